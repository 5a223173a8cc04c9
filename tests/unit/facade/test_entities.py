"""The facade's ships, asteroids and bullets: making, reading, steering."""

from __future__ import annotations

from math import inf, nan, pi

import pytest

from fasteroids import ModelError
from fasteroids.facade import ShipHandle, WorldHandle
from fasteroids.units import SPEED_OF_LIGHT
from tests.unit.facade.handles import (
    facade,
    position,
    rock,
    rock_in,
    ship,
    ship_in,
    shot_by,
    velocity,
)


@pytest.fixture
def world() -> WorldHandle:
    return facade.create_world(1000, 1000)


# Making and reading entities.


def test_create_ship_takes_direction_before_mass() -> None:
    s = facade.create_ship(1, 2, 3, 4, 5, 6, 7)
    assert position(s) == (1, 2)
    assert velocity(s) == (3, 4)
    assert facade.get_ship_radius(s) == 5
    assert facade.get_ship_direction(s) == 6
    assert facade.get_ship_mass(s) == 7
    assert facade.get_ship_world(s) is None
    assert not facade.is_ship_thruster_active(s)


def test_create_asteroid_has_the_mass_of_its_sphere() -> None:
    r = facade.create_asteroid(1, 2, 3, 4, 5)
    assert (facade.get_asteroid_x(r), facade.get_asteroid_y(r)) == (1, 2)
    assert (facade.get_asteroid_x_velocity(r), facade.get_asteroid_y_velocity(r)) == (3, 4)
    assert facade.get_asteroid_radius(r) == 5
    assert facade.get_asteroid_mass(r) == pytest.approx(4 / 3 * pi * 125 * 2.65e12, rel=1e-15)
    assert facade.get_asteroid_world(r) is None


@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_position_and_radius_are_defensive_and_velocity_is_total(bad: float) -> None:
    for x, y, r in [(bad, 0, 1), (0, bad, 1), (0, 0, bad), (0, 0, 0), (0, 0, -1)]:
        with pytest.raises(ModelError):
            ship(x, y, r=r)
        with pytest.raises(ModelError):
            rock(x, y, r=r)
    assert velocity(ship(0, 0, nan, 3)) == (0, 3)
    vx, vy = velocity(ship(0, 0, 6e5, 8e5))
    assert (vx, vy) == (pytest.approx(180_000), pytest.approx(240_000))
    assert vx * vx + vy * vy <= SPEED_OF_LIGHT**2


def test_direction_and_mass_are_refused_where_they_are_none() -> None:
    for way, m in [(nan, 1), (inf, 1), (0, 0), (0, -1), (0, nan)]:
        with pytest.raises(ModelError):
            ship(0, 0, way=way, m=m)


def test_is_ship_is_asteroid_is_bullets_tell_any_things_apart(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 100), rock(500, 500)
    things = [s, r, shot_by(s), world, None, "ship", nan, s.entity, ShipHandle]
    assert [facade.is_ship(t) for t in things] == [True] + 8 * [False]
    assert [facade.is_asteroid(t) for t in things] == [False, True] + 7 * [False]
    assert [facade.is_bullets(t) for t in things] == [False, False, True] + 6 * [False]


def test_bullet_getters_read_a_bullet_right_next_to_its_ship(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500, 77, -5, r=16)
    b = shot_by(s)
    assert (facade.get_bullet_x(b), facade.get_bullet_y(b)) == (119, 500)
    assert (facade.get_bullet_x_velocity(b), facade.get_bullet_y_velocity(b)) == (250, 0)
    assert facade.get_bullet_radius(b) == 3
    assert facade.get_bullet_mass(b) == pytest.approx(4 / 3 * pi * 27 * 7.8e12, rel=1e-15)
    assert facade.get_bullet_world(b) is world
    assert facade.get_bullet_source(b) is s


def test_get_bullet_source_tells_whose_it_is(world: WorldHandle) -> None:
    ships = [ship_in(world, 100, y) for y in (300, 500, 700)]
    bullets = [shot_by(s) for s in reversed(ships)]
    assert [facade.get_bullet_source(b) for b in reversed(bullets)] == ships


# What ships do.


@pytest.mark.parametrize("inside", [True, False])
def test_set_thruster_active_switches_it(inside: bool, world: WorldHandle) -> None:
    s = ship_in(world, 100, 100) if inside else ship(100, 100)
    for on in (True, True, False, False, True):
        facade.set_thruster_active(s, on)
        assert facade.is_ship_thruster_active(s) is on


@pytest.mark.parametrize("inside", [True, False])
def test_turn_adds_to_the_direction(inside: bool, world: WorldHandle) -> None:
    s = ship_in(world, 100, 100, way=1.0) if inside else ship(100, 100, way=1.0)
    facade.turn(s, 0.5)
    assert facade.get_ship_direction(s) == 1.5
    facade.turn(s, -2.0)
    assert facade.get_ship_direction(s) == pytest.approx(2 * pi - 0.5)
    for angle in (nan, inf):
        with pytest.raises(ModelError, match="finite"):
            facade.turn(s, angle)


def test_fire_bullet_three_times_and_not_four(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500)
    for n in (1, 2, 3, 3):
        facade.fire_bullet(s)
        assert len(facade.get_bullets(world)) == n
        facade.evolve(world, 0.125)


def test_fire_bullet_has_no_effect_outside_a_world_or_over_its_border(world: WorldHandle) -> None:
    facade.fire_bullet(ship(100, 100))
    facade.fire_bullet(ship_in(world, 985, 500))
    assert facade.get_bullets(world) == set()


def test_a_bullet_fired_onto_an_asteroid_dies_with_it_though_it_recedes(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 500), rock_in(world, 132, 500, 300, 0)
    facade.fire_bullet(s)
    assert facade.get_bullets(world) == set()
    assert facade.get_asteroid_world(r) is None
    assert (facade.get_asteroid_x(r), facade.get_asteroid_x_velocity(r)) == (132, 300)


def test_the_source_of_a_bullet_stays_known_when_both_are_dead(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500)
    b = shot_by(s)
    rock_in(world, 80, 500, 50, 0, r=10)
    facade.evolve(world, 0)
    assert facade.get_ship_world(s) is None
    assert facade.get_bullet_source(b) is s
    facade.evolve(world, 60)
    assert facade.get_bullet_world(b) is None
    assert facade.get_bullet_source(b) is s
