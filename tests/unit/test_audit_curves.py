"""The audit of bent flights: nothing between two events escapes it, and an honest run passes."""

from __future__ import annotations

import random
from math import cos, inf, pi, sin, sqrt
from typing import Any

import pytest
from attrs import evolve

from fasteroids import Asteroid, Happened, Ship, World
from fasteroids.audit import Audit, Auditor, Margin, audit
from fasteroids.audit._curves import deepest, excursion, state, turns
from fasteroids.entities import Entity, moving
from fasteroids.moments import clock_at
from fasteroids.paths import Limited, Parabola
from fasteroids.state import Flight, located, replaced, starting

UP, DOWN = pi / 2, -pi / 2


def ship(
    x: float, y: float, vx: float, vy: float, r: float, a: float, direction: float, **more: Any
) -> Ship:
    """A thrusting ship with acceleration a."""
    return Ship(x, y, vx, vy, r, 1.0, direction, thruster=True, thrust_power=a, **more)


def space(*entities: Entity, size: float = 400.0) -> World:
    return World(size, size, model="smooth").add_all(entities)


def at(world: World, time: float) -> World:
    """The same flights at another time, whatever should have happened until then."""
    return replaced(evolve(world), clock_at(time), (), (), ())


def quiet(world: World, time: float) -> Audit:
    """The audit of a run in which nothing happened."""
    return Auditor(world).finish(at(world, time))


def margin(found: Audit, what: str) -> Margin:
    (result,) = [each for each in found.margins if what in each.what]
    return result


def broken(found: Audit) -> set[str]:
    return {each.what for each in found.margins if not each.ok}


# Missed contacts.


def thrown_up(gap: float) -> World:
    """A ship that rises for 4 s and falls back, and at the top is a gap away from a rock."""
    return space(ship(200, 50, 0, 40, 10, 10, DOWN), Asteroid(200, 155 + gap, 0, 0, 15))


@pytest.mark.parametrize("deep", [5.0, 1e-3, 1e-9, 1e-11])
def test_missed_contact_at_the_top_of_a_parabola(deep: float) -> None:
    found = quiet(thrown_up(-deep), 8.0)
    assert broken(found) == {"overlap"}
    overlap = margin(found, "overlap")
    assert overlap.worst == pytest.approx(deep, abs=1e-13)
    assert overlap.time == pytest.approx(4.0, abs=1e-3)
    assert overlap.entities == (1, 2)


@pytest.mark.parametrize("gap", [0.0, 1e-9, 5.0])
def test_thrown_up_and_fallen_back_without_a_contact(gap: float) -> None:
    assert quiet(thrown_up(gap), 8.0).ok


def test_missed_contact_is_found_when_the_flight_ends() -> None:
    world = thrown_up(-5.0)
    auditor, after = Auditor(world), at(world, 8.0)
    e = after[1]
    f = starting(after, moving(e, e.x, e.y, e.vx, -e.vy))
    after = replaced(after, after.clock, ((after.slot_of(1), f),), (), ())
    auditor.see(Happened(8.0, "wall", (1,), wall="bottom"), after)
    found = auditor.finish(after)
    assert broken(found) == {"overlap"}
    assert margin(found, "overlap").time == pytest.approx(4.0)


def test_two_parabolas_meet_twice_and_the_second_time_deeper() -> None:
    """One rises and falls beside a rock drifting across: two minima of the distance, the second is the deep one."""
    a = ship(100, 50, 10, 40, 5, 10, DOWN)
    b = ship(170, 100, 0, 0, 5, 1e-3, UP)
    found = quiet(space(a, b), 9.0)
    assert broken(found) == {"overlap"}
    f, g = space(a, b).flights
    assert f is not None
    assert g is not None
    seen = sampled(f, g, 9.0)
    assert margin(found, "overlap").worst == pytest.approx(seen, abs=1e-4)


def test_missed_contact_on_a_limited_path() -> None:
    a = ship(100, 100, 30, 0, 10, 10, UP, max_speed=30.0)
    turned = located(space(a).flights[0], (0, 3.0))  # type: ignore[arg-type]
    found = quiet(space(a, Asteroid(turned.x + 18, turned.y, 0, 0, 10)), 8.0)
    assert broken(found) == {"overlap"}
    assert type(space(a).flights[0].path) is Limited  # type: ignore[union-attr]
    assert margin(found, "overlap").worst >= 2.0


def test_formation_on_limited_paths_is_no_endless_work() -> None:
    ships = [ship(100 + 20 * i, 100, 30, 0, 10, 10, UP, max_speed=30.0) for i in range(3)]
    assert quiet(space(*ships), 5.0).ok


def sampled(f: Flight, g: Flight, until: float, count: int = 20000) -> float:
    """The deepest overlap at many moments."""
    reach = f.entity.radius + g.entity.radius
    best = -inf
    for i in range(count + 1):
        a, b = state(f, until * i / count), state(g, until * i / count)
        best = max(best, reach - sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2))
    return best


@pytest.mark.parametrize("seed", range(40))
def test_deepest_is_what_many_samples_find(seed: int) -> None:
    rng = random.Random(seed)
    limits = [rng.choice([20.0, 1e4]) for _ in range(2)]
    pair = []
    for limit in limits:
        angle, v = rng.uniform(0, 2 * pi), 20.0
        facing = angle + rng.uniform(-1.5, 1.5) if limit == v else rng.uniform(0, 2 * pi)
        e = ship(
            rng.uniform(100, 300), rng.uniform(100, 300), 1.000001 * v * cos(angle), 1.000001 * v * sin(angle),
            rng.uniform(5, 50), 10 ** rng.uniform(-1, 1.5), facing, max_speed=limit,
        )  # fmt: skip
        pair.append(starting(World(1e4, 1e4, model="smooth"), e))
    f, g = pair
    for h in (g, evolve(g, path=None)):
        t, depth = deepest(f, h, (0, 6.0), lambda: 0.0)
        seen = sampled(f, h, 6.0, 3000)
        assert 0.0 <= t <= 6.0
        if seen > 0.0:
            assert seen - 1e-12 <= depth <= seen + 0.2
        else:
            assert depth <= 0.05


# Walls.


def dipping(over: float) -> World:
    """A ship that falls towards a wall, and turns 2 s later, over it so far."""
    return space(ship(200, 32 - over, 0, -20, 12, 10, UP))


@pytest.mark.parametrize("over", [2.0, 1e-6, 1e-12])
def test_parabola_dips_over_a_wall(over: float) -> None:
    found = quiet(dipping(over), 4.0)
    assert broken(found) == {"out of bounds"}
    out = margin(found, "out of bounds")
    assert out.worst == pytest.approx(over, abs=1e-13)
    assert out.time == pytest.approx(2.0)


@pytest.mark.parametrize("over", [0.0, -1e-9, -1.0])
def test_parabola_that_stays_inside(over: float) -> None:
    assert quiet(dipping(over), 4.0).ok


def test_limited_path_bulges_over_a_wall() -> None:
    """Full speed up and right while the thrust points up and left: it turns away from the right wall."""
    v = 30.0 * sqrt(0.5)
    e = ship(370, 100, v, v, 10, 10, 0.75 * pi - 1e-9, max_speed=30.0)
    world = space(e)
    f = world.flights[0]
    assert f is not None
    assert type(f.path) is Limited
    (turn,) = turns(f, 6.0)
    assert abs(state(f, turn)[2]) < 1e-12
    top = state(f, turn)[0]
    found = quiet(world, 6.0)
    assert broken(found) == {"out of bounds"}
    assert margin(found, "out of bounds").worst == pytest.approx(top - 390.0)
    assert quiet(space(evolve(e, x=370.0 - (top - 390.0) - 1e-9)), 6.0).ok


def test_what_stuck_out_before_is_not_the_doing_of_the_run() -> None:
    assert quiet(at(dipping(2.0), 3.0), 3.5).ok


def test_excursion_bounds_how_far_a_flight_leaves_its_chord() -> None:
    for limit in (30.0, inf):
        world = World(1e6, 1e6, model="smooth")
        f = starting(world, ship(0, 0, 30, 0, 1, 10, UP, max_speed=min(limit, 1e5)))
        end = state(f, 5.0)
        for i in range(51):
            x, y, _, _ = state(f, 0.1 * i)
            share = i / 50
            away = sqrt((x - end[0] * share) ** 2 + (y - end[1] * share) ** 2)
            assert away <= excursion(f, 5.0) * (1 + 1e-12)
    assert excursion(evolve(f, path=None), 5.0) == 0.0
    assert turns(evolve(f, path=None), 5.0) == []


# Other laws.


def test_limit_missed_on_a_parabola() -> None:
    found = quiet(space(ship(100, 100, 5, 0, 10, 10, 0.0, max_speed=20.0)), 4.0)
    assert broken(found) == {"speed, against the limit"}
    assert margin(found, "speed").worst == pytest.approx(45.0)
    assert quiet(space(ship(100, 100, 5, 0, 10, 10, 0.0, max_speed=20.0)), 1.5).ok


def test_smooth_ship_changes_without_being_named() -> None:
    world = space(ship(100, 100, 5, 0, 10, 10, 0.0), Asteroid(300, 300, 0, 0, 10), size=1000.0)
    auditor, after = Auditor(world), at(world, 1.0)
    after = replaced(after, after.clock, ((after.slot_of(1), starting(after, after[1])),), (), ())
    auditor.see(Happened(1.0, "wall", (2,), wall="left"), after)
    assert broken(auditor.finish(after)) == {"entity changed by an event of others"}


def test_leaving_the_limit_is_a_change_of_path() -> None:
    world = space(ship(200, 200, 20, 0, 10, 10, 2.0, max_speed=20.0))
    f = world.flight_of(1)
    assert type(f.path) is Limited
    after = replaced(
        evolve(world), world.clock, ((0, evolve(f, path=Parabola(-4.0, 9.0))),), (), ()
    )
    auditor = Auditor(world)
    auditor.see(Happened(0.0, "limit", (1,), effect="leave"), after)
    assert auditor.finish(at(after, 0.5)).ok
    auditor = Auditor(world)
    auditor.see(Happened(0.0, "tick", ()), after)
    assert "entity changed by an event of others" in broken(auditor.finish(after))


# An honest engine.


def test_thrown_up_and_caught() -> None:
    found = audit(space(ship(200, 50, 3, 40, 10, 10, DOWN), Asteroid(200, 155, 0, 0, 15)), 30.0)
    assert found.ok, [each for each in found.margins if not each.ok]
    assert found.events["wall"] > 1
    assert "contact" not in found.events


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("limit", [60.0, 3e5])
def test_honest_crowd_under_thrust(seed: int, limit: float) -> None:
    rng = random.Random(seed)
    crowd: list[Entity] = []
    for i in range(5):
        for j in range(5):
            x, y, r = 80.0 * i + 40, 80.0 * j + 40, rng.uniform(5, 30)
            vx, vy = rng.uniform(-40, 40), rng.uniform(-40, 40)
            if rng.random() < 0.5:
                crowd.append(Asteroid(x, y, vx, vy, r, max_speed=limit))
            else:
                a, facing = 10 ** rng.uniform(0, 2), rng.uniform(0, 2 * pi)
                crowd.append(ship(x, y, vx, vy, r, a, facing, max_speed=limit))
    found = audit(space(*crowd), 20.0, max_events=300)
    assert found.ok, [each for each in found.margins if not each.ok]
    assert found.events["contact"] > 10
    assert margin(found, "speed").worst > 0.0
