"""Widgets that show rows of text made elsewhere: the lines around the arena, and the panes beside it."""

from __future__ import annotations

from collections.abc import Sequence

from textual.strip import Strip
from textual.widget import Widget

from fasteroids.tui.arena import painted
from fasteroids.tui.canvas import Row

__all__ = ["Rows"]


class Rows(Widget):
    """Shows rows, from the top; what is below them is blank."""

    DEFAULT_CSS = "Rows { width: 1fr; height: 1; }"

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._rows: tuple[Row, ...] = ()

    @property
    def rows(self) -> tuple[Row, ...]:
        """What is shown."""
        return self._rows

    def show(self, rows: Sequence[Row]) -> None:
        """Show these rows. Nothing is done if they are shown already."""
        new = tuple(rows)
        if new != self._rows:
            self._rows = new
            self.refresh()

    def render_line(self, y: int) -> Strip:
        """The cells of a line of the widget."""
        row = self._rows[y] if y < len(self._rows) else Row("", ())
        return painted(row, self.size.width)
