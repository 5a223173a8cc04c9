"""The fixes of the syntax errors of a text, so that each can be put in, alone or with the others."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterable

from attrs import evolve

from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.parser.lexer import lines

__all__ = ["in_order"]

Place = tuple[int, int]


def in_order(faults: Iterable[Diagnostic], text: str) -> tuple[Diagnostic, ...]:
    """The faults by place. Of two fixes that would change the same piece the first in the text stays.

    A fix makes no one word of two: it gets a blank where it would, as in `turn+1` without its `+`.
    """
    rows = lines(text) if any(fault.fix for fault in faults) else []
    taken: list[tuple[Place, Place]] = []
    kept = []
    for fault in sorted(faults, key=lambda fault: fault.span):
        pieces = [(edit.span.start, edit.span.end) for edit in fault.fix]
        if not all(_free(taken, *piece) for piece in pieces):
            fault = evolve(fault, fix=())
        elif pieces:
            for piece in pieces:
                insort(taken, piece)
            fault = evolve(fault, fix=tuple(_parted(edit, rows) for edit in fault.fix))
        kept.append(fault)
    return tuple(kept)


def _free(taken: list[tuple[Place, Place]], start: Place, end: Place) -> bool:
    """Is a piece beside all those taken, which are in order and beside each other?"""
    i = bisect_left(taken, (start, start))
    return (i == 0 or taken[i - 1][1] <= start) and (i == len(taken) or end <= taken[i][0])


def _parted(edit: Edit, rows: list[str]) -> Edit:
    """An edit with a blank at either end where it would make a new word with what stands there."""
    span, new = edit.span, edit.text
    first, last = rows[span.line - 1], rows[span.end_line - 1]
    before, after = first[: span.column - 1][-1:], last[span.end_column - 1 :][:1]
    if not new:
        return Edit(span, " ") if _one_word(before, after) else edit
    old = "" if span.start == span.end else first[span.column - 1 :][:1]
    left = " " if _one_word(before, new[0]) and not _one_word(before, old) else ""
    old = "" if span.start == span.end else last[: span.end_column - 1][-1:]
    right = " " if _one_word(new[-1], after) and not _one_word(old, after) else ""
    return Edit(span, f"{left}{new}{right}") if left or right else edit


def _one_word(left: str, right: str) -> bool:
    """Would two characters that touch be of one word? Either may be absent, and empty."""
    return all(each.isalnum() or each == "_" for each in (left, right))
