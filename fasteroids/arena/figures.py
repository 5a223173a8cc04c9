"""What many games say: shares with their uncertainty, and whether one program is better than another.

Intervals are of 95 %. Programs are compared on the same seeds: games that both win or both lose say nothing about which
is better, so only those count in which one of the two won (McNemar, Psychometrika 12, 1947).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping
from fractions import Fraction
from math import comb, sqrt
from statistics import NormalDist, fmean, median
from typing import Final, TypeVar

from attrs import frozen

from fasteroids.arena.games import Ended

__all__ = ["Interval", "Paired", "Standing", "mcnemar", "paired", "standing", "wilson"]

K = TypeVar("K", bound=Hashable)

_Z: Final = NormalDist().inv_cdf(0.975)


@frozen
class Interval:
    """From low to high, both shares from 0 to 1."""

    low: float
    high: float


@frozen
class Standing:
    """What a program did in its games.

    `won` counts the games in which it cleared its field or won, `lost` those in which it died first, `drawn` those in
    which both ships died at one event. `death` is its mean time of death and `clearing` the median time of what it won,
    s; None without any. `fuel` counts the ticks out of fuel of all games, `stopped` the games in which its program
    stopped at an illegal operation.
    """

    games: int
    won: int
    lost: int
    drawn: int
    timed_out: int
    death: float | None
    clearing: float | None
    fuel: int
    stopped: int

    @property
    def share(self) -> float:
        """The share of games won."""
        return self.won / self.games if self.games else 0.0


@frozen
class Paired:
    """Two programs on the same games: how many only the first won, only the second, both, neither.

    `p` is the chance of so uneven a split, or one more so, between equals.
    """

    first: int
    second: int
    both: int
    neither: int
    p: float


def wilson(won: int, games: int) -> Interval:
    """The 95 % interval of a share: Wilson's, which also holds near 0 and 1 (JASA 22, 1927). Without games, all."""
    if games == 0:
        return Interval(0.0, 1.0)
    share, z2 = won / games, _Z * _Z
    middle = share + z2 / (2 * games)
    reach = _Z * sqrt(share * (1.0 - share) / games + z2 / (4 * games * games))
    scale = 1.0 + z2 / games
    low = 0.0 if won == 0 else (middle - reach) / scale
    high = 1.0 if won == games else (middle + reach) / scale
    return Interval(low, high)


def mcnemar(first: int, second: int) -> float:
    """The two-sided p-value of `first` to `second` among the games that only one of two won; exact (binomial)."""
    games = first + second
    tail = sum(comb(games, k) for k in range(min(first, second) + 1))
    return float(min(Fraction(1), Fraction(2 * tail, 2**games)))


def standing(games: Iterable[Ended]) -> Standing:
    """What a program did in its games."""
    games = list(games)
    outcomes = Counter(game.outcome for game in games)
    deaths = [game.time for game in games if game.outcome in ("died", "lost", "drawn")]
    wins = [game.time for game in games if game.good]
    return Standing(
        games=len(games),
        won=len(wins),
        lost=outcomes["died"] + outcomes["lost"],
        drawn=outcomes["drawn"],
        timed_out=outcomes["timed out"],
        death=fmean(deaths) if deaths else None,
        clearing=median(wins) if wins else None,
        fuel=sum(game.fuel for game in games),
        stopped=sum(game.stopped is not None for game in games),
    )


def paired(first: Mapping[K, Ended], second: Mapping[K, Ended]) -> Paired:
    """Two programs compared on the games that both played, alone or against each other, by seed (or any key)."""
    counts = Counter((first[key].good, second[key].good) for key in first.keys() & second.keys())
    one, other = counts[True, False], counts[False, True]
    return Paired(one, other, counts[True, True], counts[False, False], mcnemar(one, other))
