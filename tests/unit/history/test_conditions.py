"""Conditions in the ship language: what they see, where they do not hold, what they say of their faults."""

from __future__ import annotations

from math import pi

import pytest
from attrs import evolve as with_

from fasteroids import ModelError, Ship, World, check_program, evolve, parse_program
from fasteroids.actions import Program
from fasteroids.history import begin, condition, first_time
from fasteroids.lang.machine.traced import Traced
from fasteroids.state import instructed
from tests.unit.history.pasts import PILOT, arena
from tests.unit.making import Script, machine, rock, ship, world_of

COUNTS = "double n; bool odd; entity e; while (true) { n := n + 1; odd := !odd; foreach (asteroid, e) { } skip; }"


def counting() -> World:
    return world_of(ship(100.0, 100.0, 10.0, program=machine(COUNTS)), rock(500.0, 500.0, 50.0))


def the_ship(world: World) -> Ship:
    (only,) = world.ships
    return only


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("getx self < 100", False),
        ("getx self <= 100", True),
        ("getx self >= 100 && getvx self == 10", True),
        ("getdir == 0", True),
        ("n == 0 && !odd && e == null", True),
        ("  true // yes", True),
        ("(getradius self\n > 9)", True),
        ("sqrt(0 - 1) == sqrt(0 - 1)", False),
        ("1 / 0 > 9999", True),
    ],
)
def test_a_condition_is_an_expression_seen_from_the_ship(text: str, holds: bool) -> None:
    world = counting()
    assert condition(text, the_ship(world))(world) is holds


def test_it_reads_the_variables_as_the_last_tick_left_them() -> None:
    world = counting()
    third = condition("n == 3 && odd", the_ship(world))
    timeline = begin(world).evolve(2.0)
    found = first_time(timeline, third)
    assert found is not None
    assert found.place.time == pytest.approx(0.6)
    assert not third(evolve(found.world, 0.2))


def test_an_entity_in_a_variable_is_seen_anew_in_every_world() -> None:
    world = evolve(counting(), 0.25)
    moved = condition("e != null && getx e > 515", the_ship(world))
    assert not moved(world)
    assert moved(evolve(world, 0.1))


def test_a_dead_entity_in_a_variable_keeps_its_last_state() -> None:
    world = evolve(counting(), 0.25)
    gone = world.remove(2)
    assert condition("getx e == 510", the_ship(world))(gone)


def test_it_does_not_hold_where_the_ship_is_dead_or_an_operation_is_illegal() -> None:
    world = counting()
    always = condition("true", the_ship(world))
    assert always(world)
    assert not always(world.remove(1))
    for text in ("getx e < 0", "getx e >= 0", "!(getx e < 0)", "false || getx null == 0"):
        assert not condition(text, the_ship(world))(world)


@pytest.mark.parametrize("program", [None, Script((None,)), "double m; skip;", "bool n; skip;"])
def test_it_does_not_hold_where_the_program_has_no_such_variable(
    program: Program | str | None,
) -> None:
    world = counting()
    asks = condition("n == 0", the_ship(world))
    other = machine(program) if isinstance(program, str) else program
    changed = world.remove(1).add(with_(the_ship(world), program=other, id=3))
    assert not with_(asks, ship=3)(changed)
    again = instructed(world, 1, machine("double n; skip;"))
    assert asks(again)


def test_it_sees_into_a_traced_program() -> None:
    world = counting()
    traced = instructed(world, 1, Traced(machine(COUNTS)))
    asks = condition("n == 1", the_ship(traced))
    assert asks(evolve(traced, 0.2))


def test_each_ship_has_its_own_view() -> None:
    world = arena()
    red, blue = world.ships
    assert condition("getx self < 200", red)(world)
    assert not condition("getx self < 200", blue)(world)
    assert condition(f"getdir > {pi - 0.1!r}", blue)(world)


def test_it_says_what_an_if_of_the_program_would_say() -> None:
    """A condition is what an `if` asks: put into the program, it decides as the predicate does."""
    text = "getx self > 105 && n > 2"
    source = f"double n; while (true) {{ n := n + 1; if ({text}) {{ print n; }} skip; }}"
    assert check_program(parse_program(source)).program is not None
    world = world_of(ship(100.0, 100.0, 10.0, program=machine(source)))
    timeline = begin(world).evolve(3.0)
    printed = [
        s.world for s in timeline.forwards(timeline.first.place) if getattr(s.what, "prints", ())
    ]
    first = first_time(timeline, condition(text, the_ship(world)))
    assert first is not None
    assert first.world == printed[0]


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("getx self", "condition:1:1", "FA104"),
        ("getx self <", "condition:1:12", "FA018"),
        ("true &&\n  ax > 3", "condition:2:3", "FA101"),
        ("self = null", "condition:1:6", "FA011"),
        ("", "condition:1:1", "FA018"),
        ("true; fire", "condition:1:5", "FA012"),
        ("true /* x", "condition:1:", "FA0"),
        (") {", "condition:1:1", "FA0"),
        ("n := 1", "condition:1:1", "FA"),
        ("x" * 5000, "condition:1:1", "FA"),
        ("(" * 5000, "condition:", "FA"),
    ],
)
def test_a_fault_is_reported_at_its_place_in_the_text(text: str, place: str, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        condition(text, the_ship(counting()))
    first = str(caught.value).splitlines()[0]
    assert first.startswith(place)
    assert f"error {says}" in first


def test_what_is_not_declared_is_answered_with_what_is() -> None:
    with pytest.raises(ModelError, match="program has e, n, odd"):
        condition("ax > 3", the_ship(counting()))
    with pytest.raises(ModelError, match="program has no variables"):
        condition("ax > 3", the_ship(world_of(ship(100.0, 100.0))))


@pytest.mark.parametrize(
    "text",
    ["true) {} if (true", "true) {} else {} if (true", "true) { } double k; if (false", 7, None],
)
def test_what_is_more_than_an_expression_is_refused(text: str) -> None:
    with pytest.raises(ModelError):
        condition(text, the_ship(counting()))


@pytest.mark.parametrize("seen_from", [1, None, rock(1.0, 1.0), ship(100.0, 100.0)])
def test_it_needs_a_ship_of_a_world(seen_from: Ship) -> None:
    with pytest.raises(ModelError, match="seen from a ship"):
        condition("true", seen_from)


def test_the_pilot_of_the_tests_can_be_asked() -> None:
    world = arena()
    assert PILOT.count("double n") == 1
    found = first_time(begin(world).evolve(4.0), condition("n >= 5", world.ships[0]))
    assert found is not None
    assert found.what is not None
