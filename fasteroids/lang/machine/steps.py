"""The small steps of an expression: its nodes in the order they are evaluated, and what one node does.

The values that wait for their operation are the operands, a tuple with the newest last. A constant or a variable puts
a value there, an operation takes its operands away and puts its result. So `a && (b + 1 > c)` is

    a, [test &&], b, 1, +, c, >, &&

where the test looks at `a`: false decides, then it stays as the result and everything up to and with the last `&&` is
passed over; true is dropped, and what the right side gives is the result.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from attrs import field, frozen

from fasteroids.actions import View
from fasteroids.lang.machine.values import Stuck, Value, binary, look, shown, unary
from fasteroids.lang.source import NOWHERE, Span
from fasteroids.lang.syntax import (
    Binary,
    Direction,
    Expression,
    Missing,
    Name,
    Null,
    Number,
    Self,
    Truth,
    Unary,
)

__all__ = ["Node", "Operands", "Test", "evaluated", "named", "order"]


@frozen
class Test:
    """The test of `&&` or `||` between its two sides. `passes` counts the nodes it may pass over."""

    operator: str
    passes: int
    span: Span = field(default=NOWHERE, eq=False)


Node: TypeAlias = Expression | Test
Operands: TypeAlias = tuple[Value, ...]


def order(e: Expression) -> tuple[Node, ...]:
    """The nodes of an expression as they are evaluated; each is one small step."""
    nodes: list[Node] = []

    def walk(e: Expression) -> None:
        assert not isinstance(e, Missing), "a tree with a gap never runs"
        if isinstance(e, Unary):
            walk(e.operand)
        elif isinstance(e, Binary):
            walk(e.left)
            if e.operator in ("&&", "||"):
                at = len(nodes)
                walk(e.right)
                nodes.insert(at, Test(e.operator, len(nodes) - at + 1, e.span))
            else:
                walk(e.right)
        nodes.append(e)

    walk(e)
    return tuple(nodes)


def evaluated(
    node: Node, operands: Operands, store: Mapping[str, Value], view: View
) -> tuple[Operands, int]:
    """One small step: the operands after it, and how many nodes are done or passed over by it (1, but for a `Test`).

    `Stuck` if the operation has no rule: a coordinate of null, and whatever a checked program never does.
    """
    rule = _RULES.get(type(node))
    if rule is not None:
        return rule(node, operands, store, view), 1
    assert isinstance(node, Test)
    left = operands[-1]
    if type(left) is not bool:
        raise Stuck(f"{shown(left)} {node.operator} ...")
    if left is (node.operator == "||"):
        return operands, 1 + node.passes
    return operands[:-1], 1


def named(reason: str, *sides: tuple[Expression, Value]) -> str:
    """A reason that also says which variables the values are from: `getx null: a is null`."""
    names = {e.name: value for e, value in sides if isinstance(e, Name)}
    return ": ".join(
        [reason, *[", ".join(f"{n} is {shown(v)}" for n, v in names.items())] * bool(names)]
    )


def _name(e: Name, operands: Operands, store: Mapping[str, Value], _: View) -> Operands:
    try:
        return (*operands, store[e.name])
    except KeyError:
        raise Stuck(f"{e.name} is not declared") from None


def _unary(e: Unary, operands: Operands, _: Mapping[str, Value], __: View) -> Operands:
    a = operands[-1]
    try:
        return (*operands[:-1], unary(e.operator, a))
    except Stuck as stuck:
        raise Stuck(named(str(stuck), (e.operand, a))) from None


def _binary(e: Binary, operands: Operands, _: Mapping[str, Value], __: View) -> Operands:
    if e.operator in ("&&", "||"):
        right = operands[-1]
        if type(right) is bool:
            return operands
        left = shown(e.operator == "&&")
        raise Stuck(named(f"{left} {e.operator} {shown(right)}", (e.right, right)))
    a, b = operands[-2:]
    try:
        return (*operands[:-2], binary(e.operator, a, b))
    except Stuck as stuck:
        raise Stuck(named(str(stuck), (e.left, a), (e.right, b))) from None


_RULES: dict[type, Callable[[Any, Operands, Mapping[str, Value], View], Operands]] = {
    Number: lambda e, operands, _, __: (*operands, float(e.value)),
    Truth: lambda e, operands, _, __: (*operands, e.value),
    Null: lambda _, operands, __, ___: (*operands, None),
    Self: lambda _, operands, __, view: (*operands, look(view, view.self_id)),
    Direction: lambda _, operands, __, view: (*operands, view.direction),
    Name: _name,
    Unary: _unary,
    Binary: _binary,
}
