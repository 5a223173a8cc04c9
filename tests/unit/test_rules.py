"""What an event means, as functions from flights to a change. The outcomes themselves: test_decisions.py."""

from __future__ import annotations

from math import inf, nan, pi
from typing import Any

import pytest

from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    ModelError,
    Ship,
    Skip,
    Thrust,
    ThrustOff,
    Turn,
    World,
    act,
    evolve,
)
from fasteroids.entities import Entity
from fasteroids.pressing import LEAST_HOP
from fasteroids.rules import Change, apply, bounce, contact, kick, masses, wall
from fasteroids.state import Flight
from fasteroids.testing import unfold
from fasteroids.units import THRUST

NOON = (0, 2.0)


def ship(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Ship:
    given: dict[str, Any] = {"radius": 10.0, "mass": THRUST / 256, "direction": 0.0, "id": 1}
    return Ship(x, y, vx, vy, **{**given, **fields})


def rock(
    x: float, y: float, vx: float = 0.0, vy: float = 0.0, r: float = 20.0, entity_id: int = 2
) -> Asteroid:
    return Asteroid(x, y, vx, vy, r, id=entity_id)


def shot(
    x: float, y: float, vx: float = 0.0, vy: float = 0.0, entity_id: int = 3, **f: Any
) -> Bullet:
    return Bullet(x, y, vx, vy, 3.0, 99, id=entity_id, **f)


def flight(entity: Entity) -> Flight:
    """A flight that began at 0 s, two seconds before noon."""
    return Flight((0, 0.0), entity)


WORLD = World(1000, 1000).add_all([ship(100, 100), rock(500, 500), shot(800, 800)])


# Contacts (1.5.2).


@pytest.mark.parametrize(
    ("a", "b", "effect", "dead"),
    [
        (ship(0, 0), ship(20, 0, id=2), "bounce", ()),
        (rock(0, 0, entity_id=1), rock(40, 0), "bounce", ()),
        (shot(0, 0), rock(23, 0), "die", (2, 3)),
        (shot(0, 0), ship(13, 0), "die", (1, 3)),
        (shot(0, 0), shot(6, 0, entity_id=4), "die", (3, 4)),
        (ship(0, 0), rock(30, 0), "die", (1,)),
    ],
)
def test_contact_who_bounces_and_who_dies(
    a: Entity, b: Entity, effect: str, dead: tuple[int, ...]
) -> None:
    for f, g in ((a, b), (b, a)):
        change = contact(WORLD, (0, 0.0), flight(f), flight(g))
        assert (change.effect, change.dead, change.born) == (effect, dead, ())
        assert len(change.changed) == (2 if effect == "bounce" else 0)


def test_contact_happens_where_they_are_by_then() -> None:
    a, b = ship(100, 500, 10, 0), ship(160, 500, -10, 0, id=2)
    change = contact(WORLD, NOON, flight(a), flight(b))
    f, g = change.changed
    assert f == Flight(NOON, ship(120, 500, -10, 0), 2)
    assert g == Flight(NOON, ship(140, 500, 10, 0, id=2), 1)
    assert change.at == (130.0, 500.0)


def test_contact_is_at_the_point_where_they_touch() -> None:
    change = contact(WORLD, (0, 0.0), flight(ship(100, 500, 5, 0)), flight(rock(130, 500)))
    assert change.at == (110.0, 500.0)
    change = contact(WORLD, NOON, flight(rock(500, 100, 0, 20)), flight(shot(500, 163)))
    assert change.at == (500.0, 160.0)


def test_contact_keeps_the_next_tick_of_a_ship() -> None:
    f = Flight((0, 0.0), ship(100, 500, 10, 0), 0, 7)
    change = contact(WORLD, NOON, f, flight(ship(140, 500, id=2)))
    assert [g.next_tick for g in change.changed] == [7, None]


def test_masses_of_asteroids_keep_their_ratio_at_any_scale() -> None:
    for scale in (1.0, 2.0**-600, 2.0**600):
        a, b = masses(rock(0, 0, r=16.0 * scale), rock(0, 0, r=32.0 * scale))
        assert b / a == 8.0


def test_masses_of_others_are_theirs() -> None:
    a, b = ship(0, 0), shot(0, 0)
    assert masses(a, b) == (a.mass, b.mass)


def test_bounce_leaves_everything_else() -> None:
    a, b = bounce(rock(100, 500, 10, 1, entity_id=4), rock(140, 500, -10, 2, entity_id=5))
    assert a == rock(100, 500, -10, 1, entity_id=4)
    assert b == rock(140, 500, 10, 2, entity_id=5)


# Walls.


@pytest.mark.parametrize(
    ("side", "place", "velocity", "at"),
    [
        ("left", (20.0, 516.0), (5.0, 8.0), (0.0, 516.0)),
        ("right", (980.0, 516.0), (-5.0, 8.0), (1000.0, 516.0)),
        ("bottom", (510.0, 20.0), (5.0, 8.0), (510.0, 0.0)),
        ("top", (510.0, 980.0), (5.0, -8.0), (510.0, 1000.0)),
    ],
)
def test_wall_sets_the_disc_onto_it_and_turns_it_inwards(
    side: str, place: tuple[float, float], velocity: tuple[float, float], at: tuple[float, float]
) -> None:
    change = wall(WORLD, NOON, flight(rock(500, 500, 5, 8)), side)
    (f,) = change.changed
    assert f == Flight(NOON, rock(*place, *velocity))
    assert (change.effect, change.dead, change.at) == ("bounce", (), at)


def test_wall_is_met_once_by_a_bullet() -> None:
    change = wall(WORLD, NOON, flight(shot(10, 500, -5, 0)), "left")
    (f,) = change.changed
    assert f.entity == shot(3, 500, 5, 0, bounced=True)
    again = wall(WORLD, NOON, f, "right")
    assert (again.effect, again.dead, again.changed) == ("die", (3,), ())
    assert again.at is not None
    assert again.at[0] == 1000.0


def test_wall_clears_bounced_off_and_keeps_the_next_tick() -> None:
    (f,) = wall(WORLD, NOON, Flight((0, 0.0), ship(30, 500, -10, 0), 2, 9), "left").changed
    assert (f.bounced_off, f.next_tick) == (0, 9)


# Thrust.


def test_kick_moves_with_the_old_velocity_then_accelerates() -> None:
    before = Flight((0, 0.0), ship(100, 500, 8, 4, thruster=True), 2, 3)
    after, clipped = kick(before, NOON)
    assert after == Flight(NOON, ship(116, 508, 520, 4, thruster=True), 0, 3)
    assert clipped is False


def test_kick_of_no_length_is_none() -> None:
    f = Flight(NOON, ship(100, 500, 8, 4, thruster=True), 2)
    assert kick(f, NOON) == (f, False)
    assert kick(f, NOON)[0] is f


def test_kick_says_when_it_clips() -> None:
    f, clipped = kick(flight(ship(100, 500, 8, 0, thruster=True, max_speed=100)), NOON)
    assert clipped is True
    assert f.entity.velocity == (100.0, 0.0)


# Actions.


@pytest.mark.parametrize(
    ("action", "effect"),
    [
        (Turn(1.0), "turn"),
        (Fire(), "fire"),
        (Thrust(), "thrust"),
        (ThrustOff(), "thrust_off"),
        (Skip(), "skip"),
    ],
)
def test_apply_calls_each_action_by_its_name(action: Any, effect: str) -> None:
    change = apply(WORLD, WORLD.flight_of(1), action)
    assert isinstance(change, Change)
    assert change.effect == effect


def test_apply_what_is_so_already_changes_nothing() -> None:
    assert apply(WORLD, WORLD.flight_of(1), ThrustOff()) == Change("thrust_off")
    assert apply(WORLD, flight(ship(0, 0, thruster=True)), Thrust()) == Change("thrust")
    assert apply(WORLD, WORLD.flight_of(1), Skip()) == Change("skip")


def test_apply_turn_is_no_new_path() -> None:
    world = evolve(WORLD, 2.0)
    (f,) = apply(world, Flight((0, 0.0), ship(100, 100), 5, 11), Turn(pi)).changed
    assert f == Flight((0, 0.0), ship(100, 100, direction=pi), 5, 11)


@pytest.mark.parametrize("bad", [nan, inf, -inf, None, "1", True, 10**400], ids=type)
def test_apply_refuses_a_turn_by_no_angle(bad: Any) -> None:
    with pytest.raises(ModelError, match="the angle of a turn must be"):
        act(WORLD, 1, Turn(bad))


@pytest.mark.parametrize("bad", [None, "fire", Fire, 3, object()], ids=type)
def test_apply_refuses_what_is_no_action(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"an action is one of Turn\(angle\), Fire\(\)"):
        act(WORLD, 1, bad)


@pytest.mark.parametrize("entity_id", [2, 3])
def test_apply_only_ships_act(entity_id: int) -> None:
    kind = type(WORLD[entity_id]).__name__.lower()
    with pytest.raises(ModelError, match=f"only a ship can act, not {kind} #{entity_id}"):
        act(WORLD, entity_id, Fire())


# Leaning.


@pytest.mark.parametrize(("limit", "hops"), [(10.0, 300), (250.0, 8000)])
def test_wall_bears_a_ship_that_hops_ever_lower(limit: float, hops: int) -> None:
    """Found by attack: pressed obliquely at its limit a ship hopped half a million times a second."""
    diver = Ship(500, 25, limit, 0, 20, 5e15, -pi / 4, thruster=True, max_speed=limit)
    wide = World(1e5, 1e5, model="smooth").add(diver)
    run = unfold(wide, until=60.0, events=hops)
    assert run.end.time == 60.0
    assert run.end[1].vy == 0.0
    assert run.end[1].y == 20.0
    assert {h.kind for h in run.log[-2:]} == {
        "wall",
        "limit",
    }  # it leans, and is held at its limit again


@pytest.mark.parametrize("size", [1e3, 1e12, 1e20])
def test_wall_keeps_the_speed_of_a_bounce_in_a_world_of_any_size(size: float) -> None:
    thrower = Ship(30, 500, -1000, 0, 20, 5e15, pi, thruster=True)
    end = unfold(World(size, 1e3, model="smooth").add(thrower), until=0.1, events=1).end
    assert end[1].vx == pytest.approx(1000.0, rel=0.01)


def test_wall_of_a_thrown_ship_is_elastic_until_the_hop_is_the_least() -> None:
    """Without a limit nothing takes its speed: hops above the least keep their height."""
    for height, elastic in ((4.0 * LEAST_HOP * 20.0, True), (0.25 * LEAST_HOP * 20.0, False)):
        dropped = Ship(500, 20 + height, 0, 0, 20, 5e15, 1.5 * pi, thruster=True)
        end = unfold(World(1e3, 1e3, model="smooth").add(dropped), until=0.1, events=1).end
        assert (end[1].vy > 0.0) == elastic
