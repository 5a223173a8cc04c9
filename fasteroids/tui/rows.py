"""Rows of a pane: text of an exact number of cells, pieces of it in a style, and the moment it leads to.

A row is a value that any terminal can show. What a style looks like is the shell's business; without colours every
pane still says the same, as no row tells by its style alone what its text does not.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from enum import IntEnum
from textwrap import wrap
from typing import Final, Literal, NamedTuple, TypeAlias

from fasteroids.history import Place
from fasteroids.lang.report import cells, legible

__all__ = [
    "Piece",
    "Row",
    "Run",
    "Style",
    "blank",
    "clock",
    "filled",
    "fitted",
    "next_leading",
    "paragraph",
    "row",
]


class Style(IntEnum):
    """How a piece of a row looks. `PLAIN` needs no run."""

    PLAIN = 0
    DIM = 1
    TITLE = 2
    VALUE = 3
    LINK = 4
    """It leads to a moment."""
    CURSOR = 5
    """The moment or the step where one stands."""
    CHANGED = 6
    GOOD = 7
    WARNING = 8
    BAD = 9


Run: TypeAlias = tuple[int, int, int]
"""Characters of a text, from and up to but not with, and the index of their style."""

Piece: TypeAlias = str | tuple[str, Style]
"""Text, in a style if one is given."""


class Row(NamedTuple):
    """One row. Runs do not overlap and are in order; `place`, if any, is where a click or Enter leads."""

    text: str
    runs: tuple[Run, ...] = ()
    place: Place | None = None


def row(width: int, *pieces: Piece, place: Place | None = None) -> Row:
    """The row of these pieces, cut or filled with blanks to a width in cells. What a terminal would obey is escaped."""
    text, runs = "", []
    for piece in pieces:
        bare, style = (piece, Style.PLAIN) if isinstance(piece, str) else piece
        start, text = len(text), text + legible(bare)
        if style and len(text) > start:
            runs.append((start, len(text), int(style)))
    fit = fitted(text, width)
    end = len(fit) if fit.startswith(text) else fit.rfind(">")  # the sign of a cut has no style
    kept = tuple((a, min(b, end), style) for a, b, style in runs if a < end)
    return Row(fit, kept, place)


def fitted(text: str, width: int) -> str:
    """Legible text in exactly so many cells: filled with blanks, or cut, with `>` at its end for what is left out."""
    room = width - cells(text)
    if room >= 0:
        return text + " " * room
    if width <= 0:
        return ""
    kept, used = "", 0
    for c in text:
        wide = cells(c)
        if used + wide > width - 1:
            break
        kept, used = kept + c, used + wide
    return f"{kept}>{' ' * (width - 1 - used)}"


def blank(width: int) -> Row:
    """An empty row."""
    return Row(" " * max(width, 0))


def filled(rows: Sequence[Row], width: int, height: int) -> tuple[Row, ...]:
    """The first rows, and empty ones below, so that there are exactly `height`."""
    height = max(height, 0)
    return (*rows[:height], *(blank(width) for _ in range(height - len(rows))))


def paragraph(
    width: int, sentence: str, style: Style = Style.PLAIN, *, place: Place | None = None
) -> Iterator[Row]:
    """A sentence on as many rows as it needs, each of which leads to the place."""
    bound = _UNIT.sub(lambda found: found[0].replace(" ", _BOND), legible(sentence))
    indent = "  " if width > _WIDE else ""
    for line in wrap(bound, max(width, 1), subsequent_indent=indent):
        yield row(width, (line.replace(_BOND, " "), style), place=place)


def next_leading(rows: Sequence[Row], at: int | None, step: Literal[1, -1]) -> int | None:
    """The next row below, or above, that leads to a place; from the last on to the first. None if no row leads there.

    With nothing to start from, the first or the last one.
    """
    leading = [i for i, each in enumerate(rows) if each.place is not None][::step]
    if not leading:
        return None
    beyond = [i for i in leading if at is not None and (i - at) * step > 0]
    return (beyond or leading)[0]


_UNIT: Final = re.compile(r"\d s\b")
_BOND: Final = "\x00"  # stands for a blank at which no row ends; legible text has none
_WIDE: Final = 10


def clock(time: float, digits: int = 3) -> str:
    """A time for people, s: to the millisecond, or with so many digits after the point."""
    return f"{time:.{digits}f}" if time < 1e9 else f"{time:.9g}"
