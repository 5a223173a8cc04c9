"""The machine: what each construct does, what it costs, where it stops, what it remembers."""

from __future__ import annotations

import copy
import pickle
from math import nan
from typing import Literal

import pytest
from attrs import evolve
from pyrsistent import pmap

from fasteroids import Asteroid, Ship, World
from fasteroids import evolve as evolved
from fasteroids.actions import Fire, Program, Skip, Thrust, ThrustOff, Ticked, Turn
from fasteroids.lang.machine import (
    Each,
    Frame,
    Halted,
    Machine,
    Running,
    refreshed,
    run,
    run_by_steps,
    started,
    step,
    tick,
)
from fasteroids.lang.machine.code import compiled
from fasteroids.lang.machine.values import Seen
from fasteroids.lang.syntax import Assignment, Block, ForEach, Name, Number, Print
from fasteroids.lang.syntax import Program as Tree
from fasteroids.testing import DictView
from tests.unit.lang.running import BULLET, RIVAL, ROCK, SHIP, loaded, stepped, to_the_end, view
from tests.unit.making import machine

FIRST_EXAMPLE = """
double d;
bool b;

d := 0.2;
b := true;
while(b) {
  turn d;
  d := d + 0.1;
  fire;
}
"""


def ticks(machine: Program, count: int, fuel: int = 1_000) -> list[Ticked]:
    """What so many ticks give."""
    result = []
    for _ in range(count):
        gave = machine.tick(evolve(view(), fuel=fuel))
        machine = gave.program
        result.append(gave)
    return result


def prints(text: str) -> tuple[str, ...]:
    """What a text without actions prints, by closures and by steps alike."""
    fast = run(loaded(text), view(), 1_000)
    assert fast == run_by_steps(loaded(text), view(), 1_000)
    return fast.prints


# The assignment.


def test_the_first_example_of_the_assignment_turns_and_fires_in_turn() -> None:
    gave = ticks(loaded(FIRST_EXAMPLE), 6)
    assert [t.action for t in gave] == [
        Turn(0.2),
        Fire(),
        Turn(0.30000000000000004),
        Fire(),
        Turn(0.4),
        Fire(),
    ]
    assert all(t.end is None for t in gave)
    assert [t.span[0] for t in gave[:2]] == [8, 10]


def test_a_loop_over_all_asteroids_finds_the_nearest() -> None:
    text = """
    entity nearest; entity a; double least; double d; double x; double y;
    x := getx self; y := gety self;
    foreach (asteroid, a) do {
      d := sqrt((x - getx a) * (x - getx a) + (y - gety a) * (y - gety a));
      if (nearest == null || d < least) then { nearest := a; least := d; }
    }
    if (nearest != null) then { print nearest; print least; }
    """
    far, near = (
        Seen(5, "asteroid", 500.0, 20.0, 0.0, 0.0, 1.0),
        Seen(6, "asteroid", 13.0, 24.0, 0.0, 0.0, 1.0),
    )
    seen = view(SHIP, far, near, BULLET)
    assert run(loaded(text), seen, 1_000).prints == ("asteroid 6", "5.0")
    assert run_by_steps(loaded(text), seen, 1_000).prints == ("asteroid 6", "5.0")


def test_variables_start_at_their_defaults_wherever_they_are_declared() -> None:
    assert prints("print x; print p; print e; if (p) { double x; bool p; entity e; }") == (
        "0.0",
        "false",
        "null",
    )


def test_a_declaration_with_a_value_assigns_each_time_it_is_met() -> None:
    text = "double n; while (n < 2) { double x := 5; print x; x := x + 1; n := n + 1; }"
    assert prints(text) == ("5.0", "5.0")


def test_a_program_sees_its_ship_and_the_world() -> None:
    text = "print self; print getdir; print getvx self; print getradius self; print getvy self;"
    assert prints(text) == ("ship 1", "0.5", "1.0", "5.0", "-1.0")


@pytest.mark.parametrize(
    ("kind", "visited"),
    [
        ("ship", ("ship 1", "ship 4")),
        ("asteroid", ("asteroid 2",)),
        ("bullet", ("bullet 3",)),
        ("any", ("ship 1", "asteroid 2", "bullet 3", "ship 4")),
    ],
)
def test_a_for_each_visits_its_kind_by_id_the_own_ship_included(
    kind: str, visited: tuple[str, ...]
) -> None:
    assert prints(f"entity e; foreach ({kind}, e) {{ print e; }} print e;") == (
        *visited,
        visited[-1],
    )


def test_loops_may_nest_over_one_variable() -> None:
    text = "entity e; foreach (ship, e) { foreach (asteroid, e) { print e; } print e; }"
    assert prints(text) == ("asteroid 2",) * 4


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ("turn 0 - 1.5;", Turn(-1.5)),
        ("fire;", Fire()),
        ("thrust;", Thrust()),
        ("thrust_off;", ThrustOff()),
        ("skip;", Skip()),
    ],
)
def test_an_action_at_the_end_is_given_and_then_the_program_is_over(
    text: str, action: object
) -> None:
    first, second = ticks(loaded(text), 2)
    assert (first.action, first.end, first.program.running) == (action, None, False)
    assert (second.action, second.end, second.reason) == (None, "end", None)


# What counts as a step.


@pytest.mark.parametrize(
    ("text", "steps"),
    [
        ("double x;", 0),
        ("print 1;", 2),
        ("double x := 1;", 2),
        ("print 1 + 2;", 4),
        ("print true || false;", 3),  # true, test, print
        ("print false || true;", 5),  # false, test, true, ||, print
        ("print false && (1 < 2 && 1 < 2);", 3),
        ("if (true) { }", 2),
        ("if (true) { print 1; } else { print 1 + 1; }", 4),
        ("if (false) { print 1; } else { print 1 + 1; }", 6),
        ("while (false) { print 1; }", 2),
        ("double n; while (n < 2) { n := n + 1; }", 3 * 4 + 2 * 4),
        ("entity e; foreach (any, e) { }", 4 + 1),
        ("entity e; foreach (any, e) { print e; }", 4 * (1 + 2) + 1),
        ("skip; turn 1; fire;", 1 + 2 + 1),
    ],
)
def test_a_program_costs_a_step_a_node_and_a_step_a_statement(text: str, steps: int) -> None:
    machine, taken = to_the_end(text)
    assert machine.reason is None
    assert taken == steps
    fast: Machine = loaded(text)
    left = 100
    while isinstance(fast, Running):
        fast, _, _, left, _ = run(fast, view(), left)
    assert 100 - left == steps


def test_a_program_out_of_fuel_goes_on_in_the_middle_of_a_sum() -> None:
    gave = ticks(loaded("print 1 + 2;"), 5, fuel=1)
    assert [t.end for t in gave] == ["fuel", "fuel", "fuel", "end", "end"]
    assert [t.prints for t in gave] == [(), (), (), ("3.0",), ()]
    assert gave[1].span == (1, 7, 1, 12)  # the sum comes next
    middle = gave[1].program
    assert isinstance(middle, Running)
    assert list(middle.todo) == [Frame(0, 0, 2, (1.0, 2.0))]


def test_an_endless_program_uses_its_fuel_and_no_more() -> None:
    (gave,) = ticks(loaded("while (true) { }"), 1)
    assert (gave.end, gave.action, gave.program.running) == ("fuel", None, True)


def test_without_fuel_nothing_happens() -> None:
    machine = loaded("print 1;")
    assert run(machine, view(), 0) == (machine, None, (), 0, None)


# What is stuck.


@pytest.mark.parametrize(
    ("text", "reason", "line", "piece"),
    [
        ("entity a;\nprint 1 + getx a;", "getx null: a is null", 2, "getx a"),
        ("print gety null;", "gety null", 1, "gety null"),
        ("double d; d := 0 / 0;\nturn d;", "turn nan: d is nan", 2, "turn d;"),
        ("turn 1 / 0;", "turn inf", 1, "turn 1 / 0;"),
        ("print true + true;", "true + true", 1, "true + true"),
        ("double x; bool p;\nprint x + p;", "0.0 + false: x is 0.0, p is false", 2, "x + p"),
        ("double x; bool p; x := p;", "x := false: x is declared double", 1, "x := p;"),
        ("x := 1;", "x is not declared", 1, "x := 1;"),
        ("print x;", "x is not declared", 1, "x"),
        ("foreach (any, x) { }", "x is not declared", 1, "foreach (any, x) { }"),
        ("bool x; foreach (any, x) { }", "foreach x: x is declared bool", 1, "foreach (any, x) { }"),
        ("double x; if (x) { }", "if 0.0: x is 0.0", 1, "if (x) { }"),
        ("while (null) { }", "while null", 1, "while (null) { }"),
        ("turn self;", "turn ship 1", 1, "turn self;"),
        ("print 1 && true;", "1.0 && ...", 1, "1 && true"),
        ("double x; print true && x;", "true && 0.0: x is 0.0", 1, "true && x"),
        ("print false || null;", "false || null", 1, "false || null"),
        ("print !1;", "!1.0", 1, "!1"),
        ("bool p; print -p;", "-false: p is false", 1, "-p"),
        ("print sqrt(true);", "sqrt true", 1, "sqrt(true)"),
        ("print 1 == null;", "1.0 == null", 1, "1 == null"),
    ],
)  # fmt: skip
def test_an_illegal_operation_halts_and_says_why_and_where(
    text: str, reason: str, line: int, piece: str
) -> None:
    machine, _ = to_the_end(text)
    assert machine.reason == reason
    assert machine.span is not None
    source = text.splitlines()[line - 1]
    assert (machine.span.line, machine.span.end_line) == (line, line)
    assert source[machine.span.column - 1 : machine.span.end_column - 1] == piece
    gave, again = ticks(loaded(text), 2)
    assert (gave.end, gave.reason, gave.span) == ("halt", reason, machine.span)
    assert gave.program == machine
    assert again == gave


def test_what_is_skipped_cannot_be_stuck() -> None:
    assert prints("entity a; print a != null && getx a > 0; print a == null || getx a > 0;") == (
        "false",
        "true",
    )


def test_a_program_keeps_what_it_printed_before_it_got_stuck() -> None:
    (gave,) = ticks(loaded("print 1; print getx null; print 2;"), 1)
    assert (gave.prints, gave.end) == (("1.0",), "halt")


def test_a_ship_that_does_not_see_itself_is_null() -> None:
    assert run(loaded("print self;"), view(ROCK), 10).prints == ("null",)


def test_a_for_each_passes_over_an_id_that_has_no_entity() -> None:
    class Haunted(DictView):
        def ids(self, kind: Literal["ship", "asteroid", "bullet", "any"]) -> tuple[int, ...]:
            return (1, 9) if kind == "any" else ()

    seen = Haunted({1: SHIP})
    machine = loaded("entity e; foreach (any, e) { print e; }")
    assert run_by_steps(machine, seen, 99).prints == run(machine, seen, 99).prints == ("ship 1",)


# Entities over time.


def test_a_variable_shows_the_entity_as_it_is_at_this_tick() -> None:
    machine = run(loaded("entity e; foreach (asteroid, e) { } skip; print getx e;"), view(), 99)
    moved = evolve(ROCK, x=41.0)
    assert tick(machine.machine, view(SHIP, moved), 99).prints == ("41.0",)


def test_a_dead_entity_keeps_its_last_state_and_is_not_null() -> None:
    text = "entity e; foreach (asteroid, e) { } skip; print getx e; print e == null; print e;"
    machine = run(loaded(text), view(), 99).machine
    assert tick(machine, view(SHIP), 99).prints == ("40.0", "false", "asteroid 2")


def test_a_for_each_out_of_fuel_goes_on_with_those_it_began_with_as_they_are_now() -> None:
    text = "entity e; foreach (any, e) { print getx e; }"
    gave = tick(loaded(text), view(), 4 * 2)
    assert (gave.prints, gave.end) == (("10.0", "40.0"), "fuel")
    born = Seen(5, "asteroid", 0.0, 0.0, 0.0, 0.0, 1.0)
    rest = tick(gave.program, view(SHIP, ROCK, evolve(RIVAL, x=91.0), born), 99)  # type: ignore[arg-type]
    assert rest.prints == (
        "70.0",
        "91.0",
    )  # the bullet died, the rival moved, the new rock is not visited


def test_entities_among_operands_and_still_to_visit_are_seen_anew() -> None:
    half = stepped(loaded("print getx self + 1;"), 1)
    moved = view(evolve(SHIP, x=11.0), evolve(RIVAL, y=7.0))
    assert list(refreshed(half, moved).todo) == [Frame(0, 0, 1, (evolve(SHIP, x=11.0),))]  # type: ignore[union-attr]
    loop = stepped(loaded("entity e; foreach (ship, e) { print 1; }"), 1)
    again = refreshed(loop, moved)
    assert isinstance(again, Running)
    assert again.store["e"] == evolve(SHIP, x=11.0)
    each = again.todo.rest.first
    assert isinstance(each, Each)
    assert list(each.rest) == [evolve(RIVAL, y=7.0)]


def test_a_machine_without_entities_is_refreshed_to_itself() -> None:
    machine = stepped(loaded("double x := 1; print x;"), 2)
    assert refreshed(machine, view()) is machine


# Machines as values.


def test_no_frame_stands_at_the_end_of_its_block() -> None:
    machine = stepped(loaded("if (true) { if (true) { print 1; } }"), 4)
    assert list(machine.todo) == [Frame(2, 0)]


def test_an_empty_program_has_ended_before_it_began() -> None:
    assert isinstance(loaded("double x; bool p;"), Halted)
    (gave,) = ticks(loaded(""), 1)
    assert gave.end == "end"


def test_a_step_shares_what_it_does_not_change() -> None:
    text = "double x; double y; while (true) { x := 1; y := 2 + 3; }"
    machine = stepped(loaded(text), 6)
    following = step(machine, view()).machine
    assert isinstance(following, Running)
    assert following.store is machine.store
    assert following.todo.rest is machine.todo.rest
    assert following.code is machine.code


def test_a_run_tells_the_zeros_apart() -> None:
    machine = run(loaded("double x; x := -x; print 1;"), view(), 3).machine
    assert str(machine.store["x"]) == "-0.0"


def test_machines_are_equal_to_the_bit() -> None:
    code = loaded("double x; skip;").code
    todo = started(code).todo  # type: ignore[union-attr]
    zero, minus, wild = (Running(code, pmap({"x": x}), todo) for x in (0.0, -0.0, nan))
    assert zero != minus
    assert zero == Running(code, pmap({"x": 0.0}), todo)
    assert wild == Running(code, pmap({"x": float("nan")}), todo)
    assert hash(wild) == hash(Running(code, pmap({"x": float("nan")}), todo))
    assert len({zero, minus, wild}) == 3


def test_machines_survive_copying_and_pickling_halfway() -> None:
    machine = stepped(loaded("entity e; foreach (any, e) { print getx e + 1; }"), 4)
    for again in (copy.deepcopy(machine), pickle.loads(pickle.dumps(machine))):
        assert again == machine
        assert run(again, view(), 99) == run(machine, view(), 99)


def test_a_machine_is_a_program_in_the_sense_of_a_world() -> None:
    assert isinstance(loaded("skip;"), Program)
    assert isinstance(loaded(""), Program)
    ship = Ship(
        500,
        500,
        0,
        0,
        10,
        5e15,
        0.0,
        program=machine("entity a; foreach (asteroid, a) { } turn gety a;"),
    )
    world = World(1000, 1000).add_all([Asteroid(100, 100, 10, 5, 20), ship])
    flown = evolved(world, 0.2).ships[0]
    assert flown.direction == 101.0 % 6.283185307179586
    assert flown.program is not None
    assert not flown.program.running


def test_a_tree_that_was_never_text_runs_and_gets_stuck_like_any_other() -> None:
    tree = Tree(
        Block(
            (Print(Number(1)), ForEach("any", Name("e"), Block()), Assignment(Name("x"), Name("y")))
        )
    )
    ran = run(started(compiled(tree)), view(), 99)
    assert ran.prints == ("1.0",)
    assert isinstance(ran.machine, Halted)
    assert ran.machine.reason == "e is not declared"
