"""Another program from here on: the past is branched, the edited program runs, and the rest is given again.

    outcome = yield from editing(timeline, 1, program, at)
    outcome.timeline, outcome.left_out, outcome.parted

What players and programs of other ships did not decide, the world outside gives again: inputs at their times. An
input names entities by id. An id means the same in both futures if it was given before they part, or to what an
input brought that is given again; what names another one is left out, and so is what another program makes
impossible, and whatever the edited ship itself was told.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator
from typing import Final, TypeAlias

from attrs import evolve, frozen

from fasteroids.actions import Program
from fasteroids.entities import Bullet, Entity
from fasteroids.history import (
    Act,
    Add,
    Cut,
    Input,
    Instruct,
    Lived,
    Parted,
    Place,
    Remove,
    Timeline,
    Told,
    first_difference,
    outwardly,
)
from fasteroids.history.living import cuts_decide
from fasteroids.history.marks import wanted
from fasteroids.moments import Clock, advanced, between
from fasteroids.units import ModelError

__all__ = ["Edited", "LeftOut", "editing"]

_PIECE: Final = 1.0
"""Seconds of the game that are lived at once, if that gives no more than `_MOST_PIECES`."""

_MOST_PIECES: Final = 200


@frozen
class LeftOut:
    """An input of the old line that was not given again, and why not, in a few words."""

    place: Place
    what: Input
    reason: str


@frozen
class Edited:
    """A past with another future."""

    timeline: Timeline
    """Time goes on in the new line."""
    old: str
    """The name of the line that was left; the new one is `timeline.name`."""
    given: int
    """How many inputs were given again."""
    left_out: tuple[LeftOut, ...]
    parted: Parted | None
    """Where the two lines first do something different, seen from outside; None if they do not."""


def editing(
    timeline: Timeline, ship: int, program: Program, at: float | Place
) -> Generator[float, None, Edited]:
    """The timeline with a branch at a time or place in which a ship runs another program from its beginning.

    It goes as far as the old line did. In pieces: yields the time (s) it has come to, and returns what it came to.
    `ModelError` if there is no such ship then, or as `Timeline.branch`.

    A piece is a second of the game, or a 200th of all if that is more; or under literal thrust, where no more cuts may
    be made than there were, up to the next of those. Whoever shows a screen can so stay awake, and give up in between.
    """
    fork = timeline.branch(at)
    start, last, clock = fork.last.place, timeline.last, timeline.world.clock
    piece = max(_PIECE, between(start.moment, clock[:2]) / _MOST_PIECES)
    again = _Again(fork.instruct(ship, program), ship, fork.world.roster.next_id, piece)
    whole = isinstance(last.what, Cut)  # else it ends between two happenings, or with an input
    end = Place.end_of(clock[:2]) if whole else last.place
    for place, what, born in _inputs(timeline, start, end):
        if isinstance(what, Cut):
            again.cut(what.clock)
            yield place.time
        else:
            yield from again.reached(place)
            again.give(place, what, born)
    yield from again.reached(end)
    if whole and again.timeline.world.clock != clock:
        again.cut(clock)
    parted = first_difference(again.timeline, timeline.name, again.timeline.name, by=outwardly)
    return Edited(again.timeline, timeline.name, again.given, tuple(again.left_out), parted)


_Given: TypeAlias = tuple[Place, Input, tuple[int, ...]]
"""An input, the place before it, and the ids that it brought."""


def _inputs(timeline: Timeline, start: Place, end: Place) -> Iterator[_Given]:
    """The inputs after a place up to another, each with its own place, before it, and the ids that it brought.

    Cuts are among them where they decide.
    """
    cuts = cuts_decide(timeline.world)
    for given in _told(timeline.forwards(start, None if cuts else wanted("input")), cuts=cuts):
        if given[0] >= end:
            return
        yield given


def _told(states: Iterable[Lived], *, cuts: bool) -> Iterator[_Given]:
    for place, what, _ in states:
        if isinstance(what, Told):
            yield place.before, what.what, what.born
        elif cuts and isinstance(what, Cut):
            yield Place(*what.clock[:2]), what, ()


class _Again:
    """The new line as it grows. Mutable, and gone when it is done.

    `_shift`: at a moment it has so many inputs more than the old line; one where it begins, fewer where some are left
    out.
    """

    def __init__(self, timeline: Timeline, ship: int, next_id: int, piece: float) -> None:
        self.timeline = timeline
        self.given = 0
        self.left_out: list[LeftOut] = []
        self._ship = ship
        self._piece = piece
        self._shift = timeline.last.place.moment, 1
        self._common = next_id
        self._ids: dict[int, int] = {}

    def reached(self, place: Place) -> Iterator[float]:
        """Time goes on up to a place of the old line, in pieces; the time after each."""
        moment, more = self._shift
        if place.moment == moment:
            place = place._replace(nth=max(place.nth + more, 0))
        while not cuts_decide(self.timeline.world):
            piece = advanced(self.timeline.world.clock, self._piece)
            if piece[:2] >= place.moment:
                break
            self.cut(piece)
            yield self.timeline.world.time
        self.timeline = self.timeline.reach(place)
        yield self.timeline.world.time

    def cut(self, clock: Clock) -> None:
        """Time goes on up to a clock, and all that is due then happens."""
        if clock[:2] >= self.timeline.world.now:
            self.timeline = self.timeline.take(Cut(clock))

    def give(
        self, place: Place, what: Act | Instruct | Add | Remove, born: tuple[int, ...]
    ) -> None:
        """An input, now, if it makes sense."""
        try:
            self.timeline = self.timeline.take(self._translated(what))
        except ModelError as error:
            self.left_out.append(LeftOut(place, what, str(error)))
            moment, more = self._shift
            self._shift = place.moment, (more if place.moment == moment else 0) - 1
            return
        self.given += 1
        if isinstance(what, Add):
            self._ids[born[0]] = self.timeline.last.born[0]

    def _translated(self, what: Act | Instruct | Add | Remove) -> Act | Instruct | Add | Remove:
        """The same input with the ids of this line; `ModelError` says why it is left out."""
        match what:
            case Act(ship) | Instruct(ship):
                if ship == self._ship:
                    raise ModelError("it was meant for the ship whose program was edited")
                return evolve(what, ship=self._known(ship))
            case Remove(entity):
                return Remove(self._known(entity))
            case Add(entity):
                return Add(self._brought(entity))

    def _known(self, entity: int) -> int:
        if entity in self._ids:
            return self._ids[entity]
        if entity < self._common:
            return entity
        raise ModelError(f"#{entity} came to be after the lines part, so it may be another one")

    def _brought(self, entity: Entity) -> Entity:
        """An entity that an input brings, without an id that may be taken."""
        if isinstance(entity, Bullet):
            return evolve(entity, id=None, source=self._known(entity.source))
        return evolve(entity, id=None)
