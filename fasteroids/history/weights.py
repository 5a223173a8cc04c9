"""How much memory a state costs beside the one before it, with which it shares what did not change."""

from __future__ import annotations

from gc import get_referents
from sys import getsizeof
from typing import Any, Final

from pyrsistent import PMap, PVector

from fasteroids.lang.machine.code import Code
from fasteroids.state import World

__all__ = ["fresh"]

_SHARED: Final = (type, str, bool, type(None), Code)
"""What is never counted: classes, what Python holds anyway, and the code of a program, one for all its states."""

_NODE: Final = getsizeof([None] * 32)
"""Bytes of a node of a persistent vector; a change copies those on the way to it."""

_BUCKET: Final = getsizeof([None]) + getsizeof((None, None))
"""Bytes of a bucket of a persistent map with one key."""


_PARTS: Final = ("clock", "flights", "roster")


def fresh(new: object, old: object) -> int:
    """Bytes of what can be reached from `new` and is not at the same place in `old`: an estimate, rather too high.

    The two are walked side by side and left where they are the same object, so that the price of a walk is that of
    the difference. What stands at another place counts as new, unless it has been counted.
    """
    seen: set[int] = set()
    total, todo = 0, [(new, old)]
    while todo:
        a, b = todo.pop()
        if a is b or isinstance(a, _SHARED) or id(a) in seen:
            continue
        seen.add(id(a))
        size, pairs = _opened(a, b)
        total += size
        todo += pairs
    return total


def _opened(a: Any, b: Any) -> tuple[int, list[tuple[Any, Any]]]:
    """Bytes of a thing itself, and its parts beside those of another."""
    size = getsizeof(a)
    if isinstance(a, float | int):
        return size, []
    if isinstance(a, World):  # without the cache of predictions, which moves on with time
        b = b if isinstance(b, World) else None
        return size, [(getattr(a, name), getattr(b, name, None)) for name in _PARTS]
    if isinstance(a, PMap):
        others = b if isinstance(b, PMap) else {}
        parts = [(v, others.get(k)) for k, v in a.items() if v is not others.get(k)]
        return size + _way(len(a)) + _BUCKET * len(parts), parts
    if isinstance(a, PVector):
        beside = list(b) if isinstance(b, PVector) else []
        beside += [None] * (len(a) - len(beside))
        return size + _way(len(a)), [(x, y) for x, y in zip(a, beside, strict=False) if x is not y]
    parts = get_referents(a)
    beside = get_referents(b) if type(a) is type(b) else []
    beside += [None] * (len(parts) - len(beside))
    return size, list(zip(parts, beside, strict=False))


def _way(length: int) -> int:
    """Bytes of the nodes on the way to one of so many elements, and of the tail."""
    nodes = 1
    while length > 32:
        length //= 32
        nodes += 1
    return _NODE * nodes
