"""A keymap as a part of the config file.

    preset = "azerty"

    [keys]
    pause = ["p", "Enter"]
    mute = []

A command that is named has these keys and no others; all others have those of the preset. A key that the file gives to
one command is taken from the command that has it in the preset; if it was the last one, the file must say what that one
is to have, `[]` for nothing. So no command is lost by accident.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Final

from pyrsistent import pmap

from fasteroids.scene._table import nearest
from fasteroids.scene._text import (
    Problem,
    ProblemsError,
    SceneError,
    lines_of,
    parsed,
    shown,
    written,
)
from fasteroids.tui.keys._commands import Command
from fasteroids.tui.keys._keymap import Keymap, preset
from fasteroids.tui.keys._names import key_of, known_keys, spoken
from fasteroids.tui.keys._presets import DEFAULT, PRESETS
from fasteroids.units import ModelError

__all__ = ["KeymapError", "keymap_in", "keymap_of", "text_of"]


_COMMANDS: Final = {command.value: command for command in Command}


class KeymapError(ProblemsError):
    """A config file whose keys cannot be used."""


def keymap_of(text: str) -> Keymap:
    """The keymap that the text of a config file asks for. `KeymapError` tells all that is wrong, with lines.

    Only `preset` and the table `[keys]` are looked at.
    """
    try:
        document = parsed(text)
    except SceneError as error:
        raise KeymapError(error.problems) from None
    keymap, problems = keymap_in(document, lines_of(text))
    if problems:
        raise KeymapError(problems)
    return keymap


def keymap_in(
    document: Mapping[str, Any], lines: Mapping[tuple[str | int, ...], int]
) -> tuple[Keymap, tuple[Problem, ...]]:
    """The keymap of a document of TOML, and what is wrong with it, by line. `lines` are those of its keys.

    What can be used is used: a wrong entry leaves its command as it is in the preset.
    """
    problems: list[Problem] = []
    name = document.get("preset", DEFAULT)
    if not isinstance(name, str) or name not in PRESETS:
        hint = nearest(name, PRESETS) if isinstance(name, str) else ""
        message = f"must be one of {', '.join(map(written, PRESETS))}{hint}"
        problems.append(Problem(lines.get(("preset",)), None, "preset", shown(name), message))
        name = DEFAULT
    table = document.get("keys", {})
    if not isinstance(table, dict):
        line = lines.get(("keys",))
        problems.append(Problem(line, None, "keys", shown(table), "must be a table: [keys]"))
        table = {}
    reader = _Reader(table, lines, problems)
    keymap = reader.keymap(preset(name))
    return keymap, tuple(sorted(problems, key=lambda problem: problem.line or 0))


class _Reader:
    """What a table `[keys]` says, and the problems found in it so far."""

    def __init__(
        self,
        table: Mapping[str, Any],
        lines: Mapping[tuple[str | int, ...], int],
        problems: list[Problem],
    ) -> None:
        self.table, self.lines, self.problems = table, lines, problems

    def keymap(self, base: Keymap) -> Keymap:
        """The keymap that comes of a preset."""
        given: dict[Command, tuple[str, ...]] = {}
        owners: dict[str, Command] = {}
        for name, value in self.table.items():
            command = self._command(name)
            if command is not None and (keys := self._keys(name, value)) is not None:
                given[command] = self._unowned(command, keys, owners)
        keys_of = {
            command: given.get(command, tuple(key for key in keys if key not in owners))
            for command, keys in base.keys.items()
        }
        for command in Command:
            if base.keys[command] and not keys_of[command] and command not in given:
                self._lost(command, base.keys[command][0], owners)
        return Keymap(base.preset, pmap(keys_of))

    def _command(self, name: str) -> Command | None:
        command = _COMMANDS.get(name)
        if command is None:
            self._add(name, f"there is no such command{nearest(name, _COMMANDS)}")
        return command

    def _keys(self, name: str, value: object) -> list[str] | None:
        if not isinstance(value, list) or not all(isinstance(key, str) for key in value):
            self._add(name, 'must be a list of keys, such as ["p", "Enter"]')
            return None
        keys = []
        for key in value:
            try:
                keys.append(key_of(key))
            except ModelError as error:
                base = key.rpartition("+")[2].strip().lower()
                self._add(name, f"{error}{nearest(base, known_keys())}")
        # Only wrong ones: as if the command had not been named.
        return keys if keys or not value else None

    def _unowned(
        self, command: Command, keys: Iterable[str], owners: dict[str, Command]
    ) -> tuple[str, ...]:
        """The keys that no command above it has been given; the others are told of."""
        own = []
        for key in dict.fromkeys(keys):
            if key in owners:
                other = owners[key].value
                line = self.lines.get(("keys", other))
                where = "" if line is None else f" (line {line})"
                self._add(command.value, f"{spoken(key)} is given to {other} too{where}")
            else:
                owners[key] = command
                own.append(key)
        return tuple(own)

    def _lost(self, command: Command, key: str, owners: Mapping[str, Command]) -> None:
        thief = owners[key].value
        message = (
            f"{spoken(key)} is {command.value} in the preset, which has no key left: give it one, "
            f"or say {command.value} = []"
        )
        self._add(thief, message)

    def _add(self, name: str, message: str) -> None:
        value = shown(self.table[name])
        line = self.lines.get(("keys", name), self.lines.get(("keys",)))
        field = name if len(name) <= 30 else f"{name[:30]}…"
        self.problems.append(Problem(line, "[keys]", field, value, message))


def text_of(keymap: Keymap) -> str:
    """A keymap as a config file has it, with what differs from its preset; `keymap_of` reads the same back."""
    base = preset(keymap.preset).keys
    lines = [f"preset = {written(keymap.preset)}"]
    changed = [command for command in Command if keymap.keys[command] != base[command]]
    if changed:
        lines += ["", "[keys]"]
        lines += [f"{command.value} = {written(keymap.keys[command])}" for command in changed]
    return "\n".join(lines) + "\n"
