"""Diagnostics as text for people: the place, one sentence, the source with the pieces underlined, a hint.

    hunter.ast:4:1: error FA110: `target` is declared double, but used as an entity throughout
      4 | double target;
        | ^^^^^^ declared double here
      9 | target := null;
        | ------ set to an entity here
      hint: Declare it `entity target;`

The source may be anything, also what a terminal would obey: characters that do not print are shown as escapes
(`\\x1b`), tabs as four blanks, and the underlining counts the cells that characters take, not characters. A very long
line is cut around the piece underlined.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from itertools import groupby
from typing import Final, Literal
from unicodedata import category, east_asian_width

from attrs import frozen

from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.source import Span

__all__ = ["WIDEST", "Paint", "Role", "cells", "legible", "rendered"]

WIDEST: Final = 96
"""Cells of source that are shown of a line."""

_TAB: Final = "    "
_CUT: Final = "..."

Role = Literal["place", "error", "warning", "message", "gutter", "mark", "note", "hint"]
Paint = Callable[[Role, str], str]
"""Gives a piece of text the look of its role; it must add no cells."""


def _plain(_role: Role, text: str) -> str:
    return text


def rendered(
    diagnostics: Iterable[Diagnostic], source: str, name: str, *, paint: Paint = _plain
) -> str:
    """All of them, with an empty line between two, and none at the end; nothing for none. Never raises.

    `name` is what to call the source in the places. Places outside the source show an empty line.
    """
    lines = _LINE_END.split(source)
    return "\n\n".join(_one(each, lines, legible(name), paint) for each in diagnostics)


_LINE_END: Final = re.compile(r"\r\n?|\n")


def legible(text: str) -> str:
    """Text with every character that does not print, or has no width, as an escape. So a terminal obeys none."""
    return text if text.isascii() and text.isprintable() else "".join(map(_shown, text))


def cells(text: str) -> int:
    """The cells of a terminal that a `legible` text takes: two for each wide character, as those of Chinese."""
    return sum(map(_width, text))


def _one(each: Diagnostic, lines: Sequence[str], name: str, paint: Paint) -> str:
    place = paint("place", f"{name}:{each.span.line}:{each.span.column}:")
    kind = paint(each.severity, f"{each.severity} {each.code}:")
    rows = [f"{place} {kind} {paint('message', legible(each.message))}"]
    rows += _excerpt(each, lines, paint)
    if each.hint:
        rows.append(f"  {paint('hint', 'hint:')} {legible(each.hint)}")
    return "\n".join(rows)


# The excerpt.


@frozen
class _Mark:
    """A piece of one line to underline: its columns, and what to say of it. `sign` is `^` for the main piece."""

    line: int
    start: int
    end: int
    label: str
    sign: Literal["^", "-"]


def _mark(span: Span, label: str, sign: Literal["^", "-"], lines: Sequence[str]) -> _Mark:
    """The part of a piece that lies in its first line."""
    end = span.end_column
    if span.end_line > span.line:
        label = f"{label} ... to line {span.end_line}" if label else f"... to line {span.end_line}"
        end = len(_line(lines, span.line)) + 1
    return _Mark(span.line, span.column, max(end, span.column + 1), legible(label), sign)


def _line(lines: Sequence[str], number: int) -> str:
    return lines[number - 1] if 0 < number <= len(lines) else ""


def _excerpt(each: Diagnostic, lines: Sequence[str], paint: Paint) -> list[str]:
    """The lines spoken of, in their order, each once, with its marks below."""
    marks = [_mark(each.span, each.label, "^", lines)]
    marks += [_mark(note.span, note.text, "-", lines) for note in each.notes]
    marks.sort(key=lambda mark: (mark.line, mark.start))
    wide = max(3, *(len(str(mark.line)) for mark in marks))
    bar = paint("gutter", f"{'':{wide}} |")
    rows = []
    for number, group in groupby(marks, key=lambda mark: mark.line):
        text = _line(lines, number)
        shown = None
        for row in _together(list(group), short=len(text) <= WIDEST):
            view = _View(text, row[0])
            if view.text != shown:
                shown = view.text
                rows.append(f"{paint('gutter', f'{number:{wide}} |')} {shown}".rstrip())
            rows.append(f"{bar} {_underlined(row, view, paint)}")
    return rows


def _together(marks: list[_Mark], *, short: bool) -> list[list[_Mark]]:
    """The marks of one line, those in one row together: they say the same, and do not touch."""
    rows: list[list[_Mark]] = []
    for mark in marks:
        last = rows[-1][-1] if rows else None
        if (
            short
            and last is not None
            and (last.label, last.sign) == (mark.label, mark.sign)
            and last.end < mark.start
        ):
            rows[-1].append(mark)
        else:
            rows.append([mark])
    return rows


def _underlined(row: Sequence[_Mark], view: _View, paint: Paint) -> str:
    told, at = "", 0
    for mark in row:
        start, end = view.cells(mark.start), view.cells(mark.end)
        role: Role = "mark" if mark.sign == "^" else "note"
        told += " " * (start - at) + paint(role, mark.sign * max(end - start, 1))
        at = start + max(end - start, 1)
    label = row[-1].label
    return f"{told} {paint(role, label)}" if label else told


# Characters and cells.


def _shown(c: str) -> str:
    """How one character is shown: itself, four blanks for a tab, an escape if it cannot be seen."""
    if c == "\t":
        return _TAB
    if c.isprintable() and category(c) not in ("Mn", "Me"):
        return c
    return c.encode("unicode_escape").decode("ascii")


def _width(c: str) -> int:
    """The cells of a character as shown."""
    if " " <= c <= "~":
        return 1
    shown = _shown(c)
    return 2 if shown == c and east_asian_width(c) in "WF" else len(shown)


class _View:
    """What is shown of a line, and where the columns of its text are in that.

    All of a line that fits; of others `WIDEST` cells with the start of the marked piece in them.
    """

    def __init__(self, line: str, mark: _Mark) -> None:
        first, last = mark.start - 1, min(mark.end - 1, mark.start - 1 + WIDEST)
        # Every character takes a cell at least, so nothing further away can be shown.
        low = max(0, first - WIDEST)
        near = line[low : last + WIDEST]
        widths = [_width(c) for c in near]
        start, stop = 0, len(near)
        if low or last + WIDEST < len(line) or sum(widths) > WIDEST:
            start, stop = _window(widths, min(first - low, len(near)), min(last - low, len(near)))
        left = _CUT if low + start > 0 else ""
        right = _CUT if low + stop < len(line) else ""
        self.text = left + "".join(_shown(c) for c in near[start:stop]) + right
        self._first = low + start
        self._widths = widths[start:stop]
        self._before = len(left)

    def cells(self, column: int) -> int:
        """The cells before a column; before one that is not shown, up to the edge."""
        count = max(column - 1 - self._first, 0)
        return self._before + sum(self._widths[:count])


def _window(widths: Sequence[int], start: int, stop: int) -> tuple[int, int]:
    """The stretch of characters to show: the marked one from its start, a third of the room before it, the rest."""
    room = WIDEST - 2 * len(_CUT)
    low = high = start
    while low > 0 and sum(widths[low - 1 : start]) <= room // 3:
        low -= 1
    room -= sum(widths[low:start])
    while high < len(widths) and room >= widths[high]:
        room -= widths[high]
        high += 1
    while low > 0 and room >= widths[low - 1]:
        low -= 1
        room -= widths[low]
    return low, max(high, min(start + 1, stop))
