"""The rookie: turns towards the nearest asteroid by the sine of its angle, and fires."""

from __future__ import annotations

from math import cos, pi, sin

import pytest

from fasteroids import Asteroid
from tests.unit.programs.playing import acted, arena, cleared, end, killer, log, pilot


@pytest.mark.parametrize("angle", [0.3, -0.3, 1.2, -1.2])
def test_it_turns_by_the_sine_of_the_angle(angle: float) -> None:
    rock = Asteroid(512 + 300 * cos(angle), 384 + 300 * sin(angle), 0, 0, 20)
    (ship,) = end(arena(pilot("rookie"), rock), 0.3).ships
    assert ship.direction == pytest.approx(sin(angle) % (2 * pi))


@pytest.mark.parametrize("eighth", range(8))
def test_it_hits_what_rests_on_any_side(eighth: int) -> None:
    angle = eighth * pi / 4
    rock = Asteroid(512 + 250 * cos(angle), 384 + 250 * sin(angle), 0, 0, 20)
    happened = log(arena(pilot("rookie"), rock), 6.0)
    assert killer(happened, 2).time < 4.0


def test_it_leads_nothing() -> None:
    """It fires at where an asteroid is, so its first bullet comes too late."""
    happened = log(arena(pilot("rookie", 100, 384), Asteroid(900, 100, 0, 80, 20)), 4.0)
    first = next(h.born[0] for h in happened if h.effect == "fire")
    assert not any(first in h.died and 2 in h.died for h in happened)


def test_it_shoots_the_nearest_rim_first() -> None:
    """The centre of the small one is nearer, the rim of the large one."""
    small, large = Asteroid(512, 104, 0, 0, 10), Asteroid(802, 384, 0, 0, 29)
    happened = log(arena(pilot("rookie", direction=0.8), small, large), 8.0)
    assert killer(happened, 3).time < killer(happened, 2).time


def test_it_never_moves() -> None:
    happened = log(arena(pilot("rookie"), Asteroid(512, 104, 0, 0, 10)), 8.0)
    assert set(acted(happened)) == {"turn", "fire", "skip"}


def test_it_waits_where_there_is_nothing() -> None:
    assert set(acted(log(arena(pilot("rookie")), 2.0))) == {"skip"}


def test_it_clears_more_slow_fields_than_the_opponent_of_2013() -> None:
    seeds = range(10)
    assert cleared("field-2013", seeds, "rookie") > cleared("field-2013", seeds, "opponent-2013")
