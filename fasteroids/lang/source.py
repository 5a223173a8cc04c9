"""Places in a program's text."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["NOWHERE", "Span"]


class Span(NamedTuple):
    """A piece of source text: from its first character to just behind its last. Lines and columns count from 1.

    A column counts characters (code points), not cells of a terminal; a tab is one. An empty piece, between two
    characters, has its end at its start.
    """

    line: int
    column: int
    end_line: int
    end_column: int

    @property
    def start(self) -> tuple[int, int]:
        """Line and column of the first character."""
        return self.line, self.column

    @property
    def end(self) -> tuple[int, int]:
        """Line and column just behind the last character."""
        return self.end_line, self.end_column

    def to(self, last: Span) -> Span:
        """From the start of this piece to the end of a later one."""
        return Span(self.line, self.column, last.end_line, last.end_column)

    def after(self) -> Span:
        """The empty piece just behind this one."""
        return Span(self.end_line, self.end_column, self.end_line, self.end_column)


NOWHERE = Span(1, 1, 1, 1)
"""The place of what was never text: a tree that was built, not read."""
