"""Text to tokens, and bytes to text."""

from __future__ import annotations

import pytest

from fasteroids.lang import words
from fasteroids.lang.lexer import BROKEN, END, NAME, NUMBER, decoded, lines, tokens
from fasteroids.lang.source import Span


def kinds(text: str) -> list[str]:
    found, _ = tokens(text)
    assert found.kinds[-2:] == [END, END]
    return found.kinds[:-2]


def codes(text: str) -> list[str]:
    return [fault.code for fault in tokens(text)[1]]


@pytest.mark.parametrize("word", sorted(words.KEYWORDS))
def test_keywords_are_their_own_kind_and_case_matters(word: str) -> None:
    assert kinds(f"{word} {word.capitalize()} {word}2") == [word, NAME, NAME]


def test_every_sign_is_read_without_blanks_around_it() -> None:
    for sign in words.SIGNS:
        assert kinds(f"a{sign}b") == [NAME, sign, NAME]


def test_a_minus_sign_is_never_part_of_a_number() -> None:
    assert kinds("a-1 3--4") == [NAME, "-", NUMBER, NUMBER, "-", "-", NUMBER]


@pytest.mark.parametrize("text", ["", " ", "\t\r\n\r\n", "// a", "//", "\ufeff", "\ufeff// @\n//*"])
def test_white_space_and_comments_are_nothing(text: str) -> None:
    assert kinds(text) == []
    assert codes(text) == []


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_end_in_lf_crlf_or_cr_and_columns_count_characters(end: str) -> None:
    text = f"x{end}// \U0001f680{end}\t y;"
    found, _ = tokens(text)
    assert [found.span(i, i) for i in range(3)] == [
        Span(1, 1, 1, 2), Span(3, 3, 3, 4), Span(3, 4, 3, 5),
    ]  # fmt: skip
    assert lines(text) == ["x", "// \U0001f680", "\t y;"]


def test_the_end_stands_just_after_the_last_token() -> None:
    found, _ = tokens("fire; // gone\n\n")
    assert found.span(2, 2) == Span(1, 6, 1, 6)
    assert tokens("")[0].span(0, 0) == Span(1, 1, 1, 1)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (".5", "0.5"), ("5.", "5"), ("1e5", "100000"), ("1.5e-3", "0.0015"), ("1E-7", "0.0000001"),
        ("2f", "2"),
    ],
)  # fmt: skip
def test_a_number_in_another_notation_is_read_as_what_it_means(text: str, meant: str) -> None:
    found, [fault] = tokens(f"x {text};")
    assert (fault.code, found.texts[1]) == ("FA003", meant)
    assert fault.fix[0].text == meant


@pytest.mark.parametrize("text", ["0x1F", "2x", "1.2.3", "5..6", "1_000", "1e"])
def test_what_is_neither_number_nor_name_is_one_fault(text: str) -> None:
    assert kinds(text) == [BROKEN]
    assert codes(text) == ["FA003"]


@pytest.mark.parametrize("text", ["9" * 309, "1e999", "9" * 20_000 + ".5"])
def test_a_number_that_no_double_holds_is_refused(text: str) -> None:
    assert codes(text) == ["FA008"]


def test_numbers_of_any_length_that_fit_are_fine() -> None:
    assert codes("0" * 5000 + "1" + " " + "0." + "0" * 5000 + "1 " + "9" * 308) == []


@pytest.mark.parametrize(
    "sign", ["&", "|", "<>", "===", "=<", "=>", "< =", ": =", "≠", "−", "&lt;"]
)
def test_signs_of_elsewhere_are_reported_and_read_as_ours(sign: str) -> None:
    _, [fault] = tokens(f"a {sign} b")
    assert kinds(f"a {sign} b")[1] == fault.fix[0].text
    assert fault.span == Span(1, 3, 1, 3 + len(sign))


@pytest.mark.parametrize("rubbish", ["@", "@$@", "@ ` $", "\x00\x01", "\ud800", "°¶\U0001f680"])
def test_a_run_of_rubbish_is_one_fault(rubbish: str) -> None:
    assert kinds(f"x {rubbish} y") == [NAME, BROKEN, NAME]
    assert codes(f"x {rubbish} y") == ["FA001"]


@pytest.mark.parametrize(
    ("text", "told"), [("\x00", "U+0000"), ("\u200b", "ZERO WIDTH SPACE"), ("\x0c", "U+000C"), ("°", "DEGREE SIGN")]
)  # fmt: skip
def test_odd_characters_are_told_by_name_or_number(text: str, told: str) -> None:
    assert told in tokens(text)[1][0].message
    assert tokens(text)[1][0].message.isprintable()


@pytest.mark.parametrize("name", ["_x", "größe", "x²", "été", "_"])
def test_names_are_ascii_and_start_with_a_letter(name: str) -> None:
    assert kinds(name) == [BROKEN]
    assert codes(name) == ["FA006"]


def test_text_in_quotes_does_not_swallow_the_statement() -> None:
    assert kinds("print \"a;b\"; print 'c'; print \"d; fire;") == [
        "print", BROKEN, ";", "print", BROKEN, ";", "print", BROKEN, ";", "fire", ";",
    ]  # fmt: skip


def test_block_comments_are_one_fault_and_places_behind_them_are_right() -> None:
    found, [fault] = tokens("/* a\n b */ fire;")
    assert (fault.code, fault.span) == ("FA004", Span(1, 1, 2, 6))
    assert found.span(0, 0) == Span(2, 7, 2, 11)
    assert codes("fire; /* never closed\n ; /* }") == ["FA004"]


def test_a_division_before_a_comment_is_no_end_of_a_block_comment() -> None:
    assert codes("x := 2 *// twice\n 3;") == []


def test_bytes_in_utf_8_are_decoded_and_a_mark_at_the_start_is_left_out() -> None:
    assert decoded("fire; // é".encode("utf-8-sig")) == ("fire; // é", ())


def test_undecodable_bytes_are_reported_with_their_place_and_number() -> None:
    text, faults = decoded(b"\xef\xbb\xbffire;\r\nx := \xff\xfe1;\xe9")
    assert text == "fire;\r\nx := \ufffd\ufffd1;\ufffd"
    assert [(fault.code, fault.span) for fault in faults] == [
        ("FA002", Span(2, 6, 2, 8)), ("FA002", Span(2, 10, 2, 11)),
    ]  # fmt: skip
    # The mark is no byte of the text: 7 of the first line, 5 before.
    assert "Byte 13 of the text (0xFF)" in faults[0].message


def test_only_a_few_undecodable_places_are_listed() -> None:
    text, faults = decoded(b"\xff " * 50_000)
    assert len(text) == 100_000
    assert 1 <= len(faults) <= 10
