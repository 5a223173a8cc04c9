"""What a state costs beside the one before it."""

from __future__ import annotations

from sys import getsizeof

from pyrsistent import pmap, pvector

from fasteroids import Asteroid, World, evolve
from fasteroids.engine import give, take
from fasteroids.history.weights import fresh


def test_what_is_the_same_object_costs_nothing() -> None:
    world = World(100, 100).add(Asteroid(50, 50, 1, 2, 10))
    assert fresh(world, world) == 0
    assert fresh(None, 1) == 0


def test_a_number_costs_its_own_size() -> None:
    assert fresh(1.5, None) == getsizeof(1.5)
    shared = 2.5
    assert fresh((1.5, shared), (0.5, shared)) == getsizeof((1.5, shared)) + getsizeof(1.5)


def test_what_has_two_places_counts_once() -> None:
    x = float("1e3")
    assert fresh((x, x), None) == getsizeof((x, x)) + getsizeof(x)


def test_a_changed_element_of_a_vector_costs_its_own_and_a_few_nodes() -> None:
    old = pvector(map(float, range(10_000)))
    new = old.set(5_000, -1.0)
    assert fresh(new, old) < 2_000
    assert fresh(new, None) > 10_000 * getsizeof(1.0)


def test_a_changed_value_of_a_map_costs_its_own_and_a_few_nodes() -> None:
    old = pmap({k: float(k) for k in range(1_000)})
    assert fresh(old.set(500, -1.0), old) < 2_000


def test_the_cache_of_a_world_is_not_counted() -> None:
    world = evolve(
        World(1_000, 1_000).add_all(Asteroid(50 * k, 500, k, 1, 10) for k in range(1, 19)), 0.0
    )
    with_cache = fresh(world, None)
    engine = take(world)
    assert fresh(world, None) == with_cache
    give(world, engine)


def test_a_cut_costs_a_clock_and_no_flight() -> None:
    world = World(1_000, 1_000).add_all(Asteroid(50 * k, 500, 0, 0, 10) for k in range(1, 19))
    assert fresh(evolve(world, 1.0), world) < getsizeof(world) + 300
