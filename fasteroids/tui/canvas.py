"""Surfaces made of cells of a terminal, drawn on with discs, lines and text.

A cell is about twice as high as wide. *Dots* cut it finer: Braille into 2 x 4, half blocks into 1 x 2, so that a dot is
about square. *Signs* (ASCII) leave it whole and choose a character by the slope of what passes through it. Every cell
has one colour, that of what was drawn last, so who matters most is drawn last.

Coordinates are in dots, x to the right and y downwards from the top left corner; the cell of a dot is found by
flooring. Radii are in widths of a dot. Nothing here raises for a number: what is not finite or not in sight is left
out. Outlines of discs are kept as *stamps*, one for each size and place within a cell.
"""

from __future__ import annotations

import codecs
import re
from abc import ABC, abstractmethod
from collections.abc import Iterator
from functools import lru_cache
from math import ceil, cos, floor, inf, sin, sqrt, tau
from typing import ClassVar, Final, NamedTuple, TypeAlias

__all__ = ["SURFACES", "Block", "Braille", "Canvas", "Cells", "Dots", "Signs", "canvas"]


class Cells(NamedTuple):
    """A row of cells: its text, and who painted it. Blank cells are spaces."""

    text: str
    runs: tuple[tuple[int, int, int], ...]
    """(first cell, cell after the last, index of a colour); what lies between runs is blank."""


Stamp: TypeAlias = tuple[tuple[int, int, int], ...]
"""(columns to the right, rows down, mask or character) of each cell it touches."""

_FAR: Final = 1e6  # dots; nothing that far out is in sight
_LARGEST: Final = 48.0  # dots; larger discs are drawn as polygons
_RUN: Final = re.compile(rb"([^\0])(?:\0*\1)*", re.DOTALL)


class Canvas(ABC):
    """A surface of `columns` x `rows` cells, `width` x `height` dots. Mutable: made, drawn on, read once."""

    across: ClassVar[int] = 1
    """Dots in a cell, from left to right."""
    down: ClassVar[int] = 1
    """Dots in a cell, from top to bottom."""
    signs: ClassVar[str] = ""
    """What a mask looks like, by mask."""

    def __init__(self, columns: int, rows: int) -> None:
        self.columns, self.rows = columns, rows
        self.width, self.height = columns * self.across, rows * self.down
        self._cells = bytearray(columns * rows)
        self._ink = bytearray(columns * rows)
        self._texts: list[tuple[int, int, str]] = []

    @property
    def tall(self) -> float:
        """The height of a dot over its width."""
        return 2.0 * self.across / self.down

    # Drawing.

    def begin_as(self, other: Canvas) -> None:
        """Take over the dots and characters, but no text, of a surface of the same kind and size."""
        self._cells[:], self._ink[:] = other._cells, other._ink

    def dot(self, x: float, y: float, colour: int, sign: str = "*") -> None:
        """One dot. `sign` is what it looks like where dots are characters."""
        if 0.0 <= x < self.width and 0.0 <= y < self.height:
            self._point(int(x), int(y), colour, sign)

    def line(
        self, x: float, y: float, to_x: float, to_y: float, colour: int, *, every: int = 1, sign: str = ""
    ) -> None:  # fmt: skip
        """A line, of which only every so many-th dot is drawn. `sign` replaces the characters of its slope."""
        seen = _clipped(x, y, to_x, to_y, self.width, self.height)
        if seen is None:
            return
        x, y, to_x, to_y = seen
        steps = ceil(max(abs(to_x - x), abs(to_y - y)))
        dx, dy = ((to_x - x) / steps, (to_y - y) / steps) if steps else (0.0, 0.0)
        sign = sign or _slope(dx, dy * self.tall)
        width, height, point = self.width, self.height, self._point
        for i in range(0, steps + 1, every):
            column, row = int(x + i * dx), int(y + i * dy)
            if column < width and row < height:
                point(column, row, colour, sign)

    def circle(
        self, x: float, y: float, radius: float, colour: int, *, sparse: bool = False
    ) -> None:
        """The outline of a disc; of one smaller than a dot, the dot. `sparse` leaves half of it out."""
        if not (abs(x) < _FAR and abs(y) < _FAR and radius < _FAR):
            return
        if radius >= _LARGEST:
            self._polygon(x, y, radius, colour, 2 if sparse else 1)
            return
        across, down = self.across, self.down
        column, row = floor(x / across), floor(y / down)
        stamp = self._stamp(x - column * across, y - row * down, radius, sparse)
        self._press(
            column,
            row,
            int(radius / across) + 2,
            int(radius / (down * self.tall)) + 2,
            stamp,
            colour,
        )

    def text(self, column: int, row: int, text: str, colour: int) -> None:
        """Text from a cell on, over whatever is drawn there; what leaves the surface is cut off."""
        if not 0 <= row < self.rows:
            return
        text = text[max(-column, 0) : max(self.columns - column, 0)]
        column = max(column, 0)
        if text:
            self._texts.append((row, column, text))
            at = row * self.columns + column
            self._ink[at : at + len(text)] = bytes([colour]) * len(text)

    def free(self, column: int, row: int, length: int) -> bool:
        """Are these cells on the surface, and blank?"""
        if not (0 <= row < self.rows and 0 <= column <= self.columns - length):
            return False
        at = row * self.columns + column
        return not any(self._ink[at : at + length])

    # Reading.

    def read(self) -> tuple[Cells, ...]:
        """The rows, from the top."""
        return tuple(self._rows())

    def _rows(self) -> Iterator[Cells]:
        columns, ink, cells, signs = self.columns, self._ink, self._cells, self.signs
        texts: dict[int, list[tuple[int, str]]] = {}
        for row, column, text in self._texts:
            texts.setdefault(row, []).append((column, text))
        for row in range(self.rows):
            start, end = row * columns, (row + 1) * columns
            line, _ = codecs.charmap_decode(cells[start:end], "strict", signs)
            for column, text in texts.get(row, ()):
                line = line[:column] + text + line[column + len(text) :]
            runs = tuple(
                (m.start() - start, m.end() - start, ink[m.start()])
                for m in _RUN.finditer(ink, start, end)
            )
            yield Cells(line, runs)

    # What surfaces differ in.

    @abstractmethod
    def _point(self, x: int, y: int, colour: int, sign: str) -> None:
        """The dot (x, y), which is on the surface."""

    @abstractmethod
    def _stamp(self, x: float, y: float, radius: float, sparse: bool) -> Stamp:
        """The outline of a disc with its centre at (x, y) of a cell."""

    @abstractmethod
    def _mark(self, at: int, mask: int) -> None:
        """Draw part of a stamp into a cell."""

    def _press(
        self, column: int, row: int, reach_x: int, reach_y: int, stamp: Stamp, colour: int
    ) -> None:
        """Draw a stamp; the reaches say how many cells it may go to each side."""
        columns, rows, ink, mark = self.columns, self.rows, self._ink, self._mark
        if (
            reach_x <= column < columns - reach_x and reach_y <= row < rows - reach_y
        ):  # all of it is in sight
            at = row * columns + column
            for right, under, mask in stamp:
                i = at + under * columns + right
                mark(i, mask)
                ink[i] = colour
            return
        for right, under, mask in stamp:
            if 0 <= column + right < columns and 0 <= row + under < rows:
                i = (row + under) * columns + column + right
                mark(i, mask)
                ink[i] = colour

    def _polygon(self, x: float, y: float, radius: float, colour: int, every: int) -> None:
        """A large circle, as the sides of it that are in sight."""
        sides = min(720, ceil(8.0 * sqrt(radius)))
        tall = self.tall
        corners = [
            (x + radius * cos(i * tau / sides), y + radius * sin(i * tau / sides) / tall)
            for i in range(sides)
        ]
        for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
            self.line(ax, ay, bx, by, colour, every=every)


class Dots(Canvas):
    """A surface whose cells show any set of their dots; a mask has a bit for each."""

    bits: ClassVar[tuple[tuple[int, ...], ...]]
    """The bit of a dot, by its row and column in the cell."""

    def _point(self, x: int, y: int, colour: int, sign: str) -> None:  # noqa: ARG002
        row, under = divmod(y, self.down)
        column, right = divmod(x, self.across)
        i = row * self.columns + column
        self._cells[i] |= self.bits[under][right]
        self._ink[i] = colour

    def _stamp(self, x: float, y: float, radius: float, sparse: bool) -> Stamp:
        return _dotted(self.bits, int(x), int(y), round(radius), sparse)

    def _mark(self, at: int, mask: int) -> None:
        self._cells[at] |= mask


class Braille(Dots):
    """2 x 4 dots a cell. The blank cell is a space, which is shorter to send than the empty Braille sign."""

    across = 2
    down = 4
    bits = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
    signs = " " + "".join(map(chr, range(0x2801, 0x2900)))


class Block(Dots):
    """1 x 2 dots a cell: the upper half, the lower half, or the full block."""

    down = 2
    bits = ((1,), (2,))
    signs = " ▀▄█"


class Signs(Canvas):
    """Plain ASCII: a cell is one dot, and shows the character written last."""

    signs = " " + "".join(map(chr, range(1, 127)))

    def _point(self, x: int, y: int, colour: int, sign: str) -> None:
        i = y * self.columns + x
        self._cells[i] = ord(sign)
        self._ink[i] = colour

    def _stamp(self, x: float, y: float, radius: float, sparse: bool) -> Stamp:
        if radius < 1.5:
            return ((0, 0, ord(":" if sparse else "o" if radius < 0.75 else "O")),)
        return _written(round(x * 2.0), round(y * 2.0), round(radius * 2.0), sparse)

    def _mark(self, at: int, mask: int) -> None:
        self._cells[at] = mask


SURFACES: Final[dict[str, type[Canvas]]] = {"ascii": Signs, "braille": Braille, "block": Block}
"""The surfaces by name."""


def canvas(name: str, columns: int, rows: int) -> Canvas:
    """An empty surface. KeyError for a name that is not in `SURFACES`."""
    return SURFACES[name](columns, rows)


@lru_cache(maxsize=8192)
def _dotted(bits: tuple[tuple[int, ...], ...], x: int, y: int, radius: int, sparse: bool) -> Stamp:
    """A circle around the dot (x, y) of a cell; whole radii give the smoothest ones."""
    half = [(i, round(sqrt(radius * radius - i * i))) for i in range(-radius, radius + 1)]
    dots = {(i, s * j) for i, j in half for s in (-1, 1)}
    dots |= {(j, i) for i, j in dots}
    down, across = len(bits), len(bits[0])
    cells: dict[tuple[int, int], int] = {}
    for i, j in dots:
        if sparse and (i + j) % 2:
            continue
        row, under = divmod(y + j, down)
        column, right = divmod(x + i, across)
        cells[column, row] = cells.get((column, row), 0) | bits[under][right]
    return tuple((column, row, mask) for (column, row), mask in sorted(cells.items()))


@lru_cache(maxsize=8192)
def _written(halves_x: int, halves_y: int, halves: int, sparse: bool) -> Stamp:
    """A circle of characters around a place in a cell, its radius in columns: all in halves, to be symmetric."""
    x, y, radius = halves_x / 2.0, halves_y / 2.0, halves / 2.0
    steps = 64 * ceil(radius) + 64
    arcs: dict[tuple[int, int], list[tuple[float, float]]] = {}
    for i in range(steps):
        angle = (i + 0.5) * tau / steps
        right, under = radius * cos(angle), -radius * sin(angle) / 2.0
        arcs.setdefault((floor(x + right), floor(y + under)), []).append((right, under))
    least = 0.55 / (
        radius * tau / steps
    )  # a cell that less than 0.55 columns of arc pass is left blank
    stamp = []
    for (column, row), places in sorted(arcs.items()):
        if len(places) < least or (sparse and (column + row) % 2):
            continue
        right = sum(place[0] for place in places) / len(places)
        under = sum(place[1] for place in places) / len(places)
        sign = ":" if sparse else _rim(right, 2.0 * under, y + under - row)
        stamp.append((column, row, ord(sign)))
    return tuple(stamp)


def _rim(right: float, under: float, height: float) -> str:
    """The character of a circle at a place seen from its centre; `height`, 0 to 1, is how far down its cell that is."""
    if abs(under) > 2.0 * abs(right):
        return "'" if height < 0.3 else "-" if height < 0.7 else "_"
    if abs(right) > 2.4 * abs(under):
        return ")" if right > 0.0 else "("
    return "\\" if (right > 0.0) == (under < 0.0) else "/"


def _slope(dx: float, dy: float) -> str:
    """The character of a line; y points down."""
    if abs(dy) <= 0.5 * abs(dx):
        return "-"
    if abs(dy) >= 4.0 * abs(dx):
        return "|"
    return "\\" if (dx > 0.0) == (dy > 0.0) else "/"


def _clipped(
    x: float, y: float, to_x: float, to_y: float, width: float, height: float
) -> tuple[float, float, float, float] | None:
    """The part of a line within [0, width] x [0, height], or None (Liang and Barsky, 1984)."""
    dx, dy = to_x - x, to_y - y
    if not (abs(dx) < inf and abs(dy) < inf and abs(x) < inf and abs(y) < inf):
        return None
    enter, leave = 0.0, 1.0
    for step, room in ((-dx, x), (dx, width - x), (-dy, y), (dy, height - y)):
        if step == 0.0:
            if room < 0.0:
                return None
        elif step < 0.0:
            enter = max(enter, room / step)
        else:
            leave = min(leave, room / step)
    if enter > leave:
        return None
    ax, ay, bx, by = x + enter * dx, y + enter * dy, x + leave * dx, y + leave * dy
    return (
        min(max(ax, 0.0), width), min(max(ay, 0.0), height),
        min(max(bx, 0.0), width), min(max(by, 0.0), height),
    )  # fmt: skip
