"""Braces that do not balance, balanced before the parser reads them.

The parser may then rely on braces: every `{` has its `}`, and what closes nothing is marked `STRAY`. Where braces are
missing or too many, the indentation of the lines tells which: a closing brace belongs to the opening one whose line
starts in its column, and a statement no deeper than the line that opened a block is not in it. Texts that balance
are left alone, however they are indented.
"""

from __future__ import annotations

from attrs import define

from fasteroids.lang.diagnostics import Diagnostic, Edit, Note
from fasteroids.lang.lexer import BROKEN, END, STRAY, Tokens, lines

__all__ = ["balance"]

_MOST_NOTES = 3
_MOST_MENDED = 20


@define(eq=False)
class _Open:
    """A `{` not closed yet: its token, the column its line starts in, and whether its body is indented (None: not
    known before its second line)."""

    index: int
    indent: int
    indented: bool | None = None


def balance(tokens: Tokens, text: str) -> tuple[Tokens, list[Diagnostic]]:
    """The tokens with the missing `}` put in and those that close nothing marked, and the errors."""
    missing, excess = _unmatched(tokens.kinds)
    if not missing and not excess:
        return tokens, []
    return _Repair(tokens, missing, excess).run(text)


def _unmatched(kinds: list[str]) -> tuple[int, int]:
    """How many `{` and how many `}` have no partner."""
    opened = excess = 0
    for kind in kinds:
        if kind == "{":
            opened += 1
        elif kind == "}":
            if opened:
                opened -= 1
            else:
                excess += 1
    return opened, excess


def _twice(kinds: list[str], i: int) -> bool:
    """Is the `{` at `i` the second of just two?"""
    around = kinds[max(i - 2, 0) : i + 2]
    return i > 0 and kinds[i - 1] == "{" and around.count("{") == 2


class _Repair:
    """One walk over the tokens, with the blocks open at each."""

    def __init__(self, tokens: Tokens, missing: int, excess: int) -> None:
        self.tokens = tokens
        self.missing = missing
        self.excess = excess
        self.open: list[_Open] = []
        self.closed: list[tuple[int, list[_Open]]] = []
        self.faults: list[Diagnostic] = []

    def run(self, text: str) -> tuple[Tokens, list[Diagnostic]]:
        """The new tokens, and what was missing."""
        kinds, rows, columns = self.tokens.kinds, self.tokens.lines, self.tokens.columns
        indent = row = 0
        end = kinds.index(END)
        for i in range(end):
            kind = kinds[i]
            starts = rows[i] != row
            if starts:
                row, indent = rows[i], columns[i]
                self.close_before(i)
            if kind == "{" and self.missing and not starts and _twice(kinds, i):
                self.doubled(i)
            elif kind == "{":
                self.open.append(_Open(i, indent))
            elif kind == "}":
                self.match(i, starts)
        if self.open:
            self.closed.append((end, self.open[::-1]))
        source = lines(text)
        self.faults += [self.fault(at, blocks, source) for at, blocks in self.closed]
        return self.mended(), self.faults

    def close_before(self, i: int) -> None:
        """Blocks that the indentation of token `i`, first in its line, shows to be over."""
        column, kind = self.tokens.columns[i], self.tokens.kinds[i]
        if not self.open:
            return
        if self.open[-1].indented is None:
            self.open[-1].indented = column > self.open[-1].indent
        over = []
        while self.missing and self.open:
            top = self.open[-1]
            if kind == "}":
                # Only if it can close a block further out.
                ends = column < top.indent and len(self.open) > 1
            else:
                ends = top.indented is True and column <= top.indent
            if not ends:
                break
            over.append(self.open.pop())
            self.missing -= 1
        if over:
            self.closed.append((i, over))

    def match(self, i: int, starts: bool) -> None:
        """Give the `}` at `i` to the innermost block, or to none."""
        deeper = starts and self.open and self.tokens.columns[i] > self.open[-1].indent
        if not self.open or (self.excess and deeper):
            self.tokens.kinds[i] = STRAY
            self.excess -= 1
        else:
            self.open.pop()

    def doubled(self, i: int) -> None:
        """The `{` at `i` stands right behind another, and there are too many."""
        self.missing -= 1
        self.tokens.kinds[i] = BROKEN
        place = self.tokens.span(i, i)
        message = "This `{` stands there twice"
        self.faults.append(Diagnostic("FA033", message, place, "Remove it", fix=(Edit(place, ""),)))

    def mended(self) -> Tokens:
        """All tokens, with a `}` without extent for each block that lacks one."""
        old, new = self.tokens, Tokens()
        start = 0
        for at, blocks in self.closed:
            new.extend(old, start, at)
            place = old.after(at - 1)
            for _ in blocks:
                new.add("}", "", place.line, place.column, place.column)
            start = at
        new.extend(old, start, len(old.kinds))
        return new

    def fault(self, at: int, blocks: list[_Open], source: list[str]) -> Diagnostic:
        """The error for blocks that end without `}` just before token `at`."""
        place = self.tokens.after(at - 1)
        if len(blocks) == 1:
            message = "The `}` of a block is missing"
            hint = "Close the block with `}`"
        else:
            message = f"{len(blocks)} closing braces are missing"
            hint = "Close each block with `}`"
        notes = tuple(
            Note("this `{` is not closed", self.tokens.span(block.index, block.index))
            for block in blocks[:_MOST_NOTES]
        )
        fix: tuple[Edit, ...] = ()
        if len(blocks) <= _MOST_MENDED:
            fix = (Edit(place, "".join(self.brace(block, place.line, source) for block in blocks)),)
        return Diagnostic("FA014", message, place, hint, "`}` expected", notes, fix)

    def brace(self, block: _Open, row: int, source: list[str]) -> str:
        """A `}` as one would write it: under the line that opened the block, or behind a block of one line."""
        line = self.tokens.lines[block.index]
        if line == row:
            return " }"
        before = source[line - 1][: block.indent - 1]
        return "\n" + "".join(c if c in " \t" else " " for c in before) + "}"
