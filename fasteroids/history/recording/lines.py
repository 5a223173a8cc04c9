"""The lines of a recording as values, and as records for JSON: one of each kind, and one record a line.

    header      the first line: format, rules, versions, how time was cut, the first world, the programs' texts
    input       what the world outside did: act, instruct, add, remove, cut
    event       what happened; print: what a ship's program printed in the tick that the next event line tells
    snapshot    a whole world, now and then
    hash        a fingerprint of a world, more often
    bookmark    a name for a place
    result      the last line, if the recording came to its end

What a record says beyond the fields known here is kept in `extra`, and written again.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final, TypeAlias

from attrs import field, frozen

from fasteroids.actions import Turn
from fasteroids.events import Happened
from fasteroids.history.inputs import Act, Add, Cut, Given, Instruct, Place, Remove
from fasteroids.history.recording.digests import named
from fasteroids.history.recording.events import action_name, event_record, when
from fasteroids.lang import Machine
from fasteroids.moments import Clock, Moment, seconds
from fasteroids.scene import entity_row, program_row
from fasteroids.state import World

__all__ = [
    "FORMAT",
    "RULES",
    "Bookmark",
    "Entered",
    "Event",
    "Extra",
    "Hash",
    "Header",
    "Line",
    "Print",
    "Result",
    "Snapshot",
    "program_by_name",
    "record_of",
]

FORMAT: Final = 1
"""The version of the lines' fields. One more where a reader of the last version would misread a file."""

RULES: Final = 1
"""The version of the rules of the game. One more where a world of the last version has another future."""

Extra: TypeAlias = Mapping[str, Any]

_NOTHING: Final[Extra] = MappingProxyType({})


@frozen
class Header:
    """What a recording is of. `slice` is how often (s) its run was cut, None if it was not, or not regularly.

    `cuts` is "recorded" where cuts decide something, under literal thrust: each is an input line then. Else it is
    "free". `every_hash` and `every_snapshot` are game seconds. `programs` are texts by their names (`named`), and
    `world` is the document of the first world, in which ships name their programs.
    """

    cuts: str
    world: Mapping[str, Any]
    programs: Mapping[str, str]
    libm: str
    fasteroids: str
    python: str
    model: str
    fuel: int
    seed: int
    every_hash: float
    every_snapshot: float
    slice: float | None = None
    title: str | None = None
    format: int = FORMAT
    rules: int = RULES
    extra: Extra = field(default=_NOTHING)


@frozen
class Entered:
    """An input at its place, what came of it at once, and the texts of programs that are new with it, by name."""

    given: Given
    died: tuple[int, ...] = ()
    born: tuple[int, ...] = ()
    programs: Mapping[str, str] = field(default=_NOTHING)
    extra: Extra = field(default=_NOTHING)

    @property
    def moment(self) -> Moment:
        """When it came."""
        return self.given.place.moment


@frozen
class Event:
    """What happened, without its prints."""

    moment: Moment
    happened: Happened
    extra: Extra = field(default=_NOTHING)


@frozen
class Print:
    """A line that a ship's program printed in a tick; the event of that tick follows."""

    moment: Moment
    ship: int
    text: str
    extra: Extra = field(default=_NOTHING)


@frozen
class Snapshot:
    """The document of the world at a time; ships name their programs."""

    moment: Moment
    world: Mapping[str, Any]
    extra: Extra = field(default=_NOTHING)


@frozen
class Hash:
    """The `digest` of the world at a time."""

    moment: Moment
    value: str
    extra: Extra = field(default=_NOTHING)


@frozen
class Bookmark:
    """A name for a place."""

    place: Place
    name: str
    extra: Extra = field(default=_NOTHING)

    @property
    def moment(self) -> Moment:
        """When it is."""
        return self.place.moment


@frozen
class Result:
    """How a recording ended: where time had come to, why (`ended`, a word), how many events of each kind there were.

    `nth` is that of its place: a recording may end between two events of one moment. `hash` is the digest of the last
    world; `snapshots` tells the time (s) of each snapshot and at which byte of the plain text its line begins.
    """

    clock: Clock
    nth: int
    ended: str
    events: Mapping[str, int]
    hash: str
    snapshots: tuple[tuple[float, int], ...] = ()
    extra: Extra = field(default=_NOTHING)

    @property
    def moment(self) -> Moment:
        """When it ended."""
        return self.clock[:2]

    @property
    def place(self) -> Place:
        """Where it ended."""
        return Place(*self.moment, self.nth)


Line: TypeAlias = Entered | Event | Print | Snapshot | Hash | Bookmark | Result


def record_of(line: Header | Line) -> dict[str, Any]:
    """The record of a line: its type first, then when it is."""
    match line:
        case Header():
            told = _header(line)
        case Entered():
            told = {"type": "input", **_placed(line.given.place), **_input(line)}
        case Event(moment, happened):
            told = {"type": "event", **when(moment)}
            told |= {k: v for k, v in event_record(happened).items() if k not in ("time", "prints")}
        case Print(moment, ship, text):
            told = {"type": "print", **when(moment), "ship": ship, "text": text}
        case Snapshot(moment, world):
            told = {"type": "snapshot", **when(moment), "world": world}
        case Hash(moment, value):
            told = {"type": "hash", **when(moment), "value": value}
        case Bookmark(place, name):
            told = {"type": "bookmark", **_placed(place), "name": name}
        case Result():
            told = _result(line)
    return told | dict(line.extra)


def _texts(programs: Mapping[str, str]) -> list[dict[str, str]]:
    return [{"sha256": name, "text": text} for name, text in programs.items()]


def _header(h: Header) -> dict[str, Any]:
    told: dict[str, Any] = {
        "type": "header",
        "format": h.format,
        "rules": h.rules,
        "fasteroids": h.fasteroids,
        "python": h.python,
        "libm": h.libm,
        "model": h.model,
        "fuel": h.fuel,
        "seed": h.seed,
        "cuts": h.cuts,
    }
    if h.slice is not None:
        told["slice"] = h.slice
    if h.title is not None:
        told["title"] = h.title
    told |= {"every_hash": h.every_hash, "every_snapshot": h.every_snapshot}
    return told | {"programs": _texts(h.programs), "world": h.world}


def _placed(place: Place) -> dict[str, Any]:
    """The fields that tell a place."""
    return {**when(place.moment), "nth": place.nth}


def _input(line: Entered) -> dict[str, Any]:
    """The fields that tell an input and what came of it."""
    told: dict[str, Any]
    match line.given.what:
        case Act(ship, action):
            told = {"kind": "act", "ship": ship, "action": action_name(action)}
            if isinstance(action, Turn):
                told["angle"] = action.angle
        case Instruct(ship, program):
            told = {"kind": "instruct", "ship": ship, **program_by_name(program)}
        case Add(entity):
            row = entity_row(entity, row=program_by_name)
            told = {"kind": "add", "entity": {"kind": entity.kind, **row}}
        case Remove(entity_id):
            told = {"kind": "remove", "entity": entity_id}
        case Cut(clock):
            told = {"kind": "cut"}
            if clock[2] != 0.0:
                told["residue"] = clock[2]
    for name, ids in (("died", line.died), ("born", line.born)):
        if ids:
            told[name] = ids
    if line.programs:
        told["programs"] = _texts(line.programs)
    return told


def program_by_name(program: object) -> dict[str, Any]:
    """The fields that tell a program, its text by name. `ModelError` if it is none of the language."""
    row: dict[str, Any] = program_row(program)  # type: ignore[arg-type]
    return {"program": named(row.pop("program-text")), **row}


def _result(line: Result) -> dict[str, Any]:
    told: dict[str, Any] = {"type": "result", **_placed(line.place)}
    if line.clock[2] != 0.0:
        told["residue"] = line.clock[2]
    return told | {
        "ended": line.ended,
        "events": dict(line.events),
        "hash": line.hash,
        "snapshots": [list(each) for each in line.snapshots],
    }


def texts_in(world: World) -> dict[str, str]:
    """The texts of the programs in a world, by name."""
    texts = (e.program.code.source for e in world.ships if isinstance(e.program, Machine))
    return {named(text): text for text in texts}


def time_of(line: Line) -> float:
    """The time (s) of a line: the double nearest to its moment."""
    return seconds(*line.moment)
