"""The laws on plain floats, against an oracle in rational arithmetic."""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache, partial
from itertools import pairwise
from math import (
    copysign,
    cos,
    hypot,
    inf,
    isinf,
    isnan,
    isqrt,
    ldexp,
    nan,
    nextafter,
    pi,
    sin,
    sqrt,
)
from math import ulp as spacing
from types import FrameType
from typing import Any, NamedTuple

import pytest

from fasteroids.physics import (
    NEVER,
    UNDECIDED,
    approaching,
    bounce,
    contact_time,
    contact_time_exact,
    contact_time_filtered,
    distance,
    limit_contact,
    limit_speed,
    sphere_mass,
    thrust,
    wall_time,
)
from fasteroids.units import ASTEROID_DENSITY, BULLET_DENSITY, SPEED_OF_LIGHT

Pair = tuple[float, float, float, float, float, float, float, float, float, float]

U = Fraction(1, 2**53)
SUBNORMAL = 5e-324
MAX = sys.float_info.max


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


# An oracle that shares nothing with the code: rationals, and a rational bracket of the square root.


class Truth(NamedTuple):
    """What is true of ten doubles."""

    hits: bool
    low: Fraction
    """The time lies in [low, high], a bracket so narrow that both ends round to one double."""
    high: Fraction
    blur: Fraction
    """cond t: the sum over the ten inputs z of |dt/dz| |z|."""

    @property
    def nearest(self) -> float:
        """The double nearest to the true time."""
        if not self.hits:
            return NEVER
        try:
            return float(self.high)
        except OverflowError:
            return inf


def root(value: Fraction, bits: int) -> tuple[Fraction, Fraction]:
    """Two rationals around the square root, equal if it is rational, else within 2^-bits of it, relatively."""
    n = value.numerator * value.denominator
    shift = max(0, bits - n.bit_length() // 2 + 1)
    low = isqrt(n << 2 * shift)
    exact = low * low == n << 2 * shift
    scale = value.denominator << shift
    return Fraction(low, scale), Fraction(low if exact else low + 1, scale)


def truth(pair: Pair) -> Truth:
    """By the text: r + v t touches s for the first time, if they approach; overlapping means now."""
    xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj = map(Fraction, pair)
    x, y, vx, vy, s = xj - xi, yj - yi, vxj - vxi, vyj - vyi, ri + rj
    a, b, c = vx * vx + vy * vy, vx * x + vy * y, x * x + y * y - s * s
    d = b * b - a * c
    never = Truth(False, Fraction(0), Fraction(0), Fraction(0))
    if b >= 0 or (c > 0 and d <= 0):
        return never
    bits = 120
    while True:
        narrow, wide = root(d, bits)
        low, high = c / (wide - b), c / (narrow - b)
        t = high
        fx, fy = abs(x + vx * t), abs(y + vy * t)
        blur = (
            fx * (abs(xi) + abs(xj))
            + fy * (abs(yi) + abs(yj))
            + abs(t) * (fx * (abs(vxi) + abs(vxj)) + fy * (abs(vyi) + abs(vyj)))
            + s * s
        ) / wide
        if c <= 0:
            return Truth(True, Fraction(0), Fraction(0), blur)
        result = Truth(True, low, high, blur)
        if narrow == wide or result.nearest == result._replace(high=low).nearest:
            return result
        bits *= 2


def scaled(pair: Pair, length: int, speed: int) -> Pair:
    """Lengths times 2^length, velocities times 2^speed."""
    n = (length, length, speed, speed, length) * 2
    return tuple(map(ldexp, pair, n))  # type: ignore[return-value]


def some_ulps(rng: random.Random, value: float) -> float:
    """The value, or a neighbour a few doubles away."""
    for _ in range(rng.choice((0, 0, 1, 1, 2, 7))):
        value = nextafter(value, rng.choice((-inf, inf)))
    return value


def ordinary(rng: random.Random) -> Pair:
    w, v = 1000.0, 300.0
    return (
        rng.uniform(0, w), rng.uniform(0, w), rng.uniform(-v, v), rng.uniform(-v, v), rng.uniform(1, 50),
        rng.uniform(0, w), rng.uniform(0, w), rng.uniform(-v, v), rng.uniform(-v, v), rng.uniform(1, 50),
    )  # fmt: skip


def aimed(rng: random.Random, far: float, impact: float, s: float, v: float = 100.0) -> Pair:
    """i flies at v past a resting j, which it sees at `far` ahead and `impact` to the side."""
    angle = rng.uniform(0, 2 * pi)
    c, n = cos(angle), sin(angle)
    x0, y0 = rng.uniform(-far, far), rng.uniform(-far, far)
    ri = rng.uniform(0, s)
    return (
        x0, y0, v * c, v * n, ri,
        x0 + far * c - impact * n, y0 + far * n + impact * c, 0.0, 0.0, s - ri,
    )  # fmt: skip


def grazing(rng: random.Random) -> Pair:
    s = rng.uniform(1, 100)
    depth = 2.0 ** -rng.randint(10, 60) * rng.choice((-1, 1))
    return aimed(rng, s * rng.uniform(1.5, 50), s * (1 + depth), s)


def tangent(rng: random.Random) -> Pair:
    """Exactly tangent along an axis, then moved by nothing, one ulp, or one subnormal."""
    ri, rj, far = rng.randint(1, 30), rng.randint(1, 30), rng.randint(100, 999)
    y = rng.randint(-500, 500)
    side = rng.choice((-1, 1))
    moved = [0.0, float(y), float(rng.randint(1, 300)), 0.0, float(ri)]
    moved += [float(far), float(y + side * (ri + rj)), 0.0, 0.0, float(rj)]
    for i in rng.choice(((), (1,), (6,), (4,), (9,), (3,), (1, 4))):
        moved[i] = nextafter(moved[i], rng.choice((-inf, inf)))
    pair: Pair = tuple(moved)  # type: ignore[assignment]
    if rng.random() < 0.5:
        xi, yi, vxi, vyi, ri_, xj, yj, vxj, vyj, rj_ = pair
        pair = yi, -xi, vyi, -vxi, ri_, yj, -xj, vyj, -vxj, rj_
    return pair


def touching(rng: random.Random) -> Pair:
    """Touching exactly by a Pythagorean triple, or a few ulps from it, in any motion."""
    p, q, s = rng.choice(((3, 4, 5), (5, 12, 13), (8, 15, 17), (20, 21, 29), (7, 0, 7)))
    k = rng.randint(1, 9)
    x, y, s = p * k * rng.choice((-1, 1)), q * k * rng.choice((-1, 1)), s * k
    ri = rng.randint(1, 2 * s - 1) / 2
    x0, y0 = rng.randint(-100, 100), rng.randint(-100, 100)
    v = [float(rng.randint(-9, 9)) for _ in range(4)]
    numbers = [x0, y0, v[0], v[1], ri, x0 + x, y0 + y, v[2], v[3], s - ri]
    return tuple(some_ulps(rng, float(n)) for n in numbers)  # type: ignore[return-value]


def overlapping(rng: random.Random) -> Pair:
    s = rng.uniform(1, 100)
    return aimed(
        rng, s * rng.uniform(0, 0.9), s * rng.uniform(-0.4, 0.4), s, rng.choice((-1, 1)) * 50.0
    )


def sideways(rng: random.Random) -> Pair:
    """Overlapping, and passing each other across the line of centres: v.r is nothing but rounding, or little more."""
    x, y, k = rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(0.1, 30)
    pair = [rng.uniform(0, 5), rng.uniform(0, 5), 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 0.0, 9.0]
    pair[5], pair[6] = pair[0] + x, pair[1] + y
    x, y = pair[5] - pair[0], pair[6] - pair[1]
    pair[7], pair[8] = some_ulps(rng, -k * y), some_ulps(rng, k * x)
    return tuple(pair)  # type: ignore[return-value]


def far_target(rng: random.Random) -> Pair:
    s = rng.uniform(1, 60)
    return aimed(rng, s * 10 ** rng.uniform(4, 15), s * rng.uniform(-1.5, 1.5), s)


def near_parallel(rng: random.Random) -> Pair:
    """A common speed near c, a relative one that is tiny against it."""
    angle = rng.uniform(0, 2 * pi)
    vx, vy = 2.9e5 * cos(angle), 2.9e5 * sin(angle)
    tiny = 10 ** -rng.uniform(1, 11)
    pair = list(ordinary(rng))
    pair[2], pair[3] = vx, vy
    pair[7] = vx + rng.uniform(-1, 1) * 2.9e5 * tiny
    pair[8] = vy + rng.uniform(-1, 1) * 2.9e5 * tiny
    return tuple(pair)  # type: ignore[return-value]


def unequal(rng: random.Random) -> Pair:
    pair = list(ordinary(rng))
    pair[rng.choice((4, 9))] *= 10 ** -rng.uniform(0, 15)
    return tuple(pair)  # type: ignore[return-value]


def lattice(rng: random.Random) -> Pair:
    """Small integers: exact ties of every kind."""
    pair = [float(rng.randint(-4, 4)) for _ in range(10)]
    pair[4], pair[9] = float(rng.randint(1, 3)), float(rng.randint(1, 3))
    return tuple(pair)  # type: ignore[return-value]


def bits(rng: random.Random) -> Pair:
    """Any exponents at all, subnormals and near overflow included."""

    def one() -> float:
        return ldexp(rng.uniform(-1, 1), rng.randint(-1074, 1023))

    pair = [one() for _ in range(10)]
    pair[4], pair[9] = abs(pair[4]) + SUBNORMAL, abs(pair[9]) + SUBNORMAL
    return tuple(pair)  # type: ignore[return-value]


KINDS = (
    ordinary, grazing, tangent, touching, overlapping, sideways, far_target, near_parallel, unequal, lattice, bits,
)  # fmt: skip
EACH = 300


@cache
def cases() -> tuple[tuple[str, Pair, Truth], ...]:
    """Hostile pairs of every kind, half of them at some other scale, each with the truth about it."""

    def draw() -> Iterator[tuple[str, Pair, Truth]]:
        for kind in KINDS:
            rng = random.Random(f"pairs of discs: {kind.__name__}")
            for n in range(EACH):
                pair = kind(rng)
                if n % 2 and kind is not bits:
                    pair = scaled(pair, rng.randint(-500, 400), rng.randint(-500, 400))
                yield kind.__name__, pair, truth(pair)

    return tuple(draw())


def test_the_cases_hit_and_miss_in_every_kind() -> None:
    for kind in KINDS:
        hits = [t.hits for name, _, t in cases() if name == kind.__name__]
        assert 5 <= sum(hits) <= EACH - 5, kind.__name__


def test_contact_time_is_of_the_right_class_and_near_enough() -> None:
    for name, pair, true in cases():
        t = contact_time(*pair)
        if true.nearest == inf:  # a miss, or a hit beyond all doubles
            assert t == NEVER, (name, pair)
        else:
            assert 0.0 <= t < inf, (name, pair)
            allowed = Fraction(spacing(true.nearest)) / 2 + 4 * U * true.blur
            assert true.low - allowed <= Fraction(t) <= true.high + allowed, (name, pair)


def test_contact_time_exact_is_the_nearest_double() -> None:
    for name, pair, true in cases():
        assert contact_time_exact(*pair) == true.nearest, (name, pair)


@pytest.mark.parametrize("y", [2.0**-1000, 2.0**-300, 2.0**-50, 2.0**-30])
def test_contact_time_exact_a_hair_above_a_tie(y: float) -> None:
    """Head-on the gap is 1 + 2^-53 km, half way between two doubles: to even. To the side it is longer."""
    head_on = -(2.0**-53), 0.0, 1.0, 0.0, 0.5, 2.0, 0.0, 0.0, 0.0, 0.5
    beside = -(2.0**-53), 0.0, 1.0, 0.0, 0.5, 2.0, y, 0.0, 0.0, 0.5
    assert contact_time_exact(*head_on) == 1.0 == truth(head_on).nearest
    assert contact_time_exact(*beside) == 1 + 2.0**-52 == truth(beside).nearest


def test_contact_time_exact_a_hair_below_a_tie() -> None:
    """s^2 - y^2 = 1 + 2^-102: the time is 2^-103 s less than 1 + 3/2^53, where the tie would be rounded up."""
    r, y = 0.5 + 2.0**-52, 2.0**-25
    pair = -3 * 2.0**-53, 0.0, 1.0, 0.0, r, 2.0, y, 0.0, 0.0, r
    assert contact_time_exact(*pair) == 1 + 2.0**-52 == truth(pair).nearest


def test_contact_time_filtered_is_never_wrong_when_it_decides() -> None:
    decided = 0
    for name, pair, true in cases():
        t = contact_time_filtered(*pair)
        if t == t:
            decided += 1
            assert (t < inf) == true.hits, (name, pair)
            assert t >= 0.0, (name, pair)
    assert decided > len(cases()) / 4


def undecided(kind: Callable[[random.Random], Pair], count: int = 2000) -> float:
    """The share of pairs of a kind that the filter leaves to the exact formula."""
    rng = random.Random(20130501)
    return sum(isnan(contact_time_filtered(*kind(rng))) for _ in range(count)) / count


def test_the_filter_is_not_always_exact() -> None:
    assert undecided(ordinary) < 0.001


def test_the_filter_is_not_never_exact() -> None:
    assert undecided(tangent) > 0.25
    assert isnan(UNDECIDED)


@pytest.mark.parametrize(
    ("pair", "seconds"),
    [
        ((0, 0, 0.6, 0.8, 3, 6e8, 8e8, 0, 0, 3), 999999994.0),
        ((0, 0, 150, 200, 3, 6e9 + 7, 8e9 - 3, 0, 0, 30), 39999999.88),
        ((1e160, 1e160, 200, 0, 1e158, 5e160, 1e160, -100, 0, 1e158), 1.3267e158),
        ((1e-170, 1e-170, 200, 0, 1e-172, 5e-170, 1e-170, -100, 0, 1e-172), 1.3267e-172),
        ((100, 100, 1e-170, 0, 10, 500, 100, -1e-170, 0, 10), 1.9e172),
    ],
    ids=["dead centre", "a fired bullet", "huge", "tiny", "slow"],
)
def test_contact_time_where_the_formula_of_the_text_fails(pair: Pair, seconds: float) -> None:
    pair = tuple(map(float, pair))  # type: ignore[assignment]
    true = truth(pair)
    assert true.nearest == pytest.approx(seconds, rel=1e-4)
    assert contact_time_exact(*pair) == true.nearest
    allowed = Fraction(spacing(true.nearest)) / 2 + 4 * U * true.blur
    assert abs(Fraction(contact_time(*pair)) - true.high) <= allowed


def swapped(pair: Pair) -> Pair:
    return pair[5:] + pair[:5]


def turned(pair: Pair) -> Pair:
    xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj = pair
    return -yi, xi, -vyi, vxi, ri, -yj, xj, -vyj, vxj, rj


def mirrored(pair: Pair) -> Pair:
    xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj = pair
    return -xi, yi, -vxi, vyi, ri, -xj, yj, -vxj, vyj, rj


def transposed(pair: Pair) -> Pair:
    xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj = pair
    return yi, xi, vyi, vxi, ri, yj, xj, vyj, vxj, rj


@pytest.mark.parametrize("motion", [swapped, turned, mirrored, transposed])
def test_contact_time_has_the_same_bits_by_symmetry(motion: Callable[[Pair], Pair]) -> None:
    for name, pair, _ in cases():
        one, two = contact_time_filtered(*pair), contact_time_filtered(*motion(pair))
        assert one == two or (isnan(one) and isnan(two)), (name, pair)


@pytest.mark.parametrize("wrong", [nan, inf, -inf])
@pytest.mark.parametrize("place", range(10))
def test_contact_time_of_numbers_that_are_none_is_an_answer(wrong: float, place: int) -> None:
    pair = [0.0, 0.0, 1.0, 0.0, 1.0, 10.0, 0.0, -1.0, 0.0, 1.0]
    pair[place] = wrong
    t = contact_time(*pair)
    assert t >= 0.0
    assert contact_time_exact(*pair) == NEVER


def test_contact_time_at_rest_apart_and_in_one_place() -> None:
    assert contact_time(0, 0, 5, 5, 1, 10, 0, 5, 5, 1) == NEVER
    assert contact_time(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0) == NEVER
    assert contact_time(0.0, 0.0, -1.0, 0.0, 1.0, 10.0, 0.0, 0.0, 0.0, 1.0) == NEVER


# Walls.


@pytest.mark.parametrize(
    ("x", "v", "seconds"),
    [
        (10.0, 5.0, 16.0),
        (10.0, -5.0, 2.0),
        (10.0, 0.0, NEVER),
        (10.0, -0.0, NEVER),
        (90.0, 5.0, 0.0),
        (95.0, 5.0, 0.0),
        (95.0, -5.0, 19.0),
        (-5.0, 5.0, 19.0),
        (-5.0, -5.0, 0.0),
        (10.0, SUBNORMAL, inf),
        (10.0, nan, NEVER),
    ],
)
def test_wall_time_is_that_of_the_wall_ahead(x: float, v: float, seconds: float) -> None:
    t = wall_time(x, v, 0.0, 90.0)
    assert t == seconds
    assert copysign(1.0, t) == 1.0


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


# The rest.


@pytest.mark.parametrize(
    ("v", "a", "dt", "after"),
    [
        ((8.0, 0.0), (256.0, 0.0), 0.5, (136.0, 0.0, False)),
        ((8.0, 3.0), (0.0, 0.0), 9.0, (8.0, 3.0, False)),
        ((0.0, 0.0), (600.0, 800.0), 1.0, (150.0, 200.0, True)),
        ((0.0, 0.0), (MAX, 0.0), 1000.0, (250.0, 0.0, True)),
    ],
)
def test_thrust(
    v: tuple[float, float], a: tuple[float, float], dt: float, after: tuple[float, float, bool]
) -> None:
    assert thrust(*v, *a, dt, 250.0) == after


def test_sphere_mass() -> None:
    # Five roundings.
    for density in (ASTEROID_DENSITY, BULLET_DENSITY):
        exact = Fraction(4, 3) * Fraction(pi) * 10**3 * Fraction(density)
        assert abs(Fraction(sphere_mass(10.0, density)) / exact - 1) <= 5 * U


@pytest.mark.parametrize("radius", [1e-108, 1e-90, 1e90, 1e97])
def test_sphere_mass_where_the_cube_alone_is_no_double(radius: float) -> None:
    exact = Fraction(4, 3) * Fraction(pi) * Fraction(radius) ** 3 * Fraction(ASTEROID_DENSITY)
    mass = sphere_mass(radius, ASTEROID_DENSITY)
    # Subnormal from 1e-107 km down: then the spacing of doubles is what may be asked.
    assert abs(Fraction(mass) - exact) <= 5 * U * exact + 3 * Fraction(spacing(float(exact)))


def test_sphere_mass_beyond_the_doubles() -> None:
    assert sphere_mass(1e100, ASTEROID_DENSITY) == inf
    assert sphere_mass(1e-120, ASTEROID_DENSITY) == 0.0
    sizes = [sphere_mass(10.0**k, ASTEROID_DENSITY) for k in range(-100, 98)]
    assert all(a < b for a, b in pairwise(sizes))


@pytest.mark.parametrize(
    ("x", "y", "vx", "vy", "closer"),
    [
        (1.0, 0.0, -1.0, 5.0, True),
        (1.0, 0.0, 1.0, 5.0, False),
        (1.0, 1.0, 1.0, -1.0, False),
        (0.0, 0.0, 1.0, 1.0, False),
        (1.0, 1.0, 0.0, 0.0, False),
        (1e-200, 0.0, -1e-200, 0.0, True),
        (1e200, 0.0, -1e200, 0.0, True),
        (SUBNORMAL, 0.0, -SUBNORMAL, 0.0, True),
        (MAX, MAX, -MAX, -MAX, True),
    ],
)
def test_approaching(x: float, y: float, vx: float, vy: float, closer: bool) -> None:
    assert approaching(x, y, vx, vy) is closer


@pytest.mark.parametrize(
    ("x", "y", "length"),
    [
        (3.0, -4.0, 5.0),
        (0.0, 0.0, 0.0),
        (3e200, 4e200, 5e200),
        (-0.0, SUBNORMAL, SUBNORMAL),
        (3 * 2.0**-1070, 4 * 2.0**-1070, 5 * 2.0**-1070),
        (MAX, MAX, inf),
        (inf, 0.0, inf),
        (-inf, 3.0, inf),
    ],
)
def test_distance(x: float, y: float, length: float) -> None:
    assert distance(x, y) == pytest.approx(length, rel=2 * float(U), abs=0)
    assert isinf(distance(x, y)) == isinf(length)


def test_distance_of_what_is_no_number_is_none() -> None:
    assert isnan(distance(nan, 1.0))
    assert isnan(distance(1.0, nan))
