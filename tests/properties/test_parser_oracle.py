"""Two parsers that share nothing but the tree: ours, and one made from a grammar (`tests/oracle`)."""

from __future__ import annotations

import pytest
from hypothesis import find, given
from hypothesis import strategies as st

from fasteroids.lang.parser import parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import Program
from fasteroids.testing import program_texts, programs, trees
from tests.oracle.reading import read
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
