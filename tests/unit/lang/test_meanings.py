"""The table of meanings: complete, plain, and true to the parser and the machine."""

from __future__ import annotations

import pytest

from fasteroids.lang.checker import complaints
from fasteroids.lang.meanings import MEANINGS
from fasteroids.lang.parser import parse_program
from fasteroids.lang.words import KEYWORDS, SIGNS, STATEMENTS, TYPES


def test_each_word_and_each_sign_has_a_meaning_and_nothing_else_has() -> None:
    assert MEANINGS.keys() == KEYWORDS | set(SIGNS)


@pytest.mark.parametrize("word", MEANINGS)
def test_a_meaning_is_one_sentence_with_balanced_backquotes(word: str) -> None:
    sentence = MEANINGS[word].sentence
    assert sentence[0].isupper()
    assert sentence.endswith(".")
    assert ". " not in sentence
    assert sentence.count("`") % 2 == 0
    assert set(sentence.split("`")[1::2]) <= KEYWORDS
    assert len(sentence) < 200


@pytest.mark.parametrize("word", MEANINGS)
def test_the_usage_of_a_word_has_it_and_can_be_read(word: str) -> None:
    usage = MEANINGS[word].usage
    assert word in usage
    text = usage.replace("kind", "any")
    if word in TYPES or "{ }" in usage or usage.endswith(";"):
        program = text if text != "{ }" else "while (e) { }"
    else:
        program = f"print {text};"
    assert parse_program(program).diagnostics == (), program


@pytest.mark.parametrize("word", sorted(KEYWORDS - {*STATEMENTS, *TYPES, "any"}))
def test_the_usage_of_a_word_is_well_typed_for_the_types_it_speaks_of(word: str) -> None:
    usage = MEANINGS[word].usage
    kind = "entity" if word.startswith("get") or "foreach" in usage else "double"
    statement = usage if usage.endswith((";", "}")) else f"print {usage};"
    text = f"{kind} e; entity x; {statement}"
    assert complaints(parse_program(text).tree) == ()
