"""The hunter: leads its target, clears the way to it, and gets out of the way of others' bullets."""

from __future__ import annotations

import pytest

from fasteroids import Asteroid, Bullet, evolve_until
from tests.unit.programs.playing import STILL, acted, arena, end, killer, log, pilot, wins


@pytest.mark.parametrize(("vx", "vy"), [(0, 0), (0, 60), (-50, -80), (40, 90), (0, 150)])
def test_it_leads_its_target(vx: float, vy: float) -> None:
    """Its first bullet hits a ship that crosses at a distance, also after that has bounced off a wall."""
    target = pilot(None, 750, 420, vx=vx, vy=vy)
    happened = log(arena(pilot("hunter", 150, 200), target), 8.0)
    first = next(h.born[0] for h in happened if h.effect == "fire")
    assert first in killer(happened, 2).died


def test_it_hunts_the_nearest_ship() -> None:
    far, near = pilot(None, 900, 384), pilot(None, 300, 150)
    happened = log(arena(pilot("hunter"), far, near), 8.0)
    assert killer(happened, 3).time < killer(happened, 2).time


def test_it_shoots_what_is_in_the_way_and_then_its_target() -> None:
    """The asteroid between the two is too small to leave children."""
    happened = log(
        arena(pilot("hunter", 150), pilot(None, 900), Asteroid(500, 384, 0, 0, 25)), 10.0
    )
    assert killer(happened, 3).time < killer(happened, 2).time


@pytest.mark.parametrize("aimed", [Bullet(950, 384, -250, 0, 3, 9), Asteroid(512, 40, 0, 90, 30)])
def test_it_gets_out_of_the_way(aimed: Bullet | Asteroid) -> None:
    for name, alive in ((STILL, False), ("hunter", True)):
        world = end(arena(pilot(name), aimed), 6.0)
        assert bool(world.ships) is alive


def test_it_knows_its_own_bullets() -> None:
    """The target is gone before it is hit: the bullet comes back from the wall, through the ship, which stays calm."""
    shooting = evolve_until(arena(pilot("hunter", 150), pilot(None, 900)), 0.3)
    (bullet,) = shooting.bullets
    happened = log(shooting.remove(2), 8.0)
    assert [h.wall for h in happened if bullet.id in h.entities] == ["right", "left"]
    assert set(acted(happened)) == {"skip"}


def test_it_has_three_bullets_in_flight_and_then_waits() -> None:
    happened = log(arena(pilot("hunter", 150), pilot(None, 980)), 1.9)
    assert acted(happened) == ["fire"] * 3 + ["skip"] * 6


def test_it_does_nothing_alone() -> None:
    assert set(acted(log(arena(pilot("hunter")), 2.0))) == {"skip"}


@pytest.mark.parametrize(
    ("other", "least"), [("opponent-2013", 23), ("turret", 23), ("dodger", 20)]
)
def test_it_beats_others_one_on_one(other: str, least: int) -> None:
    assert wins("one-on-one", range(12), "hunter", other) >= least
