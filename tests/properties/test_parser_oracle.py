"""Two parsers that share nothing but the tree: ours, and one made from a grammar (`tests/oracle`)."""

from __future__ import annotations

import pytest
from hypothesis import find, given
from hypothesis import strategies as st

from fasteroids.lang.parser import parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import MOST_NESTED, Program
from fasteroids.testing import program_texts, programs, trees
from tests.oracle.reading import read
from tests.oracle.walking import depth
from tests.oracle.writing import damaged, noisy

any_program = st.one_of(programs(), trees())
any_text = st.one_of(program_texts(), trees().map(printed), noisy(any_program).map(lambda p: p[1]))


@given(any_program)
def test_L12_parsing_what_was_printed_gives_the_same_tree(program: Program) -> None:
    text = printed(program)
    parsed = parse_program(text)
    assert parsed.diagnostics == ()
    assert parsed.tree == program
    assert printed(parsed.tree) == text
    assert read(text) == program


@given(noisy(any_program))
def test_noise_changes_no_tree(noise: tuple[Program, str]) -> None:
    program, text = noise
    parsed = parse_program(text)
    assert parsed.diagnostics == ()
    assert parsed.program == program
    assert read(text) == program


@given(damaged(any_text))
def test_both_parsers_refuse_a_damaged_text_or_read_the_same(text: str) -> None:
    parsed = parse_program(text)
    assert read(text) == parsed.program
    assert (parsed.program is None) == bool(parsed.diagnostics)


@pytest.mark.parametrize("good", [True, False])
def test_damage_is_often_fatal_and_sometimes_not(good: bool) -> None:
    find(damaged(any_text), lambda text: (read(text) is not None) == good and len(text) > 40)


# The limit to nesting, which the oracle has not.


_WAYS = ["{}+1", "1+({})", "-{}", "getx {}", "cos({})"]
_HEADS = ["while b {{{}}}", "if b {{}} else {{{}}}", "if b {{}} else if b {{{}}}"]


@st.composite
def deep(draw: st.DrawFn) -> str:
    """A text about as deep as a program may be, in one way or a few by turns."""
    ways = draw(st.lists(st.sampled_from(_WAYS), min_size=1, max_size=3))
    heads = draw(st.lists(st.sampled_from(_HEADS), max_size=20))
    text = "a"
    # A head is two nodes or more: a statement and its block.
    for way in (ways * MOST_NESTED)[: MOST_NESTED - 2 * len(heads) - draw(st.integers(-5, 25))]:
        text = way.format(text)
    text = f"print {text};"
    for head in heads:
        text = head.format(text)
    return text


@given(deep())
def test_a_text_is_refused_for_its_depth_just_where_its_tree_is_deeper_than_the_limit(
    text: str,
) -> None:
    program = read(text)
    assert program is not None
    if depth(program.body) <= MOST_NESTED:
        assert parse_program(text).program == program
    else:
        assert "nested too deeply" in parse_program(text).diagnostics[0].message


@pytest.mark.parametrize("pairs", [MOST_NESTED, MOST_NESTED + 1])
def test_parentheses_nobody_needs_have_the_same_limit(pairs: int) -> None:
    parsed = parse_program(f"print {'(' * pairs}1{')' * pairs};")
    assert (parsed.program is None) == (pairs > MOST_NESTED)


# Where two readings of the definition are possible: this one is meant.

LEGAL = {
    "skip": "skip;",
    "skip fire;": "skip; fire;",
    "skip; ; {": None,
    ";;;": "",
    "if a then{}else if b then{}else{}": "if (a) {} else { if (b) {} else {} }",
    "if a {} ; else {}": None,
    "while (a) + b {}": "while (a + b) {}",
    "while -a do {}": "while (-a) {}",
    "foreach any, a {}": None,
    "{ skip; }": None,
    "print a--b;": "print a - (-b);",
    "print a---b;": "print a - (-(-b));",
    "print 5-3;": "print 5 - 3;",
    "print !a==b;": "print (!a) == b;",
    "print getx a+1;": "print (getx a) + 1;",
    "print getx(a)+1;": "print (getx a) + 1;",
    "print-a;": "print -a;",
    "turn(a);": "turn a;",
    "print sqrt a;": None,
    "print getdir self;": None,
    "print a<b<c;": "print (a < b) < c;",
    "print 007.50;": "print 7.5;",
    "print .5;": None,
    "print 5.;": None,
    "print 5 . 0;": None,
    "print 1e3;": None,
    "while a<3do{}": None,
    "print 3 ;// end": "print 3;",
    "print 3 / / 4;": None,
    "print 1;/**/": None,
    "double a := 1, b;": None,
    "double a b;": None,
    "thrust_off ;thrust;": "thrust_off; thrust;",
    "Thrust := 1;": "Thrust := 1;",
    "thrust := 1;": None,
    "a := b := 1;": None,
    "a : = 1;": None,
    "print a ! = b;": None,
    "\ufeffskip;": "skip;",
    "skip;\ufeff": None,
    "skip;\x1a": None,
    "skip;\x0c": None,
}


@pytest.mark.parametrize("text", LEGAL, ids=repr)
def test_what_is_legal_is_so_to_both_parsers(text: str) -> None:
    meant = LEGAL[text]
    program = parse_program(text).program
    assert program == read(text)
    if meant is None:
        assert program is None
    else:
        assert program is not None
        assert program == read(meant)


@pytest.mark.parametrize("digits", [308, 309, 400])
def test_both_parsers_refuse_a_number_beyond_the_doubles(digits: int) -> None:
    text = f"print {'9' * digits};"
    assert read(text) == parse_program(text).program
    assert (read(text) is None) == (digits > 308)
