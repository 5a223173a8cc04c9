"""The facade's worlds: what is in them, and what goes in and out."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, nan

import pytest

from fasteroids import ModelError, World
from fasteroids.facade import ShipHandle, WorldHandle
from fasteroids.units import MAX_WORLD_SIZE
from tests.unit.facade.handles import (
    facade,
    position,
    rock,
    rock_in,
    ship,
    ship_in,
    shot_by,
)


@pytest.fixture
def world() -> WorldHandle:
    return facade.create_world(1000, 1000)


def test_create_world_of_any_allowed_size_and_no_other() -> None:
    assert facade.create_world(0, MAX_WORLD_SIZE).world == World(0, MAX_WORLD_SIZE)
    assert facade.create_world(10, 10, seed=3).world == World(10, 10, 3)
    for size in (-1.0, nan, inf):
        with pytest.raises(ModelError, match="width must be"):
            facade.create_world(size, 100)
        with pytest.raises(ModelError, match="height must be"):
            facade.create_world(100, size)


def test_get_world_width_and_height() -> None:
    world = facade.create_world(1024, 768)
    assert (facade.get_world_width(world), facade.get_world_height(world)) == (1024, 768)


def test_a_new_world_is_empty(world: WorldHandle) -> None:
    assert facade.get_ships(world) == set()
    assert facade.get_asteroids(world) == set()
    assert facade.get_bullets(world) == set()


def test_get_ships_asteroids_and_bullets_give_the_same_handles_every_time(
    world: WorldHandle,
) -> None:
    s, r = ship_in(world, 100, 100), rock_in(world, 500, 500)
    b = shot_by(s)
    assert facade.get_ships(world) == {s}
    assert facade.get_asteroids(world) == {r}
    assert facade.get_bullets(world) == {b}
    facade.evolve(world, 0.5)
    assert facade.get_bullets(world) == {b}


def test_a_set_that_was_given_is_nobodys_but_the_callers(world: WorldHandle) -> None:
    s = ship_in(world, 100, 100)
    facade.get_ships(world).clear()
    assert facade.get_ships(world) == {s}


def test_add_ship_puts_it_in(world: WorldHandle) -> None:
    s = ship(100, 100)
    assert facade.get_ship_world(s) is None
    facade.add_ship(world, s)
    assert facade.get_ship_world(s) is world


def test_add_asteroid_puts_it_in(world: WorldHandle) -> None:
    r = rock(100, 100)
    assert facade.get_asteroid_world(r) is None
    facade.add_asteroid(world, r)
    assert facade.get_asteroid_world(r) is world


def test_touching_walls_and_neighbours_is_fine(world: WorldHandle) -> None:
    ship_in(world, 10, 10)
    ship_in(world, 30, 10)
    rock_in(world, 60, 20, r=20)
    assert len(world.world) == 3


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda: ship(5, 500), "sticks out"),
        (lambda: ship(500, 991), "sticks out"),
        (lambda: ship(515, 500), "overlap"),
        (lambda: ship(500, 500, r=500), "too wide"),
    ],
)
def test_what_does_not_fit_is_refused_and_changes_nothing(
    make: Callable[[], ShipHandle], reason: str, world: WorldHandle
) -> None:
    ship_in(world, 500, 500)
    before, late = world.world, make()
    with pytest.raises(ModelError, match=reason):
        facade.add_ship(world, late)
    assert facade.get_ship_world(late) is None
    assert world.world == before


def test_nothing_is_added_twice_or_to_a_second_world(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 100), rock_in(world, 500, 500)
    other = facade.create_world(1000, 1000)
    with pytest.raises(ModelError, match="in this world already"):
        facade.add_ship(world, s)
    with pytest.raises(ModelError, match="in another world already"):
        facade.add_asteroid(other, r)
    assert facade.get_asteroid_world(r) is world
    assert facade.get_asteroids(other) == set()


def test_remove_ship_takes_it_out_as_it_is_now(world: WorldHandle) -> None:
    s = ship_in(world, 100, 100, 10, 0)
    facade.evolve(world, 2)
    facade.remove_ship(world, s)
    facade.evolve(world, 2)
    assert facade.get_ship_world(s) is None
    assert position(s) == (120, 100)
    assert facade.get_ships(world) == set()


def test_a_removed_ship_may_come_back_or_go_elsewhere(world: WorldHandle) -> None:
    other = facade.create_world(1000, 1000)
    s = ship_in(world, 100, 100, 10, 0)
    b = shot_by(s)
    for home in (world, other, world):
        if facade.get_ship_world(s) is not None:
            facade.remove_ship(facade.get_ship_world(s), s)  # type: ignore[arg-type]
        facade.add_ship(home, s)
        assert facade.get_ships(home) == {s}
    assert facade.get_bullet_source(b) is s
    facade.evolve(world, 1)
    assert position(s) == (110, 100)


def test_who_left_is_not_touched_by_what_happens_to_those_who_stayed(world: WorldHandle) -> None:
    s, _ = ship_in(world, 100, 500, 10, 0), rock_in(world, 140, 500)
    away = ship_in(world, 800, 800, 1, 0)
    facade.remove_ship(world, away)
    facade.evolve(world, 1)
    assert facade.get_ship_world(s) is None
    assert position(away) == (800, 800)
    facade.add_ship(world, away)
    assert facade.get_ships(world) == {away}


def test_the_dead_never_come_back(world: WorldHandle) -> None:
    s, _ = ship_in(world, 100, 500, 10, 0), rock_in(world, 140, 500)
    facade.evolve(world, 1)
    assert facade.get_ship_world(s) is None
    with pytest.raises(ModelError, match="dead"):
        facade.add_ship(world, s)


def test_remove_asteroid_is_no_death(world: WorldHandle) -> None:
    r = rock_in(world, 500, 500, r=40)
    facade.remove_asteroid(world, r)
    assert facade.get_asteroids(world) == set()
    assert facade.get_asteroid_world(r) is None


def test_only_who_is_in_a_world_can_be_removed_from_it(world: WorldHandle) -> None:
    other = facade.create_world(1000, 1000)
    s, r = ship_in(world, 100, 100), rock(500, 500)
    with pytest.raises(ModelError, match="not in this world"):
        facade.remove_ship(other, s)
    with pytest.raises(ModelError, match="not in this world"):
        facade.remove_asteroid(world, r)
    assert facade.get_ships(world) == {s}


def test_handles_print_what_they_stand_for(world: WorldHandle) -> None:
    s = ship_in(world, 100, 100)
    assert repr(s) == f"ShipHandle({world.world[1]!r})"
    assert repr(world) == "WorldHandle(World(width=1000.0, height=1000.0, seed=0, model='robust'))"
