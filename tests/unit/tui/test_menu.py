"""A menu as a value: the chosen entry is always in sight, and every picture has its size."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.tui.boxes import fitting
from fasteroids.tui.menu import Entry, Menu, hit, lines, listed, moved, pictured, put

LABELS = st.text(st.characters(codec="ascii"), max_size=12)
MENUS = st.lists(st.builds(Entry, LABELS, st.integers(), LABELS), max_size=12).map(listed)


def ten() -> Menu[int]:
    return listed(Entry(f"entry {i}", i) for i in range(10))


@given(MENUS, st.integers(-1, 8), st.lists(st.tuples(st.integers(-20, 20), st.booleans())))
def test_the_chosen_entry_is_in_sight(
    menu: Menu[int], height: int, moves: list[tuple[int, bool]]
) -> None:
    for step, around in moves:
        menu = moved(menu, step, height, around=around)
        if menu.entries:
            assert menu.entries[menu.at] is menu.chosen
            assert menu.top <= menu.at < menu.top + max(height, 1)
        else:
            assert menu.chosen is None


@given(MENUS, st.integers(0, 40), st.integers(0, 8))
def test_a_picture_has_its_width_and_tells_the_chosen_one(
    menu: Menu[int], columns: int, height: int
) -> None:
    rows = pictured(menu, columns, height)
    assert len(rows) == min(height, len(menu.entries))
    assert {len(row.text) for row in rows} <= {columns}
    assert all(row.text.isprintable() for row in rows)
    if columns > 1 and rows:
        assert [row.text.startswith("> ") for row in rows].count(True) == 1


def test_one_goes_around_by_steps_but_not_by_pages() -> None:
    assert moved(ten(), -1, 5, around=True).at == 9
    assert moved(put(ten(), 9, 5), 1, 5, around=True).at == 0
    assert moved(ten(), -4, 5).at == 0
    assert moved(ten(), 99, 5).at == 9


def test_dots_tell_that_there_is_more() -> None:
    def dotted(menu: Menu[int]) -> list[bool]:
        return [row.text.endswith(" ...") for row in pictured(menu, 30, 4)]

    assert dotted(ten()) == [False, False, False, True]
    assert dotted(put(ten(), 5, 4)) == [True, False, False, True]
    assert dotted(put(ten(), 9, 4)) == [True, False, False, False]


def test_a_row_is_the_entry_that_is_seen_in_it() -> None:
    menu = put(ten(), 9, 4)
    assert hit(menu, 0) == 6
    assert hit(menu, 3) == 9
    assert hit(menu, 4) is None
    assert hit(menu, -1) is None
    assert hit(listed([]), 0) is None


def test_lines_are_cut_and_not_wrapped() -> None:
    shown = lines("a\tb\nlonger than that", 10)
    assert [row.text for row in shown] == ["a   b     ", "longer th>"]


@pytest.mark.parametrize(
    ("text", "first"),
    [("hun", "hunter"), ("HNTR", "hunter"), ("sn", "sniper"), ("wall", "sniper"), ("", "hunter")],
)
def test_what_is_typed_finds_by_its_letters_in_order(text: str, first: str) -> None:
    entries = [
        Entry("hunter", 1, "aims where its target will be"),
        Entry("sniper", 2, "shoots by way of a wall"),
        Entry("turret", 3, "never moves"),
    ]
    assert fitting(entries, text)[0].label == first
    assert fitting(entries, "qx") == []
