"""The config file: a keymap and a few choices, from TOML and back.

    preset = "vim"       # see fasteroids.tui.keys
    arena = "ascii"      # or braille, block
    fps = 60             # frames a second, 1 to 120
    sound = false

    [keys]
    pause = ["p"]

What is wrong is told, with its line, and the default is used in its place; one wrong line spoils no other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final

from attrs import evolve, field, frozen

from fasteroids.scene._table import nearest
from fasteroids.scene._text import Problem, SceneError, lines_of, parsed, shown, written
from fasteroids.tui import keys
from fasteroids.tui.keys import Keymap, keymap_in, preset
from fasteroids.tui.terminal import ARENAS, Arena

__all__ = ["DEFAULTS", "MOST_FPS", "Settings", "read_settings", "text_of"]

MOST_FPS: Final = 120
"""Frames a second at most."""


@frozen
class Settings:
    """What the user has chosen. `arena`: None where the terminal decides (`terminal_of`). `fps`: frames a second."""

    keymap: Keymap = field(factory=preset)
    arena: Arena | None = None
    fps: int = 30
    sound: bool = True


DEFAULTS: Final = Settings()

_FIELDS: Final[Mapping[str, tuple[str, Callable[[Any], bool]]]] = {
    "arena": (
        f"must be one of {', '.join(map(written, ARENAS))}",
        lambda value: isinstance(value, str) and value in ARENAS,
    ),
    "fps": (
        f"must be an integer from 1 to {MOST_FPS}",
        lambda value: type(value) is int and 1 <= value <= MOST_FPS,
    ),
    "sound": ("must be true or false", lambda value: isinstance(value, bool)),
}
_NAMES: Final = ("preset", *_FIELDS, "keys")


def read_settings(text: str) -> tuple[Settings, tuple[Problem, ...]]:
    """The settings in a text, and what is wrong with it, by line; `str` of a problem is a sentence. Total."""
    try:
        document = parsed(text)
    except SceneError as error:
        return DEFAULTS, error.problems
    lines = lines_of(text)
    keymap, problems = keymap_in(document, lines)
    found = list(problems)
    values: dict[str, Any] = {}
    for name, value in document.items():
        line = lines.get((name,))
        if name not in _NAMES:
            message = f"there is no such setting{nearest(name, _NAMES)}"
            found.append(Problem(line, None, f"{name:.30}", shown(value), message))
        elif name in _FIELDS:
            allowed, fits = _FIELDS[name]
            if fits(value):
                values[name] = value
            else:
                found.append(Problem(line, None, name, shown(value), allowed))
    settings = evolve(DEFAULTS, keymap=keymap, **values)
    return settings, tuple(sorted(found, key=lambda problem: problem.line or 0))


def text_of(settings: Settings) -> str:
    """The settings as a config file; `read_settings` reads the same back. Comments of an older file are not kept."""
    lines = [
        f"{name} = {written(value)}"
        for name in _FIELDS
        if (value := getattr(settings, name)) != getattr(DEFAULTS, name)
    ]
    return "\n".join([*lines, keys.text_of(settings.keymap)])
