"""A timeline: the past of a world as a value, with every moment of it at hand, and branches of it.

    timeline = begin(world).evolve_until(60.0).act(1, Fire()).evolve(5.0)
    timeline.at(12.5)                       the world then, with the bits it had
    other = timeline.branch(12.5)           another future from there; the old one stays

Every operation gives another timeline; pasts are shared. A state is kept for each event, each input, and each cut
that the caller makes. When they cost more than the budget, states that can be lived again are dropped (see
`fasteroids.history.lines`): never the first or last of a line, nor where a branch begins, nor a bookmark.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any, Final

from attrs import evolve, field, frozen
from pyrsistent import PMap, pmap

from fasteroids.actions import Action, Program
from fasteroids.entities import Entity
from fasteroids.history.inputs import Act, Add, Cut, Input, Instruct, Place, Remove
from fasteroids.history.lines import Kept, Line, appended, begun, index_of, kept, thinned
from fasteroids.history.living import (
    Lived,
    answered,
    beginning,
    lived,
    reached,
    relived,
    up_to,
)
from fasteroids.history.marks import Marks, marked
from fasteroids.moments import Clock, advanced, clock_at
from fasteroids.state import World
from fasteroids.units import ModelError, shown

__all__ = ["BUDGET", "MAIN", "Bookmark", "Timeline", "begin"]

BUDGET: Final = 256 * 2**20
"""Bytes of kept states, if nobody says."""

MAIN: Final = "main"
"""The name of the first line of a timeline."""

_RECENT: Final = 4
"""Gaps whose states are held after they were lived again: one goes back and forth near the last place."""


@frozen
class Bookmark:
    """A state with a name, and the line it is on. It holds its state, so that no thinning can drop it."""

    name: str
    line: str
    state: Lived


@frozen(eq=False)
class Timeline:
    """The lines of a past, and the one that time goes on in; made by `begin`.

    Requires: budget, the bytes that kept states may cost, an integer of 0 or more.
    Invariant: `at(t)` has the same bits however states were thinned (tests/properties/test_timeline.py).
    Invariant: no operation changes another timeline (tests/properties/test_timeline.py).

    `bytes` is an estimate: of what each state has that the one kept before it has not. A timeline over its budget
    has nothing left to drop.
    """

    lines: PMap[str, Line]
    name: str = MAIN
    marks: PMap[str, Bookmark] = field(factory=pmap)
    budget: int = BUDGET
    _recent: list[tuple[Kept, list[Lived]]] = field(factory=list, repr=False)

    # What it holds.

    @property
    def line(self) -> Line:
        """The line that time goes on in."""
        return self.lines[self.name]

    @property
    def last(self) -> Lived:
        """The last state of the line."""
        return self.line.last

    @property
    def world(self) -> World:
        """The world at the end of the line: now."""
        return self.last.world

    @property
    def bytes(self) -> int:
        """What the kept states of all lines cost, in bytes."""
        return sum(line.bytes for line in self.lines.values())

    @property
    def states(self) -> int:
        """How many states of all lines are kept."""
        return sum(line.states for line in self.lines.values())

    @property
    def first(self) -> Lived:
        """The state the past of this line begins with."""
        return self._lines()[0][0].first

    @property
    def bookmarks(self) -> Mapping[str, Bookmark]:
        """The bookmarks by name."""
        return self.marks

    # How it grows.

    def evolve(self, dt: float) -> Timeline:
        """Time goes on for `dt` s, as `fasteroids.evolve`, and is cut there. `ModelError` as there."""
        return self._until(advanced(self.world.clock, dt))

    def evolve_until(self, time: float) -> Timeline:
        """Time goes on up to `time` (absolute, s), as `fasteroids.evolve_until`, and is cut there.

        `ModelError` as there, and if time has come further already.
        """
        clock = clock_at(time)
        if clock[:2] < self.world.now:
            if time != self.world.time:
                raise ModelError(
                    f"this line has come to {self.world.time!r} s already; branch to live on from {shown(time)} s"
                )
            clock = self.world.clock  # its time is only the double nearest to its clock
        return self._until(clock)

    def _until(self, clock: Clock) -> Timeline:
        return self.grown(list(lived(self.last, clock)))

    def reach(self, place: Place) -> Timeline:
        """Time goes on up to a place that another past had: of what is due at its moment, only what came before it.

        If fewer happenings lead there than did in that past, all that is due happens. As it is if it has come there.
        `ModelError` as `evolve`.
        """
        states, coming = [], up_to(self.last, place)
        while True:
            try:
                states.append(next(coming))
            except StopIteration as stop:
                last: Lived = stop.value
                break
        if last.world.now > (states[-1] if states else self.last).world.now:
            states.append(Lived(last.place, Cut(last.world.clock), last.world))
        return self.grown(states)

    def take(self, what: Input) -> Timeline:
        """The world outside does something, now. `ModelError` if it makes no sense. A cut is time going on up to it."""
        if isinstance(what, Cut):
            return self._until(what.clock)
        return self.grown([answered(self.last, what)])

    def act(self, ship: int, action: Action) -> Timeline:
        """A ship takes an action, as `fasteroids.act`."""
        return self.take(Act(ship, action))

    def instruct(self, ship: int, program: Program) -> Timeline:
        """A ship runs another program from its next tick on."""
        return self.take(Instruct(ship, program))

    def add(self, entity: Entity) -> Timeline:
        """An entity comes into the world, as `World.add`."""
        return self.take(Add(entity))

    def remove(self, entity: int) -> Timeline:
        """An entity is taken out, as `World.remove`."""
        return self.take(Remove(entity))

    def grown(self, states: Sequence[Lived]) -> Timeline:
        """With states that were lived elsewhere, from its last one on, in order, as `living` gives them."""
        line = appended(self.line, states)
        return evolve(self, lines=self.lines.set(self.name, line)).thin()

    def thin(self, budget: int | None = None) -> Timeline:
        """With states dropped until they cost no more than a budget, the timeline's own if none is given."""
        most = self.budget if budget is None else budget
        lines = self.lines
        for line in sorted(lines.values(), key=lambda line: line.bytes, reverse=True):
            excess = sum(each.bytes for each in lines.values()) - most
            if excess <= 0:
                break
            lines = lines.set(line.name, thinned(line, excess))
        return self if lines is self.lines else evolve(self, lines=lines)

    # Any moment.

    def at(self, time: float) -> World:
        """The world at a time of the past (absolute, s), after all that happened then.

        Its bits are those of `evolve_until` from the first world through every input, and cut where the caller cut
        if cuts decide (literal thrust). `ModelError` if the line has no such time.
        """
        clock = clock_at(time)
        first, last = self.first.world, self.world
        if not first.now <= clock[:2] <= last.now:
            raise ModelError(
                f"this past goes from {first.time!r} s to {last.time!r} s; there is no {shown(time)} s in it"
            )
        world = self.reached(Place.end_of(clock[:2])).world
        return world if world.clock == clock else evolve(world, clock=clock)

    def reached(self, place: Place) -> Lived:
        """The state at a place; at one to which no happening led, the last before it as time reaches its moment."""
        return reached(self.state(place), min(place.moment, self.world.now))

    def state(self, place: Place) -> Lived:
        """The last state that is not after a place: the one right there, if the place is one of this past."""
        return next(self.backwards(place))

    def forwards(self, place: Place, wanted: Marks | None = None) -> Iterator[Lived]:
        """The states after a place, in order. With marks, at least those that have any of them; others may lack."""
        for line, end in self._lines():
            if end is not None and end <= place:
                continue
            start = (0, 0) if place < line.first.place else index_of(line, place)
            for state in self._states(line, start, 1, wanted):
                if end is not None and state.place > end:
                    break
                if state.place > place:
                    yield state

    def backwards(self, place: Place, wanted: Marks | None = None) -> Iterator[Lived]:
        """The states up to a place, the last one first. With marks, at least those that have any of them."""
        for line, end in reversed(self._lines()):
            here = place if end is None else min(place, end)
            if here < line.first.place:
                continue
            for state in self._states(line, index_of(line, here), -1, wanted):
                if state.place <= here:
                    yield state

    def _states(
        self, line: Line, start: tuple[int, int], step: int, wanted: Marks | None
    ) -> Iterator[Lived]:
        """The states of a line from a kept one on, but for what a branch begins with if that is its parent's."""
        for each in kept(line, start, step, wanted):
            states = [each.state] if wanted is None or marked(each.state).may_hold(wanted) else []
            if each.gap.size and (wanted is None or each.gap.marks.may_hold(wanted)):
                states += self._relived(line, each)
            for state in states if step > 0 else reversed(states):
                if line.parent is None or state is not line.first or state.what is not None:
                    yield state

    def _relived(self, line: Line, each: Kept) -> list[Lived]:
        """The states in the gap after a kept one."""
        for known, states in self._recent:
            if known is each:
                return states
        clock = line.last.world.clock
        past = relived(each.state, each.gap.givens, clock)
        states = list(islice(past, each.gap.size))
        assert len(states) == each.gap.size, "a past is lived again as it was"
        self._recent[:] = [(each, states), *self._recent[: _RECENT - 1]]
        return states

    def _lines(self) -> list[tuple[Line, Place | None]]:
        """The lines that the past of this one is made of, the oldest first, each with the place where it is left."""
        found: list[tuple[Line, Place | None]] = [(self.line, None)]
        while (parent := found[0][0].parent) is not None:
            found.insert(0, (self.lines[parent], found[0][0].first.place))
        return found

    def holds(self, name: str, place: Place) -> bool:
        """Is a place on the line of this name in the past of the line that time goes on in?

        Not if that past does not come by the line, or has left it before.
        """
        ends = {line.name: self.last.place if end is None else end for line, end in self._lines()}
        return name in ends and place <= ends[name]

    # Branches and bookmarks.

    def branch(self, at: float | Place, name: str | None = None) -> Timeline:
        """Another line from a time (s) or a place of this past on, in which time goes on; the old future stays.

        It begins with the world that `at` gives. Without a name it gets the first free number. `ModelError` if the name
        is taken or the time is not in this past.
        """
        name = self._free() if name is None else name
        if name in self.lines:
            raise ModelError(f"there is a line {name!r} already")
        state = self._looked_up(at)
        parent = next(
            line.name for line, _ in reversed(self._lines()) if line.first.place <= state.place
        )
        line = begun(name, parent, state)
        return evolve(self, lines=self.lines.set(name, line), name=name).thin()

    def _free(self) -> str:
        return next(
            name for name in map(str, range(2, len(self.lines) + 3)) if name not in self.lines
        )

    def _looked_up(self, at: float | Place) -> Lived:
        """The state at a time or a place: without a `what` where this past has one, with a cut between two of them.

        Right before what happens at a moment time is not cut either: the happening does that.
        """
        place = at if isinstance(at, Place) else Place.end_of(self.at(at).now)
        if isinstance(at, Place) and not self.first.place <= at <= self.last.place:
            raise ModelError(f"there is no place {tuple(at)} in this past")
        state = self.state(place)
        if state.place.moment < place.moment:
            there, after = self.reached(place), next(self.forwards(place), None)
            happens = after is not None and after.place.moment == place.moment
            state = there._replace(what=None if happens else Cut(there.world.clock))
        else:
            state = state._replace(what=None)
        if isinstance(at, Place) and state.place != at:
            raise ModelError(f"there is no place {tuple(at)} in this past")
        # What sums of steps left on the clock is lived again only where something was told: no future may hang on it.
        world = state.world
        if world.clock[2] != 0.0:
            state = state._replace(world=evolve(world, clock=(*world.now, 0.0)))
        return state

    def switch(self, name: str) -> Timeline:
        """Time goes on in another line. `ModelError` if there is none of this name."""
        if name not in self.lines:
            raise ModelError(
                f"there is no line {shown(name)}; there are {', '.join(sorted(self.lines))}"
            )
        return evolve(self, name=name)

    def bookmark(self, name: str, at: float | Place | None = None) -> Timeline:
        """With a name for a time or a place of this past, or for now. A name that was used before moves."""
        state = self.last if at is None else self._looked_up(at)
        return evolve(self, marks=self.marks.set(name, Bookmark(name, self.name, state)))

    def forget(self, name: str) -> Timeline:
        """Without a bookmark. `ModelError` if there is none of this name."""
        if name not in self.marks:
            raise ModelError(f"there is no bookmark {shown(name)}")
        return evolve(self, marks=self.marks.remove(name))

    def __reduce__(self) -> tuple[Any, ...]:
        return Timeline, (self.lines, self.name, self.marks, self.budget)


def begin(world: World, *, budget: int = BUDGET) -> Timeline:
    """The timeline that begins with a world, now. `budget`: the bytes that kept states may cost."""
    if type(budget) is not int or budget < 0:
        raise ModelError(f"a budget is a number of bytes, 0 or more; got {shown(budget)}")
    return Timeline(pmap({MAIN: begun(MAIN, None, beginning(world))}), budget=budget)
