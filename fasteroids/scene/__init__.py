"""Scene files: a world as a text in TOML, small enough to write by hand and to paste in a bug report.

`dump_scene` writes what decides the future, flight by flight, so `load_scene` gives back an equal world with
the same future, bit for bit. By hand all of that may be left out. docs/scenes.md describes every field.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from math import isfinite
from typing import Final

from attrs import NOTHING, fields

from fasteroids import models
from fasteroids.courses import LIMIT, WALLS, course
from fasteroids.engine import Engine
from fasteroids.entities import Asteroid, Bullet, Entity, Ship, moving
from fasteroids.moments import ORIGIN, START, moment_at, resolution, seconds, tick_after
from fasteroids.overlap import Placed, depth, own_bullet, slack
from fasteroids.paths import Limited, Parabola
from fasteroids.scene._draft import Draft, Member, drafted
from fasteroids.scene._field import MOST_TRIES, Field, scattered
from fasteroids.scene._programs import Read, row_of
from fasteroids.scene._table import Faults, Table
from fasteroids.scene._text import Path, Problem, SceneError, parsed, written
from fasteroids.state import (
    Flight,
    World,
    check_room,
    describe,
    flight,
    located,
    path,
    push,
    replaced,
)
from fasteroids.units import FUEL, ModelError

__all__ = ["Field", "Problem", "SceneError", "dump_scene", "load_scene", "scattered"]

_MOST_OVERLAPS = 100
"""Overlaps reported of one file: n entities in one place have n (n - 1) / 2."""

_UNPROMISING: Final = frozenset({"spec"})
"""Models under which entities may pass through one another, so that a true world of theirs can overlap."""


def load_scene(
    text: str, *, seed: int | None = None, model: str | None = None, read: Read | None = None
) -> World:
    """The world a scene file describes; a `seed` or `model` given here takes the place of the file's.

    `read` is asked for the bytes of each program that the file names, and raises `ModelError` if there is none.

    `SceneError` lists everything that is wrong with the text, in one of four stages, each of which needs the
    one before: syntax; tables, fields and values; room (outside, too wide, overlaps); past (a flight that
    should have ended before the time of the world).
    """
    document = parsed(text)
    chosen = {"seed": seed, "model": model}
    if isinstance(document.get("world"), dict):
        document["world"] |= {name: value for name, value in chosen.items() if value is not None}
    faults = Faults(text)
    draft = drafted(document, faults, read)
    flights = [_flight(member, draft.world, faults) for member in draft.members]
    world = replaced(draft.world, draft.world.clock, (), flights, (), draft.next_id)
    here = [Placed(e, _margin(e, world)) for e in (located(f, world.now) for f in flights)]
    _check_room(draft, here, faults)
    faults.stop()
    _check_past(draft, world, faults)
    faults.stop()
    return _with_fields(draft, world, [p.entity for p in here], faults)


def _flight(member: Member, world: World, faults: Faults) -> Flight:
    """The flight of an entity; a fault if it is said to be `slowing` under `smooth` and does not leave its limit."""
    since = world.now if member.since is None else member.since
    e = member.entity
    tick = None
    if isinstance(e, Ship) and e.program is not None and e.program.running:
        tick = tick_after(world.now) if member.tick is None else member.tick
    f = flight(since, e, member.bounced_off, tick, path(world, e))
    if not member.slowing or models.named(world.model).thrust != "smooth":
        return f
    if isinstance(f.path, Limited) and course(f, world.width, world.height).rank == LIMIT:
        assert isinstance(e, Ship)
        return flight(since, e, member.bounced_off, tick, Parabola(*push(world, e)))
    faults.add(
        member.table,
        "is for a ship at its speed limit whose thruster is on and points against its velocity",
        "slowing",
    )
    return f


# Room and past.


def _margin(e: Entity, world: World) -> float:
    """How far (km) rounding may have put an entity, by whatever flights it came here.

    The margin of `overlap.slack` is that of one flight. Where a flight began the rounding of those before is
    left, which flew at `max_speed` at the most, no farther than the clock allows, and inside the world.
    """
    fine = resolution(world.now)
    reach = e.max_speed * world.time
    far = moving(e, min(reach, world.width), 0.0, 0.0, 0.0)
    high = moving(e, 0.0, min(reach, world.height), 0.0, 0.0)
    return slack(e, 0.0, fine, e.max_speed) + slack(far, 0.0, fine) + slack(high, 0.0, fine)


def _check_room(draft: Draft, here: Sequence[Placed], faults: Faults) -> None:
    """Faults for every entity that does not fit into the world, and for every two that overlap."""
    world, tables, finite = draft.world, {}, []
    for member, p in zip(draft.members, here, strict=True):
        e = p.entity
        if not (isfinite(e.x) and isfinite(e.y)):
            faults.add(member.table, "flies out of the world before its time", "since")
            continue
        finite.append(p)
        tables[e.id] = member.table
        try:
            check_room(world, [p])
        except ModelError as error:
            faults.add(member.table, str(error).removeprefix(f"{describe(e)} "))
    if world.model in _UNPROMISING and world.now > ORIGIN:
        return
    pairs = list(islice(_overlaps(finite), _MOST_OVERLAPS + 1))
    for a, b in pairs[:_MOST_OVERLAPS]:
        first, second = sorted(
            (tables[a.id], tables[b.id]), key=lambda table: _place(table, faults)
        )
        faults.add(
            second,
            f"overlaps {first.label} by {depth(a, b)!r} km; "
            f"their centres must be at least {a.radius + b.radius!r} km apart",
        )
    if len(pairs) > _MOST_OVERLAPS:
        faults.add(Table((), "", {}), f"more than {_MOST_OVERLAPS} pairs overlap; some are listed")


def _place(table: Table, faults: Faults) -> tuple[int, Path]:
    """Where a table stands among the others."""
    return faults.line(table.path) or 0, table.path


def _overlaps(here: Iterable[Placed]) -> Iterator[tuple[Entity, Entity]]:
    """Every two that overlap by more than their margins, but for a bullet and its ship: a sweep from the left."""
    spans = sorted(
        (
            p.entity.x - p.entity.radius - p.slack,
            p.entity.x + p.entity.radius + p.slack,
            p.entity.id or 0,
            p,
        )
        for p in here
    )
    active: list[tuple[float, Placed]] = []
    for left, right, _, p in spans:
        active = [(end, q) for end, q in active if end > left]
        for _, q in active:
            a, b = q.entity, p.entity
            if (
                abs(b.y - a.y) < a.radius + b.radius
                and depth(a, b) > p.slack + q.slack
                and not own_bullet(a, b)
            ):
                yield a, b
        active.append((right, p))


def _check_past(draft: Draft, world: World, faults: Faults) -> None:
    """Faults for flights that something should have ended before the time of the world.

    Nothing happens on a flight between its start and the clock but its own path, straight or bent. So such a
    file left an event out, and time would run backwards.
    """
    if all(member.since in (None, world.now) for member in draft.members):
        return
    members = {member.entity.id: member for member in draft.members}
    engine = Engine(world)
    seen = set()
    while (due := engine.next_due(world.now)) is not None and due[:2] < world.now:
        rank, low, high = due[2:5]
        if (rank, low, high) in seen:  # both of a pair may know it
            continue
        seen.add((rank, low, high))
        if rank == LIMIT:
            met = f"{'leaves' if isinstance(due[8].path, Limited) else 'reaches'} its speed limit"
        else:
            met = (
                f"meets {f'the {WALLS[rank]} wall' if rank in WALLS else members[high].table.label}"
            )
        faults.add(
            members[low].table,
            f"its flight {met} at {seconds(*due[:2])!r} s, before the time of the world; "
            "a flight begins after the last event",
            "since",
        )


def _with_fields(draft: Draft, world: World, listed: Sequence[Entity], faults: Faults) -> World:
    """The world with the asteroids of its fields."""
    if not draft.fields:
        return world
    wanted = [field for _, field in draft.fields]
    found = scattered(world.seed, world.width, world.height, wanted, listed)
    for (table, field), asteroids in zip(draft.fields, found, strict=True):
        if len(asteroids) < field.count:
            faults.add(
                table,
                f"there is no room for more than {len(asteroids)}: "
                f"the next one found no place in {MOST_TRIES} tries",
                "count",
            )
    faults.stop()
    return world.add_all(asteroid for asteroids in found for asteroid in asteroids)


# Writing.


def dump_scene(world: World) -> str:
    """A scene file of a world: `load_scene` gives back an equal one with the same future, bit for bit.

    Every entity is written as it was when its flight began, with the moment of that if it is not now. Ids are
    left out where those that `load_scene` gives are the same. `ModelError` if a ship has a program that is no text
    of the language, or if an id is too long to be written.
    """
    flights = sorted(world.all_flights().values(), key=lambda f: _ORDER[type(f.entity)])
    names = [f.entity.name for f in flights if f.entity.name is not None]
    usual = [f.entity.id for f in flights] == list(range(1, len(flights) + 1))
    usual = usual and world.roster.next_id == len(flights) + 1
    with_ids = not usual or len(set(names)) < len(names)
    tables = [("[world]", _head(world, with_ids=with_ids))]
    tables += [(_HEADERS[type(f.entity)], _row(f, world, with_ids=with_ids)) for f in flights]
    return "\n".join(
        "".join([header, "\n", *(f"{key} = {written(value)}\n" for key, value in table.items())])
        for header, table in tables
    )


_HEADERS: Final[Mapping[type[Entity], str]] = {
    Ship: "[[ship]]",
    Asteroid: "[[asteroid]]",
    Bullet: "[[bullet]]",
}
_ORDER: Final = {kind: i for i, kind in enumerate(_HEADERS)}


def _head(world: World, *, with_ids: bool) -> dict[str, object]:
    """The fields of [world]; those at their defaults are left out."""
    head: dict[str, object] = {"width": world.width, "height": world.height}
    if world.seed != 0:
        head["seed"] = world.seed
    if world.model != models.DEFAULT:
        head["model"] = world.model
    if world.fuel != FUEL:
        head["fuel"] = world.fuel
    if world.clock != START:
        head["time"] = _time(*world.clock)
    if with_ids and world.roster.next_id != max(world.roster.slots, default=0) + 1:
        head["next_id"] = world.roster.next_id
    return head


def _row(f: Flight, world: World, *, with_ids: bool) -> dict[str, object]:
    """The fields of an entity and its flight; those at their defaults are left out."""
    e = f.entity
    row: dict[str, object] = {}
    if e.name is not None:
        row["name"] = e.name
    if with_ids:
        row["id"] = e.id
    for a in fields(type(e)):
        value = getattr(e, a.name)
        if a.name not in ("name", "id", "program") and (a.default is NOTHING or value != a.default):
            row[a.name] = value
    if f.since != world.now:
        row["since"] = _time(*f.since)
    if f.bounced_off:
        row["bounced_off"] = f.bounced_off
    if f.path != path(world, e):
        row["slowing"] = True
    if isinstance(e, Ship) and e.program is not None:
        try:
            row |= row_of(e.program)
        except ModelError as error:
            raise ModelError(f"{describe(e)} {error}") from None
        if f.next_tick not in (None, tick_after(world.now)):
            row["program-tick"] = f.next_tick
    return row


def _time(window: int, offset: float, residue: float = 0.0) -> float | list[float]:
    """A moment or clock as a number of seconds where that is exact, else as its parts."""
    if residue != 0.0:
        return [window, offset, residue]
    time = seconds(window, offset)
    return time if moment_at(time) == (window, offset) else [window, offset]
