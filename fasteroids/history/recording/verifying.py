"""Does a recording still happen? Its past is lived again, recorded again, and compared line by line."""

from __future__ import annotations

import json
from collections.abc import Generator, Iterator, Mapping
from heapq import merge
from itertools import zip_longest
from math import floor, inf
from typing import Any, Final, TypeAlias

from attrs import evolve, frozen

from fasteroids.history.inputs import Cut, Given, Place
from fasteroids.history.living import beginning
from fasteroids.history.recording.digests import libm
from fasteroids.history.recording.events import line as text_of
from fasteroids.history.recording.lines import (
    Bookmark,
    Entered,
    Event,
    Hash,
    Line,
    Print,
    Result,
    Snapshot,
    record_of,
    time_of,
)
from fasteroids.history.recording.reading import Recording
from fasteroids.history.recording.writing import Recorder
from fasteroids.moments import clock_at
from fasteroids.units import ModelError, shown

__all__ = ["Difference", "Verified", "differing", "parting", "verified", "verifying"]

_MOST_SLICES: Final = 2**24

Record: TypeAlias = dict[str, Any]


@frozen
class Difference:
    """The first place where two tell different things; None for what does not apply, or is not there.

    `line` is the number of the line in the first of them, from 1; `time` is in s.
    """

    line: int
    time: float
    entity: int | None
    field: str
    recorded: Any
    found: Any

    def __str__(self) -> str:
        """A sentence for people."""
        who = "" if self.entity is None else f", #{self.entity}"
        return (
            f"line {self.line}, at {self.time!r} s{who}: {self.field} is recorded as "
            f"{_told(self.recorded)}, and is {_told(self.found)}"
        )


def _told(value: Any) -> str:
    return "nothing" if value is None else shown(value)


@frozen
class Verified:
    """What came of living a recording again.

    `difference` is the first one, None if there is none. `until` (s) and `lines` tell how far was compared; `short`
    where the file was cut. `same_libm` is False if sin and cos give other numbers here than where it was made, which
    alone can make it differ.
    """

    difference: Difference | None
    until: float
    lines: int
    short: str | None
    same_libm: bool


def verified(recording: Recording, *, slice: float | None = None) -> Verified:
    """Live a recording again, and compare all that it tells of it.

    `slice` cuts time at each multiple of so many seconds, which changes nothing where cuts are free. `ModelError`
    where they are recorded, or if it is no time above 0 or gives more than 2^24 cuts.
    """
    steps = verifying(recording, slice=slice)
    while True:
        try:
            next(steps)
        except StopIteration as stop:
            result: Verified = stop.value
            return result


def verifying(
    recording: Recording, *, slice: float | None = None
) -> Generator[float, None, Verified]:
    """As `verified`, step by step: the time (s) of each line that was compared, then what came of all."""
    givens = iter(recording.givens) if slice is None else _sliced(recording, slice)
    again = _again(recording, givens)
    until, compared, difference = recording.world.time, 1, None
    for number, line in enumerate(recording.lines, 2):
        if not isinstance(line, Bookmark):
            difference = _difference(number, line, again)
            if difference is not None:
                break
            until = time_of(line)
            yield until
        compared += 1
    return Verified(difference, until, compared, recording.short, recording.header.libm == libm())


def _difference(number: int, line: Line, again: Iterator[str]) -> Difference | None:
    """What the next line made again tells differently, if it does."""
    recorded = _text(line)
    try:
        found = next(again, None)
    except ModelError as error:
        record = _record(recorded)
        return Difference(number, time_of(line), _entity(record), "the line", record, str(error))
    return _first(number, time_of(line), recorded, found)


def _again(recording: Recording, givens: Iterator[Given]) -> Iterator[str]:
    """The lines after the header, made again, without bookmarks."""
    made: list[str] = []
    recorder = Recorder(made.append, recording.world, recording.header)
    recorder.flush()
    made.clear()
    for state in recording.lived(beginning(recording.world), givens, recording.until):
        recorder.add(state)
        recorder.flush()
        for text in made:
            yield from text.splitlines()
        made.clear()
    # A recording that was cut short may end with a hash, which is written when time goes on.
    recorder.finish(recording.until, "" if recording.result is None else recording.result.ended)
    for text in made:
        yield from text.splitlines()


def _text(line: Line) -> str:
    """A line as it would be written now, without what is not known here."""
    return text_of(record_of(evolve(line, extra={}) if line.extra else line))


def _record(text: str) -> Record:
    """A record as it is compared: without what depends on the lines before it, their lengths and texts they told."""
    record = json.loads(text)
    return {name: value for name, value in record.items() if name not in ("programs", "snapshots")}


def _sliced(recording: Recording, slice: float) -> Iterator[Given]:
    """The inputs, and a cut at each multiple of so many seconds."""
    start, end = recording.world.time, recording.time
    if recording.header.cuts == "recorded":
        raise ModelError(
            f"a recording under the model {recording.header.model!r} holds its cuts, and cannot be cut otherwise"
        )
    if not 0.0 < slice < inf or not end / slice <= _MOST_SLICES:
        raise ModelError(
            f"a slice must be a time above 0 s, and fit at most {_MOST_SLICES} times into {end!r} s; got {shown(slice)}"
        )
    times = (k * slice for k in range(floor(start / slice) + 1, floor(end / slice) + 1))
    clocks = (clock for clock in map(clock_at, times) if recording.world.now < clock[:2])
    cuts = (Given(Place(*clock[:2]), Cut(clock)) for clock in clocks)
    return merge(recording.givens, cuts, key=lambda given: given.place[:2])


# Comparing.


def differing(a: Recording, b: Recording) -> Difference | None:
    """The first difference between two recordings of what is told in both; None if there is none.

    Their bookmarks, titles and versions are no part of it. If one goes on where the other ends, that is one, unless
    the other was cut short there.
    """
    if (difference := _worlds(1, a.world.time, a.header.world, b.header.world)) is not None:
        return difference
    return _parted(a, b, (Entered, Event, Print, Snapshot, Hash, Result))


def parting(a: Recording, b: Recording) -> Difference | None:
    """The first difference in what happened or was done: however the two began, and whatever programs were flown.

    Where it lies, two games that began differently part for those who watch. Else as `differing`.
    """
    return _parted(a, b, (Entered, Event, Print))


def _parted(a: Recording, b: Recording, kinds: tuple[type[Line], ...]) -> Difference | None:
    """The first difference of their lines of some kinds."""
    for each, other in zip_longest(_numbered(a, kinds), _numbered(b, kinds)):
        if each is None or other is None:
            if (a if each is None else b).short is not None:
                return None
            number, line = each or other
            told = _record(_text(line))
            pair = (told, None) if other is None else (None, told)
            return Difference(number, time_of(line), _entity(told), "the line", *pair)
        number, line = each
        difference = _first(number, time_of(line), _text(line), _text(other[1]))
        if difference is not None:
            return difference
    return None


def _numbered(recording: Recording, kinds: tuple[type[Line], ...]) -> Iterator[tuple[int, Line]]:
    """The lines of some kinds after the header, with their numbers."""
    for number, line in enumerate(recording.lines, 2):
        if isinstance(line, kinds):
            yield number, line


def _first(number: int, time: float, text: str, other: str | None) -> Difference | None:
    """The first field in which the records of two lines differ; None for a line that is not there."""
    if text == other:
        return None
    recorded, found = _record(text), None if other is None else _record(other)
    if recorded == found:
        return None
    entity = _entity(recorded)
    if found is None or recorded["type"] != found["type"]:
        return Difference(number, time, entity, "the line", recorded, found)
    if recorded["type"] == "snapshot" and recorded["time"] == found["time"]:
        difference = _worlds(number, time, recorded["world"], found["world"])
        if difference is not None:
            return difference
    field = next(n for n in (*recorded, *found) if recorded.get(n) != found.get(n))
    return Difference(number, time, entity, field, recorded.get(field), found.get(field))


def _entity(record: Record) -> int | None:
    """The entity that a record is about first."""
    for name in ("entities", "ship", "entity"):
        about = record.get(name)
        if isinstance(about, list) and about:
            about = about[0]
        if isinstance(about, int):
            return about
    return None


def _worlds(
    number: int, time: float, recorded: Mapping[str, Any], found: Mapping[str, Any]
) -> Difference | None:
    """The first difference between two documents of worlds: of the world, then of the entities in the order of ids."""
    head, other = recorded.get("world", {}), found.get("world", {})
    for name in dict.fromkeys((*head, *other)):
        if head.get(name) != other.get(name):
            return Difference(number, time, None, name, head.get(name), other.get(name))
    rows, others = _by_id(recorded), _by_id(found)
    for entity in sorted({*rows, *others}):
        row, beside = rows.get(entity), others.get(entity)
        if row == beside:
            continue
        if row is None or beside is None:
            return Difference(number, time, entity, "the entity", row, beside)
        name = next(n for n in (*row, *beside) if row.get(n) != beside.get(n))
        return Difference(number, time, entity, name, row.get(name), beside.get(name))
    return None


def _by_id(document: Mapping[str, Any]) -> dict[int, Record]:
    """The rows of a document's entities by id, each with its kind."""
    rows = [
        {"kind": kind, **row}
        for kind in ("ship", "asteroid", "bullet")
        for row in document.get(kind, [])
    ]
    return {row.get("id", number): row for number, row in enumerate(rows, 1)}
