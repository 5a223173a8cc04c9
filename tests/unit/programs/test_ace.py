"""Ace: foresees bounces, shoots what will hit it, gets out of the way, clears fields."""

from __future__ import annotations

import pytest

from fasteroids import Asteroid, Bullet, World
from tests.unit.programs.playing import STILL, acted, arena, cleared, end, killer, log, pilot

EMPTY = [Bullet(x, 760, 1, 0, 3, 1) for x in (100, 200, 300)]
"""Three of its bullets, in flight for long: so it cannot fire."""

BOUNCING = [
    (Asteroid(322, 394, -40, -170, 25), Asteroid(292, 224, -50, 50, 40)),
    (Asteroid(672, 414, -100, -160, 25), Asteroid(652, 264, 10, 30, 40)),
]
"""The first bounces off the second, and then flies to the ship."""


@pytest.mark.parametrize(("first", "second"), BOUNCING)
def test_it_gets_out_of_the_way_before_a_bounce_sends_something_its_way(
    first: Asteroid, second: Asteroid
) -> None:
    """Alone, neither would hit the ship: they bounce off each other, and one then does."""
    for one in (first, second):
        assert end(arena(pilot(STILL), one), 2.5).ships
    assert not end(arena(pilot(STILL), first, second), 2.5).ships
    happened = log(arena(pilot("ace"), first, second, *EMPTY), 3.0)
    bounce = next(h.time for h in happened if {2, 3} <= set(h.entities))
    assert next(h.time for h in happened if h.effect == "thrust") < bounce
    assert not any(1 in h.died for h in happened)


@pytest.mark.parametrize(("first", "second"), BOUNCING)
def test_it_shoots_where_something_will_be_after_a_bounce_before_that_happens(
    first: Asteroid, second: Asteroid
) -> None:
    happened = log(arena(pilot("ace"), first, second), 3.0)
    fired = next(h.time for h in happened if h.effect == "fire")
    bounce = next(h.time for h in happened if {2, 3} <= set(h.entities))
    killed = killer(happened, 2)
    assert fired < bounce < killed.time
    assert killed.entities == (2, 4), "its first bullet is the first thing that came into being"


@pytest.mark.parametrize("speed", [60, 120, 200, 400])
@pytest.mark.parametrize("side", [-1, 1])
def test_it_shoots_what_would_hit_it(speed: float, side: int) -> None:
    """Also what is faster than a bullet; without it, the ship would die."""
    attacker = Asteroid(512 + side * 300, 384, -side * speed, 0, 25)
    assert not end(arena(pilot(STILL), attacker), 5.0).ships
    happened = log(arena(pilot("ace"), attacker), 5.0)
    assert 1 not in killer(happened, 2).died


def test_it_shoots_first_what_would_hit_it_and_then_the_nearest() -> None:
    """The one that comes is farther than the one that rests."""
    resting, coming = Asteroid(512, 600, 0, 0, 25), Asteroid(812, 384, -220, 0, 25)
    happened = log(arena(pilot("ace"), resting, coming), 8.0)
    assert killer(happened, 3).time < killer(happened, 2).time


@pytest.mark.parametrize("vy", [-90, 90])
def test_it_thrusts_out_of_the_way_of_what_it_cannot_shoot(vy: float) -> None:
    attacker = Asteroid(512, 384 - 2 * vy, 0, vy, 25)
    for name, alive in ((STILL, False), ("ace", True)):
        assert bool(end(arena(pilot(name), attacker, *EMPTY), 4.0).ships) is alive
    assert "thrust" in acted(log(arena(pilot("ace"), attacker, *EMPTY), 4.0))


@pytest.mark.parametrize(("radius", "shot"), [(28, True), (32, False)])
def test_it_lets_be_what_would_leave_children_near_to_it(radius: float, shot: bool) -> None:
    """The others are big and near too."""
    others = [
        Asteroid(512, 224, 0, 0, 35),
        Asteroid(352, 384, 0, 0, 35),
        Asteroid(512, 544, 0, 0, 35),
    ]
    happened = log(arena(pilot("ace"), Asteroid(640, 384, 0, 0, radius), *others), 4.0)
    assert ("fire" in acted(happened)) is shot


@pytest.mark.parametrize("x", [640, 970])
def test_it_shoots_the_last_one_however_big_and_far(x: float) -> None:
    happened = log(arena(pilot("ace"), Asteroid(x, 384, 0, 0, 32)), 4.0)
    assert killer(happened, 2).born


def test_a_bullet_is_enough_for_one() -> None:
    happened = log(arena(pilot("ace"), Asteroid(800, 384, 0, 0, 25)), 4.0)
    assert acted(happened).count("fire") == 1


def test_it_does_nothing_alone() -> None:
    world: World = arena(pilot("ace"))
    assert set(acted(log(world, 2.0))) == {"skip"}


def test_it_clears_slow_fields_and_far_more_storms_than_the_corner() -> None:
    assert cleared("field-2013", range(10), "ace") >= 9
    seeds = range(40)
    assert cleared("field-storm", seeds, "ace") > cleared("field-storm", seeds, "corner") + 5
