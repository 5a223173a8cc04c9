"""The listener of the facade's evolve: told on the eve of each collision; it may look, not touch."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from fasteroids import ModelError, evolve
from fasteroids.facade import WorldHandle
from tests.unit.facade.handles import (
    Listener,
    facade,
    position,
    rock_in,
    ship_in,
    velocity,
)


@pytest.fixture
def world() -> WorldHandle:
    return facade.create_world(1000, 1000)


def test_a_thrusting_ship_is_seen_with_the_speed_it_has_when_it_collides(
    world: WorldHandle,
) -> None:
    s, listener = ship_in(world, 100, 500, 100, 0, m=1.1e18), Listener()
    facade.set_thruster_active(s, True)
    facade.evolve(world, 10, listener)
    # 890 km at 100 km/s, then 1 km/s^2 for these 8.9 s.
    assert listener.seen[0] == [(990, 500, pytest.approx(108.9), 0)]
    assert facade.get_ship_x_velocity(s) == pytest.approx(-108.9 + 1.1)


def test_whoever_is_told_sees_all_others_at_that_moment_too(world: WorldHandle) -> None:
    far = ship_in(world, 100, 900, 10, 0)
    ship_in(world, 500, 500, 0, 245)
    seen: list[tuple[float, float]] = []
    facade.evolve(world, 2.5, Listener(lambda *_: seen.append(position(far))))
    assert seen == [(120, 900)]
    assert position(far) == (125, 900)


def test_those_about_to_die_are_seen_alive_and_in_their_world(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 500, 10, 0), rock_in(world, 140, 500)
    seen: list[Any] = []
    facade.evolve(
        world,
        2,
        Listener(lambda *_: seen.append((facade.get_ship_world(s), facade.get_ships(world)))),
    )
    assert seen == [(world, {s})]
    assert facade.get_asteroids(world) == {r}


def test_the_world_is_the_same_with_a_listener_and_without() -> None:
    ends = []
    for listener in (None, Listener()):
        world = facade.create_world(1000, 1000, seed=5)
        s = ship_in(world, 100, 500, 30, 40, m=1e17)
        facade.set_thruster_active(s, True)
        rock_in(world, 500, 500, -70, 10, r=64)
        rock_in(world, 700, 200, 20, 30)
        facade.fire_bullet(s)
        for _ in range(300):
            facade.evolve(world, 0.1, listener)
        ends.append(world.world)
    assert ends[0] == ends[1]
    assert listener is not None
    assert len(listener.told) > 5


def test_a_listener_may_read_but_not_change_the_world_it_is_told_of(world: WorldHandle) -> None:
    s, r = ship_in(world, 100, 100, 10, 0), rock_in(world, 500, 500)
    ship_in(world, 140, 100)
    late, other = facade.create_ship(800, 800, 0, 0, 10, 0, 1), facade.create_world(1000, 1000)
    changes: list[Callable[[], object]] = [
        lambda: facade.evolve(world, 1),
        lambda: facade.add_ship(world, late),
        lambda: facade.remove_ship(world, s),
        lambda: facade.remove_asteroid(world, r),
        lambda: facade.turn(s, 1),
        lambda: facade.fire_bullet(s),
        lambda: facade.set_thruster_active(s, True),
    ]

    def at_once(*_: object) -> None:
        for change in changes:
            with pytest.raises(ModelError, match="may only look"):
                change()
        facade.evolve(other, 1)  # another world is its own affair
        facade.turn(late, 1)

    before, listener = world.world, Listener(at_once)
    facade.evolve(world, 3, listener)
    assert len(listener.told) == 1
    assert world.world == evolve(before, 3)
    assert other.world.time == 1
    facade.turn(s, 1)  # and now it may be changed again


class OwnError(Exception):
    """A listener's own."""


def test_what_a_listener_raises_passes_and_the_world_is_as_before_that_event(
    world: WorldHandle,
) -> None:
    a, b = ship_in(world, 100, 100, 10, 0), ship_in(world, 140, 100)
    r = rock_in(world, 500, 900, 0, 80)
    whole = evolve(world.world, 5)

    def at_once(*told: Any) -> None:
        if told[0] is a:
            raise OwnError

    listener = Listener(at_once)
    with pytest.raises(OwnError):
        facade.evolve(world, 5, listener)
    assert [t[:-2] for t in listener.told] == [(r,), (a, b)]
    assert world.world.time == 1  # the rock has met the top, nothing later happened
    assert facade.get_asteroid_y_velocity(r) == -80
    assert (velocity(a), position(a)) == ((10, 0), (110, 100))
    facade.evolve(world, 4)
    assert world.world == whole


def test_a_listener_that_raises_at_a_death_leaves_the_dying_alive(world: WorldHandle) -> None:
    s, _ = ship_in(world, 100, 500, 10, 0), rock_in(world, 140, 500)

    def at_once(*_: Any) -> None:
        raise OwnError

    with pytest.raises(OwnError):
        facade.evolve(world, 5, Listener(at_once))
    assert facade.get_ship_world(s) is world
    facade.evolve(world, 5)
    assert facade.get_ship_world(s) is None


@pytest.mark.parametrize("bad", [1, "listener", Listener, object(), print])
def test_what_is_no_listener_is_refused(bad: Any, world: WorldHandle) -> None:
    before = world.world
    with pytest.raises(ModelError, match="a listener must be"):
        facade.evolve(world, 1, bad)
    assert world.world == before
