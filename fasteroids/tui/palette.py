"""The colours and figures of the arena: what an index means, in one place.

A frame says of each run of cells which index of `COLOURS` paints it; nothing else knows a colour. Ships take the six
colours of Okabe and Ito that stand out most on near-black (contrasts 15.8 to 5.4); the seventh, blue (4.0), is only
for what lies behind. Because colours can be missing (NO_COLOR) or look alike, each ship also has a figure and a letter.

Okabe, M. and Ito, K.: Color Universal Design, 2008, https://jfly.uni-koeln.de/color/.
"""

from __future__ import annotations

from typing import Final, NamedTuple, TypeAlias

__all__ = [
    "ASTEROID",
    "BACKGROUND",
    "BULLET",
    "COLOURS",
    "EXPLOSION",
    "FIGURES",
    "FLAME",
    "GHOST",
    "OVERLAY",
    "PLAYERS",
    "SELECTED",
    "TRAIL",
    "WALL",
    "Colour",
    "Figure",
    "figure",
    "letter",
    "player",
]


class Colour(NamedTuple):
    """How an index is painted."""

    name: str
    hex: str
    bold: bool = False


BACKGROUND: Final = "#0b0e14"
"""What lies behind every cell."""

COLOURS: Final = (
    Colour("blank", "#0b0e14"),
    Colour("wall", "#0072b2"),  # Okabe-Ito blue
    Colour("asteroid", "#b8b8b8"),
    Colour("bullet", "#ffffff", bold=True),
    Colour("flame", "#ff9f43"),
    Colour("explosion", "#ffd166", bold=True),
    Colour("trail", "#808080"),
    Colour("overlay", "#7a9cc6"),
    Colour("ghost", "#6a6a6a"),
    Colour("selected", "#ffffff", bold=True),
    Colour("yellow", "#f0e442", bold=True),
    Colour("orange", "#e69f00", bold=True),
    Colour("sky", "#56b4e9", bold=True),
    Colour("purple", "#cc79a7", bold=True),
    Colour("green", "#009e73", bold=True),
    Colour("vermilion", "#d55e00", bold=True),
)
"""Index -> colour. Index 0 is a blank cell; the last six belong to the ships."""

WALL: Final = 1
ASTEROID: Final = 2
BULLET: Final = 3
FLAME: Final = 4
EXPLOSION: Final = 5
TRAIL: Final = 6
OVERLAY: Final = 7
GHOST: Final = 8
SELECTED: Final = 9
_SHIPS: Final = 10

PLAYERS: Final = len(COLOURS) - _SHIPS
"""How many ships differ in colour and figure; further ones begin again."""

Figure: TypeAlias = tuple[tuple[tuple[float, float], ...], ...]
"""Polylines in units of a ship's radius: (forward, left) of its centre, the nose at (1, 0)."""

_WEDGE: Final = (((1.2, 0.0), (-0.9, 0.8), (-0.9, -0.8), (1.2, 0.0)),)
_DART: Final = (((1.2, 0.0), (-1.0, 0.9), (-0.3, 0.0), (-1.0, -0.9), (1.2, 0.0)),)
_PLANE: Final = (((1.3, 0.0), (-1.0, 0.0)), ((-0.6, 1.0), (0.3, 0.0), (-0.6, -1.0)))
_KITE: Final = (((1.3, 0.0), (-0.4, 0.8), (-1.0, 0.0), (-0.4, -0.8), (1.3, 0.0)),)
_ARROW: Final = (((-0.9, 0.8), (1.2, 0.0), (-0.9, -0.8)), ((1.2, 0.0), (-0.9, 0.0)))
_TANK: Final = (
    ((0.4, 0.7), (-0.9, 0.7), (-0.9, -0.7), (0.4, -0.7), (0.4, 0.7)),
    ((0.4, 0.0), (1.4, 0.0)),
)
FIGURES: Final[tuple[Figure, ...]] = (_WEDGE, _DART, _PLANE, _KITE, _ARROW, _TANK)
"""What tells ships apart without colours, by rank."""

_LETTERS: Final = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def player(rank: int) -> int:
    """The colour of the ship of this rank (0 for the first)."""
    return _SHIPS + rank % PLAYERS


def figure(rank: int) -> Figure:
    """The figure of the ship of this rank."""
    return FIGURES[rank % PLAYERS]


def letter(rank: int) -> str:
    """The letter of the ship of this rank; ranks beyond Z begin again."""
    return _LETTERS[rank % len(_LETTERS)]
