"""A world written down: as a document of plain tables, and that as a text in TOML."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

from attrs import NOTHING, fields

from fasteroids import models
from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Bullet, Entity, Ship
from fasteroids.moments import START, moment_at, seconds, tick_after
from fasteroids.scene._programs import row_of
from fasteroids.scene._text import MOST_BITS, shown, written
from fasteroids.state import Flight, World, describe, path
from fasteroids.units import FUEL, ModelError

__all__ = ["Row", "document", "dump_scene", "entity_row"]

Row: TypeAlias = Callable[[Program], Mapping[str, Any]]
"""The fields of a ship that tell its program; `ModelError` if the program cannot be written."""

_ORDER: Final[Mapping[type[Entity], int]] = {Ship: 0, Asteroid: 1, Bullet: 2}
"""The order in which a reader gives ids to those that have none."""


def dump_scene(world: World) -> str:
    """A scene file of a world: `load_scene` gives back an equal one with the same future, bit for bit.

    Every entity is written as it was when its flight began, with the moment of that if it is not now. Ids are
    left out where those that `load_scene` gives are the same. `ModelError` if a ship has a program that is no text
    of the language, or if an id is too long to be written.
    """
    head, *rest = document(world).items()
    tables = [(f"[{head[0]}]", head[1]), *((f"[[{k}]]", row) for k, rows in rest for row in rows)]
    return "\n".join(
        "".join([header, "\n", *(f"{key} = {written(value)}\n" for key, value in table.items())])
        for header, table in tables
    )


def document(world: World, *, row: Row = row_of) -> dict[str, Any]:
    """The tables of a world's scene file: `world_of` gives back an equal world, also after a way through JSON.

    Dictionaries, lists, texts, whole numbers, truths and finite floats; `row` says how a ship's program is written.
    `ModelError` as `dump_scene`.
    """
    flights = sorted(world.all_flights().values(), key=lambda f: _ORDER[type(f.entity)])
    names = [f.entity.name for f in flights if f.entity.name is not None]
    usual = [f.entity.id for f in flights] == list(range(1, len(flights) + 1))
    usual = usual and world.roster.next_id == len(flights) + 1
    with_ids = not usual or len(set(names)) < len(names)
    tables: dict[str, Any] = {"world": _head(world, with_ids=with_ids)}
    for f in flights:
        tables.setdefault(f.entity.kind, []).append(_flight_row(f, world, row, with_ids=with_ids))
    return tables


def _head(world: World, *, with_ids: bool) -> dict[str, Any]:
    """The fields of [world]; those at their defaults are left out."""
    head: dict[str, Any] = {"width": world.width, "height": world.height}
    if world.seed != 0:
        head["seed"] = world.seed
    if world.model != models.DEFAULT:
        head["model"] = world.model
    if world.fuel != FUEL:
        head["fuel"] = world.fuel
    if world.clock != START:
        head["time"] = _time(*world.clock)
    if with_ids and world.roster.next_id != max(world.roster.slots, default=0) + 1:
        head["next_id"] = _whole(world.roster.next_id)
    return head


def entity_row(e: Entity, *, row: Row = row_of) -> dict[str, Any]:
    """The fields of an entity, those at their defaults left out, for `entity_of`. `ModelError` as `document`.

    Its kind is not among them. `row` says how a ship's program is written.
    """
    return {**_own(e, with_id=True), **_program(e, row)}


def _own(e: Entity, *, with_id: bool) -> dict[str, Any]:
    """The fields of an entity, but for its program."""
    told: dict[str, Any] = {}
    if e.name is not None:
        told["name"] = e.name
    if with_id and e.id is not None:
        told["id"] = _whole(e.id)
    for name, usual in _FIELDS[type(e)]:
        value = getattr(e, name)
        if value != usual:
            told[name] = value
    return told


def _program(e: Entity, row: Row) -> Mapping[str, Any]:
    """The fields that tell a ship's program."""
    if not isinstance(e, Ship) or e.program is None:
        return {}
    try:
        return row(e.program)
    except ModelError as error:
        raise ModelError(f"{describe(e)} {error}") from None


def _flight_row(f: Flight, world: World, row: Row, *, with_ids: bool) -> dict[str, Any]:
    """The fields of an entity and its flight; those at their defaults are left out."""
    e = f.entity
    told = _own(e, with_id=with_ids)
    if f.since != world.now:
        told["since"] = _time(*f.since)
    if f.bounced_off:
        told["bounced_off"] = _whole(f.bounced_off)
    if f.path != path(world, e):
        told["slowing"] = True
    told |= _program(e, row)
    if f.next_tick not in (None, tick_after(world.now)):
        told["program-tick"] = f.next_tick
    return told


_FIELDS: Final[Mapping[type[Entity], tuple[tuple[str, object], ...]]] = {
    kind: tuple(
        (a.name, None if a.default is NOTHING else a.default)
        for a in fields(kind)
        if a.name not in ("name", "id", "program")
    )
    for kind in _ORDER
}
"""The fields that a row tells by their names, with their defaults; None for those that are always there."""


def _whole(number: int) -> int:
    """An id, if a reader takes one of that length."""
    if number.bit_length() > MOST_BITS:
        raise ModelError(f"{shown(number)} is too long to be written: more than {MOST_BITS} bits")
    return number


def _time(window: int, offset: float, residue: float = 0.0) -> float | list[float]:
    """A moment or clock as a number of seconds where that is exact, else as its parts."""
    if residue != 0.0:
        return [window, offset, residue]
    time = seconds(window, offset)
    return time if moment_at(time) == (window, offset) else [window, offset]
