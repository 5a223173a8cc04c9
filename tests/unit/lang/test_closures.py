"""Closures: they count what they skip, give up where the steps get stuck, and are what `run` uses."""

from __future__ import annotations

from itertools import product
from math import inf, nan
from typing import Any

import pytest
from attrs import evolve

from fasteroids.lang import machine as machines
from fasteroids.lang.closures import Closure, Reading, typed
from fasteroids.lang.machine import run
from fasteroids.lang.syntax import Binary, Expression, Name, Print, Type, Unary
from fasteroids.lang.values import BINARY, GETTERS, UNARY, Stuck, Value, binary, exact, unary
from tests.unit.lang.running import ROCK, SHIP, loaded, ready, view

TYPES: dict[str, Type] = {"p": "bool", "q": "bool", "x": "double", "e": "entity"}


def expression(text: str) -> Expression:
    statement = ready(f"print {text};").program.body.statements[0]
    assert isinstance(statement, Print)
    return statement.value


@pytest.mark.parametrize(
    ("text", "p", "value", "skipped"),
    [
        ("p && q", False, False, 2),
        ("p && q", True, True, 0),
        ("p || q", True, True, 2),
        ("p || 1 < 2", True, True, 4),
        ("(p && 1 < 2) || (p && 3 < 4)", False, False, 8),
        ("p && (q || 1 < 2)", True, True, 4),
        ("p && (q || 1 < 2)", False, False, 7),
    ],
)
def test_a_closure_counts_the_steps_it_skips(text: str, p: bool, value: bool, skipped: int) -> None:
    made = typed(expression(text), TYPES)
    assert made is not None
    world = Reading(view())
    assert made.closure({"p": p, "q": True}, world) is value
    assert world.skipped == skipped


def test_a_closure_is_stuck_on_null() -> None:
    made = typed(expression("getx e"), TYPES)
    assert made is not None
    with pytest.raises(Stuck):
        made.closure({"e": None}, Reading(view()))


@pytest.mark.parametrize(
    "text", ["p + x", "getx x", "-p", "!x", "sqrt(e)", "p == x", "e < e", "z", "x && p"]
)
def test_what_is_ill_typed_has_none(text: str) -> None:
    assert typed(expression(text), TYPES) is None


def test_a_run_takes_small_steps_only_where_it_must(monkeypatch: pytest.MonkeyPatch) -> None:
    taken = []
    step = machines.step

    def counted(*args: Any) -> Any:
        taken.append(args)
        return step(*args)

    monkeypatch.setattr(machines, "step", counted)
    text = "double n; entity e; while (n < 5) { n := n + 1; foreach (any, e) { print n; } } turn n;"
    assert run(loaded(text), view(), 1_000).action is not None
    assert taken == []
    assert run(loaded("double n; print 1; n := getx null; print 2;"), view(), 1_000).action is None
    assert len(taken) == 2  # null, and the getter that is stuck
    taken.clear()
    assert run(loaded("print 1; print 1 + 2;"), view(), 5).left == 0
    assert len(taken) == 3  # fuel for three of the four steps of the second


@pytest.mark.parametrize(
    "stuck", ["print (p && true) || getx e > 0;", "if (p || !p) { turn 0 / 0; }"]
)
def test_what_got_stuck_after_skipping_leaves_nothing_behind(stuck: str) -> None:
    world = Reading(view())
    declared = "bool p; entity e; print p && p; "
    fast = run(loaded(declared + stuck), world, 1_000)
    assert fast == machines.run_by_steps(loaded(declared + stuck), view(), 1_000)
    after = run(loaded("print 1;"), world, 10)
    assert after.left == 8


OPERANDS: dict[Type, list[Value]] = {
    "double": [0.0, -0.0, 1.0, -1.0, 2.5, -7.25, 0.1, inf, -inf, nan, 5e-324, 1e308, -1e308, 1e22],
    "bool": [False, True],
    "entity": [None, SHIP, ROCK, evolve(ROCK, x=1.5)],
}


def closure(e: Expression, type_: Type) -> Closure:
    """The closure of an operation on variables `a` and `b` of a type."""
    made = typed(e, {"a": type_, "b": type_})
    assert made is not None
    return made.closure


@pytest.mark.parametrize("operator", [*UNARY, *GETTERS])
def test_each_unary_closure_gives_the_bits_of_its_operation(operator: str) -> None:
    type_: Type = UNARY[operator][0] if operator in UNARY else "entity"
    made = closure(Unary(operator, Name("a")), type_)
    for a in OPERANDS[type_]:
        if a is None:
            with pytest.raises(Stuck):
                made({"a": a}, Reading(view()))
        else:
            assert exact(made({"a": a}, Reading(view()))) == exact(unary(operator, a)), a


@pytest.mark.parametrize("operator", BINARY)
@pytest.mark.parametrize("type_", ["double", "bool", "entity"])
def test_each_binary_closure_gives_the_bits_of_its_operation(operator: str, type_: Type) -> None:
    if BINARY[operator][0] not in (None, type_):
        assert typed(Binary(operator, Name("a"), Name("a")), {"a": type_}) is None
        return
    made = closure(Binary(operator, Name("a"), Name("b")), type_)
    for a, b in product(OPERANDS[type_], repeat=2):
        got = made({"a": a, "b": b}, Reading(view()))
        assert exact(got) == exact(binary(operator, a, b)), (a, b)
