"""Any bytes as a program: diagnostics at places in the text, never an exception, in time that grows with the text.

`tests/corpus` holds files that went wrong once, or look as if they might. What is large is made here instead.
"""

from __future__ import annotations

import itertools
import re
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang.codes import CODES
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnose_bytes, mended
from fasteroids.lang.parser import decoded, parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.source import Span
from fasteroids.testing import program_texts, trees
from tests.oracle.reading import read
from tests.oracle.writing import PIECES, damaged

CORPUS = sorted((Path(__file__).parents[1] / "corpus").glob("*.ast"))


def assert_diagnosed(data: bytes) -> tuple[Diagnostic, ...]:
    """All that holds for any bytes; what is wrong with them."""
    text, undecodable = decoded(data)
    text_again, faults = diagnose_bytes(data)
    assert text_again == text
    ends = [len(line) + 1 for line in re.split(r"\r\n?|\n", text)]
    for fault in faults:
        assert_said(fault)
        for place in (fault.span, *(n.span for n in fault.notes), *(e.span for e in fault.fix)):
            assert_within(place, ends)
    assert list(faults) == sorted(faults, key=lambda fault: fault.span)
    assert isinstance(mended(text, faults), str)

    # A text is a program if and only if nothing in it is wrong but types, and then it has a normal form.
    parsed = parse_program(text)
    sound = not any(CODES[fault.code].phase == "syntax" for fault in faults)
    assert sound == (parsed.program is not None and not undecodable)
    if parsed.program is not None:
        assert parse_program(printed(parsed.program)).program == parsed.program
    return faults


def assert_said(fault: Diagnostic) -> None:
    assert fault.code in CODES
    for said in (fault.message, fault.hint or "-", *(note.text for note in fault.notes)):
        assert said.isprintable()
        assert 0 < len(said) < 300
        assert not said.endswith(".")


def assert_within(place: Span, ends: list[int]) -> None:
    assert (1, 1) <= place.start <= place.end <= (len(ends), ends[-1])
    assert place.column <= ends[place.line - 1]
    assert place.end_column <= ends[place.end_line - 1]


# Small texts.


@given(st.binary(max_size=200))
def test_any_bytes_are_diagnosed(data: bytes) -> None:
    assert_diagnosed(data)


@given(st.text(max_size=100))
def test_any_text_is_diagnosed(text: str) -> None:
    assert_diagnosed(text.encode(errors="surrogatepass"))


@given(st.lists(st.sampled_from(PIECES), max_size=40), st.sampled_from([b" ", b"", b"\n"]))
def test_any_row_of_words_and_signs_is_diagnosed(pieces: list[str], between: bytes) -> None:
    assert_diagnosed(between.join(piece.encode() for piece in pieces))


@given(damaged(program_texts() | trees().map(printed)), st.binary(max_size=3), st.integers(0, 4096))
def test_any_damaged_program_is_diagnosed(text: str, odd: bytes, at: int) -> None:
    data = text.encode()
    at %= len(data) + 1
    assert_diagnosed(data[:at] + odd + data[at:])


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: path.stem)
def test_each_file_of_the_corpus_is_diagnosed_and_both_parsers_agree(path: Path) -> None:
    data = path.read_bytes()
    assert_diagnosed(data)
    text, _ = decoded(data)
    assert read(text) == parse_program(text).program


def test_the_corpus_is_there() -> None:
    assert len(CORPUS) >= 70


# Large texts. Each is a piece said again and again between a start and two ends.

SHAPES: dict[str, tuple[str, str, str]] = {
    "parentheses": ("print ", "(", "1"),
    "closing parentheses": ("print 1", ")", ";"),
    "nots": ("print ", "!", "true;"),
    "nots alone": ("", "!", ""),
    "minus signs": ("print ", "-", "1;"),
    "getters": ("print ", "getx ", "self;"),
    "getters alone": ("", "getx ", ""),
    "calls": ("print ", "sqrt(", "1"),
    "a sum": ("print 1", "+1", ";"),
    "a sum to the right": ("print ", "1+(", "1"),
    "braces": ("", "{", ""),
    "closing braces": ("", "}", ""),
    "whiles": ("", "while (a) {\n", ""),
    "ifs": ("", "if (a", ""),
    "else ifs": ("if a {}", "else if a {}", ""),
    "elses": ("", "else ", ""),
    "loops in a row": ("entity a;", "foreach (any, a) {}", ""),
    "loops": ("entity a;", "foreach (any, a) {", ""),
    "assignments to the right": ("", "x := ", "1;"),
    "declarations in expressions": ("", "x := double a;", ""),
    "semicolons": ("", ";", ""),
    "missing semicolons": ("", "print 1\n", ""),
    "names": ("", "a ", ""),
    "a name": ("print ", "a", ";"),
    "a number": ("print ", "9", ";"),
    "a fraction": ("print 0.", "0", "1;"),
    "points": ("", ".", ""),
    "exponents": ("", "1e+", ""),
    "a comment": ("//", "x", ""),
    "slashes": ("", "/ ", ""),
    "comments of others": ("", "/*", ""),
    "ends of comments of others": ("", "*/", ""),
    "quotes": ("", '"', ""),
    "quotes and lines": ("", '"a\n', ""),
    "quotes in print": ("print ", "“", ""),
    "tags": ("", "</a", ""),
    "hashes": ("", "#\n", ""),
    "nuls": ("", "\0", ""),
    "byte order marks": ("", "\ufeff", ""),
    "letters of others": ("", "α ", ""),
    "carriage returns": ("", "\r", ""),
    "blanks": ("", " ", ""),
    "commas": ("foreach (any", ",", ""),
    "equals": ("", "a = ", "1"),
    "wrong kinds": ("", "foreach (asteriod, a) {}", ""),
    "wrong words": ("", "whlie (true) {}", ""),
    "all sorts": ("", "if ( { else } ) := ; , ", ""),
    "one name undeclared": ("", "a := 1;\n", ""),
    "one name declared often": ("", "double a;\n", ""),
    "wrong types": ("entity a;", "a := a + 1;\n", ""),
    "actions in a loop": ("entity a; foreach (any, a) {", "fire;", "}"),
}
MAKERS: dict[str, Callable[[int], str | bytes]] = {
    "many names undeclared": lambda n: "".join(f"a{i:04} := 1;\n" for i in range(n // 12)),
    "many names nearly declared": lambda n: "".join(
        f"double b{i:04}; b{i:04}c := 1;\n" for i in range(n // 28)
    ),
    "bytes of no text": lambda n: b"\xff" * n,
    "bytes of no text in lines": lambda n: b"\xc3\n" * (n // 2),
    "surrogates": lambda n: b"\xed\xa0\x80" * (n // 3),
}


def shaped(name: str, size: int, *, closed: bool = True) -> bytes:
    """A text of about so many bytes; `closed` with what closes its parentheses and braces."""
    if name in MAKERS:
        made = MAKERS[name](size)
        return made if isinstance(made, bytes) else made.encode()
    _, piece, _ = SHAPES[name]
    return repeated(name, size // len((piece + closing(piece) * closed).encode()), closed=closed)


def repeated(name: str, count: int, *, closed: bool = True) -> bytes:
    start, piece, end = SHAPES[name]
    return (start + piece * count + end + closing(piece) * count * closed).encode()


def closing(piece: str) -> str:
    """What a piece opens and does not close, closed."""
    left = piece.count("{") - piece.count("}"), piece.count("(") - piece.count(")")
    return "}" * left[0] + ")" * left[1] if min(left) >= 0 else ""


@pytest.mark.parametrize(
    ("name", "closed"),
    [(n, True) for n in (*SHAPES, *MAKERS)] + [(n, False) for n in SHAPES if closing(SHAPES[n][1])],
)
def test_time_grows_as_the_text(name: str, closed: bool) -> None:
    small, large = (shaped(name, size, closed=closed) for size in (6_250, 100_000))
    assert 15 < len(large) / len(small) < 17
    before = min(seconds(small) for _ in range(3))
    # Sixteen times the text. What is quadratic takes 256 times as long, and a busy machine two or three times.
    for tries in itertools.count(1):
        if seconds(large) < 80 * before:
            break
        assert tries < 3


def seconds(data: bytes) -> float:
    """What it takes to diagnose, s of this process."""
    start = time.process_time()
    diagnose_bytes(data)
    return time.process_time() - start


@pytest.mark.parametrize("name", SHAPES)
def test_large_texts_are_diagnosed_like_small_ones(name: str) -> None:
    small, large = (assert_diagnosed(shaped(name, size)) for size in (2_000, 4_000))
    assert {fault.code for fault in small} == {fault.code for fault in large}


@pytest.mark.parametrize(
    "name",
    ["parentheses", "nots", "minus signs", "getters", "calls", "a sum", "whiles", "else ifs"],
)
def test_what_is_100_000_deep_is_refused_as_nested_too_deeply(name: str) -> None:
    told = {fault.message for fault in assert_diagnosed(repeated(name, 100_000))}
    assert any("nested too deeply" in message for message in told)
