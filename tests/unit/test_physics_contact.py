"""When discs meet each other and walls, against an oracle in rational arithmetic."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from math import copysign, cos, inf, isnan, isqrt, ldexp, nan, nextafter, pi, sin
from math import ulp as spacing
from typing import NamedTuple

import pytest

from fasteroids.models import robust
from fasteroids.physics import (
    NEVER,
    UNDECIDED,
    contact_time_exact,
    contact_time_filtered,
    wall_time,
)
from tests.unit.making import SUBNORMAL, U

Pair = tuple[float, float, float, float, float, float, float, float, float, float]


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
        t = robust.MODEL.contact_time(*pair)
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
    assert abs(Fraction(robust.MODEL.contact_time(*pair)) - true.high) <= allowed


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
    t = robust.MODEL.contact_time(*pair)
    assert t >= 0.0
    assert contact_time_exact(*pair) == NEVER


def test_contact_time_at_rest_apart_and_in_one_place() -> None:
    assert robust.MODEL.contact_time(0, 0, 5, 5, 1, 10, 0, 5, 5, 1) == NEVER
    assert robust.MODEL.contact_time(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0) == NEVER
    assert robust.MODEL.contact_time(0.0, 0.0, -1.0, 0.0, 1.0, 10.0, 0.0, 0.0, 0.0, 1.0) == NEVER


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
