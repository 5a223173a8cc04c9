"""The choice of what reads the terminal: a driver that knows keys that go up, or Textual's own.

What reads them, `fasteroids.tui.kitty`, needs private names of Textual, which another version may not have: then it is
Textual's own, and that is said.
"""

from __future__ import annotations

from typing import NamedTuple

from textual import constants
from textual.driver import Driver

__all__ = ["Chosen", "chosen_driver"]


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
