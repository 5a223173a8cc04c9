"""Whatever the text: no exception, and places that can be trusted."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import attrs
from hypothesis import assume, given
from hypothesis import strategies as st

from fasteroids.lang import words
from fasteroids.lang.codes import SYNTAX
from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.parser import Parsed, decoded, foreign, parse_bytes, parse_program
from fasteroids.lang.parser.lexer import lines
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import MOST_NESTED, Missing, Program

PROGRAMS = [
    path.read_text() for path in sorted((Path(__file__).parents[2] / "programs").glob("*.ast"))
]
GOOD = [text for text in PROGRAMS if parse_program(text).program is not None]

WORDS = [
    *sorted(words.KEYWORDS),
    "x", "y", "a", "and", "not", "for", "int", "elif", "in", "foo", "trun", "asteriod", "off", "pass",
]  # fmt: skip
SIGNS = [
    *words.SIGNS, "=", ":", "++", "+=", "=!", "?", "@", "**", ".", ".x", '"', '"a"', "'", "/*", "*/", "//", "#",
    "</pre>", "&lt;", "_x", "1e5", ".5", "5.", "2x", "0", "1", "2.5", "é", "\ufffd", "\x00", "\xa0", "\ud800",
    *foreign.SIGNS,
]  # fmt: skip
BLANKS = ["", " ", "\n", "  ", "\r\n", "\t", "\r", "// c\n"]

tokens = st.one_of(st.sampled_from(WORDS), st.sampled_from(SIGNS))
token_texts = st.lists(st.tuples(tokens, st.sampled_from(BLANKS)), max_size=40).map(
    lambda pairs: "".join(token + blank for token, blank in pairs)
)
free_texts = st.one_of(
    st.text(max_size=60),
    st.text(st.sampled_from("xX1.:;=(){}<>!&|+-*/%\n \"'"), max_size=80),
    token_texts,
)


@st.composite
def mutated(draw: st.DrawFn, texts: list[str], *, most: int = 4) -> str:
    """A program with some tokens deleted, doubled, swapped or put in."""
    pieces = re.findall(r"\w+|\s+|:=|[=!<>]=|&&|\|\||[^\w\s]", draw(st.sampled_from(texts)))
    for _ in range(draw(st.integers(1, most))):
        assume(pieces)
        i, j = draw(st.integers(0, len(pieces) - 1)), draw(st.integers(0, len(pieces) - 1))
        match draw(st.sampled_from(["delete", "double", "swap", "insert"])):
            case "delete":
                del pieces[i]
            case "double":
                pieces.insert(i, pieces[i])
            case "swap":
                pieces[i], pieces[j] = pieces[j], pieces[i]
            case "insert":
                pieces.insert(i, draw(tokens))
    return "".join(pieces)


any_text = st.one_of(
    free_texts, mutated(PROGRAMS), mutated([code.wrong for code in SYNTAX.values()])
)


def nodes(node: Any, depth: int = 1) -> Iterator[tuple[Any, int]]:
    """Each node under one, with how many nodes from the root it is."""
    yield node, depth
    for part in attrs.asdict(node, recurse=False).values():
        for inner in part if type(part) is tuple else (part,):
            if attrs.has(type(inner)):
                yield from nodes(inner, depth + 1)


def offset(text: str, line: int, column: int) -> int:
    starts = [0, *(end.end() for end in re.finditer(r"\r\n?|\n", text))]
    return starts[line - 1] + column - 1


def mended(text: str, fix: tuple[Edit, ...]) -> str:
    for edit in sorted(fix, key=lambda edit: edit.span, reverse=True):
        start, end = offset(text, *edit.span.start), offset(text, *edit.span.end)
        text = text[:start] + edit.text + text[end:]
    return text


def assert_inside(span: Span, rows: list[str]) -> None:
    assert span.start <= span.end
    for line, column in (span.start, span.end):
        assert 1 <= line <= len(rows)
        assert 1 <= column <= len(rows[line - 1]) + 1


def parsed(text: str) -> Parsed:
    """The text read, and everything that holds of any text checked."""
    result = parse_program(text)
    assert result.tree.source == text
    rows = lines(text)
    for node, depth in nodes(result.tree.body):
        assert_inside(node.span, rows)
        assert depth <= MOST_NESTED
        if isinstance(node, Missing):
            assert result.program is None
    places = [fault.span for fault in result.diagnostics]
    assert places == sorted(places)
    assert len(set(places)) == len(places)
    for fault in result.diagnostics:
        assert fault.code in SYNTAX
        assert fault.message.isprintable()
        assert not fault.message.endswith(".")
        for span in (
            fault.span,
            *(note.span for note in fault.notes),
            *(edit.span for edit in fault.fix),
        ):
            assert_inside(span, rows)
    assert isinstance(result.program, Program) is not bool(result.diagnostics)
    return result


@given(any_text)
def test_any_text_is_read_with_places_inside_it(text: str) -> None:
    parsed(text)


@given(any_text)
def test_reading_is_a_function(text: str) -> None:
    assert parse_program(text) == parse_program(text)


@given(any_text)
def test_a_fix_gives_a_text_that_can_be_read(text: str) -> None:
    for fault in parsed(text).diagnostics:
        if fault.fix:
            repaired = mended(text, fault.fix)
            assert repaired != text
            parsed(repaired)


@given(any_text)
def test_all_fixes_at_once_never_clash(text: str) -> None:
    edits = sorted(edit.span for fault in parsed(text).diagnostics for edit in fault.fix)
    for one, other in pairwise(edits):
        assert one.end <= other.start


@given(any_text)
def test_no_fix_makes_one_word_of_two(text: str) -> None:
    for edit in (edit for fault in parsed(text).diagnostics for edit in fault.fix):
        start, end = offset(text, *edit.span.start), offset(text, *edit.span.end)
        after = mended(text, (edit,))
        for seam, was in ((start, start), (start + len(edit.text), end)):
            if re.fullmatch(r"\w\w", after[max(seam - 1, 0) : seam + 1]):
                assert re.fullmatch(r"\w\w", text[was - 1 : was + 1]), edit


@given(mutated(GOOD, most=1))
def test_the_fix_of_a_single_slip_leaves_no_more_errors(text: str) -> None:
    faults = parsed(text).diagnostics
    if len(faults) == 1 and faults[0].fix:  # few slips: assume would give up
        assert len(parsed(mended(text, faults[0].fix)).diagnostics) <= 1


@given(mutated(GOOD, most=1), st.sampled_from(["\r\n", "\r"]))
def test_the_kind_of_line_ends_does_not_matter(text: str, end: str) -> None:
    assume("\r" not in text)
    one, other = parsed(text), parsed(text.replace("\n", end))
    assert one.tree == other.tree
    assert [f.span for f in one.diagnostics] == [f.span for f in other.diagnostics]


@given(st.sampled_from(GOOD), st.data())
def test_more_white_space_and_comments_change_no_tree(text: str, data: st.DataObject) -> None:
    pieces = re.split(r"(\s+)", text)
    blanks = st.sampled_from([" ", "\n", "\t\r\n ", " // @ } ;\n", "\r"])
    spread = "".join(p + data.draw(blanks) if p.isspace() else p for p in pieces)
    assert parsed(spread).program == parsed(text).program


@given(st.one_of(st.binary(max_size=60), any_text.map(lambda t: t.encode(errors="surrogatepass"))))
def test_any_bytes_are_read(data: bytes) -> None:
    text, undecodable = decoded(data)
    result = parse_bytes(data)
    assert result.tree.source == text
    rows = lines(text)
    for fault in result.diagnostics:
        assert_inside(fault.span, rows)
    assert set(undecodable) <= set(result.diagnostics)
    spans = [fault.span for fault in result.diagnostics]
    assert spans == sorted(set(spans))


@given(st.sampled_from(GOOD), st.integers(0), st.binary(min_size=1, max_size=3))
def test_a_bad_byte_is_told_at_its_place(text: str, at: int, junk: bytes) -> None:
    junk = bytes(b | 0x80 for b in junk)
    at %= len(text)
    data = text[:at].encode() + junk + text[at:].encode()
    try:
        junk.decode()
    except UnicodeDecodeError as error:
        first = at + error.start
    else:
        assume(False)
    [fault, *_] = decoded(data)[1]
    assert fault.span.start <= fault.span.end
    assert f"Byte {first + 1} " in fault.message
