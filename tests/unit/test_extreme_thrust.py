"""The smallest scenes of thrusts, limits and lengths at the ends of the doubles: numbers come out, and they end."""

from __future__ import annotations

from math import isfinite, pi
from typing import Any

import pytest

from fasteroids import Ship, World, evolve, happenings, time_to_contact, time_to_wall
from tests.unit.making import MAX, SUBNORMAL, rock, run, told, world_of

C = 300_000.0


def feather(x: float, y: float, direction: float, **fields: Any) -> Ship:
    """A ship of 1 kg and radius 10 whose thrust over its mass is MAX, unless told otherwise."""
    given: dict[str, Any] = {"vx": 0.0, "vy": 0.0, "thrust_power": MAX, **fields}
    return Ship(x, y, radius=10.0, mass=1.0, direction=direction, thruster=True, **given)


@pytest.mark.parametrize(("model", "dt"), [("robust", 9.0), ("smooth", 2.0**-10)])
def test_a_feather_flies_the_way_it_faces(model: str, dt: float) -> None:
    """Under literal a dt used to be (inf, inf), whichever way."""
    after = evolve(world_of(feather(500, 500, 1.0), model=model), dt)[1]
    assert after.velocity == pytest.approx((C * 0.5403023058681398, C * 0.8414709848078965))


def test_a_feather_at_a_wall_falls_back_to_it() -> None:
    """It used to leave the world: sqrt(2 MAX) sqrt(0) is no number."""
    log, after = run(world_of(feather(10, 500, pi, vx=1.0), model="smooth"), 1.0)
    assert told(log)[0][1:] == ("wall", (1,), "left", "bounce")
    assert log[0].time < 1e-300
    assert after[1].x == 10.0


def test_a_feather_meets_a_rock() -> None:
    world = world_of(feather(200, 500, 0.0), rock(800, 500), model="smooth")
    log, _ = run(world, 1.0)
    assert [(h.kind, h.effect) for h in log] == [("limit", "reach"), ("contact", "die")]
    assert log[1].time == pytest.approx(570.0 / C)
    assert time_to_contact(world[1], world[2], model="smooth") == log[1].time


def test_two_feathers_that_would_overflow_together_meet() -> None:
    """Each is a double, their sum is not: the rounding error of a contact used to be no number."""
    ships = [
        feather(200, 500, 0.0, vx=C),
        feather(800, 500, pi, vx=-100.0, max_speed=200.0),
    ]
    world = world_of(*ships, model="smooth")
    contact = next(h for h, _ in happenings(world, 1.0) if h.kind == "contact")
    assert contact.time == pytest.approx(580.0 / (C + 200.0))
    assert time_to_contact(world[1], world[2], model="smooth") == contact.time


def test_a_slow_ship_with_a_weak_thrust_leans_on_its_wall() -> None:
    """v a underflows, so it used to count as pulled off: a hop of 2e-50 s each, for ever."""
    fields = {"vx": -1e-200, "max_speed": 1e-200, "thrust_power": 1e-150}
    log, after = run(world_of(feather(10, 500, pi, **fields), model="smooth"), 1.0, events=9)
    assert told(log)[0] == (0.0, "wall", (1,), "left", "bounce")
    assert after[1].vx == 0.0


def test_a_subnormal_limit_is_kept_along_the_thrust() -> None:
    """The size of a subnormal acceleration has few digits; the path must not go by it."""
    fields = {"vx": 1e-310, "max_speed": 1e-310, "thrust_power": SUBNORMAL}
    after = evolve(world_of(feather(500, 500, 1.0, **fields), model="smooth"), 1e300)[1]
    assert abs(complex(after.x - 500.0, after.y - 500.0)) == pytest.approx(1e-10, rel=1e-3)


@pytest.mark.parametrize("thrust_power", [1.0, MAX])
def test_nothing_is_near_in_the_widest_world(thrust_power: float) -> None:
    """The sum of the coordinates used to be infinite, and with it the error: all was in contact at once."""
    ships = [
        feather(8e307, 8e307, 0.0, vx=C, thrust_power=thrust_power),
        feather(1.6e308, 8e307, pi, vx=-C, thrust_power=thrust_power),
    ]
    world = World(1.7e308, 1.7e308, model="smooth").add_all(ships)
    log, after = run(world, 1e3)
    assert log == []
    assert all(isfinite(e.x) and isfinite(e.y) for e in after.ships)
    assert time_to_wall(world[2], world)[0] == pytest.approx(1.6e308 / C)
    assert time_to_wall(world[1], world)[0] == pytest.approx(9e307 / C)
