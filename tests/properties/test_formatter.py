"""The laws of the formatter, over programs with comments and odd spacing between any two tokens."""

from __future__ import annotations

import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

from fasteroids.lang.formatter import comments, formatted
from fasteroids.lang.parser import parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import Program
from fasteroids.testing import program_texts, programs, trees
from tests.oracle.writing import noisy

any_program = st.one_of(programs(), trees())
any_text = noisy(any_program).map(lambda noise: noise[1])


@st.composite
def spread(draw: st.DrawFn) -> str:
    """A text of the strategy for users, with comments and empty lines between and behind its lines."""
    more = st.sampled_from(
        ["", "", "", " // behind", "\n// below", "\r\n\r\n", "\n\n\n// on its own\n"]
    )
    return "".join(line + draw(more) + "\n" for line in draw(program_texts()).split("\n"))


any_layout = any_text | spread()


@given(any_layout)
def test_formatting_again_changes_nothing(text: str) -> None:
    once = formatted(text)
    assert formatted(once) == once


@given(any_layout)
def test_the_meaning_stays(text: str) -> None:
    new = parse_program(formatted(text))
    assert new.diagnostics == ()
    assert new.tree == parse_program(text).tree


@given(any_layout)
def test_every_comment_stays_in_its_order(text: str) -> None:
    told = [each.text for each in comments(text)]
    assert [each.text for each in comments(formatted(text))] == told
    assert "".join(told).count("//") >= len(told)


@given(any_program)
def test_what_was_printed_is_in_normal_form(program: Program) -> None:
    assert formatted(printed(program)) == printed(program)


@given(any_layout)
def test_a_formatted_text_is_tidy(text: str) -> None:
    new = formatted(text)
    lines = new.split("\n")
    assert "\r" not in new
    assert lines.pop() == ""
    assert all(line == line.rstrip(" \t") for line in lines)
    assert all(len(line) - len(line.lstrip(" ")) in range(0, 200, 2) for line in lines)
    for above, below in zip(["", *lines], [*lines, ""], strict=True):
        assert above or below or not new, "no two empty lines, none at the start or the end"


@given(any_layout)
def test_without_its_comments_and_empty_lines_it_is_what_the_printer_makes(text: str) -> None:
    bare = (line.partition("//")[0].split() for line in formatted(text).split("\n"))
    tokens = [token for line in bare for token in line]
    wanted = printed(parse_program(text).tree).split()
    if len(tokens) == len(wanted):  # else braces around an `if` are kept, for a comment beside it
        assert tokens == wanted
    else:
        assert len(tokens) > len(wanted)
        assert [token for token in tokens if token != "}" and token != "{"] == [
            token for token in wanted if token != "}" and token != "{"
        ]


@pytest.mark.parametrize("piece", ["}  //", "{  //", "else {  //", ";\n\n", "\n\n//"])
def test_the_layouts_have_comments_in_all_sorts_of_places(piece: str) -> None:
    # Found is enough: the least one is of no interest.
    quick = settings(phases=[Phase.generate], max_examples=2000, derandomize=True, database=None)
    find(any_layout, lambda text: piece in formatted(text), settings=quick)
