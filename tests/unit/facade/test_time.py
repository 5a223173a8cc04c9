"""The facade's evolve, with values known from the course and from tests of its students."""

from __future__ import annotations

from math import inf, nan, pi

import pytest

from fasteroids import ModelError
from fasteroids.facade import WorldHandle
from tests.unit.facade.handles import (
    Listener,
    facade,
    position,
    rock_in,
    ship_in,
    shot_by,
    velocity,
)


@pytest.fixture
def world() -> WorldHandle:
    return facade.create_world(1000, 1000)


def test_evolve_into_a_corner_and_back(world: WorldHandle) -> None:
    s, listener = ship_in(world, 100, 100, -10, -10, r=50), Listener()
    facade.evolve(world, 15, listener)
    assert position(s) == (150, 150)
    assert velocity(s) == (10, 10)
    assert listener.told == [(s, 0, 50), (s, 50, 0)]
    assert listener.seen == [[(50, 50, -10, -10)], [(50, 50, 10, -10)]]


def test_evolve_moves_before_it_thrusts(world: WorldHandle) -> None:
    s = ship_in(world, 100, 50, 0, 5, way=pi / 2)
    facade.set_thruster_active(s, True)
    facade.evolve(world, 0.1)
    assert position(s) == (100, 50.5)
    assert velocity(s) == (pytest.approx(0, abs=1e-14), pytest.approx(27, rel=1e-15))


def test_the_thruster_gives_1_km_per_s2_to_1_1e18_kg(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500, 10, 0, way=pi, m=1.1e18)
    facade.set_thruster_active(s, True)
    facade.evolve(world, 1)
    assert velocity(s) == (9, pytest.approx(0, abs=1e-15))


def test_thrust_depends_on_how_time_is_cut_as_the_text_has_it(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500, m=1.1e18)
    facade.set_thruster_active(s, True)
    facade.evolve(world, 1)
    assert position(s) == (100, 500)
    facade.evolve(world, 1)
    assert position(s) == (101, 500)
    assert velocity(s) == (2, 0)


def test_a_wall_negates_one_component(world: WorldHandle) -> None:
    s, listener = ship_in(world, 500, 966, 5, 8), Listener()
    facade.evolve(world, 4, listener)
    assert velocity(s) == (5, -8)
    assert position(s) == (520, 982)
    assert listener.told == [(s, 515, 1000)]


def test_ships_bounce_by_their_masses_and_the_listener_sees_them_before(world: WorldHandle) -> None:
    a, b = ship_in(world, 100, 100, 10, 0, m=1.0), ship_in(world, 300, 100, -20, 0, m=3.0)
    listener = Listener()
    facade.evolve(world, 6, listener)
    assert listener.told == [(a, b, 170, 100)]
    assert listener.seen == [[(160, 100, 10, 0), (180, 100, -20, 0)]]
    assert (velocity(a), velocity(b)) == ((-35, 0), (-5, 0))


def test_the_point_of_contact_is_on_the_rim_not_in_a_centre(world: WorldHandle) -> None:
    a, b = ship_in(world, 50, 100, 10, 0, r=20), ship_in(world, 110, 100, r=30)
    listener = Listener()
    facade.evolve(world, 1, listener)
    assert listener.told == [(a, b, 80, 100)]


def test_a_contact_at_the_very_end_of_a_step_belongs_to_it(world: WorldHandle) -> None:
    a, b = ship_in(world, 100, 100, 10, 0), ship_in(world, 140, 100)
    facade.evolve(world, 2)
    assert (velocity(a), velocity(b)) == ((0, 0), (10, 0))
    assert position(a) == (120, 100)


def test_three_in_a_row_pass_the_blow_on(world: WorldHandle) -> None:
    row = [ship_in(world, x, 500, v, 0) for x, v in [(100, 40), (140, 0), (160, 0)]]
    facade.evolve(world, 2)
    assert [velocity(s) for s in row] == [(0, 0), (0, 0), (40, 0)]


def test_a_ship_dies_on_an_asteroid_which_flies_on(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 500, 10, 0), rock_in(world, 140, 500, -10, 0)
    listener = Listener()
    facade.evolve(world, 1, listener)
    assert listener.told == [(s, r, 115, 500)]
    assert facade.get_ships(world) == set()
    assert facade.get_ship_world(s) is None
    assert position(s) == (105, 500)
    assert facade.get_asteroid_x(r) == 130
    assert facade.get_asteroid_x_velocity(r) == -10


def test_a_bullet_kills_an_asteroid_which_leaves_two_children(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 500), rock_in(world, 500, 500, 0, 8, r=32)
    b, listener = shot_by(s), Listener()
    facade.evolve(world, 10, listener)
    assert listener.told[0][:2] == (r, b)
    assert facade.get_asteroid_world(r) is None
    assert facade.get_bullet_world(b) is None
    children = facade.get_asteroids(world)
    assert len(children) == 2
    assert {facade.get_asteroid_radius(c) for c in children} == {16}
    assert facade.get_asteroids(world) == children


def test_asteroids_below_30_km_leave_nothing(world: WorldHandle) -> None:
    s, _ = ship_in(world, 100, 500), rock_in(world, 500, 500, r=29.99)
    facade.fire_bullet(s)
    facade.evolve(world, 10)
    assert facade.get_asteroids(world) == set()


def test_a_bullet_dies_at_its_second_wall(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500, way=pi / 2)
    b, listener = shot_by(s), Listener()
    facade.evolve(world, 10, listener)
    assert [x[0] for x in listener.told] == [b, b]
    assert listener.seen[1][0][1] == 3
    assert facade.get_bullet_world(b) is None
    assert facade.get_bullets(world) == set()


def test_a_bullet_in_an_exact_corner_meets_two_walls(world: WorldHandle) -> None:
    s, listener = ship_in(world, 500, 500, way=pi / 4), Listener()
    b = shot_by(s)
    facade.evolve(world, 10, listener)
    assert [x[0] for x in listener.told] == [b, b]


def test_a_bullet_flies_through_its_own_ship_on_the_way_back(world: WorldHandle) -> None:
    s, listener = ship_in(world, 100, 500), Listener()
    b = shot_by(s)
    facade.evolve(world, 6.5, listener)
    assert facade.get_ship_world(s) is world
    assert facade.get_bullet_x(b) < 500
    assert [x[0] for x in listener.told] == [b]


def test_two_bullets_of_one_ship_kill_each_other(world: WorldHandle) -> None:
    s, listener = ship_in(world, 100, 500), Listener()
    first = shot_by(s)
    facade.evolve(world, 3)
    second = shot_by(s)
    facade.evolve(world, 3, listener)
    assert listener.told[-1][:2] == (first, second)
    assert facade.get_bullets(world) == set()


def test_ten_steps_of_a_tenth_are_a_second_to_the_last_bit(world: WorldHandle) -> None:
    s = ship_in(world, 100, 500, 7, 0)
    for _ in range(10):
        facade.evolve(world, 0.1)
    assert world.world.time == 1.0
    assert position(s) == (107, 500)


@pytest.mark.parametrize("dt", [nan, inf, -inf, -0.1])
def test_a_bad_step_is_refused_and_changes_nothing(dt: float, world: WorldHandle) -> None:
    ship_in(world, 100, 100, 10, 0)
    before = world.world
    with pytest.raises(ModelError, match="a step must be"):
        facade.evolve(world, dt)
    assert world.world == before


def test_no_time_runs_what_is_due_now(world: WorldHandle) -> None:
    a, b = ship_in(world, 100, 100, 10, 0), ship_in(world, 120, 100)
    facade.evolve(world, 0)
    assert (velocity(a), velocity(b)) == ((0, 0), (10, 0))
