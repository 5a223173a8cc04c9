"""Keys that go up and keys that repeat, as messages; and the choice of a driver that reports them.

The messages need nothing of Textual but its public names. What reads them from a terminal, `fasteroids.tui.kitty`,
needs private ones, which another version may not have: then `chosen_driver` gives Textual's own driver, and says so.
"""

from __future__ import annotations

from typing import NamedTuple

from textual import constants, events
from textual.driver import Driver

__all__ = ["Chosen", "KeyAgain", "KeyUp", "KeyboardReport", "chosen_driver"]


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


class Chosen(NamedTuple):
    """A driver for `App(driver_class=...)`, None for Textual's own; and a sentence if keys that go up are not read."""

    driver: type[Driver] | None
    note: str


def chosen_driver() -> Chosen:
    """The driver that reads keys that go up, if this system and this version of Textual allow one. Never raises.

    Where the environment names a driver (as in a browser) or switches the protocol off, it is left at that.
    """
    if constants.DRIVER is not None:
        return Chosen(None, "keys that go up are not read: TEXTUAL_DRIVER names another driver")
    if constants.DISABLE_KITTY_KEY:
        return Chosen(None, "keys that go up are not read: TEXTUAL_DISABLE_KITTY_KEY is set")
    try:
        from fasteroids.tui import kitty

        kitty.check()
    except ImportError:
        return Chosen(None, "keys that go up are not read: not on this system")
    except Exception:  # private names that mean something else now fail in ways nobody can list
        return Chosen(None, "keys that go up are not read: not with this version of Textual")
    return Chosen(kitty.KittyDriver, "")
