"""Figures: intervals and p-values against tables, and the laws they keep."""

from __future__ import annotations

from itertools import product
from math import sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.arena import Ended, Interval, Paired, mcnemar, paired, standing, wilson
from fasteroids.arena.games import Outcome

shares = st.integers(1, 2000).flatmap(
    lambda games: st.tuples(st.integers(0, games), st.just(games))
)
"""Games won, of how many."""

splits = st.tuples(st.integers(0, 300), st.integers(0, 300))


# Wilson.


@pytest.mark.parametrize(
    ("won", "games", "low", "high"),
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)],
)  # fmt: skip
def test_wilson_has_the_values_of_the_table(won: int, games: int, low: float, high: float) -> None:
    """Newcombe, Statistics in Medicine 17 (1998), table I, method 3."""
    found = wilson(won, games)
    assert (round(found.low, 4), round(found.high, 4)) == (low, high)


def test_without_games_any_share_is_possible() -> None:
    assert wilson(0, 0) == Interval(0.0, 1.0)


@given(shares)
def test_the_ends_are_the_shares_at_which_the_score_test_decides(some: tuple[int, int]) -> None:
    """How Wilson defined them: there the share seen is 1.96 standard errors away."""
    won, games = some
    found = wilson(won, games)
    for end in (found.low, found.high):
        if 0.0 < end < 1.0:
            error = sqrt(end * (1.0 - end) / games)
            assert abs(won / games - end) / error == pytest.approx(1.959963984540054, rel=1e-6)


@given(shares)
def test_an_interval_contains_the_share(some: tuple[int, int]) -> None:
    won, games = some
    found = wilson(won, games)
    assert 0.0 <= found.low <= won / games <= found.high <= 1.0
    assert found.low < found.high
    assert (found.low == 0.0) == (won == 0)
    assert (found.high == 1.0) == (won == games)


@given(shares)
def test_an_interval_of_the_games_not_won_is_the_mirror_image(some: tuple[int, int]) -> None:
    won, games = some
    one, other = wilson(won, games), wilson(games - won, games)
    assert one.low == pytest.approx(1.0 - other.high, abs=1e-12)
    assert one.high == pytest.approx(1.0 - other.low, abs=1e-12)


@given(shares)
def test_an_interval_grows_with_the_games_won(some: tuple[int, int]) -> None:
    won, games = some
    if won < games:
        less, more = wilson(won, games), wilson(won + 1, games)
        assert less.low < more.low
        assert less.high < more.high


@given(shares, st.integers(2, 50))
def test_more_games_of_the_same_share_say_more(some: tuple[int, int], times: int) -> None:
    won, games = some
    few, many = wilson(won, games), wilson(times * won, times * games)
    assert many.high - many.low < few.high - few.low


# McNemar.


@pytest.mark.parametrize(
    ("first", "second", "p"),
    [
        (0, 0, 1.0),
        (1, 0, 1.0),
        (0, 5, 2 / 32),
        (0, 6, 2 / 64),
        (1, 5, 14 / 64),
        (2, 10, 2 * (1 + 12 + 66) / 4096),
        (5, 5, 1.0),
        (4, 6, 2 * (1 + 10 + 45 + 120 + 210) / 1024),
        (5, 15, 0.041389),  # of tables of the sign test, to six digits
        (8, 17, 0.107752),
    ],
)
def test_mcnemar_has_the_values_of_the_sign_test(first: int, second: int, p: float) -> None:
    assert mcnemar(first, second) == pytest.approx(p, abs=5e-7)


@given(st.integers(0, 10), st.integers(0, 10))
def test_p_is_the_share_of_equals_that_split_so_unevenly(first: int, second: int) -> None:
    games = min(first + second, 12)
    first = min(first, games)
    second = games - first
    splits = [abs(2 * sum(wins) - games) for wins in product((0, 1), repeat=games)]
    uneven = sum(split >= abs(first - second) for split in splits)
    assert mcnemar(first, second) == pytest.approx(uneven / 2**games, rel=1e-12)


@given(splits)
def test_p_is_a_chance_and_does_not_know_who_is_first(split: tuple[int, int]) -> None:
    first, second = split
    p = mcnemar(first, second)
    assert 0.0 < p <= 1.0
    assert mcnemar(second, first) == p


@given(splits)
def test_p_falls_as_a_split_gets_more_uneven(split: tuple[int, int]) -> None:
    less, more = sorted(split)
    if less:
        assert mcnemar(less - 1, more + 1) < mcnemar(less, more) or less == more


def test_p_of_very_many_games_does_not_overflow() -> None:
    assert mcnemar(0, 5000) == 0.0
    assert 0.0 < mcnemar(10_000, 10_300) < 0.05


# Standings.


def ends(*outcomes: tuple[Outcome, float]) -> list[Ended]:
    return [Ended(outcome, time) for outcome, time in outcomes]


def test_a_standing_sums_up_games_alone() -> None:
    games = ends(
        ("cleared", 20.0), ("cleared", 50.0), ("cleared", 21.0), ("died", 4.0), ("died", 8.0)
    )
    found = standing([*games, Ended("timed out", 120.0, 7, "line 1: sqrt null")])
    assert (found.games, found.won, found.lost, found.drawn, found.timed_out) == (6, 3, 2, 0, 1)
    assert (found.death, found.clearing) == (6.0, 21.0)
    assert (found.fuel, found.stopped) == (7, 1)
    assert found.share == 0.5


def test_a_standing_sums_up_games_of_two() -> None:
    found = standing(ends(("won", 10.0), ("lost", 6.0), ("drawn", 12.0), ("timed out", 120.0)))
    assert (found.games, found.won, found.lost, found.drawn, found.timed_out) == (4, 1, 1, 1, 1)
    assert (found.death, found.clearing) == (9.0, 10.0)


def test_a_standing_of_no_games() -> None:
    found = standing([])
    assert (found.games, found.share, found.death, found.clearing) == (0, 0.0, None, None)


def test_pairs_are_counted_on_the_games_of_both() -> None:
    good, bad = Ended("cleared", 9.0), Ended("died", 3.0)
    first = {1: good, 2: good, 3: good, 4: bad, 5: bad, 8: good}
    second = {1: good, 2: bad, 3: bad, 4: good, 5: bad, 9: good}
    assert paired(first, second) == Paired(first=2, second=1, both=1, neither=1, p=1.0)


@given(st.lists(st.tuples(st.booleans(), st.booleans()), max_size=40))
def test_a_comparison_the_other_way_round_is_its_mirror_image(
    games: list[tuple[bool, bool]],
) -> None:
    ends = (Ended("died", 1.0), Ended("cleared", 1.0))
    first = {i: ends[one] for i, (one, _) in enumerate(games)}
    second = {i: ends[other] for i, (_, other) in enumerate(games)}
    here, there = paired(first, second), paired(second, first)
    assert (here.first, here.second) == (there.second, there.first)
    assert (here.both, here.neither, here.p) == (there.both, there.neither, there.p)
    assert here.first + here.second + here.both + here.neither == len(games)
