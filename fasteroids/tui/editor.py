"""The editor of a ship's program, and the line that asks for a breakpoint.

The editor checks the text, and lives the other future in pieces, so that the screen stays awake and Esc gives up.
"""

from __future__ import annotations

from collections.abc import Generator
from time import perf_counter
from typing import ClassVar, Final

from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.screen import Screen
from textual.widgets import Input, TextArea

from fasteroids.lang import Diagnostic
from fasteroids.tui.boxes import Box
from fasteroids.tui.debugging import broken_at
from fasteroids.tui.menu import lines
from fasteroids.tui.panels import Rows
from fasteroids.tui.rewriting import checked, rewriting, sentence, title_of
from fasteroids.tui.rows import Row, Style, paragraph, row
from fasteroids.tui.session import Session
from fasteroids.units import ModelError

__all__ = ["Breaking", "Editor"]

_AWAKE: Final = 0.02
"""Seconds of work between two looks at the keys."""

_FAULTS: Final = 8
"""Rows for faults, at most."""


class Editor(Screen[Session | None], inherit_bindings=False):
    """The text of a ship's program. Its answer is the session in which another text flies, None if nobody wants one.

    Without `timer` the work goes on by `go_on` alone.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("ctrl+s", "save", priority=True),
        Binding("escape", "discard", priority=True),
    ]
    AUTO_FOCUS = "TextArea"
    DEFAULT_CSS = f"""
    Editor {{ layout: vertical; }}
    Editor Rows {{ height: 1; }}
    Editor #faults {{ height: auto; max-height: {_FAULTS}; display: none; }}
    Editor TextArea, Editor TextArea:focus {{
        border: none; padding: 0; background: #0b0e14; color: #e0e0e8; height: 1fr;
    }}
    """
    _FOOT: Final = "Ctrl+S flies it from here on, Esc discards it"

    def __init__(self, session: Session, ship: int, text: str, *, timer: bool = True) -> None:
        super().__init__()
        self._session, self._ship, self._before = session, ship, text
        self._ticking = timer
        self._work: Generator[float, None, Session] | None = None
        self._faults: tuple[Diagnostic, ...] = ()
        self._warned = False

    @property
    def text(self) -> str:
        """The text as it is now."""
        return self.query_one(TextArea).text

    @property
    def working(self) -> bool:
        """Is the other future being lived?"""
        return self._work is not None

    def compose(self) -> ComposeResult:
        """A heading, the text, what is wrong with it, and a line about keys."""
        yield Rows(id="title")
        yield TextArea(
            self._before, soft_wrap=False, show_line_numbers=True, tab_behavior="indent",
            highlight_cursor_line=False, id="text",
        )  # fmt: skip
        yield Rows(id="faults")
        yield Rows(id="foot")

    def on_mount(self) -> None:
        """The first picture."""
        if self._ticking:
            self.set_interval(_AWAKE, self.go_on)
        self._say(self._FOOT)

    def on_resize(self) -> None:
        """Another size."""
        width = self.app.size.width
        title = title_of(self._session, self._ship)
        self.query_one("#title", Rows).show([row(width, (title, Style.TITLE))])
        self._tell_faults()

    def _say(self, text: str, style: Style = Style.DIM) -> None:
        self.query_one("#foot", Rows).show([row(self.app.size.width, (text, style))])

    def _tell_faults(self) -> None:
        shown = self.query_one("#faults", Rows)
        rows: list[Row] = []
        for each in self._faults:
            style = Style.BAD if each.severity == "error" else Style.WARNING
            rows += paragraph(self.app.size.width, sentence(each), style)
        if len(rows) > _FAULTS:
            rows[_FAULTS - 1 :] = [row(self.app.size.width, ("and more", Style.DIM))]
        shown.styles.height = max(len(rows), 1)
        shown.display = bool(rows)
        shown.show(rows)

    def action_save(self) -> None:
        """Check the text; one without errors flies."""
        if self._work is not None:
            return
        found = checked(self.text)
        if isinstance(found, tuple):
            self._faults = found
            self._tell_faults()
            self._go_to(next(each for each in found if each.severity == "error"))
            many = sum(each.severity == "error" for each in found)
            self._say(f"{many} error{'s' * (many > 1)}; {self._FOOT}", Style.WARNING)
            return
        self._faults = ()
        self._tell_faults()
        self.query_one(TextArea).read_only = True
        self._work = rewriting(self._session, self._ship, found)
        self._say("the other future begins; Esc gives up", Style.VALUE)

    def _go_to(self, fault: Diagnostic) -> None:
        """The caret where a fault is."""
        area = self.query_one(TextArea)
        at = max(fault.span.line - 1, 0), max(fault.span.column - 1, 0)
        last = area.document.end
        area.move_cursor(min(at, last), center=True)

    def action_discard(self) -> None:
        """Give up the work, or the text; a changed text only if asked twice."""
        if self._work is not None:
            self._work.close()
            self._work = None
            self.query_one(TextArea).read_only = False
            self._say(f"given up; {self._FOOT}")
        elif self.text != self._before and not self._warned:
            self._warned = True
            self._say("the text has changed: Esc once more discards it", Style.WARNING)
        else:
            self.dismiss(None)

    def on_text_area_changed(self) -> None:
        """Whoever writes on has not given up."""
        self._warned = False

    def go_on(self) -> None:
        """Some of the work."""
        if self._work is None:
            return
        until = perf_counter() + _AWAKE
        time, end = self._session.place.time, self._session.timeline.world.time
        try:
            while perf_counter() < until:
                time = next(self._work)
        except StopIteration as stop:
            self._work = None
            self.dismiss(stop.value)
        except ModelError as error:
            self._work = None
            self.query_one(TextArea).read_only = False
            self._say(str(error), Style.BAD)
        else:
            self._say(f"lived up to {time:.1f} s of {end:.1f} s; Esc gives up", Style.VALUE)


class Breaking(Box[Session]):
    """Asks for a breakpoint: the number of a line, or a condition. Its answer is the session with it."""

    def __init__(self, session: Session) -> None:
        super().__init__(
            "Break on", "a line number or a condition, as: getx self < 100; Esc goes back"
        )
        self._session = session
        self._fault = ""

    def inside(self) -> ComposeResult:
        """The line, and what is wrong with it."""
        yield Input(id="line")
        yield Rows(id="fault")

    def wanted(self) -> tuple[int, int]:
        """A line, and as many as the fault has."""
        return 64, 1 + len(self._fault.split("\n")) * bool(self._fault)

    def fitted(self, columns: int, rows: int) -> None:
        """The room for both."""
        self.query_one("#line").styles.width = columns
        fault = self.query_one("#fault", Rows)
        fault.styles.width, fault.styles.height = columns, max(rows - 1, 1)
        fault.display = bool(self._fault) and rows > 1
        fault.show(lines(self._fault, columns))

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """The breakpoint, or what is wrong with it."""
        if not event.value.strip():
            return
        try:
            self.dismiss(broken_at(self._session, event.value))
        except ModelError as error:
            self._fault = str(error)
            self.fit()
