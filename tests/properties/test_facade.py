"""The facade is a thin shell: its worlds are those of the same calls made purely, and it raises `ModelError` alone."""

from __future__ import annotations

import inspect
import io
import random
from collections.abc import Callable
from math import inf, isfinite, nan, tau
from typing import Any

from attrs import evolve as with_
from attrs import frozen
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Asteroid, Fire, ModelError, Ship, Thrust, ThrustOff, Turn, World, act, evolve
from fasteroids.actions import Action
from fasteroids.entities import Entity
from fasteroids.facade import BulletHandle, Facade, Handle, WorldHandle
from fasteroids.lang import check_program, parse_program
from tests.properties.laws import world_law

facade = Facade()

# The same calls made purely.


@frozen
class Thing:
    """An entity that was made: the number of its world, if it is in one, and its state, with its id there.

    What died is only known to be dead.
    """

    home: int | None
    entity: Entity
    dead: bool = False


@frozen
class Pure:
    """What a shell stands for, as a value: all worlds and all things made, in order."""

    worlds: tuple[World, ...] = ()
    things: tuple[Thing, ...] = ()

    def create_world(self, width: float, height: float) -> Pure:
        return with_(self, worlds=(*self.worlds, World(width, height)))

    def create_ship(self, *numbers: float) -> Pure:
        x, y, vx, vy, radius, direction, mass = numbers
        return self._made(Ship(x, y, vx, vy, radius, mass, direction))

    def create_asteroid(self, *numbers: float) -> Pure:
        return self._made(Asteroid(*numbers))

    def _made(self, entity: Entity) -> Pure:
        return with_(self, things=(*self.things, Thing(None, entity)))

    def add(self, n: int, k: int) -> Pure:
        world, thing = self.worlds[n], self.things[k]
        if thing.home is not None or thing.dead:
            raise ModelError("in a world already, or dead")
        after = world.add(with_(thing.entity, id=None))
        return self._with(n, after)._set(k, Thing(n, after[world.roster.next_id]))

    def remove(self, n: int, k: int) -> Pure:
        thing = self.things[k]
        if thing.home != n:
            raise ModelError("not in this world")
        assert thing.entity.id is not None
        pure = self._set(k, Thing(None, thing.entity))
        return pure._with(n, self.worlds[n].remove(thing.entity.id))

    def evolve(self, n: int, dt: float) -> Pure:
        return self._with(n, evolve(self.worlds[n], dt))

    def turn(self, k: int, angle: float) -> Pure:
        return self._told(k, Turn(angle), lambda ship: ship.turn(angle))

    def set_thruster_active(self, k: int, active: bool) -> Pure:
        action = Thrust() if active else ThrustOff()
        return self._told(k, action, lambda ship: with_(ship, thruster=active))

    def fire_bullet(self, k: int) -> Pure:
        return self._told(k, Fire(), lambda ship: ship)

    def set_ship_program(self, k: int, text: str) -> Pure:
        """Only for ships in no world: worlds know no such change but the facade's."""
        thing, tree = self.things[k], parse_program(text).program
        assert tree is not None
        checked = check_program(tree).program
        if not isinstance(thing.entity, Ship) or checked is None:
            raise ModelError("no ship, or ill-typed")
        return self._set(k, Thing(None, with_(thing.entity, program=checked), thing.dead))

    def _told(self, k: int, action: Action, alone: Callable[[Ship], Ship]) -> Pure:
        thing = self.things[k]
        if not isinstance(thing.entity, Ship):
            raise ModelError("no ship")
        if thing.home is None:
            return self._set(k, Thing(None, alone(thing.entity), thing.dead))
        assert thing.entity.id is not None
        return self._with(thing.home, act(self.worlds[thing.home], thing.entity.id, action))

    def _set(self, k: int, thing: Thing) -> Pure:
        return with_(self, things=(*self.things[:k], thing, *self.things[k + 1 :]))

    def _with(self, n: int, world: World) -> Pure:
        """Another world in the place of one; who is not in it any more is dead."""
        things = []
        for thing in self.things:
            if thing.home == n:
                assert thing.entity.id is not None
                at = world.entities.get(thing.entity.id)
                thing = Thing(n, at) if at else Thing(None, thing.entity, dead=True)
            things.append(thing)
        return with_(
            self, worlds=(*self.worlds[:n], world, *self.worlds[n + 1 :]), things=tuple(things)
        )


class Shell:
    """The same, through the facade."""

    def __init__(self) -> None:
        self.worlds: list[WorldHandle] = []
        self.things: list[Any] = []

    def call(self, name: str, args: tuple[Any, ...]) -> None:
        if name == "create_world":
            self.worlds.append(facade.create_world(*args))
        elif name in ("create_ship", "create_asteroid"):
            self.things.append(getattr(facade, name)(*args))
        elif name in ("add", "remove"):
            thing = self.things[args[1]]
            kind = "ship" if facade.is_ship(thing) else "asteroid"
            getattr(facade, f"{name}_{kind}")(self.worlds[args[0]], thing)
        elif name == "evolve":
            facade.evolve(self.worlds[args[0]], args[1])
        elif name == "set_ship_program":
            tree = facade.parse_program(args[1]).program
            assert tree is not None
            facade.set_ship_program(self.things[args[0]], tree)
        else:
            getattr(facade, name)(self.things[args[0]], *args[1:])


# A lattice of 100 km in a world of 600, so that most things fit, and meet.
_places = st.integers(0, 5).map(lambda n: 50.0 + 100.0 * n)
_speeds = st.sampled_from([0.0, 50.0, -50.0, 200.0, -31.4, nan, 1e9])
_radii = st.sampled_from([10.0, 32.0, 50.0, 0.0, inf])
_angles = st.one_of(st.integers(-4, 4).map(lambda n: n * tau / 8), st.sampled_from([nan, inf]))
_moving = (_places, _places, _speeds, _speeds, _radii)
_worlds, _things = st.integers(0, 1), st.integers(0, 7)
_steps = st.sampled_from([0.0, 0.1, 0.25, 1.0, 3.0, -1.0, nan])
_TEXTS = ["while true { fire; thrust; turn 0.7; }", "turn 1; fire;", "", "turn null;"]
_calls = st.one_of(
    st.tuples(st.just("create_ship"), st.tuples(*_moving, _angles, st.sampled_from([5e15, 1e18]))),
    st.tuples(st.just("create_asteroid"), st.tuples(*_moving)),
    st.tuples(st.sampled_from(["add", "add", "remove"]), st.tuples(_worlds, _things)),
    st.tuples(st.just("evolve"), st.tuples(_worlds, _steps)),
    st.tuples(st.just("turn"), st.tuples(_things, _angles)),
    st.tuples(st.just("set_thruster_active"), st.tuples(_things, st.booleans())),
    st.tuples(st.just("fire_bullet"), st.tuples(_things)),
    st.tuples(st.just("set_ship_program"), st.tuples(_things, st.sampled_from(_TEXTS))),
)
_ship = st.tuples(_places, _places, _speeds, _speeds, st.just(10.0), st.just(0.0), st.just(5e15))
_rock = st.tuples(_places, _places, _speeds, _speeds, st.just(32.0))
_opening = st.tuples(_ship, _rock, _rock).map(
    lambda made: [
        ("create_world", (600.0, 600.0)),
        ("create_world", (600.0, 500.0)),
        ("create_ship", made[0]),
        ("create_asteroid", made[1]),
        ("create_asteroid", made[2]),
        ("set_ship_program", (0, _TEXTS[0])),
        ("add", (0, 0)),
        ("add", (0, 1)),
        ("add", (0, 2)),
    ]
)


@world_law
@given(_opening, st.lists(_calls, max_size=25))
def test_the_shell_holds_what_the_same_calls_made_purely_give(
    opening: list[tuple[str, Any]], calls: list[tuple[str, Any]]
) -> None:
    pure, shell = Pure(), Shell()
    for name, args in opening + calls:
        if name in ("add", "remove"):
            args = (args[0], args[1] % len(shell.things))
        elif name not in ("create_world", "create_ship", "create_asteroid", "evolve"):
            args = (args[0] % len(shell.things), *args[1:])
        if name == "set_ship_program" and pure.things[args[0]].home is not None:
            continue
        refused = []
        for do in (lambda: getattr(pure, name)(*args), lambda: shell.call(name, args)):  # noqa: B023
            try:
                pure = do() or pure
                refused.append(False)
            except ModelError:
                refused.append(True)
        assert refused[0] == refused[1]
        compare(pure, shell)


def compare(pure: Pure, shell: Shell) -> None:
    assert list(pure.worlds) == [w.world for w in shell.worlds]
    for thing, handle in zip(pure.things, shell.things, strict=True):
        assert (None if thing.home is None else shell.worlds[thing.home]) is handle.home
        assert handle.dead == thing.dead
        assert thing.dead or handle.entity == thing.entity
    for n, world in enumerate(shell.worlds):
        made = {
            h
            for t, h in zip(pure.things, shell.things, strict=True)
            if t.home == n and facade.is_ship(h)
        }
        assert facade.get_ships(world) == made
        consistent(world)


def consistent(world: WorldHandle) -> None:
    """One handle an entity, which knows its home; bullets know the ship that fired them."""
    handles: list[Handle[Any]] = [
        *facade.get_ships(world), *facade.get_asteroids(world), *facade.get_bullets(world),
    ]  # fmt: skip
    assert sorted(h.entity.id for h in handles) == list(world.world.entities)
    for handle in handles:
        assert handle.home is world
        assert world.handle(handle.entity.id) is handle
        if isinstance(handle, BulletHandle):
            assert facade.is_ship(facade.get_bullet_source(handle))


# Any arguments.


class Reader:
    """A listener that looks around."""

    def boundary_collision(self, entity: Any, *at: float) -> None:
        assert all(map(isfinite, at))
        consistent(entity.home)

    def object_collision(self, first: Any, second: Any, *at: float) -> None:
        assert all(map(isfinite, at))
        consistent(first.home or second.home)


METHODS = {
    name: len(inspect.signature(getattr(facade, name)).parameters)
    for name in dir(Facade)
    if not name.startswith("_")
}
SHORT = [0, 0.25, 2.0, 30, True, False]
JUNK: list[Any] = [
    *SHORT, None, nan, inf, -inf, -1, 1e300, 10**400, "", "ship", "skip;", "turn true;", b"skip;", "ftp:x", "http://[",
    [], {}, object(), Ship, Facade, Ship(1, 1, 0, 0, 1, 1, 0), Reader(), Reader, random.Random(0), io.StringIO("fire;"),
    parse_program("while true { fire; turn 1; }").program, parse_program("turn null;").program,
]  # fmt: skip


@world_law
@given(st.data())
def test_any_calls_with_any_arguments_raise_nothing_but_model_errors(data: st.DataObject) -> None:
    worlds = [facade.create_world(600, 600), facade.create_world(600, 600)]
    pool: list[Any] = [*worlds]
    for x in (100, 200, 300):
        pool.append(facade.create_ship(x, 300, 0, 0, 10, 0, 5e15))
        pool.append(facade.create_asteroid(x, 400, 40, -30, 40, random.Random(x)))
    for _ in range(data.draw(st.integers(0, 30))):
        name = data.draw(st.sampled_from(sorted(METHODS)))
        given_ = st.one_of(st.sampled_from(pool), st.sampled_from(pool), st.sampled_from(JUNK))
        args = [data.draw(given_) for _ in range(METHODS[name])]
        if name == "evolve" and args[1] == 1e300:
            args[1] = nan  # a world that moves would take for ever
        try:
            got = outcome(name, args)
        except ModelError:
            continue
        pool += got if isinstance(got, set) else [got]
        for world in worlds:
            consistent(world)


def outcome(name: str, args: list[Any]) -> Any:
    """What a method gives; an argument that may only be given by name, so."""
    parameters = inspect.signature(getattr(facade, name)).parameters.values()
    plain = [a for a, p in zip(args, parameters, strict=True) if p.kind is not p.KEYWORD_ONLY]
    named = {p.name: a for a, p in zip(args, parameters, strict=True) if p.kind is p.KEYWORD_ONLY}
    return getattr(facade, name)(*plain, **named)
