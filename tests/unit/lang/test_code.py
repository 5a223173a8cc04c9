"""Programs made ready: blocks, instructions, nodes in evaluation order, defaults."""

from __future__ import annotations

import copy
import pickle

import pytest

from fasteroids.lang.code import Form, compiled
from fasteroids.lang.printer import printed
from fasteroids.lang.steps import Test as ShortCut
from fasteroids.lang.steps import order
from fasteroids.lang.syntax import (
    Assignment,
    Binary,
    Block,
    Expression,
    Missing,
    Name,
    Print,
    Program,
)
from tests.unit.lang.running import ready


def expression(text: str) -> Expression:
    statement = ready(f"print {text};").program.body.statements[0]
    assert isinstance(statement, Print)
    return statement.value


def words(text: str) -> list[str]:
    nodes = order(expression(text))
    return [
        f"{n.operator}?{n.passes}" if isinstance(n, ShortCut)
        else getattr(n, "operator", None) or printed(n)
        for n in nodes
    ]  # fmt: skip


def test_nodes_stand_in_evaluation_order() -> None:
    assert words("1 - getx a * sqrt(2)") == ["1", "a", "getx", "2", "sqrt", "*", "-"]
    assert words("-x") == ["x", "-"]


def test_a_test_stands_between_the_sides_and_passes_over_all_that_is_left() -> None:
    assert words("p && q") == ["p", "&&?2", "q", "&&"]
    assert words("p || 1 < 2") == ["p", "||?4", "1", "2", "<", "||"]
    assert words("p && q || r") == ["p", "&&?2", "q", "&&", "||?2", "r", "||"]
    assert words("p && (q || r)") == ["p", "&&?5", "q", "||?2", "r", "||", "&&"]


def test_blocks_are_numbered_in_the_order_they_open() -> None:
    code = ready(
        "bool p; entity e;"
        "while (p) { if (p) { skip; } else { print 1; } foreach (any, e) { print 2; } }"
        "if (p) { fire; }"
    )
    forms = [[i.form for i in block] for block in code.blocks]
    assert forms == [
        [Form.WHILE, Form.IF],
        [Form.IF, Form.EACH],
        [Form.ACT],
        [Form.PRINT],
        [Form.PRINT],
        [Form.ACT],
    ]
    loop, branch = code.blocks[0]
    assert (loop.blocks, branch.blocks) == ((1,), (5,))
    assert [i.blocks for i in code.blocks[1]] == [(2, 3), (4,)]


def test_a_declaration_is_an_instruction_only_with_a_value() -> None:
    code = ready("double x; if (true) { bool b; entity e := self; }")
    assert [len(block) for block in code.blocks] == [1, 1]
    assert code.blocks[1][0].target == "e"
    assert dict(code.defaults) == {"x": 0.0, "b": False, "e": None}


def test_the_worst_cost_is_a_step_a_node_and_one() -> None:
    (instruction,) = ready("print true && 1 < 2;").blocks[0]
    assert instruction.worst == 7  # true, test, 1, 2, <, &&, print
    assert ready("skip;").blocks[0][0].worst == 1


@pytest.mark.parametrize(
    "text",
    [
        "print true + true;",
        "print x;",
        "x := 1;",
        "double x; x := true;",
        "double x; foreach (any, x) { }",
        "foreach (any, x) { }",
        "if (1) { }",
        "while (null) { }",
        "turn true;",
        "print 1 && true;",
        "print getx 1;",
        "print null < null;",
        "print 1 == true;",
        "print !1;",
    ],
)
def test_what_is_ill_typed_has_no_closure(text: str) -> None:
    instruction = ready(text).blocks[0][-1]
    assert not instruction.sound
    assert instruction.closure is None


def test_code_is_equal_by_its_text() -> None:
    assert ready("print 1;") == ready("print 1;")
    assert hash(ready("print 1;")) == hash(ready("print 1;"))
    assert ready("print 1;") != ready("print 1; ")


def test_code_can_be_copied_and_pickled() -> None:
    code = ready("double x; x := 1; print x;")
    assert copy.deepcopy(code) is code
    again = pickle.loads(pickle.dumps(code))
    assert again == code
    assert again.defaults == code.defaults
    assert [i.nodes for i in again.blocks[0]] == [i.nodes for i in code.blocks[0]]


def test_a_tree_with_a_gap_is_our_mistake() -> None:
    gap = Program(Block((Assignment(Name("x"), Binary("+", Missing(), Missing())),)))
    with pytest.raises(AssertionError):
        compiled(gap)
