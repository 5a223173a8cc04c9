"""What the constructs of the language take and give (assignment 1.8.2, 1.8.3): the one table of types.

An operator decides the type of its result alone, so the type of an expression is evident from its root: a fault deep
inside an expression never hides what the whole of it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from fasteroids.lang import syntax
from fasteroids.lang.syntax import Expression, Type
from fasteroids.lang.words import CALLS, GETTERS

__all__ = ["CONSTANT_TYPES", "EQUALITIES", "GIVES", "TAKES", "type_of", "wants", "with_article"]

EQUALITIES: Final = ("==", "!=")
"""They take two operands of one type, whichever it is."""

TAKES: Final[Mapping[str, Type]] = {
    **dict.fromkeys(("+", "-", "*", "/", "%", "<", "<=", ">", ">=", *CALLS), "double"),
    **dict.fromkeys(("&&", "||", "!"), "bool"),
    **dict.fromkeys(GETTERS, "entity"),
}
"""The type of all operands of an operator. Those in `EQUALITIES` are not here."""

GIVES: Final[Mapping[str, Type]] = {
    **dict.fromkeys(("+", "-", "*", "/", "%", *CALLS, *GETTERS), "double"),
    **dict.fromkeys(("<", "<=", ">", ">=", "&&", "||", "!", *EQUALITIES), "bool"),
}
"""The type of what an operator gives."""

CONSTANT_TYPES: Final[Mapping[str, Type]] = {
    "true": "bool",
    "false": "bool",
    "null": "entity",
    "self": "entity",
    "getdir": "double",
}
"""The type of an expression of one word."""


def with_article(kind: Type) -> str:
    """A type with its article, for sentences."""
    return f"an {kind}" if kind == "entity" else f"a {kind}"


def type_of(expression: Expression, variables: Mapping[str, Type]) -> Type | None:
    """The evident type of an expression; None if it is a variable of unknown type, or `Missing`."""
    match expression:
        case syntax.Name(name):
            return variables.get(name)
        case syntax.Unary(operator) | syntax.Binary(operator):
            return GIVES[operator]
        case syntax.Number() | syntax.Direction():
            return "double"
        case syntax.Truth():
            return "bool"
        case syntax.Null() | syntax.Self():
            return "entity"
        case syntax.Missing():
            return None


def wants(
    node: syntax.Statement | Expression, variables: Mapping[str, Type]
) -> Iterator[tuple[Expression, Type | None]]:
    """The expressions directly in a construct, in the order of the text, with the type that each must have.

    None stands for any type, and for a type that is not evident. Where two expressions must agree (`==`, the two
    sides of an assignment), each must have the type of the other.
    """
    match node:
        case syntax.Unary(operator, operand):
            yield operand, TAKES[operator]
        case syntax.Binary(operator, left, right):
            if operator in EQUALITIES:
                yield left, type_of(right, variables)
                yield right, type_of(left, variables)
            else:
                yield left, TAKES[operator]
                yield right, TAKES[operator]
        case syntax.Assignment(target, value) | syntax.Declaration(_, target, value) if (
            value is not None
        ):
            yield target, type_of(value, variables)
            yield value, type_of(target, variables)
        case syntax.If(condition) | syntax.While(condition):
            yield condition, "bool"
        case syntax.ForEach(_, variable):
            yield variable, "entity"
        case syntax.Turn(angle):
            yield angle, "double"
        case syntax.Print(value):
            yield value, None
        case _:
            return
