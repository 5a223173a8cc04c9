"""The widget that shows frames. All it knows is how an index of the palette is painted and which rows changed.

Measured for Textual 8: one full refresh a frame costs less than refreshing what changed, and a row that is the same
as before costs nothing if its strip is kept.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Final

from rich.segment import Segment
from rich.style import Style
from textual.message import Message
from textual.strip import Strip

from fasteroids.tui import palette
from fasteroids.tui.camera import Frame
from fasteroids.tui.canvas import Cells
from fasteroids.tui.lines import Lines

__all__ = ["Arena", "painted"]

_BLANK: Final = Style(bgcolor=palette.BACKGROUND)
_STYLES: Final = tuple(
    Style(color=colour.hex, bgcolor=palette.BACKGROUND, bold=colour.bold)
    for colour in palette.COLOURS
)

_EMPTY: Final = Cells("", ())
_WORD: Final = re.compile(r" +|[^ ]+")


class Arena(Lines):
    """Shows one frame at a time. Where a frame is smaller than the widget the rest is blank, where larger it is cut.

    Make frames of `content_size` cells. NO_COLOR is Textual's business: figures, letters and signs tell entities apart.
    """

    class Resized(Message):
        """It has another size now, so another frame is due."""

    DEFAULT_CSS = f"Arena {{ width: 1fr; height: 1fr; background: {palette.BACKGROUND}; }}"

    def __init__(
        self, *, name: str | None = None, id: str | None = None, classes: str | None = None
    ) -> None:
        super().__init__(name=name, id=id, classes=classes)
        self._frame = Frame(0, ())
        self._strips: dict[Cells, Strip] = {}
        self._width = 0
        self._cut: Callable[[Cells], list[Segment]] = _segments

    @property
    def frame(self) -> Frame:
        """The frame that is shown."""
        return self._frame

    def on_resize(self) -> None:
        """Another size, because of the terminal or of what is beside it."""
        self.post_message(self.Resized())

    def show(self, frame: Frame) -> bool:
        """Show a frame; False if it equals the one that is shown, and so nothing was done."""
        if frame == self._frame:
            return False
        self._frame = frame
        kept = self._strips
        self._strips = {row: kept[row] for row in frame.rows if row in kept}
        self.refresh()
        return True

    @contextmanager
    def posing(self) -> Iterator[None]:
        """While a picture is taken (`App.export_screenshot`): every word is placed by itself.

        An SVG stretches each piece of text to its cells, and fonts give Braille, blocks and blanks other widths.
        """
        self._recut(_words)
        try:
            yield
        finally:
            self._recut(_segments)

    def _recut(self, cut: Callable[[Cells], list[Segment]]) -> None:
        self._cut = cut
        self._strips = {}
        self.refresh()

    def render_line(self, y: int) -> Strip:
        """The cells of a line of the widget."""
        width, rows = self.outer_size.width, self._frame.rows
        if width != self._width:
            self._width, self._strips = width, {}
        row = rows[y] if y < len(rows) else _EMPTY
        strip = self._strips.get(row)
        if strip is None:
            strip = Strip(self._cut(row), len(row.text)) if row.text else Strip.blank(width, _BLANK)
            strip = self._strips[row] = strip.adjust_cell_length(width, _BLANK)
        return strip


def painted(row: Cells, width: int) -> Strip:
    """A row as a strip of a width."""
    strip = Strip(_segments(row), len(row.text))
    return strip if len(row.text) == width else strip.adjust_cell_length(width, _BLANK)


def _segments(row: Cells) -> list[Segment]:
    """A row as text with styles, each run with the blanks up to the next one: fewer changes of style to send."""
    text, runs = row
    if not runs:
        return [Segment(text, _BLANK)]
    starts = [0, *(start for start, _, _ in runs[1:]), len(text)]
    return [
        Segment(text[start:end], _STYLES[colour])
        for start, end, (_, _, colour) in zip(starts, starts[1:], runs, strict=False)
    ]


def _words(row: Cells) -> list[Segment]:
    """A row as text with styles, blanks and words apart."""
    styles = [_BLANK] * len(row.text)
    for start, end, colour in row.runs:
        styles[start:end] = [_STYLES[colour]] * (end - start)
    edges = {0, len(row.text), *(m.start() for m in _WORD.finditer(row.text))}
    edges |= {edge for start, end, _ in row.runs for edge in (start, end)}
    ordered = sorted(edges)
    return [Segment(row.text[start:end], styles[start]) for start, end in pairwise(ordered)]
