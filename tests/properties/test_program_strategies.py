"""The strategies for programs: type correct by construction, every construct, all sizes, and small when shrunk."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, TypeVar

import pytest
from hypothesis import HealthCheck, Phase, find, given, settings
from hypothesis import strategies as st

from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import (
    MOST_NESTED,
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Name,
    Null,
    Number,
    Print,
    Program,
    Self,
    Truth,
    Turn,
    Type,
    Unary,
    While,
)
from fasteroids.lang.words import BINARY, CALLS, GETTERS, KEYWORDS, KINDS, TYPES, UNARY
from fasteroids.testing import expressions, program_texts, programs, trees
from tests.oracle.walking import children, depth, nodes

_T = TypeVar("_T")
search = settings(
    max_examples=2_000, derandomize=True, database=None, phases=(Phase.generate, Phase.shrink)
)

WORLDLY = ["getx", "gety", "getvx", "getvy", "getradius"]
CONSTRUCTS = {
    *(c.__name__ for c in (Number, Truth, Null, Self, Direction, Name)),
    *(c.__name__ for c in (Declaration, Assignment, If, While, Print, Turn)),
    *(f"unary {operator}" for operator in (*UNARY, *CALLS)),
    *(f"binary {operator}" for operator in BINARY),
    *(f"foreach {kind}" for kind in KINDS),
    *(f"declared {type}" for type in TYPES),
    *("fire", "thrust", "thrust_off", "skip", "else", "else if", "declared with a value"),
}


def constructs(tree: Any) -> Iterator[str]:
    for node in nodes(tree):
        match node:
            case Unary(operator):
                yield f"unary {operator}"
            case Binary(operator):
                yield f"binary {operator}"
            case ForEach(kind):
                yield f"foreach {kind}"
            case Act(action):
                yield action
            case Declaration(type_, _, value):
                yield from ("Declaration", f"declared {type_}")
                yield from ["declared with a value"] if value else []
            case If(_, _, orelse):
                yield from ["If"] + ["else"] * (orelse is not None)
                chained = orelse and [If] == list(map(type, orelse.statements))
                yield from ["else if"] if chained else []
            case Program() | Block():
                pass
            case _:
                yield type(node).__name__


def sample(strategy: st.SearchStrategy[_T], count: int = 300) -> list[_T]:
    """So many examples, always the same."""
    found: list[_T] = []
    every = settings(search, max_examples=count, phases=(Phase.generate,))

    @settings(every, suppress_health_check=list(HealthCheck))
    @given(strategy)
    def draw(example: _T) -> None:
        found.append(example)

    draw()
    return found


@cache
def some_programs() -> list[Program]:
    return sample(programs())


@cache
def some_trees() -> list[Program]:
    return sample(trees())


# What is type correct (assignment 1.8.3), told once more and as bluntly as can be.


def declared(program: Program) -> dict[str, Type]:
    found: dict[str, Type] = {}
    for node in nodes(program):
        if isinstance(node, Declaration):
            assert node.target.name not in found
            found[node.target.name] = node.type
    return found


def type_of(tree: Expression, variables: Mapping[str, Type]) -> Type:
    match tree:
        case Number() | Direction():
            return "double"
        case Truth():
            return "bool"
        case Null() | Self():
            return "entity"
        case Name(name):
            return variables[name]
        case Unary(operator, operand):
            wants = "entity" if operator in WORLDLY else "bool" if operator == "!" else "double"
            assert type_of(operand, variables) == wants
            return "bool" if operator == "!" else "double"
        case Binary(operator, left, right):
            sides = [type_of(left, variables), type_of(right, variables)]
            assert sides[0] == sides[1]
            if operator in ("&&", "||"):
                assert sides[0] == "bool"
            elif operator not in ("==", "!="):
                assert sides[0] == "double"
            return "double" if operator in "+-*/%" else "bool"
    raise AssertionError(tree)


def assert_typed(tree: Any, variables: Mapping[str, Type]) -> None:
    match tree:
        case Declaration(_, target, value) if value:
            assert type_of(value, variables) == variables[target.name]
        case Assignment(target, value):
            assert type_of(value, variables) == variables[target.name]
        case If(condition) | While(condition):
            assert type_of(condition, variables) == "bool"
        case ForEach(_, variable, body):
            assert variables[variable.name] == "entity"
            assert not any(isinstance(node, Act | Turn) for node in nodes(body))
        case Turn(angle):
            assert type_of(angle, variables) == "double"
        case Print(value):
            type_of(value, variables)
    for child in children(tree):
        if not isinstance(child, Expression):
            assert_typed(child, variables)


@given(programs())
def test_programs_are_type_correct(program: Program) -> None:
    variables = declared(program)
    assert_typed(program, variables)
    assert {node.name for node in nodes(program) if isinstance(node, Name)} <= set(variables)


@given(st.data(), st.sampled_from(TYPES), st.integers(0, 5))
def test_expressions_have_the_type_and_the_depth_asked_for(
    data: st.DataObject, type: Type, most: int
) -> None:
    variables: dict[str, Type] = {"much": "double", "given": "bool", "other": "entity"}
    tree = data.draw(expressions(type, variables, depth=most))
    assert type == type_of(tree, variables)
    assert depth(tree) <= most + 2


@pytest.mark.parametrize("variables", [{}, {"mine": "entity"}, {"mine": "double", "other": "bool"}])
def test_expressions_use_the_variables_given_and_no_others(variables: dict[str, Type]) -> None:
    used = set()
    for tree in sample(expressions("bool", variables), 200):
        assert type_of(tree, variables) == "bool"
        used |= {node.name for node in nodes(tree) if isinstance(node, Name)}
    assert used == set(variables)


# Variety.


def test_every_construct_appears_in_programs_and_in_trees() -> None:
    for some in (some_programs(), some_trees()):
        assert CONSTRUCTS - {name for tree in some for name in constructs(tree)} == set()


@pytest.mark.parametrize(
    ("strategy", "absent"),
    [
        (programs(thrust=False), {"thrust", "thrust_off"}),
        (programs(fire=False), {"fire"}),
        (programs(actions=False), {"fire", "thrust", "thrust_off", "skip", "Turn"}),
    ],
)
def test_what_is_left_out_is_absent_and_nothing_else(
    strategy: st.SearchStrategy[Program], absent: set[str]
) -> None:
    found = {name for tree in sample(strategy) for name in constructs(tree)}
    assert CONSTRUCTS - found == absent


def test_sizes_vary() -> None:
    for some in (some_programs(), some_trees()):
        lines = sorted(printed(tree).count("\n") for tree in some)
        assert lines[0] == 0
        small, large = lines[len(lines) // 4], lines[-len(lines) // 4]
        assert 2 * small < large
        assert 60 < lines[-1] < 1_000


def test_trees_are_deep_but_leave_room_for_parentheses() -> None:
    depths = [depth(tree) for tree in some_trees()]
    assert MOST_NESTED / 4 < max(depths) <= MOST_NESTED / 2
    assert max(depth(tree) for tree in some_programs()) <= MOST_NESTED / 2


def test_most_programs_act_and_read_entities_and_some_read_null() -> None:
    some = some_programs()
    assert sum(any(isinstance(n, Act | Turn) for n in nodes(tree)) for tree in some) > len(some) / 2
    reads = [
        [n for n in nodes(tree) if isinstance(n, Unary) and n.operator in GETTERS] for tree in some
    ]
    assert sum(map(bool, reads)) > len(some) / 2
    assert any(n.operand == Null() for row in reads for n in row)


def test_programs_nest_loops_over_entities_and_declare_inside_them() -> None:
    def inside(tree: Any, kind: type) -> bool:
        loops = (node for node in nodes(tree) if isinstance(node, ForEach))
        return any(isinstance(node, kind) for loop in loops for node in nodes(loop.body))

    assert any(inside(tree, ForEach) for tree in some_programs())
    assert any(inside(tree, Declaration) for tree in some_programs())


def test_names_in_trees_are_no_words_of_the_language_but_look_like_them() -> None:
    names = {node.name for tree in some_trees() for node in nodes(tree) if isinstance(node, Name)}
    assert not names & KEYWORDS
    assert {"Thrust", "thrust_of", "e1"} <= names
    assert max(map(len, names)) > 6


# Shrinking.


def test_everything_shrinks_to_the_empty_program() -> None:
    assert find(programs(), lambda _: True, settings=search) == Program(Block())
    assert find(trees(), lambda _: True, settings=search) == Program(Block())
    assert find(program_texts(), lambda _: True, settings=search) == ""


@pytest.mark.parametrize(
    ("construct", "smallest"),
    [
        ("skip", "skip;\n"),
        ("fire", "fire;\n"),
        ("Turn", "turn 0;\n"),
        ("unary getx", "print getx self;\n"),
        ("binary %", "print 0 % 0;\n"),
        ("foreach ship", "entity a;\nforeach (ship, a) {\n}\n"),
        ("While", "while (false) {\n}\n"),
        ("else if", "if (false) {\n} else if (false) {\n}\n"),
        ("declared with a value", "double x := 0;\n"),
    ],
)
def test_a_program_with_one_construct_shrinks_to_it(construct: str, smallest: str) -> None:
    small = find(programs(), lambda tree: construct in constructs(tree), settings=search)
    assert smallest == printed(small)


def test_a_program_with_a_loop_in_a_loop_shrinks_to_those() -> None:
    def nested(tree: Program) -> bool:
        loops = [node for node in nodes(tree) if isinstance(node, ForEach)]
        return any(isinstance(node, ForEach) for loop in loops for node in nodes(loop.body))

    assert printed(find(programs(), nested, settings=search)).count("\n") == 5


def test_a_deep_tree_shrinks_to_one_row_of_operators() -> None:
    small = find(trees(), lambda tree: depth(tree) > 12, settings=search)
    assert len(list(nodes(small))) < 30
