"""Units, constants and limits, each with its source.

Lengths are kilometres (km), times seconds (s), masses kilograms (kg), angles radians (rad); hence speeds are
km/s, densities kg/km^3, accelerations km/s^2 and forces kg km/s^2 (one such unit is 1000 newton).
Section numbers refer to the text of the assignment (OGP 2012-2013, part III).
"""

from __future__ import annotations

import sys
from math import inf
from numbers import Real
from typing import Final

__all__ = [
    "ASTEROID_DENSITY",
    "BULLET_DENSITY",
    "BULLET_RADIUS",
    "BULLET_SPEED",
    "CHILD_SPEED_FACTOR",
    "FUEL",
    "MAX_ACCELERATION",
    "MAX_BULLETS",
    "MAX_FUEL",
    "MAX_WORLD_SIZE",
    "SPEED_OF_LIGHT",
    "SPLIT_RADIUS",
    "THRUST",
    "TICKS_PER_SECOND",
    "WINDOW",
    "ModelError",
    "number",
    "shown",
]

SPEED_OF_LIGHT: Final = 300_000.0
"""c, the upper bound of every speed limit, km/s (1.2, 1.3, 1.4)."""

MAX_WORLD_SIZE: Final = sys.float_info.max
"""Upper bound of the width and of the height of every world, km (1.1). The one place to lower it."""

THRUST: Final = 1.1e18
"""Force of the standard thruster, kg km/s^2: 1.1e21 N = 1.1e21 kg m/s^2 (1.2)."""

MAX_ACCELERATION: Final = 2.0**1000
"""Upper bound of what a thruster does to a ship, however small its mass, km/s^2. The one place to lower it.

The size of an acceleration, sums of a few and products with a few seconds are then doubles. At this bound a ship
is at the speed of light within 2^-981 s and 2^-964 km, so nobody can tell who does not look closer than that.
"""

ASTEROID_DENSITY: Final = 2.65e12
"""kg/km^3 (1.3)."""

BULLET_DENSITY: Final = 7.8e12
"""kg/km^3 (1.4)."""

BULLET_RADIUS: Final = 3.0
"""Radius of a fired bullet, km (1.4)."""

BULLET_SPEED: Final = 250.0
"""Initial speed of a fired bullet, km/s (1.4)."""

MAX_BULLETS: Final = 3
"""A ship with this many bullets in its world cannot fire (1.4)."""

SPLIT_RADIUS: Final = 30.0
"""An asteroid of at least this radius (km) leaves two children when it dies (1.7)."""

CHILD_SPEED_FACTOR: Final = 1.5
"""Speed of a child over the speed of its parent (1.7)."""

TICKS_PER_SECOND: Final = 5
"""Programs run every 0.2 s (1.6). Kept as an integer: tick k happens at the double nearest to k / 5."""

FUEL: Final = 10_000
"""Small steps a program may take in one tick, expressions included. Ours: 1.8 lets a program without an action run
for ever, and so hang the world it is in."""

MAX_FUEL: Final = 1_000_000_000
"""The most a world may grant: a tick of minutes."""

WINDOW: Final = 1024.0
"""Length of a window of time, s. A power of two, so splitting a time is exact (see `fasteroids.moments`)."""


class ModelError(ValueError):
    """The caller asked for something the model does not allow.

    The message is a sentence that says what was given and what is allowed. It is the only exception the
    library raises on purpose.
    """


def number(value: object, what: str) -> float:
    """`value` as a float (huge integers become infinite), or `ModelError` naming `what`."""
    if not isinstance(value, Real) or isinstance(value, bool):
        raise ModelError(f"{what} must be a number; got {shown(value)}")
    try:
        return float(value)
    except OverflowError:
        return inf if value > 0 else -inf  # type: ignore[operator]


def shown(value: object) -> str:
    """A value as error messages show it: its repr, cut short, and never an error of its own."""
    try:
        text = repr(value)
    except ValueError:  # an integer of more digits than Python prints
        return "a huge integer"
    except RecursionError:
        return "something nested too deeply to show"
    return text if len(text) <= 200 else text[:197] + "..."
