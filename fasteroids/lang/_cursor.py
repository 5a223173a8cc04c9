"""A place in the tokens, and the errors found so far: what the parser's two halves share.

Two rules keep follow-on errors away. No two errors have the same span. And after the parser has skipped something,
it is *mute* about the token it goes on with: nothing was read since, so a complaint about that token would be the
same fault told again.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from fasteroids.lang import foreign, words
from fasteroids.lang.diagnostics import Diagnostic, Edit, Note
from fasteroids.lang.lexer import BROKEN, END, NAME, NUMBER, STRAY, Tokens, quoted
from fasteroids.lang.names import closest_word
from fasteroids.lang.source import Span

__all__ = ["ENDINGS", "OPERANDS", "STARTERS", "Cursor"]

OPERANDS: Final = frozenset(
    {NAME, NUMBER, "(", "!", *words.CONSTANTS, *words.GETTERS, *words.CALLS}
)
"""Tokens that start an expression and cannot go on with one (a minus can)."""

ENDINGS: Final = frozenset({";", ")", "{", ",", "then", "do", "}", STRAY, END})
"""Tokens that may stand behind an expression."""

STARTERS: Final = frozenset({*words.TYPES, *words.ACTIONS, "if", "while", "foreach", "print"})
"""Words that start a statement and nothing else."""

_LIKE_ASSIGNMENT: Final = frozenset({"=", "=!", *foreign.SHORTHANDS})
_BORDERS: Final = frozenset({";", "{", "}", STRAY, END})
_MOST_SUGGESTIONS: Final = 40
_MOST_IN_CALL: Final = 64


class Cursor:
    """The tokens of one text with the index of the next, `at`."""

    brackets = 0
    """How many parentheses are open."""

    def __init__(self, tokens: Tokens, faults: list[Diagnostic]) -> None:
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.texts = tokens.texts
        self.at = 0
        self.faults = faults
        self.told = {fault.span for fault in faults}
        self.mute = -1
        self.suggestions = _MOST_SUGGESTIONS
        """How often a misspelt word is looked up: it costs more than to parse a line."""
        self.span = tokens.span

    def report(
        self, code: str, message: str, span: Span, hint: str | None = None, *, label: str = "",
        notes: tuple[Note, ...] = (), fix: tuple[Edit, ...] = (), about: int | None = None,
    ) -> None:  # fmt: skip
        """Tell of a fault that token `about` (the next one, if not said) brought to light, unless it was told."""
        if (self.at if about is None else about) <= self.mute or span in self.told:
            return
        self.told.add(span)
        self.faults.append(Diagnostic(code, message, span, hint, label, notes, fix))

    def here(self) -> Span:
        """The next token's place."""
        return self.span(self.at, self.at)

    def behind(self) -> Span:
        """The empty piece just behind the last token read."""
        return self.tokens.after(self.at - 1)

    def shown(self) -> str:
        """The next token for a message."""
        return (
            "the end of the program" if self.kinds[self.at] == END else quoted(self.texts[self.at])
        )

    def same_line(self) -> bool:
        """Does the next token stand in the line of the last one read?"""
        return self.at > 0 and self.tokens.lines[self.at] == self.tokens.lines[self.at - 1]

    def touching(self) -> bool:
        """Does the next token stand right behind the last one read?"""
        return self.same_line() and self.tokens.columns[self.at] == self.tokens.ends[self.at - 1]

    def starts_statement(self) -> bool:
        """Is the next token surely the first of a statement?"""
        kind = self.kinds[self.at]
        if kind != NAME:
            return kind in STARTERS
        sign = self.kinds[self.at + 1]
        return sign == ":=" or (sign in _LIKE_ASSIGNMENT and not self.brackets)

    def ahead(self) -> int:
        """The index of the next token that can be read."""
        at = self.at
        while self.kinds[at] == BROKEN:
            at += 1
        return at

    def skip_statement(self) -> None:
        """On to where a statement may start: behind a `;`, or at a brace, at a word that starts one, or at the end."""
        kinds = self.kinds
        while kinds[self.at] not in _BORDERS and not self.starts_statement():
            self.at += 1
        self.mute = self.at
        if kinds[self.at] == ";":
            self.at += 1

    def skip_expression(self) -> None:
        """On to the end of the expression: to a bracket or comma that is not its own, a border, or a statement."""
        kinds = self.kinds
        opened = 0
        while (kind := kinds[self.at]) not in _BORDERS and kind not in STARTERS:
            if kind == "(":
                opened += 1
            elif (kind == ")" and not opened) or (kind == "," and not opened):
                break
            elif kind == ")":
                opened -= 1
            elif kind == NAME and kinds[self.at + 1] == ":=" and not self.same_line():
                break
            self.at += 1
        self.mute = self.at

    def skip_head(self) -> bool:
        """On to the `{` of a construct the language has not; False if there is none before its end."""
        kinds = self.kinds
        opened = 0
        while (kind := kinds[self.at]) not in ("{", "}", STRAY, END):
            if kind == "(":
                opened += 1
            elif kind == ")":
                opened -= 1
            elif opened <= 0 and (kind == ";" or self.starts_statement()):
                break
            self.at += 1
        self.mute = self.at
        return kind == "{"

    def skip_block(self) -> None:
        """On to the `}` of the block the next token is in."""
        kinds = self.kinds
        opened = 0
        while (kind := kinds[self.at]) != END:
            if kind == "{":
                opened += 1
            elif kind == "}":
                if not opened:
                    break
                opened -= 1
            self.at += 1
        self.mute = self.at

    def indent(self, index: int) -> int:
        """The column that the line of a token starts in."""
        rows = self.tokens.lines
        while index and rows[index - 1] == rows[index]:
            index -= 1
        return self.tokens.columns[index]

    def closing(self, opened: int) -> int | None:
        """The index of the `)` that belongs to the `(` at `opened`, if it comes soon and in the same statement."""
        nested = 0
        for index in range(opened, min(opened + _MOST_IN_CALL, len(self.kinds))):
            kind = self.kinds[index]
            if kind == "(":
                nested += 1
            elif kind == ")":
                nested -= 1
                if not nested:
                    return index
            elif kind in _BORDERS:
                break
        return None

    def suggested(self, word: str, choices: Iterable[str]) -> str | None:
        """What a misspelt word stands for; after many, no more is looked up."""
        if self.suggestions <= 0 or len(word) > 12:
            return None
        self.suggestions -= 1
        return closest_word(word, choices)
