"""L2: the cache of predictions can be dropped at any moment, between events of one instant too."""

from __future__ import annotations

import copy
import pickle

from hypothesis import given
from hypothesis import strategies as st

from fasteroids import World
from fasteroids.testing import Run, keeping, unfold
from tests.properties.laws import BURNING, EVENTS, same, world_law


@world_law
@given(BURNING, st.data())
def test_L2_rebuild(world: World, data: st.DataObject) -> None:
    whole = unfold(world, events=EVENTS)
    n = len(whole.log)
    after = data.draw(st.integers(0, n))
    past = whole.worlds[after - 1] if after else world
    bare = data.draw(st.sampled_from([copy.copy, lambda w: pickle.loads(pickle.dumps(w))]))(past)
    with keeping("L2_rebuild", world):
        rest = unfold(bare, events=n - after) if n < EVENTS else unfold(bare, events=EVENTS - after)
        assert whole.log[after:] == rest.log
        assert whole.end == rest.end or n < EVENTS


@world_law
@given(BURNING)
def test_L2_rebuild_after_every_event(world: World) -> None:
    whole = unfold(world, events=EVENTS)
    log, worlds_, now = [], [], world
    with keeping("L2_rebuild_after_every_event", world):
        for _ in whole.log:
            step = unfold(copy.copy(now), events=1)
            log += step.log
            worlds_.append(step.end)
            now = step.end
        same(
            Run(whole.log, whole.worlds, whole.worlds[-1] if whole.log else world),
            Run(log, worlds_, now),
        )
