"""A tree as text, in the one normal form of the language.

Two blanks a level, one statement a line, conditions in parentheses, no more parentheses than the tree needs:

    while (true) {
      if (nearest == null || !(getx nearest < 3)) {
        skip;
      } else if (armed) {
        turn -0.5 * (a - b);
      } else {
      }
    }

Law L12: parsing the text of a tree that a parser made gives an equal tree. So every other group of operators than the
one the strengths of `words.BINARY` give has its parentheses, and a number its shortest digits that read back to the
same double. The language knows no exponents: 1e-300 has 300 of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from decimal import Decimal
from math import copysign, isfinite
from typing import Final, NamedTuple, assert_never

from fasteroids.lang.source import Span
from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Missing,
    Name,
    Null,
    Number,
    Print,
    Program,
    Self,
    Statement,
    Truth,
    Turn,
    Unary,
    While,
)
from fasteroids.lang.words import BINARY, CALLS, GETTERS

__all__ = ["INDENT", "Line", "lines", "printed"]

INDENT: Final = "  "
"""One level."""

_LOOSEST = min(BINARY.values())
_PREFIX = max(BINARY.values()) + 1
"""How strongly prefix operators bind: more than any binary one."""


class Line(NamedTuple):
    """A line in normal form.

    `text` is without its blanks in front, of which there are `level` times `INDENT`. `span` is what it was read from:
    a statement with its `;`, a head up to its `{`, a `}`, or all from a `}` to the `{` of the `else` behind it.
    """

    level: int
    text: str
    span: Span


def _never(_block: Block) -> bool:
    return False


def lines(block: Block, apart: Callable[[Block], bool] = _never) -> Iterator[Line]:
    """The lines of a program's body or of the statements of any other block, which start at level 0.

    An `else` of one `if` is `else if`, unless it is to stay `apart`: then it has braces, which mean the same.
    """
    return _block(block, 0, apart)


def printed(node: Program | Block | Statement | Expression) -> str:
    """The text of a tree, in normal form.

    That of a program ends in a line end, unless it is empty; that of a block is its statements, without braces. Places
    and the text a tree was read from have no say, so comments are lost (`formatter` keeps them). `Missing` and numbers
    that no text gives (negative, inf, nan) are an `AssertionError`: such a tree is ours to keep away from here.
    """
    if isinstance(node, Program):
        return "".join(INDENT * level + text + "\n" for level, text, _ in lines(node.body))
    if isinstance(node, Block):
        return "\n".join(INDENT * level + text for level, text, _ in lines(node))
    if isinstance(node, Declaration | Assignment | If | While | ForEach | Print | Turn | Act):
        return printed(Block((node,)))
    return _expression(node, _LOOSEST)


# Statements, as lines.


def _block(block: Block, level: int, apart: Callable[[Block], bool]) -> Iterator[Line]:
    for statement in block.statements:
        match statement:
            case If():
                yield from _choice(statement, level, apart)
            case While(condition, body):
                head = f"while ({_whole(condition)}) {{"
                yield from _loop(head, body, statement.span, level, apart)
            case ForEach(kind, variable, body):
                head = f"foreach ({kind}, {variable.name}) {{"
                yield from _loop(head, body, statement.span, level, apart)
            case _:
                yield Line(level, _simple(statement), statement.span)


def _simple(statement: Declaration | Assignment | Print | Turn | Act) -> str:
    """A statement of one line."""
    match statement:
        case Declaration(type_, target, None):
            return f"{type_} {target.name};"
        case Declaration(type_, target, value) if value is not None:
            return f"{type_} {target.name} := {_whole(value)};"
        case Assignment(target, value):
            return f"{target.name} := {_whole(value)};"
        case Print(value):
            return f"print {_whole(value)};"
        case Turn(angle):
            return f"turn {_whole(angle)};"
        case Act(action):
            return f"{action};"
        case _:
            raise AssertionError(f"no statement: {statement!r}")


def _loop(
    head: str, body: Block, span: Span, level: int, apart: Callable[[Block], bool]
) -> Iterator[Line]:
    yield Line(level, head, _up_to_brace(span, body))
    yield from _block(body, level + 1, apart)
    yield Line(level, "}", _brace(body).to(span))


def _choice(chain: If, level: int, apart: Callable[[Block], bool]) -> Iterator[Line]:
    """An if, with all the `else if` that follow it."""
    opening, start, span = "if", chain.span, chain.span
    while True:
        head = f"{opening} ({_whole(chain.condition)}) {{"
        yield Line(level, head, _up_to_brace(start, chain.then))
        yield from _block(chain.then, level + 1, apart)
        start = _brace(chain.then)
        match chain.orelse:
            case None:
                break
            case Block((If() as another,)) as orelse if not apart(orelse):
                opening, chain = "} else if", another
            case Block() as orelse:
                yield Line(level, "} else {", _up_to_brace(start, orelse))
                yield from _block(orelse, level + 1, apart)
                start = _brace(orelse)
                break
    # It may end behind its last `}`: braces around an `else if` are gone.
    yield Line(level, "}", start.to(span))


def _up_to_brace(start: Span, body: Block) -> Span:
    """From the start of something to the `{` of a block."""
    line, column = body.span.start
    return Span(*start.start, line, column + 1)


def _brace(body: Block) -> Span:
    """The `}` of a block."""
    line, column = body.span.end
    return Span(line, column - 1, line, column)


# Expressions.


def _whole(expression: Expression) -> str:
    """An expression with nothing on either side that could take a piece of it."""
    return _expression(expression, _LOOSEST)


def _expression(expression: Expression, least: int) -> str:
    """In parentheses, if its operator binds less strongly than `least`."""
    match expression:
        case Number(value):
            return _number(value)
        case Truth(value):
            return "true" if value else "false"
        case Null():
            return "null"
        case Self():
            return "self"
        case Direction():
            return "getdir"
        case Name(name):
            return name
        case Unary(operator, operand) if operator in CALLS:
            return f"{operator}({_whole(operand)})"
        case Unary(operator, operand):
            return operator + _gap(operator, operand) + _expression(operand, _PREFIX)
        case Binary(operator, left, right):
            # All of them group to the left: an equally strong operator on the right needs parentheses.
            strength = BINARY[operator]
            sides = _expression(left, strength), _expression(right, strength + 1)
            text = f" {operator} ".join(sides)
            return f"({text})" if strength < least else text
        case Missing():
            raise AssertionError("a tree with a piece missing has no text")
        case _:
            assert_never(expression)


def _gap(operator: str, operand: Expression) -> str:
    """Between a prefix operator and what follows: words want a blank, and two minus signs are not to look like one."""
    twice = operator == "-" and isinstance(operand, Unary) and operand.operator == "-"
    return " " if operator in GETTERS or twice else ""


def _number(value: float) -> str:
    """Digits, and a point only if there is something behind it."""
    assert copysign(1.0, value) > 0.0, f"no text gives {value}"
    assert isfinite(value), f"no text gives {value}"
    return format(Decimal(repr(value)), "f").removesuffix(".0")
