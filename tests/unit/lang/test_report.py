"""Diagnostics as text: `fasteroids.lang.report`."""

from __future__ import annotations

from unicodedata import east_asian_width

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang.diagnostics import Diagnostic, Note
from fasteroids.lang.report import WIDEST, Role, legible, rendered
from fasteroids.lang.source import Span


def at(line: int, column: int, end_column: int, end_line: int = 0) -> Span:
    return Span(line, column, end_line or line, end_column)


def shown(source: str, span: Span, **more: object) -> list[str]:
    """The rows for one diagnostic, without the first."""
    one = Diagnostic("FA999", "Oh", span, **more)  # type: ignore[arg-type]
    first, *rows = rendered([one], source, "a.ast").split("\n")
    assert first == f"a.ast:{span.line}:{span.column}: error FA999: Oh"
    return rows


def cells(text: str) -> int:
    return sum(2 if east_asian_width(c) in "WF" else 1 for c in text)


def test_place_sentence_excerpt_label_and_hint() -> None:
    assert shown("double d;\nd := null;\n", at(2, 6, 10), label="an entity", hint="Give it 0") == [
        "  2 | d := null;",
        "    |      ^^^^ an entity",
        "  hint: Give it 0",
    ]


def test_a_warning_says_so() -> None:
    one = Diagnostic("FA201", "Hm", at(1, 1, 2), severity="warning")
    assert rendered([one], "x", "-").startswith("-:1:1: warning FA201: Hm\n")


def test_an_empty_piece_has_one_caret() -> None:
    assert shown("fire", at(1, 5, 5)) == ["  1 | fire", "    |     ^"]


def test_places_behind_the_text_show_an_empty_line() -> None:
    assert shown("fire;\n", at(7, 3, 3)) == ["  7 |", "    | ^"]
    assert shown("", at(1, 1, 1)) == ["  1 |", "    | ^"]


def test_notes_and_the_piece_itself_stand_in_the_order_of_the_text() -> None:
    source = "double d;\nentity e;\nd := e;"
    notes = (Note("declared entity here", at(2, 8, 9)), Note("declared double here", at(1, 8, 9)))
    assert shown(source, at(3, 6, 7), label="an entity", notes=notes) == [
        "  1 | double d;",
        "    |        - declared double here",
        "  2 | entity e;",
        "    |        - declared entity here",
        "  3 | d := e;",
        "    |      ^ an entity",
    ]


def test_a_line_is_shown_once_and_like_notes_share_a_row() -> None:
    notes = (Note("too", at(1, 5, 6)), Note("too", at(1, 9, 10)), Note("not", at(1, 13, 14)))
    assert shown("x + x + x + y", at(1, 1, 2), notes=notes) == [
        "  1 | x + x + x + y",
        "    | ^",
        "    |     -   - too",
        "    |             - not",
    ]


def test_a_piece_of_many_lines_shows_the_first() -> None:
    source = "/* one\ntwo\nthree */ fire;"
    assert shown(source, Span(1, 1, 3, 9)) == ["  1 | /* one", "    | ^^^^^^ ... to line 3"]
    assert shown(source, Span(2, 2, 3, 9), label="here") == [
        "  2 | two",
        "    |  ^^ here ... to line 3",
    ]


def test_line_numbers_widen_the_margin() -> None:
    assert shown("\n" * 99_999 + "x", at(100_000, 1, 2)) == ["100000 | x", "       | ^"]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_end_as_on_any_system(end: str) -> None:
    assert shown(f"a{end}b{end}c", at(2, 1, 2)) == ["  2 | b", "    | ^"]


def test_lines_end_nowhere_else() -> None:
    assert shown("a\x0bb\u2028c\x85d", at(1, 7, 8))[1] == "    | " + " " * 17 + "^"


def test_carets_stand_under_wide_characters_and_tabs() -> None:
    rows = shown("\tprint 漢字 + x;", at(1, 8, 10))
    assert rows == ["  1 |     print 漢字 + x;", "    |           ^^^^"]
    assert shown("漢字 x", at(1, 4, 5))[1] == "    |      ^"


def test_what_a_terminal_would_obey_is_shown_as_an_escape() -> None:
    source = "a\x1b[2Jb\x07c\u202ed\udc80e\ufefff"
    rows = shown(source, at(1, 6, 7))
    assert rows == [
        r"  1 | a\x1b[2Jb\x07c\u202ed\udc80e\ufefff",
        "    |         ^",
    ]


def test_nothing_unprintable_comes_from_messages_and_names_either() -> None:
    one = Diagnostic("FA999", "\x1b", at(1, 1, 2), "\x1b", "\x1b\n", (Note("\x1b", at(1, 1, 2)),))
    text = rendered([one], "x", "\x1b\udcff.ast")
    assert text.split("\n")[0] == r"\x1b\udcff.ast:1:1: error FA999: \x1b"
    assert all(c.isprintable() or c == "\n" for c in text)


def test_a_long_line_is_cut_around_the_piece() -> None:
    source = "a" * 500 + "XYZ" + "b" * 500
    row, marks = shown(source, at(1, 501, 504))
    assert cells(row) <= WIDEST + 6
    assert row[6:9] == row[-3:] == "..."
    assert marks.index("^") == row.index("XYZ")
    assert marks.count("^") == 3


@pytest.mark.parametrize("column", [1, 2, 998, 1000, 1001])
def test_a_long_line_is_cut_at_its_ends_only_where_there_is_more(column: int) -> None:
    source = "".join(chr(0x4E00 + i) for i in range(1000))
    row, marks = shown(source, at(1, column, column + 1))
    shown_text = row.removeprefix("  1 | ")
    assert shown_text.startswith("...") == (column > 500)
    assert shown_text.endswith("...") == (column < 500)
    assert cells(row) <= WIDEST + 6
    before = marks.index("^")
    if column <= 1000:
        assert cells(row[: row.index(source[column - 1])]) == before
    else:
        assert before == cells(row)


def test_a_long_piece_of_a_long_line_starts_in_sight() -> None:
    row, marks = shown("a" * 300 + "b" * 5000, at(1, 301, 5301))
    assert marks.index("^") == row.index("b")
    assert row.endswith("b...")
    assert len(marks) <= len(row)


def test_many_diagnostics_have_empty_lines_between_them() -> None:
    one = Diagnostic("FA999", "Oh", at(1, 1, 2))
    assert rendered([one, one], "x", "a") == "\n\n".join([rendered([one], "x", "a")] * 2)
    assert rendered([], "x", "a") == ""


def test_paint_gets_each_part_with_its_role() -> None:
    seen: list[tuple[Role, str]] = []

    def paint(role: Role, text: str) -> str:
        seen.append((role, text))
        return f"<{text}>"

    one = Diagnostic("FA999", "Oh", at(1, 3, 4), "Do", "la", (Note("ti", at(1, 1, 2)),))
    text = rendered([one], "a b", "x.ast", paint=paint)
    assert text.split("\n") == [
        "<x.ast:1:3:> <error FA999:> <Oh>",
        "<  1 |> a b",
        "<    |> <-> <ti>",
        "<    |>   <^> <la>",
        "  <hint:> Do",
    ]
    assert {role for role, _ in seen} == {"place", "error", "message", "gutter", "note", "mark", "hint"}  # fmt: skip


TEXTS = st.text(st.sampled_from("ab \t\n\r\x1b\u0301漢\ud800\u202e"), max_size=300)
NUMBERS = st.integers(1, 400)


@given(TEXTS, st.tuples(st.integers(1, 9), NUMBERS, st.integers(0, 2), NUMBERS), NUMBERS)
def test_any_place_in_any_text_can_be_shown(
    source: str, four: tuple[int, int, int, int], times: int
) -> None:
    line, column, more, end = four
    span = Span(line, column, line + more, max(end, column) if not more else end)
    rows = shown(source * times, span, notes=(Note("here", at(1, 1, 1)),))
    carets = [row for row in rows if "^" in row]
    assert len(carets) == 1
    for row in rows:
        assert row.isprintable()
        assert cells(row) <= 2 * (WIDEST + 30)


@given(TEXTS)
def test_legible_text_is_printable_and_plain_text_is_left_alone(text: str) -> None:
    assert legible(text).isprintable()
    assert legible(legible(text)) == legible(text)


def test_what_has_no_width_is_an_escape_also_among_characters_that_print() -> None:
    assert legible("e\u0301") == "e\\u0301"
    assert legible("\u00e9") == "\u00e9"
