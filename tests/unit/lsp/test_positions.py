"""Places in a text: in the units of an editor, and in ours."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang.source import Span
from fasteroids.lsp.positions import Encoding, Page, Position

# é: 2 bytes, ☃: 3 bytes, 🚀: 4 bytes and two units of UTF-16.
ROW = "aé☃\U0001f680b"

ENCODINGS: list[Encoding] = ["utf-8", "utf-16", "utf-32"]
encodings = st.sampled_from(ENCODINGS)
texts = st.text(st.sampled_from("ab \t\r\n\x0c\x85\u2028é☃\U0001f680\ud83d;"), max_size=30)


@pytest.mark.parametrize(
    ("encoding", "starts"),
    [
        ("utf-8", [0, 1, 3, 6, 10, 11]),
        ("utf-16", [0, 1, 2, 3, 5, 6]),
        ("utf-32", [0, 1, 2, 3, 4, 5]),
    ],
)
def test_a_character_has_as_many_units_as_its_encoding_gives_it(
    encoding: Encoding, starts: list[int]
) -> None:
    page = Page(f"x\n{ROW}", encoding)
    assert [page.position(2, column) for column in range(1, 7)] == [(1, at) for at in starts]
    assert [page.place(Position(1, at)) for at in starts] == [(2, c) for c in range(1, 7)]


def test_a_position_within_a_character_means_its_start() -> None:
    assert Page(ROW, "utf-16").place(Position(0, 4)) == (1, 4)
    assert Page(ROW, "utf-8").place(Position(0, 9)) == (1, 4)


@pytest.mark.parametrize("row", ["ab", "é☃"])
def test_positions_outside_the_text_mean_its_nearest_place(row: str) -> None:
    page = Page(f"{row}\r\n{row}")
    assert page.place(Position(0, 99)) == (1, 3)
    assert page.place(Position(9, 0)) == (2, 3)
    assert page.place(Position(-1, 5)) == (1, 1)
    assert page.place(Position(1, -5)) == (2, 1)
    assert page.position(9, 1) == (1, 2)
    assert page.range(Span(1, 2, 3, 1)) == ((0, 1), (1, 2))


def test_only_the_line_ends_of_the_protocol_end_a_line() -> None:
    page = Page("a\x0cb\u2028c\x85d\re\nf\r\ng")
    assert page.place(Position(0, 6)) == (1, 7)
    assert [page.place(Position(line, 9)) for line in (1, 2, 3)] == [(2, 2), (3, 2), (4, 2)]


@given(texts, encodings, st.integers(-2, 40), st.integers(-2, 40))
def test_a_place_is_its_position_and_back(
    text: str, encoding: Encoding, line: int, units: int
) -> None:
    page = Page(text, encoding)
    place = page.place(Position(line, units))
    position = page.position(*place)
    assert page.place(position) == place
    assert page.position(*page.place(position)) == position
    if position.line == line:
        assert position.character <= max(units, 0)
