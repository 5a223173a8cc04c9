"""Places in a text as editors count them: lines from 0, and in a line the units of an encoding.

The protocol's default unit is that of UTF-16: a character beyond U+FFFF, as most emoji are, is two. The package counts
lines and characters from 1 (`Span`).
"""

from __future__ import annotations

from typing import Final, Literal, NamedTuple

from fasteroids.lang.parser.lexer import lines
from fasteroids.lang.source import Span

__all__ = ["Encoding", "Page", "Position"]

Encoding = Literal["utf-8", "utf-16", "utf-32"]

_BYTES: Final[dict[Encoding, tuple[str, int]]] = {
    "utf-8": ("utf-8", 1),
    "utf-16": ("utf-16-le", 2),
    "utf-32": ("utf-32-le", 4),
}
"""The codec of an encoding, and how many bytes a unit has."""


class Position(NamedTuple):
    """A line and the units before a place in it, both from 0."""

    line: int
    character: int


class Page:
    """The lines of a text, and the unit that an editor counts in. Lines end in LF, CRLF or CR, as in the protocol."""

    def __init__(self, text: str, encoding: Encoding = "utf-16") -> None:
        self._rows = lines(text)
        self._codec, self._size = _BYTES[encoding]

    def place(self, position: Position) -> tuple[int, int]:
        """Line and column, from 1, of an editor's position.

        Behind the end of a line means its end, outside the text means its start or end, and within a character means
        its start.
        """
        line, units = position
        if line < 0:
            return 1, 1
        if line >= len(self._rows):
            return len(self._rows), len(self._rows[-1]) + 1
        row = self._rows[line]
        units = max(units, 0)
        if row.isascii():
            return line + 1, min(units, len(row)) + 1
        column = 1
        for character in row:
            units -= self._units(character)
            if units < 0:
                break
            column += 1
        return line + 1, column

    def position(self, line: int, column: int) -> Position:
        """An editor's position of a line and a column from 1. Outside the text means its nearest place."""
        if line > len(self._rows):
            line, column = len(self._rows), len(self._rows[-1]) + 1
        before = self._rows[line - 1][: column - 1]
        return Position(line - 1, len(before) if before.isascii() else self._units(before))

    def range(self, span: Span) -> tuple[Position, Position]:
        """An editor's positions of the start and the end of a piece."""
        return self.position(*span.start), self.position(*span.end)

    def _units(self, text: str) -> int:
        # An editor may send half of a pair of surrogates; it counts as any character of its size.
        return len(text.encode(self._codec, "surrogatepass")) // self._size
