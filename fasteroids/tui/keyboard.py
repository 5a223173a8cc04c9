"""Keys that go up and keys that repeat, as messages.

They need nothing of Textual but its public names; `fasteroids.tui.kitty` reads them from a terminal.
"""

from __future__ import annotations

from textual import events

__all__ = ["KeyAgain", "KeyUp", "KeyboardReport"]


class KeyUp(events.InputEvent, bubble=True):
    """A key went up. `key` is the name under which it went down, whatever modifiers are held by now.

    A widget has it in `on_key_up`. Textual hands it to the screen: a screen or a focused widget's parent sees it, the
    focused widget itself does not.
    """

    def __init__(self, key: str) -> None:
        super().__init__()
        self.key = key

    def __rich_repr__(self):  # type: ignore[no-untyped-def]  # as in Textual
        yield "key", self.key


class KeyAgain(events.Key, bubble=True):
    """A key that is down repeats. It comes to `on_key` and to bindings as any key does; its class tells it apart."""

    def copy(self) -> KeyAgain:
        """Another one of the same key."""
        return KeyAgain(self.key, self.character)


# Widgets that take text look for `on_key`; without this they would miss every repeat.
KeyAgain.handler_name = events.Key.handler_name


class KeyboardReport(events.InputEvent, bubble=True):
    """The terminal says which parts of the kitty keyboard protocol are on. Handled in `on_keyboard_report`."""

    key = ""
    """None: the parser of Textual asks it of whatever comes from keys."""

    def __init__(self, flags: int) -> None:
        super().__init__()
        self.flags = flags

    @property
    def key_up(self) -> bool:
        """Does it report keys that go up?"""
        return bool(self.flags & 2)
