"""L8: the speed as computed never exceeds an entity's limit, not by one unit in the last place."""

from __future__ import annotations

from math import isfinite, sqrt

from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Asteroid, Bullet, Ship, World
from fasteroids.physics import limit_contact, limit_speed
from fasteroids.state import located
from fasteroids.testing import keeping, unfold, worlds
from fasteroids.units import SPEED_OF_LIGHT
from tests.properties.laws import BURNING, EVENTS, world_law

limits = st.one_of(st.floats(0.0, SPEED_OF_LIGHT), st.just(SPEED_OF_LIGHT))
anything = st.floats()
EXTREME = st.sampled_from(["robust", "smooth"]).flatmap(
    lambda model: worlds(flavours=("extreme",), min_size=1, thrusters=True, model=model)
)
finite = st.floats(allow_nan=False, allow_infinity=False)
speeds = st.floats(-6e5, 6e5)


@world_law
@given(BURNING)
def test_L8_speed(world: World) -> None:
    check_speeds("L8_speed", world)


@world_law
@given(EXTREME)
def test_L8_speed_under_any_thrust(world: World) -> None:
    check_speeds("L8_speed_under_any_thrust", world)


def check_speeds(law: str, world: World) -> None:
    """Nothing is faster than its limit, and all numbers are numbers."""
    with keeping(law, world):
        for after in unfold(world, events=EVENTS).worlds:
            for f in after.all_flights().values():
                for e in (f.entity, located(f, after.now)):
                    assert sqrt(e.vx * e.vx + e.vy * e.vy) <= e.max_speed <= SPEED_OF_LIGHT
                    assert isfinite(e.x)
                    assert isfinite(e.y)


@given(anything, anything, limits)
def test_L8_speed_of_new_entities(vx: float, vy: float, limit: float) -> None:
    for entity in (
        Ship(0, 0, vx, vy, 1, 1, 0, max_speed=limit),
        Asteroid(0, 0, vx, vy, 1, max_speed=limit),
        Bullet(0, 0, vx, vy, 1, 1, max_speed=limit),
    ):
        assert sqrt(entity.vx * entity.vx + entity.vy * entity.vy) <= limit


@given(anything, anything, limits)
def test_L8_speed_limited(vx: float, vy: float, limit: float) -> None:
    ux, uy = limit_speed(vx, vy, limit)
    assert sqrt(ux * ux + uy * uy) <= limit
    assert (ux, uy) == limit_speed(ux, uy, limit)
    if vx == vx and vy == vy:
        assert ux == 0.0 or (ux > 0.0) == (vx > 0.0)
        assert uy == 0.0 or (uy > 0.0) == (vy > 0.0)


@given(finite, finite, speeds, speeds, limits, speeds, speeds, limits)
def test_L8_speed_after_a_clipped_contact(
    x: float, y: float, vxi: float, vyi: float, li: float, vxj: float, vyj: float, lj: float
) -> None:
    if x == 0.0 == y:
        x = 1.0
    ax, ay, bx, by, ci, cj = limit_contact(x, y, vxi, vyi, li, vxj, vyj, lj)
    if ci or cj:
        assert sqrt(ax * ax + ay * ay) <= li or (not ci and (ax, ay) == (vxi, vyi))
        assert sqrt(bx * bx + by * by) <= lj or (not cj and (bx, by) == (vxj, vyj))
    else:
        assert (ax, ay, bx, by) == (vxi, vyi, vxj, vyj)
