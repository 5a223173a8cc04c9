"""A recording as tables: rows of plain values, for spreadsheets, SQL and data frames.

Ids in a list stand in one cell with blanks between them. Where a column says nothing of a row it is None. Times are
in s, lengths in km, speeds in km/s, masses in kg.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import isfinite
from typing import Final, TypeAlias, TypeVar

from attrs import field, frozen

from fasteroids.entities import Bullet, Entity, Ship
from fasteroids.history.recording import (
    Bookmark,
    Entered,
    Event,
    Print,
    Recording,
    Snapshot,
    record_of,
    time_of,
)
from fasteroids.moments import Clock, seconds

__all__ = ["TABLES", "Row", "Table"]

Cell: TypeAlias = "str | int | float | bool | None"
Row: TypeAlias = tuple[Cell, ...]


@frozen
class Table:
    """A table: what its rows are, its columns with their types in SQL, and how its rows are had."""

    what: str
    columns: Mapping[str, str]
    rows: Callable[[Recording], Iterator[Row]] = field(repr=False)


L = TypeVar("L", Event, Snapshot, Print, Entered, Bookmark)


def _lines(recording: Recording, kind: type[L]) -> Iterator[tuple[int, L]]:
    """The lines of a kind, with their numbers in the file."""
    for number, line in enumerate(recording.lines, 2):
        if isinstance(line, kind):
            yield number, line


def _ids(ids: tuple[int, ...]) -> str | None:
    return " ".join(map(str, ids)) or None


def _double(value: float) -> float | None:
    return value if isfinite(value) else None


# events


def _events(recording: Recording) -> Iterator[Row]:
    for number, line in _lines(recording, Event):
        h = line.happened
        other = h.entities[1] if len(h.entities) > 1 else None
        x, y = (None, None) if h.at is None else map(_double, h.at)
        changed = (_ids(h.died), _ids(h.born), _ids(h.clipped))
        yield (
            number, h.time, h.kind, h.effect, h.entities[0], other, h.wall, *changed, x, y,
            None if h.span is None else h.span[0], h.reason,
        )  # fmt: skip


_EVENTS: Final = {
    "line": "BIGINT", "time": "DOUBLE", "kind": "VARCHAR", "effect": "VARCHAR", "entity": "BIGINT", "other": "BIGINT",
    "wall": "VARCHAR", "died": "VARCHAR", "born": "VARCHAR", "clipped": "VARCHAR", "x": "DOUBLE", "y": "DOUBLE",
    "source_line": "BIGINT", "reason": "VARCHAR",
}  # fmt: skip


# states


def _states(recording: Recording) -> Iterator[Row]:
    """The entities of the first world, of each snapshot, and of the last world if no snapshot is as late."""
    clocks = [recording.world.clock]
    clocks += [(*line.moment, 0.0) for _, line in _lines(recording, Snapshot)]
    clocks += [recording.until] * (recording.until[:2] > clocks[-1][:2])
    for i, clock in enumerate(clocks):
        world = recording.world if i == 0 else recording.at(clock)
        yield from (_state(clock, e) for e in world.entities.values())


def _state(clock: Clock, e: Entity) -> Row:
    ship = (None,) * 4
    if isinstance(e, Ship):
        program = None if e.program is None else "running" if e.program.running else "stopped"
        ship = (e.direction, e.thrust_power, e.thruster, program)  # type: ignore[assignment]
    bullet = (e.source, e.bounced) if isinstance(e, Bullet) else (None, None)
    return (
        seconds(*clock[:2]), e.id, e.kind, e.name, e.x, e.y, e.vx, e.vy, e.radius, _double(e.mass), *ship, *bullet,
    )  # fmt: skip


_STATES: Final = {
    "time": "DOUBLE", "id": "BIGINT", "kind": "VARCHAR", "name": "VARCHAR", "x": "DOUBLE", "y": "DOUBLE",
    "vx": "DOUBLE", "vy": "DOUBLE", "radius": "DOUBLE", "mass": "DOUBLE", "direction": "DOUBLE",
    "thrust_power": "DOUBLE", "thruster": "BOOLEAN", "program": "VARCHAR", "source": "BIGINT", "bounced": "BOOLEAN",
}  # fmt: skip


# prints, inputs, bookmarks


def _prints(recording: Recording) -> Iterator[Row]:
    for number, line in _lines(recording, Print):
        yield number, time_of(line), line.ship, line.text


_PRINTS: Final = {"line": "BIGINT", "time": "DOUBLE", "ship": "BIGINT", "text": "VARCHAR"}


def _inputs(recording: Recording) -> Iterator[Row]:
    for number, line in _lines(recording, Entered):
        told = record_of(line)
        entity = told.get("ship", told.get("entity"))
        if isinstance(entity, dict):  # one that is added
            entity = next(iter(line.born), entity.get("id"))
        yield (
            number, told["time"], told["nth"], told["kind"], entity, told.get("action"), told.get("angle"),
            told.get("program"), _ids(line.died), _ids(line.born),
        )  # fmt: skip


_INPUTS: Final = {
    "line": "BIGINT", "time": "DOUBLE", "nth": "BIGINT", "kind": "VARCHAR", "entity": "BIGINT", "action": "VARCHAR",
    "angle": "DOUBLE", "program": "VARCHAR", "died": "VARCHAR", "born": "VARCHAR",
}  # fmt: skip


def _bookmarks(recording: Recording) -> Iterator[Row]:
    for number, line in _lines(recording, Bookmark):
        yield number, time_of(line), line.place.nth, line.name


_BOOKMARKS: Final = {"line": "BIGINT", "time": "DOUBLE", "nth": "BIGINT", "name": "VARCHAR"}


TABLES: Final[Mapping[str, Table]] = {
    "events": Table("what happened, a row an event", _EVENTS, _events),
    "states": Table("every entity at the start, at each snapshot and at the end", _STATES, _states),
    "prints": Table("what programs printed", _PRINTS, _prints),
    "inputs": Table("what the world outside did", _INPUTS, _inputs),
    "bookmarks": Table("names for times", _BOOKMARKS, _bookmarks),
}
"""The tables by name."""
