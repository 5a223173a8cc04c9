"""The fold of an audit: one event after the other, then the findings. `fasteroids.audit` says how it works."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from math import sqrt

from attrs import evolve

from fasteroids import rules
from fasteroids.audit._balance import BOUNCE_LIMIT, drift, imbalance, kinetic_energy
from fasteroids.audit._containment import Containment
from fasteroids.audit._curves import bend, state
from fasteroids.audit._margins import Audit, Faults, Worst
from fasteroids.engine import Engine, peek
from fasteroids.entities import Bullet, Entity, Ship
from fasteroids.events import Happened, storm_limit
from fasteroids.moments import Moment, between, resolution
from fasteroids.overlap import own_bullet
from fasteroids.physics import distance
from fasteroids.state import Flight, World, located
from fasteroids.units import MAX_BULLETS

__all__ = ["Auditor"]

_ROUNDINGS = 16 * 2.0**-53


class Auditor:
    """A fold over the events of one run: `see` each (event, world after it), then `finish` with the last world.

    It keeps the flights and little else, never the worlds, and asks nothing of the engine but its counters.
    """

    def __init__(self, world: World) -> None:
        self._speed = Worst("L8", "speed, against the limit", "km/s")
        self._momentum = Worst("L9", "momentum of a bounce", "u")
        self._energy = Worst("L9", "energy of a bounce", "u")
        self._shots = Worst("L10", "bullets of a ship that fired", "bullets")
        self._own = Faults("L10", "ship met its own bullet")
        self._walls = Faults("L10", "bullet survived its second wall")
        self._dead = Faults("L10", "dead entity in the world")
        self._unnamed = Faults("L10", "entity changed by an event of others")
        self._crowd = Worst("L14", "events at one moment", "events")
        self._back = Faults("L14", "event before the one before it")
        self._events: Counter[str] = Counter()
        self._clipped = self._died = self._born = 0
        self._now, self._at_once = world.now, 0
        self._paths = Containment(world)
        self._check_speeds(world.now, (f for f in world.flights if f is not None))
        self._start_energy = kinetic_energy(world)
        self._tally = _Tally(world)

    def see(self, happened: Happened, world: World) -> None:
        """One more event, and the world just after it."""
        self._events[happened.kind] += 1
        self._clipped += len(happened.clipped)
        self._died += len(happened.died)
        self._born += len(happened.born)
        now = world.now
        self._at_once = self._at_once + 1 if now == self._now else 1
        self._crowd.see(self._at_once, storm_limit(len(world)), now, happened.entities)
        taking_part = [f for f in map(self._paths.flight, happened.entities) if f is not None]
        if happened.kind == "contact" and len(taking_part) == 2:
            self._check_contact(happened, world, *taking_part)
        elif happened.kind == "wall":
            self._check_wall(world, taking_part)
        for i in happened.died:
            if i in world:
                self._dead.fault(now, (i,))
        for i in happened.born:
            if i in world:
                self._check_birth(world, world.flight_of(i).entity)
        self._go_to(world, {*happened.entities, *happened.born, *happened.died})

    def finish(self, world: World) -> Audit:
        """The findings, given the world the run ended with (its clock may be past the last event)."""
        self._paths.finish(world.now)
        self._go_to(world, set())
        self._check_ends(world.now, (f for f in world.flights if f is not None))
        worst = (
            self._paths.overlap, self._paths.overhang, self._speed, self._momentum, self._energy, self._shots,
            self._own, self._walls, self._dead, self._unnamed, self._crowd, self._back,
        )  # fmt: skip
        return Audit(
            margins=tuple(each.margin for each in worst),
            events=dict(self._events),
            clipped=self._clipped,
            died=self._died,
            born=self._born,
            asked=self._tally.asked,
            undecided=self._tally.undecided,
            energy_drift=drift(self._start_energy, kinetic_energy(world)),
            time=world.time,
        )

    def _go_to(self, world: World, named: set[int]) -> None:
        """Another world: whose flight changed?

        Besides those the event names only thrusting ships may, and only under the thrust rule `literal` (1.6).
        """
        now = world.now
        if now < self._now:
            self._back.fault(now, sorted(named))
        self._now = now
        changed = self._paths.change(world, named)
        for f, _ in changed:
            if f is not None and f.entity.id not in named:
                e = f.entity
                if not (type(e) is Ship and e.thruster and f.path is None):
                    self._unnamed.fault(now, (e.id or 0,))
        self._check_ends(now, (f for f, _ in changed if f is not None))
        self._check_speeds(now, (g for _, g in changed if g is not None))
        self._tally.follow(world)

    def _check_speeds(self, now: Moment, flights: Iterable[Flight]) -> None:
        """L8, exact: the speed as computed is at most the limit."""
        for f in flights:
            e = f.entity
            self._speed.see(sqrt(e.vx * e.vx + e.vy * e.vy), e.max_speed, now, (e.id or 0,))

    def _check_ends(self, now: Moment, flights: Iterable[Flight]) -> None:
        """L8 where a bent flight ends: as said exactly, and along its path up to rounding.

        The speed is convex in time on a parabola and constant on a limited path, so it is highest at an end. What
        is said is scaled to the limit; a flight that went on beyond shows in the velocity before that. To it the
        moment of the end adds its resolution, and v + a t the rounding of a handful of operations: 16 u.
        """
        for f in flights:
            if f.path is None:
                continue
            self._check_speeds(now, (evolve(f, entity=located(f, now)),))
            e, age = f.entity, between(f.since, now)
            vx, vy = state(f, age)[2:]
            gained = min(bend(f) * age, 2.0 * e.max_speed)
            room = _ROUNDINGS * (distance(e.vx, e.vy) + gained) + bend(f) * resolution(now)
            self._speed.see(distance(vx, vy), e.max_speed + room, now, (e.id or 0,))

    def _check_contact(self, happened: Happened, world: World, f: Flight, g: Flight) -> None:
        """L9 for a bounce nobody was clipped in; L10 for own bullets.

        Two that press on each other keep momentum, to twice as much since they are lifted after the bounce; the work
        of the thrust over the height of a hop is theirs.
        """
        now, ids = world.now, happened.entities
        if own_bullet(f.entity, g.entity):
            self._own.fault(now, ids)
        if happened.effect in ("bounce", "press") and not any(
            i in happened.clipped or i not in world for i in ids
        ):
            after = [world.flight_of(i).entity for i in ids]
            momentum, energy = imbalance(_at_impact(f, now), _at_impact(g, now), *after)
            if happened.effect == "bounce":
                self._momentum.see(momentum, BOUNCE_LIMIT, now, ids)
                self._energy.see(energy, BOUNCE_LIMIT, now, ids)
            else:
                self._momentum.see(momentum, 2.0 * BOUNCE_LIMIT, now, ids)

    def _check_wall(self, world: World, flights: Iterable[Flight]) -> None:
        """L10: a bullet dies at its second wall."""
        for f in flights:
            e = f.entity
            if type(e) is Bullet and e.bounced and e.id in world:
                self._walls.fault(world.now, (e.id or 0,))

    def _check_birth(self, world: World, e: Entity) -> None:
        """L10: with three bullets in the world a ship fires no other. (A scene may start with more.)"""
        if type(e) is Bullet:
            entities = [f.entity for f in world.flights if f is not None]
            shots = sum(type(other) is Bullet and other.source == e.source for other in entities)
            self._shots.see(shots, MAX_BULLETS, world.now, (e.source,))


def _at_impact(f: Flight, now: Moment) -> Entity:
    """An entity with the velocity it brings into an event.

    That at the end of a bent path; under the thrust rule `literal` a thrusting ship is kicked first (1.6).
    """
    e = f.entity
    if f.path is not None:
        return located(f, now)
    return rules.kick(f, now)[0].entity if type(e) is Ship and e.thruster else e


class _Tally:
    """What the engines of a run counted in it: if one was built anew, they add up."""

    def __init__(self, world: World) -> None:
        self._engine: Engine | None = peek(world)
        self._seen = _counters(self._engine)
        self.asked = self.undecided = 0

    def follow(self, world: World) -> None:
        """Read the counters of the engine a world has, if it has one."""
        engine = peek(world)
        if engine is None:
            return
        asked, undecided = self._seen if engine is self._engine else (0, 0)
        self._engine, self._seen = engine, _counters(engine)
        self.asked += self._seen[0] - asked
        self.undecided += self._seen[1] - undecided


def _counters(engine: Engine | None) -> tuple[int, int]:
    return (0, 0) if engine is None else (engine.asked, engine.undecided)
