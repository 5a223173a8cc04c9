"""A traced program: the steps it took, and the same future."""

from __future__ import annotations

from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.actions import Fire, Turn
from fasteroids.lang import Halted, Machine
from fasteroids.lang.machine.traced import Traced
from fasteroids.lang.machine.values import Seen
from fasteroids.testing import DictView, machines, views
from tests.unit.making import machine


@pytest.fixture
def still() -> DictView:
    """A ship alone."""
    return DictView({1: Seen(1, "ship", 1.0, 2.0, 3.0, 4.0, 5.0)})


def ticked(text: str, view: DictView) -> Traced:
    program: Any = Traced(machine(text)).tick(view).program
    assert isinstance(program, Traced)
    return program


def test_each_step_has_its_place_and_what_it_came_to(still: DictView) -> None:
    steps = ticked("double x := 1 + 2;\nprint x;\nturn x;", still).steps
    told = [(s.span.line, s.span.column, s.value, dict(s.changed), s.printed) for s in steps]
    assert told == [
        (1, 13, (1.0,), {}, None),
        (1, 17, (2.0,), {}, None),
        (1, 13, (3.0,), {}, None),
        (1, 1, None, {"x": 3.0}, None),
        (2, 7, (3.0,), {}, None),
        (2, 1, None, {}, "3.0"),
        (3, 6, (3.0,), {}, None),
        (3, 1, None, {}, None),
    ]
    assert [s.action for s in steps if s.action] == [Turn(3.0)]


def test_the_steps_are_those_of_the_last_tick(still: DictView) -> None:
    program = ticked("fire; skip;", still)
    assert [s.action for s in program.steps] == [Fire()]
    again: Any = program.tick(still).program
    assert len(again.steps) == 1
    assert isinstance(again.steps[0].after, Halted)
    assert not again.running
    assert again.tick(still).program.steps == ()


def test_a_null_is_a_value_and_a_stuck_step_has_none(still: DictView) -> None:
    steps = ticked("entity e; print getx e;", still).steps
    assert [s.value for s in steps] == [(None,), None]
    stuck = steps[-1].after
    assert isinstance(stuck, Halted)
    assert stuck.reason == "getx null: e is null"


@given(machines(), views(), st.integers(0, 200))
def test_a_traced_program_does_what_the_machine_does(
    program: Machine, view: DictView, fuel: int
) -> None:
    view = evolve(view, fuel=fuel)
    plain, traced = program.tick(view), Traced(program).tick(view)
    assert traced._replace(program=plain.program) == plain
    inside: Any = traced.program
    assert inside.machine == plain.program
    assert sum(s.action is not None for s in inside.steps) == (plain.action is not None)
    assert tuple(s.printed for s in inside.steps if s.printed is not None) == plain.prints


def test_the_left_side_of_and_has_a_value_only_if_it_decides(still: DictView) -> None:
    steps = ticked("bool y; y := false == (true && true); y := false && true; skip;", still).steps
    values = [step.value for step in steps]
    assert values[:5] == [(False,), (True,), None, (True,), (True,)]
    assert values[7:9] == [(False,), (False,)]
