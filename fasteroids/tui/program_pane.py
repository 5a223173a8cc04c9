"""The pane of a ship's program: its source with the cursor where the machine stands, variables, prints, fuel, state.

    program_rows(at_tick(timeline, 1, 12.4), 60, 30)                 in front of a step of a tick
    program_rows(machine_of(world, 1), 60, 30)                       as it waits between two ticks

It shows a value, a `Point` of `fasteroids.history` or a machine; how one comes from point to point is the business of
`fasteroids.history.stepping` and of `fasteroids.tui.breakpoints`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Final

from fasteroids.entities import Ship
from fasteroids.events import Happened
from fasteroids.history import Place, Point
from fasteroids.lang.machine import Halted, Machine, Running
from fasteroids.lang.machine import place as place_in
from fasteroids.lang.machine.traced import machine_in
from fasteroids.lang.machine.values import Seen, Value, shown
from fasteroids.lang.report import cells, legible
from fasteroids.lang.source import Span
from fasteroids.state import World
from fasteroids.tui.chronicle import Chronicle
from fasteroids.tui.rows import Piece, Row, Style, clock, filled, fitted, row
from fasteroids.tui.words import number

__all__ = ["machine_of", "print_rows", "program_rows", "state_of"]

_LINE_END: Final = re.compile(r"\r\n?|\n")
_SPARE: Final = 6  # cells kept in sight right of the cursor


def machine_of(world: World, ship: int) -> Machine | None:
    """The machine that a ship carries, as it waits; None if it is dead, no ship, or without one."""
    e = world.flight_of(ship).entity if ship in world else None
    return machine_in(e.program) if isinstance(e, Ship) else None


def state_of(position: Point | Machine) -> tuple[str, Style]:
    """What a program does there: it runs, waits for its next tick, ran out of fuel, ended, or halted and why."""
    machine = position.machine if isinstance(position, Point) else position
    if isinstance(machine, Halted):
        if machine.reason is None:
            return "ended", Style.DIM
        line = f" (line {machine.span.line})" if machine.span is not None else ""
        return f"halted: {machine.reason}{line}", Style.BAD
    if not isinstance(position, Point):
        return "waits for its next tick", Style.DIM
    if position.step == len(position.tick.steps):
        what = position.tick.state.what
        if isinstance(what, Happened) and what.effect == "fuel":
            return "out of fuel", Style.WARNING
        return "waits for its next tick", Style.DIM
    return "running", Style.GOOD


def program_rows(
    position: Point | Machine | None,
    width: int,
    height: int,
    *,
    name: str = "",
    lines: Collection[int] = (),
    conditions: Collection[str] = (),
) -> tuple[Row, ...]:
    """The pane of a program: exactly `height` rows of `width` cells, the line of the cursor always among them.

    `name` is the ship's. `lines` have breakpoints, marked `*`; `>` marks the cursor's line. `conditions` are the texts
    of breakpoints on one. None as a position: the ship has no program.
    """
    if position is None:
        return filled([row(width, ("no program", Style.DIM))], width, height)
    head = [*_head(position, name, conditions, width)]
    spare = max(height - len(head), 0)
    facts = [*_facts(position, width, spare // 2)]
    source = _source(position, width, spare - len(facts), lines)
    return filled([*head, *source, *facts], width, height)


def _head(
    position: Point | Machine, name: str, conditions: Collection[str], width: int
) -> Iterator[Row]:
    title = f"{name} program: " if name else "program: "
    yield row(width, (title, Style.TITLE), state_of(position))
    if isinstance(position, Point):
        tick = position.tick
        steps = f"{len(tick.steps)}" if tick.whole else f"more than {len(tick.steps)}"
        place = (f"tick at {clock(tick.time)} s  ", Style.LINK)
        used = f"step {position.step} of {steps}  fuel {position.step} of {tick.fuel} used"
        spent = position.step > 0.8 * tick.fuel
        yield row(width, place, (used, Style.WARNING if spent else Style.PLAIN), place=tick.place)
    for text in conditions:
        yield row(width, ("* when ", Style.DIM), text)


# Variables and prints.


def _facts(position: Point | Machine, width: int, room: int) -> Iterator[Row]:
    """Variables, those changed in this tick first if not all fit, and the last lines printed, below."""
    if room <= 0:
        return
    machine = position.machine if isinstance(position, Point) else position
    changed = _changed(position)
    prints = position.prints if isinstance(position, Point) else ()
    printed = prints[-max(room // 3, 1) :]
    yield from _variables(machine.store, changed, width, room - len(printed))
    for line in printed:
        yield row(width, ("print ", Style.DIM), line)


def _changed(position: Point | Machine) -> set[str]:
    """The variables that got another value in this tick so far."""
    if not isinstance(position, Point):
        return set()
    return {name for step in position.tick.steps[: position.step] for name in step.changed}


def print_rows(chronicle: Chronicle, at: Place, ship: int, width: int, most: int) -> Iterator[Row]:
    """What a program printed in its last ticks up to a place, `most` lines at most, each with its time; in order."""
    lines = [
        (entry.place, line)
        for entry in chronicle.until((ship, "print"), at, most)
        if isinstance(entry.what, Happened)
        for line in entry.what.prints
    ]
    for place, line in lines[max(len(lines) - most, 0) :]:
        yield row(
            width, (f"{clock(place.time)} s ", Style.LINK), ("print ", Style.DIM), line, place=place
        )


def _variables(
    store: Mapping[str, Value], changed: Collection[str], width: int, room: int
) -> Iterator[Row]:
    names = sorted(store)
    left = 0
    if len(names) > room:
        keep = sorted(names, key=lambda name: name not in changed)[: max(room - 1, 0)]
        left, names = len(names) - len(keep), sorted(keep)
    label = min(max(map(len, names), default=0), max(width // 2, 1))
    for name in names:
        sign: Piece = ("* ", Style.CHANGED) if name in changed else "  "
        style = Style.CHANGED if name in changed else Style.VALUE
        text = fitted(legible(name), label)
        yield row(width, sign, f"{text} = ", (_value(store[name]), style))
    if left and room > 0:
        yield row(width, (f"  and {left} more", Style.DIM))


def _value(value: Value) -> str:
    """As `print` shows it, and where an entity was seen."""
    if isinstance(value, Seen):
        return f"{shown(value)} at {number(value.x)}, {number(value.y)}"
    return shown(value)


# The source.


def _source(
    position: Point | Machine, width: int, room: int, breakpoints: Collection[int]
) -> Iterator[Row]:
    machine = position.machine if isinstance(position, Point) else position
    texts = _LINE_END.split(machine.code.source)
    while len(texts) > 1 and not texts[-1]:
        texts.pop()
    span = _first_line(place_in(machine), texts)
    seen = isinstance(machine, Running) or machine.span is not None
    digits = len(str(len(texts)))
    gutter = digits + 4
    top = min(max(span.line - 1 - room // 2, 0), max(len(texts) - room, 0))
    offset = _offset(texts, span, width - gutter)
    for number_ in range(top + 1, min(top + room, len(texts)) + 1):
        here = number_ == span.line and seen
        yield _line(
            texts[number_ - 1],
            f"{'*' if number_ in breakpoints else ' '}{'>' if here else ' '}{number_:{digits}}  ",
            span if here else None,
            offset,
            width,
        )


def _first_line(span: Span, texts: Sequence[str]) -> Span:
    """The part of a piece that lies in its first line, of one beyond the text the end of the last line."""
    line = min(span.line, len(texts))
    end = len(texts[line - 1]) + 1
    if line < span.line:
        return Span(line, end, line, end)
    last = min(span.end_column, end) if span.end_line == span.line else end
    return Span(line, min(span.column, end), line, max(last, span.column))


def _offset(texts: Sequence[str], span: Span, room: int) -> int:
    """How many characters are scrolled out at the left, so that the cursor is in sight."""
    text = legible(texts[span.line - 1])
    start, end = _columns(texts[span.line - 1], span)
    if cells(text[:end]) <= room:
        return 0
    return max(start - max(room // 2 - _SPARE, 0), 0)


def _columns(text: str, span: Span) -> tuple[int, int]:
    """From and up to which character of the legible line a piece of it goes."""
    start, end = (len(legible(text[: column - 1])) for column in (span.column, span.end_column))
    return start, end


def _line(text: str, gutter: str, span: Span | None, offset: int, width: int) -> Row:
    shown_ = legible(text)[offset:]
    if span is None:
        sign = (gutter, Style.WARNING if gutter[0] == "*" else Style.DIM)
        return row(width, sign, shown_)
    start, end = (max(at - offset, 0) for at in _columns(text, span))
    if start == end:  # behind the last character, where a blank can carry the cursor
        shown_, end = f"{shown_} " if end >= len(shown_) else shown_, end + 1
    middle = (shown_[start:end], Style.CURSOR)
    return row(width, (gutter, Style.CURSOR), shown_[:start], middle, shown_[end:])
