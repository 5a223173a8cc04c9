"""Names of keys: what people write, what Textual says, what a help screen shows.

Textual calls a letter or digit by itself, another character by its Unicode name in lower case with low lines
(`question_mark`), with six shorter names of its own (`slash`, `minus`, ...), and the other keys by words. Modifiers
stand before it, in alphabetical order.
"""

from __future__ import annotations

import unicodedata
from functools import cache
from typing import Final

from fasteroids.units import ModelError

__all__ = ["MODIFIER_KEYS", "key_of", "known_keys", "spoken"]

_SHORTER: Final = {
    "solidus": "slash",
    "reverse_solidus": "backslash",
    "commercial_at": "at",
    "hyphen_minus": "minus",
    "plus_sign": "plus",
    "low_line": "underscore",
}
MODIFIER_KEYS: Final = {
    f"{side}_{key}": modifier
    for side in ("left", "right")
    for key, modifier in (
        ("shift", "shift"),
        ("control", "ctrl"),
        ("alt", "alt"),
        ("super", "super"),
        ("hyper", "hyper"),
        ("meta", "meta"),
    )
}
"""Modifiers as keys of their own, which only some terminals report, and the prefix each gives to other keys."""

_WORDS: Final = (
    *("left", "right", "up", "down", "home", "end", "pageup", "pagedown", "insert", "delete"),
    *("escape", "enter", "tab", "backspace", "space"),
    *(f"f{number}" for number in range(1, 25)),
    *MODIFIER_KEYS,
)
_SAME: Final = {
    "esc": "escape",
    "return": "enter",
    "pgup": "pageup",
    "pgdn": "pagedown",
    "del": "delete",
    "ins": "insert",
    "spacebar": "space",
}
_MODIFIERS: Final = {
    "alt": "alt",
    "option": "alt",
    "ctrl": "ctrl",
    "control": "ctrl",
    "shift": "shift",
    "super": "super",
    "hyper": "hyper",
    "meta": "meta",
}
_SPOKEN: Final = {
    "escape": "Esc",
    "pageup": "PgUp",
    "pagedown": "PgDn",
    "delete": "Del",
    "insert": "Ins",
    "left": "Left",
    "right": "Right",
    "up": "Up",
    "down": "Down",
}


def _named(character: str) -> str:
    """What Textual calls a character."""
    if character.isalnum():
        return character
    name = unicodedata.name(character, "").lower().replace("-", "_").replace(" ", "_")
    return _SHORTER.get(name, name)


@cache
def _characters() -> dict[str, str]:
    """The characters of western keyboards that have names, by these."""
    signs = (chr(code) for code in (*range(33, 127), *range(0xA1, 0x100), 0x20AC))
    return {_named(sign): sign for sign in signs if not sign.isalnum()}


def known_keys() -> tuple[str, ...]:
    """The names of keys that are words."""
    return (*_WORDS, *_characters())


def key_of(text: str) -> str:
    """The name of a key as Textual says it, from what people write: `"?"`, `"Ctrl+Q"`, `"Esc"`, `"shift+a"` (`A`).

    Case counts in a letter without modifiers only. `ModelError` if there is no such key.
    """
    *parts, base = _parts(text)
    modifiers = set()
    for part in parts:
        modifier = _MODIFIERS.get(part.strip().lower())
        if modifier is None:
            raise ModelError(f"there is no modifier {part.strip()!r}; there are alt, ctrl, shift")
        modifiers.add(modifier)
    key = _base(base, text)
    if len(key) == 1 and modifiers == {"shift"} and len(key.upper()) == 1:
        return key.upper()
    if len(key) == 1 and modifiers and len(key.lower()) == 1:
        key = key.lower()
    return "+".join([*sorted(modifiers), key])


def _parts(text: str) -> list[str]:
    """The modifiers and the key; the last may be a plus sign."""
    if text.strip() == "+" or text.strip().endswith("++"):
        return [*text.strip()[:-1].split("+")[:-1], "+"]
    return text.split("+")


def _base(base: str, text: str) -> str:
    if base == " ":
        return "space"
    base = base.strip()
    if len(base) == 1 and (base.isalnum() or _named(base) in _characters()):
        return _named(base)
    word = base.lower()
    word = _SAME.get(word, word)
    word = _SHORTER.get(word, word)
    if word in _WORDS or word in _characters():
        return word
    raise ModelError(f"there is no key {text!r}")


def spoken(key: str) -> str:
    """A key as a help screen shows it, in plain ASCII for the keys of an ASCII keyboard: `Ctrl+Q`, `?`, `Left`."""
    *modifiers, base = key.split("+")
    if base in _SPOKEN:
        shown = _SPOKEN[base]
    elif base in _characters():
        shown = _characters()[base]
    elif len(base) == 1:
        shown = base.upper() if modifiers else base
    else:
        shown = base.replace("_", " ").capitalize()
    return "+".join([*map(str.capitalize, modifiers), shown])
