"""What the engine knows of the future, as data to draw: where entities will fly, and what they will meet.

The world is evolved on a copy, so the predictions it carries stay where they are, and what is shown is what will happen
if nobody interferes: bounces, deaths and running programs included. A look ahead ends after `MOST` events, so that it
costs a few milliseconds however crowded a world is; `Overlay.seconds` says how far it came.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from copy import copy
from typing import Final, NamedTuple

from attrs import frozen

from fasteroids.entities import Ship
from fasteroids.events import Happened, unfold
from fasteroids.moments import Moment, advanced, between, checked_time, later
from fasteroids.state import Flight, World, located
from fasteroids.units import ModelError

__all__ = ["MOST", "Line", "Mark", "Overlay", "Point", "overlay"]

Point = tuple[float, float]
"""(x, y), km."""

MOST: Final = 96
"""Events after which a look ahead ends."""

_PIECES: Final = 12
"""Straight pieces that stand for the part of a bent path between two events."""


class Line(NamedTuple):
    """The way of an entity."""

    id: int
    points: tuple[Point, ...]
    """From where it is now, in order."""


class Mark(NamedTuple):
    """The next contact or wall of one or two entities."""

    seconds: float
    """From now."""
    at: Point
    """Where they touch, km."""
    ids: tuple[int, ...]
    wall: str | None
    """The side of the world, or None for a contact."""
    fatal: bool
    """Does anybody die?"""


@frozen
class Overlay:
    """Ways and next meetings, known for so many seconds from now on."""

    lines: tuple[Line, ...]
    marks: tuple[Mark, ...]
    """In order of time, one at most for each entity asked about, unless it meets the mark of another one."""
    seconds: float


def overlay(
    world: World, ids: Collection[int] | None = None, seconds: float = 4.0, most: int = MOST
) -> Overlay:
    """The future of some entities (None: of all) for so many seconds, or for `most` events if that is sooner.

    Ids that are not in the world are left out. Who dies ends its line; who is born gets none. Under literal thrust the
    future depends on how time is cut; shown is that of one long step. `ModelError` if `seconds` is nan, negative
    or infinite. Where a world has no future, because its clock is at its end or because of a storm (see
    `fasteroids.events.storm_limit`), what is known before is shown.
    """
    followed = [i for i in (world.roster.slots if ids is None else set(ids)) if i in world]
    ways = {i: _Way(world.flight_of(i), world.now) for i in sorted(followed)}
    ships = [i for i, way in ways.items() if isinstance(way.flight.entity, Ship)]
    marks: list[Mark] = []
    met: set[int] = set()
    after, whole = world, False
    checked_time(seconds, "how far to look ahead")
    try:
        until = advanced(world.clock, seconds)
        future = unfold(copy(world), until, most)
        while True:
            happened, after = next(future)
            _follow(ways, {*ships, *happened.entities, *happened.died}, after)
            if happened.kind in ("contact", "wall"):
                new = [i for i in happened.entities if i in ways and i not in met]
                if new:
                    marks.append(_mark(happened, between(world.now, after.now)))
                    met.update(happened.entities)
    except StopIteration as stop:
        after = stop.value
        whole = after.now >= until[:2]
    except ModelError:  # a storm, or no time left
        pass
    end = between(world.now, after.now)
    lines = tuple(Line(i, way.ended(after.now)) for i, way in ways.items())
    return Overlay(lines, tuple(marks), seconds if whole else end)


class _Way:
    """The way of an entity as far as it is known."""

    __slots__ = ("_points", "_since", "flight", "over")

    def __init__(self, f: Flight, now: Moment) -> None:
        self.flight, self._since, self.over = f, now, False
        e = located(f, now)
        self._points: list[Point] = [(e.x, e.y)]

    def turned(self, f: Flight | None, now: Moment) -> None:
        """Go on with another flight; None ends the way."""
        if self.over or f is self.flight:
            return
        self._points += self._pieces(now)
        self._since = now
        if f is None:
            self.over = True
        else:
            self.flight = f

    def ended(self, now: Moment) -> tuple[Point, ...]:
        """Its points, up to now."""
        return tuple(self._points if self.over else [*self._points, *self._pieces(now)])

    def _pieces(self, now: Moment) -> Iterator[Point]:
        """The points after the last one, up to now."""
        f = self.flight
        if f.path is not None:
            step = between(self._since, now) / _PIECES
            for i in range(1, _PIECES):
                e = located(f, later(self._since, i * step))
                yield e.x, e.y
        e = located(f, now)
        yield e.x, e.y


def _follow(ways: dict[int, _Way], touched: set[int], after: World) -> None:
    """Bring the ways of these entities to the world after an event."""
    now, slots, flights = after.now, after.roster.slots, after.flights
    for i in touched & ways.keys():
        ways[i].turned(flights[slots[i]] if i in slots else None, now)


def _mark(happened: Happened, seconds: float) -> Mark:
    at = happened.at
    assert at is not None  # contacts and walls have a place
    return Mark(seconds, at, happened.entities, happened.wall, bool(happened.died))
