"""L1: cutting time changes nothing. The future of a world does not depend on how often you looked at it."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, reject
from hypothesis import strategies as st

from fasteroids import ModelError, World, evolve, evolve_until
from fasteroids.testing import keeping, unfold, worlds
from tests.properties.laws import EVENTS, continued, same, world_law


@world_law
@given(worlds(programs=True), st.data())
def test_L1_flow(world: World, data: st.DataObject) -> None:
    whole = unfold(world, events=EVENTS)
    end = whole.times[-1] if whole.log else 1.0
    direct = unfold(world, until=end, events=EVENTS)
    moments = st.one_of(
        st.floats(0.0, 1.0).map(lambda part: part * end),
        st.sampled_from([*whole.times, end]),  # exactly on an event
        st.integers(0, 10).map(lambda k: min(k / 5, end)),  # exactly on a tick
    )
    cuts = sorted(data.draw(st.lists(moments, max_size=6)))
    with keeping("L1_flow", world):
        same(direct, continued(world, [*cuts, end]))


@world_law
@given(worlds(programs=True, flavours=("ordinary", "touching", "corners", "twins")), st.data())
def test_L1_flow_without_watching(world: World, data: st.DataObject) -> None:
    whole = unfold(world, events=EVENTS)
    end = whole.times[-1] if whole.log else 1.0
    cut = data.draw(st.floats(0.0, 1.0)) * end
    with keeping("L1_flow_without_watching", world):
        try:
            whole_way = evolve_until(world, end)
        except ModelError:  # jammed: see L14
            reject()
        assert whole_way == evolve_until(evolve_until(world, cut), end)


@given(worlds(max_size=3, flavours=("ordinary",)), st.integers(1, 60))
def test_L1_flow_of_the_clock(world: World, steps: int) -> None:
    sliced = world
    for _ in range(steps):
        sliced = evolve(sliced, 0.1)
    assert float(steps * Fraction(0.1)) == sliced.time
