"""Leagues: which games are played, and what they say."""

from __future__ import annotations

import pytest

from fasteroids.arena import Ended, Game, between, fixtures, games_of, paired, ranked

CLEARED, DIED, LATE = Ended("cleared", 20.0), Ended("died", 5.0), Ended("timed out", 120.0)
WON, LOST, DRAWN = Ended("won", 9.0), Ended("lost", 9.0), Ended("drawn", 9.0)


def test_alone_each_plays_each_seed() -> None:
    assert fixtures(["a", "b"], 1, [3, 9]) == (
        Game(("a",), 3), Game(("b",), 3), Game(("a",), 9), Game(("b",), 9),
    )  # fmt: skip


@pytest.mark.parametrize("bots", ["ab", "abc", "abcde"])
def test_of_two_ships_every_two_play_each_seed_on_both_sides(bots: str) -> None:
    games = fixtures([*bots], 2, range(4))
    assert len(set(games)) == len(games) == 4 * len(bots) * (len(bots) - 1)
    assert all(Game(game.bots[::-1], game.seed) in games for game in games)
    assert all(game.bots[0] != game.bots[1] for game in games)


def test_more_games_come_with_more_seeds_and_the_old_ones_stay() -> None:
    assert fixtures(["a", "b"], 2, range(5))[:6] == fixtures(["a", "b"], 2, range(3))


def test_games_of_one_are_seen_from_its_side() -> None:
    played = {
        Game(("a", "b"), 1): (WON, LOST),
        Game(("b", "a"), 1): (DRAWN, DRAWN),
        Game(("b", "c"), 1): (LOST, WON),
    }
    assert games_of("a", played) == {Game(("a", "b"), 1): WON, Game(("b", "a"), 1): DRAWN}
    assert [each.outcome for each in games_of("b", played).values()] == ["lost", "drawn", "lost"]


def test_the_best_comes_first() -> None:
    ends = {"few": (CLEARED, DIED, DIED), "late": (CLEARED, LATE, LATE), "best": (CLEARED, CLEARED, DIED),
            "same": (CLEARED, LATE, LATE)}  # fmt: skip
    played = {
        Game((bot,), seed): (ended,)
        for bot, each in ends.items()
        for seed, ended in enumerate(each)
    }
    table = ranked(["few", "late", "same", "best"], played)
    assert list(table) == ["best", "late", "same", "few"]
    assert (table["late"].won, table["late"].timed_out) == (1, 2)


def test_two_alone_are_compared_by_seeds() -> None:
    played = {
        Game(("a",), 1): (CLEARED,), Game(("b",), 1): (DIED,),
        Game(("a",), 2): (DIED,), Game(("b",), 2): (LATE,),
        Game(("c",), 1): (CLEARED,),
    }  # fmt: skip
    pair = paired(*between("a", "b", played))
    assert (pair.first, pair.second, pair.both, pair.neither) == (1, 0, 0, 1)


def test_two_against_each_other_are_compared_by_games() -> None:
    played = {
        Game(("a", "b"), 1): (WON, LOST), Game(("b", "a"), 1): (LOST, WON),
        Game(("a", "b"), 2): (LOST, WON), Game(("b", "a"), 2): (DRAWN, DRAWN),
        Game(("a", "c"), 1): (WON, LOST),
    }  # fmt: skip
    pair = paired(*between("a", "b", played))
    assert (pair.first, pair.second, pair.both, pair.neither) == (2, 1, 0, 1)
