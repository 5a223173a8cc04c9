"""A program's text in normal form, with its comments: the lines of `printer`, and between them what was no token.

    while(b)do{// the hunt          while (b) {  // the hunt
    x:=1 // one                       // one
    +2;;fire}                         x := 1 + 2;
                                      fire;
                                    }

A comment stays where it can: behind the line it stands behind, or on a line of its own before what it stands before.
One inside a statement, or inside the head of a loop or an `if`, moves to the line before. Those between a `}` and the
`{` of its `else` keep the two on lines of their own. Those beside an `if` that is all of an `else { }` keep its braces.

Of the empty lines between two statements or comments one is left, of those behind a `{` or before a `}` none.

Laws: doing it twice changes nothing more, the tree stays equal, all comments stay in their order, and a text that
`printer` made stays as it is.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import Final, NamedTuple

from fasteroids.lang import parser
from fasteroids.lang.parser import lexer
from fasteroids.lang.printer import INDENT, Line, lines
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Block, Program

__all__ = ["Comment", "comments", "formatted", "laid_out"]

_BEHIND: Final = "  "
"""Between a line and the comment behind it."""


class Comment(NamedTuple):
    """A comment: where it starts, and its text from `//` on, without blanks at its end."""

    line: int
    column: int
    text: str


def comments(text: str) -> list[Comment]:
    """The comments of a program without syntax errors, by place."""
    # Nothing but a comment has `//` in it: there are no texts in quotes.
    found = ((row, line, line.find("//")) for row, line in enumerate(lexer.lines(text), 1))
    return [Comment(row, at + 1, line[at:].rstrip(" \t")) for row, line, at in found if at >= 0]


def formatted(text: str) -> str:
    """The text in normal form; one with syntax errors as it is.

    It ends in a line end, unless it is empty; its line ends are LF, and a byte order mark at its start is gone.
    """
    program = parser.parse_program(text).program
    return text if program is None else laid_out(program)


def laid_out(program: Program) -> str:
    """A program that was read without syntax errors, in normal form, with the comments of its source."""
    page = _Page(program.source)
    for line in lines(program.body, page.beside_lone):
        if line.text.startswith("} else") and page.comment_within(line.span):
            for half in page.halves(line):
                page.add(half)
        else:
            page.add(line)
    page.finish()
    return "".join(f"{line}\n" for line in page.written)


class _Page:
    """The lines written so far, and how much of the source is in them."""

    def __init__(self, source: str) -> None:
        self.written: list[str] = []
        self._comments = comments(source)
        self._places = [(each.line, each.column) for each in self._comments]
        self._rows = lexer.lines(source)
        self._empty = [row for row, line in enumerate(self._rows, 1) if not line.strip(" \t")]
        self._next = 0  # the comment to write next
        self._row = 0  # the line of the source in which the last thing written ended
        self._opened = True  # nothing is written since the start, or since a `{`

    # Where there are comments.

    def comment_within(self, span: Span) -> bool:
        """Does a comment start in this piece?"""
        return bisect_left(self._places, span.start) < bisect_left(self._places, span.end)

    def beside_lone(self, block: Block) -> bool:
        """Does a comment start in a block of one statement, but before or behind that?"""
        (lone,) = block.statements
        before = Span(*block.span.start, *lone.span.start)
        behind = Span(*lone.span.end, *block.span.end)
        return self.comment_within(before) or self.comment_within(behind)

    def halves(self, line: Line) -> tuple[Line, Line]:
        """The `}` of a line, and the `else` behind it."""
        level, text, (row, column, end_row, end_column) = line
        brace = Span(row, column, row, column + 1)
        # A comment behind the brace stays there, but one behind the `else` is none of the brace's.
        near = self._rows[row - 1][column:].lstrip(" \t").startswith("else")
        rest = Span(*(brace.end if near else line.span.end), end_row, end_column)
        return Line(level, "}", brace), Line(level, text.removeprefix("} "), rest)

    # Writing.

    def add(self, line: Line) -> None:
        """A line, behind the comments that belong before it."""
        closes, follows = line.text.startswith("}"), line.text.startswith("else")
        self._comments_up_to(line.span.start, line.level + closes, tight=follows)
        for comment in self._taken(line.span.end):
            # It was inside: the empty lines before it are those before the statement.
            self._put(line.level, comment.text, line.span.line)
        self._put(line.level, line.text, line.span.line, tight=closes or follows)
        self._row = line.span.end_line
        self._opened = line.text.endswith("{")

    def finish(self) -> None:
        """The comments behind the last line."""
        self._comments_up_to(None, 0)

    def _comments_up_to(
        self, place: tuple[int, int] | None, level: int, *, tight: bool = False
    ) -> None:
        """Those before a place: behind the last line if they stood there, else on lines of their own."""
        for comment in self._taken(place):
            if comment.line == self._row:
                self.written[-1] += _BEHIND + comment.text
            else:
                self._put(level, comment.text, comment.line, tight=tight)

    def _taken(self, place: tuple[int, int] | None) -> list[Comment]:
        """The next comments before a place (None: all), which are then done with."""
        first, places = self._next, self._places
        self._next = len(places) if place is None else bisect_left(places, place, first)
        return self._comments[first : self._next]

    def _put(self, level: int, text: str, row: int, *, tight: bool = False) -> None:
        """Something that started in a line of the source, behind an empty line if there was one and it is not tight."""
        empty = bisect_right(self._empty, self._row) < bisect_left(self._empty, row)
        if empty and not tight and not self._opened:
            self.written.append("")
        self.written.append(INDENT * level + text)
        self._row, self._opened = row, False
