"""What programs compute with: values, and every operation on them as a total function of the right types.

A value is a double, a truth, an entity or null (assignment 1.8.3). Doubles follow IEEE 754 where Python would raise:
1 / 0 is inf, 0 / 0 and the root of a negative number are nan. So on operands of the right types every operation has
a result but one: an entity's coordinates, asked of null. Where an operation has no rule `Stuck` is raised, which the
machine turns into a value of its own; it never leaves this package.

An entity in a program is a `Seen`, its state when it was last looked at. A world does not change during a tick, so a
`Sight` looks at each entity once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from math import copysign, inf, nan
from typing import Final, Literal, TypeAlias

from attrs import frozen
from pyrsistent import PList, plist

from fasteroids._raw import raw
from fasteroids.actions import View
from fasteroids.lang.syntax import Kind, Type

__all__ = [
    "BINARY",
    "DEFAULTS",
    "GETTERS",
    "UNARY",
    "Seen",
    "Sight",
    "Stuck",
    "Value",
    "binary",
    "exact",
    "look",
    "same",
    "shown",
    "type_of",
    "unary",
    "visited",
]


@frozen(weakref_slot=False)
class Seen:
    """An entity as it was last seen: km, km/s. It may be dead by now; then this is its last state.

    Records are equal field by field. For a program two of them are the same entity if they have the same id.
    """

    id: int
    kind: Literal["ship", "asteroid", "bullet"]
    x: float
    y: float
    vx: float
    vy: float
    radius: float


Value: TypeAlias = float | bool | Seen | None

DEFAULTS: Final[dict[Type, Value]] = {"bool": False, "double": 0.0, "entity": None}
"""What a variable holds before anything is assigned to it (1.8.3)."""

_seen = raw(Seen)


def look(view: View, entity_id: int) -> Seen | None:
    """An entity as it is now, or None if it is dead.

    Without signs of zeros: entities that differ in those are equal, and 1 / getvx must not tell them apart.
    """
    e = view.entity(entity_id)
    if e is None or type(e) is Seen:
        return e
    return _seen(entity_id, e.kind, e.x + 0.0, e.y + 0.0, e.vx + 0.0, e.vy + 0.0, e.radius)


class Sight:
    """A view that counts and looks at each entity once. For one tick: it remembers."""

    __slots__ = ("_ids", "_known", "_view", "direction", "fuel", "self_id")

    def __init__(self, view: View) -> None:
        self._view = view
        self._known: dict[int, Seen | None] = {}
        self._ids: dict[str, tuple[int, ...]] = {}
        self.self_id, self.direction, self.fuel = view.self_id, view.direction, view.fuel

    def ids(self, kind: Kind) -> tuple[int, ...]:
        """The ids of all entities of a kind, ascending."""
        if kind not in self._ids:
            self._ids[kind] = self._view.ids(kind)
        return self._ids[kind]

    def entity(self, entity_id: int) -> Seen | None:
        """An entity at this moment, or None if it is dead."""
        known = self._known
        if entity_id not in known:
            known[entity_id] = look(self._view, entity_id)
        return known[entity_id]


def visited(view: View, kind: Kind) -> PList[Seen]:
    """Whom a for-each visits: the living of a kind, in ascending order of ids."""
    looks = (look(view, entity_id) for entity_id in view.ids(kind))
    return plist([seen for seen in looks if seen is not None])


def type_of(value: Value) -> Type:
    """The type of a value; null is an entity."""
    kind = type(value)
    return "double" if kind is float else "bool" if kind is bool else "entity"


def shown(value: Value) -> str:
    """A value as `print` shows it: `0.25`, `inf`, `nan`, `true`, `null`, `ship 3`."""
    if value is None:
        return "null"
    if isinstance(value, Seen):
        return f"{value.kind} {value.id}"
    return repr(value).lower()


def exact(value: Value) -> Hashable:
    """What stands for a value where machines are compared: to the bit, but nan equals nan, and 1.0 is not true."""
    if type(value) is float:
        return value.hex()
    if isinstance(value, Seen):
        state = (value.x, value.y, value.vx, value.vy, value.radius)
        return value.id, value.kind, *(s.hex() for s in state)
    return value


# Operations.


class Stuck(Exception):  # noqa: N818 - not an error of ours, but the semantics' word for it
    """An operation that has no rule. The text says which, with its values."""


def _divided(a: float, b: float) -> float:
    try:
        return a / b
    except ZeroDivisionError:
        return nan if a == 0.0 or a != a else copysign(inf, a) * copysign(1.0, b)


def _modulo(a: float, b: float) -> float:
    """a - b floor(a / b), of b's sign, as Python has it; nan where a is infinite or b is 0."""
    try:
        return a % b
    except ZeroDivisionError:
        return nan


def _total(function: Callable[[float], float]) -> Callable[[float], float]:
    """A function that is nan where Python's raises."""

    def result(a: float) -> float:
        try:
            return function(a)
        except ValueError:
            return nan

    return result


def same(a: Value, b: Value) -> bool:
    """The language's `==` of two values of one type: IEEE for doubles, by id for entities."""
    if isinstance(a, Seen) and isinstance(b, Seen):
        return a.id == b.id
    return a == b


def _other(a: Value, b: Value) -> bool:
    return not same(a, b)


BINARY: Final[dict[str, tuple[Type | None, Type, Callable[..., Value]]]] = {
    "+": ("double", "double", lambda a, b: a + b),
    "-": ("double", "double", lambda a, b: a - b),
    "*": ("double", "double", lambda a, b: a * b),
    "/": ("double", "double", _divided),
    "%": ("double", "double", _modulo),
    "<": ("double", "bool", lambda a, b: a < b),
    "<=": ("double", "bool", lambda a, b: a <= b),
    ">": ("double", "bool", lambda a, b: a > b),
    ">=": ("double", "bool", lambda a, b: a >= b),
    "==": (None, "bool", same),
    "!=": (None, "bool", _other),
}
"""Type of both operands (None: any, but the same), type of the result, and the function. `&&` and `||` are no
functions of two values, since they may not look at the second."""

GETTERS: Final = {"getx": "x", "gety": "y", "getvx": "vx", "getvy": "vy", "getradius": "radius"}
"""Which field of an entity a getter reads."""

UNARY: Final[dict[str, tuple[Type, Type, Callable[..., Value]]]] = {
    "-": ("double", "double", lambda a: -a),
    "!": ("bool", "bool", lambda a: not a),
    "sqrt": ("double", "double", _total(math.sqrt)),
    "sin": ("double", "double", _total(math.sin)),
    "cos": ("double", "double", _total(math.cos)),
}
"""Type of the operand, type of the result, and the function, for all but the getters."""


def unary(operator: str, a: Value) -> Value:
    """The value of a unary operation; `Stuck` if it has no rule."""
    if operator in GETTERS:
        if isinstance(a, Seen):
            return getattr(a, GETTERS[operator])  # type: ignore[no-any-return]
    else:
        rule = UNARY.get(operator)
        if rule is not None and rule[0] == type_of(a):
            return rule[2](a)
    gap = "" if operator in ("-", "!") else " "
    raise Stuck(f"{operator}{gap}{shown(a)}")


def binary(operator: str, a: Value, b: Value) -> Value:
    """The value of a binary operation other than `&&` and `||`; `Stuck` if it has no rule."""
    rule = BINARY.get(operator)
    kind = type_of(a)
    if rule is not None and kind == type_of(b) and (rule[0] is None or rule[0] == kind):
        return rule[2](a, b)
    raise Stuck(f"{shown(a)} {operator} {shown(b)}")
