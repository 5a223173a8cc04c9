"""Corner: flies to the emptiest corner, stays there, and shoots from there."""

from __future__ import annotations

from itertools import product
from math import hypot

import pytest

from fasteroids import Asteroid, World
from tests.unit.programs.playing import acted, arena, cleared, end, killer, log, pilot

CORNERS = list(product((48, 976), (48, 720)))


def guarded(*empty: int) -> World:
    """Resting asteroids near all corners but one."""
    rocks = [Asteroid(abs(x - 30), abs(y - 30), 0, 0, 15) for x, y in CORNERS if (x, y) != empty]
    return arena(pilot("corner"), *rocks)


@pytest.mark.parametrize("corner", CORNERS)
def test_it_flies_to_the_empty_corner_and_stays(corner: tuple[int, int]) -> None:
    for time in (12.0, 20.0):
        (ship,) = end(guarded(*corner), time).ships
        assert hypot(ship.x - corner[0], ship.y - corner[1]) < 60
        assert hypot(*ship.velocity) <= 30
        assert not ship.thruster


def test_it_shoots_on_its_way_what_would_hit_it() -> None:
    attacker = Asteroid(200, 160, 90, 66, 25)
    world = arena(pilot("corner"), attacker, *guarded(48, 48).asteroids[2:])
    kill = killer(log(world, 8.0), 2)
    assert 1 not in kill.died


def test_it_clears_the_others_from_its_corner() -> None:
    world = end(guarded(48, 48), 40.0)
    assert world.ships
    assert not world.asteroids


def test_it_waits_where_there_is_nothing() -> None:
    """It is alone: it flies to a corner all the same, and then does nothing."""
    happened = log(arena(pilot("corner")), 20.0)
    assert "fire" not in acted(happened)
    assert set(acted(happened)[-20:]) == {"skip"}


def test_it_clears_slow_fields_and_more_storms_than_the_turret() -> None:
    assert cleared("field-2013", range(10), "corner") >= 8
    seeds = range(40)
    assert cleared("field-storm", seeds, "corner") > cleared("field-storm", seeds, "turret")
