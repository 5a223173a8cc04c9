"""Which games a comparison of programs takes, and what they say of each program and of every two.

All programs play the same seeds: alone in a field, or every two against each other, twice on each seed with sides
swapped. So luck of the field is the same for all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import permutations
from typing import TypeAlias

from attrs import frozen

from fasteroids.arena.figures import Standing, standing
from fasteroids.arena.games import Ended

__all__ = ["Game", "Played", "between", "fixtures", "games_of", "ranked"]


@frozen
class Game:
    """A game to play: the names of the programs of its ships, in the order of their ids, and the seed of its field."""

    bots: tuple[str, ...]
    seed: int


Played: TypeAlias = Mapping[Game, tuple[Ended, ...]]
"""How games ended, for each ship in order."""


def fixtures(bots: Sequence[str], ships: int, seeds: Iterable[int]) -> tuple[Game, ...]:
    """The games of these programs in a field with so many ships, seed by seed.

    With one ship each program is alone; with two every two play each other twice, with sides swapped.
    """
    crews = list(permutations(bots, ships))
    return tuple(Game(crew, seed) for seed in seeds for crew in crews)


def games_of(bot: str, played: Played) -> dict[Game, Ended]:
    """How all games of a program ended for it."""
    return {game: ended[game.bots.index(bot)] for game, ended in played.items() if bot in game.bots}


def ranked(bots: Iterable[str], played: Played) -> dict[str, Standing]:
    """What each program did, from the best on: most games won, then fewest lost, then as given."""
    table = {bot: standing(games_of(bot, played).values()) for bot in bots}
    return dict(sorted(table.items(), key=lambda row: (-row[1].won, row[1].lost)))


def between(
    first: str, second: str, played: Played
) -> tuple[dict[object, Ended], dict[object, Ended]]:
    """How the games that compare two programs ended for the first and for the second.

    The keys pair them: the seed where each is alone, the game where one is against the other.
    """
    ends: dict[str, dict[object, Ended]] = {first: {}, second: {}}
    for game, ended in played.items():
        if ends.keys() >= set(game.bots):
            key = game.seed if len(game.bots) == 1 else game
            for bot, one in zip(game.bots, ended, strict=True):
                ends[bot][key] = one
    return ends[first], ends[second]
