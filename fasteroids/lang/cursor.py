"""A machine as people read it: its text with a cursor at what comes next, and its frames, one a line."""

from __future__ import annotations

import re

from fasteroids.lang.machine import Each, Frame, Machine, Running, place
from fasteroids.lang.values import shown

__all__ = ["cursor", "frames"]


def cursor(machine: Machine, *, around: int = 1) -> str:
    """The lines of the text at the place of a machine, with `around` lines before and after, and a mark below:

        5 |   turn d;
        6 |   d := d + 0.1;
          |        ^
        7 |   fire;

    The mark is as long as the piece that comes next; of a piece of several lines it marks the first.
    """
    span = place(machine)
    lines = re.split(r"\r\n?|\n", machine.code.source)
    here = min(span.line, len(lines))
    shown_lines = range(max(1, here - around), min(len(lines), here + around) + 1)
    width = len(str(shown_lines[-1]))
    rows = []
    for number in shown_lines:
        text = lines[number - 1]
        rows.append(f"{number:>{width}} | {text}".rstrip())
        if number == here:
            start = min(span.column, len(text) + 1) - 1
            end = span.end_column - 1 if span.end_line == span.line else len(text)
            # Tabs stay tabs, so that the mark stands below its piece however wide they are.
            gap = "".join(c if c == "\t" else " " for c in text[:start])
            rows.append(f"{'':>{width}} | {gap}{'^' * max(1, min(end, len(text)) - start)}")
    return "\n".join(rows)


def frames(machine: Machine) -> tuple[str, ...]:
    """What is left to do, innermost first: the line, the place in numbers, and what waits there."""
    return tuple(_frame(machine, f) for f in machine.todo) if isinstance(machine, Running) else ()


def _frame(machine: Running, f: Frame | Each) -> str:
    instruction = machine.code.blocks[f.block][f.index]
    text = f"line {instruction.span.line}, block {f.block}, instruction {f.index}"
    if isinstance(f, Each):
        return f"{text}: to visit {', '.join(map(shown, f.rest)) or 'nobody'}"
    if not f.done:
        return text
    waiting = ", ".join(map(shown, f.operands))
    return f"{text}: {f.done} of {len(instruction.nodes)} nodes done, operands {waiting or 'none'}"
