"""While games are played the collector looks at what is new, and is left as it was."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from pathlib import Path
from weakref import ref

import pytest
from textual.pilot import Pilot

from fasteroids.tui.app import Arcade
from fasteroids.tui.collector import Collector
from tests.unit.tui.arcades import arcade, run


class Knot:
    """Part of a cycle: nothing but the collector frees it."""

    def __init__(self) -> None:
        self.itself = self


@pytest.fixture
def collector() -> Iterator[Collector]:
    collector = Collector(new=1)
    collector.begin()
    yield collector
    collector.end()


def test_new_garbage_is_freed_at_the_next_look_and_old_garbage_when_all_is_looked_at(
    collector: Collector,
) -> None:
    new = ref(Knot())
    assert new() is not None
    collector.tend()
    assert new() is None
    knot = Knot()
    old = ref(knot)
    collector.tend()  # it counts as old from now on
    del knot
    collector.tend()
    assert old() is not None
    collector.renew()
    assert old() is None


def test_what_is_not_looked_at_again_does_not_grow_the_work(collector: Collector) -> None:
    kept = [[i] for i in range(100_000)]
    collector.tend()
    assert gc.get_freeze_count() > 100_000
    assert sum(gc.get_count()) < 1_000 < len(kept)


def test_few_new_objects_wait_until_there_are_more() -> None:
    collector = Collector(new=1_000)
    collector.begin()
    try:
        new = ref(Knot())
        collector.tend()
        assert new() is not None
        more = [[i] for i in range(2_000)]
        collector.tend()
        assert new() is None
        assert len(more) == 2_000
    finally:
        collector.end()


@pytest.mark.parametrize("enabled", [True, False])
def test_afterwards_the_collector_is_as_it_was(enabled: bool) -> None:
    collector = Collector()
    try:
        gc.enable() if enabled else gc.disable()
        for _ in range(2):
            collector.begin()
            collector.begin()
            assert not gc.isenabled()
            collector.end()
            collector.end()
            assert gc.isenabled() is enabled
            assert gc.get_freeze_count() == 0
        for late in (collector.tend, collector.renew):
            late()
            assert gc.get_freeze_count() == 0
    finally:
        gc.enable()


def test_the_app_has_it_as_long_as_it_runs(tmp_path: Path) -> None:
    async def seen(_app: Arcade, _pilot: Pilot[int]) -> None:
        assert not gc.isenabled()
        assert gc.get_freeze_count() > 0

    run(arcade(tmp_path), seen)
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0
