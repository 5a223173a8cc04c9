"""Surfaces of cells: which character a dot becomes, how round a circle is, what is cut off, whose colour a cell has."""

from __future__ import annotations

from math import hypot

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.tui.canvas import SURFACES, Canvas, canvas

NAMES = sorted(SURFACES)
ANY = st.floats(allow_nan=True, allow_infinity=True) | st.floats(-50, 250)

SIXTEENTHS = st.integers(-16 * 40, 16 * 80).map(lambda n: n / 16)


def text(surface: Canvas) -> list[str]:
    return [row.text for row in surface.read()]


def inked(surface: Canvas) -> list[tuple[int, int]]:
    """The cells that are not blank, as (column, row)."""
    return [(c, r) for r, line in enumerate(text(surface)) for c, sign in enumerate(line) if sign != " "]  # fmt: skip


def span(places: list[int]) -> int:
    return max(places) - min(places) + 1


@pytest.mark.parametrize(
    ("x", "y", "sign"),
    [(0, 0, "⠁"), (0, 1, "⠂"), (0, 2, "⠄"), (0, 3, "⡀"), (1, 0, "⠈"), (1, 1, "⠐"), (1, 2, "⠠"), (1, 3, "⢀")],
)  # fmt: skip
def test_each_dot_of_a_braille_cell_is_where_unicode_puts_it(x, y, sign):
    surface = canvas("braille", 3, 2)
    surface.dot(2.0 + x, 4.0 + y, 1)
    assert text(surface) == ["   ", f" {sign} "]


def test_half_blocks_are_upper_lower_and_both():
    surface = canvas("block", 3, 1)
    for x, y in ((0, 0), (1, 1), (2, 0), (2, 1)):
        surface.dot(x, y, 1)
    assert text(surface) == ["▀▄█"]


@pytest.mark.parametrize("name", NAMES)
def test_what_is_not_drawn_on_is_a_space_without_colour(name):
    assert canvas(name, 4, 2).read() == ((" " * 4, ()), (" " * 4, ()))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("radius", [5.0, 8.0, 13.3, 20.0, 31.0, 60.0, 90.0])
def test_a_circle_is_as_high_as_wide(name, radius):
    """A cell counts 1 by 2; a circle may be off by what a cell, or a dot in it, cannot show."""
    surface = canvas(name, 240, 120)
    surface.circle(surface.width / 2, surface.height / 2, radius, 1)
    cells = inked(surface)
    wide = span([column for column, _ in cells])
    high = 2 * span([row for _, row in cells])
    assert abs(wide - high) <= 3
    assert abs(wide - 2 * radius / surface.across) <= 2.0


@pytest.mark.parametrize("radius", [1, 2, 3, 4, 7, 12, 20, 33, 47])
def test_every_dot_of_a_circle_is_at_its_radius(radius):
    surface = canvas("block", 120, 60)
    surface.circle(60.0, 60.0, radius, 1)
    dots = [
        (c, 2 * r + half)
        for r, line in enumerate(text(surface))
        for c, sign in enumerate(line)
        for half in (0, 1)
        if sign == "█" or sign == "▀▄"[half]
    ]
    assert len(dots) >= 4 * radius
    assert all(abs(hypot(x - 60, y - 60) - radius) <= 0.71 for x, y in dots)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("radius", [0.0, 1e-300, 0.2])
def test_a_disc_smaller_than_a_dot_shows_as_one_dot(name, radius):
    surface, dot = canvas(name, 9, 9), canvas(name, 9, 9)
    surface.circle(5.3, 3.7, radius, 1)
    dot.dot(5.3, 3.7, 1, "o")
    assert surface.read() == dot.read()
    assert len(inked(surface)) == 1


@pytest.mark.parametrize("name", NAMES)
@given(
    x=SIXTEENTHS,
    y=SIXTEENTHS,
    radius=st.floats(0, 45),
    sparse=st.booleans(),
)
def test_a_circle_at_the_edge_is_cut_and_not_changed(name, x, y, radius, sparse):
    small, large = canvas(name, 20, 10), canvas(name, 320, 210)
    small.circle(x, y, radius, 1, sparse=sparse)
    large.circle(x + 150 * large.across, y + 100 * large.down, radius, 1, sparse=sparse)
    assert text(small) == [line[150:170] for line in text(large)[100:110]]


@given(x=st.floats(-99, 150), y=st.floats(-99, 150), to_x=st.floats(-99, 150), to_y=st.floats(-99, 150))  # fmt: skip
def test_every_dot_of_a_line_lies_on_it(x, y, to_x, to_y):
    surface = canvas("ascii", 50, 40)
    surface.line(x, y, to_x, to_y, 1)
    length = hypot(to_x - x, to_y - y)
    for column, row in inked(surface):
        away = (column + 0.5 - x) * (to_y - y) - (row + 0.5 - y) * (to_x - x)
        assert abs(away) <= 0.75 * length


def test_a_line_joins_its_ends_without_a_gap():
    surface = canvas("block", 30, 15)
    surface.line(2.5, 1.5, 27.5, 1.5, 1)
    assert text(surface)[0] == "  " + "▄" * 26 + "  "


def test_characters_of_a_line_follow_its_slope():
    for to_x, to_y, sign in ((9.5, 5.5, "-"), (5.5, 9.5, "|"), (9.5, 9.5, "\\"), (9.5, 1.5, "/")):
        surface = canvas("ascii", 11, 11)
        surface.line(5.5, 5.5, to_x, to_y, 1)
        assert {line[c] for line in text(surface) for c in range(11)} == {" ", sign}


@pytest.mark.parametrize("name", NAMES)
def test_text_lies_over_dots_and_is_cut_at_the_edges(name):
    surface = canvas(name, 8, 3)
    surface.circle(surface.width / 2, surface.height / 2, 3.0, 1)
    surface.text(-2, 1, "abcdef", 2)
    surface.text(6, 1, "xyz", 3)
    surface.text(0, 3, "below", 4)
    surface.text(9, 0, "beside", 4)
    row = surface.read()[1]
    assert (row.text[:4], row.text[6:]) == ("cdef", "xy")
    assert row.runs[0] == (0, 4, 2)
    assert row.runs[-1] == (6, 8, 3)


def test_a_cell_has_the_colour_of_who_came_last_and_the_dots_of_all():
    surface = canvas("braille", 1, 1)
    surface.dot(0, 0, 1)
    surface.dot(1, 3, 2)
    assert surface.read() == (("⢁", ((0, 1, 2),)),)


def test_runs_of_one_colour_are_merged_over_blanks():
    surface = canvas("ascii", 9, 1)
    for x, colour in ((1, 5), (3, 5), (4, 6), (6, 5), (7, 5)):
        surface.dot(x, 0, colour)
    assert surface.read()[0].runs == ((1, 4, 5), (4, 5, 6), (6, 8, 5))


def test_a_place_is_free_if_it_is_blank_and_on_the_surface():
    surface = canvas("ascii", 6, 2)
    surface.dot(3, 0, 1)
    assert surface.free(0, 0, 3)
    assert not surface.free(1, 0, 3)
    assert surface.free(4, 1, 2)
    assert not surface.free(5, 1, 2)
    assert not surface.free(-1, 1, 2)
    assert not surface.free(0, 2, 1)


@pytest.mark.parametrize("name", NAMES)
@given(x=ANY, y=ANY, a=ANY, b=ANY)
def test_no_number_is_an_error(name, x, y, a, b):
    surface = canvas(name, 30, 10)
    surface.dot(x, y, 1)
    surface.line(x, y, a, b, 2)
    surface.circle(x, y, abs(a), 3)
    rows = surface.read()
    assert [len(row.text) for row in rows] == [30] * 10
