"""One line of a recording: from its text to its value, trusting nothing.

Every failure is a `RecordingError`, here still without the number of the line.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final

from fasteroids.actions import Action, Fire, Program, Skip, Thrust, ThrustOff, Turn
from fasteroids.events import Happened
from fasteroids.history.inputs import Act, Add, Cut, Given, Input, Instruct, Place, Remove
from fasteroids.history.recording.digests import named
from fasteroids.history.recording.errors import RecordingError
from fasteroids.history.recording.fields import Fields, double
from fasteroids.history.recording.lines import (
    FORMAT,
    RULES,
    Bookmark,
    Entered,
    Event,
    Hash,
    Header,
    Line,
    Print,
    Result,
    Snapshot,
)
from fasteroids.lang import Span
from fasteroids.moments import seconds
from fasteroids.scene import SceneError, entity_of, program_in
from fasteroids.units import ModelError, shown

__all__ = ["Texts", "header_of", "line_of", "reader", "told"]

Texts = dict[str, str]
"""The texts of programs by their names, as far as a file has told them. Grows."""

_ACTIONS: Final[Mapping[str, Action]] = {
    "fire": Fire(),
    "thrust": Thrust(),
    "thrust_off": ThrustOff(),
    "skip": Skip(),
}
_KINDS: Final = ("contact", "wall", "limit", "tick")
_WALLS: Final = ("left", "right", "bottom", "top")


# The header.


def header_of(record: dict[str, Any]) -> Header:
    """The header that the first line tells."""
    fields = Fields(record)
    if fields.rest.pop("type", None) != "header":
        raise RecordingError(
            'is not the header of a recording, an object of JSON with "type" "header"'
        )
    format_ = fields.whole("format", 1)
    if format_ > FORMAT:
        raise RecordingError(
            f"the recording has format {format_}, and this version reads formats up to {FORMAT}"
        )
    for version in range(format_, FORMAT):
        fields = Fields(MIGRATIONS[version](fields.rest))
    rules = fields.whole("rules", 1)
    if rules > RULES:
        raise RecordingError(
            f"the recording is of rules {rules}, and this version knows rules up to {RULES}"
        )
    programs = _texts(fields)
    return Header(
        cuts=fields.word("cuts", ("free", "recorded")),
        world=fields.object("world"),
        programs=programs,
        libm=fields.text("libm"),
        fasteroids=fields.text("fasteroids"),
        python=fields.text("python"),
        model=fields.text("model"),
        fuel=fields.whole("fuel", 1),
        seed=fields.seed(),
        every_hash=fields.number("every_hash", 2.0**-10),
        every_snapshot=fields.number("every_snapshot", 2.0**-10),
        slice=fields.number("slice", 0.0) if "slice" in fields.rest else None,
        title=fields.text("title") if "title" in fields.rest else None,
        format=FORMAT,
        rules=rules,
        extra=fields.rest,
    )


MIGRATIONS: Final[Mapping[int, Callable[[dict[str, Any]], dict[str, Any]]]] = {}
"""From each old format to the next: what makes the fields of a header, without its type and format, those of the next.

A change of other lines' fields has its place here too, when there is one: then this table grows a second column.
"""

assert set(MIGRATIONS) == set(range(1, FORMAT)), "every old format needs its migration"


def _texts(fields: Fields) -> Texts:
    """The texts of programs that a line brings, by name."""
    texts: Texts = {}
    for each in fields.list("programs", []):
        program = Fields(each, 'each of "programs"')
        name, text = program.text("sha256"), program.text("text")
        if named(text) != name:
            raise RecordingError(f"the program {shown(name)} has another text than it is named by")
        texts[name] = text
    return texts


# The other lines.


def line_of(record: dict[str, Any], texts: Texts) -> Line:
    """The value of a line but the first; programs that it brings are put into `texts`."""
    fields = Fields(record)
    kind = fields.word("type", _READERS)
    return _READERS[kind](fields, texts)


def _input(fields: Fields, texts: Texts) -> Line:
    new = _texts(fields)
    texts.update(new)
    moment, nth = fields.moment(), fields.whole("nth")
    kind = fields.word("kind", ("act", "instruct", "add", "remove", "cut"))
    what: Input
    if kind == "cut":
        what = Cut((*moment, fields.residue()))
    elif kind == "remove":
        what = Remove(fields.entity("entity"))
    elif kind == "add":
        row = fields.object("entity")
        of = row.get("kind")
        rest = {name: value for name, value in row.items() if name != "kind"}
        what = Add(
            told(lambda: entity_of(of if isinstance(of, str) else "", rest, read=reader(texts)))
        )
    elif kind == "act":
        what = Act(fields.entity("ship"), _action(fields))
    else:
        what = Instruct(fields.entity("ship"), _program(fields, texts))
    died, born = fields.entities("died"), fields.entities("born")
    return Entered(Given(Place(*moment, nth), what), died, born, new, fields.rest)


def _action(fields: Fields) -> Action:
    name = fields.word("action", ("turn", *_ACTIONS))
    return Turn(fields.number("angle")) if name == "turn" else _ACTIONS[name]


def _program(fields: Fields, texts: Texts) -> Program:
    names = ("program", "program-state")
    row: dict[str, Any] = {name: fields.rest.pop(name) for name in names if name in fields.rest}
    program: Program | None = told(lambda: program_in(row, read=reader(texts)))
    if program is None:
        raise RecordingError('"program" is missing')
    return program


def told(make: Callable[[], Any]) -> Any:
    """What a reader of scenes makes; its problems on one line."""
    try:
        return make()
    except SceneError as error:
        raise RecordingError("; ".join(str(error).split("\n"))) from None


def reader(texts: Mapping[str, str]) -> Callable[[str], str]:
    """What tells a reader of scenes the text of a program by its name."""

    def read(name: str) -> str:
        if name not in texts:
            raise ModelError(f"there is no program {shown(name)} in this recording so far")
        return texts[name]

    return read


def _event(fields: Fields, _: Texts) -> Line:
    moment = fields.moment()
    kind = fields.word("kind", _KINDS)
    entities = fields.entities("entities")
    if not 1 <= len(entities) <= 2:
        raise RecordingError('"entities" must be one id or two')
    happened = Happened(
        seconds(*moment),
        kind,
        entities,
        wall=fields.word("wall", _WALLS) if "wall" in fields.rest else None,
        effect=fields.text("effect"),
        died=fields.entities("died"),
        born=fields.entities("born"),
        clipped=fields.entities("clipped"),
        at=_at(fields),
        span=_span(fields),
        reason=fields.text("reason") if "reason" in fields.rest else None,
    )
    return Event(moment, happened, fields.rest)


def _at(fields: Fields) -> tuple[float, float] | None:
    """The point of contact, nan where it is beyond the doubles."""
    if "at" not in fields.rest:
        return None
    point = fields.list("at")
    if len(point) != 2 or not all(z is None or type(z) in (int, float) for z in point):
        raise RecordingError(f'"at" must be two numbers of km; got {shown(point)}')
    x, y = (double(z) for z in point)
    return x, y


def _span(fields: Fields) -> Span | None:
    if "span" not in fields.rest:
        return None
    span = Fields(fields.object("span"), '"span"')
    return Span(*(span.whole(name, 1) for name in Span._fields))


def _print(fields: Fields, _: Texts) -> Line:
    return Print(fields.moment(), fields.entity("ship"), fields.text("text"), fields.rest)


def _snapshot(fields: Fields, _: Texts) -> Line:
    return Snapshot(fields.moment(), fields.object("world"), fields.rest)


def _hash(fields: Fields, _: Texts) -> Line:
    return Hash(fields.moment(), fields.text("value"), fields.rest)


def _bookmark(fields: Fields, _: Texts) -> Line:
    place = Place(*fields.moment(), fields.whole("nth"))
    return Bookmark(place, fields.text("name"), fields.rest)


def _result(fields: Fields, _: Texts) -> Line:
    clock, nth = fields.clock(), fields.whole("nth")
    ended = fields.text("ended")
    events = Fields(fields.object("events"), '"events"')
    counts = {name: events.whole(name) for name in tuple(events.rest)}
    value = fields.text("hash")
    index: list[tuple[float, int]] = []
    for each in fields.list("snapshots", []):
        if not (
            isinstance(each, list)
            and len(each) == 2
            and type(each[0]) in (int, float)
            and type(each[1]) is int
            and 0 <= each[1] < 2**63
        ):
            raise RecordingError(
                f'"snapshots" must be pairs of a time and a place in the file; got {shown(each)}'
            )
        index.append((double(each[0]), each[1]))
    return Result(clock, nth, ended, counts, value, tuple(index), fields.rest)


_READERS: Final[Mapping[str, Callable[[Fields, Texts], Line]]] = {
    "input": _input,
    "event": _event,
    "print": _print,
    "snapshot": _snapshot,
    "hash": _hash,
    "bookmark": _bookmark,
    "result": _result,
}
