"""The cells in which neighbours are looked for.

A rectangular grid over the world, with a rim of empty cells so that every cell has eight neighbours. A cell is
wider than the largest contact distance by a margin that covers rounding, so two discs in contact are always in
the same or in neighbouring cells, and were known to be before they touched. "All with all" is a grid of one cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt, ulp

from fasteroids.entities import Entity
from fasteroids.units import SPEED_OF_LIGHT, WINDOW

__all__ = ["Grid", "fitting"]

_MARGIN = 1.0 + 2.0**-20
_SHY = 2.0**-24
_CELLS_PER_DISC = 3.0


class Grid:
    """`columns` x `rows` cells over a world of `width` x `height` km; cells hold slots.

    `around` are the offsets of a cell's neighbourhood; `ahead[delta]` those of the three cells that become
    neighbours by a step of `delta`. `lefts[cell]`, `rights`, `bottoms` and `tops` are a cell's borders (km), None
    where a wall lies there. `shy` (km) is a small part of the spare room, by which a disc may be late.
    """

    __slots__ = (
        "ahead", "around", "bottoms", "cells", "columns", "height", "lefts", "rights", "rows", "shy", "stride", "tops",
        "width",
    )  # fmt: skip

    def __init__(self, width: float, height: float, columns: int, rows: int) -> None:
        self.width, self.height, self.columns, self.rows = width, height, columns, rows
        stride = self.stride = rows + 2
        self.cells: list[list[int]] = [[] for _ in range((columns + 2) * stride)]
        self.around: tuple[int, ...] = (0,)
        self.ahead: dict[int, tuple[int, ...]] = {}
        if columns * rows > 1:
            self.around = tuple(dx + dy for dx in (-stride, 0, stride) for dy in (-1, 0, 1))
            for step in (-1, 1):
                self.ahead[step] = (step - stride, step, step + stride)
                self.ahead[step * stride] = (step * stride - 1, step * stride, step * stride + 1)
        self.shy = min(width / columns, height / rows) * _SHY
        lefts, rights = _borders(width, columns)
        self.lefts = [border for border in lefts for _ in range(stride)]
        self.rights = [border for border in rights for _ in range(stride)]
        bottoms, tops = _borders(height, rows)
        self.bottoms, self.tops = bottoms * (columns + 2), tops * (columns + 2)

    def box(self, cell: int) -> tuple[float | None, float | None, float | None, float | None]:
        """Left, right, bottom and top border (km) of a cell, moved outwards by a small part of the spare room.

        Who is beyond such a border is beyond that of the cell as well, whatever rounding does.
        """
        shy = self.shy
        left, right = self.lefts[cell], self.rights[cell]
        bottom, top = self.bottoms[cell], self.tops[cell]
        return (
            None if left is None else left - shy,
            None if right is None else right + shy,
            None if bottom is None else bottom - shy,
            None if top is None else top + shy,
        )

    def cell_at(self, x: float, y: float) -> int:
        """The index of the cell around a place (km) in or near the world."""
        column = int(x / self.width * self.columns) + 1 if self.columns > 1 else 1
        row = int(y / self.height * self.rows) + 1 if self.rows > 1 else 1
        return min(max(column, 1), self.columns) * self.stride + min(max(row, 1), self.rows)


def _borders(size: float, cells: int) -> tuple[list[float | None], list[float | None]]:
    """The lower and the upper border (km) of each column or row, the rim's included; None for a wall."""
    inner: list[float | None] = [i * (size / cells) for i in range(1, cells)]
    return [None, None, *inner, None], [None, *inner, None, None]


def fitting(width: float, height: float, discs: Sequence[Entity]) -> tuple[int, int]:
    """Columns and rows of a good grid for these discs; (1, 1) where cells cannot help.

    About three cells a disc, none narrower than the largest contact distance 2 r. The spare room must cover
    what rounding does to positions (a few ulps of the world's size, and the way flown within the resolution of
    late moments); it does not when the discs are tiny against the world or the clock, and then there is no grid.
    """
    if not discs:
        return 1, 1
    contact = 2.0 * max(e.radius for e in discs)
    rounding = 8.0 * ulp(max(width, height)) + 8.0 * SPEED_OF_LIGHT * ulp(WINDOW)
    least = max(contact * _MARGIN, contact + rounding)
    most = int(_CELLS_PER_DISC * len(discs))
    side = max(least, sqrt(width) * sqrt(height) / sqrt(most))
    columns = max(1, int(min(width / side, most)))
    rows = max(1, int(min(height / side, most)))
    return (columns, rows) if max(columns, rows) > 2 else (1, 1)
