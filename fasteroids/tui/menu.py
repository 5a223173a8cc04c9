"""A menu as a value: entries, the chosen one, what is in sight. Pure, and in ASCII if its texts are."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, Generic, TypeVar

from attrs import evolve, frozen

from fasteroids.tui.rows import Row, Style, row

__all__ = ["Entry", "Menu", "centred", "hit", "lines", "listed", "moved", "pictured", "put"]

T = TypeVar("T")

_MARK: Final = "> "
_LEAST: Final = 12
"""Columns below which there are no dots."""

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
    """The rows of a menu: a sign marks the chosen entry, and dots that there is more above or below."""
    labels = _labels(menu)
    rows = []
    for number, entry in enumerate(menu.entries[menu.top : menu.top + height], menu.top):
        last = number == menu.top + height - 1 and number < len(menu.entries) - 1
        more = " ..." if (last or number == menu.top > 0) and columns > _LEAST else ""
        chosen = number == menu.at
        label = f"{_MARK if chosen else ' ' * len(_MARK)}{entry.label:<{labels + _GAP}}"
        styles = (Style.WARNING, Style.TITLE) if chosen else (Style.VALUE, Style.DIM)
        shown = row(columns - len(more), (label, styles[0]), (entry.detail, styles[1]))
        rows.append(Row(shown.text + more, shown.runs))
    return tuple(rows)


def _labels(menu: Menu[T]) -> int:
    return max((len(each.label) for each in menu.entries), default=0)


def lines(text: str, columns: int, style: Style = Style.VALUE) -> tuple[Row, ...]:
    """A text as rows, cut at a width: it may be a picture of columns, so it is not wrapped."""
    return tuple(row(columns, (line, style)) for line in text.expandtabs(4).split("\n"))


def centred(text: str, columns: int, style: Style) -> Row:
    """A text in the middle."""
    return row(columns, (text.center(columns), style))
