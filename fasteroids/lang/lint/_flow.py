"""Statements that are never reached, and loops that burn the fuel of a tick without an action."""

from __future__ import annotations

from collections.abc import Generator, Iterator

from fasteroids.lang import syntax
from fasteroids.lang.checker.types import wants
from fasteroids.lang.diagnostics import Diagnostic, Note
from fasteroids.lang.lint._constants import constant
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Block, Expression, Statement, While

__all__ = ["warnings"]

_Walk = Generator[Diagnostic, None, bool]
"""Warnings, and at the end: does the program never come to what is behind?"""


def warnings(tree: syntax.Program) -> Iterator[Diagnostic]:
    """FA201 to FA203. What lies in a piece that is never reached is not looked into."""
    yield from _in_block(tree.body, spinning=False)


def _in_block(block: Block, *, spinning: bool) -> _Walk:
    """`spinning`: a loop around is told already to spin; what spins in it is the same fault."""
    for i, statement in enumerate(block.statements):
        if (yield from _in_statement(statement, spinning=spinning)):
            rest = [each for each in block.statements[i + 1 :] if _acts(each)]
            if rest:
                yield _unreached(statement, rest)
            return True
    return False


def _in_statement(statement: Statement, *, spinning: bool) -> _Walk:
    match statement:
        case syntax.If(condition, then, orelse):
            value = constant(condition)
            endless = True
            for branch, taken in ((then, True), (orelse, False)):
                if value is (not taken):
                    if branch is not None and any(map(_acts, branch.statements)):
                        yield _dead(condition, branch, always=not taken)
                elif branch is None:
                    endless = False
                else:
                    endless &= yield from _in_block(branch, spinning=spinning)
            return endless
        case syntax.While(condition, body):
            value = constant(condition)
            if value is False:
                if any(map(_acts, body.statements)):
                    yield _dead(condition, body, always=False)
                return False
            spins = not spinning and _spins(statement)
            if spins:
                yield _spinning(statement, endless=value is True)
            yield from _in_block(body, spinning=spinning or spins)
            return value is True
        case syntax.ForEach(_, _, body):
            yield from _in_block(body, spinning=spinning)
    return False


def _acts(statement: Statement) -> bool:
    """Does it do anything? A declaration without a value counts wherever it stands, and does nothing there."""
    return not isinstance(statement, syntax.Declaration) or statement.value is not None


def _spins(loop: While) -> bool:
    """Has its body no action, and nothing that its condition depends on?"""
    names = _named(loop.condition)
    todo = [*loop.body.statements]
    while todo:
        match todo.pop():
            case syntax.Act() | syntax.Turn():
                return False
            case syntax.Assignment(target):
                if target.name in names:
                    return False
            case syntax.Declaration(_, target, value):
                if value is not None and target.name in names:
                    return False
            case syntax.If(_, then, orelse):
                todo += then.statements + (orelse.statements if orelse else ())
            case syntax.While(_, body):
                todo += body.statements
            case syntax.ForEach(_, variable, body):
                if variable.name in names:
                    return False
                todo += body.statements
    return True


def _named(e: Expression) -> set[str]:
    """The variables in an expression."""
    if isinstance(e, syntax.Name):
        return {e.name}
    return {name for part, _ in wants(e, {}) for name in _named(part)}


# What is said.


def _unreached(loop: Statement, rest: list[Statement]) -> Diagnostic:
    kind = "loop" if isinstance(loop, While) else "if"
    return Diagnostic(
        "FA201",
        f"This is never reached: the {kind} before it never ends",
        rest[0].span.to(rest[-1].span),
        hint="Give the loop a condition that can become false, or put this before it",
        label="never reached",
        notes=(Note("never ends", _word(loop)),),
        severity="warning",
    )


def _dead(condition: Expression, branch: Block, *, always: bool) -> Diagnostic:
    value = "true" if always else "false"
    return Diagnostic(
        "FA202",
        f"This block never runs: the condition is always {value}",
        branch.span,
        hint="Ask something that can be both true and false, or leave the block out",
        label="never runs",
        notes=(Note(f"always {value}", condition.span),),
        severity="warning",
    )


def _spinning(loop: While, *, endless: bool) -> Diagnostic:
    why = "and never ends" if endless else "and changes no variable of its condition"
    hint = (
        "Take an action in the loop, such as `skip;`"
        if endless
        else "Take an action in the loop, such as `skip;`, or change what its condition asks"
    )
    return Diagnostic(
        "FA203",
        f"This loop takes no action {why}, so it burns all fuel of a tick",
        _word(loop),
        hint=hint,
        label="no action in this loop",
        severity="warning",
    )


def _word(statement: Statement) -> Span:
    """The word that an `if` or `while` starts with."""
    line, column = statement.span.start
    return Span(line, column, line, column + (5 if isinstance(statement, While) else 2))
