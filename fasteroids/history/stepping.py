"""Program steps as part of time: a ship's program step by step, forwards and backwards, across its ticks.

A world keeps a machine as it waits between two ticks. What it did in a tick is not kept; it is found by running the
tick again, from the state right before it, with the machine traced (`fasteroids.lang.machine.traced`). A tick is a
happening like any other, so this is exact: under literal thrust it is a cut, which comes first; a ship that ticks at
the same moment before this one has done so; and what comes of it is compared with what was lived.

A `Point` is where a debugger stands: in front of a step of a tick. After the last step of a tick comes the first of the
next tick, as for the program no time passes in between. Behind the last step of the last tick nothing comes.

    point = at_tick(timeline, 1, 12.4)      in front of the first step of the last tick up to 12.4 s
    point = next_statement(timeline, point)
    point.machine.store["target"], point.span, point.prints
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from attrs import evolve, frozen

from fasteroids.entities import Ship
from fasteroids.events import Happened
from fasteroids.history.inputs import Place
from fasteroids.history.living import Lived, relived
from fasteroids.history.marks import wanted
from fasteroids.history.questions import At, before_all_at, known, past_all_at
from fasteroids.history.timeline import Timeline
from fasteroids.lang.machine import Each, Machine, Running, place
from fasteroids.lang.machine.traced import MOST_STEPS, Step, Traced, machine_in
from fasteroids.lang.machine.values import Value
from fasteroids.lang.source import Span
from fasteroids.state import World, describe, flight, replaced
from fasteroids.units import ModelError, shown

__all__ = [
    "Point",
    "Tick",
    "at_tick",
    "is_tick_of",
    "last_steps",
    "machine_at",
    "next_statement",
    "next_step",
    "next_tick",
    "previous_statement",
    "previous_step",
    "previous_tick",
    "tick_at",
    "ticks_of",
    "traced",
]


# One tick.


@frozen
class Tick:
    """One tick of a ship's program, step by step: at least one step."""

    ship: int
    state: Lived
    """The state after it."""
    before: World
    """The world right before it, in which the program waits."""
    steps: tuple[Step, ...]
    """Its first steps, `MOST_STEPS` at most."""

    @property
    def place(self) -> Place:
        """Where it is in the past."""
        return self.state.place

    @property
    def time(self) -> float:
        """When it is, s."""
        return self.place.time

    @property
    def fuel(self) -> int:
        """The steps it might have taken."""
        return self.before.fuel

    @property
    def whole(self) -> bool:
        """Are all its steps there?"""
        return len(self.steps) < MOST_STEPS

    def writes(self, name: str) -> tuple[int, ...]:
        """The steps that gave a variable of the program another value."""
        return tuple(i for i, step in enumerate(self.steps) if name in step.changed)

    def machine(self, step: int) -> Machine:
        """The machine in front of a step, from 0 on; of as many as it took, the machine after the last.

        In front of the first the entities in variables are seen anew already. `ModelError` if there is no such step.
        """
        if type(step) is not int or not 0 <= step <= len(self.steps):
            raise ModelError(
                f"this tick of ship #{self.ship} at {self.time!r} s has steps 0 to {len(self.steps)}; "
                f"there is no {shown(step)}"
            )
        return self.steps[step].before if step < len(self.steps) else self.steps[-1].after


def is_tick_of(happened: object, ship: int) -> bool:
    """Is this a tick of a ship's program?"""
    return (
        isinstance(happened, Happened) and happened.kind == "tick" and happened.entities == (ship,)
    )


def traced(world: World, ship: int) -> World:
    """The same world with the program of a ship traced. `ModelError` if it is no ship that runs a machine."""
    f, slot = world.flight_of(ship), world.slot_of(ship)
    e = f.entity
    machine = machine_in(e.program) if isinstance(e, Ship) else None
    if machine is None or not isinstance(e, Ship):
        raise ModelError(f"{describe(e)} runs no program that could be stepped")
    return _flown(world, slot, evolve(e, program=Traced(machine)))


def last_steps(world: World, ship: int) -> tuple[Step, ...]:
    """The steps of the last tick of a ship, in a world that was `traced`."""
    e = world.flight_of(ship).entity
    assert isinstance(e, Ship)
    assert isinstance(e.program, Traced)
    return e.program.steps


def _flown(world: World, slot: int, ship: Ship) -> World:
    """The world with another record of a ship on the same flight."""
    f = world.flights[slot]
    assert f is not None
    again = flight(f.since, ship, f.bounced_off, f.next_tick, f.path)
    return replaced(world, world.clock, ((slot, again),), (), ())


def _run_again(timeline: Timeline, ship: int, state: Lived) -> Tick:
    """The tick that led to a state."""
    moment = state.place.moment
    last = next(each for each in timeline.backwards(state.place) if each.place < state.place)
    again = next(relived(last._replace(world=traced(last.world, ship)), (), (*moment, 0.0)))
    assert (again.place, again.what) == (state.place, state.what), "a tick is run again as it was"
    assert _same(again.world, state.world, ship), "and gives what it gave"
    return Tick(ship, state, last.world, last_steps(again.world, ship))


def _same(a: World, b: World, ship: int) -> bool:
    """Are the flights in two worlds the same, be the program of a ship traced or not?"""
    one, other = a.all_flights(), b.all_flights()
    f, g = one.pop(ship), other.pop(ship)
    assert isinstance(f.entity, Ship)
    assert isinstance(g.entity, Ship)
    machines = machine_in(f.entity.program) == machine_in(g.entity.program)
    as_was = evolve(f, entity=evolve(f.entity, program=g.entity.program))
    return one == other and machines and as_was == g


# All its ticks.


def ticks_of(timeline: Timeline, ship: int, *, after: At | None = None) -> Iterator[Lived]:
    """The states that the ticks of a ship's program led to, in order; those after a place or time, if one is given.

    `ModelError` as `fasteroids.history.questions.known`.
    """
    start = timeline.first.place if after is None else past_all_at(after)
    marks = wanted("tick", known(timeline, ship))
    return (state for state in timeline.forwards(start, marks) if is_tick_of(state.what, ship))


def next_tick(timeline: Timeline, ship: int, at: At) -> Tick | None:
    """The first tick of a ship after a place or time; None if there is none."""
    state = next(ticks_of(timeline, ship, after=at), None)
    return None if state is None else _run_again(timeline, ship, state)


def previous_tick(timeline: Timeline, ship: int, at: At) -> Tick | None:
    """The last tick of a ship before a place or time; None if there is none."""
    place = before_all_at(at)
    state = next((s for s in _back(timeline, ship, place) if s.place < place), None)
    return None if state is None else _run_again(timeline, ship, state)


def _back(timeline: Timeline, ship: int, place: Place) -> Iterator[Lived]:
    """The ticks of a ship up to and with a place, the last one first."""
    for state in timeline.backwards(place, wanted("tick", known(timeline, ship))):
        if is_tick_of(state.what, ship):
            yield state


def tick_at(timeline: Timeline, ship: int, at: At) -> Tick:
    """The last tick of a ship up to and with a place or time. `ModelError` if there is none that can be stepped."""
    state = next(_back(timeline, ship, past_all_at(at)), None)
    if state is None:
        when = f"{(at.time if isinstance(at, Place) else at)!r} s"
        raise ModelError(f"no program of ship #{ship} ran up to {when} in this past")
    return _run_again(timeline, ship, state)


def machine_at(timeline: Timeline, ship: int, at: At, step: int = 0) -> Machine:
    """The machine of a ship in front of a step of its last tick up to and with a place or time.

    `ModelError` as `tick_at` and `Tick.machine`.
    """
    return tick_at(timeline, ship, at).machine(step)


# Where a debugger stands.


@frozen
class Point:
    """In front of a step of a tick, or behind the last of all."""

    tick: Tick
    step: int = 0
    """Which, from 0 on: as much fuel was used in this tick."""

    @property
    def machine(self) -> Machine:
        """The program as it is there."""
        return self.tick.machine(self.step)

    @property
    def span(self) -> Span:
        """The piece of text that comes next: a node of an expression, or a statement that has its value."""
        return place(self.machine)

    @property
    def statement(self) -> Span:
        """The statement that comes next or is half done; where nothing comes, where the program stopped."""
        machine = self.machine
        if not isinstance(machine, Running):
            return place(machine)
        frame = machine.todo.first
        return machine.code.blocks[frame.block][frame.index].span

    @property
    def variables(self) -> Mapping[str, Value]:
        """What the variables hold, by name."""
        store = self.machine.store
        return {name: store[name] for name in sorted(store)}

    @property
    def prints(self) -> tuple[str, ...]:
        """The lines printed in this tick so far."""
        done = self.tick.steps[: self.step]
        return tuple(step.printed for step in done if step.printed is not None)

    @property
    def begins(self) -> bool:
        """Is a statement about to begin here, or another turn of a loop?"""
        machine = self.machine
        if not isinstance(machine, Running):
            return False
        frame = machine.todo.first
        return isinstance(frame, Each) or frame.done == 0


def at_tick(timeline: Timeline, ship: int, at: At) -> Point:
    """In front of the first step of the last tick of a ship up to and with a place or time; as `tick_at`."""
    return Point(tick_at(timeline, ship, at))


def next_step(timeline: Timeline, point: Point) -> Point | None:
    """One step on; None behind the last step of the last tick.

    Of a tick of more than `MOST_STEPS` the rest is passed over.
    """
    tick, step = point.tick, point.step + 1
    if step < len(tick.steps):
        return Point(tick, step)
    following = next_tick(timeline, tick.ship, tick.place)
    if following is not None:
        return Point(following)
    return Point(tick, step) if step == len(tick.steps) else None


def previous_step(timeline: Timeline, point: Point) -> Point | None:
    """One step back; None in front of the first step of the first tick."""
    if point.step > 0:
        return Point(point.tick, point.step - 1)
    earlier = previous_tick(timeline, point.tick.ship, point.tick.place)
    return None if earlier is None else Point(earlier, len(earlier.steps) - 1)


def next_statement(timeline: Timeline, point: Point) -> Point | None:
    """On to where the next statement begins, or behind the last step of all; None from there."""
    here = next_step(timeline, point)
    while here is not None and not here.begins and here.step < len(here.tick.steps):
        here = next_step(timeline, here)
    return here


def previous_statement(timeline: Timeline, point: Point) -> Point | None:
    """Back to where a statement began; None if there is none before."""
    here = previous_step(timeline, point)
    while here is not None and not here.begins:
        here = previous_step(timeline, here)
    return here
