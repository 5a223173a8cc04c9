"""Values: every operation is total on operands of its types, and has no rule for others."""

from __future__ import annotations

from math import copysign, inf, isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Asteroid, Bullet, Ship, World
from fasteroids.lang.values import (
    BINARY,
    GETTERS,
    UNARY,
    Seen,
    Sight,
    Stuck,
    Value,
    binary,
    exact,
    look,
    same,
    shown,
    type_of,
    unary,
)
from fasteroids.rules import ShipView
from tests.unit.lang.running import ROCK, SHIP, view

entities = st.builds(
    Seen, st.integers(1, 3), st.sampled_from(["ship", "asteroid", "bullet"]), *[st.floats()] * 5
)
values: st.SearchStrategy[Value] = st.one_of(st.floats(), st.booleans(), st.none(), entities)


@pytest.mark.parametrize(
    ("a", "operator", "b", "result"),
    [
        (1.0, "/", 0.0, inf),
        (1.0, "/", -0.0, -inf),
        (-1.0, "/", 0.0, -inf),
        (-inf, "/", -0.0, inf),
        (0.0, "/", 0.0, nan),
        (nan, "/", 0.0, nan),
        (1e308, "*", 10.0, inf),
        (inf, "-", inf, nan),
        (5.5, "%", 2.0, 1.5),
        (-0.5, "%", 2.0, 1.5),
        (5.5, "%", -2.0, -0.5),
        (5.0, "%", 0.0, nan),
        (inf, "%", 2.0, nan),
        (5.0, "%", inf, 5.0),
        (-5.0, "%", inf, inf),
        (nan, "==", nan, False),
        (nan, "!=", nan, True),
        (0.0, "==", -0.0, True),
        (nan, "<", 1.0, False),
        (nan, ">=", 1.0, False),
    ],
)
def test_doubles_follow_ieee(a: float, operator: str, b: float, result: float | bool) -> None:
    assert exact(binary(operator, a, b)) == exact(result)


@pytest.mark.parametrize("operator", ["sqrt", "sin", "cos"])
@pytest.mark.parametrize("a", [inf, -inf, nan, -2.0])
def test_a_function_outside_its_domain_is_nan(operator: str, a: float) -> None:
    result = unary(operator, a)
    if operator == "sqrt" and a == inf:
        assert result == inf
    elif a != -2.0 or operator == "sqrt":
        assert isinstance(result, float)
        assert isnan(result)
    else:
        assert isinstance(result, float)
        assert -1.0 <= result <= 1.0


def test_the_root_of_minus_zero_is_minus_zero() -> None:
    assert exact(unary("sqrt", -0.0)) == exact(-0.0)


@given(st.sampled_from([*BINARY, "&&", "**"]), values, values)
def test_a_binary_operation_has_a_value_of_its_type_or_no_rule(
    operator: str, a: Value, b: Value
) -> None:
    wanted, result, _ = BINARY.get(operator, ("none", "double", None))
    ruled = operator in BINARY and type_of(a) == type_of(b) and wanted in (None, type_of(a))
    if ruled:
        assert type_of(binary(operator, a, b)) == result
    else:
        with pytest.raises(Stuck, match=r"^[^\n]+$"):
            binary(operator, a, b)


@given(st.sampled_from([*UNARY, *GETTERS, "~"]), values)
def test_a_unary_operation_has_a_value_of_its_type_or_no_rule(operator: str, a: Value) -> None:
    ruled = operator in UNARY and type_of(a) == UNARY[operator][0]
    if ruled or (operator in GETTERS and isinstance(a, Seen)):
        assert type_of(unary(operator, a)) == ("bool" if operator == "!" else "double")
    else:
        with pytest.raises(Stuck, match=r"^[^\n]+$"):
            unary(operator, a)


def test_entities_are_the_same_by_id_and_never_null() -> None:
    moved = Seen(2, "asteroid", 0.0, 0.0, 0.0, 0.0, 8.0)
    assert moved != ROCK
    assert same(moved, ROCK)
    assert not same(SHIP, ROCK)
    assert not same(ROCK, None)
    assert not same(None, ROCK)
    assert same(None, None)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.25, "0.25"),
        (30.0, "30.0"),
        (1e300, "1e+300"),
        (-0.0, "-0.0"),
        (inf, "inf"),
        (-inf, "-inf"),
        (nan, "nan"),
        (True, "true"),
        (False, "false"),
        (None, "null"),
        (SHIP, "ship 1"),
    ],
)
def test_print_shows_a_value(value: Value, text: str) -> None:
    assert shown(value) == text


@given(values, values)
def test_exact_tells_values_apart_to_the_bit(a: Value, b: Value) -> None:
    alike = type(a) is type(b) and repr(a) == repr(b)
    assert (exact(a) == exact(b)) == alike
    assert exact(a) == exact(a)


def test_exact_tells_one_from_true_and_the_zeros_from_each_other() -> None:
    assert len({exact(1.0), exact(True), exact(0.0), exact(False), exact(-0.0), exact(None)}) == 6
    assert exact(nan) == exact(copysign(nan, -1.0))


def test_a_program_sees_of_an_entity_what_its_world_knows() -> None:
    world = World(1000, 1000).add_all(
        [
            Ship(100, 100, 1, 2, 10, 1e15, 1.5),
            Asteroid(300, 300, 3, 4, 20),
            Bullet(500, 500, 5, 6, 3, 1),
        ]
    )
    seen = ShipView(world, world.ships[0])
    assert look(seen, 1) == Seen(1, "ship", 100.0, 100.0, 1.0, 2.0, 10.0)
    assert look(seen, 2) == Seen(2, "asteroid", 300.0, 300.0, 3.0, 4.0, 20.0)
    assert look(seen, 3) == Seen(3, "bullet", 500.0, 500.0, 5.0, 6.0, 3.0)
    assert look(seen, 4) is None


def test_a_sight_looks_at_each_entity_once() -> None:
    looked = []

    class Counting:
        self_id, direction, fuel = 1, 0.5, 10

        def ids(self, kind: str) -> tuple[int, ...]:
            return view().ids(kind)  # type: ignore[arg-type]

        def entity(self, entity_id: int) -> Seen | None:
            looked.append(entity_id)
            return view().entity(entity_id)

    sight = Sight(Counting())
    assert sight.entity(2) is sight.entity(2)
    assert sight.entity(99) is sight.entity(99) is None
    assert looked == [2, 99]
    assert (sight.self_id, sight.direction, sight.fuel) == (1, 0.5, 10)
    assert sight.ids("any") == (1, 2, 3, 4)
