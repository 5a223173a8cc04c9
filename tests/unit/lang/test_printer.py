"""The normal form: its look, its parentheses, its numbers. That it reads back is law L12, in the properties."""

from __future__ import annotations

import math
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.lang.printer import printed
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Missing,
    Name,
    Null,
    Number,
    Print,
    Program,
    Self,
    Statement,
    Truth,
    Turn,
    Unary,
    While,
)

A, B, C = Name("a"), Name("b"), Name("c")
SKIP = Block((Act("skip"),))

NORMAL = """\
double d := 0.2;
bool b;
entity e := null;
b := true;
while (b) {
  foreach (asteroid, e) {
    if (e == self) {
      print getx e;
    } else if (e != null && getradius e >= 2) {
    } else {
      if (b) {
        d := -getdir;
      }
      print false;
    }
  }
  turn d * (1 - d);
  fire;
}
thrust_off;
"""

TREE = Program(
    Block(
        (
            Declaration("double", Name("d"), Number(0.2)),
            Declaration("bool", Name("b")),
            Declaration("entity", Name("e"), Null()),
            Assignment(Name("b"), Truth(True)),
            While(
                Name("b"),
                Block(
                    (
                        ForEach(
                            "asteroid",
                            Name("e"),
                            Block(
                                (
                                    If(
                                        Binary("==", Name("e"), Self()),
                                        Block((Print(Unary("getx", Name("e"))),)),
                                        Block(
                                            (
                                                If(
                                                    Binary(
                                                        "&&",
                                                        Binary("!=", Name("e"), Null()),
                                                        Binary(
                                                            ">=",
                                                            Unary("getradius", Name("e")),
                                                            Number(2.0),
                                                        ),
                                                    ),
                                                    Block(),
                                                    Block(
                                                        (
                                                            If(
                                                                Name("b"),
                                                                Block(
                                                                    (
                                                                        Assignment(
                                                                            Name("d"),
                                                                            Unary("-", Direction()),
                                                                        ),
                                                                    )
                                                                ),
                                                            ),
                                                            Print(Truth(False)),
                                                        )
                                                    ),
                                                ),
                                            )
                                        ),
                                    ),
                                )
                            ),
                        ),
                        Turn(Binary("*", Name("d"), Binary("-", Number(1.0), Name("d")))),
                        Act("fire"),
                    )
                ),
            ),
            Act("thrust_off"),
        )
    )
)


def test_every_construct_has_its_normal_form() -> None:
    assert NORMAL == printed(TREE)


def test_an_empty_program_is_no_text_and_any_other_ends_its_last_line() -> None:
    assert printed(Program(Block())) == ""
    assert printed(Program(SKIP)) == "skip;\n"


def test_a_block_is_its_statements_and_a_statement_has_no_line_end_behind_it() -> None:
    assert printed(Block((Act("skip"), Act("fire")))) == "skip;\nfire;"
    assert printed(While(A, SKIP)) == "while (a) {\n  skip;\n}"


@pytest.mark.parametrize(
    ("orelse", "text"),
    [
        (None, "if (a) {\n  skip;\n}"),
        (Block(), "if (a) {\n  skip;\n} else {\n}"),
        (Block((If(B, Block()),)), "if (a) {\n  skip;\n} else if (b) {\n}"),
        (Block((If(B, Block(), Block()),)), "if (a) {\n  skip;\n} else if (b) {\n} else {\n}"),
        (
            Block((If(B, Block()), Act("fire"))),
            "if (a) {\n  skip;\n} else {\n  if (b) {\n  }\n  fire;\n}",
        ),
    ],
)
def test_else_if_stands_for_an_else_of_one_if_and_nothing_else(
    orelse: Block | None, text: str
) -> None:
    assert text == printed(If(A, SKIP, orelse))


def test_a_long_chain_of_else_if_is_flat_text() -> None:
    chain = If(A, Block())
    for _ in range(40):
        chain = If(A, Block(), Block((chain,)))
    assert printed(chain) == "if (a) {\n" + "} else if (a) {\n" * 40 + "}"


def add(left: Expression, right: Expression) -> Expression:
    return Binary("+", left, right)


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (add(add(A, B), C), "a + b + c"),
        (add(A, add(B, C)), "a + (b + c)"),
        (Binary("-", A, Binary("-", B, C)), "a - (b - c)"),
        (Binary("%", Binary("/", A, B), C), "a / b % c"),
        (Binary("*", add(A, B), C), "(a + b) * c"),
        (add(A, Binary("*", B, C)), "a + b * c"),
        (Binary("<", Binary("<", A, B), C), "a < b < c"),
        (Binary("==", A, Binary("<", B, C)), "a == (b < c)"),
        (Binary("||", A, Binary("&&", B, C)), "a || b && c"),
        (Binary("&&", Binary("||", A, B), C), "(a || b) && c"),
        (Binary("&&", A, Binary("<", B, add(C, C))), "a && b < c + c"),
        (Unary("-", Unary("-", A)), "- -a"),
        (Unary("-", Unary("-", Unary("-", A))), "- - -a"),
        (Binary("-", A, Unary("-", B)), "a - -b"),
        (Binary("-", Unary("-", A), B), "-a - b"),
        (Unary("-", Binary("-", A, B)), "-(a - b)"),
        (Unary("!", Unary("!", A)), "!!a"),
        (Unary("!", Unary("-", A)), "!-a"),
        (Binary("&&", Unary("!", A), B), "!a && b"),
        (add(Unary("getx", A), B), "getx a + b"),
        (Unary("getx", add(A, B)), "getx (a + b)"),
        (Unary("gety", Unary("-", A)), "gety -a"),
        (Unary("-", Unary("getvx", Self())), "-getvx self"),
        (Unary("getvy", Unary("getradius", A)), "getvy getradius a"),
        (Unary("sqrt", Binary("||", A, B)), "sqrt(a || b)"),
        (Unary("-", Unary("cos", Unary("sin", A))), "-cos(sin(a))"),
    ],
)
def test_parentheses_stand_only_where_the_tree_needs_them(tree: Expression, text: str) -> None:
    assert text == printed(tree)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (2.0, "2"),
        (0.2, "0.2"),
        (1e16, "1" + "0" * 16),
        (1.5e-7, "0.00000015"),
        (5e-324, "0." + "0" * 323 + "5"),
        (1e23, "1" + "0" * 23),
        (sys.float_info.max, "17976931348623157" + "0" * 292),
    ],
)
def test_a_number_is_its_shortest_digits_without_an_exponent(value: float, text: str) -> None:
    assert text == printed(Number(value))


@given(st.floats(min_value=0.0, allow_nan=False, allow_infinity=False))
def test_a_number_reads_back_as_the_same_double(value: float) -> None:
    text = printed(Number(value))
    assert float(text) == value
    whole, _, rest = text.partition(".")
    assert (whole + rest).isdecimal()
    assert ("." in text) == bool(rest)


@pytest.mark.parametrize("value", [-1.0, -0.0, math.inf, math.nan])
def test_a_number_no_text_gives_is_our_fault(value: float) -> None:
    with pytest.raises(AssertionError, match="no text gives"):
        printed(Number(value))


@pytest.mark.parametrize(
    "statement", [Print(Missing()), Assignment(A, add(B, Missing())), While(Missing(), SKIP)]
)
def test_a_tree_with_a_piece_missing_has_no_text(statement: Statement) -> None:
    with pytest.raises(AssertionError, match="missing"):
        printed(Program(Block((statement,))))


def test_places_and_source_have_no_say() -> None:
    place = Span(3, 1, 3, 5)
    there = Program(Block((Print(Name("a", span=place), span=place),), span=place), "print a;//x")
    assert printed(there) == "print a;\n"
