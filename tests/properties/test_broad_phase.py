"""L3: the grid only saves work. With it or comparing all with all, the same events happen, bit for bit."""

from __future__ import annotations

from hypothesis import given

from fasteroids import World
from fasteroids.engine import Plan
from fasteroids.testing import keeping, unfold, worlds
from tests.properties.laws import BURNING, EVENTS, forced, same, world_law

WITH_GRID = Plan(grid=True, thrust=True, bullets=True, ticks=True)
ALL_PAIRS = Plan(grid=False, thrust=True, bullets=True, ticks=True)


@world_law
@given(BURNING)
def test_L3_broad_phase(world: World) -> None:
    with keeping("L3_broad_phase", world):
        same(
            unfold(forced(world, ALL_PAIRS), events=EVENTS),
            unfold(forced(world, WITH_GRID), events=EVENTS),
        )


@world_law
@given(worlds(flavours=("dense", "thin", "touching"), min_size=12, max_size=30))
def test_L3_broad_phase_for_long(world: World) -> None:
    with keeping("L3_broad_phase_for_long", world):
        same(
            unfold(forced(world, ALL_PAIRS), events=4 * EVENTS),
            unfold(forced(world, WITH_GRID), events=4 * EVENTS),
        )
