"""The language front end as a whole: text in, all that is wrong with it out."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right, insort
from collections.abc import Callable, Iterable, Sequence
from itertools import accumulate
from typing import Final

from attrs import evolve

from fasteroids.lang.checker import complaints
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.parser import Parsed, parse_bytes, parse_program
from fasteroids.lang.source import Span

__all__ = [
    "diagnose",
    "diagnose_bytes",
    "diagnosed",
    "line_end",
    "mended",
    "mended_throughout",
]

_LINE_END: Final = re.compile(r"\r\n?|\n")

_MOST_ROUNDS: Final = 20
"""So often a program is mended and checked again: a fix can bring to light what another fix is for."""


def diagnose(text: str) -> tuple[Diagnostic, ...]:
    """Every syntax error and every type error of a program, by place. Never raises.

    A type error in a piece that a syntax error is about is left out: it may be a mere consequence. Its fix is left out
    if it would change such a piece: there the text is not what the tree says. Fixes have the line ends of the text.
    """
    return diagnosed(parse_program(text))


def diagnose_bytes(data: bytes) -> tuple[str, tuple[Diagnostic, ...]]:
    """The text of a file of a program, and all that is wrong with it, its encoding included. Never raises."""
    parsed = parse_bytes(data)
    return parsed.tree.source, diagnosed(parsed)


def diagnosed(parsed: Parsed) -> tuple[Diagnostic, ...]:
    """What `diagnose` finds in a text, of one that was read already."""
    found = _joined(parsed.diagnostics, complaints(parsed.tree))
    end = line_end(parsed.tree.source)
    return found if end == "\n" else tuple(_ending(each, end) for each in found)


def line_end(text: str) -> str:
    """The first line end of a text, which new lines in it should have too: LF, CRLF or CR; LF if it has none."""
    first = _LINE_END.search(text)
    return first[0] if first else "\n"


def _ending(fault: Diagnostic, end: str) -> Diagnostic:
    """A fault whose fix has these line ends, not LF."""
    if not any("\n" in edit.text for edit in fault.fix):
        return fault
    return evolve(
        fault, fix=tuple(Edit(edit.span, edit.text.replace("\n", end)) for edit in fault.fix)
    )


def _joined(first: Iterable[Diagnostic], others: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Both by place, without what the others say of, or would change in, a piece that one of the first is about."""
    kept = [*first]
    told = sorted(each.span for each in kept)
    reach = [*accumulate((span.end for span in told), max)]
    for each in others:
        before = bisect_right(told, each.span.start, key=lambda span: span.start)
        if not (before and each.span.end <= reach[before - 1]):
            if any(_touched(told, reach, edit.span) for edit in each.fix):
                each = evolve(each, fix=())
            kept.append(each)
    return tuple(sorted(kept, key=lambda each: each.span))


def _touched(told: Sequence[Span], reach: Sequence[tuple[int, int]], span: Span) -> bool:
    """Does a piece share characters with one of those told, or lie inside one? They are in order of their starts."""
    before = bisect_left(told, span.end, key=lambda each: each.start)
    return before > 0 and reach[before - 1] > span.start


def mended(text: str, diagnostics: Iterable[Diagnostic]) -> str:
    """The text with the fixes of these diagnostics put in.

    Each is put in whole or not at all: not if it would change a piece that an earlier one changes. What is put in at
    one place keeps the order of the diagnostics. Places outside the text count as its end.
    """
    starts = [0, *(end.end() for end in _LINE_END.finditer(text))]

    def offset(line: int, column: int) -> int:
        return min(starts[line - 1] + column - 1, len(text)) if line <= len(starts) else len(text)

    taken: list[_Change] = []
    for each in diagnostics:
        changes = [
            (offset(*edit.span.start), offset(*edit.span.end), edit.text) for edit in each.fix
        ]
        if all(_free(taken, start, end) for start, end, _ in changes):
            for change in changes:
                insort(taken, change, key=lambda one: one[:2])
    pieces, at = [], 0
    for start, end, new in taken:
        pieces += [text[at:start], new]
        at = end
    return "".join(pieces) + text[at:]


def mended_throughout(text: str, found: Callable[[str], Iterable[Diagnostic]]) -> str:
    """The text mended again and again, with what `found` says of each, until no fix changes it any more."""
    for _ in range(_MOST_ROUNDS):
        after = mended(text, found(text))
        if after == text:
            break
        text = after
    return text


_Change = tuple[int, int, str]


def _free(taken: Sequence[_Change], start: int, end: int) -> bool:
    """Is nothing changed yet between two offsets? What was put in at either of them does not matter."""
    i = bisect_left(taken, start, key=lambda one: one[0])
    if i and taken[i - 1][1] > start:
        return False
    while i < len(taken) and taken[i][0] < end:
        if taken[i][0] > start or taken[i][1] > start:
            return False
        i += 1
    return True
