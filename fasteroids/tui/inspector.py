"""The pane of the selected entity: what it is, how it flies, what comes next, what happened to it, what changed it.

    entity_rows(chronicle, world, place, 3, 40, 24)

Rows that tell of a moment lead there. Nothing here goes through a past: what happened comes from the chronicle, what
is comes from the world at the cursor, and what comes next is computed from its flights.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import atan2, degrees, inf, tau
from typing import Final, NamedTuple

from fasteroids.entities import Asteroid, Bullet, Entity, Ship, id_of
from fasteroids.events import time_to_contact, time_to_wall
from fasteroids.history import Place
from fasteroids.paths import Parabola
from fasteroids.state import Flight, World
from fasteroids.tui.chronicle import Chronicle, Entry
from fasteroids.tui.rows import Piece, Row, Style, clock, filled, row
from fasteroids.tui.words import called, happened, number
from fasteroids.units import MAX_BULLETS

__all__ = ["Ahead", "ahead", "entity_rows"]


class Ahead(NamedTuple):
    """What is next for an entity if nothing but what flies now decides: seconds from now, infinite for never."""

    contact: float
    other: int | None
    """Whom it touches."""
    wall: float
    walls: tuple[str, ...]


def ahead(world: World, entity: int) -> Ahead:
    """The next contact and the next wall of an entity, as all fly now.

    A contact counts if neither of the two meets a wall before. Others may come in between, and programs and players
    may act, so it is a prediction of this moment only. `ModelError` if there is no such entity.
    """
    f, entities = world.flight_of(entity), world.entities
    me = entities[entity]
    wall, walls = time_to_wall(me, world)
    meetings = []
    for other, e in entities.items():
        if other != entity and not _parted(f, world.flight_of(other)):
            t = time_to_contact(me, e, model=world.model)
            if t <= wall and t < inf:
                meetings.append((t, other))
    for t, other in sorted(meetings):
        if t <= time_to_wall(entities[other], world)[0]:
            return Ahead(t, other, wall, walls)
    return Ahead(inf, None, wall, walls)


def _parted(f: Flight, g: Flight) -> bool:
    """Have two just bounced off each other, so that they fly apart?"""
    a, b = id_of(f.entity), id_of(g.entity)
    return f.bounced_off == b and g.bounced_off == a and f.path is None and g.path is None


# Rows.

_LABEL: Final = 10
_RESERVED: Final = 3  # rows that events have at least, if there is any room


def entity_rows(
    chronicle: Chronicle, world: World, place: Place, entity: int, width: int, height: int
) -> tuple[Row, ...]:
    """The pane of an entity at the cursor: exactly `height` rows of `width` cells.

    `chronicle` is that of the timeline, `world` the world at the cursor, `place` the last place not after it. Of an
    entity that is not there, dead or not born yet or unknown, it says so, and tells its events.
    """
    if entity in world:
        head = [_title(world, world[entity], width)]
        head += [*_fields(world, entity, width), *_flight(chronicle, world, place, entity, width)]
        head += [*_next(world, entity, width), *_changes(chronicle, world, place, entity, width)]
    else:
        head = [*_absent(chronicle, place, entity, width)]
    room = height - len(head)
    if room < _RESERVED:
        return filled(head, width, height)
    return filled([*head, *_events(chronicle, world, place, entity, width, room)], width, height)


def _title(world: World, e: Entity, width: int) -> Row:
    name = f"{e.kind} #{e.id}" + (f" {e.name}" if e.name else "")
    return row(width, (name, Style.TITLE), (f"  at {clock(world.time)} s", Style.DIM))


def _line(width: int, label: str, *pieces: Piece, place: Place | None = None) -> Row:
    return row(width, (f"{label:{_LABEL}}", Style.DIM), *pieces, place=place)


def _fields(world: World, entity: int, width: int) -> Iterator[Row]:
    e = world[entity]
    yield _line(width, "position", f"{number(e.x)}, {number(e.y)} km")
    yield _line(width, "velocity", f"{number(e.vx)}, {number(e.vy)} km/s")
    course = f"  towards {number(_bearing(e))} deg" if e.speed else ""
    yield _line(width, "speed", f"{number(e.speed)} km/s{course}")
    yield _line(width, "radius", f"{number(e.radius)} km")
    yield _line(width, "mass", f"{number(e.mass)} kg")
    if isinstance(e, Ship):
        burning = ("on", Style.WARNING) if e.thruster else ("off", Style.DIM)
        yield _line(width, "faces", f"{number(degrees(e.direction))} deg  thruster ", burning)
        fired = sum(b.source == entity for b in world.bullets)
        yield _line(width, "bullets", f"{max(MAX_BULLETS - fired, 0)} of {MAX_BULLETS} left")
    elif isinstance(e, Bullet):
        bounced = "the next wall is its end" if e.bounced else "has met no wall yet"
        yield _line(width, "fired by", f"{called(world, e.source)}  {bounced}")


def _bearing(e: Entity) -> float:
    """Where it moves, degrees in [0, 360), counter-clockwise from the right."""
    return degrees(atan2(e.vy, e.vx) % tau) % 360.0


def _flight(
    chronicle: Chronicle, world: World, place: Place, entity: int, width: int
) -> Iterator[Row]:
    f = world.flight_of(entity)
    began = chronicle.last_change(entity, "flight", place)
    since = Place(*f.since).time
    lead = None if began is None else began.place
    yield _line(width, "flight", f"since {clock(since)} s, {_path(f)}", place=lead)
    cause = "the past begins" if began is None else happened(began.what, entity, world)
    yield _line(width, "", (cause, Style.PLAIN if began is None else Style.LINK), place=lead)
    if f.bounced_off:
        yield _line(width, "", f"last bounced off {called(world, f.bounced_off)}")


def _path(f: Flight) -> str:
    if f.path is None:
        return "straight"
    return "under thrust" if isinstance(f.path, Parabola) else "at its speed limit"


def _next(world: World, entity: int, width: int) -> Iterator[Row]:
    found = ahead(world, entity)
    if found.other is None:
        yield _line(width, "next", ("no contact before a wall", Style.DIM))
    else:
        style = Style.WARNING if isinstance(world[entity], Ship) else Style.VALUE
        whom = called(world, found.other)
        yield _line(width, "next", (f"{whom} {_due(world, found.contact)}", style))
    if found.walls:
        walls = " and ".join(found.walls)
        yield _line(width, "", f"{walls} wall {_due(world, found.wall)}")
    else:
        yield _line(width, "", ("no wall", Style.DIM))


def _due(world: World, seconds: float) -> str:
    return f"in {seconds:.3f} s, at {clock(world.time + seconds)} s"


def _changes(
    chronicle: Chronicle, world: World, place: Place, entity: int, width: int
) -> Iterator[Row]:
    """When each field last changed, and by what."""
    e = world[entity]
    names = ["velocity"]
    if isinstance(e, Ship):
        names += ["direction", "thruster"]
    elif isinstance(e, Bullet):
        names += ["bounced"]
    for name in names:
        found = chronicle.last_change(entity, name, place)
        if found is None:
            yield _line(width, name, ("never changed", Style.DIM))
        else:
            text = f"{clock(found.place.time)} s: {happened(found.what, entity, world)}"
            yield _line(width, name, (text, Style.LINK), place=found.place)
    if isinstance(e, Asteroid | Ship):
        touched = chronicle.until((entity, "contact"), place, 1)
        if touched:
            text = f"{clock(touched[0].place.time)} s: {happened(touched[0].what, entity, world)}"
            yield _line(width, "contact", (text, Style.LINK), place=touched[0].place)


def _absent(chronicle: Chronicle, place: Place, entity: int, width: int) -> Iterator[Row]:
    past = chronicle.until(entity, place, 1)
    coming = chronicle.after(entity, place, 1)
    yield row(width, (f"#{entity}", Style.TITLE), (f"  at {clock(place.time)} s", Style.DIM))
    if past:
        text = f"not there any more since {clock(past[0].place.time)} s"
        yield row(width, (text, Style.BAD), place=past[0].place)
    elif coming:
        text = f"not there before {clock(coming[0].place.time)} s"
        yield row(width, (text, Style.LINK), place=coming[0].place)
    else:
        yield row(width, (f"there is no #{entity} in this past", Style.DIM))


def _events(
    chronicle: Chronicle, world: World, place: Place, entity: int, width: int, room: int
) -> Iterator[Row]:
    """The last events, where one stands, and the next ones, in at most so many rows."""
    coming = chronicle.after(entity, place, room - 1)
    past = chronicle.until(entity, place, room - 1)
    later = min(len(coming), max((room - 1) // 3, room - 1 - len(past)))
    earlier = min(len(past), room - 1 - later)
    yield from _told(past[len(past) - earlier :], world, entity, width)
    yield row(width, (f"> {clock(world.time):>9} s  here", Style.CURSOR))
    yield from _told(coming[:later], world, entity, width)


def _told(entries: Sequence[Entry], world: World, entity: int, width: int) -> Iterator[Row]:
    for place, what in entries:
        time = (f"  {clock(place.time):>9} s  ", Style.DIM)
        bad = entity in getattr(what, "died", ())
        style = Style.BAD if bad else Style.PLAIN
        yield row(width, time, (happened(what, entity, world), style), place=place)
