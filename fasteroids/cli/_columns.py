"""Tables of plain text."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from fasteroids.lang.report import cells

__all__ = ["aligned"]


def aligned(rows: Sequence[Sequence[str]], *, right: Collection[int] = ()) -> list[str]:
    """Rows of equal length as lines with their columns aligned, those of the numbers in `right` at their ends."""
    widths = [max(map(cells, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(
            _padded(cell, width, right=i in right)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _padded(cell: str, width: int, *, right: bool) -> str:
    """The cell with blanks before or after it."""
    blanks = " " * (width - cells(cell))
    return blanks + cell if right else cell + blanks
