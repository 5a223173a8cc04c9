"""The facade's asteroids with a generator, which decides where their children fly."""

from __future__ import annotations

from math import inf, nan
from random import Random
from typing import Any

import pytest

from fasteroids import ModelError, World, evolve
from fasteroids.facade import WorldHandle
from tests.unit.facade.handles import facade, ship_in


class Given(Random):
    """Gives the numbers it was given."""

    def __init__(self, *numbers: Any) -> None:
        super().__init__()
        self.numbers = list(numbers)

    def random(self) -> float:
        number: float = self.numbers.pop(0)
        return number


def split(generator: Random | None, r: float = 40) -> tuple[WorldHandle, list[Any]]:
    """A world in which an asteroid of r km was shot, and its children as (x, y, vx, vy), the first first."""
    world = facade.create_world(1000, 1000)
    facade.add_asteroid(world, facade.create_asteroid(500, 500, 0, 8, r, generator))
    facade.fire_bullet(ship_in(world, 500 - r - 13, 500))
    return world, [(e.x, e.y, e.vx, e.vy) for e in world.world.asteroids]


def test_create_asteroid_with_a_generator_which_decides_where_children_fly() -> None:
    world, children = split(Given(0.25))
    assert children == [
        pytest.approx((500, 520, 0, 12), abs=1e-13),
        pytest.approx((500, 480, 0, -12), abs=1e-13),
    ]
    assert {facade.get_asteroid_radius(c) for c in facade.get_asteroids(world)} == {20}


def test_children_have_the_generator_in_their_turn() -> None:
    generator = Given(0.5, 0.0)
    world, _ = split(generator, 60)
    (s,) = facade.get_ships(world)
    facade.fire_bullet(s)
    # The child on the left, of 30 km at (470, 500), flew at 12 km/s; its own fly along x at 18.
    assert generator.numbers == []
    assert [(e.x, e.vx) for e in world.world.asteroids if e.radius == 15] == [(485, 18), (455, -18)]


def test_the_future_of_drawn_children_is_that_of_a_world_with_them() -> None:
    world, _ = split(Random(1))
    twin = World(1000, 1000).add_all(world.world.entities.values())
    facade.evolve(world, 30)
    assert dict(world.world.entities) == dict(evolve(twin, 30).entities)


def test_equal_generators_give_equal_children_and_none_is_the_worlds_own_luck() -> None:
    assert split(Random(7))[1] == split(Random(7))[1] != split(Random(8))[1]
    assert split(None)[1] == split(None)[1]


def test_small_asteroids_draw_nothing() -> None:
    generator = Given()
    world = facade.create_world(1000, 1000)
    facade.add_asteroid(world, facade.create_asteroid(500, 500, 0, 0, 29.99, generator))
    facade.fire_bullet(ship_in(world, 458, 500))
    assert facade.get_asteroids(world) == set()


@pytest.mark.parametrize("number", [nan, inf, 1e308, "half", None])
def test_a_generator_of_nonsense_is_refused_before_anything_changes(number: Any) -> None:
    world = facade.create_world(1000, 1000)
    rock = facade.create_asteroid(500, 500, 0, 0, 40, Given(number))
    facade.add_asteroid(world, rock)
    s = ship_in(world, 447, 500)
    before = world.world
    with pytest.raises(ModelError, match="random number"):
        facade.fire_bullet(s)
    assert world.world == before
    assert facade.get_asteroid_world(rock) is world
    facade.remove_asteroid(world, rock)


def test_drawn_children_do_not_depend_on_how_time_is_cut() -> None:
    ends = []
    for steps in (1, 300):
        world = facade.create_world(1000, 1000)
        generator = Random(3)
        facade.add_asteroid(world, facade.create_asteroid(500, 500, -5, 8, 120, generator))
        s = ship_in(world, 100, 500)
        facade.fire_bullet(s)
        for _ in range(steps):
            facade.evolve(world, 30 / steps)
        ends.append((dict(world.world.entities), generator.getstate()))
        assert len(facade.get_asteroids(world)) == 2
    assert ends[0] == ends[1]


def test_children_fly_on_as_drawn_after_a_split_in_the_middle_of_a_step() -> None:
    world = facade.create_world(1000, 1000)
    facade.add_asteroid(world, facade.create_asteroid(500, 500, 0, 8, 32, Given(0.25)))
    facade.fire_bullet(ship_in(world, 100, 500, m=1e30))
    facade.evolve(world, 2)
    hit = (500 - 32 - 3 - 113) / 250
    # They start 16 km off the place of the hit, at 12 km/s, up and down.
    assert [e.vx for e in world.world.asteroids] == pytest.approx([0, 0], abs=1e-14)
    assert [e.y for e in world.world.asteroids] == pytest.approx(
        [500 + 8 * hit + sign * (16 + 12 * (2 - hit)) for sign in (1, -1)], abs=0.5
    )
