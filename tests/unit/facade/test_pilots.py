"""The facade's ships that run programs: when, what, and what a listener hears of it."""

from __future__ import annotations

from math import pi
from typing import Any

import pytest

from fasteroids import ModelError, happenings
from fasteroids.facade import WorldHandle
from tests.unit.facade.handles import (
    FIRST,
    ILL_TYPED,
    Listener,
    facade,
    program,
    rock_in,
    ship,
    ship_in,
    shot_by,
)


@pytest.fixture
def world() -> WorldHandle:
    return facade.create_world(1000, 1000)


@pytest.mark.parametrize("first", [True, False])
def test_set_ship_program_before_or_after_the_ship_is_in_its_world(
    first: bool, world: WorldHandle
) -> None:
    s = ship(500, 500)
    if first:
        facade.set_ship_program(s, program(FIRST))
    facade.add_ship(world, s)
    if not first:
        facade.set_ship_program(s, program(FIRST))
    turns = []
    for _ in range(10):
        facade.evolve(world, 0.1)
        turns.append(facade.get_ship_direction(s))
    # Five runs: turn 0.2, fire, turn 0.3, fire, turn 0.4.
    assert turns == pytest.approx([0, *2 * [0.2, 0.2], *2 * [0.5, 0.5], 0.9])
    assert len(facade.get_bullets(world)) == 2


def test_it_makes_no_difference_when_a_ship_got_its_program() -> None:
    ends = []
    for first in (True, False):
        world, s = facade.create_world(1000, 1000), ship(500, 500, 3, 4)
        facade.evolve(world, 0.3)
        if first:
            facade.set_ship_program(s, program(FIRST))
        facade.add_ship(world, s)
        facade.set_ship_program(s, program(FIRST))
        facade.evolve(world, 3)
        ends.append(world.world)
    assert ends[0] == ends[1]


def test_twenty_steps_of_three_hundredths_are_three_ticks(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500)
    facade.set_ship_program(s, program("while true { turn 0.25; }"))
    for _ in range(20):
        facade.evolve(world, 0.03)
    assert facade.get_ship_direction(s) == 0.75


def test_a_program_given_later_runs_at_the_next_tick(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500, 10, 0)
    facade.evolve(world, 0.3)
    facade.set_ship_program(s, program("turn 1; turn 1;"))
    facade.evolve(world, 0.09)
    assert facade.get_ship_direction(s) == 0
    facade.evolve(world, 0.02)
    assert facade.get_ship_direction(s) == 1
    assert facade.get_ship_x(s) == pytest.approx(504.1)


def test_another_program_takes_the_place_of_the_first(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500)
    facade.set_ship_program(s, program("turn 1; turn 1;"))
    facade.evolve(world, 0.2)
    facade.set_ship_program(s, program("turn 0.25;"))
    facade.evolve(world, 10)
    assert facade.get_ship_direction(s) == 1.25
    assert not list(happenings(world.world, 20))


def test_a_program_without_anything_to_do_has_no_ticks(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500)
    facade.set_ship_program(s, program("turn 1;"))
    facade.set_ship_program(s, program(""))
    assert not list(happenings(world.world, 10))


def test_an_ill_typed_program_is_refused_and_the_ship_keeps_its_own(world: WorldHandle) -> None:
    for s in (ship_in(world, 500, 500), ship(100, 100)):
        facade.set_ship_program(s, program(FIRST))
        before = s.entity
        with pytest.raises(ModelError, match=r"type-correct.*\n.*program:2:") as caught:
            facade.set_ship_program(s, program(ILL_TYPED))
        assert "program:3:" in str(caught.value)
        assert s.entity == before


def test_one_program_on_two_ships_runs_twice(world: WorldHandle) -> None:
    text = "double n;\nwhile n < 3 { turn 1; n := n + 1; }"
    both = program(text)
    a, b = ship_in(world, 200, 500), ship_in(world, 800, 500)
    for s in (a, b):
        facade.set_ship_program(s, both)
    facade.evolve(world, 5)
    assert [facade.get_ship_direction(s) for s in (a, b)] == [3, 3]


def test_if_inside_while_asks_its_condition_each_time(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500)
    text = """
    double n;
    while n < 4 {
      if n < 2 then { turn 0.1; } else { turn 0.01; }
      n := n + 1;
    }"""
    facade.set_ship_program(s, program(text))
    ways = []
    for _ in range(4):
        facade.evolve(world, 0.2)
        ways.append(facade.get_ship_direction(s))
    assert ways == pytest.approx([0.1, 0.2, 0.21, 0.22])


def test_an_illegal_operation_stops_the_program_and_nothing_else(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500, 10, 0)
    facade.set_ship_program(s, program("entity e; turn 1; turn getx e; turn 1;"))
    facade.evolve(world, 2)
    assert facade.get_ship_direction(s) == 1
    assert facade.get_ship_x(s) == 520


def test_a_loop_without_action_does_not_hang(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500, 10, 0)
    facade.set_ship_program(s, program("while true { }"))
    facade.evolve(world, 1)
    assert facade.get_ship_x(s) == 510


def test_a_bullet_a_program_fires_onto_another_entity_is_told(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 500), rock_in(world, 132, 500, r=20)
    facade.set_ship_program(s, program("fire;"))
    listener = Listener()
    facade.evolve(world, 1, listener)
    ((rock, bullet, x, y),) = [(b, a, x, y) for a, b, x, y in listener.told]
    assert rock is r
    assert (x, y) == (113 + 19 * 3 / 23, 500)
    assert facade.is_bullets(bullet)
    assert facade.get_bullet_source(bullet) is s
    assert facade.get_bullet_world(bullet) is None
    assert (facade.get_bullet_x(bullet), facade.get_bullet_x_velocity(bullet)) == (113, 250)
    assert listener.seen == [[(113, 500, 250, 0), (132, 500, 0, 0)]]
    assert facade.get_asteroids(world) == set()


def test_actions_of_a_program_are_no_collisions(world: WorldHandle) -> None:
    s, listener = ship_in(world, 500, 500), Listener()
    facade.set_ship_program(s, program("fire; thrust; turn 1; thrust_off; skip;"))
    facade.evolve(world, 1, listener)
    assert listener.told == []
    assert len(facade.get_bullets(world)) == 1


def test_a_listener_may_not_give_programs(world: WorldHandle) -> None:
    s, refused = ship_in(world, 500, 900, 0, 90), []

    def at_once(*_: Any) -> None:
        with pytest.raises(ModelError, match="may only look"):
            facade.set_ship_program(s, program("fire;"))
        refused.append(True)

    facade.evolve(world, 1, Listener(at_once))
    assert refused == [True]


def test_a_program_that_aims_at_its_own_bullet_kills_nobody(world: WorldHandle) -> None:
    s = ship_in(world, 500, 500, way=pi)
    shot_by(s)
    facade.set_ship_program(s, program("fire; fire;"))
    facade.evolve(world, 0.4)
    assert len(facade.get_bullets(world)) == 3
