"""Games of ships that run programs, and what many games say about the programs."""

from fasteroids.arena.figures import (
    Interval,
    Paired,
    Standing,
    mcnemar,
    paired,
    standing,
    wilson,
)
from fasteroids.arena.games import LIMIT, Ended, crew, flown, play

__all__ = [
    "LIMIT",
    "Ended",
    "Interval",
    "Paired",
    "Standing",
    "crew",
    "flown",
    "mcnemar",
    "paired",
    "play",
    "standing",
    "wilson",
]
