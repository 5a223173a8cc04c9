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

from collections.abc import Iterator
from decimal import Decimal
from math import copysign, isfinite
from typing import assert_never

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

__all__ = ["printed"]

_INDENT = "  "
_LOOSEST = min(BINARY.values())
_PREFIX = max(BINARY.values()) + 1
"""How strongly prefix operators bind: more than any binary one."""


def printed(node: Program | Block | Statement | Expression) -> str:
    """The text of a tree, in normal form.

    That of a program ends in a line end, unless it is empty; that of a block is its statements, without braces. Places
    and the text a tree was read from have no say, so comments are lost. `Missing` and numbers that no text gives
    (negative, inf, nan) are an `AssertionError`: such a tree is ours to keep away from here.
    """
    if isinstance(node, Program):
        return "".join(f"{line}\n" for line in _block(node.body))
    if isinstance(node, Block):
        return "\n".join(_block(node))
    if isinstance(node, Declaration | Assignment | If | While | ForEach | Print | Turn | Act):
        return "\n".join(_statement(node))
    return _expression(node, _LOOSEST)


# Statements, as lines.


def _block(block: Block) -> Iterator[str]:
    for statement in block.statements:
        yield from _statement(statement)


def _body(block: Block) -> Iterator[str]:
    """The lines between two braces."""
    return (_INDENT + line for line in _block(block))


def _statement(statement: Statement) -> Iterator[str]:
    match statement:
        case Declaration(type_, target, None):
            yield f"{type_} {target.name};"
        case Declaration(type_, target, value) if value is not None:
            yield f"{type_} {target.name} := {_whole(value)};"
        case Assignment(target, value):
            yield f"{target.name} := {_whole(value)};"
        case Print(value):
            yield f"print {_whole(value)};"
        case Turn(angle):
            yield f"turn {_whole(angle)};"
        case Act(action):
            yield f"{action};"
        case While(condition, body):
            yield f"while ({_whole(condition)}) {{"
            yield from _body(body)
            yield "}"
        case ForEach(kind, variable, body):
            yield f"foreach ({kind}, {variable.name}) {{"
            yield from _body(body)
            yield "}"
        case If():
            yield from _choice(statement)
        case _:
            raise AssertionError(f"no statement: {statement!r}")


def _choice(chain: If) -> Iterator[str]:
    """An if, with all the `else if` that follow it."""
    opening = "if"
    while True:
        yield f"{opening} ({_whole(chain.condition)}) {{"
        yield from _body(chain.then)
        match chain.orelse:
            case None:
                break
            case Block((If() as another,)):
                opening, chain = "} else if", another
            case orelse:
                yield "} else {"
                yield from _body(orelse)
                break
    yield "}"


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
