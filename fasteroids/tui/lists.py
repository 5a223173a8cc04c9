"""Widgets of boxes and of the start screen: a menu on screen, and a text that scrolls.

They have no cursor: whoever has the keys hands those on that move.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Generic, TypeVar

from textual import events
from textual.message import Message

from fasteroids.tui.menu import Entry, Menu, hit, lines, listed, moved, pictured, put
from fasteroids.tui.panels import Rows

__all__ = ["Choices", "Text"]

T = TypeVar("T")

_STEPS: Final = {"up": -1, "down": 1}


class Choices(Rows, Generic[T]):
    """A menu on screen. A click chooses; keys come through `key`, from whoever has them."""

    class Chosen(Message):
        """An entry was clicked."""

    def __init__(self, entries: Sequence[Entry[T]], *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.menu: Menu[T] = listed(entries)

    def offer(self, entries: Sequence[Entry[T]], *, at: int = 0) -> None:
        """Show other entries, one of them chosen."""
        self.menu = put(listed(entries), min(at, max(len(entries) - 1, 0)), self.size.height)
        self.picture()

    def key(self, key: str) -> bool:
        """Move by a key; was it one that moves?"""
        height = self.size.height
        page = max(height - 1, 1)
        if key in _STEPS:
            self.menu = moved(self.menu, _STEPS[key], height, around=True)
        elif key in ("pageup", "pagedown"):
            self.menu = moved(self.menu, page if key == "pagedown" else -page, height)
        elif key in ("home", "end"):
            many = len(self.menu.entries)
            self.menu = moved(self.menu, many if key == "end" else -many, height)
        else:
            return False
        self.picture()
        return True

    def picture(self) -> None:
        """Show the menu as it is."""
        self.show(pictured(self.menu, self.size.width, self.size.height))

    def on_resize(self) -> None:
        """Another size: the chosen entry stays in sight."""
        if self.menu.entries:
            self.menu = put(self.menu, self.menu.at, self.size.height)
        self.picture()

    def on_click(self, event: events.Click) -> None:
        """Choose what is clicked."""
        event.stop()
        event.prevent_default()
        at = hit(self.menu, event.y)
        if at is not None:
            self.menu = put(self.menu, at, self.size.height)
            self.picture()
            self.post_message(self.Chosen())

    def on_mouse_scroll_up(self) -> None:
        """The wheel moves the choice."""
        self.menu = moved(self.menu, -1, self.size.height)
        self.picture()

    def on_mouse_scroll_down(self) -> None:
        """The wheel moves the choice."""
        self.menu = moved(self.menu, 1, self.size.height)
        self.picture()


class Text(Rows):
    """A text that scrolls."""

    def __init__(self, text: str, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.text, self.top = text, 0

    def key(self, key: str) -> bool:
        """Scroll by a key; was it one that scrolls?"""
        page = max(self.size.height - 1, 1)
        far = len(self.text.split("\n"))
        steps = {**_STEPS, "pageup": -page, "pagedown": page, "space": page, "home": -far, "end": far}  # fmt: skip
        self.move(steps.get(key, 0))
        return key in steps

    def move(self, step: int) -> None:
        """So many lines down, or up."""
        last = max(len(self.text.split("\n")) - self.size.height, 0)
        self.top = min(max(self.top + step, 0), last)
        self.picture()

    def picture(self) -> None:
        """Show the part that is in sight."""
        self.show(lines(self.text, self.size.width)[self.top : self.top + self.size.height])

    def on_resize(self) -> None:
        """Another size."""
        self.move(0)

    def on_mouse_scroll_up(self) -> None:
        """The wheel scrolls."""
        self.move(-3)

    def on_mouse_scroll_down(self) -> None:
        """The wheel scrolls."""
        self.move(3)
