"""L9: an unclipped bounce keeps energy and momentum to 8 u; a long run keeps energy to 1e-11."""

from __future__ import annotations

from fractions import Fraction
from math import inf

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fasteroids import Asteroid, Ship, World, happenings
from fasteroids.physics import bounce
from fasteroids.testing import keeping, unfold, worlds
from tests.properties.laws import EVENTS, EXAMPLES, world_law

U = Fraction(1, 2**53)
speeds = st.one_of(st.floats(-3e5, 3e5), st.integers(-4, 4).map(float))
masses = st.one_of(st.floats(1e-290, 1e290), st.floats(1.0, 8.0))
places = st.one_of(st.floats(-1e150, 1e150), st.floats(-8, 8))

Bounce = tuple[float, float, float, float, float, float]


def defects(
    mi: float, mj: float, before: tuple[float, ...], after: tuple[float, ...]
) -> tuple[Fraction, ...]:
    """Changes of momentum and energy, exactly, in units of u of what was there before and after.

    Momentum is measured against the sum of m |v| and energy against the sum of m v^2, before and after together.
    """
    m, n = Fraction(mi), Fraction(mj)
    vx, vy, wx, wy, ux, uy, zx, zy = map(Fraction, (*before, *after))
    fast = m * (abs(vx) + abs(vy) + abs(ux) + abs(uy)) + n * (abs(wx) + abs(wy) + abs(zx) + abs(zy))
    hot = m * (vx**2 + vy**2 + ux**2 + uy**2) + n * (wx**2 + wy**2 + zx**2 + zy**2)
    px, py = m * (ux - vx) + n * (zx - wx), m * (uy - vy) + n * (zy - wy)
    energy = m * (ux**2 + uy**2 - vx**2 - vy**2) + n * (zx**2 + zy**2 - wx**2 - wy**2)
    return (
        (abs(px) + abs(py)) / (U * fast) if fast else Fraction(0),
        abs(energy) / (U * hot) if hot else Fraction(0),
    )


@given(places, places, speeds, speeds, masses, speeds, speeds, masses)
def test_L9_conservation_of_a_bounce(
    x: float, y: float, vxi: float, vyi: float, mi: float, vxj: float, vyj: float, mj: float
) -> None:
    after = bounce(x, y, vxi, vyi, mi, vxj, vyj, mj)
    # Below the normal doubles a velocity has no 53 bits to keep anything with.
    assume(max(map(abs, (vxi, vyi, vxj, vyj))) * min(mi / mj, mj / mi) >= 1e-290)
    assert max(defects(mi, mj, (vxi, vyi, vxj, vyj), after)) <= 8


@world_law
@given(worlds(kinds=(Ship, Asteroid)))
def test_L9_conservation(world: World) -> None:
    run = unfold(world, events=EVENTS)
    before = world
    with keeping("L9_conservation", world):
        for happened, after in zip(run.log, run.worlds, strict=True):
            if happened.kind == "contact" and happened.effect == "bounce" and not happened.clipped:
                i, j = happened.entities
                a, b = before.flight_of(i).entity, before.flight_of(j).entity
                c, d = after.flight_of(i).entity, after.flight_of(j).entity
                old, new = (*a.velocity, *b.velocity), (*c.velocity, *d.velocity)
                least = (
                    min(a.mass / b.mass, b.mass / a.mass) if min(a.mass, b.mass) > 1e-300 else 0.0
                )
                if max(map(abs, old)) * least >= 1e-290 and max(a.mass, b.mass) < inf:
                    assert max(defects(a.mass, b.mass, old, new)) <= 8
            before = after


def energy(world: World) -> float:
    return sum(a.mass * a.speed**2 for a in world.asteroids)


def test_L9_conservation_over_a_long_run() -> None:
    world = World(1000, 1000).add_all(
        Asteroid(100 + 200 * (i % 4), 100 + 300 * (i // 4), 150 - 40 * i, 35 * i - 90, 20 + 5 * i)
        for i in range(10)
    )
    events = 1_000_000 if EXAMPLES >= 20_000 else 20_000
    end = world
    for _, world_then in happenings(world, 1e9, max_events=events):
        end = world_then
    assert pytest.approx(energy(world), rel=1e-11, abs=0) == energy(end)
    assert len(end) == 10
