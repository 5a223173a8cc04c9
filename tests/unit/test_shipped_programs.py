"""The ship programs that come with the package: each does what its opening comment says."""

from __future__ import annotations

from math import hypot

import pytest

from fasteroids import (
    Asteroid,
    Ship,
    World,
    check_program,
    load_scene,
    parse_program,
)
from fasteroids.cli._files import shipped, shipped_programs
from fasteroids.testing import unfold
from tests.unit.making import machine
from tests.unit.programs.playing import acted, cleared

PROGRAMS = shipped_programs()


def pilot(name: str, x: float = 512.0, y: float = 384.0) -> Ship:
    return Ship(x, y, 0, 0, 40, 5e15, 0.0, program=machine(PROGRAMS[name]), name=name)


@pytest.mark.parametrize("name", PROGRAMS)
def test_each_is_correct_and_opens_with_what_it_does(name: str) -> None:
    checked = check_program(parse_program(PROGRAMS[name]))
    assert checked.diagnostics == ()
    assert PROGRAMS[name].startswith("// ")


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
    assert cleared("field-2013", range(20), "opponent-2013") <= 3


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
    assert cleared("field-2013", range(500, 512), "turret") >= 9
