"""The one loop over time: `happenings` unfolds events, `evolve` folds them (assignment 1.6).

`happenings` yields each event with the world just after it and returns the world at the end. Whatever watches a
world, a game, a recorder, a debugger, a test, iterates over it; there are no callbacks and no second loop.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

from attrs import field, frozen

from fasteroids import models, rules
from fasteroids._raw import raw
from fasteroids.actions import Action
from fasteroids.courses import contact_ahead, wall_ahead
from fasteroids.engine import LIMIT, TICK, WALLS, Due, Engine, give, take
from fasteroids.entities import Entity, Ship, checked, id_of
from fasteroids.moments import Clock, advanced, clock_at, seconds
from fasteroids.overlap import own_bullet
from fasteroids.physics import NEVER, wall_time
from fasteroids.state import World, describe, path, replaced
from fasteroids.units import ModelError, shown

__all__ = [
    "Happened",
    "act",
    "bounce",
    "evolve",
    "evolve_until",
    "happenings",
    "storm_limit",
    "time_to_contact",
    "time_to_wall",
    "unfold",
]


@frozen(weakref_slot=False)
class Happened:
    """One physical event with all its consequences.

    `time` in s; `kind` one of contact, wall, limit, tick; `entities` the ids that took part, ascending; `wall`
    the side met (left, right, bottom, top); `effect` what came of it: bounce, press (two ships whose thrust holds
    them together, hopping), die or split; reach or leave for a limit; for a tick turn, fire, thrust, thrust_off,
    skip, end, halt or fuel. `died` and `born` are ids, a bullet that dies as it is fired among both; `clipped` those
    whose speed was scaled back to their limit; `at` the point of contact (km). A tick also carries its `prints`, the
    `span` of source it stopped at and, halted, the `reason`.
    """

    time: float
    kind: str
    entities: tuple[int, ...]
    wall: str | None = field(default=None, kw_only=True)
    effect: str = field(default="bounce", kw_only=True)
    died: tuple[int, ...] = field(default=(), kw_only=True)
    born: tuple[int, ...] = field(default=(), kw_only=True)
    clipped: tuple[int, ...] = field(default=(), kw_only=True)
    at: tuple[float, float] | None = field(default=None, kw_only=True)
    prints: tuple[str, ...] = field(default=(), kw_only=True)
    span: Any = field(default=None, kw_only=True)
    reason: str | None = field(default=None, kw_only=True)

    def __str__(self) -> str:
        """One line for people."""
        who = " and ".join(f"#{i}" for i in self.entities)
        parts = [f"t={self.time:.6g} {self.kind} {who}"]
        if self.wall:
            parts.append(f"at the {self.wall}")
        parts.append(self.effect)
        for label, ids in (("died", self.died), ("born", self.born), ("clipped", self.clipped)):
            if ids:
                parts.append(f"{label} {' '.join(f'#{i}' for i in ids)}")
        if self.reason:
            parts.append(f"because {self.reason}")
        parts += [f"prints {line}" for line in self.prints]
        return "".join(c if c.isprintable() else repr(c)[1:-1] for c in ", ".join(parts))


_happened = raw(Happened)


def happenings(
    world: World, until: float, *, max_events: int | None = None
) -> Generator[tuple[Happened, World], None, World]:
    """Unfold the events of a world up to and including `until` (absolute, s).

    Yields (event, world after it) and returns the world at `until`, or after `max_events` events if that is
    sooner. `ModelError` if `until` is nan, negative, infinite or before the world's clock, or if events pile up
    at one moment without end (see `storm_limit`).
    """
    if max_events is not None and (type(max_events) is not int or max_events < 0):
        raise ModelError(
            f"max_events must be an integer, 0 or more, or None; got {shown(max_events)}"
        )
    clock = clock_at(until)
    if clock[:2] < world.now:
        if until != world.time:
            raise ModelError(
                f"the world is at {world.time!r} s already; it cannot go back to {until!r} s"
            )
        clock = world.clock  # its time is only the double nearest to its clock
    return unfold(world, clock, max_events)


def evolve_until(world: World, time: float) -> World:
    """The world at an absolute time (s): the value that `happenings` returns."""
    return _fold(happenings(world, time))


def evolve(world: World, dt: float) -> World:
    """The world `dt` seconds later (1.6). The rounding of dt is carried, so ten steps of 0.1 s reach 1 s.

    `ModelError` if dt is nan, negative or infinite. evolve(world, 0) runs what is due now.
    """
    return _fold(unfold(world, advanced(world.clock, dt)))


def _fold(unfold: Generator[tuple[Happened, World], None, World]) -> World:
    while True:
        try:
            next(unfold)
        except StopIteration as stop:
            result: World = stop.value
            return result


def storm_limit(entities: int) -> int:
    """How many events may happen at one and the same moment among so many entities (law L14)."""
    return 10_000 + 100 * entities


def unfold(
    world: World, until: Clock, max_events: int | None = None
) -> Generator[tuple[Happened, World], None, World]:
    """What `happenings` unfolds, up to a clock: for those who step as `evolve` does, and carry the residue.

    The clock (see `fasteroids.moments.advanced`) must not be before the world's.
    """
    end, now = until[:2], world.now
    left = -1 if max_events is None else max_events
    crowd = 0
    engine = take(world)
    while left != 0:
        due = engine.next_due(end)
        if due is None:
            break
        moment = due[:2]
        if moment > now:
            now, crowd = moment, 0
        elif moment < now:  # the flights of another model, which overlooked it: it happens now
            due = (*now, *due[2:])
        crowd += 1
        if crowd > 10_000 and crowd > storm_limit(engine.living):
            raise ModelError(_storm(world, due))
        happened, world = _happen(world, engine, due)
        yield happened, world
        engine = take(world)
        left -= 1
    if left != 0:
        return _cut(world, engine, until)[0]
    give(world, engine)
    return world


def _storm(world: World, due: Due) -> str:
    names = " and ".join(describe(f.entity) for f in (due[8], due[9]) if f is not None)
    return (
        f"more than {storm_limit(len(world))} events at the moment {seconds(due[0], due[1])!r} s, the last of "
        f"{names}: they have no room to move that the clock could resolve"
    )


def _cut(world: World, engine: Engine, clock: Clock) -> tuple[World, tuple[int, ...]]:
    """The world at the end of an advance: only a thrusting ship notices (1.6). Also the ids clipped."""
    kicks, clipped = [], []
    for slot in sorted(engine.thrusters):
        f = engine.flights[slot]
        assert f is not None
        after, fast = rules.kick(f, clock[:2])
        if after is not f:
            kicks.append((slot, after))
        if fast:
            clipped.append(id_of(f.entity))
    return replaced(world, clock, kicks, (), (), cache=engine), tuple(sorted(clipped))


def _happen(world: World, engine: Engine, due: Due) -> tuple[Happened, World]:
    """One event: the kicks of its cut, what it changes, and the record of both."""
    window, offset, rank, low, high, _, slot, other, f, g = due
    moment, clock = (window, offset), (window, offset, 0.0)
    kicked: tuple[int, ...] = ()
    if engine.thrusters:
        world, kicked = _cut(world, engine, clock)
        take(world)  # no world may own the engine while an event is half done
        kicked_f, g = engine.flights[slot], g and engine.flights[other]
        assert kicked_f is not None
        f = kicked_f
    entities: tuple[int, ...] = (low,)
    side = ticked = None
    if g is not None:
        kind, entities = "contact", (low, high)
        if f.entity.id != low:
            slot, other, f, g = other, slot, g, f
        change = rules.contact(world, moment, f, g)
    elif rank == TICK:
        kind = "tick"
        world = replaced(world, clock, (), (), ())
        change, ticked = rules.tick(world, f)
    elif rank == LIMIT:
        kind, change = "limit", rules.limit(world, moment, f)
    else:
        kind, side = "wall", WALLS[rank]
        change = rules.wall(world, moment, f, side)
    effect, _, born, dead, clipped, passing, at = change
    world = _changed(world, clock, (slot, other), change, engine)
    births: tuple[int, ...] = ()
    if born or passing:
        births = tuple(sorted((*passing, *(id_of(b.entity) for b in born))))
        dead = tuple(sorted((*passing, *dead)))
    if kicked:
        clipped = tuple(sorted({*kicked, *clipped}))
    prints, span, reason = ((), None, None) if ticked is None else ticked[3:]
    happened = _happened(
        seconds(window, offset), kind, entities, side, effect, dead, births, clipped, at, prints, span, reason,
    )  # fmt: skip
    return happened, world


def _changed(
    world: World, clock: Clock, slots: tuple[int, ...], change: rules.Change, engine: Engine | None
) -> World:
    """The world after a change, whose flights belong into the first of these slots."""
    _, flights, born, dead, _, passing, _ = change
    next_id = passing[-1] + 1 if passing else 1
    return replaced(world, clock, tuple(zip(slots, flights)), born, dead, next_id, engine)  # noqa: B905


def act(world: World, ship_id: int, action: Action) -> World:
    """The world after one action of a ship, now. Players, programs and tests all act through this.

    `action` is one of Turn, Fire, Thrust, ThrustOff and Skip. `ModelError` if there is no such entity, it is
    not a ship, or the action makes no sense.
    """
    slot = world.slot_of(ship_id)
    change = rules.apply(world, world.flight_of(ship_id), action)
    return _changed(world, world.clock, (slot,), change, None)


def time_to_contact(a: Entity, b: Entity, *, model: str = models.DEFAULT) -> float:
    """Seconds from now until two entities touch (1.5.1); infinite if they never do.

    0.0 if they overlap and approach. A bullet and its own ship never meet. Both fly on as they are: straight, but
    under `smooth` along the path on which their thrusters send them, the speed limit included. No world is known, so
    there are no walls: a contact later than the first `time_to_wall` of one of the two is not what will happen, and
    a ship that leans on a wall is taken to leave through it.
    """
    level = models.named(model)
    if own_bullet(checked(a, "the first"), checked(b, "the second")):
        return NEVER
    if level.thrust == "smooth" and any(type(e) is Ship and e.thruster for e in (a, b)):
        return contact_ahead(a, b)
    return level.contact_time(a.x, a.y, a.vx, a.vy, a.radius, b.x, b.y, b.vx, b.vy, b.radius)


def time_to_wall(entity: Entity, world: World) -> tuple[float, tuple[str, ...]]:
    """Seconds from now until an entity meets a boundary of the world, and which (1.5.1).

    (infinity, ()) if it never does, two walls if it runs into a corner. It flies on as it is, whatever it may meet
    on the way: straight, but if the world's model is `smooth` along the path on which its thruster sends it, the
    speed limit included. A ship that leans on a wall slides along it and does not meet it.
    """
    e = checked(entity, "what meets a wall")
    if type(e) is Ship and path(world, e) is not None:
        return wall_ahead(e, world)
    r = e.radius
    tx = wall_time(e.x, e.vx, r, world.width - r)
    ty = wall_time(e.y, e.vy, r, world.height - r)
    t = min(tx, ty)
    if t == NEVER:
        return t, ()
    walls = (("right" if e.vx > 0.0 else "left", tx), ("top" if e.vy > 0.0 else "bottom", ty))
    return t, tuple(name for name, at in walls if at == t)


def bounce(a: Entity, b: Entity) -> tuple[Entity, Entity]:
    """Two entities in contact after their elastic bounce (1.5.2), within their speed limits.

    If they do not approach nothing changes.
    """
    return rules.bounce(checked(a, "the first"), checked(b, "the second"))
