"""What an expression without variables comes to."""

from __future__ import annotations

from fasteroids.lang.machine.values import binary, unary
from fasteroids.lang.syntax import Binary, Expression, Number, Truth, Unary
from fasteroids.lang.words import GETTERS

__all__ = ["constant"]


def constant(e: Expression) -> bool | float | None:
    """The value of an expression that has the same whenever it is evaluated, or None.

    One side is enough for `&&` and `||`, if it decides. No entity counts as constant, not even `self`.
    """
    match e:
        case Number(value) | Truth(value):
            return value
        case Unary(operator, operand) if operator not in GETTERS:
            inner = constant(operand)
            return None if inner is None else _plain(unary(operator, inner))
        case Binary("&&" | "||" as operator, left, right):
            decides = operator == "||"
            sides = (constant(left), constant(right))
            if decides in [side for side in sides if side is not None]:
                return decides
            return None if None in sides else not decides
        case Binary(operator, left, right):
            one, other = constant(left), constant(right)
            if one is None or other is None:
                return None
            return _plain(binary(operator, one, other))
    return None


def _plain(value: object) -> bool | float:
    assert isinstance(value, bool | float)
    return value
