"""Widgets that show rows of text made elsewhere: the lines around the arena, and the pane beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from rich.segment import Segment
from rich.style import Style as Look
from textual import events
from textual.message import Message
from textual.strip import Strip

from fasteroids.history import Place
from fasteroids.tui import palette
from fasteroids.tui.lines import Lines
from fasteroids.tui.rows import Row, Style, next_leading

__all__ = ["Pane", "Rows"]

_LOOKS: Final[Mapping[int, Look]] = {
    Style.PLAIN: Look(color="#c8c8d0", bgcolor=palette.BACKGROUND),
    Style.DIM: Look(color="#8a8a96", bgcolor=palette.BACKGROUND),
    Style.TITLE: Look(color="#ffffff", bgcolor=palette.BACKGROUND, bold=True),
    Style.VALUE: Look(color="#e0e0e8", bgcolor=palette.BACKGROUND),
    Style.LINK: Look(color="#56b4e9", bgcolor=palette.BACKGROUND, underline=True),
    Style.CURSOR: Look(color="#101014", bgcolor="#f0e442", bold=True),
    Style.CHANGED: Look(color="#e69f00", bgcolor=palette.BACKGROUND, bold=True),
    Style.GOOD: Look(color="#009e73", bgcolor=palette.BACKGROUND, bold=True),
    Style.WARNING: Look(color="#f0e442", bgcolor=palette.BACKGROUND),
    Style.BAD: Look(color="#d55e00", bgcolor=palette.BACKGROUND, bold=True),
}
_PLAIN: Final = _LOOKS[Style.PLAIN]
_CHOSEN: Final = Look(reverse=True)
_EMPTY: Final = Row("")


class Rows(Lines):
    """Shows rows, from the top; what is below them is blank. A click posts where it leads, if it leads anywhere."""

    DEFAULT_CSS = f"Rows {{ width: 1fr; height: 1; background: {palette.BACKGROUND}; }}"

    class Clicked(Message):
        """Somebody clicked on a row: in this column, on this row, which leads to a place or nowhere."""

        def __init__(self, rows: Rows, column: int, place: Place | None) -> None:
            super().__init__()
            self.rows, self.column, self.place = rows, column, place

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._rows: tuple[Row, ...] = ()
        self._strips: dict[Row, Strip] = {}
        self._width = 0

    @property
    def rows(self) -> tuple[Row, ...]:
        """What is shown."""
        return self._rows

    def show(self, rows: Sequence[Row]) -> None:
        """Show these rows. Nothing is done if they are shown already."""
        new = tuple(rows)
        if new != self._rows:
            self._rows, kept = new, self._strips
            self._strips = {row: kept[row] for row in new if row in kept}
            self.refresh()

    def render_line(self, y: int) -> Strip:
        """The cells of a line of the widget."""
        width = self.outer_size.width
        if width != self._width:
            self._width, self._strips = width, {}
        shown = self._rows[y] if y < len(self._rows) else _EMPTY
        strip = self._strips.get(shown)
        if strip is None:
            strip = Strip(_segments(shown)).adjust_cell_length(width, _PLAIN)
            self._strips[shown] = strip
        return strip

    def on_click(self, event: events.Click) -> None:
        """A click."""
        y = event.y
        if 0 <= y < len(self._rows):
            self.post_message(self.Clicked(self, event.x, self._rows[y].place))


class Pane(Rows):
    """Rows of which one that leads to a place can be chosen with keys, which come through `key`."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._chosen: int | None = None

    @property
    def chosen(self) -> int | None:
        """The chosen row, from the top; None while keys are for others."""
        return self._chosen

    def begin(self) -> bool:
        """Choose the first row that leads anywhere; is there one?"""
        self._choose(next_leading(self.rows, None, 1))
        return self._chosen is not None

    def end(self) -> None:
        """Keys are for others again."""
        self._choose(None)

    def show(self, rows: Sequence[Row]) -> None:
        """Show these rows; the choice goes on to the next one that leads anywhere."""
        super().show(rows)
        if self._chosen is not None:
            self._choose(next_leading(self.rows, self._chosen - 1, 1))

    def _choose(self, row: int | None) -> None:
        if row != self._chosen:
            self._chosen = row
            self.refresh()

    def key(self, key: str) -> bool:
        """Move with arrows, go there with Enter; was the key for this? Any other one ends the choice."""
        at = self._chosen
        if at is None:
            return False
        if key in ("up", "down"):
            self._choose(next_leading(self.rows, at, 1 if key == "down" else -1))
            return True
        place = self.rows[at].place if at < len(self.rows) else None
        if key == "enter" and place is not None:
            self.post_message(self.Clicked(self, 0, place))
            return True
        self.end()
        return key == "escape"

    def render_line(self, y: int) -> Strip:
        """The cells of a line, the chosen one reversed."""
        strip = super().render_line(y)
        return strip.apply_style(_CHOSEN) if y == self._chosen else strip


def _segments(shown: Row) -> list[Segment]:
    """A row as text with styles."""
    text, at, segments = shown.text, 0, []
    for start, end, style in shown.runs:
        if at < start:
            segments.append(Segment(text[at:start], _PLAIN))
        segments.append(Segment(text[start:end], _LOOKS[style]))
        at = end
    if at < len(text):
        segments.append(Segment(text[at:], _PLAIN))
    return segments
