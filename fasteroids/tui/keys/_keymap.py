"""A keymap: which command each key gives."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final, NamedTuple, get_args

from attrs import field, frozen
from pyrsistent import PMap, pmap

from fasteroids.tui.keys._commands import FLIGHT, Command, Group
from fasteroids.tui.keys._names import MODIFIER_KEYS, key_of, spoken
from fasteroids.tui.keys._presets import DEFAULT, PRESETS
from fasteroids.units import ModelError

__all__ = ["HelpRow", "Keymap", "bound", "cleared", "free", "help_rows", "preset"]


def _inverted(keys: Mapping[Command, tuple[str, ...]]) -> PMap[str, Command]:
    owners: dict[str, Command] = {}
    for command in Command:
        for key in keys[command]:
            if key in owners:
                first = owners[key].value
                raise ModelError(f"{spoken(key)} cannot be both {first} and {command.value}")
            owners[key] = command
    return pmap(owners)


@frozen
class Keymap:
    """The keys of every command, by Textual's names, each key for one command; and the preset they come from.

    Made by `preset`, `bound`, `cleared` and `keymap_of`.
    """

    preset: str
    keys: PMap[Command, tuple[str, ...]]
    _owners: PMap[str, Command] = field(init=False, eq=False, repr=False)

    def __attrs_post_init__(self) -> None:
        object.__setattr__(self, "_owners", _inverted(self.keys))

    def command(self, key: str) -> Command | None:
        """The command of a key as Textual names it, None if it has none. Total.

        A ship also obeys a key that comes changed: in the other case (Caps Lock), or with a modifier that is itself
        one of the keys that fly, so that one player may hold Control to fire while the other presses Left.
        """
        owner = self._owners.get(key)
        if owner is not None:
            return owner
        *modifiers, base = key.split("+")
        held = {MODIFIER_KEYS[own] for own in MODIFIER_KEYS if self._owners.get(own) in FLIGHT}
        if not set(modifiers) <= held:
            return None
        for candidate in (base, base.swapcase()):
            owner = self._owners.get(candidate)
            if owner in FLIGHT and (candidate == base or len(base) == 1):
                return owner
        return None


_KEYMAPS: Final = {name: Keymap(name, pmap(keys)) for name, keys in PRESETS.items()}


def preset(name: str = DEFAULT) -> Keymap:
    """A preset by its name. `ModelError` if there is none."""
    if name not in _KEYMAPS:
        raise ModelError(f"there is no preset {name!r}; there are {', '.join(_KEYMAPS)}")
    return _KEYMAPS[name]


def bound(keymap: Keymap, command: Command, keys: Iterable[str]) -> Keymap:
    """A keymap in which a command has these keys and no others; whoever had one of them loses it.

    `keymap.command(key)` tells beforehand who that is. `ModelError` if there is no such key.
    """
    taken = tuple(dict.fromkeys(map(key_of, keys)))
    others = {
        other: tuple(key for key in owned if key not in taken)
        for other, owned in keymap.keys.items()
    }
    return Keymap(keymap.preset, pmap({**others, command: taken}))


def cleared(keymap: Keymap, command: Command) -> Keymap:
    """A keymap in which a command has the keys of the preset again, as far as no other has them now."""
    keys = preset(keymap.preset).keys[command]
    return bound(
        keymap, command, [key for key in keys if keymap._owners.get(key, command) is command]
    )


def free(keymap: Keymap) -> tuple[Command, ...]:
    """The commands without a key."""
    return tuple(command for command in Command if not keymap.keys[command])


class HelpRow(NamedTuple):
    """A line of the help screen: a heading, what the command does, and its keys in words (none: empty)."""

    group: Group
    command: Command
    says: str
    keys: str


def help_rows(keymap: Keymap) -> tuple[HelpRow, ...]:
    """All commands with their keys, group by group."""
    return tuple(
        HelpRow(group, command, command.says, ", ".join(map(spoken, keymap.keys[command])))
        for group in get_args(Group)
        for command in Command
        if command.group == group
    )
