"""The likely fix where a type does not fit: a hint, and an edit where that is safe to make unseen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from fasteroids.lang import syntax
from fasteroids.lang.checker.types import EQUALITIES, type_of
from fasteroids.lang.checker.uses import Node
from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.names import shortened
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Expression, Type
from fasteroids.lang.words import GETTERS

__all__ = [
    "Remedy",
    "for_equality",
    "for_negated_side",
    "for_operand",
    "for_value",
    "negated_side",
]

Remedy = tuple[str | None, tuple[Edit, ...]]
"""A hint, if there is a likely fix, and the fix, if it is safe."""

_COMPARISONS: Final = ("<", "<=", ">", ">=", "==", "!=")


def for_operand(node: Node, expression: Expression, found: Type, wanted: Type) -> Remedy:
    """For an expression that does not have the type that the construct around it takes."""
    match node:
        case syntax.ForEach():
            return "Declare another variable for the loop, such as `entity e;`", ()
        case syntax.Binary(operator) if operator in _COMPARISONS:
            if _is_comparison(expression):
                return _chained(expression, node), ()
            if found == "entity" and not isinstance(expression, syntax.Null):
                return _number_of(expression), ()
        case syntax.Unary("-") if found == "bool":
            line, column = node.span.start
            return "Not is written `!`", (Edit(Span(line, column, line, column + 1), "!"),)
    return for_value(expression, found, wanted)


def for_equality(node: syntax.Binary, one: Type, other: Type) -> Remedy:
    """For `==` and `!=` between operands of two types."""
    left, right = node.left, node.right
    if _is_comparison(left):
        return _chained(left, node), ()
    if isinstance(left, syntax.Null) or isinstance(right, syntax.Null):
        return "Only an entity can be `null`", ()
    if isinstance(right, syntax.Number) and (better := for_value(right, other, one))[1]:
        return better
    if {one, other} == {"double", "entity"}:
        return _number_of(left if one == "entity" else right), ()
    return "Compare two doubles, two bools or two entities", ()


def negated_side(node: Node, types: Mapping[str, Type]) -> syntax.Unary | None:
    """The `!a` of `!a < b`, if `!(a < b)` would be right; None if it would not, or if there is no such."""
    match node:
        case syntax.Binary(operator, syntax.Unary("!", operand) as side, right) if (
            operator in _COMPARISONS and side.span.start == node.span.start
        ):
            kind = type_of(operand, types)
            fits = kind == "double" or (kind == "entity" and operator in EQUALITIES)
            return side if fits and kind == type_of(right, types) else None
    return None


def for_negated_side(node: Node, side: syntax.Unary) -> Remedy:
    """For the `!a` that `negated_side` finds in `!a < b`."""
    assert isinstance(node, syntax.Binary)
    opened, closed = Span(*side.operand.span.start, *side.operand.span.start), node.span.after()
    meant = f"{_text(side.operand)} {node.operator} {_text(node.right)}"
    hint = f"`!` binds more strongly than `{node.operator}`: write `!({meant})`"
    return hint, (Edit(opened, "("), Edit(closed, ")"))


def _number_of(entity: Expression) -> str:
    return f"Compare a number of the entity, as in `getx {_text(entity)}`"


def for_value(expression: Expression, found: Type, wanted: Type) -> Remedy:
    """The likely way from a value of one type to one of another, as a hint and, if it is safe, an edit."""
    match expression, found, wanted:
        case syntax.Number(0.0 | 1.0 as value, span), _, "bool":
            word = "true" if value else "false"
            return f"Write `{word}`", (Edit(span, word),)
        case syntax.Number(0.0, span), _, "entity":
            return "No entity is `null`", (Edit(span, "null"),)
        case _, "double", "bool":
            return f"Compare it with a number, as in `{_text(expression)} != 0`", ()
        case syntax.Null(), "entity", "bool":
            return "Write `false`", (Edit(expression.span, "false"),)
        case _, "entity", "bool":
            return f"Ask whether there is one: `{_text(expression)} != null`", ()
        case syntax.Null(), "entity", "double":
            return "`null` is for entities; a double has no such value", ()
        case _, "entity", "double":
            text = _text(expression)
            return f"Take a number of the entity, as in `getx {text}` or `getradius {text}`", ()
        case syntax.Unary(operator), "double", "entity" if operator in GETTERS:
            return f"`{operator}` has made it a double: leave it out if the entity is meant", ()
        case _:
            return None, ()


def _text(expression: Expression) -> str:
    """A simple expression as it is written; `...` for others."""
    match expression:
        case syntax.Name(name):
            return shortened(name)
        case syntax.Number(value):
            return f"{value:g}" if 1e-3 <= value < 1e5 or value == 0.0 else "..."
        case syntax.Self():
            return "self"
        case syntax.Null():
            return "null"
        case syntax.Direction():
            return "getdir"
        case syntax.Unary(operator, syntax.Name() | syntax.Self() as operand) if (
            operator in GETTERS
        ):
            return f"{operator} {_text(operand)}"
        case _:
            return "..."


def _is_comparison(expression: Expression) -> bool:
    return isinstance(expression, syntax.Binary) and expression.operator in _COMPARISONS


def _chained(left: Expression, node: syntax.Binary) -> str:
    """What `a < b < c` should be."""
    assert isinstance(left, syntax.Binary)
    middle = _text(left.right)
    return (
        f"Comparisons do not chain: write `{_text(left.left)} {left.operator} {middle} && "
        f"{middle} {node.operator} {_text(node.right)}`"
    )
