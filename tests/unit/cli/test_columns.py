"""Tables of plain text."""

from __future__ import annotations

import pytest

from fasteroids.cli._columns import aligned


def test_columns_are_as_wide_as_their_widest_cell() -> None:
    rows = [("bot", "games", "note"), ("turret", "7", ""), ("é", "1,200", "x")]
    assert aligned(rows, right={1}) == [
        "bot     games  note",
        "turret      7",
        "é       1,200  x",
    ]


def test_columns_are_aligned_by_cells_and_not_by_characters() -> None:
    """Chinese characters are two cells wide."""
    rows = [("bot", "won"), ("炮塔", "7"), ("ab", "12")]
    assert aligned(rows, right={1}) == ["bot   won", "炮塔    7", "ab     12"]


def test_rows_of_unequal_length_are_an_error_of_ours() -> None:
    with pytest.raises(ValueError, match="zip"):
        aligned([("a", "b"), ("c",)])
