"""The guardian: shoots what is on course to hit it, and nothing else."""

from __future__ import annotations

import pytest

from fasteroids import Asteroid
from tests.unit.programs.playing import STILL, acted, arena, games, killer, lifetime, log, pilot


def test_it_lets_pass_what_will_not_hit_it() -> None:
    passing = Asteroid(900, 500, -100, 0, 40), Asteroid(200, 200, 0, 100, 40)
    happened = log(arena(pilot("guardian"), *passing), 3.5)
    assert set(acted(happened)) == {"skip"}


@pytest.mark.parametrize(("x", "y"), [(950, 384), (100, 100), (512, 720), (900, 60)])
def test_it_shoots_what_will_hit_it_with_one_bullet(x: float, y: float) -> None:
    """Small enough to leave no children, and 4 s away."""
    attacker = Asteroid(x, y, (512 - x) / 4, (384 - y) / 4, 25)
    happened = log(arena(pilot("guardian"), attacker), 4.0)
    assert 2 in killer(happened, 2).died
    assert acted(happened).count("fire") == 1


def test_it_shoots_the_soonest_first_though_it_is_farther() -> None:
    slow, fast = Asteroid(512, 620, 0, -30, 25), Asteroid(60, 384, 150, 0, 25)
    happened = log(arena(pilot("guardian"), slow, fast), 8.0)
    assert killer(happened, 3).time < killer(happened, 2).time


def test_it_shoots_again_what_its_bullet_has_not_met_in_time() -> None:
    """A small asteroid in between catches the first bullet; the second comes when the first has had its time."""
    attacker, between = Asteroid(960, 384, -60, 0, 29), Asteroid(700, 310, 0, 90, 20)
    happened = log(arena(pilot("guardian"), attacker, between), 7.0)
    shots = [h.time for h in happened if h.effect == "fire"]
    assert killer(happened, 3).time < killer(happened, 2).time
    assert len(shots) == 2
    assert shots[1] - shots[0] > 1.0


def test_it_survives_slow_fields_to_the_end() -> None:
    outcomes = [g.outcome for g in games("field-2013", range(10), "guardian")]
    assert outcomes.count("timed out") + outcomes.count("cleared") >= 8


def test_it_lives_much_longer_in_a_storm_than_one_that_stays_or_the_turret() -> None:
    seeds = range(20)
    life = lifetime("field-storm", seeds, "guardian")
    assert life >= 3 * lifetime("field-storm", seeds, STILL)
    assert life >= 1.5 * lifetime("field-storm", seeds, "turret")
