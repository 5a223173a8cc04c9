"""The line of a timeline as a recording, and back: the same worlds at any time, whatever was done in it."""

from __future__ import annotations

from typing import Any

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import initialize, precondition, rule, run_state_machine_as_test

from fasteroids import Ship, World
from fasteroids.history.marks import is_of
from fasteroids.history.recording import read, verified
from fasteroids.history.recording.loading import recorded, timeline_of
from fasteroids.testing import worlds
from tests.properties.laws import BURNING, EXAMPLES
from tests.properties.test_recordings import without_scripts
from tests.properties.test_timeline import Histories


class Recorded(Histories):
    """Histories that are recorded now and then, and loaded."""

    @initialize(
        world=BURNING | worlds(min_size=1, max_size=5, kinds=(Ship,), thrusters=True),
        runs=st.lists(st.tuples(st.integers(0, 12), st.floats(0.0, 1.0)), max_size=5),
    )
    def start(self, world: World, runs: list[tuple[int, float]]) -> None:
        super().start(without_scripts(world), runs)

    def jump(self, part: float) -> None:
        """Not here: L15 tests it."""

    @precondition(lambda self: hasattr(self, "timeline"))
    @rule(parts=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=5), thin=st.booleans())
    def record_and_load(self, parts: list[float], thin: bool) -> None:
        text = recorded(self.timeline, title="x")
        recording = read(text.encode())
        told = verified(recording)
        assert told.difference is None, str(told.difference)
        loaded = timeline_of(recording, **({"budget": 0} if thin else {}))
        assert loaded.world == self.timeline.world
        assert loaded.last.place == self.timeline.last.place
        for part in parts:
            time = self.time(part)
            assert loaded.at(time) == self.line.at(time)
        assert happenings(loaded) == happenings(self.timeline)
        for name, mark in loaded.bookmarks.items():
            assert mark.state.place == self.timeline.bookmarks[name].state.place
            assert mark.state.world == self.timeline.bookmarks[name].state.world
        marks = self.timeline.bookmarks.values()
        assert {m.name for m in marks if m.line == self.timeline.name} <= {*loaded.bookmarks}
        assert recorded(loaded, title="x") == text


def happenings(timeline: Any) -> list[Any]:
    """What happened and was done in the past of a line, and what came of it."""
    states = timeline.forwards(timeline.first.place)
    found = [s for s in states if is_of(s, "event") or is_of(s, "input")]
    return [(s.place, s.what, s.world.all_flights()) for s in found]


def test_a_past_that_was_recorded_is_loaded_as_it_was() -> None:
    run_state_machine_as_test(
        Recorded,
        settings=settings(max_examples=min(EXAMPLES // 2, 1_000), stateful_step_count=12),
    )
