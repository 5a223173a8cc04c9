"""Which known word was meant: `fasteroids.lang.names`."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang.names import LONGEST, closest, distance, shortened

WORDS = st.text("abc1", max_size=6)


@pytest.mark.parametrize(
    ("word", "candidates", "meant"),
    [
        ("asteriod", ["bullet", "asteroid"], "asteroid"),
        ("distanse", ["distances", "distance"], "distance"),
        ("True", ["true"], "true"),
        ("NEARESTASTEROID", ["nearestAsteroid"], "nearestAsteroid"),
        ("nul", ["null"], "null"),
        ("targets", ["target"], "target"),
    ],
)
def test_slips_are_understood(word: str, candidates: list[str], meant: str) -> None:
    assert closest(word, candidates) == meant


@pytest.mark.parametrize(
    ("word", "candidates"),
    [
        ("ax", ["x", "ay", "a", "ar"]),
        ("x", ["y"]),
        ("target2", ["target1", "target10"]),
        ("speed", ["power", "shield"]),
        ("same", ["same"]),
        ("a" * (LONGEST + 1), ["a" * LONGEST]),
        ("word", []),
    ],
)
def test_names_of_their_own_are_left_alone(word: str, candidates: list[str]) -> None:
    assert closest(word, candidates) is None


def test_the_nearest_wins_and_of_equals_the_first() -> None:
    assert closest("distance", ["distaces", "distancs", "distanc"]) == "distancs"


@given(WORDS, WORDS)
def test_distance_is_symmetric_and_zero_for_equals_alone(one: str, other: str) -> None:
    assert distance(one, other) == distance(other, one)
    assert (distance(one, other) == 0) == (one == other)
    assert abs(len(one) - len(other)) <= distance(one, other) <= max(len(one), len(other))


@given(WORDS, st.integers(0, 5), st.sampled_from("abc1"))
def test_one_edit_is_one_away(word: str, place: int, letter: str) -> None:
    at = min(place, len(word))
    assert distance(word, word[:at] + letter + word[at:]) == 1
    swapped = word[:at] + word[at : at + 2][::-1] + word[at + 2 :]
    assert distance(word, swapped) == (swapped != word)


def test_long_names_are_cut_where_they_are_shown() -> None:
    assert shortened("a" * LONGEST) == "a" * LONGEST
    assert shortened("a" * 1000) == "a" * (LONGEST - 3) + "..."
