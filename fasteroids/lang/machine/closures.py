"""Expressions compiled to Python closures, once a program.

A closure takes the variables as a dictionary and a `Reading` of the world, and gives the value that the small steps
of `fasteroids.lang.machine.steps` would give, bit for bit. It charges the same too: every step of the expression, less
those that `&&` and `||` skipped, which they add to `Reading.skipped`. Where the small steps get stuck it raises
`Stuck`, and has changed nothing that matters, so the steps can be taken from the start of the expression.

Only well-typed expressions are compiled, on types that are known; so a closure tests none. This is safe because the
machine never lets a variable hold a value of another type than it was declared with.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import cos, inf, nan, sin, sqrt
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

from fasteroids.actions import View
from fasteroids.lang.machine.values import BINARY, GETTERS, UNARY, Seen, Sight, Stuck, Value
from fasteroids.lang.syntax import (
    Binary,
    Direction,
    Expression,
    Name,
    Null,
    Number,
    Self,
    Truth,
    Type,
    Unary,
)

__all__ = ["Closure", "Reading", "Typed", "typed"]


class Reading(Sight):
    """A sight for closures, which also counts the steps they skipped."""

    __slots__ = ("skipped",)

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self.skipped = 0


Closure: TypeAlias = Callable[[dict[str, Any], Reading], Any]


class Typed(NamedTuple):
    """A well-typed expression: its type, how many small steps it takes if nothing is skipped, its closure."""

    type: Type
    steps: int
    closure: Closure


def typed(e: Expression, types: Mapping[str, Type]) -> Typed | None:
    """An expression compiled among variables of these types; None if it is ill-typed."""
    match e:
        case Number(value):
            return Typed("double", 1, _constant(float(value)))
        case Truth(value):
            return Typed("bool", 1, _constant(value))
        case Null():
            return Typed("entity", 1, _constant(None))
        case Self():
            return Typed("entity", 1, lambda _, world: world.entity(world.self_id))
        case Direction():
            return Typed("double", 1, lambda _, world: world.direction)
        case Name(name):
            return Typed(types[name], 1, lambda env, _: env[name]) if name in types else None
        case Unary(operator, operand):
            inner = typed(operand, types)
            return inner and _unary(operator, inner)
        case Binary(operator, left, right):
            a, b = typed(left, types), typed(right, types)
            return a and b and _binary(operator, a, b)
    raise AssertionError(f"{e!r} has no value")


def _constant(value: Value) -> Closure:
    return lambda _env, _world: value


def _unary(operator: str, inner: Typed) -> Typed | None:
    if operator in GETTERS and inner.type == "entity":
        return Typed("double", inner.steps + 1, _getter(operator, inner.closure))
    if operator in UNARY and UNARY[operator][0] == inner.type:
        return Typed(UNARY[operator][1], inner.steps + 1, _UNARY[operator](inner.closure))
    return None


def _binary(operator: str, a: Typed, b: Typed) -> Typed | None:
    if operator in ("&&", "||"):
        if a.type != "bool" or b.type != "bool":
            return None
        # The small steps: left, test, and unless it decides, right and the operation.
        closure = _SHORT[operator](a.closure, b.closure, b.steps + 1)
        return Typed("bool", a.steps + b.steps + 2, closure)
    if operator not in BINARY or a.type != b.type:
        return None
    wanted, result, _ = BINARY[operator]
    if wanted not in (None, a.type):
        return None
    table = _ENTITIES if a.type == "entity" else _BINARY
    closure = table[operator](a.closure, b.closure)
    return Typed(result, a.steps + b.steps + 1, closure)


# Unary operations.


def _getter(operator: str, e: Closure) -> Closure:
    field: Callable[[Seen], float] = attrgetter(GETTERS[operator])

    def closure(env: dict[str, Any], world: Reading) -> float:
        entity = e(env, world)
        if entity is None:
            raise Stuck
        return field(entity)

    return closure


def _root(e: Closure) -> Closure:
    def closure(env: dict[str, Any], world: Reading) -> float:
        a = e(env, world)
        return sqrt(a) if a >= 0.0 else nan

    return closure


def _wave(function: Callable[[float], float]) -> Callable[[Closure], Closure]:
    def made(e: Closure) -> Closure:
        def closure(env: dict[str, Any], world: Reading) -> float:
            a = e(env, world)
            return function(a) if -inf < a < inf else nan

        return closure

    return made


_UNARY: dict[str, Callable[[Closure], Closure]] = {
    "-": lambda e: lambda env, world: -e(env, world),
    "!": lambda e: lambda env, world: not e(env, world),
    "sqrt": _root,
    "sin": _wave(sin),
    "cos": _wave(cos),
}


# Binary operations.


def _by_function(operator: str) -> Callable[[Closure, Closure], Closure]:
    function = BINARY[operator][2]
    return lambda a, b: lambda env, world: function(a(env, world), b(env, world))


_BINARY: dict[str, Callable[[Closure, Closure], Closure]] = {
    "+": lambda a, b: lambda env, world: a(env, world) + b(env, world),
    "-": lambda a, b: lambda env, world: a(env, world) - b(env, world),
    "*": lambda a, b: lambda env, world: a(env, world) * b(env, world),
    "/": _by_function("/"),
    "%": _by_function("%"),
    "<": lambda a, b: lambda env, world: a(env, world) < b(env, world),
    "<=": lambda a, b: lambda env, world: a(env, world) <= b(env, world),
    ">": lambda a, b: lambda env, world: a(env, world) > b(env, world),
    ">=": lambda a, b: lambda env, world: a(env, world) >= b(env, world),
    "==": lambda a, b: lambda env, world: a(env, world) == b(env, world),
    "!=": lambda a, b: lambda env, world: a(env, world) != b(env, world),
}

_ENTITIES: dict[str, Callable[[Closure, Closure], Closure]] = {
    "==": _by_function("=="),
    "!=": _by_function("!="),
}
"""Entities are compared by id."""


def _both(a: Closure, b: Closure, skipped: int) -> Closure:
    def closure(env: dict[str, Any], world: Reading) -> bool:
        if a(env, world):
            return b(env, world)  # type: ignore[no-any-return]
        world.skipped += skipped
        return False

    return closure


def _either(a: Closure, b: Closure, skipped: int) -> Closure:
    def closure(env: dict[str, Any], world: Reading) -> bool:
        if a(env, world):
            world.skipped += skipped
            return True
        return b(env, world)  # type: ignore[no-any-return]

    return closure


_SHORT: dict[str, Callable[[Closure, Closure, int], Closure]] = {"&&": _both, "||": _either}
