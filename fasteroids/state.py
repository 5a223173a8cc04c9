"""The world: an immutable value made of flights and a clock (assignment 1.1).

A *flight* is an entity in free flight since a moment; the entity's fields are its state at that moment. The
clock never re-stamps a flight: a new one starts only when the path changes. Where something is, is computed
when somebody asks, so advancing time with no event touches the clock and nothing else, and past worlds can be
kept for the price of what changed.

A world keeps its flights in a persistent vector by slot. Slots and the cache of predictions (`_box`) are
nobody's business: they take no part in equality, hash, repr, copies and pickles.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeVar

from attrs import evolve, field, frozen
from pyrsistent import PMap, PVector, pmap, pvector

from fasteroids import models
from fasteroids._raw import raw
from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Bullet, Entity, Ship, checked, id_of, moving
from fasteroids.moments import (
    START,
    Clock,
    Moment,
    between,
    resolution,
    seconds,
    tick_after,
)
from fasteroids.overlap import Placed, depth, first_overlap, grace, outside, slack
from fasteroids.paths import Path, path_of
from fasteroids.units import FUEL, MAX_FUEL, MAX_WORLD_SIZE, ModelError, number, shown

__all__ = ["Cache", "Flight", "Roster", "World", "instructed", "located", "path", "push"]

E = TypeVar("E", Ship, Asteroid, Bullet)


@frozen(weakref_slot=False)
class Flight:
    """An entity in free flight since a moment; whatever decides its future is in here.

    `bounced_off` is the id of the entity it bounced off last, 0 if none: two that name each other are not
    asked for a contact again until one of them changes its velocity. `next_tick` is the k of the next run of
    a ship's program, at k / 5 s; None without a running program. `path` says how a thruster bends the flight
    under the thrust rule `smooth`; None is a straight line.
    """

    since: Moment
    entity: Entity
    bounced_off: int = 0
    next_tick: int | None = None
    path: Path | None = None


flight = raw(Flight)
"""`Flight` for the hot path: all fields by position, unchecked."""


def located(f: Flight, now: Moment) -> Entity:
    """The flight's entity at a moment not before its start: moved along its path."""
    e = f.entity
    age = between(f.since, now)
    if age == 0.0:
        return e
    if f.path is not None:
        return moving(e, *f.path.after(e.x, e.y, e.vx, e.vy, age, e.max_speed))
    return moving(e, e.x + e.vx * age, e.y + e.vy * age, e.vx, e.vy)


class Roster(NamedTuple):
    """Who sits where: changes only at births and deaths."""

    slots: PMap[int, int]
    """Entity id -> slot."""
    free: tuple[Any, ...]
    """Free slots as a linked list: () or (slot, rest)."""
    next_id: int
    """The id of the next entity; ids are never reused."""


class Cache(Protocol):
    """What a world asks of the cache of predictions it may carry (see `fasteroids.engine`)."""

    def replace(
        self,
        clock: Clock,
        changed: Sequence[tuple[int, Flight]],
        born: Sequence[tuple[int, Flight]],
        dead: Sequence[int],
    ) -> None:
        """Take over the flights of a new world: (slot, flight) of the changed and born, slots of the dead."""


class Entities(Mapping[int, Entity]):
    """Entities by id, in id order, moved to a world's clock when asked for."""

    __slots__ = ("_world",)

    def __init__(self, world: World) -> None:
        self._world = world

    def __getitem__(self, entity_id: int) -> Entity:
        world = self._world
        return located(world.flights[world.roster.slots[entity_id]], world.now)  # type: ignore[arg-type]

    def __iter__(self) -> Iterator[int]:
        return iter(sorted(self._world.roster.slots))

    def __len__(self) -> int:
        return len(self._world.roster.slots)

    def __repr__(self) -> str:
        return repr(dict(self))


def _size(instance: World, attribute: Any, value: float) -> None:
    size = number(value, attribute.name)
    if not 0.0 <= size <= MAX_WORLD_SIZE:
        raise ModelError(
            f"{attribute.name} must be a number of km from 0 to {MAX_WORLD_SIZE!r}; got {shown(value)}"
        )
    object.__setattr__(instance, attribute.name, size)


def _seed(_world: World, _attribute: Any, value: int) -> None:
    if type(value) is not int or value.bit_length() > _SEED_BITS:
        raise ModelError(f"seed must be an integer; got {shown(value)}")


_SEED_BITS = 4096  # any seed anyone draws, and still printable


def _model(_world: World, _attribute: Any, value: str) -> None:
    models.named(value)


def _fuel(_world: World, _attribute: Any, value: int) -> None:
    if type(value) is not int or not 1 <= value <= MAX_FUEL:
        raise ModelError(f"fuel must be an integer from 1 to {MAX_FUEL}; got {shown(value)}")


@frozen(eq=False, weakref_slot=False)
class World:
    """A rectangle of space with what flies in it, at one moment. A value: every operation returns a new one.

    Requires: 0 <= width, height <= `units.MAX_WORLD_SIZE` (km); seed an integer of 4096 bits at most;
        model the name of a level; fuel, the steps a program may take in a tick, an integer from 1 to
        `units.MAX_FUEL`.
    Returns: an empty world at time 0.
    Raises: `ModelError` where a requirement is broken.
    Invariant: width, height, seed, model and fuel never change (tests/properties/test_purity.py).
    Invariant: every entity is in bounds and overlaps no other, but for a bullet and its source, up to a margin
        computed from the numbers (tests/properties/test_containment.py).
    Invariant: no id is in it twice or comes back (tests/properties/test_rules.py).

    Two worlds are equal if their model, size, seed, fuel, clock and flights by id are.
    """

    width: float = field(validator=_size)
    height: float = field(validator=_size)
    seed: int = field(default=0, validator=_seed)
    model: str = field(default=models.DEFAULT, validator=_model)
    fuel: int = field(default=FUEL, validator=_fuel, kw_only=True, repr=False)
    clock: Clock = field(default=START, kw_only=True, repr=False)
    flights: PVector[Flight | None] = field(factory=pvector, kw_only=True, repr=False)
    roster: Roster = field(default=Roster(pmap(), (), 1), kw_only=True, repr=False)
    _box: list[Any] = field(factory=list, init=False, repr=False)

    # What it contains.

    @property
    def now(self) -> Moment:
        """The clock as a moment."""
        return self.clock[:2]

    @property
    def time(self) -> float:
        """Seconds since the start: the double nearest to the clock."""
        return seconds(self.clock[0], self.clock[1])

    @property
    def entities(self) -> Mapping[int, Entity]:
        """Every entity by id, in id order, moved to the world's clock. A read-only view."""
        return Entities(self)

    @property
    def ships(self) -> tuple[Ship, ...]:
        """The ships in id order, moved to the world's clock."""
        return self._all(Ship)

    @property
    def asteroids(self) -> tuple[Asteroid, ...]:
        """The asteroids in id order, moved to the world's clock."""
        return self._all(Asteroid)

    @property
    def bullets(self) -> tuple[Bullet, ...]:
        """The bullets in id order, moved to the world's clock."""
        return self._all(Bullet)

    def _all(self, kind: type[E]) -> tuple[E, ...]:
        return tuple(e for e in Entities(self).values() if isinstance(e, kind))

    def __getitem__(self, entity_id: int) -> Entity:
        """The entity with this id, moved to the world's clock. KeyError if there is none."""
        return Entities(self)[entity_id]

    def __contains__(self, entity_id: object) -> bool:
        """Is an entity with this id in the world?"""
        return entity_id in self.roster.slots

    def __len__(self) -> int:
        """How many entities there are."""
        return len(self.roster.slots)

    def flight_of(self, entity_id: int) -> Flight:
        """The flight an entity is on; `ModelError` if there is no such entity."""
        return self.flights[self.slot_of(entity_id)]  # type: ignore[return-value]

    def slot_of(self, entity_id: int) -> int:
        """The slot of an entity; `ModelError` if there is no such entity."""
        try:
            return self.roster.slots[entity_id]
        except (KeyError, TypeError):
            raise ModelError(
                f"there is no entity with id {shown(entity_id)} in this world"
            ) from None

    def all_flights(self) -> dict[int, Flight]:
        """Every flight by entity id, in id order."""
        return {i: self.flights[s] for i, s in sorted(self.roster.slots.items())}  # type: ignore[misc]

    # What may be changed.

    def add(self, entity: Entity) -> World:
        """The world with one more entity, which starts a flight now.

        An entity without an id gets the next one. Touching is fine, and so is an overlap that rounding may
        have caused; `ModelError` says which other it overlaps, where it sticks out, that it is too wide
        (2 r >= width or height), or that its id is taken or was used before.
        """
        return self.add_all((entity,))

    def add_all(self, entities: Iterable[Entity]) -> World:
        """The world with all these entities, added in order, as `add` does; all of them or none."""
        next_id, flights = self.roster.next_id, []
        if not isinstance(entities, Iterable):
            raise ModelError(f"a collection of entities can be added; got {shown(entities)}")
        for entity in entities:
            checked(entity, "what is added")
            if entity.id is None:
                entity = evolve(entity, id=next_id)
            elif entity.id in self:
                raise ModelError(
                    f"id {entity.id} is taken: {describe(entity)} cannot be added twice"
                )
            elif entity.id < next_id:
                raise ModelError(f"id {entity.id} was used before; leave the id out for a new one")
            next_id = id_of(entity) + 1
            flights.append(starting(self, entity))
        check_room(self, [standing(self, f) for f in flights])
        return replaced(self, self.clock, (), flights, ())

    def remove(self, entity_id: int) -> World:
        """The world without an entity. Not a death: no children. `ModelError` if there is no such entity."""
        self.slot_of(entity_id)
        return replaced(self, self.clock, (), (), (entity_id,))

    # What makes it a value.

    def _key(self) -> tuple[object, ...]:
        return self.model, self.width, self.height, self.seed, self.fuel, self.clock

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, World):
            return NotImplemented
        return self is other or (
            self._key() == other._key() and self.all_flights() == other.all_flights()
        )

    def __hash__(self) -> int:
        return hash((self._key(), tuple(self.all_flights().values())))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (
            self.width, self.height, self.seed, self.model, self.fuel,
            self.clock, self.flights, self.roster,
        )  # fmt: skip


_world = raw(World)


def _restored(*fields: Any) -> World:
    return _world(*fields, [])


def starting(world: World, entity: Entity) -> Flight:
    """The flight of an entity that is as it is now; a running program ticks next after this moment."""
    now = world.now
    running = type(entity) is Ship and entity.program is not None and entity.program.running
    return flight(now, entity, 0, tick_after(now) if running else None, path(world, entity))


def instructed(world: World, ship_id: int, program: Program | None) -> World:
    """The world in which a ship runs another program, or none, from its next tick on. Its flight stays the same.

    `ModelError` if there is no such entity, it is no ship, or the program is none a ship takes.
    """
    f = world.flight_of(ship_id)
    if not isinstance(f.entity, Ship):
        raise ModelError(f"a program is for a ship; {describe(f.entity)} is none")
    told = evolve(f.entity, program=program)
    tick = tick_after(world.now) if program is not None and program.running else None
    f = flight(f.since, told, f.bounced_off, tick, f.path)
    return replaced(world, world.clock, [(world.slot_of(ship_id), f)], (), ())


def path(world: World, e: Entity) -> Path | None:
    """The path on which a flight of this entity starts: bent by a thruster under `smooth`, else None."""
    if type(e) is not Ship or not e.thruster or models.named(world.model).thrust != "smooth":
        return None
    return path_of(e.vx, e.vy, *push(world, e), e.max_speed)


def push(world: World, ship: Ship) -> tuple[float, float]:
    """The acceleration (km/s^2) a thruster gives a ship, but for what presses it against a wall it leans on.

    It leans on a wall if it is at it and has no velocity off it: the wall bears what would press it on, and the
    ship slides along.
    """
    ax, ay = ship.acceleration
    r = ship.radius
    if ship.vx == 0.0 and ((ax < 0.0 and ship.x <= r) or (ax > 0.0 and ship.x >= world.width - r)):
        ax = 0.0
    if ship.vy == 0.0 and ((ay < 0.0 and ship.y <= r) or (ay > 0.0 and ship.y >= world.height - r)):
        ay = 0.0
    return ax, ay


def describe(entity: Entity) -> str:
    """How messages call an entity: its kind, and its name or id."""
    who = repr(entity.name) if entity.name is not None else f"#{entity.id}"
    return f"{type(entity).__name__.lower()} {who}"


def standing(world: World, f: Flight) -> Placed:
    """The entity of a flight where it is now, and how far rounding may have put it from there."""
    now = world.now
    e = located(f, now)
    bend = 0.0 if f.path is None else f.path.bend
    here = slack(e, between(f.since, now), resolution(now), bend=bend)
    return Placed(e, here + grace(e, world.width, world.height))


def placed(world: World) -> list[Placed]:
    """Every entity where it is now."""
    return [standing(world, f) for f in world.all_flights().values()]


def check_room(world: World, news: Sequence[Placed]) -> None:
    """`ModelError` unless these entities fit into the world beside those already there."""
    for p in news:
        e = p.entity
        if not (2.0 * e.radius < world.width and 2.0 * e.radius < world.height):
            raise ModelError(
                f"{describe(e)} is too wide: 2 r = {2.0 * e.radius!r} km must be less than the width "
                f"({world.width!r} km) and the height ({world.height!r} km)"
            )
        if outside(p, world.width, world.height):
            raise ModelError(
                f"{describe(e)} of radius {e.radius!r} km at ({e.x!r}, {e.y!r}) sticks out of the world: "
                f"x must lie in [{e.radius!r}, {world.width - e.radius!r}], "
                f"y in [{e.radius!r}, {world.height - e.radius!r}]"
            )
    pair = first_overlap(placed(world), news)
    if pair is not None:
        a, b = pair
        raise ModelError(
            f"{describe(a)} at ({a.x!r}, {a.y!r}) and {describe(b)} at ({b.x!r}, {b.y!r}) overlap by "
            f"{depth(a, b)!r} km; their centres must be at least {a.radius + b.radius!r} km apart"
        )


def replaced(
    world: World,
    clock: Clock,
    changed: Sequence[tuple[int, Flight]],
    born: Sequence[Flight],
    dead: Sequence[int],
    next_id: int = 1,
    cache: Cache | None = None,
) -> World:
    """The world at `clock` with other flights: changed (slot, flight), born ones, and without the dead ids.

    Ids below `next_id` count as used. This is the one way flights change. The new world gets the cache of
    predictions, brought up to date: `cache`, or else that of the old world, which loses it.
    """
    flights = world.flights
    if len(changed) == 2:
        (slot, f), (other, g) = changed
        flights = flights.mset(slot, f, other, g)  # type: ignore[arg-type]
    else:
        for slot, f in changed:
            flights = flights.set(slot, f)
    roster = world.roster
    born_slots: list[tuple[int, Flight]] = []
    dead_slots: list[int] = []
    if born or dead or next_id > roster.next_id:
        free, next_id = roster.free, max(next_id, roster.next_id)
        slots, vector = roster.slots.evolver(), flights.evolver()
        for entity_id in dead:
            slot = slots[entity_id]
            slots.remove(entity_id)
            vector[slot] = None
            free = (slot, free)
            dead_slots.append(slot)
        for f in born:
            if free:
                slot, free = free
                vector[slot] = f
            else:
                slot = len(vector)
                vector.append(f)
            slots[id_of(f.entity)] = slot
            next_id = max(next_id, id_of(f.entity) + 1)
            born_slots.append((slot, f))
        flights, roster = vector.persistent(), Roster(slots.persistent(), free, next_id)
    if cache is None and world._box:
        cache = world._box.pop()
    if cache is not None:
        cache.replace(clock, changed, born_slots, dead_slots)
    box = [] if cache is None else [cache]
    return _world(
        world.width, world.height, world.seed, world.model, world.fuel, clock, flights, roster, box
    )
