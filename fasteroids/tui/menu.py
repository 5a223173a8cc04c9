"""A menu as a value: entries, the chosen one, what is in sight. Pure, and in ASCII if its texts are."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, Generic, TypeVar

from attrs import evolve, frozen

from fasteroids.tui import palette
from fasteroids.tui.canvas import Row

__all__ = ["Entry", "Menu", "heading", "hit", "lines", "listed", "moved", "pictured", "put"]

T = TypeVar("T")

_MARK: Final = "> "
_GAP: Final = 3
"""Blanks between a label and what is said of it."""


@frozen
class Entry(Generic[T]):
    """Something to choose: what is shown, what it stands for, and what is said of it."""

    label: str
    value: T
    detail: str = ""


@frozen
class Menu(Generic[T]):
    """Entries, the number of the chosen one, and of the first one in sight."""

    entries: tuple[Entry[T], ...]
    at: int = 0
    top: int = 0

    @property
    def chosen(self) -> Entry[T] | None:
        """The chosen entry; None if there are no entries."""
        return self.entries[self.at] if self.entries else None

    @property
    def width(self) -> int:
        """The columns that show all of every entry."""
        details = max((len(each.detail) for each in self.entries), default=0)
        return len(_MARK) + _labels(self) + (_GAP + details if details else 0)


def listed(entries: Iterable[Entry[T]]) -> Menu[T]:
    """A menu of these entries, the first one chosen."""
    return Menu(tuple(entries))


def moved(menu: Menu[T], step: int, height: int, *, around: bool = False) -> Menu[T]:
    """So many entries further down, or up; with `around` the first one comes after the last one."""
    count = len(menu.entries)
    if not count:
        return menu
    at = menu.at + step
    return put(menu, at % count if around else min(max(at, 0), count - 1), height)


def put(menu: Menu[T], at: int, height: int) -> Menu[T]:
    """An entry chosen by its number, and in sight among so many rows."""
    top = min(menu.top, at, max(len(menu.entries) - height, 0))
    return evolve(menu, at=at, top=max(top, at - max(height, 1) + 1, 0))


def hit(menu: Menu[T], row: int) -> int | None:
    """The number of the entry in a row; None if there is none."""
    at = menu.top + row
    return at if row >= 0 and at < len(menu.entries) else None


def pictured(menu: Menu[T], columns: int, height: int) -> tuple[Row, ...]:
    """The rows of a menu: a sign and a colour mark the chosen entry, dots what is above and below."""
    labels = _labels(menu)
    shown = menu.entries[menu.top : menu.top + height]
    rows = []
    for number, entry in enumerate(shown, menu.top):
        chosen = number == menu.at
        start = _MARK if chosen else " " * len(_MARK)
        text = f"{start}{_plain(entry.label):<{labels + _GAP}}{_plain(entry.detail)}"
        text = text[:columns].ljust(columns)
        named = min(len(_MARK) + labels, columns)
        colour = palette.player(0) if chosen else palette.ASTEROID
        runs = ((0, named, colour), (named, columns, palette.SELECTED if chosen else palette.TRAIL))
        rows.append(Row(text, tuple(run for run in runs if run[0] < run[1])))
    if rows and menu.top > 0:
        rows[0] = _dotted(rows[0])
    if rows and menu.top + height < len(menu.entries):
        rows[-1] = _dotted(rows[-1])
    return tuple(rows)


def _dotted(row: Row) -> Row:
    """A row that says there is more beyond it."""
    return Row(row.text[:-4] + " ..." if len(row.text) > 4 else row.text, row.runs)


def _labels(menu: Menu[T]) -> int:
    return max((len(each.label) for each in menu.entries), default=0)


def lines(text: str, columns: int, colour: int = palette.ASTEROID) -> tuple[Row, ...]:
    """A text as rows, cut at a width: it may be a picture of columns, so it is not wrapped."""
    return tuple(_row(line, columns, colour) for line in text.expandtabs(4).split("\n"))


def heading(text: str, columns: int) -> Row:
    """A heading, in the middle."""
    return _row(text.center(columns), columns, palette.SELECTED)


def _row(text: str, columns: int, colour: int) -> Row:
    shown = _plain(text)[:columns].ljust(columns)
    return Row(shown, ((0, columns, colour),) if columns > 0 else ())


def _plain(text: str) -> str:
    """A text without signs that a terminal would obey."""
    return "".join(sign if sign.isprintable() else " " for sign in text)
