"""Boxes over another screen: one chooses, is asked for a line of text, or reads. Esc leaves them without an answer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Final, TypeVar

from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import Vertical
from textual.fuzzy import Matcher
from textual.screen import ModalScreen
from textual.widgets import Input

from fasteroids.tui.keyboard import KeyAgain
from fasteroids.tui.lists import Choices, Text
from fasteroids.tui.menu import Entry, centred, listed
from fasteroids.tui.panels import Rows
from fasteroids.tui.rows import Style

__all__ = ["Ask", "Box", "Choose", "Tell", "fitting"]

T = TypeVar("T")
R = TypeVar("R")

_MARGIN: Final = 6
"""Columns and rows of a box that are not for what is in it: the border, and some blanks."""


class Box(ModalScreen[R], inherit_bindings=False):
    """A box in the middle with a heading above and a line about keys below; `inside` is what is in it."""

    BINDINGS: ClassVar[list[BindingType]] = []
    AUTO_FOCUS = "Input"
    DEFAULT_CSS = """
    Box { align: center middle; background: #0b0e14 70%; }
    Box > Vertical {
        border: ascii #7a9cc6; background: #0b0e14; padding: 0 1; width: auto; height: auto;
        max-width: 100%; max-height: 100%;
    }
    Box Input, Box Input:focus {
        border: none; height: 1; padding: 0; background: #1c2230; color: #ffffff; background-tint: #000000 0%;
    }
    """

    def __init__(self, title: str, foot: str) -> None:
        super().__init__()
        self._heading, self._foot = title, foot
        self._left = False

    def inside(self) -> ComposeResult:
        """The widgets between heading and foot."""
        yield from ()

    def wanted(self) -> tuple[int, int]:
        """The columns and rows that what is inside would like to have."""
        return 0, 0

    def fitted(self, columns: int, rows: int) -> None:
        """What is inside gets so many columns and rows."""

    def compose(self) -> ComposeResult:
        """The box."""
        with Vertical():
            yield Rows(id="title")
            yield from self.inside()
            yield Rows(id="foot")

    def on_mount(self) -> None:
        """Take the room there is."""
        self.fit()

    def on_resize(self) -> None:
        """Another size."""
        self.fit()

    def fit(self) -> None:
        """Take as much room as what is inside wants, but no more than there is."""
        if not self.is_mounted:
            return
        columns, rows = self.app.size
        wanted = self.wanted()
        width = max(min(max(wanted[0], len(self._heading), len(self._foot)), columns - _MARGIN), 1)
        height = max(min(wanted[1], rows - _MARGIN), 1)
        for name, text, style in (
            ("#title", self._heading, Style.TITLE),
            ("#foot", self._foot, Style.DIM),
        ):
            self.query_one(name, Rows).styles.width = width
            self.query_one(name, Rows).show([centred(text, width, style)])
        self.fitted(width, height)

    def leave(self, answer: R | None) -> None:
        """Give the answer, once: more keys may have been on their way."""
        if not self._left:
            self._left = True
            self.dismiss(answer)

    def say(self, text: str) -> None:
        """Another line about keys."""
        self._foot = text
        foot = self.query_one("#foot", Rows)
        foot.show([centred(text, foot.size.width, Style.DIM)])

    def on_key(self, event: events.Key) -> None:
        """A key that means nothing here goes on to whoever has the cursor."""
        again = isinstance(event, KeyAgain) and event.key in ("enter", "escape")
        if again or self.key(event):
            event.stop()
            event.prevent_default()

    def key(self, event: events.Key) -> bool:
        """Do what a key asks, if it asks anything; Esc leaves."""
        if event.key != "escape":
            return False
        self.leave(None)
        return True


class Choose(Box[T]):
    """One of some entries; with `search` those that a text typed in fits."""

    def __init__(
        self,
        title: str,
        entries: Sequence[Entry[T]],
        *,
        search: bool = False,
        foot: str = "Enter chooses, Esc goes back",
    ) -> None:
        super().__init__(title, foot)
        self._entries, self._search = tuple(entries), search

    def inside(self) -> ComposeResult:
        """A line to search with, and the entries."""
        if self._search:
            yield Input(placeholder="type to search", id="search", select_on_focus=False)
        yield Choices(self._entries, id="choices")

    @property
    def choices(self) -> Choices[T]:
        """The entries on screen."""
        found: Choices[T] = self.query_one("#choices", Choices)
        return found

    def wanted(self) -> tuple[int, int]:
        """All entries."""
        return listed(self._entries).width + 4, len(self._entries) + self._search

    def fitted(self, columns: int, rows: int) -> None:
        """Room for the entries."""
        if self._search:
            self.query_one("#search").styles.width = columns
            rows = max(rows - 1, 1)
        self.choices.styles.width, self.choices.styles.height = columns, rows

    def key(self, event: events.Key) -> bool:
        """Move, or choose."""
        if event.key == "enter":
            self.chosen()
            return True
        return self.choices.key(event.key) or super().key(event)

    def on_choices_chosen(self) -> None:
        """A click chooses."""
        self.chosen()

    def chosen(self) -> None:
        """The chosen entry is the answer."""
        entry = self.choices.menu.chosen
        if entry is not None:
            self.leave(entry.value)

    def on_input_changed(self, event: Input.Changed) -> None:
        """Those that fit, the best first."""
        self.choices.offer(fitting(self._entries, event.value))


def fitting(entries: Sequence[Entry[T]], text: str) -> list[Entry[T]]:
    """The entries whose label or detail has the letters of a text in this order, the best first."""
    if not text.strip():
        return list(entries)
    match = Matcher(text.strip()).match
    scored = [(max(match(each.label), 0.5 * match(each.detail)), each) for each in entries]
    found = [pair for pair in scored if pair[0] > 0.0]
    return [each for _, each in sorted(found, key=lambda pair: -pair[0])]


class Ask(Box[str]):
    """A line of text, not empty."""

    def __init__(self, title: str, *, text: str = "", foot: str = "Enter takes it, Esc goes back") -> None:  # fmt: skip
        super().__init__(title, foot)
        self._text = text

    def inside(self) -> ComposeResult:
        """The line."""
        yield Input(self._text, id="line")

    def wanted(self) -> tuple[int, int]:
        """A long line: it may be a path."""
        return 64, 1

    def fitted(self, columns: int, rows: int) -> None:
        """The width of the line."""
        del rows
        self.query_one("#line").styles.width = columns

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """The answer."""
        text = "".join(filter(str.isprintable, event.value)).strip()
        if text:
            self.leave(text)


class Tell(Box[None]):
    """Something to read, which may be longer than the screen."""

    def __init__(self, title: str, text: str, *, foot: str = "Up and Down scroll, Esc goes back") -> None:  # fmt: skip
        super().__init__(title, foot)
        self._text = text

    def inside(self) -> ComposeResult:
        """The text, as a menu without a choice."""
        yield Text(self._text, id="text")

    def wanted(self) -> tuple[int, int]:
        """The whole text."""
        rows = self._text.expandtabs(4).split("\n")
        return max(map(len, rows)), len(rows)

    def fitted(self, columns: int, rows: int) -> None:
        """The part of it that there is room for."""
        text = self.query_one("#text", Text)
        text.styles.width, text.styles.height = columns, rows
        text.picture()

    def key(self, event: events.Key) -> bool:
        """Scroll; Enter leaves too."""
        if event.key == "enter":
            self.leave(None)
            return True
        return self.query_one("#text", Text).key(event.key) or super().key(event)
