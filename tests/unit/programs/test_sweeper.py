"""The sweeper: flies up to its asteroids and shoots them from near."""

from __future__ import annotations

from math import hypot

from fasteroids import Asteroid, Happened, World, happenings
from tests.unit.programs.playing import acted, arena, cleared, killer, log, pilot


def rim_to_rim(world: World, asteroid: int) -> float:
    (ship,), rock = world.ships, world[asteroid]
    return hypot(rock.x - ship.x, rock.y - ship.y) - rock.radius - ship.radius


def test_it_flies_near_before_it_shoots() -> None:
    world = arena(pilot("sweeper", 100, 384), Asteroid(950, 384, 0, 0, 25))
    distances = [rim_to_rim(w, 2) for h, w in happenings(world, 15.0) if h.effect == "fire"]
    assert rim_to_rim(world, 2) > 700
    assert distances
    assert max(distances) < 300


def test_it_sweeps_from_one_to_the_next_nearest() -> None:
    rocks = Asteroid(60, 700, 0, 0, 20), Asteroid(500, 700, 0, 0, 20), Asteroid(960, 400, 0, 0, 20)
    happened = log(arena(pilot("sweeper", 960, 100), *rocks), 40.0)
    assert deaths(happened, 2, 3, 4) == [4, 3, 2]


def test_it_keeps_to_its_asteroid_though_another_comes_nearer() -> None:
    chosen, other = Asteroid(612, 700, 0, 0, 20), Asteroid(60, 640, 70, 0, 20)
    happened = log(arena(pilot("sweeper", 512, 60), chosen, other), 12.0)
    assert deaths(happened, 2, 3) == [2, 3]


def test_it_shoots_first_what_would_hit_it() -> None:
    chosen, attacker = Asteroid(760, 384, 0, 0, 25), Asteroid(512, 740, 0, -180, 25)
    happened = log(arena(pilot("sweeper"), chosen, attacker), 12.0)
    assert deaths(happened, 2, 3)[0] == 3


def test_it_stops_thrusting_and_waits_when_all_is_swept() -> None:
    happened = log(arena(pilot("sweeper", 100, 384), Asteroid(950, 384, 0, 0, 25)), 25.0)
    last = killer(happened, 2).time
    assert set(acted([h for h in happened if h.time > last + 0.5])) == {"skip"}


def test_it_clears_slow_fields_and_now_and_then_a_storm() -> None:
    assert cleared("field-2013", range(10), "sweeper") >= 8
    assert cleared("field-storm", range(40), "sweeper") >= 1


def deaths(happened: list[Happened], *asteroids: int) -> list[int]:
    """The asteroids in the order they died in."""
    return [i for h in happened for i in h.died if i in asteroids]
