"""The table of high scores: what is kept, and what is read of damaged text."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.tui.scores import (
    EMPTY,
    KEPT,
    Score,
    Table,
    best,
    entered,
    merged,
    place_of,
    table_of,
    text_of,
)
from fasteroids.units import ModelError

integers = st.integers(-(2**63) + 1, 2**63 - 1)
scores = st.builds(
    Score,
    st.sampled_from(["one", "two", "{}"]),
    st.text(max_size=25),
    st.integers(0, 5) | integers,
    wave=integers,
    seed=integers,
    date=st.text(max_size=12),
    recording=st.text(max_size=12),
)


@st.composite
def tables(draw: st.DrawFn) -> Table:
    table = EMPTY
    for score in draw(st.lists(scores, max_size=25)):
        table = entered(table, score)
    return table


# The table.


@given(st.lists(scores, max_size=40))
def test_the_ten_best_of_each_mode_are_kept_in_order(rows: list[Score]) -> None:
    table = EMPTY
    for row in rows:
        table = entered(table, row)
    for mode in {row.mode for row in rows}:
        wanted = sorted({row for row in rows if row.mode == mode}, key=lambda row: -row.score)
        kept = best(table, mode)
        assert [row.score for row in kept] == [row.score for row in wanted[:KEPT]]
        assert set(kept) <= set(wanted)


def test_of_equal_scores_the_earlier_is_better() -> None:
    first, second = Score("one", "Ada", 50), Score("one", "Bob", 50)
    table = entered(entered(EMPTY, first), second)
    assert best(table, "one") == (first, second)
    assert place_of(entered(EMPTY, first), second) == 2


def test_a_score_below_the_ten_best_has_no_place() -> None:
    table = EMPTY
    for score in range(10, 20):
        table = entered(table, Score("one", "Ada", score))
    assert place_of(table, Score("one", "Bob", 9)) is None
    assert place_of(table, Score("one", "Bob", 25)) == 1
    assert place_of(table, Score("two", "Bob", 9)) == 1
    assert entered(table, Score("one", "Bob", 9)) == table


@given(tables(), scores)
def test_a_row_entered_again_counts_once(table: Table, score: Score) -> None:
    assert entered(entered(table, score), score) == entered(table, score)


@given(tables(), tables())
def test_merging_loses_none_of_the_best(a: Table, b: Table) -> None:
    both = merged(a, b)
    assert merged(both, b) == both == merged(a, both)
    for row in {*a.rows, *b.rows} - {*both.rows}:
        kept = best(both, row.mode)
        assert len(kept) == KEPT
        assert kept[-1].score >= row.score


def test_texts_lose_what_cannot_be_shown_and_numbers_that_are_none_are_refused() -> None:
    score = Score("one", "  A\nd\x1b[2Ja " + "x" * 40, 5)
    assert score.name == "A d [2Ja xxxxxxxxxxx"
    for wrong in (1.5, True, "7", 2**63, 10**5000):
        with pytest.raises(ModelError, match="score must be an integer"):
            Score("one", "Ada", wrong)  # type: ignore[arg-type]


# Text.


@given(tables())
def test_a_table_is_read_back_from_its_text(table: Table) -> None:
    text = text_of(table)
    assert table_of(text) == table
    assert text.isascii()
    assert len(json.loads(text)["rows"]) == len(table.rows)


@given(st.text())
def test_any_text_gives_a_table(text: str) -> None:
    table = table_of(text)
    assert table.damaged is bool(text.strip())
    assert table_of(text_of(table)).rows == table.rows


@given(tables(), st.data())
def test_a_row_that_is_not_damaged_survives_the_others(table: Table, data: st.DataObject) -> None:
    lines = text_of(table).split("\n")
    wrecked = data.draw(st.sets(st.integers(0, len(lines) - 1), min_size=1))
    for i in wrecked:
        cut = data.draw(st.integers(0, len(lines[i])))
        lines[i] = lines[i][:cut] + data.draw(
            st.sampled_from(["", "\x00", "�", "{", "}", '"', "\\"])
        )
    read = table_of("\n".join(lines))
    assert {row for i, row in enumerate(table.rows, 1) if i not in wrecked} <= set(read.rows)


@given(tables().filter(lambda table: len(table.rows) > 0), st.data())
def test_a_file_that_was_cut_short_keeps_its_beginning(table: Table, data: st.DataObject) -> None:
    text = text_of(table)
    cut = data.draw(st.integers(1, len(text) - 2))
    read = table_of(text[:cut])
    assert read.rows == table.rows[: len(read.rows)] or len(read.rows) == len(table.rows)
    assert read.damaged


@pytest.mark.parametrize(
    "row",
    [
        '{"mode": "one", "name": "Ada"}',
        '{"mode": "one", "name": "Ada", "score": "5"}',
        '{"mode": "one", "name": "Ada", "score": true}',
        '{"mode": "one", "name": "Ada", "score": 1e3}',
        '{"mode": "one", "name": 3, "score": 5}',
        '{"mode": "one", "name": "Ada", "score": 5, "wave": null}',
        '{"mode": "one", "name": "Ada", "score": 9223372036854775808}',
        '{"mode": "one", "name": "Ada", "score": ' + "9" * 5000 + "}",
        '{"mode": "one", "name": "Ada", "score": NaN}',
    ],
)
def test_a_row_that_is_no_score_is_dropped_and_told(row: str) -> None:
    good = Score("one", "Bob", 3)
    text = text_of(Table((good,))).replace('"rows": [\n', f'"rows": [\n{row},\n')
    assert table_of(text) == Table((good,), damaged=True)


def test_a_row_without_the_lesser_fields_is_read() -> None:
    read = table_of('[{"mode": "one", "name": "Ada", "score": 5, "more": 1}]')
    assert read == Table((Score("one", "Ada", 5),), damaged=True)


def test_no_file_at_all_is_an_empty_table_and_sound() -> None:
    assert table_of("") == table_of("\n") == EMPTY
