"""When a value of an entity last changed, and from what to what: asked again and again it leads to a cause.

What an entity is, is on record where a flight of it begins; in between it moves as its flight says. So a field
changes where it got another value on record:

-   most fields (`direction`, `thruster`, `bounced`, ...) where a flight has another value than the one before;
-   `vx`, `vy`, `velocity`, `speed` likewise: at a bounce, or where a thruster bends the flight anew;
-   `x`, `y`, `position` change all the time. What counts is where another flight begins, which decides them;
-   `flight` where another motion begins: another velocity, another bend, or the same from another moment on;
-   `path`, how a thruster bends the flight; `program`, the machine, which every tick changes;
-   `program.NAME`, a variable of the ship's program, at the tick that left another value in it. One that holds an
    entity changes when it holds another entity; that it is seen anew at each tick is no change.

To be born and to die are changes too, of every field, from or to `ABSENT`.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from enum import Enum
from typing import Final

from attrs import frozen

from fasteroids.entities import Ship
from fasteroids.history.living import Lived, Told, What, cuts_decide
from fasteroids.history.marks import about, who
from fasteroids.history.questions import At, before_all_at, known
from fasteroids.history.timeline import Timeline
from fasteroids.lang.machine.traced import machine_in
from fasteroids.lang.machine.values import Seen, exact
from fasteroids.state import Flight, World
from fasteroids.units import ModelError, shown

__all__ = ["ABSENT", "FIELDS", "Absent", "Changed", "last_change", "motion", "told", "value_of"]


class Absent(Enum):
    """What stands for the value of a field that an entity does not have, or of an entity that is not there."""

    ABSENT = "absent"

    def __repr__(self) -> str:
        return "absent"


ABSENT: Final = Absent.ABSENT
"""The one value of `Absent`."""

_MOVING: Final = ("x", "y", "position")
_ON_FLIGHT: Final = ("flight", "path", "bounced_off", "next_tick")
_VARIABLE: Final = "program."

FIELDS: Final = (
    *_MOVING, "vx", "vy", "velocity", "speed", "radius", "mass", "direction", "thruster", "acceleration", "program",
    "name", "max_speed", "thrust_power", "source", "bounced", *_ON_FLIGHT,
)  # fmt: skip
"""The fields that can be asked for, but for the variables of programs."""


@frozen
class Changed:
    """A field of an entity got another value."""

    entity: int
    field: str
    old: object
    new: object
    state: Lived
    """The state since which it has the new value; its `what` is what changed it."""

    def __str__(self) -> str:
        """One line for people."""
        old, new = shown(self.old), shown(self.new)
        when = f"at {self.state.place.time!r} s: {told(self.state.what)}"
        return f"#{self.entity} {self.field} from {old} to {new} {when}"


def told(what: What) -> str:
    """What led to a state, on one line for people."""
    if what is None:
        return "the past begins"
    if isinstance(what, Told):
        ids = [
            f", {label} {' '.join(f'#{i}' for i in some)}"
            for label, some in (("died", what.died), ("born", what.born))
            if some
        ]
        return f"input {what.what}{''.join(ids)}"
    return str(what)


def last_change(
    timeline: Timeline, entity: int, field: str, *, before: At | None = None
) -> Changed | None:
    """The last time before a place or time that a field of an entity changed, as the module says; None if it did not.

    Without `before` the whole line is searched. Asked again `before=changed.state.place` it tells the change before
    that; the last change up to and with a place is the one `before=place.after(place.moment)`. `ModelError` if there
    is no such field, or never was an entity with such an id.
    """
    if field not in FIELDS and not (field.startswith(_VARIABLE) and len(field) > len(_VARIABLE)):
        raise ModelError(
            f"a field is one of {', '.join(FIELDS)} or program.NAME; got {shown(field)}"
        )
    later: Lived | None = None
    for state in _deciding(timeline, known(timeline, entity), before):
        if later is not None and _key(state.world, entity, field) != _key(
            later.world, entity, field
        ):
            old, new = (value_of(s.world, entity, field) for s in (state, later))
            return Changed(entity, field, old, new, later)
        later = state
    return None


def _deciding(timeline: Timeline, entity: int, before: At | None) -> Iterator[Lived]:
    """The states that may have changed an entity, the last one first, and the first of all."""
    last = timeline.last.place
    place = last.after(last.moment) if before is None else before_all_at(before)
    kicks = cuts_decide(
        timeline.world
    )  # then whatever happens, and each cut, changes each ship that thrusts
    for state in timeline.backwards(place, None if kicks else about(entity)):
        if state.place < place and (entity in who(state) or kicks):
            yield state
    if timeline.first.place < place:
        yield timeline.first


def value_of(world: World, entity: int, field: str) -> object:
    """What is on record for a field of an entity in a world: where its flight began. `ABSENT` if it has none."""
    if entity not in world:
        return ABSENT
    f = world.flight_of(entity)
    if field == "flight":
        return f
    if field in _ON_FLIGHT:
        return getattr(f, field)
    if field.startswith(_VARIABLE):
        machine = machine_in(f.entity.program) if isinstance(f.entity, Ship) else None
        return ABSENT if machine is None else machine.store.get(field[len(_VARIABLE) :], ABSENT)
    return getattr(f.entity, field, ABSENT)


def _key(world: World, entity: int, field: str) -> Hashable:
    """What differs if the field changed."""
    value = value_of(world, entity, field)
    if value is ABSENT:
        return ABSENT
    f = world.flight_of(entity)
    if field == "flight":
        return motion(f)
    if field in _MOVING:
        return f.since, value
    if isinstance(value, Seen):
        return "entity", value.id
    if field.startswith(_VARIABLE):
        return exact(value)  # type: ignore[arg-type]  # what a store holds
    return value


def motion(f: Flight) -> tuple[Hashable, ...]:
    """What of a flight decides where the entity is from its beginning on."""
    e = f.entity
    return f.since, e.x, e.y, e.vx, e.vy, f.path
