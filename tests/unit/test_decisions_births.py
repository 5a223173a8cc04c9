"""DESIGN section 5, tests named after its rows: how entities come, go, and draw their luck."""

from __future__ import annotations

from math import inf, nextafter, pi, sqrt, ulp
from typing import Any

import pytest

from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    Happened,
    ModelError,
    World,
    act,
    chance,
    evolve,
    happenings,
)
from fasteroids.state import Flight
from fasteroids.units import SPEED_OF_LIGHT
from tests.unit.making import Script, rock, run, ship, shot, told, world_of

# births


def test_births_a_bullet_starts_next_to_its_ship_at_250_whatever_the_ship_does() -> None:
    world = act(world_of(ship(100, 500, 77, -5, radius=16.0)), 1, Fire())
    (bullet,) = world.bullets
    assert bullet == Bullet(119.0, 500.0, 250.0, 0.0, 3.0, 1, id=2)
    assert bullet.max_speed == SPEED_OF_LIGHT
    assert world[1] == ship(100, 500, 77, -5, radius=16.0, id=1)


def test_births_the_way_it_faces() -> None:
    (bullet,) = act(world_of(ship(500, 500, direction=pi / 2)), 1, Fire()).bullets
    assert bullet.y == 513.0
    assert bullet.vy == 250.0
    assert abs(bullet.x - 500.0) <= ulp(500.0)


def test_births_partly_outside_no_effect_and_no_id() -> None:
    world = world_of(ship(nextafter(984, inf) + 1e-9, 500))
    assert act(world, 1, Fire()) == world
    assert act(world, 1, Fire()).add(rock(100, 100)).asteroids[0].id == 2


def test_births_touching_the_wall_is_inside() -> None:
    assert len(act(world_of(ship(984, 500)), 1, Fire()).bullets) == 1


def test_births_at_most_three_bullets() -> None:
    world = world_of(ship(100, 500))
    for n in (1, 2, 3):
        world = act(world, 1, Fire())
        assert len(world.bullets) == n
        world = evolve(world, 0.125)
    assert act(world, 1, Fire()) == world
    assert act(world, 1, Fire()).add(rock(100, 100)).asteroids[0].id == 5
    world = world.remove(3)
    assert len(act(world, 1, Fire()).bullets) == 3


def test_births_bullets_of_others_do_not_count() -> None:
    world = world_of(ship(100, 500), *(shot(100 + 50 * i, 800, source=9) for i in range(5)))
    assert len(act(world, 1, Fire()).bullets) == 6


@pytest.mark.parametrize("v", [0.0, 300.0, -300.0])
def test_births_on_another_both_die_approaching_or_not(v: float) -> None:
    world = act(world_of(ship(100, 500), rock(130, 500, v, 0)), 1, Fire())
    assert list(world.entities) == [1]
    assert world.add(rock(500, 500)).asteroids[0].id == 4  # the bullet had 3


def test_births_on_another_is_one_event() -> None:
    world = world_of(ship(100, 500, program=Script((Fire(),))), rock(130, 500, 0, 0, 19))
    log, after = run(world, 0.2)
    assert told(log) == [(0.2, "tick", (1,), None, "fire")]
    assert (log[0].died, log[0].born) == ((2, 3), (3,))
    assert list(after.entities) == [1]


def test_births_on_a_large_asteroid_split_it() -> None:
    world = world_of(ship(100, 500, program=Script((Fire(),))), rock(150, 500, 0, 0, 38))
    log, after = run(world, 0.2)
    assert (log[0].died, log[0].born) == ((2, 3), (3, 4, 5))
    assert list(after.entities) == [1, 4, 5]


def test_births_on_two_kills_the_lower_id() -> None:
    world = world_of(ship(100, 500), rock(121, 519, 0, 0, 18), rock(121, 481, 0, 0, 18))
    assert list(act(world, 1, Fire()).entities) == [1, 3]
    world = world_of(ship(100, 500), rock(121, 481, 0, 0, 18), rock(121, 519, 0, 0, 18))
    assert list(act(world, 1, Fire()).entities) == [1, 3]


def test_births_an_own_earlier_bullet_counts() -> None:
    world = act(world_of(ship(100, 500)), 1, Fire())
    assert list(world.entities) == [1, 2]
    after = act(world, 1, Fire())
    assert list(after.entities) == [1]
    assert after.add(rock(500, 500)).asteroids[0].id == 4


def test_births_a_bullet_never_hits_its_own_ship() -> None:
    """The ship overtakes its bullet, and meets it again on its way back from the wall."""
    world = act(world_of(ship(500, 500, 400, 0, max_speed=400.0)), 1, Fire())
    log, after = run(world, 2.3)
    assert [h.kind for h in log] == ["wall"] * len(log)
    assert {h.entities for h in log} == {(1,), (2,)}
    assert list(after.entities) == [1, 2]


def test_births_touching_exactly_is_no_hit_yet() -> None:
    world = world_of(ship(100, 500), rock(136, 500))
    fired = act(world, 1, Fire())
    assert list(fired.entities) == [1, 2, 3]
    assert list(evolve(fired, 0.0).entities) == [1]


# children


def split(
    r: float, vx: float, vy: float, seed: int = 0, **fields: Any
) -> tuple[World, Happened, World]:
    """An asteroid at rest against a bullet that is upon it, before, what happened, and after."""
    parent = rock(500, 500, vx, vy, r, **fields)
    world = world_of(parent, shot(500 - r - 3, 500, vx + 250, vy), seed=seed)
    (happened, after), *_ = happenings(world, 0.0)
    return world, happened, after


@pytest.mark.parametrize("seed", range(8))
def test_children_lie_on_one_line_through_the_parent_and_fly_apart_along_it(seed: int) -> None:
    _, happened, after = split(40.0, 30.0, -40.0, seed)
    assert (happened.effect, happened.died, happened.born) == ("split", (1, 2), (3, 4))
    a, b = after.asteroids
    assert (a.id, b.id) == (3, 4)
    assert a.radius == b.radius == 20.0
    assert (a.vx, a.vy) == (-b.vx, -b.vy)
    assert abs(a.x + b.x - 1000.0) <= 2 * ulp(1000.0)
    assert abs(a.y + b.y - 1000.0) <= 2 * ulp(1000.0)
    for child in (a, b):
        dx, dy = child.x - 500.0, child.y - 500.0
        assert abs(sqrt(dx * dx + dy * dy) - 20.0) <= 2 * ulp(500.0)
        assert abs(child.speed - 75.0) <= 4 * ulp(75.0)
        # along the axis, outwards: the cross product is rounding of the places, times the speed
        assert abs(dx * child.vy - dy * child.vx) <= 4 * 75.0 * ulp(500.0)
        assert dx * child.vx + dy * child.vy > 0.0


def test_children_go_a_random_way() -> None:
    ways = {split(40.0, 30.0, -40.0, seed)[2].asteroids[0].velocity for seed in range(20)}
    assert len(ways) == 20
    assert {(vx > 0, vy > 0) for vx, vy in ways} == {
        (a, b) for a in (True, False) for b in (True, False)
    }


@pytest.mark.parametrize(
    ("r", "count"), [(30.0, 2), (nextafter(30.0, 0.0), 0), (29.0, 0), (60.0, 2)]
)
def test_children_come_from_30_km_on(r: float, count: int) -> None:
    _, happened, after = split(r, 0.0, 0.0)
    assert len(after) == count
    assert happened.effect == ("split" if count else "die")


def test_children_of_a_resting_parent_rest() -> None:
    _, _, after = split(40.0, 0.0, 0.0)
    assert [child.velocity for child in after.asteroids] == [(0.0, 0.0)] * 2
    assert run(after, 10.0)[0] == []


def test_children_inherit_the_limit_and_obey_it() -> None:
    _, happened, after = split(40.0, 30.0, -40.0, max_speed=60.0)
    assert happened.clipped == (3, 4)
    a, b = after.asteroids
    assert a.max_speed == b.max_speed == 60.0
    assert (a.vx, a.vy) == (-b.vx, -b.vy)
    assert 60.0 - 8 * ulp(60.0) <= a.speed <= 60.0


def test_children_none_of_an_asteroid_outside_a_world() -> None:
    world = world_of(rock(500, 500, 0, 0, 40)).remove(1)
    assert len(world) == 0
    assert world.add(rock(100, 100)).asteroids[0].id == 2


def test_children_none_where_the_ship_dies() -> None:
    log, after = run(world_of(ship(440, 500, 10, 0), rock(500, 500, 0, 0, 40)), 1.0)
    assert [(h.effect, h.died, h.born) for h in log] == [("die", (1,), ())]
    assert list(after.entities) == [2]


# source died


def test_source_died_its_bullets_fly_on_and_keep_its_id() -> None:
    world = act(world_of(ship(100, 500), rock(100, 530, 0, -1, 19)), 1, Fire())
    after = evolve(world, 1.0)
    assert 1 not in after
    (bullet,) = after.bullets
    assert bullet.source == 1
    assert bullet.position == (363.0, 500.0)


# adding


def test_adding_touching_is_fine() -> None:
    world = world_of(rock(20, 20), rock(60, 20), ship(90, 20), rock(980, 980))
    assert len(world) == 4


def test_adding_rounding_overlap_is_fine() -> None:
    assert len(world_of(ship(100.1, 500), ship(nextafter(120.1, 0.0), 500))) == 2
    assert len(world_of(ship(nextafter(10.0, 0.0), 500))) == 1


@pytest.mark.parametrize(
    ("entity", "reason"),
    [
        (rock(139, 500), "overlap by"),
        (rock(15, 500), "sticks out"),
        (rock(900, 990), "sticks out"),
        (rock(500, 500, 0, 0, 500), "too wide"),
        (rock(500, 500, 0, 0, 700), "too wide"),
        (rock(500, 700, id=1), "taken"),
    ],
)
def test_adding_is_refused_with_the_reason(entity: Asteroid, reason: str) -> None:
    with pytest.raises(ModelError, match=reason):
        world_of(rock(100, 500)).add(entity)


def test_adding_a_bullet_onto_its_source_is_fine() -> None:
    world = world_of(ship(500, 500), shot(505, 500, source=1))
    assert len(world) == 2
    assert run(world, 1.0)[0] == []


# randomness


def test_randomness_is_keyed_by_seed_id_and_purpose() -> None:
    _, _, after = split(40.0, 30.0, -40.0, seed=5)
    angle = chance.angle(5, 1, "split")
    a, _ = after.asteroids
    assert (a.vx > 0.0) == (-pi / 2 < (angle if angle < pi else angle - 2 * pi) < pi / 2)
    assert (a.vy > 0.0) == (angle < pi)


def test_randomness_adding_an_entity_does_not_change_anothers_luck() -> None:
    world, _, after = split(40.0, 30.0, -40.0, seed=5)
    (_, with_more), *_ = happenings(world.add(rock(900, 900, 5, 5, 50)), 0.0)
    luck = [child.velocity for child in after.asteroids]
    assert [child.velocity for child in with_more.asteroids if child.radius == 20.0] == luck


def test_randomness_another_seed_or_id_is_another_luck() -> None:
    one = split(40.0, 30.0, -40.0, seed=5)[2].asteroids[0].velocity
    assert split(40.0, 30.0, -40.0, seed=6)[2].asteroids[0].velocity != one
    (_, other), *_ = happenings(
        world_of(rock(500, 500, 30, -40, 40, id=2), shot(457, 500, 280, -40), seed=5), 0.0
    )
    assert other.asteroids[0].velocity != one


def test_randomness_asks_nobody_twice() -> None:
    assert split(40.0, 30.0, -40.0, seed=5)[2] == split(40.0, 30.0, -40.0, seed=5)[2]
    assert isinstance(split(40.0, 0.0, 0.0)[2].flight_of(3), Flight)
