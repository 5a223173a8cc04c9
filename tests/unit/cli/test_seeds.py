"""Seeds in short, and read."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.cli._seeds import MOST_SEEDS, in_short, seeds_of


@pytest.mark.parametrize(
    ("text", "seeds"),
    [
        ("7", (7,)),
        ("0-3", (0, 1, 2, 3)),
        ("1,4,9-12", (1, 4, 9, 10, 11, 12)),
        ("9-12, 4  1", (1, 4, 9, 10, 11, 12)),
        ("5,3-6,4", (3, 4, 5, 6)),
        ("5-5", (5,)),
        (" 007 ", (7,)),
    ],
)
def test_seeds_are_read(text: str, seeds: tuple[int, ...]) -> None:
    assert seeds_of(text) == seeds


@pytest.mark.parametrize(
    ("text", "why"),
    [
        *((text, "must be seeds such as") for text in ("", "x", "1,,2", "-5", "1-", "1-2-3", "1.5", "²", "9" * 19)),
        ("9-3", "9-3 runs backwards; write 3-9"),
        (f"0-{MOST_SEEDS}", "at most"),
        ("0-999999999999999999", "at most"),
        (f"5,10-{MOST_SEEDS + 9}", "at most"),
        (f"0-{MOST_SEEDS - 1} {MOST_SEEDS}", "at most"),
    ],
)  # fmt: skip
def test_anything_else_is_refused(text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        seeds_of(text)


def test_as_many_as_allowed() -> None:
    assert len(seeds_of(f"1-{MOST_SEEDS}")) == MOST_SEEDS


def test_seeds_given_twice_count_once() -> None:
    assert len(seeds_of(f"7,0-{MOST_SEEDS - 1},3-9")) == MOST_SEEDS


@pytest.mark.parametrize(
    ("seeds", "text"),
    [([], ""), ([4], "4"), ([3, 2, 1, 0, 5, 12, 9, 10, 11, 5], "0-3 5 9-12"), ([1, 2], "1-2")],
)
def test_seeds_in_a_row_are_a_range(seeds: list[int], text: str) -> None:
    assert in_short(seeds) == text


@given(st.sets(st.one_of(st.integers(0, 40), st.integers(0, 10**18 - 1)), min_size=1))
def test_what_is_told_in_short_reads_the_same(seeds: set[int]) -> None:
    assert seeds_of(in_short(seeds)) == tuple(sorted(seeds))
    assert seeds_of(in_short(seeds).replace(" ", ",")) == tuple(sorted(seeds))
