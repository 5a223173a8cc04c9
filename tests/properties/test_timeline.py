"""L15: any moment of a past is the world that was lived, with the same bits, however many states were dropped.

A timeline is driven beside a plain list of every state there was.
"""

from __future__ import annotations

import pickle
import re
from typing import Any

import pytest
from attrs import define, evolve, field
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)

from fasteroids import ModelError, Ship, World, act, evolve_until
from fasteroids import evolve as evolve_by
from fasteroids.history import Act, Place, Told, begin
from fasteroids.history.living import cuts_decide
from fasteroids.history.marks import is_of, wanted
from fasteroids.moments import clock_at, moment_at
from fasteroids.testing import actions, unfold, worlds
from fasteroids.testing.runs import FOREVER
from tests.properties.laws import BURNING, EXAMPLES

LONGEST = 60
"""Events that a line has at most: the list beside it keeps them all."""


@define
class Plain:
    """A line of history as a list: each happening as its place, what it was, and the world after it; and each cut."""

    states: list[tuple[Place, Any, World]]
    names: dict[str, World] = field(factory=dict)

    @property
    def world(self) -> World:
        return self.states[-1][2]

    @property
    def events(self) -> int:
        return sum(what is not None for _, what, _ in self.states)

    def add(self, what: Any, world: World) -> None:
        place = self.states[-1][0]
        nth = place.nth if place.moment == world.now else 0
        self.states.append((Place(*world.now, nth + (what is not None)), what, world))

    def at(self, time: float) -> World:
        moment = moment_at(time)
        world = [w for _, _, w in self.states if w.now <= moment][-1]
        if world.now < moment and cuts_decide(world):
            return evolve_until(world, time)
        return evolve(world, clock=clock_at(time))


class Histories(RuleBasedStateMachine):
    """Runs, inputs, jumps, branches, bookmarks and thinning."""

    @initialize(
        world=BURNING | worlds(min_size=1, max_size=5, kinds=(Ship,), thrusters=True),
        runs=st.lists(st.tuples(st.integers(0, 12), st.floats(0.0, 1.0)), max_size=5),
    )
    def start(self, world: World, runs: list[tuple[int, float]]) -> None:
        self.timeline = begin(world)
        self.plain = {self.timeline.name: Plain([(Place(*world.now), None, world)])}
        self.bookmarks: dict[str, tuple[str, World]] = {}
        for events, part in runs:
            self.run_once(events, part, step=False)

    @property
    def line(self) -> Plain:
        return self.plain[self.timeline.name]

    def time(self, part: float) -> float:
        """A time of the current line's past, or one at which something happened in it."""
        times = [world.time for _, _, world in self.line.states]
        if part > 0.5:
            return times[int((part - 0.5) * 2.0 * (len(times) - 1))]
        return min(times[0] + 2.0 * part * (times[-1] - times[0]), times[-1])

    # What time brings.

    @precondition(lambda self: self.line.events < LONGEST)
    @rule(
        events=st.integers(0, 12),
        parts=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=3),
        step=st.booleans(),
    )
    def run(self, events: int, parts: list[float], step: bool) -> None:
        """Time goes on up to a few events from now, cut on the way."""
        for part in sorted(parts):
            self.run_once(events, part, step=step)

    def run_once(self, events: int, part: float, *, step: bool) -> None:
        world = self.line.world
        try:
            log = unfold(world, until=FOREVER, events=events + 1).log
            end = log[-1].time if len(log) == events + 1 else world.time + 1.0
            until = min(world.time + part * (end - world.time), end)
            cut = evolve_by(world, until - world.time) if step else evolve_until(world, until)
        except ModelError:  # jammed: see L14
            return
        grown = self.timeline
        self.timeline = grown.evolve(until - world.time) if step else grown.evolve_until(until)
        run = unfold(world, until=min(until, cut.time))
        for what, after in zip(run.log, run.worlds, strict=True):
            self.line.add(what, after)
        self.line.add(None, cut)

    @rule(action=actions(), index=st.integers(0, 3))
    def act(self, action: Any, index: int) -> None:
        ships = [
            f.entity.id for f in self.line.world.all_flights().values() if f.entity.kind == "ship"
        ]
        if not ships:
            return
        ship = ships[index % len(ships)]
        assert ship is not None
        try:
            after = act(self.line.world, ship, action)
        except ModelError as error:
            with pytest.raises(ModelError, match=re.escape(str(error))):
                self.timeline.act(ship, action)
            return
        self.timeline = self.timeline.act(ship, action)
        self.line.add(Act(ship, action), after)

    @precondition(lambda self: len(self.line.world) > 1)
    @rule(index=st.integers(0, 30))
    def remove(self, index: int) -> None:
        ids = sorted(self.line.world.roster.slots)
        entity = ids[index % len(ids)]
        gone = self.line.world[entity]
        after = self.line.world.remove(entity)
        self.timeline = self.timeline.remove(entity)
        self.line.add(self.timeline.last.what.what, after)  # type: ignore[union-attr]
        back = evolve(gone, id=None)
        try:
            after = after.add(back)
        except ModelError as error:  # a ship among its own bullets
            with pytest.raises(ModelError, match=re.escape(str(error))):
                self.timeline.add(back)
            return
        self.timeline = self.timeline.add(back)
        self.line.add(self.timeline.last.what.what, after)  # type: ignore[union-attr]

    # What the user does.

    @rule(part=st.floats(0.0, 1.0))
    def jump(self, part: float) -> None:
        time = self.time(part)
        assert self.timeline.at(time) == self.line.at(time)

    @precondition(lambda self: len(self.plain) < 4)
    @rule(part=st.floats(0.0, 1.0), data=st.data())
    def branch(self, part: float, data: st.DataObject) -> None:
        before, name = self.line, self.timeline.name
        if data.draw(st.booleans()):  # at a place, perhaps between two events of one moment
            happened = [
                i for i, (_, what, _) in enumerate(before.states) if what is not None or i == 0
            ]
            i = happened[int(part * (len(happened) - 1))]
            self.timeline = self.timeline.branch(before.states[i][0])
            states = before.states[: i + 1]
            lived = before.states[i][2]
            world = evolve(self.timeline.world, clock=lived.clock)
            assert world == lived
        else:
            time = self.time(part)
            world = before.at(time)
            self.timeline = self.timeline.branch(time)
            states = [state for state in before.states if state[2].now <= world.now]
            assert self.timeline.world == world
        place = self.timeline.last.place
        assert place == states[-1][0].reaching(world.now)
        plain = Plain([*states, (place, None, self.timeline.world)])
        self.plain[self.timeline.name] = plain
        assert self.timeline.name != name

    @rule(data=st.data())
    def switch(self, data: st.DataObject) -> None:
        name = data.draw(st.sampled_from(sorted(self.plain)))
        self.timeline = self.timeline.switch(name)

    @rule(part=st.floats(0.0, 1.0), name=st.sampled_from("ab"))
    def bookmark(self, part: float, name: str) -> None:
        time = self.time(part)
        self.timeline = self.timeline.bookmark(name, time)
        self.bookmarks[name] = self.timeline.name, self.line.at(time)

    @rule(
        part=st.sampled_from([0.0, 0.3, 0.7]),
        looks=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=6),
    )
    def thin(self, part: float, looks: list[float]) -> None:
        before, world = self.timeline, self.timeline.world
        budget = int(part * before.bytes)
        self.timeline = before.thin(budget)
        assert self.timeline.world is world
        assert self.timeline.bytes <= max(budget, sum(map(least, self.timeline.lines.values())))
        assert self.timeline.states <= before.states
        for look in looks:
            self.jump(look)

    @rule()
    def save_and_load(self) -> None:
        self.timeline = pickle.loads(pickle.dumps(self.timeline))

    # What always holds.

    @invariant()
    def it_ends_now(self) -> None:
        if hasattr(self, "timeline"):
            assert self.timeline.world == self.line.world
            assert self.timeline.last.place == self.line.states[-1][0]

    @invariant()
    def bookmarks_stay(self) -> None:
        if hasattr(self, "timeline"):
            found = {k: (b.line, b.state.world) for k, b in self.timeline.bookmarks.items()}
            assert found == self.bookmarks

    @rule(
        back=st.booleans(),
        part=st.floats(0.0, 1.0),
        kind=st.sampled_from(["event", "death", "contact", "input"]),
    )
    def look(self, back: bool, part: float, kind: Any) -> None:
        """Every happening before or after a place, in order; and with marks those of a kind."""
        place = self.line.states[int(part * (len(self.line.states) - 1))][0]
        if back:
            states = [s for s in reversed(self.line.states) if s[1] is not None and s[0] <= place]
            found = list(self.timeline.backwards(place))
            few = list(self.timeline.backwards(place, wanted(kind)))
        else:
            states = [s for s in self.line.states if s[1] is not None and s[0] > place]
            found = list(self.timeline.forwards(place))
            few = list(self.timeline.forwards(place, wanted(kind)))
        happened = [s for s in found if is_of(s, "event") or is_of(s, "input")]
        assert [(s.place, plain(s.what)) for s in happened] == [s[:2] for s in states]
        assert [s.world for s in happened] == [s[2] for s in states]
        assert [s for s in found if is_of(s, kind)] == [s for s in few if is_of(s, kind)]


def plain(what: Any) -> Any:
    return what.what if isinstance(what, Told) else what


def least(line: Any) -> int:
    """The bytes of a line that has nothing left to drop."""
    states = [kept for chunk in line.chunks for kept in chunk.kept]
    return line.bytes if len(states) <= 2 else 0


def test_L15_timeline() -> None:
    run_state_machine_as_test(
        Histories,
        settings=settings(max_examples=min(EXAMPLES, 2_000), stateful_step_count=25),
    )
