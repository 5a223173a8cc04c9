"""The grammar in `docs/grammar.md` is the language: made into a parser, it takes what ours takes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from lark import Lark, UnexpectedInput

from fasteroids.lang.parser import parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.words import BINARY, KEYWORDS, SIGNS, UNARY
from fasteroids.testing import trees
from tests.oracle.writing import damaged, noisy

PAGE = (Path(__file__).parents[2] / "docs" / "grammar.md").read_text(encoding="utf-8")
GRAMMAR = re.search(r"```ebnf\n(.*?)```", PAGE, re.DOTALL)[1]  # type: ignore[index]
LEXICAL = ("number", "name")
RULES: dict[str, str] = dict(
    re.findall(r'^(\w+) += ((?:"[^"]*"|[^;"])*) ;$', GRAMMAR, re.MULTILINE)
)


def in_lark(rule: str) -> str:
    """The right side of a rule of EBNF in the notation of lark."""
    signs = {"{": "(", "}": ")*", ",": "", "number": "NUMBER", "name": "NAME"}
    parts = re.findall(r'"[^"]*"|\w+|[^\s\w]', rule)
    # Rules may be called what Python and lark call something else.
    return " ".join(signs.get(part, f"{part}_" if part.isalpha() else part) for part in parts)


def made() -> Lark:
    rules = [f"{name}_: {in_lark(rule)}" for name, rule in RULES.items() if name not in LEXICAL]
    terminals = [
        r"NUMBER: /[0-9]+(\.[0-9]+)?(?![0-9A-Za-z_.])/",
        r"NAME: /[A-Za-z][A-Za-z0-9_]*/",
        r"%ignore /[ \t\r\n]+|\/\/[^\r\n]*/",
    ]
    return Lark("\n".join(rules + terminals), start="program_", parser="lalr", lexer="basic")


PARSER = made()


def accepted(text: str) -> bool:
    try:
        PARSER.parse(text)
    except UnexpectedInput:
        return False
    return True


def test_every_rule_is_read_and_used() -> None:
    assert len(RULES) == GRAMMAR.count(" = ") == len(re.findall(r"^\w", GRAMMAR, re.MULTILINE))
    used = {
        word for rule in RULES.values() for word in re.findall(r"\w+", re.sub('"[^"]*"', "", rule))
    }
    assert used - {"letter", "digit"} == set(RULES) - {"program"}


def test_the_page_has_exactly_the_words_and_signs_of_the_language() -> None:
    rules = [rule for name, rule in RULES.items() if name not in LEXICAL]
    assert set(re.findall(r'"([^"]*)"', " ".join(rules))) == {*KEYWORDS, *SIGNS}


def test_the_table_has_the_strength_of_every_operator() -> None:
    rows = re.findall(r"^\| (\d) \| (.*?) \| ", PAGE, re.MULTILINE)
    strengths = {
        (sign.replace("\\", ""), int(strength))
        for strength, signs in rows
        for sign in re.findall("`(.*?)`", signs)
    }
    strongest = max(BINARY.values()) + 1
    assert strengths == {*BINARY.items(), *((sign, strongest) for sign in UNARY)}


@given(noisy(trees()))
def test_the_grammar_of_the_page_takes_every_program(program: tuple[object, str]) -> None:
    assert accepted(program[1])


@given(damaged(trees().map(printed)))
def test_the_grammar_of_the_page_refuses_what_the_parser_refuses(text: str) -> None:
    # The grammar has no word on the byte order mark and on numbers beyond the doubles: the text under it has.
    text = re.sub(r"[0-9]{300,}", "9", text.removeprefix("\ufeff"))
    assert accepted(text) == (parse_program(text).program is not None)


@pytest.mark.parametrize(
    ("one", "same"),
    [("10 - 3 - 2", "(10 - 3) - 2"), ("getx a + 1", "(getx a) + 1"), ("!a == b", "(!a) == b")],
)
def test_what_the_page_says_of_grouping_is_so(one: str, same: str) -> None:
    assert f"`{one}`" in PAGE
    first, second = (parse_program(f"print {text};").program for text in (one, same))
    assert first is not None
    assert first == second
