"""The filmstrip: marks in the right columns, at any width, zoom and past."""

from __future__ import annotations

from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Fire, ModelError
from fasteroids.history import Timeline, begin
from fasteroids.lang.report import cells
from fasteroids.tui.chronicle import Chronicle, chronicle_of
from fasteroids.tui.strip import LEGEND, Stretch, Strip, strip, whole
from tests.unit.history.pasts import fought
from tests.unit.making import machine, rock, ship, world_of


@pytest.fixture(scope="module")
def past() -> Timeline:
    return fought().bookmark("here", 4.0)


@pytest.fixture(scope="module")
def account(past: Timeline) -> Chronicle:
    return chronicle_of(past)


def quiet() -> Timeline:
    """A ship that halts at 2 s; two rocks that touch at 6 s; 10 s in all."""
    text = "skip; skip; skip; skip; skip; skip; skip; skip; skip; print getx null;"
    world = world_of(
        ship(500.0, 900.0, program=machine(text)),
        rock(100.0, 100.0, 30.0),
        rock(500.0, 100.0, -30.0),
    )
    return begin(world).evolve(10.0)


def drawn(
    timeline: Timeline, cursor: float, *, selected: int | None = None, height: Literal[1, 2] = 1
) -> Strip:
    return strip(
        chronicle_of(timeline), timeline, whole(timeline), cursor, 57,
        selected=selected, height=height, unicode=False,
    )  # fmt: skip


def test_it_shows_where_things_happened() -> None:
    timeline = quiet().bookmark("here", 8.0)
    timeline = timeline.branch(9.0).switch("main")
    (row,) = drawn(timeline, 4.0, selected=2).rows
    assert row.text == "0.0 .........!         |        o         B    Y     10.0"
    bar = drawn(timeline, 4.0, selected=2)
    for sign, time in (("!", 2.0), ("|", 4.0), ("B", 8.0), ("Y", 9.0)):
        assert bar.rows[0].text[bar.column_at(time)] == sign
    contact = bar.rows[0].text.index("o")
    assert 5.8 < bar.time_at(contact) < 6.2
    assert "o" not in drawn(timeline, 4.0, selected=1).rows[0].text


def test_a_second_row_bares_what_the_cursor_hides() -> None:
    timeline = quiet().bookmark("here", 8.0)
    one, two = drawn(timeline, 8.0), drawn(timeline, 8.0, height=2)
    column = one.column_at(8.0)
    assert one.rows[0].text[column] == "|"
    assert two.rows[0].text[column] == "B"
    assert two.rows[1].text[column] == "^"
    assert "8.000 s" in two.rows[1].text


def test_a_click_on_a_mark_leads_to_its_place(past: Timeline, account: Chronicle) -> None:
    shown = strip(account, past, whole(past), 0.0, 80, unicode=False, height=2)
    deaths = [entry.place for entry in account.entries("death")]
    assert "x" in shown.rows[0].text
    for column, sign in enumerate(shown.rows[0].text):
        place = shown.place_at(column)
        if sign == "x":
            assert place in deaths
            assert shown.column_at(place.time) == column
        elif sign in " .:-=":
            assert place is None


@given(
    st.floats(0.0, 11.9), st.floats(0.01, 12.0), st.floats(0.0, 12.0), st.integers(3, 130),
    st.booleans(), st.sampled_from([1, 2]),
)  # fmt: skip
def test_every_row_has_exactly_the_width_and_columns_are_times(
    past: Timeline, account: Chronicle, start: float, span: float, cursor: float, width: int,
    unicode: bool, height: int,
) -> None:  # fmt: skip
    stretch = Stretch(start, start + span)
    shown = strip(account, past, stretch, cursor, width, unicode=unicode, height=height)  # type: ignore[arg-type]
    assert len(shown.rows) == height
    assert all(cells(row.text) == width == len(row.text) for row in shown.rows)
    for column in range(shown.left, shown.left + shown.columns):
        assert shown.column_at(shown.time_at(column)) == column
        assert stretch.start <= shown.time_at(column) <= stretch.end
    if not unicode:
        assert all(row.text.isascii() for row in shown.rows)


@given(st.floats(0.5, 12.0))
def test_the_strip_of_a_shorter_past_is_that_of_the_longer_one_up_to_there(
    past: Timeline, account: Chronicle, time: float
) -> None:
    stretch = Stretch(0.0, time)
    shorter = past.branch(time, "short")
    one = strip(account, past, stretch, 0.0, 60, height=2)
    two = strip(account.followed(shorter), shorter, stretch, 0.0, 60, height=2)
    branch = two.column_at(time)
    for column in range(60):
        if column != branch:
            assert one.rows[0].text[column] == two.rows[0].text[column]


@given(st.floats(0.0, 12.0), st.lists(st.sampled_from([0.5, 0.7, 1.5, 3.0]), max_size=20))
def test_zoom_keeps_the_cursor_in_sight_and_stays_inside(
    cursor: float, factors: list[float]
) -> None:
    within = Stretch(0.0, 12.0)
    stretch = within
    for factor in factors:
        stretch = stretch.zoomed(cursor, factor, within)
        assert within.start <= stretch.start <= cursor <= stretch.end <= within.end
    assert stretch.zoomed(cursor, 1e9, within) == within


def test_zooming_in_without_end_stops_at_what_the_clock_can_tell() -> None:
    within = Stretch(0.0, 2048.0)
    stretch = within
    for _ in range(200):
        stretch = stretch.zoomed(1500.0, 0.5, within)
    assert 0.0 < stretch.span < 1e-9


def test_holding_moves_no_more_than_is_needed() -> None:
    within, stretch = Stretch(0.0, 100.0), Stretch(20.0, 30.0)
    assert stretch.holding(25.0, within) == stretch
    assert stretch.holding(35.0, within) == Stretch(25.0, 35.0)
    assert stretch.holding(3.0, within) == Stretch(3.0, 13.0)
    assert stretch.holding(99.0, Stretch(0.0, 5.0)) == Stretch(0.0, 5.0)


def test_a_cursor_out_of_sight_is_told_on_its_side(past: Timeline, account: Chronicle) -> None:
    def below(cursor: float) -> str:
        shown = strip(account, past, Stretch(4.0, 6.0), cursor, 60, height=2, unicode=False)
        assert "|" not in shown.rows[0].text
        return shown.rows[1].text

    assert below(1.0).startswith("< 1.000 s")
    assert below(9.0).endswith("9.000 s >")


def test_a_past_without_time_has_a_strip() -> None:
    timeline = begin(world_of(rock(100.0, 100.0)))
    shown = strip(chronicle_of(timeline), timeline, whole(timeline), 0.0, 40)
    assert len(shown.rows[0].text) == 40


def test_a_stretch_that_ends_before_it_starts_is_refused() -> None:
    with pytest.raises(ModelError, match="a stretch goes from a time to a later one"):
        Stretch(3.0, 3.0)


def test_no_two_marks_look_alike() -> None:
    for variant in (0, 1):
        signs = [looks[variant] for looks in LEGEND.values()]
        assert len(set(signs)) == len(signs)
        assert not set(signs) & set((" .:-=", " ▁▂▃▄")[variant])


def test_a_bookmark_after_all_that_happened_is_shown() -> None:
    timeline = quiet().bookmark("late", 9.9)
    assert max(e.place.time for e in chronicle_of(timeline).entries("event")) < 9.0
    assert "B" in drawn(timeline, 0.0).rows[0].text


def test_the_death_of_a_ship_is_told_from_that_of_others() -> None:
    world = world_of(
        ship(100.0, 100.0, name="red"),
        rock(300.0, 100.0, -50.0),
        ship(100.0, 500.0),
        rock(500.0, 500.0),
    )
    timeline = begin(world).act(3, Fire()).evolve(10.0)
    row = drawn(timeline, 0.0).rows[0].text
    assert (row.count("X"), row.count("x")) == (1, 1)
