"""The filmstrip: a stretch of a past on one row, with the cursor, the times at both ends, and marks of what happened.

    shown = strip(chronicle, timeline, stretch, cursor, 80, selected=3)
    shown.rows, shown.time_at(17), shown.place_at(17)

Each column stands for an equal part of the stretch and shows the weightiest of what happened in it; where nothing of
note did, a shade says how much happened at all. What it costs does not depend on how much the past holds.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from math import ceil, inf, isfinite, nextafter
from typing import Final, Literal

from attrs import frozen

from fasteroids.history import Place, Timeline
from fasteroids.history.questions import past_all_at
from fasteroids.moments import moment_at, resolution
from fasteroids.tui.chronicle import Chronicle, Key
from fasteroids.tui.rows import Piece, Row, Style, clock, row
from fasteroids.units import ModelError, shown

__all__ = ["LEGEND", "Mark", "Stretch", "Strip", "strip", "whole"]

Mark = Literal[
    "cursor", "loss", "stop", "bookmark", "branch", "contact", "death", "shot", "input"
]  # fmt: skip
"""What a column can show, the weightiest first. A `loss` is the death of a ship, a `contact` one
of the selected entity."""

_LOOKS: Final[Mapping[Mark, tuple[str, str, Style]]] = {
    "cursor": ("|", "┃", Style.CURSOR),
    "loss": ("X", "✗", Style.BAD),
    "stop": ("!", "!", Style.WARNING),
    "bookmark": ("B", "⚑", Style.GOOD),
    "branch": ("Y", "┴", Style.GOOD),
    "contact": ("o", "○", Style.LINK),
    "death": ("x", "⨯", Style.WARNING),
    "shot": ("*", "∗", Style.VALUE),
    "input": ("i", "▴", Style.CHANGED),
}
_SHADES: Final = (" .:-=", " ▁▂▃▄")

LEGEND: Final[Mapping[Mark, tuple[str, str]]] = {
    mark: (plain, fine) for mark, (plain, fine, _) in _LOOKS.items()
}
"""The signs of the marks, in ASCII and in Unicode."""


@frozen
class Stretch:
    """From one time to another, s."""

    start: float
    end: float

    def __attrs_post_init__(self) -> None:
        """`ModelError` if it does not end after it starts."""
        if not (isfinite(self.end) and 0.0 <= self.start < self.end):
            raise ModelError(
                f"a stretch goes from a time to a later one; got {shown(self.start)} to {shown(self.end)}"
            )

    @property
    def span(self) -> float:
        """How long it is, s."""
        return self.end - self.start

    def zoomed(self, cursor: float, factor: float, within: Stretch) -> Stretch:
        """`factor` times as long, with the cursor where it was, but not beyond `within`.

        A factor below 1 shows more detail, down to what the clock can tell.
        """
        least = 1024.0 * resolution(moment_at(within.end))
        span = min(max(self.span * factor, least), within.span)
        share = min(max((cursor - self.start) / self.span, 0.0), 1.0)
        return Stretch(*_placed(cursor - share * span, span, within))

    def holding(self, cursor: float, within: Stretch) -> Stretch:
        """As long, moved no more than is needed to hold the cursor, but not beyond `within`."""
        span = min(self.span, within.span)
        start = min(max(self.start, cursor - span), cursor)
        return Stretch(*_placed(start, span, within))


def _placed(start: float, span: float, within: Stretch) -> tuple[float, float]:
    """A stretch of this length, moved into another one that is not shorter."""
    if span >= within.span:
        return within.start, within.end
    start = min(max(start, within.start), within.end - span)
    return start, min(start + span, within.end)


def whole(timeline: Timeline) -> Stretch:
    """All of a past; of one without any time, a first moment of it."""
    start, end = timeline.first.place.time, timeline.world.time
    return Stretch(start, end if end > start else start + max(1.0, 2.0**-40 * start))


@frozen
class Strip:
    """A drawn filmstrip: its rows, and what its columns stand for."""

    rows: tuple[Row, ...]
    stretch: Stretch
    left: int
    """The first column of the bar."""
    columns: int
    """How many columns it has."""
    places: tuple[Place | None, ...]
    """What each column of the bar shows, if something happened there."""

    def time_at(self, column: int) -> float:
        """The time a column of the row stands for, s: the middle of its part, but at both ends, and beyond, the end."""
        k = column - self.left
        if k <= 0:
            return self.stretch.start
        if k >= self.columns - 1:
            return self.stretch.end
        return self.stretch.start + (k + 0.5) / self.columns * self.stretch.span

    def column_at(self, time: float) -> int:
        """The column of the row that stands for a time; the nearest one for a time that is not shown."""
        return self.left + _column(self.stretch, self.columns, time)

    def place_at(self, column: int) -> Place | None:
        """The place of what a column of the row shows, if something happened there."""
        k = column - self.left
        return self.places[k] if 0 <= k < self.columns else None


def _edge(stretch: Stretch, columns: int, k: int) -> float:
    """The time at which column k begins."""
    return stretch.start + k / columns * stretch.span


def _column(stretch: Stretch, columns: int, time: float) -> int:
    """The column that holds a time: the last that begins not after it."""
    return bisect_right(range(1, columns), time, key=lambda k: _edge(stretch, columns, k))


def strip(
    chronicle: Chronicle,
    timeline: Timeline,
    stretch: Stretch,
    cursor: float,
    width: int,
    *,
    selected: int | None = None,
    height: Literal[1, 2] = 1,
    unicode: bool = True,
) -> Strip:
    """The filmstrip of a stretch, of a width in cells of at least 3.

    `chronicle` is that of the timeline (`Chronicle.followed`), which gives bookmarks and branches. On one row the
    cursor hides the mark below it; with a `height` of 2 it has a second row, with its time.
    """
    start, end = (_label(time, stretch, width) for time in (stretch.start, stretch.end))
    if width < len(start) + len(end) + 12:
        start = end = ""
    left = len(start) + 1 if start else 0
    columns = max(width - left - (len(end) + 1 if end else 0), 1)
    marks = _marks(chronicle, timeline, stretch, columns, selected)
    shades = _shades(chronicle, stretch, columns)
    here = _column(stretch, columns, cursor) if stretch.start <= cursor <= stretch.end else None
    places = tuple(marks[k][1] if k in marks else None for k in range(columns))
    signs = [_SHADES[unicode][shade] for shade in shades]
    pieces: list[Piece] = [(sign, Style.DIM) if sign.strip() else sign for sign in signs]
    for k, (mark, _) in marks.items():
        pieces[k] = _look(mark, unicode=unicode)
    if here is not None and height == 1:
        pieces[here] = _look("cursor", unicode=unicode)
    ends: list[Piece] = [(start + " ", Style.DIM)] if start else []
    rows = [_merged(row(width, *ends, *pieces, (f" {end}" if end else "", Style.DIM)))]
    if height == 2:
        rows.append(_below(stretch, cursor, here, left, width, unicode=unicode))
    return Strip(tuple(rows), stretch, left, columns, places)


def _look(mark: Mark, *, unicode: bool) -> tuple[str, Style]:
    plain, fine, style = _LOOKS[mark]
    return fine if unicode else plain, style


def _label(time: float, stretch: Stretch, width: int) -> str:
    """A time as exact as the columns are."""
    digits = 0
    while digits < 6 and 10.0**-digits > stretch.span / max(width, 1):
        digits += 1
    return clock(time, digits)


def _below(
    stretch: Stretch, cursor: float, here: int | None, left: int, width: int, *, unicode: bool
) -> Row:
    """The row of the cursor: a sign below its column, and its time beside it."""
    time = f"{clock(cursor)} s"
    if here is None:
        sign = "<" if cursor < stretch.start else ">"
        text = f"{sign} {time}" if sign == "<" else f"{time} {sign}".rjust(width)
        return row(width, (text, Style.CURSOR))
    at, sign = left + here, "▲" if unicode else "^"
    if at + 2 + len(time) <= width:
        return row(width, " " * at, (sign, Style.CURSOR), f" {time}")
    lead = f"{time} "
    return row(width, lead.rjust(at)[-at:] if at else "", (sign, Style.CURSOR))


def _merged(given: Row) -> Row:
    """With one run where several of a style touch."""
    runs: list[tuple[int, int, int]] = []
    for start, end, style in given.runs:
        if runs and runs[-1][1:] == (start, style):
            runs[-1] = runs[-1][0], end, style
        else:
            runs.append((start, end, style))
    return given._replace(runs=tuple(runs))


def _edges(stretch: Stretch, columns: int) -> list[Place]:
    """The places between the columns: right before all that happens at a time."""
    firsts = [Place(*moment_at(_edge(stretch, columns, k))) for k in range(columns)]
    return [*firsts, past_all_at(nextafter(stretch.end, inf))]  # an end may be rounded


def _shades(chronicle: Chronicle, stretch: Stretch, columns: int) -> list[int]:
    """How much happened in each column: 0 for nothing, one for little, up to the last shade for the most."""
    counts = [len(part) for part in chronicle.parts("event", _edges(stretch, columns))]
    top = len(_SHADES[0]) - 1
    most = max(*counts, top)
    return [ceil(top * n / most) for n in counts]


def _marks(
    chronicle: Chronicle, timeline: Timeline, stretch: Stretch, columns: int, selected: int | None
) -> dict[int, tuple[Mark, Place | None]]:
    """What each column shows, of those that show a mark: the weightiest, and of several of those the first."""
    found: dict[int, tuple[Mark, Place | None]] = {}

    def note(mark: Mark, place: Place) -> None:
        if stretch.start <= place.time <= stretch.end:
            found.setdefault(_column(stretch, columns, place.time), (mark, place))

    keys: dict[Mark, Key] = {"loss": "loss", "stop": "stop", "death": "death"}
    keys |= {"shot": "shot", "input": "input"}
    if selected is not None:
        keys["contact"] = selected, "contact"
    edges = _edges(stretch, columns)
    for mark in _LOOKS:
        if mark == "bookmark":
            for bookmark in timeline.bookmarks.values():
                if timeline.holds(bookmark.line, bookmark.state.place):
                    note(mark, bookmark.state.place)
        elif mark == "branch":
            for line in timeline.lines.values():
                if line.parent and timeline.holds(line.parent, line.first.place):
                    note(mark, line.first.place)
        elif mark in keys:
            for k, part in enumerate(chronicle.parts(keys[mark], edges)):
                if part:
                    found.setdefault(k, (mark, chronicle.entries(keys[mark])[part[0]].place))
    return found
