"""Records made without ceremony, for the fold's hot path.

A frozen attrs class sets each field through `object.__setattr__` and then validates; for the records an event
makes that costs more than its physics. `raw(cls)` gives a constructor for values that are valid already: it
fills a mutable twin with the same slots and turns it into `cls` as its last act. Nobody ever holds the twin,
so the records stay as frozen as any. benchmarks/README.md has the figures.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from attrs import fields

__all__ = ["raw"]

T = TypeVar("T")


def raw(cls: type[T]) -> Callable[..., T]:
    """A constructor of `cls` that takes every slot by position, in the order of its fields, and checks nothing.

    `cls` is a frozen, slotted attrs class without weak references.
    """
    names = tuple(a.name for a in fields(cls))  # type: ignore[arg-type]
    assert tuple(cls.__slots__) == names, f"{cls.__name__} is not a plain slotted record"  # type: ignore[attr-defined]
    lines = [f"def __init__(self, {', '.join(names)}):"]
    lines += [f"    self.{name} = {name}" for name in names]
    lines += ["    self.__class__ = cls"]
    scope: dict[str, Any] = {"cls": cls}
    exec("\n".join(lines), scope)
    body = {"__slots__": names, "__init__": scope["__init__"]}
    return type(f"_Raw{cls.__name__}", cls.__bases__, body)
