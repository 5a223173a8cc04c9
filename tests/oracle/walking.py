"""Walking trees by their fields, whatever they are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs

__all__ = ["children", "depth", "nodes"]


def nodes(tree: Any) -> Iterator[Any]:
    """A node and all below it, in the order of the text."""
    yield tree
    for child in children(tree):
        yield from nodes(child)


def children(tree: Any) -> Iterator[Any]:
    """The nodes just below a node."""
    for field in attrs.fields(type(tree)):
        value = getattr(tree, field.name)
        for part in value if field.name == "statements" else (value,):
            if attrs.has(type(part)):
                yield part


def depth(tree: Any) -> int:
    """How many nodes there are from this one to the farthest leaf."""
    return 1 + max(map(depth, children(tree)), default=0)
