"""A line of history: the kept states of a past in the order of their places, and what lies between two of them.

A line grows at its end by states, each kept at first. Thinning drops states that can be lived again: what remains of
one is its input, if it was one, in the *gap* behind the kept state before it. So a gap is a piece of the past that is
not in memory, and `Gap.givens` is all that is needed to live it again.

The states stand in chunks. A *hand* goes round over the chunks; in one round it leaves at most `coarse` happenings
between two kept states, in the next twice as many. So each piece of a past is as quick to live again as any other,
a state is dropped at a price that does not grow with the line, and a line gets as short as is asked for.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise
from sys import getsizeof
from typing import Any, Final, NamedTuple

from attrs import evolve, frozen
from pyrsistent import PVector, pvector

from fasteroids.history.inputs import Cut, Given, Place
from fasteroids.history.living import Lived, Told, cuts_decide
from fasteroids.history.marks import NOTHING, Marks, joined, marked
from fasteroids.history.weights import fresh

__all__ = ["Chunk", "Gap", "Kept", "Line", "appended", "begun", "index_of", "kept", "thinned"]

_CHUNK: Final = 64
"""States in a chunk: few enough to copy at each step, enough to pass over."""


class Gap(NamedTuple):
    """What was dropped between two kept states."""

    size: int = 0
    """How many states `living.relived` gives there: one a happening, and one a cut that is kept."""
    givens: tuple[Given, ...] = ()
    marks: Marks = NOTHING
    weight: int = 0
    """Bytes."""


_CLOSED: Final = Gap()


class Kept(NamedTuple):
    """A state in memory, its price in bytes beside the one kept before it, and the gap after it."""

    state: Lived
    weight: int
    gap: Gap = _CLOSED


class Chunk(NamedTuple):
    """Kept states, and what they and their gaps are about."""

    kept: tuple[Kept, ...]
    marks: Marks


@frozen
class Line:
    """A line of history. `parent` is the line it branched off where it begins; None of a first one."""

    name: str
    parent: str | None
    chunks: PVector[Chunk]
    bytes: int
    coarse: int = 1
    hand: int = 0

    @property
    def first(self) -> Lived:
        """The state it begins with."""
        return self.chunks[0].kept[0].state

    @property
    def last(self) -> Lived:
        """The state it ends with."""
        return self.chunks[-1].kept[-1].state

    @property
    def states(self) -> int:
        """How many states are in memory."""
        return sum(len(chunk.kept) for chunk in self.chunks)


def begun(name: str, parent: str | None, first: Lived) -> Line:
    """The line that begins with a state, alone."""
    kept = Kept(first, _weight(first, None))
    return Line(name, parent, pvector([Chunk((kept,), marked(first))]), kept.weight)


def _weight(state: Lived, before: Lived | None) -> int:
    """Bytes of a kept state beside the one before it."""
    return _RECORD + fresh(state, before)


_RECORD: Final = getsizeof(Kept(None, 0)) + getsizeof((None,)) - getsizeof(()) + getsizeof(2**20)  # type: ignore[arg-type]
"""Bytes of a `Kept`, of its place in a chunk and of its weight."""


def appended(line: Line, states: Sequence[Lived]) -> Line:
    """The line with more states at its end, in order."""
    if not states:
        return line
    chunks, total = line.chunks.evolver(), line.bytes
    last, tail, marks = line.last, list(line.chunks[-1].kept), line.chunks[-1].marks
    slot = len(line.chunks) - 1
    for state in states:
        if len(tail) == _CHUNK:
            chunks[slot] = Chunk(tuple(tail), marks)
            tail, marks, slot = [], NOTHING, slot + 1
            chunks.append(None)  # type: ignore[arg-type]  # filled below
        weight = _weight(state, last)
        tail.append(Kept(state, weight))
        marks, total, last = joined(marks, marked(state)), total + weight, state
    chunks[slot] = Chunk(tuple(tail), marks)
    return evolve(line, chunks=chunks.persistent(), bytes=total)


# Where things are.


def index_of(line: Line, place: Place) -> tuple[int, int]:
    """Chunk and index of the last kept state that is not after a place not before the line's first."""
    c = bisect_right(line.chunks, place, key=lambda chunk: chunk.kept[0].state.place) - 1
    k = bisect_right(line.chunks[c].kept, place, key=lambda kept: kept.state.place) - 1
    return c, k


def kept(line: Line, start: tuple[int, int], step: int, wanted: Marks | None) -> Iterator[Kept]:
    """The kept states from one on, forwards or backwards; but for chunks without anything that is wanted."""
    c, k = start
    count = len(line.chunks)
    while 0 <= c < count:
        chunk = line.chunks[c]
        if wanted is None or chunk.marks.may_hold(wanted):
            yield from (
                chunk.kept[k:] if step > 0 else reversed(chunk.kept[: None if k < 0 else k + 1])
            )
        c += step
        k = 0 if step > 0 else -1


# Thinning.


def thinned(line: Line, excess: int) -> Line:
    """The line with so many bytes less, or as few as it can have. Its first and last state stay."""
    target, decide = line.bytes - excess, cuts_decide(line.first.world)
    chunks: Any = line.chunks.evolver()
    total, coarse, hand, left = line.bytes, line.coarse, line.hand, None
    if target < total:  # no round that would drop too little
        coarse = max(coarse, 1 << (total // max(target, 1)).bit_length() - 1)
    while total > target:
        if hand >= len(chunks):
            grouped, hand = _grouped(chunks.persistent()), 0
            chunks, states = grouped.evolver(), [kept for chunk in grouped for kept in chunk.kept]
            if len(states) <= 2 or (left == len(states) and _most(states) < coarse):
                break
            coarse, left = 2 * coarse, len(states)
        chunk = _coarser(chunks[hand], coarse, cuts=decide)
        total += _bytes(chunk) - _bytes(chunks[hand])
        chunks[hand] = chunk
        hand += 1
    return evolve(line, chunks=chunks.persistent(), bytes=total, coarse=coarse, hand=hand)


def _most(states: Sequence[Kept]) -> int:
    """The happenings of the largest two gaps that could be one."""
    return max(a.gap.size + 1 + b.gap.size for a, b in pairwise(states[:-1]))


def _bytes(chunk: Chunk) -> int:
    return sum(kept.weight + kept.gap.weight for kept in chunk.kept)


def _coarser(chunk: Chunk, coarse: int, *, cuts: bool) -> Chunk:
    """The chunk with at most so many happenings in a gap. Its first and last state stay, so that others keep."""
    old = chunk.kept
    out = [old[0]]
    for i in range(1, len(old)):
        each, last = old[i], out[-1]
        gap = _bridged(last.gap, each, cuts=cuts)
        if i < len(old) - 1 and gap.size <= coarse:
            out[-1] = last._replace(gap=gap)
            continue
        if last.state is not old[i - 1].state:
            each = each._replace(weight=_weight(each.state, last.state))
        out.append(each)
    return Chunk(tuple(map(_priced, out)), chunk.marks)


def _priced(kept: Kept) -> Kept:
    """With the price of its gap."""
    gap = kept.gap
    return (
        kept
        if gap.weight or gap is _CLOSED
        else kept._replace(gap=gap._replace(weight=fresh(gap, None)))
    )


def _bridged(gap: Gap, dropped: Kept, *, cuts: bool) -> Gap:
    """A gap, a state that is dropped after it, and the gap after that, in one."""
    (place, what, world), after = dropped.state, dropped.gap
    size, givens, marks = gap.size + after.size, gap.givens, joined(gap.marks, after.marks)
    if not isinstance(what, Cut):
        size, marks = size + 1, joined(marks, marked(dropped.state))
    elif cuts:
        size, givens = size + 1, (*givens, Given(place, what))
    if isinstance(what, Told):
        givens = (*givens, Given(place.before, what.what, world.clock[2]))
    return Gap(size, givens + after.givens, marks)


def _grouped(chunks: PVector[Chunk]) -> PVector[Chunk]:
    """The same states in fewer chunks: neighbours that fit into one. No state is looked at, so it is soon done."""
    grouped: list[Chunk] = []
    for chunk in chunks:
        if grouped and len(grouped[-1].kept) + len(chunk.kept) <= _CHUNK:
            before = grouped.pop()
            chunk = Chunk(before.kept + chunk.kept, joined(before.marks, chunk.marks))
        grouped.append(chunk)
    return pvector(grouped)
