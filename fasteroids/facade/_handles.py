"""Handles: objects that change, each standing for one entity or one world at a time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from math import isfinite, tau
from random import Random
from typing import Generic, TypeVar, cast

from attrs import evolve

from fasteroids import rules
from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Bullet, Entity, Ship, id_of
from fasteroids.state import World, describe, flight, instructed, replaced
from fasteroids.units import ModelError, number

__all__ = ["AsteroidHandle", "BulletHandle", "Handle", "ShipHandle", "WorldHandle"]

E = TypeVar("E", bound=Entity)


class Handle(Generic[E]):
    """An entity that changes: in a world, or on its own.

    Invariant: `home` is None, or the one world handle that gives this handle for its entity's id
        (tests/properties/test_facade.py).
    """

    __slots__ = ("_dead", "_home", "_last")

    def __init__(self, entity: E) -> None:
        self._last = entity
        self._home: WorldHandle | None = None
        self._dead = False

    @property
    def entity(self) -> E:
        """The immutable entity as it is now; for one in no world, as it is or was last."""
        if self._home is None:
            return self._last
        return cast(E, self._home.world[id_of(self._last)])

    @property
    def home(self) -> WorldHandle | None:
        """The world it is in, if any."""
        return self._home

    def join(self, home: WorldHandle, entity: E) -> None:
        """It is in a world from now on, where its entity has an id."""
        self._last, self._home = entity, home

    @property
    def dead(self) -> bool:
        """Did it die in a world? Then it never comes back into one (1.7)."""
        return self._dead

    def leave(self, last: Entity, *, dead: bool) -> None:
        """It is in no world any more, and stays as it was last."""
        self._last, self._home, self._dead = cast(E, last), None, dead

    def alter(self, entity: E) -> None:
        """Another value for an entity in no world."""
        assert self._home is None
        self._last = entity

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.entity!r})"


class ShipHandle(Handle[Ship]):
    """A ship that changes."""

    __slots__ = ()


class AsteroidHandle(Handle[Asteroid]):
    """An asteroid that changes, perhaps with a generator that decides where its children fly."""

    __slots__ = ("generator",)

    def __init__(self, entity: Asteroid, generator: Random | None = None) -> None:
        super().__init__(entity)
        self.generator = generator


class BulletHandle(Handle[Bullet]):
    """A bullet that changes, and the ship that fired it, which stays known when it dies."""

    __slots__ = ("source",)

    def __init__(self, entity: Bullet, source: ShipHandle) -> None:
        super().__init__(entity)
        self.source = source


class WorldHandle:
    """A world that changes: the current immutable one, and a handle for each entity somebody asked for.

    Invariant: every ship has a handle, since ships come in by theirs, and is found by its id when it is dead
        (tests/properties/test_facade.py).
    """

    __slots__ = ("_busy", "_handles", "_ships", "_world")

    def __init__(self, world: World) -> None:
        self._world = world
        self._handles: dict[int, ShipHandle | AsteroidHandle | BulletHandle] = {}
        self._ships: dict[int, ShipHandle] = {}
        self._busy = False

    @property
    def world(self) -> World:
        """The world as it is now: a value, which nobody changes."""
        return self._world

    def __repr__(self) -> str:
        return f"WorldHandle({self._world!r})"

    # Who is who.

    def handle(self, entity_id: int) -> ShipHandle | AsteroidHandle | BulletHandle:
        """The handle of an entity that is in the world; a new one if nobody asked before."""
        known = self._handles.get(entity_id)
        if known is not None:
            return known
        entity = self._world[entity_id]
        assert not isinstance(entity, Ship)
        made = AsteroidHandle(entity) if isinstance(entity, Asteroid) else self.shot(entity)
        self._enter(made, entity)
        return made

    def shot(self, bullet: Bullet) -> BulletHandle:
        """A handle, in no world yet, for a bullet that a ship of this world fired."""
        return BulletHandle(bullet, self._ships[bullet.source])

    def _enter(self, handle: ShipHandle | AsteroidHandle | BulletHandle, entity: Entity) -> None:
        self._handles[id_of(entity)] = handle
        handle.join(self, entity)  # type: ignore[arg-type]
        if isinstance(handle, ShipHandle):
            self._ships[id_of(entity)] = handle

    # What changes it.

    @contextmanager
    def changing(self) -> Iterator[None]:
        """One change at a time: `ModelError` for a listener that wants more than to look."""
        if self._busy:
            raise ModelError(
                "the world is in the middle of a change; who is told of it may only look"
            )
        self._busy = True
        try:
            yield
        finally:
            self._busy = False

    @contextmanager
    def seen_as(self, eve: World) -> Iterator[None]:
        """For a while, whoever reads this world or what is in it reads another one."""
        world, self._world = self._world, eve
        try:
            yield
        finally:
            self._world = world

    def add(self, handle: ShipHandle | AsteroidHandle) -> None:
        """Put an entity in, under a new id; `ModelError` as `World.add`, or if it is in a world already or dead."""
        entity = handle.entity
        if handle.dead:
            raise ModelError(f"{describe(entity)} is dead; a world never contains the dead")
        if handle.home is not None:
            which = "this" if handle.home is self else "another"
            raise ModelError(
                f"{describe(entity)} is in {which} world already; remove it there first"
            )
        entity_id = self._world.roster.next_id
        self._world = self._world.add(evolve(entity, id=None))
        self._enter(handle, self._world[entity_id])

    def remove(self, handle: ShipHandle | AsteroidHandle) -> None:
        """Take an entity out, which is no death; `ModelError` if it is not in this world."""
        if handle.home is not self:
            raise ModelError(f"{describe(handle.entity)} is not in this world")
        last, entity_id = handle.entity, id_of(handle.entity)
        self._world = self._world.remove(entity_id)
        del self._handles[entity_id]
        handle.leave(last, dead=False)

    def instruct(self, ship: ShipHandle, program: Program) -> None:
        """A ship of this world runs another program, from its next tick on. Its flight stays the same."""
        self._world = instructed(self._world, id_of(ship.entity), program)

    def move_on(self, eve: World, after: World) -> World:
        """One change: `eve` is the world just before it, `after` just after. Gives the world it is now.

        That is `after`, unless an asteroid with a generator left children: then they fly where its next number
        says, and have the generator in their turn.
        """
        gone = {}
        if after.roster is not eve.roster:  # births or deaths
            gone = {i: handle for i, handle in self._handles.items() if i not in after}
        heirs: dict[int, Random] = {}
        for entity_id, handle in gone.items():
            if isinstance(handle, AsteroidHandle) and handle.generator is not None:
                born = [i for i in range(eve.roster.next_id, after.roster.next_id) if i in after]
                if born:
                    after = _redrawn(eve, entity_id, after, born, handle.generator)
                    heirs = dict.fromkeys(born, handle.generator)
        for entity_id, handle in gone.items():
            del self._handles[entity_id]
            handle.leave(eve[entity_id], dead=True)
        self._world = after
        for entity_id, generator in heirs.items():
            child = self.handle(entity_id)
            assert isinstance(child, AsteroidHandle)
            child.generator = generator
        return after


def _redrawn(eve: World, parent_id: int, after: World, born: list[int], generator: Random) -> World:
    """The world in which the children of an asteroid, just born, fly where a generator says."""
    angle = tau * number(generator.random(), "a random number")
    if not isfinite(angle):
        raise ModelError(
            f"a random number must lie in [0, 1); got one that makes a turn of {angle!r} rad"
        )
    parent = eve[parent_id]
    assert isinstance(parent, Asteroid)
    drawn = [flight(after.now, c, 0, None, None) for c, _ in rules.children(angle, parent, born[0])]
    return replaced(after, after.clock, (), drawn, born)
