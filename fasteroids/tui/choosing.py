"""Going from row to row of a pane, past those that lead nowhere. Pure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from fasteroids.tui.rows import Row

__all__ = ["next_leading"]


def next_leading(rows: Sequence[Row], at: int | None, step: Literal[1, -1]) -> int | None:
    """The next row below, or above, that leads to a place; from the last on to the first. None if no row leads there.

    With nothing to start from, the first or the last one.
    """
    leading = [i for i, each in enumerate(rows) if each.place is not None][::step]
    if not leading:
        return None
    beyond = [i for i in leading if at is not None and (i - at) * step > 0]
    return (beyond or leading)[0]
