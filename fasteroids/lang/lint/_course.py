"""What the parser of the course of 2013 would have read otherwise, or refused (docs/grammar.md, last section).

To it all binary operators were alike and grouped to the right, and `getx` and its like and `!` took everything to their
right. So it read an operator as we do if its left side ends for itself: a word, a call, something in parentheses. Where
the left side is open, what is on the right went into it. That is the one case to find, and the mend is parentheses
around the left side. Whether it has some already is seen in the places: a tree has no parentheses, but an operator
starts with those of its left side.

No warning where all operators that were grouped anew are `+`, `*`, `&&` or `||`, all the same one: for the last two
that changes nothing, for `+` and `*` rounding alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import accumulate

from fasteroids.lang import syntax
from fasteroids.lang.checker.types import wants
from fasteroids.lang.checker.uses import Construct, Node
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import MOST_NESTED, Binary, Expression, Number, Program, Unary
from fasteroids.lang.words import CALLS

__all__ = ["warnings"]

_LINE = re.compile(r"[^\r\n]*(?:\r\n?|\n|\Z)")


class _Text:
    """The text of a program, by places."""

    def __init__(self, source: str) -> None:
        self._source = source
        self._starts = [0, *accumulate(map(len, _LINE.findall(source)))]

    def between(self, start: tuple[int, int], end: tuple[int, int]) -> str:
        """What is written from one place to another."""
        return self._source[self._offset(*start) : self._offset(*end)]

    def around(self, line: int, column: int) -> str:
        """The character before a place and that behind it; less at the ends of the text."""
        at = self._offset(line, column)
        return self._source[max(at - 1, 0) : at + 1]

    def _offset(self, line: int, column: int) -> int:
        return self._starts[line - 1] + column - 1


def warnings(tree: Program, program: Sequence[Construct]) -> Iterator[Diagnostic]:
    """FA211 and FA212. Without a text there is nothing that another parser could read."""
    if not tree.source:
        return
    text = _Text(tree.source)
    for node, _ in program:
        yield from _refused(node, text)
        if isinstance(node, Unary | Binary):
            continue
        for expression, _ in wants(node, {}):
            if (found := _grouped(node, expression, text)) is not None:
                yield found


# Grouped otherwise.


def _grouped(node: Node, expression: Expression, text: _Text) -> Diagnostic | None:
    """The warning about a whole expression of a statement."""
    sides: list[Expression] = []
    differs = False
    todo = [expression]
    while todo:
        e = todo.pop()
        todo += [part for part, _ in wants(e, {})]
        if isinstance(e, Binary) and _open(e.left) and e.span.start == e.left.span.start:
            sides.append(e.left)
            differs |= not _alike(e)
    if not differs:
        return None
    edits: list[Edit] = []
    for side in sides:
        line, column = side.span.start
        edits += [Edit(Span(line, column, line, column), "("), Edit(side.span.after(), ")")]
    brackets = text.between(node.span.start, expression.span.end).count("(") + len(sides)
    return Diagnostic(
        "FA211",
        "The parser of 2013 grouped this otherwise: it grouped all operators to the right",
        expression.span,
        hint="Add parentheses, which both read alike",
        label="grouped otherwise in 2013",
        fix=tuple(edits) if brackets <= MOST_NESTED else (),
        severity="warning",
    )


def _open(e: Expression) -> bool:
    """Did the parser of 2013 put what is behind this expression into it, if no parentheses are around it?"""
    match e:
        case Binary():
            return True
        case Unary(operator, operand) if operator not in CALLS:
            return operator != "-" or (_open(operand) and e.span.end == operand.span.end)
    return False


def _alike(e: Binary) -> bool:
    """Do both groups of `a + b + c`, and of other operators that do not care, come to the same?"""
    left = e.left
    return (
        isinstance(left, Binary)
        and left.operator == e.operator
        and e.operator in ("+", "*", "&&", "||")
        and not (_open(left.right) and left.span.end == left.right.span.end)
    )


# Refused.


def _refused(node: Node, text: _Text) -> Iterator[Diagnostic]:
    match node:
        case syntax.If(_, _, syntax.Block((syntax.If() as inner,), span)) if span == inner.span:
            line, column = span.start
            yield _told(
                "no `else if`",
                Span(line, column, line, column + 2),
                "Put the `if` into braces",
                Edit(Span(line, column, line, column), "{ "),
                Edit(span.after(), " }"),
            )
        case Binary("%"):
            yield _told("no `%`", node.span, "Take a whole number of the divisor away instead")
        case Binary("-", _, right) if _glued(right, text):
            line, column = right.span.start
            yield _told(
                "a sign as part of the number behind it, so no operator is left here",
                Span(line, column - 1, line, column),
                "Put a blank behind the `-`",
                Edit(Span(line, column, line, column), " "),
            )
        case Unary("-", operand) if not (isinstance(operand, Number) and _glued(operand, text)):
            line, column = node.span.start
            hint = (
                "Write the sign right before the number"
                if isinstance(operand, Number)
                else "Write `0 - ...`"
            )
            yield _told("a sign before numbers only", Span(line, column, line, column + 1), hint)


def _glued(e: Expression, text: _Text) -> bool:
    """Does this expression begin with a digit, right behind a minus sign?"""
    return re.fullmatch("-[0-9]", text.around(*e.span.start)) is not None


def _told(knew: str, span: Span, hint: str, *fix: Edit) -> Diagnostic:
    return Diagnostic(
        "FA212",
        f"The parser of 2013 refused this: it knew {knew}",
        span,
        hint=hint,
        label="refused in 2013",
        fix=fix,
        severity="warning",
    )
