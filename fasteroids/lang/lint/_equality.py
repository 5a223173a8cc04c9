"""Doubles compared with `==` and `!=`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from fasteroids.lang import syntax
from fasteroids.lang.checker.types import EQUALITIES, type_of
from fasteroids.lang.checker.uses import Construct
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.syntax import Expression, Type

__all__ = ["warnings"]

_STAYS_WHOLE: Final = ("+", "-", "*", "%")
"""They make whole numbers of whole numbers, exactly up to 2^53. (By 0 `%` makes `nan`, but no odd last digits.)"""


def warnings(program: Sequence[Construct], types: Mapping[str, Type]) -> Iterator[Diagnostic]:
    """FA207, but not where both sides count: whole numbers are exact."""
    whole: set[str] | None = None
    for node, _ in program:
        if (
            isinstance(node, syntax.Binary)
            and node.operator in EQUALITIES
            and type_of(node.left, types) == "double"
        ):
            if whole is None:
                whole = _counters(program, types)
            if not (_whole(node.left, whole) and _whole(node.right, whole)):
                yield _compared(node)


def _counters(program: Sequence[Construct], types: Mapping[str, Type]) -> set[str]:
    """The doubles that only ever hold whole numbers, by what is assigned to them."""
    values: dict[str, list[Expression]] = {}
    for node, _ in program:
        match node:
            case syntax.Assignment(target, value) | syntax.Declaration(_, target, value) if (
                value is not None
            ):
                values.setdefault(target.name, []).append(value)
    whole = {name for name, kind in types.items() if kind == "double"}
    readers: dict[str, set[str]] = {}
    for name, each in values.items():
        for other in {other for value in each for other in _leaves(value)}:
            readers.setdefault(other, set()).add(name)
    todo = whole & values.keys()
    while todo:
        name = todo.pop()
        if name in whole and not all(_whole(value, whole) for value in values[name]):
            whole.discard(name)
            todo |= readers.get(name, set()) & whole
    return whole


def _leaves(e: Expression) -> set[str]:
    """The variables that an expression is put together of, by operators that keep numbers whole."""
    match e:
        case syntax.Name(name):
            return {name}
        case syntax.Unary("-", operand):
            return _leaves(operand)
        case syntax.Binary(operator, left, right) if operator in _STAYS_WHOLE:
            return _leaves(left) | _leaves(right)
    return set()


def _whole(e: Expression, whole: set[str]) -> bool:
    match e:
        case syntax.Number(value):
            return value.is_integer()
        case syntax.Name(name):
            return name in whole
        case syntax.Unary("-", operand):
            return _whole(operand, whole)
        case syntax.Binary(operator, left, right) if operator in _STAYS_WHOLE:
            return _whole(left, whole) and _whole(right, whole)
    return False


def _compared(node: syntax.Binary) -> Diagnostic:
    answer = "false" if node.operator == "==" else "true"
    return Diagnostic(
        "FA207",
        f"`{node.operator}` between doubles is almost always {answer}, as the last digits seldom agree",
        node.span,
        hint="Use `<` or `>`, or ask whether they are close, as in `a - b < 0.1 && b - a < 0.1`",
        label="two doubles",
        severity="warning",
    )
