"""Bounds and overlaps, with the margin that rounding earns."""

from __future__ import annotations

import random
from math import inf, nextafter, ulp

import pytest

from fasteroids import Asteroid, Bullet, Ship
from fasteroids.overlap import (
    Placed,
    depth,
    first_overlap,
    outside,
    overhang,
    own_bullet,
    slack,
)


def disc(x: float, y: float, r: float, v: float = 0.0, entity_id: int | None = None) -> Asteroid:
    return Asteroid(x, y, v, 0, r, id=entity_id)


def placed(*discs: Asteroid | Bullet | Ship) -> list[Placed]:
    return [Placed(d, slack(d, 0.0, 0.0)) for d in discs]


def sticks_out(p: Placed, size: float) -> bool:
    return outside(p, size, size)


def test_depth_is_how_deep_two_discs_overlap() -> None:
    assert depth(disc(0, 0, 3), disc(3, 4, 4)) == 2.0
    assert depth(disc(0, 0, 3), disc(3, 4, 2)) == 0.0
    assert depth(disc(0, 0, 1), disc(3, 4, 1)) == -3.0
    assert depth(disc(5, 5, 1), disc(5, 5, 2)) == 3.0


@pytest.mark.parametrize(
    ("x", "y", "r", "deep"),
    [
        (50, 50, 10, -40),
        (10, 50, 10, 0),
        (5, 50, 10, 5),
        (95, 50, 10, 5),
        (50, 198, 10, 8),
        (50, 2, 10, 8),
    ],
)
def test_overhang_is_how_far_a_disc_sticks_out(x: float, y: float, r: float, deep: float) -> None:
    assert overhang(disc(x, y, r), 100.0, 200.0) == deep


def test_slack_grows_with_the_numbers_and_is_never_a_literal() -> None:
    u = 2.0**-53
    assert slack(disc(100, 28, 10), 0.0, 0.0) == 16 * u * 138
    assert slack(disc(100e9, 28e9, 10e9), 0.0, 0.0) == 16 * u * 138e9
    assert slack(disc(100, 28, 10, 5.0), 4.0, 0.0) == 16 * u * 158
    assert slack(disc(100, 28, 10, 5.0), 0.0, 0.25) == 16 * u * 138 + 1.25
    assert slack(disc(100, 28, 10, 5.0), 0.0, 0.25, 8.0) == 16 * u * 138 + 2.0


def test_slack_of_a_bent_path_covers_the_velocity_it_gains() -> None:
    u = 2.0**-53
    e = disc(100, 28, 10, 5.0)
    assert slack(e, 4.0, 0.25, bend=0.0) == slack(e, 4.0, 0.25)
    assert slack(e, 4.0, 0.0, bend=3.0) == 16 * u * (138 + 4.0 * (5.0 + 2.0 * 12.0))
    assert slack(e, 4.0, 0.25, bend=3.0) == 16 * u * (138 + 4.0 * 29.0) + 29.0 * 0.25
    ship = Ship(100, 28, 5.0, 0.0, 10, 1.0, 0.0, max_speed=8.0)
    assert slack(ship, 4.0, 0.25, bend=1e9) == 16 * u * (138 + 4.0 * 37.0) + 37.0 * 0.25


def test_slack_is_a_handful_of_ulps() -> None:
    assert ulp(1000.0) <= slack(disc(1000, 1000, 10), 0.0, 0.0) <= 64 * ulp(1000.0)


def test_slack_of_a_place_near_the_largest_double_is_no_excuse() -> None:
    assert slack(disc(1.5e308, 1.5e308, 1), 0.0, 0.0) < inf
    assert sticks_out(placed(disc(1.5e308, 1.5e308, 1))[0], 1000.0)
    a, b = disc(1.5e308, 1.5e308, 1e307, entity_id=1), disc(1.5e308, 1.5e308, 1e307, entity_id=2)
    assert first_overlap([], placed(a, b)) is not None


def test_outside_is_beyond_the_slack() -> None:
    edge = disc(10, 50, 10)
    assert not sticks_out(Placed(edge, 0.0), 100.0)
    past = disc(nextafter(10.0, 0.0), 50, 10)
    assert sticks_out(Placed(past, 0.0), 100.0)
    assert not sticks_out(placed(past)[0], 100.0)
    assert sticks_out(placed(disc(9.999999, 50, 10))[0], 100.0)


def test_own_bullet_either_way_round() -> None:
    ship, shot = Ship(0, 0, 0, 0, 1, 1, 0, id=4), Bullet(0, 0, 0, 0, 1, 4, id=5)
    other = Ship(0, 0, 0, 0, 1, 1, 0, id=3)
    assert own_bullet(ship, shot)
    assert own_bullet(shot, ship)
    assert not own_bullet(other, shot)
    assert not own_bullet(shot, Bullet(0, 0, 0, 0, 1, 4, id=6))
    assert not own_bullet(ship, other)


def test_first_overlap_names_the_pair_the_new_one_first() -> None:
    old, new = disc(0, 0, 5, entity_id=1), disc(8, 0, 5, entity_id=2)
    assert first_overlap(placed(old), placed(new)) == (new, old)
    assert first_overlap(placed(new), placed(old)) == (old, new)


def test_first_overlap_looks_at_pairs_with_a_new_one_only() -> None:
    a, b = disc(0, 0, 5), disc(1, 0, 5)
    assert first_overlap(placed(a, b), []) is None
    assert first_overlap(placed(a, b), placed(disc(50, 0, 5))) is None
    assert first_overlap([], placed(a, b)) is not None


def test_first_overlap_exempts_a_ship_and_its_bullet() -> None:
    ship, shot = Ship(0, 0, 0, 0, 5, 1, 0, id=1), Bullet(1, 0, 0, 0, 3, 1, id=2)
    assert first_overlap(placed(ship), placed(shot)) is None
    assert first_overlap(placed(shot), placed(ship)) is None
    assert first_overlap(placed(Ship(0, 0, 0, 0, 5, 1, 0, id=3)), placed(shot)) is not None


def test_first_overlap_forgives_what_rounding_may_have_done() -> None:
    a = disc(0.1, 0.2, 5)
    touching = disc(nextafter(10.1, 0.0), 0.2, 5)
    assert depth(a, touching) > 0.0
    assert first_overlap(placed(a), placed(touching)) is None
    assert first_overlap(placed(a), placed(disc(10.09999, 0.2, 5))) is not None


def test_first_overlap_finds_one_if_and_only_if_there_is_one() -> None:
    rng = random.Random(12)
    found = 0
    for _ in range(400):
        discs = [
            disc(rng.uniform(0, 100), rng.uniform(0, 100), 10 ** rng.uniform(-1, 1))
            for _ in range(rng.randint(2, 9))
        ]
        cut = rng.randint(0, len(discs) - 1)
        old, new = placed(*discs[:cut]), placed(*discs[cut:])
        there = any(
            depth(p.entity, q.entity) > p.slack + q.slack
            for i, p in enumerate(new)
            for q in [*old, *new[:i]]
        )
        pair = first_overlap(old, new)
        assert (pair is not None) == there
        if pair is not None:
            found += 1
            assert depth(*pair) > 0.0
    assert 20 < found < 380
