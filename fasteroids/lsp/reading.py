"""A text, read once for all that an editor may ask about it. Any text will do; each part is worked out on demand."""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property

from fasteroids.lang import parser
from fasteroids.lang.checker import uses as _uses
from fasteroids.lang.checker.uses import Construct, Use
from fasteroids.lang.checker.variables import Variables, understood
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnosed
from fasteroids.lang.lint import warnings
from fasteroids.lang.parser import Parsed
from fasteroids.lang.parser.lexer import NAME, Tokens, lines, tokens
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Declaration, Type
from fasteroids.lang.words import KEYWORDS

__all__ = ["Place", "Reading", "faults"]

Place = tuple[int, int]
"""Line and column, from 1: a place between two characters."""


def faults(text: str) -> tuple[Diagnostic, ...]:
    """Every error of a program; its warnings, if there are none. What `fasteroids check` finds."""
    return Reading(text).faults


class Reading:
    """What a text says. Its parts are values; none changes once it was asked for."""

    def __init__(self, text: str) -> None:
        self.text = text

    @cached_property
    def rows(self) -> list[str]:
        """The lines, without their ends."""
        return lines(self.text)

    @cached_property
    def parsed(self) -> Parsed:
        """The tree and the syntax errors."""
        return parser.parse_program(self.text)

    @cached_property
    def faults(self) -> tuple[Diagnostic, ...]:
        """Every error by place; the warnings, if there are no errors."""
        return diagnosed(self.parsed) or warnings(self.parsed.tree)

    @cached_property
    def constructs(self) -> list[Construct]:
        """Every statement and operator, each before what is in it."""
        return _uses.constructs(self.parsed.tree)

    @cached_property
    def variables(self) -> Variables:
        """The variables, with their types, as the author most likely means them."""
        return understood(self.parsed.tree, self.constructs)

    @cached_property
    def declarations(self) -> dict[str, list[Declaration]]:
        """The declarations of each name, in the order of the text."""
        return _uses.declarations(self.constructs)

    @cached_property
    def uses(self) -> dict[str, list[Use]]:
        """The uses of each name, in the order of the text; a declaration without a value is none."""
        return _uses.uses(self.constructs, self.variables.types)

    @cached_property
    def tokens(self) -> Tokens:
        """The tokens, the last two of them `END`: what the text says, before any guess at what is meant."""
        return tokens(self.text)[0]

    @cached_property
    def names(self) -> dict[str, list[Span]]:
        """Each variable, with all places where it is named, in the order of the text.

        All variables are global and no word of the language is a name, so the tokens say it all, whatever else is wrong
        with the text.
        """
        found: dict[str, list[Span]] = {}
        for i, kind in enumerate(self.tokens.kinds):
            if kind == NAME:
                found.setdefault(self.tokens.texts[i], []).append(self.tokens.span(i, i))
        return found

    def type_of(self, name: str) -> Type | None:
        """The type of a variable; None if it is in doubt."""
        return self.variables.types.get(name)

    def last_before(self, place: Place) -> int:
        """The index of the last token that starts before a place; -1 if none does."""
        rows, columns = self.tokens.lines, self.tokens.columns
        count = len(rows) - 2
        return bisect_right(range(count), place, key=lambda i: (rows[i], columns[i] + 1)) - 1

    def token_at(self, place: Place) -> int | None:
        """The index of the token at a place: around it, or beside it, a word rather than a sign."""
        behind = self.last_before(place)
        found = [i for i in (behind + 1, behind) if 0 <= i and self._touches(i, place)]
        return next((i for i in found if self.is_word(i)), found[0] if found else None)

    def _touches(self, index: int, place: Place) -> bool:
        line, column = place
        t = self.tokens
        if index >= len(t.kinds) - 2 or t.lines[index] != line:
            return False
        return t.columns[index] <= column <= t.ends[index]

    def is_word(self, index: int) -> bool:
        """Is a token a name or a word of the language?"""
        kind = self.tokens.kinds[index]
        return kind == NAME or kind in KEYWORDS

    def in_comment(self, place: Place) -> bool:
        """Does a comment start before a place, in its line?"""
        line, column = place
        return "//" in self.rows[line - 1][: column - 1]
