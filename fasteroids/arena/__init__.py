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
from fasteroids.arena.league import Game, Played, between, fixtures, games_of, ranked

__all__ = [
    "LIMIT",
    "Ended",
    "Game",
    "Interval",
    "Paired",
    "Played",
    "Standing",
    "between",
    "crew",
    "fixtures",
    "flown",
    "games_of",
    "mcnemar",
    "paired",
    "play",
    "ranked",
    "standing",
    "wilson",
]
