"""What differs: between two worlds, by entity and field, and between two lines of a timeline, by the first moment."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import zip_longest
from typing import Any, Final, TypeAlias

from attrs import evolve, fields, frozen

from fasteroids.entities import Entity, Ship
from fasteroids.events import Happened
from fasteroids.history.changes import ABSENT, motion, told
from fasteroids.history.inputs import Cut, Instruct, Place
from fasteroids.history.lines import Line
from fasteroids.history.living import Lived, Told
from fasteroids.history.timeline import Timeline
from fasteroids.lang.machine import Machine, place
from fasteroids.lang.machine.traced import machine_in
from fasteroids.lang.machine.values import exact
from fasteroids.state import World, located
from fasteroids.units import shown

__all__ = ["Difference", "Look", "Parted", "diff", "first_difference", "outwardly", "wholly"]

_OF_WORLDS: Final = ("model", "width", "height", "seed", "fuel", "time", "clock")
_OF_FLIGHTS: Final = ("since", "path", "bounced_off", "next_tick")


@frozen
class Difference:
    """A field that is not the same in two worlds."""

    entity: int | None
    """The id of whom it is about; None for a field of the world."""
    field: str
    """`entity` if only one of the worlds has the entity."""
    a: object
    """Its value in the first world; `ABSENT` if it has none there."""
    b: object
    """Its value in the second."""

    def __str__(self) -> str:
        """One line for people."""
        who = "world" if self.entity is None else f"#{self.entity}"
        if self.field == "entity":
            there, which = (self.b, "second") if self.a is ABSENT else (self.a, "first")
            return f"{who} only in the {which}: {shown(there)}"
        return f"{who} {self.field}: {shown(self.a)} | {shown(self.b)}"


def diff(a: World, b: World) -> tuple[Difference, ...]:
    """What differs between two worlds: fields of the world first, then entities by id.

    Entities are compared as they are at the clocks of the worlds, then what of their flights nobody sees: since when,
    the `path`, `bounced_off`, `next_tick`. Programs by variables (`program.NAME`) and where they go on (`program`: line
    and column, or the text if that differs). Empty if and only if the worlds are equal; `program.NAME` with 0.0 and
    -0.0 differ, as machines do, other numbers are compared as `==` does.
    """
    found = [
        Difference(None, name, getattr(a, name), getattr(b, name))
        for name in _OF_WORLDS
        if getattr(a, name) != getattr(b, name)
    ]
    if len(found) > 1 and found[-1].field == "clock" and found[-2].field == "time":
        found.pop()  # told already
    for entity in sorted({*a.roster.slots, *b.roster.slots}):
        found += _of_entity(entity, a, b)
    return tuple(found)


def _of_entity(entity: int, a: World, b: World) -> Iterator[Difference]:
    if entity not in a or entity not in b:
        here, there = (w.entities.get(entity, ABSENT) for w in (a, b))
        yield Difference(entity, "entity", here, there)
        return
    f, g = a.flight_of(entity), b.flight_of(entity)
    if f == g and a.now == b.now:
        return
    found = [
        *_of_records(entity, located(f, a.now), located(g, b.now)),
        *(
            Difference(entity, name, getattr(f, name), getattr(g, name))
            for name in _OF_FLIGHTS
            if getattr(f, name) != getattr(g, name)
        ),
    ]
    if not found and f != g:  # the same place and velocity now, from other ones
        found = [Difference(entity, "flight", f, g)]
    yield from found


def _of_records(entity: int, a: Entity, b: Entity) -> Iterator[Difference]:
    if type(a) is not type(b):
        yield Difference(entity, "kind", a.kind, b.kind)
        return
    for attribute in fields(type(a)):
        name = attribute.name
        x, y = getattr(a, name), getattr(b, name)
        if x == y:
            continue
        if name == "program":
            yield from _of_programs(entity, x, y)
        else:
            yield Difference(entity, name, x, y)


def _of_programs(entity: int, x: Any, y: Any) -> Iterator[Difference]:
    a, b = machine_in(x), machine_in(y)
    if a is None or b is None or a.code != b.code:
        yield Difference(entity, "program", _text(a, x), _text(b, y))
        return
    named = [
        Difference(entity, f"program.{name}", a.store[name], b.store[name])
        for name in sorted(a.store)
        if exact(a.store[name]) != exact(b.store[name])
    ]
    yield from named
    here, there = (f"{m.__class__.__name__.lower()} at {_at(m)}" for m in (a, b))
    if here != there:
        yield Difference(entity, "program", here, there)
    elif not named:
        yield Difference(entity, "program", a, b)


def _text(machine: Machine | None, program: object) -> object:
    return program if machine is None else machine.code.source


def _at(machine: Machine) -> str:
    span = place(machine)
    return f"{span.line}:{span.column}"


# Lines.


@frozen
class Parted:
    """The first happenings of two lines that are not the same, after which they go apart."""

    place: Place
    """Where the first of the two is."""
    a: Lived | None
    """What happened next in the first line; None if it ends before."""
    b: Lived | None
    """And in the second."""
    differences: tuple[Difference, ...]
    """What differs, if the same happened in both, and something else came of it."""

    @property
    def time(self) -> float:
        """When, s."""
        return self.place.time

    def __str__(self) -> str:
        """Some lines for people."""
        if self.differences and self.a is not None:
            rows = [f"both: at {self.time!r} s {told(self.a.what)}", *map(str, self.differences)]
            return "\n  ".join(rows)
        return "\n".join(
            f"{label}: {'nothing more' if s is None else f'at {s.place.time!r} s {told(s.what)}'}"
            for label, s in (("first", self.a), ("second", self.b))
        )


Look: TypeAlias = Callable[[Lived], object]
"""What of a state is compared; None if it is passed over."""


def wholly(state: Lived) -> object:
    """All of a state: its place, what led to it, and every flight after it, programs included; cuts are passed over."""
    if isinstance(state.what, Cut):
        return None
    return state.place, state.what, state.world.all_flights()


def outwardly(state: Lived) -> object:
    """What of a state is seen from outside: what happened, who flies how; not what programs are, hold and print.

    By this a ship with an edited program does the same as long as it acts the same.
    """
    what = state.what
    if isinstance(what, Cut) or (isinstance(what, Told) and isinstance(what.what, Instruct)):
        return None
    if isinstance(what, Happened):
        what = evolve(what, prints=(), span=None, reason=None)
    flights = {
        i: (motion(f), isinstance(f.entity, Ship) and (f.entity.direction, f.entity.thruster))
        for i, f in state.world.all_flights().items()
    }
    return state.place.moment, what, flights


def first_difference(timeline: Timeline, a: str, b: str, *, by: Look = wholly) -> Parted | None:
    """Where two lines of a timeline part: the first happening after their common beginning that is not the same.

    They are compared as far as both have come; None if that is the same. A cut is no happening: what it decides under
    literal thrust shows in the flights after the next one. `by=outwardly` compares what the world did, and passes over
    programs. `ModelError` if there is no such line.
    """
    first, second = timeline.switch(a), timeline.switch(b)
    place = _fork(timeline, a, b)
    if place is None:
        return None
    pairs = zip_longest(_seen(first, place, by), _seen(second, place, by), fillvalue=None)
    for one, other in pairs:
        if one is None or other is None:
            shorter = first if one is None else second
            longer = other if one is None else one
            assert longer is not None
            if not _passed(shorter, longer[0]):
                return None
        elif one[1] == other[1]:
            continue
        return _parted(one and one[0], other and other[0])
    return None


def _seen(timeline: Timeline, place: Place, by: Look) -> Iterator[tuple[Lived, object]]:
    """The states after a place that are compared, and what is compared of them."""
    for state in timeline.forwards(place):
        look = by(state)
        if look is not None:
            yield state, look


def _fork(timeline: Timeline, a: str, b: str) -> Place | None:
    """The place up to which two lines are one; None if they are the same line."""
    one, other = ([line.name for line in _ancestry(timeline, name)] for name in (a, b))
    common = sum(x == y for x, y in zip(one, other, strict=False))
    left = [
        timeline.lines[name].first.place
        for names in (one, other)
        for name in names[common : common + 1]
    ]
    return min(left, default=None)


def _ancestry(timeline: Timeline, name: str) -> list[Line]:
    """A line and those it comes from, the oldest first."""
    found = [timeline.lines[name]]
    while (parent := found[0].parent) is not None:
        found.insert(0, timeline.lines[parent])
    return found


def _passed(timeline: Timeline, state: Lived) -> bool:
    """Did a line come so far that what led to a state of another would have happened in it too?"""
    moment, now = state.place.moment, timeline.world.now
    if moment == now:  # all that is due then happened only if time went up to there
        return isinstance(timeline.last.what, Cut) and isinstance(state.what, Happened)
    return moment < now


def _parted(a: Lived | None, b: Lived | None) -> Parted:
    place = min(state.place for state in (a, b) if state is not None)
    found: tuple[Difference, ...] = ()
    if a is not None and b is not None and (a.place.moment, a.what) == (b.place.moment, b.what):
        found = tuple(d for d in diff(a.world, b.world) if d.entity is not None)
    return Parted(place, a, b, found)
