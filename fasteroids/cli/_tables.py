"""A recording as tables: rows of plain values, for spreadsheets, SQL and data frames.

Ids in a list stand in one cell with blanks between them. Where a column says nothing of a row it is None. Times are
in s, lengths in km, speeds in km/s, masses in kg.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import isfinite
from typing import Final, TypeAlias, TypeVar

from attrs import field, frozen

from fasteroids.cli._fold import stops
from fasteroids.cli._guard import Refusal
from fasteroids.entities import Bullet, Entity, Ship
from fasteroids.history.living import Lived, beginning, reached
from fasteroids.history.recording import (
    Bookmark,
    Entered,
    Event,
    Print,
    Recording,
    record_of,
    time_of,
)
from fasteroids.moments import clock_at
from fasteroids.state import World

__all__ = ["TABLES", "Columns", "Row", "Tables", "worlds"]

Cell: TypeAlias = "str | int | float | bool | None"
Row: TypeAlias = tuple[Cell, ...]


_MOST_LOOKS: Final = 2**20

Columns: TypeAlias = Mapping[str, str]
"""The names of columns, each with its type in SQL."""

L = TypeVar("L", Event, Print, Entered, Bookmark)


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


def worlds(recording: Recording, every: float) -> Iterator[World]:
    """The first world, those at the multiples of so many seconds, each after all that happened then, and the last.

    The recording is lived again. Under literal thrust each look is a cut, but of what is shown alone.
    """
    yield recording.world
    start, past = recording.world.now, recording.past()
    times = stops(recording.world.time, recording.time, every)
    looks = (clock_at(time)[:2] for time, sampled in times if sampled)
    inside = (look for look in looks if start < look < recording.until[:2])
    look, last = next(inside, None), beginning(recording.world)
    while True:
        try:
            state = next(past)
        except StopIteration as stop:
            ended: Lived = stop.value
            break
        while look is not None and look < state.place.moment:
            yield reached(last, look).world
            look = next(inside, None)
        last = state
    for each in () if look is None else (look, *inside):
        yield reached(last, each).world
    if ended.world.now > start:
        yield ended.world


def _states(recording: Recording, every: float) -> Iterator[Row]:
    for world in worlds(recording, every):
        yield from (_state(world.time, e) for e in world.entities.values())


def _state(time: float, e: Entity) -> Row:
    ship = (None,) * 4
    if isinstance(e, Ship):
        program = None if e.program is None else "running" if e.program.running else "stopped"
        ship = (e.direction, e.thrust_power, e.thruster, program)  # type: ignore[assignment]
    bullet = (e.source, e.bounced) if isinstance(e, Bullet) else (None, None)
    return (
        time, e.id, e.kind, e.name, e.x, e.y, e.vx, e.vy, e.radius, _double(e.mass), *ship, *bullet,
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


TABLES: Final[Mapping[str, Columns]] = {
    "events": _EVENTS,
    "states": _STATES,
    "prints": _PRINTS,
    "inputs": _INPUTS,
    "bookmarks": _BOOKMARKS,
}
"""The tables by name: what happened; every entity now and then; what programs printed; what the world outside did;
names for times."""

_ROWS: Final[Mapping[str, Callable[[Recording], Iterator[Row]]]] = {
    "events": _events,
    "prints": _prints,
    "inputs": _inputs,
    "bookmarks": _bookmarks,
}


@frozen
class Tables:
    """The tables of a recording. `title` is what to call it, `every` how often (s) `states` looks.

    `Refusal` if that is too often.
    """

    recording: Recording = field(repr=False)
    title: str
    every: float = 1.0

    def __attrs_post_init__(self) -> None:
        looks = (self.recording.time - self.recording.world.time) / self.every
        if not looks <= _MOST_LOOKS:
            raise Refusal(f"every {self.every!r} s is too often: {_MOST_LOOKS:,} looks are allowed")

    def rows(self, name: str) -> Iterator[Row]:
        """The rows of a table."""
        if name == "states":
            return _states(self.recording, self.every)
        return _ROWS[name](self.recording)
