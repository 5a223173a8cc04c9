"""Text in, all that is wrong with it out: `fasteroids.lang.front`."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang import words
from fasteroids.lang.checker import complaints
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.front import diagnose, diagnose_bytes, mended
from fasteroids.lang.parser import parse_program
from fasteroids.lang.report import rendered
from fasteroids.lang.source import Span


def fault(*edits: tuple[tuple[int, int, int, int], str]) -> Diagnostic:
    fix = tuple(Edit(Span(*place), text) for place, text in edits)
    return Diagnostic("FA999", "Oh", Span(1, 1, 1, 1), fix=fix)


# Diagnosis.


def test_syntax_and_type_errors_come_together_by_place() -> None:
    text = "bool b := 1;\nprint 3\nturn true;\ndouble d = 2;\nd := null;\n"
    found = diagnose(text)
    assert [each.span.line for each in found] == [1, 2, 3, 4, 5]
    assert [each.code[2] for each in found] == ["1", "0", "1", "0", "1"]


def test_a_program_without_faults_has_none() -> None:
    assert diagnose("") == ()
    assert diagnose("turn 1;") == ()
    assert diagnose_bytes(b"\xef\xbb\xbfturn 1;") == ("turn 1;", ())


def test_bytes_that_are_no_text_are_faults_beside_the_others() -> None:
    text, found = diagnose_bytes(b"turn 1;\nturn \xff;\nturn true;")
    assert text == "turn 1;\nturn \ufffd;\nturn true;"
    assert {(each.code, each.span.line) for each in found} == {("FA002", 2), ("FA107", 3)}


PIECES = [*words.KEYWORDS, *words.SIGNS, "x", "y", "1", "2.5", "\n", "// no", "\x00", "é", "\ud800"]


@given(st.lists(st.sampled_from(PIECES), max_size=60).map(" ".join))
def test_any_text_has_a_diagnosis_that_can_be_shown_and_mended(text: str) -> None:
    found = diagnose(text)
    assert list(found) == sorted(found, key=lambda each: each.span)
    assert len(rendered(found, text, "x").split("\n\n")) == max(len(found), 1)
    assert found == () or mended(text, found) is not None


@given(st.binary(max_size=80))
def test_any_bytes_have_a_diagnosis(data: bytes) -> None:
    text, found = diagnose_bytes(data)
    for each in found:
        assert 1 <= each.span.line <= text.count("\n") + text.count("\r") + 1


@given(st.lists(st.sampled_from(PIECES), max_size=60).map(" ".join))
def test_type_errors_alone_are_all_kept(text: str) -> None:
    parsed = parse_program(text)
    if parsed.program is not None:
        assert diagnose(text) == complaints(parsed.tree)


# Mending.


@pytest.mark.parametrize(
    ("faults", "after"),
    [
        ([], "ab\ncd"),
        ([fault(((1, 1, 1, 2), "x"), ((2, 2, 2, 3), "yy"))], "xb\ncyy"),
        ([fault(((1, 2, 2, 1), ""))], "acd"),
        ([fault(((2, 1, 2, 1), "1")), fault(((2, 1, 2, 1), "2"))], "ab\n12cd"),
        ([fault(((1, 2, 1, 3), "B")), fault(((1, 2, 1, 2), "+"))], "a+B\ncd"),
        ([fault(((1, 3, 1, 3), "!"))], "ab!\ncd"),
        ([fault(((9, 1, 9, 1), "!"))], "ab\ncd!"),
    ],
)
def test_edits_are_put_in_their_places(faults: list[Diagnostic], after: str) -> None:
    assert mended("ab\ncd", faults) == after


def test_of_two_fixes_that_clash_the_first_is_taken_and_the_other_left_whole() -> None:
    one = fault(((1, 1, 1, 3), "X"))
    other = fault(((1, 2, 1, 4), "Y"), ((1, 5, 1, 6), "Z"))
    assert mended("abcdef", [one, other]) == "Xcdef"
    assert mended("abcdef", [other, one]) == "aYdZf"
    within = fault(((1, 2, 1, 2), "-"))
    assert mended("abcdef", [one, within]) == "Xcdef"
    assert mended("abcdef", [within, one]) == "a-bcdef"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_places_count_lines_as_the_parser_does(end: str) -> None:
    text = f"// é{end}bool b := 0;{end}"
    assert mended(text, diagnose(text)) == f"// é{end}bool b := false;{end}"
