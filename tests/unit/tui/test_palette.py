"""Colours: those of Okabe and Ito for ships, apart from each other and from the background, and one figure each."""

from __future__ import annotations

from fasteroids.tui import palette


def luminance(code: str) -> float:
    """Relative luminance (WCAG 2.2)."""
    parts = [int(code[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_ships_have_the_colours_of_okabe_and_ito_without_the_dark_one():
    ships = [palette.COLOURS[palette.player(rank)].hex for rank in range(palette.PLAYERS)]
    assert ships == ["#f0e442", "#e69f00", "#56b4e9", "#cc79a7", "#009e73", "#d55e00"]


def test_everything_stands_out_from_the_background():
    for colour in palette.COLOURS[1:]:
        # 3 is what WCAG 1.4.11 asks of graphics; ships are text too, and get the 4.5 of 1.4.3.
        assert contrast(colour.hex, palette.BACKGROUND) >= 3.0, colour
    for rank in range(palette.PLAYERS):
        assert contrast(palette.COLOURS[palette.player(rank)].hex, palette.BACKGROUND) >= 4.5


def test_ranks_beyond_the_last_begin_again():
    assert palette.player(palette.PLAYERS) == palette.player(0)
    assert palette.figure(palette.PLAYERS) == palette.figure(0)
    assert [palette.letter(rank) for rank in (0, 25, 26)] == ["A", "Z", "A"]


def test_each_rank_has_a_figure_that_reaches_out_to_the_front():
    assert len(set(palette.FIGURES)) == palette.PLAYERS
    for figure in palette.FIGURES:
        forward = [x for polyline in figure for x, _ in polyline]
        assert max(forward) > -min(forward)


def test_no_two_colours_share_an_index_name():
    assert len({colour.name for colour in palette.COLOURS}) == len(palette.COLOURS)
