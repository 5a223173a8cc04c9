"""The colours of the ship language: the lexer for Pygments, the grammar for TextMate, and what comes with them."""

from __future__ import annotations

import json
import re
import tomllib
from importlib import import_module
from importlib.metadata import distribution
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pygments.token import Comment, Error, Keyword, Name, Number, Operator, Punctuation, Whitespace
from textmate import SCOPE, grammar

from fasteroids.highlight import RULES, FasteroidsLexer
from fasteroids.lang import words
from fasteroids.lang.parser.lexer import END, NAME, NUMBER, tokens
from fasteroids.testing import program_texts

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "editors" / "vscode"
GRAMMAR = FOLDER / "syntaxes" / "fasteroids.tmLanguage.json"
TABLES = {
    each: getattr(words, each)
    for each in ("TYPES", "KINDS", "ACTIONS", "STATEMENTS", "CONSTANTS", "GETTERS", "CALLS")
}

KNOWN = {*words.KEYWORDS, *words.SIGNS, NAME, NUMBER, END}
ODD = (
    "x", "größe", "1", "1.5", ".5", "1e-3", "2x", " ", "\t", "\n", "\r", "\r\n", "//", "/*", "=", "&", ".", "_",
    "\ufeff", "\ufffd",
)  # fmt: skip

Piece = tuple[tuple[str, ...], str]

odd_texts = st.one_of(
    st.text(),
    st.lists(st.sampled_from([*sorted(words.KEYWORDS), *words.SIGNS, *ODD])).map("".join),
)


def painted(text: str) -> list[Piece]:
    """The pieces of a text and their kinds, as Pygments has them before it trims anything."""
    return [(kind, piece) for _, kind, piece in FasteroidsLexer().get_tokens_unprocessed(text)]


# The lexer.


def test_every_word_of_the_table_has_the_kind_of_its_part() -> None:
    kinds: dict[str, tuple[str, ...]] = {}
    for part, members in TABLES.items():
        for word in members:
            [(kind, piece)] = painted(word)
            assert piece == word
            assert kind not in (Name, Name.Variable, Error)
            assert kinds.setdefault(part, kind) == kind
    assert len(set(kinds.values())) == len(TABLES)
    assert {word for part in TABLES.values() for word in part} == words.KEYWORDS


@pytest.mark.parametrize("word", sorted(words.KEYWORDS))
def test_longer_words_and_other_cases_are_names(word: str) -> None:
    for name in (f"{word}2", f"{word}_", f"x{word}", word.capitalize()):
        assert painted(name) == [(Name.Variable, name)]


def test_every_sign_is_one_piece_without_blanks_around_it() -> None:
    for sign in words.SIGNS:
        kind = Punctuation if sign in words.PUNCTUATION else Operator
        assert painted(f"a{sign}b") == [(Name.Variable, "a"), (kind, sign), (Name.Variable, "b")]


def test_a_line_with_something_of_all() -> None:
    assert painted("\ufeffdouble d:=sqrt(1.5); // if\r\n") == [
        (Whitespace, "\ufeff"), (Keyword.Type, "double"), (Whitespace, " "),
        (Name.Variable, "d"), (Punctuation, ":="), (Name.Builtin, "sqrt"), (Punctuation, "("),
        (Number, "1.5"), (Punctuation, ")"), (Punctuation, ";"), (Whitespace, " "),
        (Comment.Single, "// if"), (Whitespace, "\r\n"),
    ]  # fmt: skip


@pytest.mark.parametrize("text", [".5", "5.", "1e-3", "1.2.3", "2x", "größe", "_x", "=", "&", "."])
def test_what_is_no_piece_of_the_language_is_an_error(text: str) -> None:
    assert painted(text) == [(Error, text)]


@given(text=st.one_of(program_texts(), odd_texts))
def test_the_pieces_make_up_the_text(text: str) -> None:
    assert "".join(piece for _, piece in painted(text)) == text


def kept(text: str) -> list[str]:
    """The pieces that mean something."""
    return [piece for kind, piece in painted(text) if kind not in (Whitespace, Comment.Single)]


@given(text=program_texts())
def test_valid_programs_are_cut_as_the_parser_cuts_them_and_have_no_error(text: str) -> None:
    found, faults = tokens(text)
    assert faults == []
    assert kept(text) == found.texts[:-2]
    assert all(kind is not Error for kind, _ in painted(text))


@given(text=odd_texts)
def test_what_the_parser_can_cut_without_fault_is_cut_alike(text: str) -> None:
    found, faults = tokens(text)
    if not faults and KNOWN.issuperset(found.kinds):
        assert kept(text) == found.texts[:-2]
        assert all(kind is not Error for kind, _ in painted(text))


@pytest.mark.parametrize("name", ["first", "second-mended"])
def test_programs_of_the_course_have_no_error(name: str) -> None:
    text = (ROOT / "tests" / "programs" / f"{name}.ast").read_text("utf-8")
    assert [piece for kind, piece in painted(text) if kind is Error] == []


def test_pygments_finds_the_lexer_by_its_entry_point() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    [(name, place)] = project["entry-points"]["pygments.lexers"].items()
    module, _, attribute = place.partition(":")
    assert getattr(import_module(module), attribute) is FasteroidsLexer
    assert name in FasteroidsLexer.aliases
    assert "*.ast" in FasteroidsLexer.filenames
    installed = distribution("fasteroids").entry_points.select(group="pygments.lexers")
    assert all(each.load().name == FasteroidsLexer.name for each in installed)


# The grammar.


def test_the_grammar_in_the_repository_is_what_the_table_gives() -> None:
    assert GRAMMAR.read_text("utf-8") == grammar()


MATCHERS = [(re.compile(each["match"]), each["name"]) for each in json.loads(grammar())["patterns"]]


def scoped(text: str) -> list[tuple[str, str]]:
    """The pieces of a line as an editor finds them, with their scopes: the nearest match, by the first rule."""
    pieces, at = [], 0
    while found := [(match, name) for rule, name in MATCHERS if (match := rule.search(text, at))]:
        match, name = min(found, key=lambda each: each[0].start())
        pieces.append((match[0], name))
        at = match.end()
    return pieces


def test_every_word_has_the_scope_of_its_part() -> None:
    scopes: dict[str, str] = {}
    for part, members in TABLES.items():
        for word in members:
            [(piece, scope)] = scoped(word)
            assert piece == word
            assert scope != "variable.other.fasteroids"
            assert scopes.setdefault(part, scope) == scope
            assert [name for _, name in scoped(word + "2")] == ["variable.other.fasteroids"]
    assert len({*scopes.values()}) == len(TABLES)


def test_no_two_rules_share_a_scope() -> None:
    scopes = [rule.scope for rule in RULES if rule.scope]
    assert len(scopes) == len({*scopes})


@given(text=program_texts())
def test_an_editor_and_pygments_see_the_same_pieces(text: str) -> None:
    scope_of = {rule.token: f"{rule.scope}.fasteroids" for rule in RULES}
    expected = [(piece, scope_of[kind]) for kind, piece in painted(text) if kind is not Whitespace]
    assert [each for line in re.split("[\r\n]", text) for each in scoped(line)] == expected


# The folder for VS Code.


def test_the_extension_names_files_that_are_there() -> None:
    package = json.loads((FOLDER / "package.json").read_text("utf-8"))["contributes"]
    [language], [painter] = package["languages"], package["grammars"]
    assert painter["language"] == language["id"] == "fasteroids"
    assert painter["scopeName"] == SCOPE == json.loads(grammar())["scopeName"]
    assert (FOLDER / painter["path"]).resolve() == GRAMMAR
    assert [f"*{each}" for each in language["extensions"]] == [*FasteroidsLexer.filenames]
    assert (FOLDER / language["configuration"]).is_file()


def test_the_configuration_of_the_editor_is_about_this_language() -> None:
    settings = json.loads((FOLDER / "language-configuration.json").read_text("utf-8"))
    [(kind, _)] = painted(settings["comments"]["lineComment"])
    assert kind is Comment.Single
    for opening, closing in settings["brackets"]:
        assert {opening, closing} <= {*words.PUNCTUATION}
    assert [[each["open"], each["close"]] for each in settings["autoClosingPairs"]] == settings[
        "brackets"
    ]
    increase = re.compile(settings["indentationRules"]["increaseIndentPattern"])
    assert increase.search("while (a / 2 > b) {")
    assert not increase.search("turn 1; // {")
    for name in ("x", "thrust_off", "a2"):
        assert re.fullmatch(settings["wordPattern"], name)
