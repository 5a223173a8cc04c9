"""What an event means: bounce, die, split, fire, turn, thrust (assignment 1.4 to 1.7).

Pure functions from flights to a `Change`. When an event happens is not decided here (see `fasteroids.engine`),
nor how a world takes a change over (see `fasteroids.state.replaced`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from math import cos, isfinite, sin, sqrt, ulp
from typing import Literal, NamedTuple

from attrs import evolve

from fasteroids import chance, physics
from fasteroids.actions import Action, Fire, Skip, Thrust, ThrustOff, Ticked, Turn
from fasteroids.entities import Asteroid, Bullet, Entity, Ship, id_of, moving
from fasteroids.moments import Moment, between, resolution
from fasteroids.overlap import Placed, depth, outside, own_bullet, slack
from fasteroids.paths import Limited, Parabola, limit_time, reached, to_limit
from fasteroids.pressing import LEAST_HOP, Mover, lift
from fasteroids.state import Flight, World, describe, flight, located, path, placed, push
from fasteroids.units import (
    BULLET_RADIUS,
    BULLET_SPEED,
    CHILD_SPEED_FACTOR,
    MAX_BULLETS,
    SPLIT_RADIUS,
    WINDOW,
    ModelError,
    number,
    shown,
)

__all__ = [
    "Change",
    "ShipView",
    "apply",
    "bounce",
    "children",
    "contact",
    "fire",
    "fired",
    "kick",
    "limit",
    "past_limit",
    "tick",
    "wall",
]


class Change(NamedTuple):
    """What an event does: flights that replace others, births, deaths, and how to call it."""

    effect: str
    changed: tuple[Flight, ...] = ()
    born: tuple[Flight, ...] = ()
    dead: tuple[int, ...] = ()
    clipped: tuple[int, ...] = ()
    passing: tuple[int, ...] = ()
    """Ids that were born and died in the same event, so that they never entered the world."""
    at: tuple[float, float] | None = None
    """The point of contact, km."""


# Contacts.


def masses(a: Entity, b: Entity) -> tuple[float, float]:
    """The masses of two entities; in kg if one is a ship, else in a unit that keeps them from over- and underflow.

    A bounce asks for their ratio only, and two spheres of 1e-120 km have one. The unit is the larger sphere, so
    that the order of the two changes no bit.
    """
    if isinstance(a, Ship) or isinstance(b, Ship):
        return a.mass, b.mass
    if a.radius <= b.radius:
        ratio = a.radius / b.radius
        return ratio * ratio * ratio * a.density, b.density
    ratio = b.radius / a.radius
    return a.density, ratio * ratio * ratio * b.density


def bounce(a: Entity, b: Entity) -> tuple[Entity, Entity]:
    """Two entities in contact after their elastic bounce (1.5.2), within their speed limits.

    If they do not approach nothing changes.
    """
    return _bounced(a, a.x, a.y, b, b.x, b.y)[:2]


def _bounced(
    a: Entity, xa: float, ya: float, b: Entity, xb: float, yb: float
) -> tuple[Entity, Entity, bool, bool]:
    """Both entities after a bounce at these places, and whether each was clipped."""
    ma, mb = masses(a, b)
    x, y = xb - xa, yb - ya
    vxa, vya, vxb, vyb = physics.bounce(x, y, a.vx, a.vy, ma, b.vx, b.vy, mb)
    ca = cb = False
    if sqrt(vxa * vxa + vya * vya) > a.max_speed or sqrt(vxb * vxb + vyb * vyb) > b.max_speed:
        vxa, vya, vxb, vyb, ca, cb = physics.limit_contact(
            x, y, vxa, vya, a.max_speed, vxb, vyb, b.max_speed
        )
    return moving(a, xa, ya, vxa, vya), moving(b, xb, yb, vxb, vyb), ca, cb


def contact(world: World, now: Moment, f: Flight, g: Flight) -> Change:
    """Two flights touch at `now` (1.5.2): bounce, or die."""
    a, b = f.entity, g.entity
    if type(a) is type(b) and type(a) is not Bullet:
        straight = f.path is None and g.path is None
        if straight:
            s = (now[0] - f.since[0]) * WINDOW + (now[1] - f.since[1])
            t = (now[0] - g.since[0]) * WINDOW + (now[1] - g.since[1])
            xa, ya, xb, yb = a.x + a.vx * s, a.y + a.vy * s, b.x + b.vx * t, b.y + b.vy * t
        else:
            a, b = located(f, now), located(g, now)
            xa, ya, xb, yb = a.x, a.y, b.x, b.y
        a, b, ca, cb = _bounced(a, xa, ya, b, xb, yb)
        effect = "bounce"
        if not straight:
            a, b, effect, la, lb = _lifted(world, now, a, b)
            ca, cb = ca or la, cb or lb
        clipped = tuple(id_of(e) for e, c in ((a, ca), (b, cb)) if c) if ca or cb else ()
        f = flight(now, a, b.id, f.next_tick, f.path and path(world, a))
        g = flight(now, b, a.id, g.next_tick, g.path and path(world, b))
        share = a.radius / (a.radius + b.radius)
        at = xa + (xb - xa) * share, ya + (yb - ya) * share
        return Change(effect, (f, g), (), (), clipped, (), at)
    a, b = located(f, now), located(g, now)
    share = a.radius / (a.radius + b.radius)
    at = a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share
    dying = (a, b) if Bullet in (type(a), type(b)) else (a if type(a) is Ship else b,)
    return deaths(world.seed, now, world.roster.next_id, dying)._replace(at=at)


def _lifted(
    world: World, now: Moment, a: Entity, b: Entity
) -> tuple[Entity, Entity, str, bool, bool]:
    """Two ships after a bounce, parted so far that they can press on each other; "press" if they do.

    The least height of a hop is never below what rounding may leave between the two (law L7).
    """
    fine = resolution(now)
    height = max(LEAST_HOP * (a.radius + b.radius), slack(a, 0.0, fine) + slack(b, 0.0, fine))
    movers: list[Mover] = []
    for e in (a, b):
        bend = path(world, e)
        pull = (0.0, 0.0) if bend is None else bend.acceleration(e.vx, e.vy)
        movers.append(Mover(e.vx, e.vy, *pull, e.mass, e.max_speed))
    (vxa, vya, ca), (vxb, vyb, cb), pressing = lift(
        b.x - a.x, b.y - a.y, movers[0], movers[1], height
    )
    if (vxa, vya, vxb, vyb) != (a.vx, a.vy, b.vx, b.vy):
        a, b = moving(a, a.x, a.y, vxa, vya), moving(b, b.x, b.y, vxb, vyb)
    return a, b, "press" if pressing else "bounce", ca, cb


def deaths(seed: int, now: Moment, next_id: int, dying: Iterable[Entity]) -> Change:
    """Entities die at `now`; a large asteroid leaves two children, with ids from `next_id` (1.7)."""
    born: list[Flight] = []
    clipped: list[int] = []
    dead = sorted(dying, key=id_of)
    for e in dead:
        if type(e) is Asteroid and e.radius >= SPLIT_RADIUS:
            angle = chance.angle(seed, id_of(e), "split")
            for child, fast in children(angle, e, next_id + len(born)):
                born.append(flight(now, child, 0, None, None))
                clipped += [id_of(child)] * fast
    return Change(
        "split" if born else "die",
        born=tuple(born),
        dead=tuple(map(id_of, dead)),
        clipped=tuple(clipped),
    )


def children(angle: float, parent: Asteroid, first_id: int) -> list[tuple[Asteroid, bool]]:
    """The two children of an asteroid where it died, and whether each was clipped at its speed limit (1.7).

    Half its radius each, on one axis through its centre, r / 2 from it on either side, flying apart along that
    axis with 1.5 times its speed; the first goes the way of `angle` (rad).
    """
    c, s = cos(angle), sin(angle)
    half = 0.5 * parent.radius
    speed = CHILD_SPEED_FACTOR * parent.speed
    result = []
    for child_id, sign in ((first_id, 1.0), (first_id + 1, -1.0)):
        vx, vy = sign * speed * c, sign * speed * s
        child = Asteroid(
            parent.x + sign * half * c,
            parent.y + sign * half * s,
            vx,
            vy,
            half,
            max_speed=parent.max_speed,
            id=child_id,
        )
        result.append((child, (child.vx, child.vy) != (vx, vy)))
    return result


# Walls.


def wall(world: World, now: Moment, f: Flight, side: str) -> Change:
    """A flight meets a wall at `now`: the disc is set onto it and turned inwards (1.5.2).

    A bullet that has met one before dies.
    """
    e = f.entity
    age = between(f.since, now)
    x, y, vx, vy = e.x + e.vx * age, e.y + e.vy * age, e.vx, e.vy
    if f.path is not None:
        x, y, vx, vy = f.path.after(e.x, e.y, e.vx, e.vy, age, e.max_speed)
    if side == "left":
        x, vx, at = e.radius, abs(vx), (0.0, y)
    elif side == "right":
        x, vx, at = world.width - e.radius, -abs(vx), (world.width, y)
    elif side == "bottom":
        y, vy, at = e.radius, abs(vy), (x, 0.0)
    else:
        y, vy, at = world.height - e.radius, -abs(vy), (x, world.height)
    if type(e) is Bullet and e.bounced:
        return Change("die", (), (), (id_of(e),), (), (), at)
    if f.path is not None:
        ax, ay = e.acceleration  # type: ignore[union-attr]
        if side in ("left", "right"):
            vx = _settled(vx, ax, e.radius, x, now)
        else:
            vy = _settled(vy, ay, e.radius, y, now)
    e = moving(e, x, y, vx, vy, bounced=True)
    f = flight(now, e, 0, f.next_tick, f.path and path(world, e))
    return Change("bounce", (f,), (), (), (), (), at)


def _settled(v: float, a: float, radius: float, at: float, now: Moment) -> float:
    """The velocity off a wall, or 0.0 if acceleration `a` brings the ship back before anyone can tell.

    That is from a hop v^2 / (2 a) lower than the least (see `fasteroids.pressing`), or than the spacing of the
    coordinates there, `at`; or one of 2 v / a s that the clock does not resolve. At its speed limit a ship pressed
    obliquely against a wall hops ever lower, without end; the wall then bears the pressure (see `state.push`).
    """
    if v == 0.0 or a == 0.0 or (v > 0.0) == (a > 0.0):
        return v
    least = max(LEAST_HOP * radius, ulp(at))
    hop = abs(v / a)
    return v if hop * 2.0 > resolution(now) and hop * abs(v) > 2.0 * least else 0.0


# Thrust.


def kick(f: Flight, now: Moment) -> tuple[Flight, bool]:
    """A thrusting ship at a cut, by the text's rule (1.6): moved with its old velocity, then v + a dt, limited.

    Also whether it was clipped. A kick of zero length changes nothing.
    """
    dt = between(f.since, now)
    if dt == 0.0:
        return f, False
    e = located(f, now)
    assert isinstance(e, Ship)
    vx, vy, clipped = physics.thrust(e.vx, e.vy, *e.acceleration, dt, e.max_speed)
    return flight(now, moving(e, e.x, e.y, vx, vy), 0, f.next_tick, None), clipped


def limit(world: World, now: Moment, f: Flight) -> Change:
    """A ship on a bent path reaches its speed limit at `now`, or leaves it because its thrust points inwards."""
    effect = "leave" if type(f.path) is Limited else "reach"
    return Change(effect, (past_limit(f, now, partial(push, world)),))


def past_limit(f: Flight, now: Moment, pull: Callable[[Ship], tuple[float, float]]) -> Flight:
    """The flight of a ship that reaches its speed limit at `now`, or leaves it; `pull` tells its acceleration (km/s^2).

    Reaching it sets the speed to the limit, as a wall sets a coordinate. Once reached it is not left on this course.
    """
    e = f.entity
    assert isinstance(e, Ship)
    if type(f.path) is Limited:
        return flight(f.since, e, f.bounced_off, f.next_tick, Parabola(*pull(e)))
    assert type(f.path) is Parabola
    ax, ay = f.path.ax, f.path.ay
    t = limit_time(e.vx, e.vy, ax, ay, e.max_speed)
    here = located(f, now)
    vx, vy = to_limit(e.vx + ax * t, e.vy + ay * t, e.max_speed)
    e = moving(e, here.x, here.y, vx, vy)
    bend = reached(vx, vy, *pull(e), e.max_speed)  # type: ignore[arg-type]
    return flight(now, e, 0, f.next_tick, bend)


# Actions.


def apply(world: World, f: Flight, action: Action) -> Change:
    """One action at the world's clock, of the ship on flight `f` (1.2, 1.4, 1.8)."""
    ship = f.entity
    if not isinstance(ship, Ship):
        raise ModelError(f"only a ship can act, not {describe(ship)}")
    match action:
        case Turn(angle):
            if not isfinite(number(angle, "the angle of a turn")):
                raise ModelError(f"the angle of a turn must be finite; got {shown(angle)}")
            return Change("turn", (_steered(world, f, ship.turn(angle)),))
        case Fire():
            return fire(world, located(f, world.now))
        case Thrust() if not ship.thruster:
            here = located(f, world.now)
            on = evolve(ship, x=here.x, y=here.y, thruster=True)
            bend = path(world, on)
            last = f.bounced_off if bend is None or world.now == f.since else 0
            return Change("thrust", (flight(world.now, on, last, f.next_tick, bend),))
        case ThrustOff() if ship.thruster:
            return Change("thrust_off", (_steered(world, f, evolve(ship, thruster=False)),))
        case Thrust():
            return Change("thrust")
        case ThrustOff():
            return Change("thrust_off")
        case Skip():
            return Change("skip")
    raise ModelError(
        f"an action is one of Turn(angle), Fire(), Thrust(), ThrustOff() and Skip(); got {shown(action)}"
    )


def _steered(world: World, f: Flight, ship: Ship) -> Flight:
    """The flight of a ship that was turned, or its thruster switched off: a new one if its path was bent.

    Its velocity stays, so what it bounced off this moment counts as that still.
    """
    if f.path is None:
        return flight(f.since, ship, f.bounced_off, f.next_tick, None)
    here = located(f, world.now)
    ship = evolve(ship, x=here.x, y=here.y, vx=here.vx, vy=here.vy)
    last = f.bounced_off if world.now == f.since else 0
    return flight(world.now, ship, last, f.next_tick, path(world, ship))


def fire(world: World, ship: Entity) -> Change:
    """A ship fires from where it is (1.4): a bullet next to it, or two deaths if the place is taken, or nothing.

    Nothing happens with three bullets of the ship in the world, or if the bullet would be partly outside.
    """
    assert isinstance(ship, Ship)
    shots = [f for f in world.flights if f is not None and own_bullet(f.entity, ship)]
    if len(shots) >= MAX_BULLETS:
        return Change("fire")
    bullet_id = world.roster.next_id
    bullet = fired(ship, bullet_id)
    here = Placed(bullet, slack(bullet, 0.0, resolution(world.now)))
    if outside(here, world.width, world.height):
        return Change("fire")
    for other in placed(world):
        occupant = other.entity
        if not own_bullet(bullet, occupant) and (
            depth(bullet, occupant) > here.slack + other.slack
        ):
            death = deaths(world.seed, world.now, bullet_id + 1, (occupant,))
            return death._replace(effect="fire", passing=(bullet_id,))
    return Change("fire", born=(flight(world.now, bullet, 0, None, None),))


def fired(ship: Ship, bullet_id: int) -> Bullet:
    """The bullet a ship fires from where it is (1.4): next to it the way it faces, whatever the ship's velocity."""
    c, s = cos(ship.direction), sin(ship.direction)
    reach = ship.radius + BULLET_RADIUS
    return Bullet(
        ship.x + reach * c,
        ship.y + reach * s,
        BULLET_SPEED * c,
        BULLET_SPEED * s,
        BULLET_RADIUS,
        id_of(ship),
        id=bullet_id,
    )


# Ticks.


class ShipView:
    """What the program of a ship sees: the world at its clock, read-only (see `fasteroids.actions.View`)."""

    __slots__ = ("_ship", "_world")

    def __init__(self, world: World, ship: Ship) -> None:
        self._world, self._ship = world, ship

    @property
    def self_id(self) -> int:
        """The id of the ship that runs the program."""
        return id_of(self._ship)

    @property
    def direction(self) -> float:
        """Where that ship faces, rad."""
        return self._ship.direction

    @property
    def fuel(self) -> int:
        """Small steps a program may take in one tick."""
        return self._world.fuel

    def ids(self, kind: Literal["ship", "asteroid", "bullet", "any"]) -> tuple[int, ...]:
        """The ids of all entities of a kind, ascending."""
        of_kind = _KINDS[kind]
        return tuple(
            i for i, f in self._world.all_flights().items() if isinstance(f.entity, of_kind)
        )

    def entity(self, entity_id: int) -> Entity | None:
        """An entity at this moment, or None if it is dead."""
        return self._world.entities.get(entity_id)


_KINDS: dict[str, type | tuple[type, ...]] = {
    "ship": Ship,
    "asteroid": Asteroid,
    "bullet": Bullet,
    "any": (Ship, Asteroid, Bullet),
}


def tick(world: World, f: Flight) -> tuple[Change, Ticked]:
    """One run of a ship's program at the world's clock (1.6, 1.8), and what it did to the world."""
    ship = f.entity
    assert isinstance(ship, Ship)
    assert ship.program is not None
    assert f.next_tick is not None
    ticked = ship.program.tick(ShipView(world, located(f, world.now)))  # type: ignore[arg-type]
    again = f.next_tick + 1 if ticked.program.running else None
    f = flight(f.since, evolve(ship, program=ticked.program), f.bounced_off, again, f.path)
    if ticked.action is None:
        return Change(ticked.end or "skip", (f,)), ticked
    change = apply(world, f, ticked.action)
    return (change if change.changed else change._replace(changed=(f,))), ticked
