"""From a tree to its type errors: `types` is the table, `uses` and `variables` the names, `_checker` the rules."""

from fasteroids.lang.checker._checker import complaints as complaints
from fasteroids.lang.checker._checker import declared as declared

__all__ = [
    "complaints",
    "declared",
]
