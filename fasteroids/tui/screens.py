"""Screens about the whole game: the keys and their change, all commands, the high scores."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Final, Literal, TypeAlias

from textual import events

from fasteroids.tui.boxes import Choose, Tell
from fasteroids.tui.keyboard import KeyAgain
from fasteroids.tui.keys import (
    PRESETS,
    Command,
    HelpRow,
    Keymap,
    bound,
    cleared,
    help_rows,
    preset,
    spoken,
)
from fasteroids.tui.menu import Entry
from fasteroids.tui.scores import Table
from fasteroids.units import ModelError

__all__ = ["EXTRA", "Help", "Keys", "Palette", "Place", "Scores"]

Place: TypeAlias = Literal["keys", "scores"]
"""A screen that no key leads to."""

EXTRA: Final = (
    Entry[Command | Place]("change keys", "keys"),
    Entry[Command | Place]("high scores", "scores"),
)


class Help(Tell):
    """All commands and their keys."""

    def __init__(self, keymap: Keymap, note: str = "") -> None:
        self._keymap = keymap
        super().__init__("Keys", _help(keymap, note), foot="Up and Down scroll, Esc goes back")

    def key(self, event: events.Key) -> bool:
        """The key that opened it closes it too."""
        if self._keymap.command(event.key) is Command.HELP:
            self.leave(None)
            return True
        return super().key(event)


def _help(keymap: Keymap, note: str) -> str:
    rows = help_rows(keymap)
    wide = max(len(row.keys) for row in rows)
    text = [note] if note else []
    group = ""
    for row in rows:
        if row.group != group:
            group = row.group
            text += [*([""] if text else []), group]
        text.append(f"  {row.keys or '(none)':<{wide}}  {row.says}")
    return "\n".join(text)


class Palette(Choose[Command | Place]):
    """All commands, found by what is typed."""

    def __init__(self, keymap: Keymap) -> None:
        entries = [Entry[Command | Place](_named(row), row.command, row.keys) for row in help_rows(keymap)]  # fmt: skip
        super().__init__("Commands", (*entries, *EXTRA), search=True)


def _named(row: HelpRow) -> str:
    """What a command does, with whose ship it flies."""
    return f"{row.says} ({row.group.lower()})" if row.command.player else row.says


class Keys(Choose[Command | None]):
    """Changes keys. `keep` is told each new keymap.

    Enter waits for a key: the next one that is pressed, but for Esc, which takes none. A key that another command has
    is taken from it only if it is pressed twice.
    """

    _FOOT: Final = "Enter gives a key, Del takes back, Esc goes back"

    def __init__(self, keymap: Keymap, keep: Callable[[Keymap], object]) -> None:
        self.keymap, self._keep = keymap, keep
        self._waiting: Command | None = None
        self._pressed: str | None = None
        super().__init__("Change keys", _commands(keymap), foot=self._FOOT)

    def key(self, event: events.Key) -> bool:
        """A key for the command that waits for one, or for the list."""
        entry = self.choices.menu.chosen
        if self._waiting is not None:
            if not isinstance(event, KeyAgain):
                self._given(self._waiting, event.key)
        elif event.key in ("delete", "backspace") and entry is not None and entry.value is not None:
            self._become(cleared(self.keymap, entry.value), f"{entry.value.says}: as before")
        else:
            return super().key(event)
        return True

    def chosen(self) -> None:
        """Wait for a key of the command; the first line changes the preset."""
        entry = self.choices.menu.chosen
        if entry is None:
            return
        if entry.value is None:
            names = list(PRESETS)
            name = names[(names.index(self.keymap.preset) + 1) % len(names)]
            self._become(preset(name), f"the keys of the preset {name}")
        else:
            self._waiting, self._pressed = entry.value, None
            self.say(f"press a key to {entry.value.says}; Esc: none")

    def _given(self, command: Command, key: str) -> None:
        if key == "escape":
            self._waiting = None
            self.say(self._FOOT)
            return
        owner = self.keymap.command(key)
        if owner is not None and owner is not command and key != self._pressed:
            self._pressed = key
            self.say(f"{spoken(key)} is for: {owner.says}. Press it again to take it")
            return
        self._waiting = None
        try:
            keymap = bound(self.keymap, command, [key])
        except ModelError as error:
            self.say(str(error))
            return
        self._become(keymap, f"{command.says}: {spoken(key)}")

    def _become(self, keymap: Keymap, said: str) -> None:
        self.keymap = keymap
        self.choices.offer(_commands(keymap), at=self.choices.menu.at)
        self.say(said)
        self._keep(keymap)


def _commands(keymap: Keymap) -> list[Entry[Command | None]]:
    head = Entry[Command | None]("preset", None, keymap.preset)
    rows = help_rows(keymap)
    return [head, *(Entry[Command | None](_named(r), r.command, r.keys or "(none)") for r in rows)]


class Scores(Choose[str]):
    """The high scores; one that has a recording can be chosen to see it."""

    def __init__(self, table: Table, folder: Path | None) -> None:
        entries = [
            Entry(
                f"{place:2} {row.name:<20} {row.score:>9,}",
                row.recording if _there(folder, row.recording) else "",
                f"wave {row.wave}  seed {row.seed}  {row.date}",
            )
            for place, row in enumerate(table.rows, 1)
        ]
        kept = any(entry.value for entry in entries)
        foot = "Enter shows the game, Esc goes back" if kept else "Esc goes back"
        none = [Entry("nobody yet", "")]
        super().__init__("High scores", entries or none, foot=foot)


def _there(folder: Path | None, name: str) -> bool:
    """Is a recording still there? Its name is one of a file, not a path."""
    return bool(folder and name and Path(name).name == name and (folder / name).is_file())
