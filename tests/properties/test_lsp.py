"""Laws of the language server: it answers whatever it is asked, and what it changes is what it says."""

from __future__ import annotations

import re
from bisect import bisect_right

from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.formatter import formatted
from fasteroids.lang.front import diagnose
from fasteroids.lang.parser import foreign, parse_program
from fasteroids.lang.parser.lexer import lines
from fasteroids.lang.printer import printed
from fasteroids.lang.source import Span
from fasteroids.lang.words import GETTERS, KEYWORDS, SIGNS
from fasteroids.lsp.completing import completions
from fasteroids.lsp.hovering import hover
from fasteroids.lsp.mending import fix_all, fixes, formatting, put_in
from fasteroids.lsp.navigating import Refused, definitions, mentions, renamed, symbols
from fasteroids.lsp.positions import Page, Position
from fasteroids.lsp.reading import Place, Reading
from fasteroids.testing import program_texts, trees

FOREIGN = sorted(
    {
        *foreign.CONSTANTS, *foreign.INFIX, *foreign.PREFIX, *foreign.TYPES, *foreign.KINDS, *foreign.MEMBERS,
        *foreign.ELSE_IFS, *foreign.STATEMENTS, *foreign.SYNONYMS, *foreign.FUNCTIONS,
    }
    - KEYWORDS
)  # fmt: skip
"""Words that the parser knows from elsewhere, and guesses at in a text with errors. In a right one they are names."""

pieces = st.one_of(
    st.sampled_from([*sorted(KEYWORDS), *SIGNS]),
    st.sampled_from(["a", "b", "x", "and", "True", "else if", "1", "0.5", "2x", ".x", "=", "+="]),
    st.sampled_from([" ", "\t", "\n", "\r\n", "\r", "\x0c", "\u2028", "// ", "/* "]),
    st.sampled_from(["\U0001f680", "é", "\ud83d", "\ufeff", '"', "#"]),
)
soups = st.lists(pieces, max_size=25).map("".join)


@st.composite
def cut(draw: st.DrawFn) -> str:
    """A program, cut off somewhere, perhaps with a piece missing: as it is while somebody types."""
    text = draw(program_texts())
    start = draw(st.integers(0, len(text)))
    return (
        text[: draw(st.integers(0, start))] + text[start:] if draw(st.booleans()) else text[:start]
    )


texts = st.one_of(soups, cut(), st.text(max_size=20), st.builds(printed, trees()))
valid = st.one_of(program_texts(), st.builds(printed, trees()))


@st.composite
def asked(draw: st.DrawFn, text: st.SearchStrategy[str]) -> tuple[str, Place]:
    """A text, and a place in it as a page makes it of what an editor sends."""
    found = draw(text)
    line = draw(st.integers(0, found.count("\n") + 1))
    return found, Page(found).place(Position(line, draw(st.integers(0, 60))))


@given(asked(texts), st.sampled_from(["", " ", "("]), st.text(max_size=3))
def test_every_request_has_an_answer_whose_places_are_in_the_text(
    question: tuple[str, Place], typed: str, new: str
) -> None:
    text, place = question
    reading = Reading(text)
    spans: list[Span] = [fault.span for fault in reading.faults]
    shown = hover(reading, place)
    if shown:
        assert shown.span.start <= place <= shown.span.end
        spans.append(shown.span)
    for each in completions(reading, place, typed=typed):
        assert each.span.end == place
        spans.append(each.span)
    spans += definitions(reading, place)
    spans += [each.span for each in mentions(reading, place)]
    for symbol in symbols(reading):
        assert symbol.span.start <= symbol.name_span.start <= symbol.name_span.end
        assert symbol.name_span.end <= symbol.span.end
        spans.append(symbol.span)
    changes = renamed(reading, place, new)
    for edits in (
        () if isinstance(changes, Refused) else changes,
        formatting(reading),
        fix_all(reading),
        *(fix.edits for fix in fixes(reading, Span(1, 1, *place))),
    ):
        spans += [edit.span for edit in edits]
    rows = lines(text)
    for span in spans:
        for line, column in (span.start, span.end):
            assert 1 <= line <= len(rows)
            assert 1 <= column <= len(rows[line - 1]) + 1


@given(asked(texts))
def test_what_completion_offers_replaces_the_beginning_of_a_word(
    question: tuple[str, Place],
) -> None:
    text, place = question
    rows = lines(text)
    for each in completions(Reading(text), place):
        start, end = each.span.column, each.span.end_column
        replaced = rows[each.span.line - 1][start - 1 : end - 1]
        assert each.span.line == each.span.end_line
        assert replaced == "" or replaced.replace("_", "").isalnum()


@given(
    valid,
    st.data(),
    st.sampled_from(["renamed", "a1", "Thrust", *FOREIGN]),
)
def test_a_renamed_program_is_the_same_up_to_the_name(
    text: str, data: st.DataObject, new: str
) -> None:
    reading = Reading(text)
    if not reading.names:
        return
    name = data.draw(st.sampled_from(sorted(reading.names)))
    place = data.draw(st.sampled_from(reading.names[name])).start
    edits = renamed(reading, place, new)
    if isinstance(edits, Refused):
        assert new in reading.names
        return
    after = put_in(text, edits)
    tree = parse_program(after).program
    assert tree is not None
    back = renamed(Reading(after), _moved(edits, place), name)
    assert not isinstance(back, Refused)
    assert put_in(after, back) == text
    assert printed(tree) == printed(parse_program(_words(text, name, new)).tree)
    if not diagnose(text):
        assert not diagnose(after)


def _moved(edits: tuple[Edit, ...], place: Place) -> Place:
    """Where a place is after the edits before it in its line."""
    line, column = place
    for each in edits:
        if each.span.line == line and each.span.start < place:
            column += len(each.text) - (each.span.end_column - each.span.column)
    return line, column


def _words(text: str, name: str, new: str) -> str:
    """A text with a whole word replaced, the plain way: what a rename should come to where there are no comments."""
    return re.sub(rf"(?<![\w.]){re.escape(name)}(?!\w)", new, text)


@given(texts)
def test_formatting_gives_the_normal_form_with_the_line_ends_of_the_text(text: str) -> None:
    after = put_in(text, formatting(Reading(text)))
    plain = formatted(text)
    assert after == text or after.replace("\r\n", "\n").replace("\r", "\n") == plain
    assert formatting(Reading(after)) == ()
    if "\r" not in text:
        assert after == plain


@given(texts, st.integers(0, 40), st.integers(0, 6))
def test_the_token_at_a_place_is_the_one_around_or_beside_it(text: str, at: int, row: int) -> None:
    reading = Reading(text)
    place = Page(text).place(Position(row, at))
    index = reading.token_at(place)
    t = reading.tokens
    starts = [*zip(t.lines, t.columns, strict=True)][:-2]
    touching = [
        i
        for i, (line, column) in enumerate(starts)
        if line == place[0] and column <= place[1] <= t.ends[i]
    ]
    assert (index in touching) if touching else index is None
    assert reading.last_before(place) == bisect_right(starts, (place[0], place[1] - 1)) - 1


def reads(before: list[str]) -> bool:
    """Is the next operand that of a getter? To read `null` is legal there, but stops the program: it is not offered."""
    while before and before[-1] == "(":
        before = before[:-1]
    return bool(before) and before[-1] in GETTERS


@given(program_texts(), st.data())
def test_the_word_that_a_program_has_somewhere_is_offered_there(
    text: str, data: st.DataObject
) -> None:
    whole = Reading(text)
    t = whole.tokens
    declared = {each.target.span for found in whole.declarations.values() for each in found}
    places = [
        i
        for i in range(len(t.kinds) - 2)
        if whole.is_word(i)
        and t.span(i, i) not in declared
        and len(whole.names.get(t.texts[i], "..")) > 1
        and not (t.kinds[i] == "null" and reads(t.kinds[:i]))
    ]
    if not places:
        return
    index = data.draw(st.sampled_from(places))
    word, span = t.texts[index], t.span(index, index)
    for typed in (word[:1], ""):
        reading = Reading(put_in(text, [Edit(span, typed)]))
        place = (span.line, span.column + len(typed))
        assert word in [each.label for each in completions(reading, place)]
