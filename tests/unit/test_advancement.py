"""Contacts on curves without a closed form, against dense sampling with bisection."""

from __future__ import annotations

import random
from collections.abc import Callable
from math import atan2, cos, hypot, inf, isfinite, log, pi, sin, sqrt, tan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import advancement
from fasteroids.advancement import contact_time, safe_step, wall_time
from fasteroids.paths import Limited, Parabola, Path, falling_time, limited
from fasteroids.physics import NEVER, contact_time_exact, distance
from tests.unit.making import U

Disc = tuple[float, float, float, float, Path | None, float]

SAMPLES = 2000


# Looks are counted where each of them derives its tolerances.


class Looks:
    """How often a gap was looked at."""

    count = 0


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> Looks:
    counter, errors = Looks(), advancement._errors

    def counted(size: float, speed: float, pull: float, t: float) -> tuple[float, float]:
        counter.count += 1
        return errors(size, speed, pull, t)

    monkeypatch.setattr(advancement, "_errors", counted)
    return counter


# Brute force.


def at(disc: Disc, t: float) -> tuple[float, float]:
    x, y, vx, vy, path, _ = disc
    return path.after(x, y, vx, vy, t)[:2] if path else (x + vx * t, y + vy * t)


def gap_between(i: Disc, j: Disc) -> Callable[[float], float]:
    def gap(t: float) -> float:
        (xi, yi), (xj, yj) = at(i, t), at(j, t)
        return hypot(xj - xi, yj - yi) - (i[5] + j[5])

    return gap


def crossing(gap: Callable[[float], float], until: float) -> tuple[float, float]:
    """The first sampled fall through zero in [0, until], bisected, or inf; and the least gap sampled before."""
    before, lowest = 0.0, inf
    for n in range(1, SAMPLES + 1):
        t = until * n / SAMPLES
        if gap(t) <= 0.0 < gap(before):
            low, high = before, t
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if gap(middle) > 0.0 else (low, middle)
            return high, lowest
        before, lowest = t, min(lowest, gap(t))
    return inf, lowest


def disc(chance: random.Random, kind: str, radius: float) -> Disc:
    """A disc near the origin, on a limited path, a parabola or a straight line."""
    x, y = chance.uniform(-100.0, 100.0), chance.uniform(-100.0, 100.0)
    speed = chance.choice([1.0, 10.0, 60.0])
    aim = atan2(-y, -x) + chance.uniform(-1.0, 1.0)
    vx, vy = speed * cos(aim), speed * sin(aim)
    power = chance.choice([0.1, 1.0, 10.0, 60.0])
    if kind == "limited":
        turn = aim + chance.uniform(-pi / 2.0, pi / 2.0)
        return x, y, vx, vy, limited(vx, vy, power * cos(turn), power * sin(turn), speed), radius
    turn = chance.uniform(-pi, pi)
    bent = Parabola(power * cos(turn), power * sin(turn)) if kind == "parabola" else None
    return x, y, vx, vy, bent, radius


@pytest.mark.parametrize("other", ["straight", "limited", "parabola"])
@pytest.mark.parametrize("seed", range(40))
def test_contacts_agree_with_brute_force(other: str, seed: int, looks: Looks) -> None:
    chance = random.Random(f"{other} {seed}")
    i, j = disc(chance, "limited", 8.0), disc(chance, other, 12.0)
    gap, until = gap_between(i, j), 10.0
    while gap(0.0) <= 0.0:
        j = disc(chance, other, 12.0)
        gap = gap_between(i, j)
    want, lowest = crossing(gap, until)
    t = contact_time(*i, *j, until, parted=False)
    if (
        t < want and want - t > 1e-9
    ):  # sampling may miss a short dip, never find one that is not there
        assert lowest < 1.0
        assert abs(gap(t)) < 1e-10
        assert gap(t + 1e-7) < 0.0
    else:
        assert t == pytest.approx(want, abs=1e-9)
    assert contact_time(*j, *i, until, parted=False) == t
    assert looks.count <= 2 * 64


@pytest.mark.parametrize("seed", range(40))
def test_straight_pairs_are_those_of_the_exact_formula(seed: int) -> None:
    chance = random.Random(seed)
    i, j = disc(chance, "straight", 8.0), disc(chance, "straight", 12.0)
    still = (*i[:4], Parabola(0.0, 0.0), i[5])
    want = contact_time_exact(*i[:4], i[5], *j[:4], j[5])
    assert contact_time(*i, *j, inf, parted=False) == pytest.approx(want, rel=1e-13)
    assert contact_time(*still, *j, inf, parted=False) == pytest.approx(want, rel=1e-13)


@pytest.mark.parametrize("seed", range(200))
def test_searches_without_an_end_end(seed: int, looks: Looks) -> None:
    chance = random.Random(seed)
    i, j = disc(chance, "limited", 8.0), disc(chance, chance.choice(["limited", "none"]), 12.0)
    parted = chance.random() < 0.5
    t = contact_time(*i, *j, inf, parted=parted)
    gap = gap_between(i, j)
    want, _ = crossing(gap, 60.0)
    if t == NEVER:  # beyond 60 s all of them fly straight, and apart
        assert want == inf or parted or gap(0.0) <= 0.0
    elif not parted:
        assert isfinite(t)
        assert gap(t) < 1e-8
        assert gap(t + 1e-6 * (1.0 + t)) < gap(t)
        assert gap(0.0) <= 0.0 or t <= want + 1e-9
    assert looks.count <= 64


# Known contacts.


def turning(half: float, limit: float = 1.0, power: float = 1.0) -> Limited:
    return Limited(1.0, 0.0, limit, power, power / limit, half)


def test_a_ship_that_turns_towards_a_rock_meets_it() -> None:
    """From phi = pi / 2 it flies ln cosh t along x and nears y = pi / 2, where the rock rests."""
    ship: Disc = (0.0, 0.0, 0.0, 1.0, turning(1.0), 0.5)
    rock: Disc = (40.0, pi / 2.0, 0.0, 0.0, None, 0.5)
    assert contact_time(*ship, *rock, inf, parted=False) == pytest.approx(
        39.0 + log(2.0), rel=1e-14
    )


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("hits", [True, False])
def test_a_graze_is_seen(depth: float, hits: bool, looks: Looks) -> None:
    """The rock lies beyond the asymptote y = pi / 2, less or more than the radii away from it."""
    ship: Disc = (0.0, 0.0, 0.0, 1.0, turning(1.0), 0.5)
    rock: Disc = (50.0, pi / 2.0 + 1.0 + (-depth if hits else depth), 0.0, 0.0, None, 0.5)
    t = contact_time(*ship, *rock, inf, parted=False)
    touch = 50.0 - sqrt(depth * (2.0 - depth)) + log(2.0)
    assert t == (pytest.approx(touch, abs=1e-13 / sqrt(depth)) if hits else NEVER)
    assert looks.count <= 128


def formation(chance: random.Random) -> tuple[Disc, Disc]:
    """Two side by side at the limit, or next to it, whose thrusts are nearly the same: they drift slowly."""
    aim, spread = chance.uniform(0.0, 2.0 * pi), 10.0 ** chance.uniform(-6.0, -1.0)
    turn, away = aim + chance.uniform(-1.5, 1.5), chance.uniform(0.0, 2.0 * pi)
    gap = 10.0 ** chance.uniform(-6.0, -2.0)
    discs = []
    for n in (0.0, 1.0):
        here = aim + n * chance.choice([0.0, chance.uniform(-1.0, 1.0)]) * spread
        vx, vy = 250.0 * cos(here), 250.0 * sin(here)
        push = 220.0 * (1.0 + n * chance.choice([0.0, spread, -spread]))
        thrust = turn + n * chance.uniform(-1.0, 1.0) * spread
        path = limited(vx, vy, push * cos(thrust), push * sin(thrust), 250.0)
        x, y = n * (40.0 + gap) * cos(away), n * (40.0 + gap) * sin(away)
        discs.append((x, y, vx, vy, path, 20.0))
    return discs[0], discs[1]


@pytest.mark.parametrize("seed", range(60))
def test_a_formation_meets_when_it_should(seed: int, looks: Looks) -> None:
    """Found by attack: what two that bend alike might do each by itself is much, what they do is little."""
    i, j = formation(random.Random(seed))
    gap, until = gap_between(i, j), 8.0
    want, lowest = crossing(gap, until)
    t = contact_time(*i, *j, until, parted=False)
    if want < inf or t < inf:
        assert t <= want + 1e-6
        assert abs(gap(t)) < 1e-9
        assert t == pytest.approx(want, abs=1e-3) or lowest < 1e-9
    assert looks.count <= 160


def test_a_gap_beyond_the_doubles_never_closes() -> None:
    """An acceleration of 1e-300 km/s^2 at the limit: the next look would be 1e305 s ahead."""
    path = limited(212132.0, 212132.0, -7e-301, 7e-301, distance(212132.0, 212132.0))
    assert wall_time(path, 5e8, 5e8, 212132.0, 212132.0, 1.0, 0.0, 1e6) == NEVER
    assert wall_time(path, 5e8, 5e8, 212132.0, 212132.0, -1.0, 0.0, -1e9) == pytest.approx(
        5e8 / 212132.0
    )


@pytest.mark.parametrize("speed", [0.01, 1.0])
def test_a_slow_graze_on_a_strong_bend_ends(speed: float, looks: Looks) -> None:
    """Thrust along a common tangent bends nothing towards the rock, but the second-order bound does not know it."""
    rock: Disc = (0.0, 0.0, 0.0, 0.0, None, 500.0)
    for above, hits in ((0.0, None), (1e-6, False), (-1e-6, True)):
        ship: Disc = (-3.0, 1000.0 + above, speed, 0.0, Parabola(220.0, 0.0), 500.0)
        looks.count = 0
        t = contact_time(*ship, *rock, 100.0, parted=False)
        assert t == NEVER or abs(gap_between(ship, rock)(t)) < 1e-9
        assert hits is None or (t < NEVER) == hits
        assert looks.count <= 200


def test_until_is_the_end() -> None:
    ship: Disc = (0.0, 0.0, 0.0, 1.0, turning(1.0), 0.5)
    rock: Disc = (40.0, pi / 2.0, 0.0, 0.0, None, 0.5)
    assert contact_time(*ship, *rock, 39.0, parted=False) == NEVER
    assert contact_time(*ship[:4], None, 0.5, 0.0, 9.0, 0.0, 0.0, None, 0.5, 7.0, False) == NEVER


# Touching at the start.


def hop(vx: float, ax: float) -> tuple[Disc, Disc]:
    """A rock and, touching it on the right, a ship that leaves at vx and is pulled at ax."""
    return (0.0, 0.0, 0.0, 0.0, None, 1.0), (3.0, 0.0, vx, 0.0, Parabola(ax, 0.0), 2.0)


@pytest.mark.parametrize("parted", [True, False])
def test_a_ship_that_bounced_off_falls_back_after_2_v_by_a(parted: bool) -> None:
    i, j = hop(0.5, -0.25)
    assert contact_time(*i, *j, 100.0, parted=parted) == pytest.approx(4.0, rel=1e-12)
    assert contact_time(*j, *i, 100.0, parted=parted) == contact_time(*i, *j, 100.0, parted=parted)


def test_touching_and_approaching_is_now() -> None:
    i, j = hop(-0.5, 1.0)
    assert contact_time(*i, *j, 100.0, parted=False) == 0.0


@pytest.mark.parametrize("v", [0.0, -1e-17, -0.5])
def test_a_pair_that_bounced_and_presses_is_in_contact_at_once(v: float) -> None:
    i, j = hop(v, -1.0)
    assert contact_time(*i, *j, 100.0, parted=True) == 0.0


@pytest.mark.parametrize("v", [0.0, -1e-17, 0.5])
def test_a_pair_that_bounced_and_is_pulled_apart_never_meets(v: float) -> None:
    i, j = hop(v, 1.0)
    assert contact_time(*i, *j, 100.0, parted=True) == NEVER


def test_a_straight_pair_that_bounced_never_meets() -> None:
    i, j = hop(-1e-17, 0.0)
    assert contact_time(*i, *j, 100.0, parted=True) == NEVER


def test_limited_ships_that_bounced_press_by_the_thrust_across() -> None:
    """Side by side at one speed, the thrust of the upper one points down: all of it is across."""
    lower: Disc = (0.0, 0.0, 5.0, 0.0, None, 1.0)
    for power in (1.0, -1.0):
        upper: Disc = (0.0, 2.0, 5.0, 0.0, limited(5.0, 0.0, 0.0, -power, 5.0), 1.0)
        t = contact_time(*lower, *upper, 100.0, parted=True)
        assert t == (0.0 if power > 0.0 else NEVER)


def test_overlapping_and_receding_discs_meet_when_they_turn() -> None:
    i, j = hop(0.5, -0.25)
    j = (2.0, *j[1:])  # the ship rises by 0.5 km in 2 s and is then still inside
    assert contact_time(*i, *j, 100.0, parted=False) == pytest.approx(2.0, abs=1e-5)


def test_concentric_discs_are_looked_at() -> None:
    i, j = hop(0.5, -0.25)
    j = (0.0, *j[1:])
    assert contact_time(*i, *j, 100.0, parted=False) == pytest.approx(2.0, abs=1e-5)


# Walls.


@pytest.mark.parametrize(("nx", "ny"), [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
@pytest.mark.parametrize("seed", range(20))
def test_walls_agree_with_brute_force(nx: float, ny: float, seed: int, looks: Looks) -> None:
    x, y, vx, vy, path, _ = ship = disc(random.Random(seed), "limited", 0.0)
    wall = -103.0

    def gap(t: float) -> float:
        px, py = at(ship, t)
        return nx * px + ny * py - wall

    want, _ = crossing(gap, 100.0)
    t = wall_time(path, x, y, vx, vy, nx, ny, wall)
    if want < inf or t <= 100.0:
        assert t == pytest.approx(want, abs=1e-9)
    assert wall_time(path, x, y, vx, vy, nx, ny, wall, 0.5 * min(t, 1e3)) == NEVER
    assert looks.count <= 64


@pytest.mark.parametrize("gap", [0.0, 1e-14, -1e-14])
def test_at_a_wall_and_falling_is_now(gap: float) -> None:
    assert wall_time(turning(1.0), 0.0, 90.0 + gap, 0.0, -1.0, 0.0, 1.0, 90.0) == 0.0


def test_at_a_wall_and_rising_the_ship_may_come_back() -> None:
    """Thrust downwards turns a rising ship until it falls back to the wall; thrust along the wall never does."""
    across = Limited(0.0, -1.0, 1.0, 1.0, 1.0, tan(2.5 / 2.0))
    vx, vy = sin(2.5), -cos(2.5)
    t = wall_time(across, 0.0, 0.0, vx, vy, 0.0, 1.0, 0.0)
    assert t > 0.1
    assert abs(across.after(0.0, 0.0, vx, vy, t)[1]) < 1e-14
    assert wall_time(turning(1.0), 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0) == NEVER


def test_a_ship_that_nears_a_line_never_meets_a_wall_beyond_it() -> None:
    """It nears y = pi / 2 from below."""
    path = turning(1.0)
    assert wall_time(path, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, -pi / 2.0 - 1e-12) == NEVER
    assert wall_time(path, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, -1.5) < inf


@given(st.floats(0.0, 100.0), st.floats(-10.0, 10.0), st.floats(-10.0, -0.01))
def test_on_a_parabola_the_closed_form_is_found(gap: float, v: float, a: float) -> None:
    t = wall_time(Parabola(0.0, a), 0.0, gap, 0.0, v, 0.0, 1.0, 0.0, 1e6)
    want = falling_time(gap, v, a)
    slope = sqrt(v * v - 2.0 * a * gap)
    way = gap + (abs(v) - a * want) * want
    assert abs(t - want) * slope <= 64.0 * U * way + 1e-290


# Lengths near the end of the doubles.


def test_far_apart_is_no_contact_though_the_sum_of_the_coordinates_is_no_double() -> None:
    away = limited(3e5, 0.0, 1.0, 0.0, 3e5)
    back = limited(-3e5, 0.0, -1.0, 0.0, 3e5)
    i: Disc = (8e307, 8e307, 3e5, 0.0, away, 1e300)
    j: Disc = (1.6e308, 8e307, -3e5, 0.0, back, 1e300)
    assert contact_time(*i, *j, inf, parted=False) == pytest.approx(8e307 / 6e5, rel=1e-6)


def test_far_from_a_wall_is_not_at_it_though_the_sum_of_the_coordinates_is_no_double() -> None:
    path = limited(3e5, 0.0, 1.0, 0.0, 3e5)
    t = wall_time(path, 1.6e308, 5.0, 3e5, 0.0, -1.0, 0.0, -1.7e308)
    assert t == pytest.approx(1e307 / 3e5, rel=1e-12)


# The step.


@given(st.floats(0.0, 1e6), st.floats(-1e6, 1e6), st.floats(1e-6, 1e6))
def test_the_step_solves_its_equation(gap: float, rate: float, bend: float) -> None:
    h = safe_step(gap, rate, bend)
    terms = gap + abs(rate) * h + 0.5 * bend * h * h
    assert abs(gap + rate * h - 0.5 * bend * h * h) <= 16.0 * U * terms + 1e-300


def test_steps_without_a_bend() -> None:
    assert safe_step(6.0, -2.0, 0.0) == 3.0
    assert safe_step(6.0, 0.0, 0.0) == inf
    assert safe_step(0.0, 2.0, 0.0) == inf
    assert safe_step(0.0, -2.0, 0.0) == 0.0
    assert safe_step(0.0, -2.0, 1.0) == 0.0
    assert safe_step(0.0, 3.0, 2.0) == 3.0


@pytest.mark.parametrize("gap", [0.0, 5e-324, 1.0, 1e308, inf])
@pytest.mark.parametrize("rate", [-1e308, -1.0, 0.0, 1.0, 1e308])
@pytest.mark.parametrize("bend", [0.0, 5e-324, 1.0, 1e308, inf])
def test_steps_are_never_nan(gap: float, rate: float, bend: float) -> None:
    assert safe_step(gap, rate, bend) >= 0.0
