"""The world as a value: adding, removing, looking, comparing, copying."""

from __future__ import annotations

import copy
import pickle
import random
import sys
from collections.abc import Callable, Mapping
from math import inf, nan
from typing import Any

import attrs
import pytest
from attrs.exceptions import FrozenInstanceError

from fasteroids import (
    Asteroid,
    Bullet,
    ModelError,
    Ship,
    Thrust,
    World,
    act,
    evolve,
    evolve_until,
    happenings,
)
from fasteroids.engine import peek
from fasteroids.moments import moment_at
from fasteroids.state import Flight, located

HUGE = 10**5000


def ship(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Ship:
    return Ship(x, y, vx, vy, 10.0, 5e15, 0.0, **fields)


def rock(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Asteroid:
    return Asteroid(x, y, vx, vy, 20.0, **fields)


def shot(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Bullet:
    return Bullet(x, y, vx, vy, 3.0, fields.pop("source", 1), **fields)


def some() -> World:
    return World(1000, 800, seed=3).add_all(
        [ship(100, 100, 50, 0), rock(500, 400, -20, 30), shot(700, 100, 0, 60), ship(900, 700)]
    )


# Making one.


def test_a_new_world_is_empty_and_at_nought() -> None:
    world = World(1000, 800)
    assert (world.width, world.height, world.seed, world.model) == (1000.0, 800.0, 0, "robust")
    assert (world.time, world.now, len(world)) == (0.0, (0, 0.0), 0)
    assert dict(world.entities) == {}
    assert (world.ships, world.asteroids, world.bullets) == ((), (), ())


@pytest.mark.parametrize("size", [0, 0.0, 5e-324, 1, sys.float_info.max])
def test_any_size_up_to_the_largest_double_is_a_world(size: float) -> None:
    world = World(size, size)
    assert world.width == world.height == size
    assert evolve(world, 5.0).time == 5.0


@pytest.mark.parametrize(
    "bad", [nan, inf, -inf, -1, -5e-324, HUGE, -HUGE, None, "1000", True, [], 1j], ids=type
)
def test_a_size_out_of_range_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^width must be a number"):
        World(bad, 10)
    with pytest.raises(ModelError, match=r"^height must be a number"):
        World(10, bad)


@pytest.mark.parametrize("bad", [None, 1.0, "1", True, nan], ids=repr)
def test_a_seed_that_is_no_integer_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^seed must be an integer; got"):
        World(10, 10, seed=bad)


@pytest.mark.parametrize("seed", [0, -5, 2**200])
def test_any_integer_is_a_seed(seed: int) -> None:
    assert World(10, 10, seed=seed).seed == seed


def test_a_huge_seed_is_refused_or_works() -> None:
    try:
        world = World(1000, 1000, seed=HUGE)
    except ModelError:
        return
    big = Asteroid(500, 500, 0, 0, 40)
    after = evolve(world.add_all([big, shot(500, 400, 0, 250, source=9)]), 1.0)
    assert len(after.asteroids) == 2


# Looking.


def test_entities_by_id_in_id_order() -> None:
    world = some()
    assert list(world.entities) == [1, 2, 3, 4]
    assert [e.id for e in world.entities.values()] == [1, 2, 3, 4]
    assert [type(world[i]) for i in (1, 2, 3, 4)] == [Ship, Asteroid, Bullet, Ship]
    assert [e.id for e in world.ships] == [1, 4]
    assert [e.id for e in world.asteroids] == [2]
    assert [e.id for e in world.bullets] == [3]
    assert len(world) == len(world.entities) == 4


def test_entities_are_in_id_order_whatever_their_slots() -> None:
    world = some().remove(2).remove(1).add_all([rock(300, 300), rock(600, 600)])
    assert list(world.entities) == [3, 4, 5, 6]
    assert [e.id for e in world.asteroids] == [5, 6]
    assert list(world.all_flights()) == [3, 4, 5, 6]


def test_entities_are_moved_to_the_clock() -> None:
    world = evolve(some(), 0.5)
    assert world[1].position == (125.0, 100.0)
    assert world.entities[2].position == (490.0, 415.0)
    assert world.ships[0] == world[1]
    assert world.bullets[0].position == (700.0, 130.0)


def test_flights_are_never_stamped_by_the_clock() -> None:
    before = some()
    after = evolve(before, 0.5)
    assert all(after.flight_of(i) is before.flight_of(i) for i in before.entities)
    assert after.flights is before.flights


def test_the_mapping_is_read_only() -> None:
    assert isinstance(some().entities, Mapping)
    entities: Any = some().entities
    with pytest.raises(TypeError):
        entities[1] = rock(1, 1)
    with pytest.raises(TypeError):
        del entities[1]
    with pytest.raises(AttributeError):
        entities.clear()


def test_the_mapping_stays_with_its_world() -> None:
    world = some()
    entities = world.entities
    before = dict(entities)
    evolve(world, 3.0)
    world.remove(1)
    assert dict(entities) == before


def test_the_mapping_prints_as_a_dict() -> None:
    world = some()
    assert repr(world.entities) == repr(dict(world.entities))


def test_the_mapping_of_equal_worlds_is_equal() -> None:
    assert some().entities == some().entities
    assert some().entities != evolve(some(), 0.25).entities


@pytest.mark.parametrize("bad", [0, 99, -1, "1", None, 1.5, nan])
def test_who_is_not_there(bad: Any) -> None:
    world = some()
    assert bad not in world
    assert world.entities.get(bad) is None
    with pytest.raises(KeyError):
        world[bad]
    with pytest.raises(ModelError, match=r"^there is no entity with id"):
        world.flight_of(bad)
    with pytest.raises(ModelError, match=r"^there is no entity with id"):
        world.slot_of(bad)


@pytest.mark.parametrize("bad", [[], {}], ids=type)
def test_who_cannot_even_be_asked_for(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^there is no entity with id"):
        some().remove(bad)


def test_contains() -> None:
    assert 1 in some()
    assert 5 not in some()


def test_a_flight_says_what_decides_the_future() -> None:
    f = evolve(some(), 0.5).flight_of(1)
    assert f == Flight((0, 0.0), ship(100, 100, 50, 0, id=1))
    assert (f.bounced_off, f.next_tick) == (0, None)
    assert located(f, (0, 2.0)) == ship(200, 100, 50, 0, id=1)
    assert located(f, (0, 0.0)) is f.entity


def test_time_is_the_double_nearest_to_the_clock() -> None:
    world = evolve_until(World(10, 10), 1e15 / 7)
    assert world.time == 1e15 / 7
    assert world.now == moment_at(1e15 / 7)


# Adding.


def test_ids_count_from_one_in_order_of_adding() -> None:
    world = World(1000, 1000).add(rock(100, 100)).add(rock(300, 100)).add_all([rock(500, 100)])
    assert list(world.entities) == [1, 2, 3]


def test_adding_leaves_the_first_world_alone() -> None:
    before = some()
    copy_of_it = copy.deepcopy(before)
    before.add(rock(300, 300))
    before.remove(1)
    assert before == copy_of_it


def test_ids_are_never_reused() -> None:
    world = some().remove(4).add(rock(300, 300))
    assert list(world.entities) == [1, 2, 3, 5]
    world = world.remove(5).remove(3).add(rock(300, 300))
    assert list(world.entities) == [1, 2, 6]
    with pytest.raises(ModelError, match=r"^id 5 was used before"):
        world.add(rock(600, 600, id=5))


def test_an_id_may_be_asked_for() -> None:
    world = World(1000, 1000).add(rock(100, 100, id=7)).add(rock(300, 100))
    assert list(world.entities) == [7, 8]


def test_a_taken_id_is_refused() -> None:
    with pytest.raises(ModelError, match=r"^id 2 is taken: asteroid #2 cannot be added twice"):
        some().add(rock(300, 300, id=2))
    with pytest.raises(ModelError, match=r"^id 2 is taken: asteroid 'rocky' cannot"):
        some().add(rock(300, 300, id=2, name="rocky"))


def test_an_entity_of_the_world_cannot_be_added_again() -> None:
    world = some()
    with pytest.raises(ModelError, match="cannot be added twice"):
        world.add(world[1])


def test_one_id_twice_in_one_call_is_refused() -> None:
    with pytest.raises(ModelError, match=r"^id 7 "):
        World(1000, 1000).add_all([rock(100, 100, id=7), rock(300, 100, id=7)])


def test_adding_all_is_all_or_nothing() -> None:
    world = some()
    with pytest.raises(ModelError):
        world.add_all([rock(300, 300), rock(301, 300)])
    assert world == some()
    assert len(world.add_all([])) == 4
    assert world.add_all(iter([rock(300, 300)])).asteroids[-1].id == 5


def test_a_name_in_place_of_an_id() -> None:
    world = World(1000, 1000).add(rock(100, 100, name="rocky"))
    assert world[1].name == "rocky"


@pytest.mark.parametrize("bad", [None, 3, "ship", (1, 2), Ship, {}], ids=repr)
def test_only_entities_can_be_added(bad: Any) -> None:
    with pytest.raises(
        ModelError, match=r"^what is added must be a ship, an asteroid or a bullet; got"
    ):
        World(100, 100).add(bad)


@pytest.mark.parametrize("bad", [None, 3], ids=repr)
def test_only_a_collection_can_be_added_as_all(bad: Any) -> None:
    with pytest.raises(ModelError):
        World(100, 100).add_all(bad)


@pytest.mark.parametrize(
    ("x", "y"), [(9, 50), (50, 9), (91, 50), (50, 91), (-500, 50), (50, 1e300), (1e308, 1e308)]
)
def test_outside_is_refused(x: float, y: float) -> None:
    with pytest.raises(ModelError, match="sticks out of the world: x must lie in"):
        World(100, 100).add(ship(x, y))


@pytest.mark.parametrize(
    ("x", "y"), [(1e308, 1e308), (-1e308, 1e308), (1.7e308, 0.5e308), (-1.7e308, -1.7e308)]
)
def test_outside_is_refused_however_far(x: float, y: float) -> None:
    with pytest.raises(ModelError, match="sticks out of the world"):
        World(1e300, 1e300).add(ship(x, y))


def test_overlap_is_refused_however_far() -> None:
    huge = World(1.7e308, 1.7e308).add(Asteroid(1e308, 1e308, 0, 0, 1e307))
    with pytest.raises(ModelError, match="overlap by"):
        huge.add(Asteroid(1e308, 1e308, 0, 0, 1e307))


@pytest.mark.parametrize("size", [0, 1, 19.9, 20])
def test_a_disc_as_wide_as_the_world_is_refused(size: float) -> None:
    with pytest.raises(ModelError, match=r"too wide: 2 r = 20.0 km must be less"):
        World(size, 100).add(ship(10, 50))
    with pytest.raises(ModelError, match=r"too wide: 2 r = 20.0 km must be less"):
        World(100, size).add(ship(50, 10))


def test_overlap_is_refused_and_says_with_whom() -> None:
    world = World(100, 100).add(ship(50, 50, name="red"))
    with pytest.raises(ModelError, match=r"asteroid #2 .* and ship 'red' .* overlap by 26\.0 km"):
        world.add(rock(54, 50))


def test_a_subclass_is_refused_or_flies() -> None:
    class Cruiser(Ship):  # type: ignore[misc]
        pass

    try:
        world = World(100, 100).add(Cruiser(20, 50, 10, 0, 10, 1e15, 0))
    except ModelError:
        return
    after = evolve(world.add(ship(60, 50)), 2.5)
    assert list(after.entities) == [1, 2]  # two ships bounce, and neither dies


def test_what_is_added_starts_its_flight_now() -> None:
    world = evolve(World(1000, 1000), 2.5).add(ship(100, 100, 10, 0))
    assert world.flight_of(1).since == (0, 2.5)
    assert evolve(world, 1.0)[1].position == (110.0, 100.0)


def test_what_flew_in_one_world_may_start_in_another() -> None:
    """Just after a contact two discs overlap by rounding: no reason to refuse them in a fresh world."""
    rng = random.Random(2)
    world = World(1000, 1000)
    for i in range(25):
        x, y = 100 + 200 * (i % 5), 100 + 200 * (i // 5)
        world = world.add(rock(x, y, rng.uniform(-200, 200), rng.uniform(-200, 200)))
    contacts = 0
    for happened, after in happenings(world, 60.0):
        contacts += happened.kind == "contact"
        late = evolve_until(World(1000, 1000), after.time).add_all(after.entities.values())
        fresh = World(1000, 1000).add_all(after.entities.values())
        assert [e.position for e in fresh.asteroids] == [e.position for e in late.asteroids]
    assert contacts > 200


# Removing.


def test_remove_takes_one_away() -> None:
    world = some().remove(2)
    assert list(world.entities) == [1, 3, 4]
    assert 2 not in world
    with pytest.raises(KeyError):
        world[2]


@pytest.mark.parametrize("bad", [0, 5, -1, None, "1", nan, 1.5])
def test_removing_who_is_not_there_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^there is no entity with id .* in this world"):
        some().remove(bad)


def test_the_removed_take_no_part() -> None:
    world = World(1000, 100).add_all([rock(100, 50, 100, 0), rock(500, 50, 0, 0)]).remove(2)
    assert evolve(world, 4.0)[1].position == (500.0, 50.0)


# A value.


def test_equality_is_that_of_what_flies_and_the_clock() -> None:
    assert some() == some()
    assert hash(some()) == hash(some())
    assert some() != evolve(some(), 0.25)
    assert some() != some().remove(3)
    assert some() != "world"
    assert World(10, 10) != World(10, 11)
    assert World(10, 10) != World(11, 10)
    assert World(10, 10) != World(10, 10, seed=1)
    assert World(10, 10) != World(10, 10, model="spec")


def test_equality_and_hash_do_not_see_slots_or_the_cache() -> None:
    one = World(1000, 1000).add_all([rock(100, 100, id=3), ship(300, 300, id=4)])
    two = World(1000, 1000).add_all([ship(600, 600, id=1), rock(800, 800, id=2)])
    two = two.add_all([rock(100, 100, id=3), ship(300, 300, id=4)]).remove(1).remove(2)
    two = two.remove(4)
    one = one.remove(4)
    assert one.slot_of(3) != two.slot_of(3)
    evolve(two, 0.0)
    assert one == two
    assert hash(one) == hash(two)


def test_worlds_can_be_keys() -> None:
    assert len({some(), some(), evolve(some(), 1.0)}) == 2


def test_a_world_is_frozen() -> None:
    world: Any = some()
    with pytest.raises(FrozenInstanceError):
        world.width = 5.0
    with pytest.raises(AttributeError):
        world.colour = "red"
    with pytest.raises(TypeError):
        world[1] = rock(1, 1)


def test_a_world_prints_without_its_flights() -> None:
    assert repr(some()) == "World(width=1000.0, height=800.0, seed=3, model='robust')"


WAYS: list[Callable[[World], World]] = [
    copy.copy,
    copy.deepcopy,
    lambda world: pickle.loads(pickle.dumps(world)),
    lambda world: attrs.evolve(world),
]


def flown() -> World:
    """A world that has lived: with a cache, a residue, a free slot, a thruster on."""
    world = evolve(evolve(some().remove(3), 0.1), 0.2)
    return act(world, 4, Thrust())


@pytest.mark.parametrize("way", WAYS, ids=["copy", "deepcopy", "pickle", "attrs.evolve"])
def test_copies_are_equal_and_keep_every_flight_but_never_the_cache(
    way: Callable[[World], World],
) -> None:
    world = flown()
    assert peek(world) is not None
    again = way(world)
    assert peek(again) is None
    assert peek(world) is not None
    assert again == world
    assert hash(again) == hash(world)
    assert again.all_flights() == world.all_flights()
    assert again.clock == world.clock
    assert again.roster == world.roster


@pytest.mark.parametrize("way", WAYS, ids=["copy", "deepcopy", "pickle", "attrs.evolve"])
def test_copies_have_the_same_future(way: Callable[[World], World]) -> None:
    world = flown()
    again = way(world)
    ours, theirs = list(happenings(world, 30.0)), list(happenings(again, 30.0))
    assert len(ours) > 5
    assert ours == theirs


def test_attrs_evolve_of_the_seed_keeps_the_flights() -> None:
    world = flown()
    other = attrs.evolve(world, seed=99)
    assert other != world
    assert other.all_flights() == world.all_flights()
    with pytest.raises(ModelError, match="seed must be"):
        attrs.evolve(world, seed="x")  # type: ignore[arg-type]


def test_evolving_a_copy_leaves_the_world_alone() -> None:
    world = flown()
    before = world.all_flights()
    again = copy.copy(world)
    for _ in happenings(again, 20.0):
        pass
    assert world.all_flights() == before
    assert evolve(world, 5.0) == evolve(flown(), 5.0)
