"""Scene files: a world as a text in TOML, small enough to write by hand and to paste in a bug report.

`dump_scene` writes what decides the future, flight by flight, so `load_scene` gives back an equal world with
the same future, bit for bit. By hand all of that may be left out. docs/scenes.md describes every field.

Between a world and its text stands a *document*: its tables as dictionaries and lists, which JSON can hold too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from math import isfinite
from typing import Any, Final

from fasteroids import models
from fasteroids.actions import Program
from fasteroids.courses import LIMIT, WALLS, course
from fasteroids.engine import Engine
from fasteroids.entities import Entity, Ship, moving
from fasteroids.moments import ORIGIN, resolution, seconds, tick_after
from fasteroids.overlap import Placed, depth, own_bullet, slack
from fasteroids.paths import Limited, Parabola
from fasteroids.scene._draft import Draft, Member, drafted, lone, lone_program
from fasteroids.scene._field import MOST_TRIES, scattered
from fasteroids.scene._programs import Read as Read
from fasteroids.scene._programs import row_of as program_row
from fasteroids.scene._table import Faults, Table
from fasteroids.scene._text import Path, SceneError, parsed
from fasteroids.scene._text import Problem as Problem
from fasteroids.scene._writing import document as document
from fasteroids.scene._writing import dump_scene as dump_scene
from fasteroids.scene._writing import entity_row as entity_row
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
from fasteroids.units import ModelError

__all__ = [
    "Problem",
    "Read",
    "SceneError",
    "document",
    "dump_scene",
    "entity_of",
    "entity_row",
    "load_scene",
    "program_in",
    "program_row",
    "world_of",
]

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
    return _read(document, Faults(text), read)


def world_of(document: Mapping[str, Any], *, read: Read | None = None) -> World:
    """The world of a document, such as `document` gives: also after a way through JSON, and with the same bits.

    It is trusted as little as a text: `SceneError` as `load_scene`, without the numbers of lines.
    """
    return _read(document, Faults(""), read)


def entity_of(kind: str, row: Mapping[str, Any], *, read: Read | None = None) -> Entity:
    """The entity of a kind and a row, such as `entity_row` gives; without an id if the row has none.

    `SceneError` as `world_of`, and if the kind is none, or the row tells of a flight as a scene's may.
    """
    faults = Faults("")
    entity = lone(kind, row, faults, read)
    faults.stop()
    assert entity is not None
    return entity


def program_in(row: Mapping[str, Any], *, read: Read | None = None) -> Program | None:
    """The program that the fields of a row tell, such as `program_row` gives; None if they tell none.

    `SceneError` as `world_of`.
    """
    faults = Faults("")
    program = lone_program(row, faults, read)
    faults.stop()
    return program


def _read(document: Mapping[str, Any], faults: Faults, read: Read | None) -> World:
    """The world of a document; `SceneError` with all that is wrong with it."""
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
