"""The dodger: gets out of the way, brakes, and never fires."""

from __future__ import annotations

from math import hypot

import pytest

from fasteroids import Asteroid, Bullet
from fasteroids.entities import Entity
from tests.unit.programs.playing import STILL, acted, arena, end, lifetime, log, pilot


@pytest.mark.parametrize(
    "threat",
    [
        Asteroid(900, 384, -100, 0, 40),
        Asteroid(200, 100, 120, 100, 50),
        Asteroid(512, 700, 0, -150, 25),
        Bullet(950, 384, -250, 0, 3, 9),
    ],
    ids=["from the right", "from below", "fast", "a bullet"],
)
def test_it_survives_what_kills_a_ship_that_stays(threat: Entity) -> None:
    still, dodging = (end(arena(pilot(name), threat), 5.0) for name in (STILL, "dodger"))
    assert not still.ships
    assert dodging.ships


def test_it_sees_what_comes_back_from_a_wall() -> None:
    """The asteroid flies away from the ship, and hits it only after its bounce."""
    behind = Asteroid(920, 384, 120, 0, 20)
    still, dodging = (end(arena(pilot(name, x=800.0), behind), 6.0) for name in (STILL, "dodger"))
    assert not still.ships
    assert dodging.ships


def test_it_escapes_when_asteroids_come_from_two_sides() -> None:
    pair = Asteroid(900, 384, -90, 0, 40), Asteroid(512, 40, 0, 80, 40)
    still, dodging = (end(arena(pilot(name), *pair), 6.0) for name in (STILL, "dodger"))
    assert not still.ships
    assert dodging.ships


def test_it_brakes_where_nothing_threatens() -> None:
    (ship,) = end(arena(pilot("dodger", x=200.0, vx=120.0)), 6.0).ships
    assert hypot(*ship.velocity) < 40.0
    assert not ship.thruster


def test_it_never_fires() -> None:
    happened = log(arena(pilot("dodger"), Asteroid(900, 384, -100, 0, 40)), 6.0)
    assert {"turn", "thrust", "thrust_off"} <= set(acted(happened))
    assert "fire" not in acted(happened)


@pytest.mark.parametrize(
    ("field", "games", "times"), [("field-storm", 40, 1.5), ("field-2013", 12, 2.5)]
)
def test_it_lives_much_longer_than_a_ship_that_stays(field: str, games: int, times: float) -> None:
    seeds = range(games)
    assert lifetime(field, seeds, "dodger") >= times * lifetime(field, seeds, STILL)
