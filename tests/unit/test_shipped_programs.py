"""The ship programs that come with the package: each does what its opening comment says."""

from __future__ import annotations

from math import hypot

import pytest
from attrs import evolve as with_

from fasteroids import (
    Asteroid,
    Happened,
    Ship,
    World,
    check_program,
    happenings,
    load_scene,
    parse_program,
)
from fasteroids.cli._files import shipped, shipped_programs
from fasteroids.testing import unfold
from tests.unit.making import machine

PROGRAMS = shipped_programs()


def pilot(name: str, x: float = 512.0, y: float = 384.0) -> Ship:
    return Ship(x, y, 0, 0, 40, 5e15, 0.0, program=machine(PROGRAMS[name]), name=name)


def field(name: str, seed: int, program: str) -> World:
    """A shipped field whose ship is flown by a program."""
    world = load_scene(shipped()[name], seed=seed)
    empty = World(world.width, world.height, seed, world.model).add(pilot(program))
    return empty.add_all(with_(asteroid, id=None) for asteroid in world.asteroids)


def ends(world: World) -> tuple[str, float]:
    """How a game of 120 s ends for ship 1, and when."""
    for happened, after in happenings(world, 120.0):
        if 1 in happened.died:
            return "died", happened.time
        if happened.died and not after.asteroids:
            return "cleared", happened.time
    return "timed out", 120.0


def acted(log: list[Happened]) -> list[str]:
    return [h.effect for h in log if h.kind == "tick"]


@pytest.mark.parametrize("name", PROGRAMS)
def test_each_is_correct_and_opens_with_what_it_does(name: str) -> None:
    checked = check_program(parse_program(PROGRAMS[name]))
    assert checked.diagnostics == ()
    assert PROGRAMS[name].startswith("// ")


@pytest.mark.parametrize("name", PROGRAMS)
@pytest.mark.parametrize("scene", ["field-2013", "field-storm"])
def test_none_stops_or_runs_out_of_fuel(name: str, scene: str) -> None:
    for seed in range(3):
        log = unfold(field(scene, seed, name), until=20.0).log
        assert {"halt", "fuel"}.isdisjoint(acted(log))


def test_the_fields_are_as_they_are_said_to_be() -> None:
    for name, count, low, high in (("field-2013", 12, 10, 50), ("field-storm", 16, 40, 200)):
        for seed in (*range(20), 100_000):
            world = load_scene(shipped()[name], seed=seed)
            (ship,) = world.ships
            assert (ship.position, ship.velocity, ship.direction) == ((512, 384), (0, 0), 0)
            assert (ship.radius, ship.mass, world.model) == (40, 5e15, "smooth")
            assert len(world.asteroids) == count
            for a in world.asteroids:
                assert 10 <= a.radius <= 60
                assert low - 1e-9 <= a.speed <= high + 1e-9
                assert hypot(a.x - 512, a.y - 384) - a.radius - 40 >= 100


def test_the_spinner_turns_and_fires_by_turns_ever_farther() -> None:
    run = unfold(World(1024, 768).add(pilot("spinner")), until=0.8)
    assert acted(run.log) == ["turn", "fire", "turn", "fire"]
    assert run.end.ships[0].direction == 0.2 + (0.2 + 0.1)


def test_nearest_says_once_how_far_the_nearest_is() -> None:
    world = World(1024, 768).add_all(
        [pilot("nearest"), Asteroid(512, 700, 0, 0, 20), Asteroid(212, 384, 0, 0, 20)]
    )
    log = unfold(world, until=3.0).log
    assert [h.prints for h in log] == [("300.0",)]


def test_the_opponent_of_2013_says_turns_and_fires() -> None:
    world = World(1024, 768).add_all([pilot("opponent-2013"), Asteroid(512, 700, 0, 0, 20)])
    log = unfold(world, until=1.0).log
    assert acted(log) == ["turn", "fire", "turn", "fire", "turn"]
    assert [h.prints for h in log] == [("316.0",), (), ("316.0",), (), ("316.0",)]


def test_the_opponent_of_2013_seldom_clears_its_field() -> None:
    assert (
        sum(ends(field("field-2013", seed, "opponent-2013"))[0] == "cleared" for seed in range(20))
        <= 3
    )


@pytest.mark.parametrize(("vx", "vy"), [(0, 80), (90, -40), (-60, -100), (0, 0)])
def test_the_turret_leads_its_target(vx: float, vy: float) -> None:
    """Its first bullet hits an asteroid that crosses far away."""
    world = World(4000, 4000).add_all(
        [pilot("turret", 2000, 2000), Asteroid(2600, 2300, vx, vy, 20)]
    )
    log = unfold(world, until=10.0).log
    fired = [h.born for h in log if h.effect == "fire"]
    hit = next(h for h in log if h.kind == "contact")
    assert fired[0][0] in hit.died
    assert 2 in hit.died


def test_the_turret_clears_slow_fields() -> None:
    """What it clears is measured by games of other seeds than those it was made with."""
    outcomes = [ends(field("field-2013", seed, "turret"))[0] for seed in range(500, 512)]
    assert outcomes.count("cleared") >= 9
