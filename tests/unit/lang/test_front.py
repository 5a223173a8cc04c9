"""Text in, all that is wrong with it out: `fasteroids.lang.front`."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang import words
from fasteroids.lang.checker import complaints
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.front import diagnose, diagnose_bytes, mended, mended_throughout
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


@pytest.mark.parametrize(
    ("text", "codes", "after"),
    [
        ("ship d; d := 1; turn d;", ["FA022", "FA110"], "entity d; d := 1; turn d;"),
        ("print minus true;", ["FA009", "FA105"], "print - true;"),
        ("int e; e := null; print e == self;", ["FA022", "FA110"], "double e; e := null; print e == self;"),
    ],
)  # fmt: skip
def test_a_type_error_has_no_fix_where_the_text_is_not_what_the_tree_says(
    text: str, codes: list[str], after: str
) -> None:
    found = diagnose(text)
    assert [each.code for each in found] == codes
    assert [each.code for each in found if not each.fix] == codes[1:2]
    assert mended(text, found) == after
    assert any(each.fix for each in diagnose(after))


def test_a_type_error_beside_a_syntax_error_keeps_its_fix() -> None:
    text = "print not getx self > 3;"
    syntax, other = diagnose(text)
    assert mended(text, [other]) == "print not (getx self > 3);"
    assert mended(text, [syntax, other]) == "print ! (getx self > 3);"
    assert mended("x = 1;", diagnose("x = 1;")) == "double x;\nx := 1;"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize(
    ("lines", "after"),
    [
        (["d := 1;", "turn d;"], ["double d;", "d := 1;", "turn d;"]),
        (["/* one */ fire;", ""], ["// one", " fire;", ""]),
        (["if (true) {", "  fire;", ""], ["if (true) {", "  fire;", "}", ""]),
    ],
)
def test_fixes_have_the_line_ends_of_the_text(lines: list[str], after: list[str], end: str) -> None:
    text = end.join(lines)
    assert mended(text, diagnose(text)) == end.join(after)


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
def test_any_text_has_a_diagnosis_that_can_be_shown(text: str) -> None:
    found = diagnose(text)
    assert list(found) == sorted(found, key=lambda each: each.span)
    assert len(rendered(found, text, "x").split("\n\n")) == max(len(found), 1)


NAMES = st.sampled_from(["d", "b", "e", "near", "nera", "True"])
EXPRESSIONS = st.recursive(
    NAMES | st.sampled_from(["0", "1", "2.5", "true", "null", "self", "getdir"]),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(words.UNARY), inner).map(lambda two: f"{two[0]} ({two[1]})"),
        st.tuples(inner, st.sampled_from([*words.BINARY]), inner).map(
            lambda three: "({} {} {})".format(*three)
        ),
    ),
    max_leaves=4,
)
STATEMENTS = st.one_of(
    st.builds("{} {};".format, st.sampled_from(words.TYPES), NAMES),
    st.builds("{} {} := {};".format, st.sampled_from(words.TYPES), NAMES, EXPRESSIONS),
    st.builds("{} := {};".format, NAMES, EXPRESSIONS),
    st.builds("if {} {{ turn {}; }}".format, EXPRESSIONS, EXPRESSIONS),
    st.builds("foreach (any, {}) {{ print {}; }}".format, NAMES, EXPRESSIONS),
    st.builds("foreach (ship, {}) {{ fire; }}".format, NAMES),
)
PROGRAMS = st.lists(STATEMENTS, max_size=12).map("\n".join)


@given(PROGRAMS)
def test_fixes_of_type_errors_leave_a_program_that_reads(text: str) -> None:
    """And a name that was mended is never complained of as undeclared again."""
    assert parse_program(text).diagnostics == ()
    found = diagnose(text)
    after = mended(text, found)
    assert parse_program(after).diagnostics == ()
    told = {each.message for each in found if each.code == "FA101" and each.fix}
    assert told.isdisjoint(each.message for each in diagnose(after))


@given(PROGRAMS)
def test_no_two_complaints_are_about_one_place_in_one_way(text: str) -> None:
    found = diagnose(text)
    assert len({(each.code, each.span) for each in found}) == len(found)
    for code in ("FA101", "FA102", "FA110"):
        messages = [each.message for each in found if each.code == code]
        assert len(set(messages)) == len(messages)


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


def test_mending_goes_on_until_no_fix_changes_anything() -> None:
    text = "double d;\nentity e\nd = 1;\nturn d\n"
    after = mended_throughout(text, diagnose)
    assert after == "double d;\nentity e;\nd := 1;\nturn d;\n"
    assert mended_throughout(after, diagnose) == after


def test_mending_ends_even_if_the_fixes_never_do() -> None:
    def always(text: str) -> list[Diagnostic]:
        return [fault(((1, 1, 1, 1), "x"))] if text else []

    assert set(mended_throughout("x", always)) == {"x"}
