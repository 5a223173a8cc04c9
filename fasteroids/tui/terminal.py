"""What a terminal can show, as far as the environment tells: pure, from a mapping of its variables."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final, Literal, TypeAlias

from attrs import frozen

__all__ = ["ARENAS", "Arena", "Terminal", "is_utf8", "terminal_of"]

Arena: TypeAlias = Literal["ascii", "braille", "block"]
"""How the arena is drawn."""

ARENAS: Final[tuple[Arena, ...]] = ("ascii", "braille", "block")

_LOCALES: Final = ("LC_ALL", "LC_CTYPE", "LANG")  # by POSIX the first that is not empty counts
_UTF8: Final = re.compile(r"[^.@]*\.utf-?8(?:@.*)?|utf-?8", re.IGNORECASE)


@frozen
class Terminal:
    """`arena` is the style to begin with, `colour` whether to use colours, `note` a sentence why, for the user."""

    arena: Arena
    colour: bool
    note: str


def is_utf8(environment: Mapping[str, str]) -> bool:
    """Does the locale name UTF-8? LC_ALL counts before LC_CTYPE, that before LANG; empty ones do not count."""
    locale = next((value for name in _LOCALES if (value := environment.get(name, ""))), "")
    return _UTF8.fullmatch(locale) is not None


def terminal_of(environment: Mapping[str, str]) -> Terminal:
    """The style to begin with, and colours.

    Braille only if the locale names UTF-8 and TERM is not `linux`, `dumb` or that of a VT (`vt100`, `vt220`; `vte`,
    which is none, is allowed); ASCII otherwise. No colours if NO_COLOR is there and not empty (https://no-color.org),
    or the terminal is dumb.
    """
    term = environment.get("TERM", "")
    kind = term.partition("-")[0]
    if kind in ("linux", "dumb") or (kind.startswith("vt") and kind != "vte"):
        arena, why = _ASCII, f"TERM is {term:.40}"
    elif not is_utf8(environment):
        arena, why = _ASCII, "no locale names UTF-8"
    else:
        arena, why = _BRAILLE, "the locale names UTF-8"
    shown = "ASCII" if arena == _ASCII else "Braille"
    plain = [
        reason
        for reason, holds in (
            ("NO_COLOR is set", bool(environment.get("NO_COLOR"))),
            ("the terminal is dumb", kind == "dumb"),
        )
        if holds
    ]
    colours = f"; no colours: {plain[0]}" if plain else ""
    return Terminal(arena, not plain, f"{shown}: {why}{colours}")


_ASCII: Final[Arena] = "ascii"
_BRAILLE: Final[Arena] = "braille"
