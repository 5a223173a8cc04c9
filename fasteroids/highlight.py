"""How programs of the ship language are coloured: a lexer for Pygments, and the rules its TextMate twin is made of.

Pygments finds the lexer by itself, as `fasteroids` or by the file name `*.ast`; nothing else of the package
imports this module. All words and signs are those of `fasteroids.lang.words`. `tools/textmate.py` writes the same
rules as a TextMate grammar, so the expressions keep to what Python's `re` and Oniguruma read alike.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import ClassVar, Final, NamedTuple

from pygments.lexer import RegexLexer
from pygments.token import (
    Comment,
    Error,
    Keyword,
    Name,
    Number,
    Operator,
    Punctuation,
    Whitespace,
)

from fasteroids.lang import words

__all__ = ["RULES", "FasteroidsLexer", "Rule"]


class Rule(NamedTuple):
    """A kind of piece: what it looks like, what Pygments and what TextMate call it ('' for nothing)."""

    pattern: str
    token: tuple[str, ...]
    scope: str


def _word(choices: Iterable[str]) -> str:
    """One of these words, and not the beginning of a longer one."""
    return rf"\b(?:{'|'.join(map(re.escape, choices))})\b"


def _sign(choices: Iterable[str]) -> str:
    """One of these signs, the longest that fits."""
    return "|".join(map(re.escape, sorted(choices, key=len, reverse=True)))


RULES: Final = (
    Rule(r"\A\ufeff|[ \t\r\n]+", Whitespace, ""),
    Rule(r"//[^\r\n]*", Comment.Single, "comment.line.double-slash"),
    Rule(_word(words.TYPES), Keyword.Type, "storage.type"),
    Rule(_word(words.KINDS), Name.Class, "support.class"),
    Rule(_word(words.ACTIONS), Name.Function, "entity.name.function.action"),
    Rule(_word(words.STATEMENTS), Keyword, "keyword.control"),
    Rule(_word(words.CONSTANTS), Keyword.Constant, "constant.language"),
    Rule(_word(words.GETTERS), Operator.Word, "keyword.operator.getter"),
    Rule(_word(words.CALLS), Name.Builtin, "support.function"),
    Rule(r"\b[A-Za-z][A-Za-z0-9_]*\b", Name.Variable, "variable.other"),
    Rule(r"[0-9]+(?:\.[0-9]+)?(?![\w.])", Number, "constant.numeric"),
    # What the lexer of the language takes as one piece, only to refuse it: `1e-3`, `2x`, `.5`, `größe`.
    Rule(r"\.?[0-9](?:[eE][+-][0-9]|[\w.])*|\w+", Error, "invalid.illegal"),
    Rule(_sign(words.PUNCTUATION), Punctuation, "punctuation"),
    Rule(_sign((*words.BINARY, "!")), Operator, "keyword.operator"),
)
"""In order: where two fit at one place, the first counts. What fits none is no part of the language."""


class FasteroidsLexer(RegexLexer):  # type: ignore[misc] # Pygments has no types
    """Programs of ships. Any text can be coloured; what cannot be part of a program is of kind `Error`."""

    name = "Fasteroids"
    aliases = ("fasteroids",)
    filenames = ("*.ast",)
    tokens: ClassVar = {"root": [(rule.pattern, rule.token) for rule in RULES]}
