"""What changes velocities: bounces, speed limits, and thrust."""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from math import cos, hypot, inf, ldexp, nan, pi, sin, sqrt
from math import ulp as spacing
from types import FrameType
from typing import Any

import pytest

from fasteroids.physics import approaching, bounce, limit_contact, limit_speed, thrust
from fasteroids.units import SPEED_OF_LIGHT
from tests.unit.making import MAX, SUBNORMAL, U


def soon(what: Callable[[], Any], lines: int = 20_000) -> Any:
    """What `what` returns; fails if it runs more than so many lines of Python (a hang, without a clock)."""
    left = lines

    def count(_frame: FrameType, event: str, _arg: Any) -> Any:
        nonlocal left
        left -= event == "line"
        if left < 0:
            raise AssertionError(f"still not done after {lines} lines of Python")
        return count

    before = sys.gettrace()
    sys.settrace(count)
    try:
        return what()
    finally:
        sys.settrace(before)


# Bounces.


def defect(
    mi: float, mj: float, old: tuple[float, ...], new: tuple[float, ...]
) -> tuple[Fraction, Fraction]:
    """Change of momentum and of energy in units of u of the sums of m |v| and of m v^2, before and after."""
    m = [Fraction(mi), Fraction(mi), Fraction(mj), Fraction(mj)]
    v, w = list(map(Fraction, old)), list(map(Fraction, new))
    hot, then = (sum((a * b * b for a, b in zip(m, c, strict=True)), Fraction(0)) for c in (v, w))
    fast = sum((a * (abs(b) + abs(c)) for a, b, c in zip(m, v, w, strict=True)), Fraction(0))
    px, py = (m[k] * (w[k] - v[k]) + m[k + 2] * (w[k + 2] - v[k + 2]) for k in (0, 1))
    return max(abs(px), abs(py)) / (U * fast), abs(then - hot) / (U * (hot + then))


def bounces(count: int = 1500) -> Iterator[tuple[float, ...]]:
    """(x, y, vxi, vyi, mi, vxj, vyj, mj) of approaching discs, of like and of very unlike masses."""
    rng = random.Random(1687)
    while count:
        scale = rng.choice((0, 0, -500, 400))
        x, y = (ldexp(rng.uniform(-100, 100), scale) for _ in range(2))
        v = [rng.uniform(-300, 300) for _ in range(4)]
        mi, mj = (10 ** rng.choice((rng.uniform(10, 20), rng.uniform(-290, 290))) for _ in range(2))
        if approaching(x, y, v[2] - v[0], v[3] - v[1]):
            count -= 1
            yield x, y, v[0], v[1], mi, v[2], v[3], mj


def test_bounce_keeps_energy_and_momentum() -> None:
    for case in bounces():
        _, _, vxi, vyi, mi, vxj, vyj, mj = case
        momentum, energy = defect(mi, mj, (vxi, vyi, vxj, vyj), bounce(*case))
        assert momentum <= 8, case
        assert energy <= 8, case


def test_bounce_turns_approach_into_flight() -> None:
    for case in bounces():
        x, y, *_ = case
        vxi, vyi, vxj, vyj = bounce(*case)
        assert not approaching(x, y, vxj - vxi, vyj - vyi), case


def test_bounce_has_the_same_bits_by_symmetry() -> None:
    for x, y, a, b, m, c, d, n in bounces():
        w, h, p, q = bounce(x, y, a, b, m, c, d, n)
        assert bounce(-x, -y, c, d, n, a, b, m) == (p, q, w, h)  # the other one first
        assert bounce(-x, y, -a, b, m, -c, d, n) == (-w, h, -p, q)  # mirror
        assert bounce(-y, x, -b, a, m, -d, c, n) == (-h, w, -q, p)  # quarter turn
        assert bounce(y, x, b, a, m, d, c, n) == (h, w, q, p)  # axes


def test_bounce_of_equals_swaps_the_components_along_the_line() -> None:
    assert bounce(20.0, 0.0, 30.0, 7.0, 5.0, -10.0, 2.0, 5.0) == (-10.0, 7.0, 30.0, 2.0)


def test_bounce_by_the_formula_of_the_text() -> None:
    x, y, s, mi, mj = 30.0, 40.0, 50.0, 2e15, 6e15
    vxi, vyi, vxj, vyj = 10.0, 20.0, -30.0, 5.0
    j = 2 * mi * mj * ((vxj - vxi) * x + (vyj - vyi) * y) / (s * (mi + mj))
    jx, jy = j * x / s, j * y / s
    after = vxi + jx / mi, vyi + jy / mi, vxj - jx / mj, vyj - jy / mj
    # Each side rounds some ten times at the scale of the speeds, 100 km/s.
    for ours, text in zip(bounce(x, y, vxi, vyi, mi, vxj, vyj, mj), after, strict=True):
        assert abs(ours - text) <= 20 * spacing(100.0)


@pytest.mark.parametrize(
    ("x", "y", "v"), [(1.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 5.0), (0.0, 0.0, -1.0)]
)
def test_bounce_changes_nothing_without_approach(x: float, y: float, v: float) -> None:
    assert bounce(x, y, 0.0, 0.0, 1.0, v, 0.0, 1.0) == (0.0, 0.0, v, 0.0)


@pytest.mark.parametrize("mass", [SUBNORMAL, 1e-170, 1e200, MAX])
def test_bounce_of_masses_whose_product_is_no_double(mass: float) -> None:
    assert bounce(1.0, 0.0, 10.0, 0.0, mass, -10.0, 0.0, mass) == (-10.0, 0.0, 10.0, 0.0)


def test_bounce_off_what_is_heavier_than_any_ratio() -> None:
    assert bounce(1.0, 0.0, 10.0, 3.0, 1e-290, -20.0, 0.0, 1e290) == (-50.0, 3.0, -20.0, 0.0)


# Speed limits.

LIMITS = (SPEED_OF_LIGHT, 250.0, 1.0, 1e-3, 1e-100, 1e-150, 1e100)


def velocities(count: int = 400) -> Iterator[tuple[float, float]]:
    rng = random.Random(299792)
    for _ in range(count):
        size = 10 ** rng.choice((rng.uniform(0, 7), rng.uniform(-300, 308)))
        angle = rng.choice((rng.uniform(0, 2 * pi), rng.randint(0, 8) * pi / 4))
        yield size * cos(angle), size * sin(angle)


@pytest.mark.parametrize("limit", LIMITS)
def test_limit_speed_never_exceeds_it_as_computed(limit: float) -> None:
    clipped = 0
    for vx, vy in velocities():
        wx, wy = limit_speed(vx, vy, limit)
        assert sqrt(wx * wx + wy * wy) <= limit, (vx, vy)
        if sqrt(vx * vx + vy * vy) <= limit:
            assert (wx, wy) == (vx, vy)
        else:
            clipped += 1
    assert clipped > 40


def test_limit_speed_keeps_the_direction_and_gives_little_away() -> None:
    for vx, vy in velocities():
        wx, wy = limit_speed(vx, vy, 250.0)
        if (wx, wy) != (vx, vy):
            across = Fraction(vx) * Fraction(wy) - Fraction(vy) * Fraction(wx)
            size = (abs(Fraction(vx)) + abs(Fraction(vy))) * 250
            assert abs(across) <= 8 * U * size, (vx, vy)
            assert sqrt(wx * wx + wy * wy) >= 250.0 - 8 * spacing(250.0), (vx, vy)
            assert wx * vx >= 0.0, (vx, vy)
            assert wy * vy >= 0.0, (vx, vy)


@pytest.mark.parametrize(
    ("vx", "vy", "after"),
    [
        (nan, 5.0, (0.0, 5.0)),
        (5.0, nan, (5.0, 0.0)),
        (nan, nan, (0.0, 0.0)),
        (inf, 0.0, (250.0, 0.0)),
        (-inf, nan, (-250.0, 0.0)),
        (1e308, -inf, (0.0, -250.0)),
        (3e5, 4e5, (150.0, 200.0)),
        (-MAX, 0.0, (-250.0, 0.0)),
        (150.0, 200.0, (150.0, 200.0)),
    ],
)
def test_limit_speed_is_total(vx: float, vy: float, after: tuple[float, float]) -> None:
    assert limit_speed(vx, vy, 250.0) == after


def test_limit_speed_of_two_infinities_is_a_diagonal() -> None:
    vx, vy = limit_speed(inf, -inf, 250.0)
    assert vx == -vy > 176.0
    assert sqrt(vx * vx + vy * vy) <= 250.0


@pytest.mark.parametrize("v", [(3.0, 4.0), (-1e300, 1.0), (inf, 1.0), (nan, 2.0), (1e-300, 1.0)])
def test_limit_speed_of_nought_stops(v: tuple[float, float]) -> None:
    assert limit_speed(*v, 0.0) == (0.0, 0.0)


@pytest.mark.parametrize("v", [(3.0, 4.0), (1.0, 1.0), (1.0, 0.3), (300.0, -7e-9)])
def test_limit_speed_ends_where_squares_are_subnormal(v: tuple[float, float]) -> None:
    for exponent in (*range(-170, -150), -310, -323):
        for digits in ("1", "1.3", "2", "3.7", "6.25"):
            limit = float(f"{digits}e{exponent}")
            vx, vy = soon(partial(limit_speed, *v, limit))
            assert sqrt(vx * vx + vy * vy) <= limit


def test_limit_contact_leaves_what_fits() -> None:
    assert limit_contact(1.0, 0.0, -5.0, 1.0, 10.0, 7.0, 2.0, 10.0) == (
        -5.0, 1.0, 7.0, 2.0, False, False,
    )  # fmt: skip


def test_limit_contact_clips_and_keeps_the_direction() -> None:
    assert limit_contact(1.0, 0.0, -300.0, -400.0, 250.0, 7.0, 2.0, 10.0) == (
        -150.0, -200.0, 7.0, 2.0, True, False,
    )  # fmt: skip


def test_limit_contact_still_approaching_takes_the_partners_component() -> None:
    """i was pushed ahead of j, but its limit scales it back to less than j's 180 along the line."""
    vxi, vyi, vxj, vyj, ci, cj = limit_contact(-1.0, 0.0, 200.0, 100.0, 189.0, 180.0, 0.0, 300.0)
    assert (vxi, vxj, vyj) == (180.0, 180.0, 0.0)
    assert (ci, cj) == (True, False)
    room = sqrt(189.0**2 - 180.0**2)
    assert sqrt(vxi * vxi + vyi * vyi) <= 189.0
    # d(room) = 189 / room d(limit): a few ulps of the limit.
    assert abs(vyi - room) <= 8 * 189.0 / room * spacing(189.0)


def test_limit_contact_too_slow_for_its_partner_stops_it() -> None:
    assert limit_contact(1.0, 0.0, 100.0, 3.0, 300.0, 200.0, 0.0, 10.0) == (
        10.0, 3.0, 10.0, 0.0, False, True,
    )  # fmt: skip


def test_limit_contact_with_an_immovable_one() -> None:
    assert limit_contact(1.0, 0.0, 50.0, 3.0, 300.0, 150.0, 0.0, 0.0) == (
        0.0, 3.0, 0.0, 0.0, False, True,
    )  # fmt: skip


def clips(count: int = 3000) -> Iterator[tuple[float, ...]]:
    """Bounces with limits of which one or both are broken; the limits are mostly unlike."""
    rng = random.Random(88)
    while count:
        angle = rng.uniform(0, 2 * pi)
        x, y = 40 * cos(angle), 40 * sin(angle)
        li, lj = (rng.choice((300.0, rng.uniform(1, 300), rng.uniform(0, 5))) for _ in range(2))
        vi = limit_speed(rng.uniform(-300, 300), rng.uniform(-300, 300), li)
        vj = limit_speed(rng.uniform(-300, 300), rng.uniform(-300, 300), lj)
        mi, mj = (10 ** rng.uniform(0, 6) for _ in range(2))
        after = bounce(x, y, *vi, mi, *vj, mj)
        a, b, c, d = after
        if sqrt(a * a + b * b) > li or sqrt(c * c + d * d) > lj:
            count -= 1
            yield x, y, *after[:2], li, *after[2:], lj


def test_limit_contact_fits_and_does_not_approach() -> None:
    for case in clips():
        x, y, *_ = case
        li, lj = case[4], case[7]
        vxi, vyi, vxj, vyj, ci, cj = limit_contact(*case)
        assert ci or cj
        assert sqrt(vxi * vxi + vyi * vyi) <= li, case
        assert sqrt(vxj * vxj + vyj * vyj) <= lj, case
        # Along the line they may differ by rounding, some ulps of the speeds there.
        along = ((vxj - vxi) * x + (vyj - vyi) * y) / hypot(x, y)
        assert along >= -16 * spacing(max(li, lj)), case


def test_limit_contact_has_the_same_limits_whoever_comes_first() -> None:
    for x, y, a, b, li, c, d, lj in clips(500):
        w, h, p, q, ci, cj = limit_contact(x, y, a, b, li, c, d, lj)
        assert limit_contact(-x, -y, c, d, lj, a, b, li) == (p, q, w, h, cj, ci)


# Thrust.


@pytest.mark.parametrize(
    ("v", "a", "dt", "after"),
    [
        ((8.0, 0.0), (256.0, 0.0), 0.5, (136.0, 0.0, False)),
        ((8.0, 3.0), (0.0, 0.0), 9.0, (8.0, 3.0, False)),
        ((0.0, 0.0), (600.0, 800.0), 1.0, (150.0, 200.0, True)),
        ((0.0, 0.0), (MAX, 0.0), 1000.0, (250.0, 0.0, True)),
        ((9.0, 9.0), (-3.0, 4.0), MAX, (-150.0, 200.0, True)),
        ((9.0, 9.0), (0.75 * MAX, MAX), 2.0, (150.0, 200.0, True)),
    ],
)
def test_thrust(
    v: tuple[float, float], a: tuple[float, float], dt: float, after: tuple[float, float, bool]
) -> None:
    assert thrust(*v, *a, dt, 250.0) == after
