"""The one loop that lives a past, the first time and again: from a state, through inputs at their places, to a clock.

A timeline grows and fills its gaps by it, `verify` checks a recording by it. It consumes `fasteroids.events.unfold`,
as everything does that goes through time.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable
from typing import NamedTuple, TypeAlias

from attrs import evolve, frozen

from fasteroids import models
from fasteroids.events import Happened, unfold
from fasteroids.history.inputs import Cut, Given, Input, Place, applied
from fasteroids.moments import Clock, Moment
from fasteroids.state import World

__all__ = [
    "Lived",
    "Past",
    "Told",
    "What",
    "answered",
    "beginning",
    "cuts_decide",
    "lived",
    "reached",
    "relived",
    "up_to",
]


@frozen(weakref_slot=False)
class Told:
    """An input that was no cut, and what came of it at once: the ids that died and were born.

    A bullet that is fired where something is dies as it is fired, and is among both.
    """

    what: Input
    died: tuple[int, ...] = ()
    born: tuple[int, ...] = ()


What: TypeAlias = Happened | Told | Cut | None
"""What led to a state: an event, an input, a cut; None if its past begins with it."""


class Lived(NamedTuple):
    """A state of a past: where it is, what led to it, and the world right after that."""

    place: Place
    what: What
    world: World

    @property
    def died(self) -> tuple[int, ...]:
        """The ids of those that died of it."""
        return self.what.died if isinstance(self.what, Happened | Told) else ()

    @property
    def born(self) -> tuple[int, ...]:
        """The ids of those that it brought."""
        return self.what.born if isinstance(self.what, Happened | Told) else ()


Past: TypeAlias = Generator[Lived, None, Lived]
"""States one after another. It returns the last one, brought to the time that was asked for."""


def beginning(world: World) -> Lived:
    """The first state of a past."""
    return Lived(Place(*world.now), None, world)


def cuts_decide(world: World) -> bool:
    """Do futures of this world depend on where they are cut? Under literal thrust only (law L1)."""
    return models.named(world.model).thrust == "literal"


def lived(last: Lived, until: Clock) -> Past:
    """Each event after a state up to a clock not before it, and the cut there.

    `ModelError` if events pile up at one moment without end.
    """
    last = yield from _events(last, until)
    last = Lived(last.place, Cut(until), last.world)
    yield last
    return last


def answered(last: Lived, what: Input) -> Lived:
    """The state after an input, now; `ModelError` if it makes no sense there. A cut leads to its own clock."""
    if isinstance(what, Cut):
        *_, last = lived(last, what.clock)
        return last
    world = applied(last.world, what)
    died: tuple[int, ...] = ()
    born: tuple[int, ...] = ()
    old, new = last.world.roster, world.roster
    if old is not new:
        died = tuple(sorted(i for i in old.slots if i not in new.slots))
        born = tuple(sorted(i for i in new.slots if i not in old.slots))
        passing = tuple(i for i in range(old.next_id, new.next_id) if i not in new.slots)
        if died and passing:  # a bullet fired where something was
            died, born = tuple(sorted((*died, *passing))), tuple(sorted((*born, *passing)))
    return Lived(last.place.after(world.now), Told(what, died, born), world)


def reached(last: Lived, moment: Moment) -> Lived:
    """The state as time reaches a moment before which nothing more happens. A look is a cut, if cuts decide.

    Unless something happens at that very moment: then the cut is that of the happening.
    """
    world = last.world
    if moment <= world.now:
        return last
    clock = (*moment, 0.0)
    cut = list(lived(last, clock)) if cuts_decide(world) else []
    world = cut[0].world if len(cut) == 1 else evolve(world, clock=clock)
    return Lived(last.place.reaching(moment), None, world)


def relived(last: Lived, givens: Iterable[Given], until: Clock) -> Past:
    """Each event after a state, each input at its place, up to a clock not before any of them.

    An input comes at its place even if fewer happenings lead there than did the first time: whoever compares the two
    pasts finds the difference by itself. `ModelError` as `answered` and `lived`.
    """
    for place, what, residue in givens:
        if isinstance(what, Cut):  # not by way of its place: time would be cut there twice
            last = yield from lived(last, what.clock)
        else:
            last = yield from up_to(last, place)
            if residue != last.world.clock[2]:
                last = yield from _events(last, (*place.moment, residue))
            last = answered(last, what)
            yield last
    return (yield from _events(last, until))


def up_to(last: Lived, place: Place) -> Past:
    """Each event up to a place: no more of those at its moment than belong before it, maybe none."""
    events = _events(last, (*place.moment, 0.0))
    while last.place < place:
        try:
            following = next(events)
        except StopIteration as stop:
            there: Lived = stop.value
            return there
        if following.place > place:
            return reached(last, place.moment)
        last = following
        yield last
    return last


def _events(last: Lived, until: Clock) -> Past:
    """Each event up to and including a clock's moment; returns the last state, brought to that clock."""
    place, what, world = last
    events = unfold(world, until)
    while True:
        try:
            what, world = next(events)
        except StopIteration as stop:
            return Lived(place.reaching(until[:2]), what, stop.value)
        place = place.after(world.now)
        yield Lived(place, what, world)
