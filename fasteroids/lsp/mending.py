"""What an editor may change in a text: the fixes of its diagnostics, and the normal form."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Final

from attrs import frozen

from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.formatter import laid_out
from fasteroids.lang.front import line_end, mended, mended_throughout
from fasteroids.lang.source import Span
from fasteroids.lsp.reading import Reading, faults

__all__ = ["Fix", "changed", "fix_all", "fixes", "formatting", "put_in"]

_LINE: Final = re.compile(r"[^\r\n]*(?:\r\n?|\n)|[^\r\n]+")


@frozen
class Fix:
    """A change that an editor offers: what it does, and the fault that it mends."""

    title: str
    edits: tuple[Edit, ...]
    fault: Diagnostic


def put_in(text: str, edits: Iterable[Edit]) -> str:
    """A text with changes made, no two of which are to the same piece."""
    return mended(text, [Diagnostic("", "", each.span, fix=(each,)) for each in edits])


def fixes(reading: Reading, span: Span) -> Iterator[Fix]:
    """The fixes of the faults that a piece, or an empty one between two characters, touches."""
    for fault in reading.faults:
        if fault.fix and fault.span.start <= span.end and span.start <= fault.span.end:
            yield Fix(fault.hint or f"Mend: {fault.message}", fault.fix, fault)


def fix_all(reading: Reading) -> tuple[Edit, ...]:
    """Every fix, and those that they bring to light, as `fasteroids check --fix` puts them in; empty for none."""
    if not any(fault.fix for fault in reading.faults):
        return ()
    return changed(reading, mended_throughout(reading.text, faults))


def formatting(reading: Reading) -> tuple[Edit, ...]:
    """What brings a text into normal form; nothing if it is in it, or has syntax errors.

    Line ends stay what the first one is: an editor shows and saves them as it likes.
    """
    program = reading.parsed.program
    if program is None:
        return ()
    return changed(reading, laid_out(program).replace("\n", line_end(reading.text)))


def changed(reading: Reading, after: str) -> tuple[Edit, ...]:
    """What makes one text of another: at most one change, of whole lines, without those at either end that stay."""
    if after == reading.text:
        return ()
    old, new = _LINE.findall(reading.text), _LINE.findall(after)
    most = min(len(old), len(new))
    first = 0
    while first < most and old[first] == new[first]:
        first += 1
    last = 0
    while last < most - first and old[-1 - last] == new[-1 - last]:
        last += 1
    start = _start(old, first)
    end = _start(old, len(old) - last)
    return (Edit(Span(*start, *end), "".join(new[first : len(new) - last])),)


def _start(rows: list[str], index: int) -> tuple[int, int]:
    """Where a line starts, of lines with their ends; behind the last, where the text ends."""
    if index < len(rows) or not rows or rows[-1].endswith(("\r", "\n")):
        return index + 1, 1
    return index, len(rows[-1]) + 1
