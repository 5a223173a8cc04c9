"""L1: cutting time changes nothing. The future of a world does not depend on how often you looked at it."""

from __future__ import annotations

from fractions import Fraction
from math import ulp

from hypothesis import assume, given, reject
from hypothesis import strategies as st

from fasteroids import ModelError, World, evolve, evolve_until, happenings
from fasteroids.testing import keeping, unfold
from tests.properties.laws import EVENTS, FLOWING, continued, same, world_law

MANY = 25 * EVENTS

ULP_OF_RESIDUE = Fraction(1, 2**96)
"""A residue is below 2^-43 s, so it is a multiple of at most 2^-96 s: what a step's own rounding of it may lose."""


@world_law
@given(FLOWING, st.data())
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
@given(FLOWING, st.data())
def test_L1_flow_without_watching(world: World, data: st.DataObject) -> None:
    whole = unfold(world, events=EVENTS)
    end = whole.times[-1] if whole.log else 1.0
    cut = data.draw(st.floats(0.0, 1.0)) * end
    with keeping("L1_flow_without_watching", world):
        try:
            few = sum(1 for _ in happenings(world, end, max_events=MANY))
            assume(few < MANY)  # late in time, one double stands for many moments
            whole_way = evolve_until(world, end)
        except ModelError:  # jammed: see L14
            reject()
        assert whole_way == evolve_until(evolve_until(world, cut), end)


@given(st.lists(st.floats(0.0, 1e4), max_size=30), st.floats(0.0, 1e6))
def test_L1_flow_of_the_clock(steps: list[float], start: float) -> None:
    """The clock carries what rounding leaves: it shows the double nearest to the exact sum of its steps."""
    world = evolve_until(World(1, 1), start)
    for step in steps:
        world = evolve(world, step)
    exact = sum(map(Fraction, steps), Fraction(start))
    window, offset, residue = world.clock
    assert (
        abs(window * 1024 + Fraction(offset) + Fraction(residue) - exact)
        <= len(steps) * ULP_OF_RESIDUE
    )
    assert abs(Fraction(world.time) - exact) <= Fraction(ulp(world.time))


def test_L1_flow_of_the_clock_through_tenths() -> None:
    world = World(1, 1)
    for n in range(1, 601):
        world = evolve(world, 0.1)
        assert float(n * Fraction(0.1)) == world.time
