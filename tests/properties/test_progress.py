"""L14: events at one and the same moment come to an end, or are named."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given

from fasteroids import ModelError, Ship, World
from fasteroids.events import storm_limit
from fasteroids.testing import keeping, unfold
from tests.properties.laws import BURNING, world_law


@world_law
@given(BURNING)
def test_L14_progress(world: World) -> None:
    with keeping("L14_progress", world):
        log = unfold(world, events=500).log
        assert all(a.time <= b.time for a, b in itertools.pairwise(log))
        crowds: dict[float, int] = {}
        for happened in log:
            crowds[happened.time] = crowds.get(happened.time, 0) + 1
        assert max(crowds.values(), default=0) <= storm_limit(len(world))


def test_L14_progress_names_a_scene_below_the_resolution_of_its_clock() -> None:
    late = World(1e-12, 1e-12, clock=(7, 3.0, 0.0))
    late = late.add(Ship(5e-13, 5e-13, 1e5, 0, 1e-13, 1.0, 0.0, name="mite"))
    with pytest.raises(ModelError, match=r"mite.*no room to move"):
        unfold(late, until=8000.0)
