"""Breakpoints of a ship's program: on a line, or on a condition; and running to the next one, in either direction.

A program stops in front of statements. A breakpoint is a set of such points of a past: `AtLine` all those of
statements that begin on a line, `When` those where its condition holds and did not hold at the one before. So running
back comes to the points that running on comes to, and time itself has no say in it.

What a condition says of the world it says of the world of the tick, and of variables what they hold at the point.
What is true only between two ticks is none of the program's business; `fasteroids.history.first_time` finds that.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import islice, pairwise
from typing import Final, Literal, TypeAlias

from attrs import evolve, frozen

from fasteroids.entities import Ship
from fasteroids.history import (
    Condition,
    Place,
    Point,
    Tick,
    Timeline,
    next_tick,
    previous_tick,
)
from fasteroids.history.living import Lived, reached
from fasteroids.lang.machine import Machine
from fasteroids.state import World, flight, replaced
from fasteroids.units import ModelError, shown

__all__ = ["MOST_TICKS", "AtLine", "Breakpoint", "Found", "When", "next_break"]

MOST_TICKS: Final = 50
"""So many ticks are looked through at once, if nobody says: 10 s of a past."""


@frozen
class AtLine:
    """Stop in front of each statement that begins on this line, from 1 on."""

    line: int


@frozen
class When:
    """Stop in front of the first statement at which a condition has become true."""

    condition: Condition


Breakpoint: TypeAlias = AtLine | When


@frozen
class Found:
    """What running to a breakpoint came to."""

    point: Point | None
    """Where it stopped; None if no breakpoint was met."""
    breakpoint: Breakpoint | None
    """Which one it was, the first of those given if several."""
    ticks: int
    """How many ticks it looked through, the one it started in included."""
    last: Place
    """The place of the last tick it looked through."""
    exhausted: bool
    """Did the past end there, with no tick more in this direction?"""


def next_break(
    timeline: Timeline,
    breakpoints: Collection[Breakpoint],
    position: Point,
    step: Literal[1, -1] = 1,
    *,
    ticks: int = MOST_TICKS,
) -> Found:
    """Run to the next breakpoint after a position, or, with a step of -1, back to the last one before it.

    It looks through at most so many ticks, at least 1, the one it starts in included. To go on where it stopped
    without having found any, start from the first or behind the last step of `found.last`. Each tick is run again,
    step by step. `ModelError` if `ticks` or `step` make no sense.
    """
    if type(ticks) is not int or ticks < 1:
        raise ModelError(f"at least 1 tick is looked through; got {shown(ticks)}")
    if step not in (1, -1):
        raise ModelError(f"a program runs by 1 or by -1; got {shown(step)}")
    walk = _ticks(timeline, position.tick, step)
    looked, last = 0, position.tick
    for last in islice(walk, ticks):
        looked += 1
        points = _beginnings(last)
        stops = [_stops(timeline, each, last, points) for each in breakpoints]
        for i in range(len(points))[::step]:
            point = points[i]
            if last.place != position.tick.place or (point.step - position.step) * step > 0:
                for each, stopping in zip(breakpoints, stops, strict=True):
                    if stopping[i]:
                        return Found(point, each, looked, last.place, exhausted=False)
    return Found(None, None, looked, last.place, exhausted=next(walk, None) is None)


def _ticks(timeline: Timeline, tick: Tick | None, step: int) -> Iterator[Tick]:
    """The ticks of a ship from one on."""
    following = next_tick if step == 1 else previous_tick
    while tick is not None:
        yield tick
        tick = following(timeline, tick.ship, tick.place)


def _beginnings(tick: Tick) -> list[Point]:
    """The points of a tick in front of its statements, in order."""
    points = (Point(tick, i) for i in range(len(tick.steps)))
    return [point for point in points if point.begins]


def _last_before(timeline: Timeline, tick: Tick) -> Point | None:
    """The last point in front of a statement before a tick."""
    earlier = previous_tick(timeline, tick.ship, tick.place)
    while earlier is not None and not (points := _beginnings(earlier)):
        earlier = previous_tick(timeline, tick.ship, earlier.place)
    return None if earlier is None else points[-1]


def _stops(
    timeline: Timeline, breakpoint_: Breakpoint, tick: Tick, points: Sequence[Point]
) -> list[bool]:
    """Which points of a tick, those in front of its statements, are ones of a breakpoint?"""
    if isinstance(breakpoint_, AtLine):
        return [point.statement.line == breakpoint_.line for point in points]
    holding = _holding(breakpoint_.condition, tick, points)
    stopping = [held and not before for before, held in pairwise([False, *holding])]
    if stopping and stopping[0]:  # it may have held at the end of an earlier tick
        last = _last_before(timeline, tick)
        stopping[0] = last is None or not _holding(breakpoint_.condition, last.tick, [last])[0]
    return stopping


def _holding(condition: Condition, tick: Tick, points: Sequence[Point]) -> list[bool]:
    """Does a condition hold at points of a tick? It is looked at only where a variable was set."""
    world = reached(Lived(tick.place, None, tick.before), tick.place.moment).world
    found: list[bool] = []
    store = None
    for point in points:
        machine = point.machine
        if store is None or machine.store is not store:
            held, store = condition(_with(world, tick.ship, machine)), machine.store
        found.append(held)
    return found


def _with(world: World, ship: int, machine: Machine) -> World:
    """The world with the program of a ship as it is at a point of its tick."""
    f, slot = world.flight_of(ship), world.slot_of(ship)
    assert isinstance(f.entity, Ship)
    told = flight(f.since, evolve(f.entity, program=machine), f.bounced_off, f.next_tick, f.path)
    return replaced(world, world.clock, ((slot, told),), (), ())
