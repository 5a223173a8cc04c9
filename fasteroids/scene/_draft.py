"""A scene file, table by table: an empty world and what is to be put into it, or everything that is wrong.

Whether things have room beside each other is not asked here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from itertools import count
from math import inf, ulp
from typing import Any, Final, TypeGuard

from attrs import frozen

from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Bullet, Entity, Ship
from fasteroids.moments import (
    START,
    Clock,
    Moment,
    moment_at,
    seconds,
    tick_after,
    tick_moment,
)
from fasteroids.scene._field import MOST_ASTEROIDS, Field
from fasteroids.scene._programs import FIELDS, Read, program_of
from fasteroids.scene._table import (
    INTEGER,
    NUMBER,
    SWITCH,
    TEXT,
    Faults,
    Fields,
    Table,
    Type,
    are_numbers,
    check_headers,
    guarded,
    is_integer,
    is_number,
    nearest,
    tables_of,
    typed,
)
from fasteroids.scene._text import shown
from fasteroids.state import World
from fasteroids.units import SPEED_OF_LIGHT, WINDOW, ModelError

__all__ = ["Draft", "Member", "drafted", "lone", "lone_program"]

_MOMENT = Type(
    "must be a number of seconds, or [windows of 1024 s, seconds in the window]",
    lambda value: is_number(value) or are_numbers(value, 2),
)
_CLOCK = Type(
    "must be a number of seconds, or [windows of 1024 s, seconds in the window, residue in seconds]",
    lambda value: is_number(value) or are_numbers(value, 2, 3),
)
_RANGE = Type(
    "must be a number, or a range [lowest, highest]",
    lambda value: is_number(value) or are_numbers(value, 2),
)
_REFERENCE = Type(
    "must be the name of a ship in this file, or the id of a ship (an integer from 1)",
    lambda value: isinstance(value, str) or _is_id(value),
)

_WORLD: Final[Fields] = {
    "width": NUMBER,
    "height": NUMBER,
    "seed": INTEGER,
    "model": TEXT,
    "fuel": INTEGER,
    "time": _CLOCK,
    "next_id": INTEGER,
}
_DISC: Final[Fields] = {
    "name": TEXT,
    "id": INTEGER,
    "x": NUMBER,
    "y": NUMBER,
    "vx": NUMBER,
    "vy": NUMBER,
    "radius": NUMBER,
    "max_speed": NUMBER,
    "since": _MOMENT,
    "bounced_off": INTEGER,
}
_FIELD: Final[Fields] = {"count": INTEGER, "radius": _RANGE, "speed": _RANGE, "clear": NUMBER}


@frozen
class _Kind:
    """A kind of entity: its class, its fields and those that must be there.

    `valid` are the values of a valid one, to try others beside; those not required are a file's defaults.
    """

    cls: type[Entity]
    fields: Fields
    required: tuple[str, ...]
    valid: Mapping[str, Any]


_STILL = {"x": 0.0, "y": 0.0, "vx": 0.0, "vy": 0.0, "radius": 1.0}
_KINDS: Final[Mapping[str, _Kind]] = {
    "ship": _Kind(
        Ship,
        {
            **_DISC,
            "mass": NUMBER,
            "direction": NUMBER,
            "thruster": SWITCH,
            "thrust_power": NUMBER,
            "slowing": SWITCH,
            **FIELDS,
            "program-tick": INTEGER,
        },
        ("x", "y", "radius", "mass"),
        {**_STILL, "mass": 1.0, "direction": 0.0},
    ),
    "asteroid": _Kind(Asteroid, _DISC, ("x", "y", "radius"), _STILL),
    "bullet": _Kind(
        Bullet,
        {**_DISC, "source": _REFERENCE, "bounced": SWITCH},
        ("x", "y", "radius", "source"),
        {**_STILL, "source": 1},
    ),
}
"""In the order in which ids are given."""
_HEADERS = ("[world]", *(f"[[{kind}]]" for kind in _KINDS), "[[asteroid-field]]")


@frozen
class Member:
    """An entity of a scene, and the flight it is on; `since` None if that starts now.

    `slowing`: its flight began by leaving the speed limit (see `fasteroids.rules.limit`). `tick` is the k of its next
    run of a program, None for the first after the time of the world.
    """

    table: Table
    entity: Entity
    since: Moment | None
    bounced_off: int
    slowing: bool
    tick: int | None


@frozen
class Draft:
    """What a document says, each value checked by itself: an empty world, and what is to be put into it."""

    world: World
    next_id: int
    members: list[Member]
    fields: list[tuple[Table, Field]]


def drafted(document: Mapping[str, Any], faults: Faults, read: Read | None = None) -> Draft:
    """What a document says. `SceneError` with every fault of its tables, fields and values.

    `read` gives the programs that it names.
    """
    check_headers(document, _HEADERS, faults)
    clock, next_id, world = _world(document, faults)
    tables = {kind: tables_of(document, kind, faults) for kind in (*_KINDS, "asteroid-field")}
    members = _members(tables, clock, next_id, read, faults)
    scattered = [
        (table, field)
        for number, table in enumerate(tables["asteroid-field"], 1)
        if (field := _field(table, number, world, faults)) is not None
    ]
    faults.stop()
    assert world is not None  # otherwise there is a fault
    return Draft(world, next_id or 1, members, scattered)


_OF_A_FLIGHT = ("since", "bounced_off", "slowing", "program-tick")


def lone(
    kind: str, row: Mapping[str, Any], faults: Faults, read: Read | None = None
) -> Entity | None:
    """An entity that is in no world, without an id if the row has none; None if anything is wrong with it."""
    if kind not in _KINDS:
        faults.add(Table((), "", {"kind": kind}), f"must be one of {', '.join(_KINDS)}", "kind")
        return None
    table = Table((kind, 0), kind, row)
    flown = [name for name in _OF_A_FLIGHT if name in row]
    for name in flown:
        faults.add(table, "is for an entity that flies in a world", name)
    member = _member(_KINDS[kind], table, None, {}, None, read, faults)
    return None if member is None or flown else member.entity


def lone_program(
    row: Mapping[str, Any], faults: Faults, read: Read | None = None
) -> Program | None:
    """The program that the fields of a row tell; None if they tell none, or if anything is wrong with it."""
    before = len(faults)
    table = Table(("ship", 0), "program", row)
    values = typed(table, FIELDS, (), faults)
    return program_of(table, values, read, faults) if len(faults) == before else None


# [world]


def _world(
    document: Mapping[str, Any], faults: Faults
) -> tuple[Clock | None, int | None, World | None]:
    """The clock (None if wrong), the next id (None if not given), and an empty world (None if wrong)."""
    before = len(faults)
    given = document.get("world")
    table = Table(("world",), "[world]", given if isinstance(given, dict) else {})
    if not isinstance(given, dict):
        missing = "is missing; it gives the width and the height"
        faults.add(table, missing if given is None else "must be one table")
        return None, None, None
    values = typed(table, _WORLD, ("width", "height"), faults)
    clock = None if "time" in given else START
    if "time" in values:
        try:
            clock = _clock(values.pop("time"))
        except ModelError as error:
            faults.add(table, str(error), "time")
    next_id = values.pop("next_id", None)
    if next_id is not None and next_id < 1:
        faults.add(table, "must be an integer from 1, above every id in the file", "next_id")
    make = partial(World, clock=clock or START)
    world = guarded(make, {"width": 1.0, "height": 1.0}, table, values, faults)
    return clock, next_id, world if len(faults) == before else None


def _clock(value: Any) -> Clock:
    """The clock a number of seconds or an array stands for, exactly; `ModelError` says what is allowed."""
    if not isinstance(value, list):
        time = _float(value)
        if not 0.0 <= time < inf:
            raise ModelError("must be a finite number of seconds, 0 or more")
        return *moment_at(time), 0.0
    window, offset, residue = value[0], *map(_float, [*value[1:], 0.0][:2])
    if not (is_integer(window) and window >= 0):
        raise ModelError("the number of windows must be an integer from 0")
    if not 0.0 <= offset < WINDOW:
        raise ModelError(f"the seconds in the window must be at least 0 and less than {WINDOW:.0f}")
    if not abs(residue) <= ulp(WINDOW):  # what two sums of offsets can leave
        raise ModelError(f"the residue must lie between -{ulp(WINDOW)!r} and {ulp(WINDOW)!r} s")
    try:
        seconds(window, offset)
    except OverflowError:
        raise ModelError("must be a finite number of seconds, 0 or more") from None
    return window, offset, residue


def _float(value: int | float) -> float:
    try:
        return float(value)
    except OverflowError:
        return inf if value > 0 else -inf


# [[ship]], [[asteroid]], [[bullet]]


def _members(
    tables: Mapping[str, list[Table]], clock: Clock | None, next_id: int | None,
    read: Read | None, faults: Faults,
) -> list[Member]:  # fmt: skip
    """The entities of all kinds, each under its id."""
    everyone = [(_KINDS[kind], table) for kind in _KINDS for table in tables[kind]]
    ids = _ids([table for _, table in everyone], next_id, faults)
    _check_names([table for _, table in everyone], faults)
    ships: dict[str, list[int]] = {}
    for (kind, table), entity_id in zip(everyone, ids, strict=True):
        if kind.cls is Ship and isinstance(table.values.get("name"), str):
            ships.setdefault(table.values["name"], []).append(entity_id)
    members = (
        _member(kind, table, entity_id, ships, clock, read, faults)
        for (kind, table), entity_id in zip(everyone, ids, strict=True)
    )
    return [member for member in members if member is not None]


def _ids(tables: list[Table], next_id: int | None, faults: Faults) -> list[int]:
    """The ids of entities: the one given, or the next above all that are given, in order."""
    owners: dict[int, Table] = {}
    for table in tables:
        if _is_id(entity_id := table.values.get("id")):
            owner = owners.setdefault(entity_id, table)
            if owner is not table:
                faults.add(table, f"is the id of {_whose(owner, faults)} too", "id")
    highest = max(owners, default=0)
    if next_id is not None and 1 <= next_id <= highest:
        world = Table(("world",), "[world]", {"next_id": next_id})
        message = f"must be above every id in the file, and the highest is {shown(highest)}"
        faults.add(world, message, "next_id")
    fresh = count(max(next_id or 1, highest + 1, 1))
    return [i if _is_id(i := table.values.get("id")) else next(fresh) for table in tables]


def _is_id(value: Any) -> TypeGuard[int]:
    return is_integer(value) and value >= 1


def _check_names(tables: list[Table], faults: Faults) -> None:
    """Faults for names used twice. Where both entities have an id, names are labels and may be the same."""
    owners: dict[str, Table] = {}
    for table in tables:
        name = table.values.get("name")
        if isinstance(name, str):
            owner = owners.setdefault(name, table)
            if owner is not table and not ("id" in owner.values and "id" in table.values):
                whose = _whose(owner, faults)
                faults.add(table, f"is the name of {whose} too; then both need an id", "name")


def _whose(table: Table, faults: Faults) -> str:
    line = faults.line(table.path)
    return table.label if line is None else f"{table.label} on line {line}"


def _member(
    kind: _Kind, table: Table, entity_id: int | None, ships: Mapping[str, list[int]],
    clock: Clock | None, read: Read | None, faults: Faults,
) -> Member | None:  # fmt: skip
    """One entity, or None if anything is wrong with it."""
    before = len(faults)
    values = typed(table, kind.fields, kind.required, faults)
    if isinstance(values.get("source"), str):
        found = ships.get(values["source"], [])
        if len(found) == 1:
            values["source"] = found[0]
        else:
            hint = nearest(values["source"], ships)
            several = f"{len(found)} ships have this name; give an id"
            faults.add(
                table, several if found else f"there is no ship of this name{hint}", "source"
            )
            del values["source"]
    since = _since(table, values.pop("since", None), clock, faults)
    bounced_off = values.pop("bounced_off", 0)
    if bounced_off < 0:
        faults.add(table, "must be an id, or 0 for none", "bounced_off")
    slowing = values.pop("slowing", False)
    tick = _tick(table, values.pop("program-tick", None), clock, faults)
    if kind.cls is Ship:
        values["program"] = program_of(table, values, read, faults)
        if tick is not None and values["program"] is None:
            faults.add(table, "is for a ship with a program", "program-tick")
    make: Callable[..., Entity] = partial(kind.cls, id=entity_id)
    entity = guarded(make, kind.valid, table, values, faults)
    if entity is None or len(faults) > before:
        return None
    return Member(table, entity, since, bounced_off, slowing, tick)


def _since(table: Table, value: Any, clock: Clock | None, faults: Faults) -> Moment | None:
    """The moment a flight began, if the table gives one: not after the clock (None if that is not known)."""
    if value is None:
        return None
    try:
        since = _clock(value)[:2]
    except ModelError as error:
        faults.add(table, str(error), "since")
        return None
    if clock is not None and since > clock[:2]:
        faults.add(table, "must not be later than the time of the world", "since")
    return since


def _tick(table: Table, k: int | None, clock: Clock | None, faults: Faults) -> int | None:
    """The next run of a program, if the table gives one: it may be due now, and is at most the first after that."""
    if k is None or clock is None:
        return None
    last = tick_after(clock[:2])
    if not (0 <= k <= last and tick_moment(k) >= clock[:2]):
        faults.add(
            table,
            f"must be {last}, the next k whose k / 5 s come after the time of the world, or one due at that time",
            "program-tick",
        )
    return k


# [[asteroid-field]]


def _field(table: Table, number: int, world: World | None, faults: Faults) -> Field | None:
    """One field of asteroids, or None if anything is wrong with it. What does not fit into `world` is wrong."""
    before = len(faults)
    values = typed(table, _FIELD, ("count", "radius"), faults)
    for name in ("radius", "speed"):
        if name in values:
            given = values[name]
            values[name] = tuple(map(_float, given if isinstance(given, list) else (given, given)))
    amount, clear = values.get("count", 1), _float(values.get("clear", 0.0))
    low, high = values.get("radius", (1.0, 1.0))
    slow, fast = values.get("speed", (0.0, 0.0))
    if not 1 <= amount <= MOST_ASTEROIDS:
        faults.add(table, f"must lie between 1 and {MOST_ASTEROIDS}", "count")
    if not 0.0 < low <= high < inf:
        faults.add(table, "must be finite numbers of km above 0, the lowest first", "radius")
    elif (
        world is not None and "radius" in values and not 2.0 * high < min(world.width, world.height)
    ):
        faults.add(table, "is too wide: 2 r must be less than the width and the height", "radius")
    if not 0.0 <= slow <= fast <= SPEED_OF_LIGHT:
        message = f"must be numbers of km/s from 0 to {SPEED_OF_LIGHT:.0f}, the lowest first"
        faults.add(table, message, "speed")
    if not 0.0 <= clear < inf:
        faults.add(table, "must be a finite number of km, 0 or more", "clear")
    if len(faults) > before:
        return None
    return Field(number, amount, (low, high), (slow, fast), clear)
