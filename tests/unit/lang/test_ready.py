"""From a tree to a machine that a ship can carry."""

from __future__ import annotations

import copy
import pickle

import pytest
from hypothesis import given

from fasteroids import ModelError, Ship, check_program, parse_program
from fasteroids.lang import Halted, Running, started, syntax
from fasteroids.lang.machine.code import compiled
from fasteroids.lang.machine.traced import Traced
from fasteroids.lang.printer import printed
from fasteroids.testing import programs, trees


def test_a_correct_program_is_ready_for_a_ship() -> None:
    tree = parse_program("fire;").program
    assert tree is not None
    checked = check_program(tree)
    assert checked.diagnostics == ()
    assert isinstance(checked.program, Running)
    assert checked.program.code.source == "fire;"
    assert Ship(0, 0, 0, 0, 1, 1, 0, program=checked.program).program is checked.program


def test_a_program_that_does_nothing_is_over_at_once() -> None:
    tree = parse_program("double x;").program
    assert tree is not None
    assert isinstance(check_program(tree).program, Halted)


def test_an_ill_typed_program_gives_its_errors() -> None:
    tree = parse_program("turn true;\nx := 1;").program
    assert tree is not None
    checked = check_program(tree)
    assert checked.program is None
    assert [d.span.line for d in checked.diagnostics] == [1, 2]


@pytest.mark.parametrize("wrong", ["fire;", 3, syntax.Block()])
def test_what_is_no_tree_is_refused(wrong: object) -> None:
    with pytest.raises(ModelError, match="a program to check is a tree"):
        check_program(wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "statement",
    [
        syntax.Print(syntax.Missing()),
        syntax.Print(syntax.Name("a b")),
        syntax.Print(syntax.Name("while")),
        syntax.Print(syntax.Number(-1.0)),
    ],
)
def test_a_tree_that_no_text_gives_is_refused(statement: syntax.Statement) -> None:
    with pytest.raises(ModelError, match="this tree is no program"):
        check_program(syntax.Program(syntax.Block((statement,))))


def test_a_changed_tree_runs_as_it_is_not_as_its_old_text_was() -> None:
    tree = parse_program("fire;").program
    assert tree is not None
    changed = syntax.Program(syntax.Block((syntax.Act("skip"),)), tree.source)
    ready = check_program(changed).program
    assert ready is not None
    assert ready.code.source == "skip;\n"


@given(programs())
def test_trees_without_text_get_one(tree: syntax.Program) -> None:
    ready = check_program(tree).program
    assert ready is not None
    assert ready.code.source == printed(tree)


@given(trees())
def test_any_tree_is_either_ready_or_told_why_not(tree: syntax.Program) -> None:
    checked = check_program(tree)
    assert (checked.program is None) == bool(checked.diagnostics)


def test_what_parse_program_gave_is_checked_as_a_whole() -> None:
    assert check_program(parse_program("fire;")) == check_program(parse_program("fire;").program)
    broken = check_program(parse_program("turn true; x := ;"))
    assert broken.program is None
    assert [d.code[:3] for d in broken.diagnostics] == ["FA1", "FA1", "FA0"]
    assert check_program(parse_program("x := ;").program) == check_program(None)


def test_a_ship_takes_no_program_that_was_not_checked() -> None:
    for text in ("turn true;", "fire;"):
        for program in (
            started(compiled(parse_program(text).tree)),
            Traced(started(compiled(parse_program(text).tree))),
        ):
            with pytest.raises(ModelError, match="program must be a checked program"):
                Ship(0, 0, 0, 0, 1, 1, 0, program=program)
    ready = check_program(parse_program("fire; skip;")).program
    assert ready is not None
    for same in (ready, copy.deepcopy(ready), pickle.loads(pickle.dumps(ready))):
        assert Ship(0, 0, 0, 0, 1, 1, 0, program=same).program == ready
