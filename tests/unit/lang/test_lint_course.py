"""What the parser of 2013 read otherwise, against a reader of its kind: `fasteroids.lang.lint`, with `course`."""

from __future__ import annotations

import pytest
from hypothesis import given

from fasteroids.lang import diagnose, parse_program
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import mended
from fasteroids.lang.lint import warnings
from fasteroids.lang.parser.lexer import tokens
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import Binary, Expression, Print, Unary
from fasteroids.lang.words import BINARY, CALLS, GETTERS
from fasteroids.testing.programs import expressions

DECLARED = "double a; double b; double c; double d; bool p; bool q; entity e;\n"


def found(text: str, code: str) -> list[Diagnostic]:
    assert diagnose(text) == ()
    return [each for each in warnings(parse_program(text).tree, course=True) if each.code == code]


# A reader of 2013: all operators alike and to the right, getters and `!` take everything.


def read_in_2013(text: str) -> str:
    """The expression with all the parentheses that show how it was grouped then."""
    words = [word for word in tokens(text)[0].texts if word]

    def whole() -> str:
        left = operand()
        if words and words[0] in BINARY:
            return f"({left} {words.pop(0)} {whole()})"
        return left

    def operand() -> str:
        word = words.pop(0)
        if word == "(" or word in CALLS:
            if word in CALLS:
                words.pop(0)
            inner = whole()
            assert words.pop(0) == ")"
            return inner if word == "(" else f"{word}({inner})"
        if word in GETTERS or word == "!":
            return f"{word}({whole()})"
        return f"-({operand()})" if word == "-" else word

    told = whole()
    assert not words
    return told


def read_now(e: Expression) -> str:
    """The same of a tree of ours."""
    match e:
        case Binary(operator, left, right):
            return f"({read_now(left)} {operator} {read_now(right)})"
        case Unary(operator, operand):
            return f"{operator}({read_now(operand)})"
    return printed(e)


def chains(e: Expression) -> object:
    """A tree in which `a + b + c` has one form, however grouped; and so of `*`, `&&` and `||`."""
    match e:
        case Binary("+" | "*" | "&&" | "||" as operator, left, right):
            sides: list[object] = []
            for side in (left, right):
                form = chains(side)
                joins = isinstance(form, tuple) and form[0] == operator and form[1] == "chain"
                sides += form[2:] if joins and isinstance(form, tuple) else [form]
            return (operator, "chain", *sides)
        case Binary(operator, left, right):
            return (operator, "pair", chains(left), chains(right))
        case Unary(operator, operand):
            return (operator, "prefix", chains(operand))
    return e


def value(text: str) -> Expression:
    statement = parse_program(text).tree.body.statements[-1]
    assert isinstance(statement, Print)
    return statement.value


@given(expressions("double") | expressions("bool"))
def test_it_is_told_where_the_reader_of_2013_grouped_otherwise_and_the_fix_makes_both_agree(
    e: Expression,
) -> None:
    text = (
        "double x; double y; double z; bool p; bool q; entity a; entity b; entity c;\n"
        f"print {printed(e)};"
    )
    then = value(f"print {read_in_2013(printed(e))};")
    some = found(text, "FA211")
    assert bool(some) == (chains(then) != chains(e))
    if some:
        after = mended(text, some)
        assert value(after) == e
        assert read_in_2013(after.split("\nprint ")[1].removesuffix(";")) == read_now(e)


@pytest.mark.parametrize(
    ("text", "after"),
    [
        ("a - b - c", "(a - b) - c"),
        ("a - b - c - d", "((a - b) - c) - d"),
        ("a * b + c", "(a * b) + c"),
        ("getx e + 1", "(getx e) + 1"),
        ("getx(e) + 1", "(getx(e)) + 1"),
        ("a + b * c + d", "(a + b * c) + d"),
        ("a + getx e + c", "(a + getx e) + c"),
        ("sqrt(a / b / c)", "sqrt((a / b) / c)"),
        ("a < b && p", "(a < b) && p"),
        ("!p && q", "(!p) && q"),
        ("-getx e - a", "(-getx e) - a"),
        ("(a - b - c)", "((a - b) - c)"),
    ],
)
def test_what_was_grouped_otherwise_gets_parentheses(text: str, after: str) -> None:
    program = f"{DECLARED}print {text};"
    some = found(program, "FA211")
    assert len(some) == 1
    assert mended(program, some) == f"{DECLARED}print {after};"


@pytest.mark.parametrize(
    "text",
    ["a + b * c", "a + b + c", "a * b * c", "p && q && p", "p || a < b", "(a - b) - c", "sqrt(a) - b",
     "(getx e) - a", "-1 - a", "getx e", "!(p && q)", "a - (b + c)", "((a) + b) + c", "self == e"],
)  # fmt: skip
def test_what_was_read_alike_is_not_told(text: str) -> None:
    assert found(f"{DECLARED}print {text};", "FA211") == []


def test_no_fix_has_more_parentheses_than_the_language_allows() -> None:
    long = "1" + " - 1" * 90
    (some,) = found(f"print {long};", "FA211")
    assert diagnose(mended(f"print {long};", [some])) == ()
    (some,) = found(f"print {'(' * 20}{long}{')' * 20};", "FA211")
    assert some.fix == ()


# Refused.


@pytest.mark.parametrize(
    ("text", "after"),
    [
        ("print a % b;", None),
        ("print -a;", None),
        ("print - 1;", None),
        ("print -(1);", None),
        ("print a-1;", "print a- 1;"),
        ("print a -1 * b;", "print a - 1 * b;"),
        ("if p { } else if q { fire; }", "if p { } else { if q { fire; } }"),
    ],
)
def test_what_was_refused_is_told(text: str, after: str | None) -> None:
    (one,) = found(DECLARED + text, "FA212")
    if after is None:
        assert one.fix == ()
    else:
        assert mended(DECLARED + text, [one]) == DECLARED + after
        assert parse_program(after).tree == parse_program(text).tree
        assert found(DECLARED + after, "FA212") == []


@pytest.mark.parametrize(
    "text",
    ["print a - 1;", "print -1;", "print a - -1;", "print a -b;", "print a -(1);",
     "if p { } else { if q { } }"],
)  # fmt: skip
def test_what_was_accepted_is_not_told(text: str) -> None:
    assert found(DECLARED + text, "FA212") == []


def test_only_on_demand() -> None:
    assert warnings(parse_program("print 10 - 3 -2 % 5;").tree) == ()


def test_long_chains_of_else_if_are_mended_at_once() -> None:
    text = DECLARED + "if p { fire; } " + "else if q { fire; } " * 20
    after = mended(text, found(text, "FA212"))
    assert after.count("else { if") == 20
    assert parse_program(after).tree == parse_program(text).tree
