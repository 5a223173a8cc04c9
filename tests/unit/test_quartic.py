"""Contact times under constant acceleration: known answers, the filter against the exact formula, symmetries."""

from __future__ import annotations

import random
from decimal import Decimal, localcontext
from fractions import Fraction
from math import cos, inf, isinf, isnan, nan, nextafter, pi, sin, sqrt, ulp

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fasteroids import physics
from fasteroids.quartic import contact_time, contact_time_exact, contact_time_filtered

U = 2.0**-53
LONG = 1e6

Pair = tuple[
    float, float, float, float, float, float, float,
    float, float, float, float, float, float, float,
    float, bool,
]  # fmt: skip


def seen(x, y, vx, vy, ax, ay, s, until=LONG, parted=False) -> Pair:
    """j seen from an i of radius s / 2 that rests at the origin."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, s / 2, x, y, vx, vy, ax, ay, s / 2, until, parted)


def check(pair: Pair) -> float:
    """The exact time, after the filter's answer has been compared with it: class, and error bound."""
    t = contact_time_exact(*pair)
    filtered = contact_time_filtered(*pair)
    together = contact_time(*pair)
    if isnan(filtered):
        assert together == t
    else:
        assert together == filtered
        assert isinf(filtered) == isinf(t)
        assert (filtered == 0.0) == (t == 0.0)
        if 0.0 < t < inf:
            error = abs(Fraction(filtered) - Fraction(t))
            assert error <= Fraction(ulp(t)) + 16 * Fraction(U) * condition(pair, t)
    return t


def condition(pair: Pair, time: float) -> Fraction:
    """Sum of |dt/dz| |z| over the fourteen inputs, at a falling root."""
    (xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj), t = (
        [Fraction(z) for z in pair[:14]],
        Fraction(time),
    )
    slope, total = Fraction(0), Fraction(0)
    for zi, zj, wi, wj, hi, hj in ((xi, xj, vxi, vxj, axi, axj), (yi, yj, vyi, vyj, ayi, ayj)):
        r = zj - zi + (wj - wi) * t + (hj - hi) * t * t / 2
        slope += 2 * r * (wj - wi + (hj - hi) * t)
        total += 2 * abs(r) * (abs(zi) + abs(zj))
        total += abs(r) * (2 * t * (abs(wi) + abs(wj)) + t * t * (abs(hi) + abs(hj)))
    total += 2 * abs(ri + rj) * (abs(ri) + abs(rj))
    return total / abs(slope)


def gap(pair: Pair, t: Fraction) -> Fraction:
    """p(t), exactly."""
    xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj = map(Fraction, pair[:14])
    rx = xj - xi + (vxj - vxi) * t + (axj - axi) * t * t / 2
    ry = yj - yi + (vyj - vyi) * t + (ayj - ayi) * t * t / 2
    return rx * rx + ry * ry - (ri + rj) ** 2


def ordinary(rng: random.Random) -> Pair:
    """Two ships and asteroids of everyday size, not overlapping; one in four has just bounced."""
    while True:
        one, two = (
            (rng.uniform(0, 800), rng.uniform(0, 600), rng.uniform(-50, 50), rng.uniform(-50, 50),
             rng.uniform(-10, 10), rng.uniform(-10, 10), rng.uniform(5, 25))
            for _ in range(2)
        )  # fmt: skip
        away = sqrt((two[0] - one[0]) ** 2 + (two[1] - one[1]) ** 2)
        s = one[6] + two[6]
        if away <= 1.001 * s:
            continue
        parted = rng.random() < 0.25
        if parted:
            x = one[0] + (two[0] - one[0]) * s / away
            y = one[1] + (two[1] - one[1]) * s / away
            two = (x, y, *two[2:])
            if (x - one[0]) * (two[2] - one[2]) + (y - one[1]) * (two[3] - one[3]) < 0.0:
                two = (x, y, 2 * one[2] - two[2], 2 * one[3] - two[3], *two[4:])
        return (*one, *two, rng.uniform(0.1, 60.0), parted)


def aimed(rng: random.Random, depth: float) -> tuple[Pair, float]:
    """A pair whose path comes nearest to s - depth, at a known time: a parabola through its vertex, shifted in time."""
    s, at = rng.uniform(0.5, 20.0), rng.uniform(0.5, 5.0)
    angle = rng.uniform(0, 2 * pi)
    nx, ny = cos(angle), sin(angle)
    speed, pull = rng.uniform(1.0, 20.0), rng.uniform(0.0, 3.0)
    # At the vertex: (s - depth) n, moving across n, accelerating along n (outwards, so it is the nearest point).
    x, y = (s - depth) * nx, (s - depth) * ny
    vx, vy, ax, ay = -speed * ny, speed * nx, pull * nx, pull * ny
    x, y = x - vx * at + ax * at * at / 2, y - vy * at + ay * at * at / 2
    return seen(x, y, vx - ax * at, vy - ay * at, ax, ay, s, 20.0), at


# --- known answers ----------------------------------------------------------------------------------------------


def test_thrown_up_and_back():
    # From 3 up at 4 and back at acceleration -2: gap 1 (s = 2) again falls to 0 at 1 + 4 t - t^2 = 0.
    assert check(seen(3.0, 0.0, 4.0, 0.0, -2.0, 0.0, 2.0)) == 2.0 + sqrt(5.0)


def test_head_on_from_rest():
    assert check(seen(10.0, 0.0, 0.0, 0.0, -4.0, 0.0, 2.0)) == 2.0


def test_a_parabola_over_the_disc_misses_or_hits():
    assert check(seen(-10.0, 0.0, 10.0, 10.0, 0.0, -10.0, 2.0)) == inf  # at its height over i
    assert check(seen(-20.0, 0.0, 10.0, 10.0, 0.0, -10.0, 2.0)) < 2.0  # comes down on it


def test_no_relative_motion():
    assert check(seen(3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0)) == inf
    assert check(seen(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0)) == inf
    assert check(seen(2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, parted=True)) == inf


def test_touching_only_is_a_miss():
    assert check(seen(5.0, 2.0, -1.0, 0.0, 0.0, 0.0, 2.0)) == inf
    assert check(seen(4.0, 0.0, -2.0, 0.0, 1.0, 0.0, 2.0)) == inf  # stops at the rim, turns
    # Falls beside i along its tangent, stops level with it and goes back.
    assert check(seen(2.0, 4.0, 0.0, -4.0, 0.0, 2.0, 2.0)) == inf


def test_rest_inside_and_pressing():
    assert check(seen(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 2.0)) == 0.0
    assert check(seen(1.0, 0.0, -1.0, 0.0, 9.0, 0.0, 2.0)) == 0.0
    assert check(seen(2.0, 0.0, -1.0, 0.0, 0.0, 0.0, 2.0)) == 0.0
    assert check(seen(2.0, 0.0, -1.0, 0.0, 0.0, 0.0, 2.0, until=0.0)) == 0.0


def test_turn_inside_an_overlap():
    assert check(seen(1.0, 0.0, 1.0, 0.0, -2.0, 0.0, 4.0)) == 0.5
    # The turn exactly at the rim: from 1 at 2, acceleration -2, up to 2 = s at time 1.
    assert check(seen(1.0, 0.0, 2.0, 0.0, -2.0, 0.0, 2.0)) == 1.0
    # A little faster: it leaves, and comes back to 2 = 1 + 3 t - t^2 at (3 + sqrt 5) / 2.
    expected = (3.0 + sqrt(5.0)) / 2
    assert check(seen(1.0, 0.0, 3.0, 0.0, -2.0, 0.0, 2.0)) == pytest.approx(expected, rel=1e-15)
    assert check(seen(1.0, 0.0, 3.0, 0.0, -2.0, 0.0, 2.0, until=2.0)) == inf


def test_the_turn_is_decided_however_close_to_the_rim():
    s = 2.0
    for x in (nextafter(1.0, 0.0), 1.0):
        assert contact_time_exact(*seen(x, 0.0, 2.0, 0.0, -2.0, 0.0, s)) == 1.0
    above = contact_time_exact(*seen(nextafter(1.0, 2.0), 0.0, 2.0, 0.0, -2.0, 0.0, s))
    assert above == pytest.approx(1.0 + 2.0**-26, abs=1e-12)


def test_parted():
    # Bounced upwards with 4 at acceleration -2: back at s, about 4 s later, wherever rounding left the two.
    for x in (2.0, 2.0 - 1e-9, 2.0 + 1e-9):
        assert check(seen(x, 0.0, 4.0, 0.0, -2.0, 0.0, 2.0, parted=True)) == 2.0 + sqrt(2.0 + x)
    assert check(seen(2.0, 0.0, 4.0, 0.0, -2.0, 0.0, 2.0, until=3.0, parted=True)) == inf
    assert check(seen(2.0, 0.0, 4.0, 0.0, 0.0, 0.0, 2.0, parted=True)) == inf
    # At rest or approaching by rounding: pressed together by the acceleration, or pulled apart, or neither.
    for v in (0.0, -1e-9):
        assert check(seen(2.0, 0.0, v, 0.0, -2.0, 0.0, 2.0, parted=True)) == 0.0
        assert check(seen(2.0, 0.0, v, 0.0, 2.0, 0.0, 2.0, parted=True)) == inf
        assert check(seen(2.0, 0.0, v, 1.0, 0.0, 0.0, 2.0, parted=True)) == inf


def test_until_cuts_off():
    pair = seen(10.0, 0.0, 0.0, 0.0, -4.0, 0.0, 2.0)
    for until, expected in ((2.0, 2.0), (nextafter(2.0, 0.0), inf), (nextafter(2.0, 3.0), 2.0)):
        assert check((*pair[:14], until, False)) == expected
    assert check((*pair[:14], 0.0, False)) == inf


@pytest.mark.parametrize("bad", [inf, -inf, nan])
def test_inputs_that_are_not_finite_never_touch(bad):
    for values in (
        seen(3.0, 0.0, -1.0, 0.0, 0.0, 0.0, 2.0),
        seen(1.0, 0.5, -1.0, 0.0, 0.0, 0.0, 2.0),
    ):
        for k in range(14):
            for until in (0.0, 10.0):
                for parted in (False, True):
                    pair = (*values[:k], bad, *values[k + 1 : 14], until, parted)
                    assert contact_time(*pair) == inf


# --- against other ways -----------------------------------------------------------------------------------------


small = st.integers(-9, 9).map(float)


@given(st.tuples(small, small, small), st.integers(1, 9).map(float))
def test_on_a_line_it_is_a_quadratic(motion, s):
    x, v, a = motion
    assume(abs(x) > s)
    t = check(seen(x, 0.0, v, 0.0, a, 0.0, s))
    if x < 0:
        x, v, a = -x, -v, -a
    with localcontext() as context:
        context.prec = 60
        d, c = Decimal(v * v - 2 * a * (x - s)), Decimal(x - s)
        # The first falling root of c + v t + a t^2 / 2, c > 0, without cancellation.
        expected = float(2 * c / (d.sqrt() - Decimal(v))) if d > 0 and (v < 0 or a < 0) else inf
    assert t == expected


def sampled(pair: Pair, n: int) -> float:
    """The rules read off n exact samples: right up to one step, unless a step hides a pair of roots."""
    step = Fraction(pair[14]) / n
    values = [gap(pair, k * step) for k in range(n + 1)]
    if values[0] <= 0:
        if values[1] < values[0]:
            return 0.0
        out = False
    else:
        out = True
    for k in range(1, n + 1):
        if out and values[k] < 0:
            return float(k * step)
        if not out and values[k] < values[k - 1]:
            return float(k * step)
        out = out or values[k] > 0
    return inf


@given(st.tuples(small, small, small, small, small, small), st.integers(1, 9).map(float))
def test_exact_agrees_with_samples(motion, s):
    x, y, vx, vy, ax, ay = motion
    pair = seen(x, y, vx, vy, ax, ay, s, until=8.0)
    t, expected = check(pair), sampled(pair, 512)
    if abs(t - expected) <= 2 * 8 / 512 or t == expected:
        return
    # What a step may hide is a contact; it is proven then by the sign of p on both sides.
    assert t < expected
    before, after = (gap(pair, Fraction(nextafter(t, end))) for end in (0.0, inf))
    assert (before > 0 > after) or gap(pair, Fraction(t)) <= 0


wide = st.floats(-1e6, 1e6, allow_subnormal=False)
radius = st.floats(1e-3, 1e3)


@given(*[wide] * 4, radius, *[wide] * 4, radius)
def test_straight_flights_agree_with_physics(xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj):
    straight = physics.contact_time_exact(xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj)
    zero = (0.0, 0.0)
    for until in (1e300, straight):
        if until < inf:
            pair = (xi, yi, vxi, vyi, *zero, ri, xj, yj, vxj, vyj, *zero, rj, until, False)
            t = check(pair)
            assert contact_time_exact(*pair) == (straight if until > straight else t)
            assert until == straight or contact_time_exact(*pair) == straight


def test_aimed_straight_flights_agree_with_physics():
    rng = random.Random(5)
    for _ in range(500):
        x, y, s = rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(0.1, 9)
        t, miss = rng.uniform(0.1, 9), rng.uniform(-1.1, 1.1) * s
        vx, vy = -x / t - y * miss / 900, -y / t + x * miss / 900
        pair = seen(x, y, vx, vy, 0.0, 0.0, s)
        assert check(pair) == pytest.approx(contact_time_exact(*pair), rel=1e-9)
        straight = physics.contact_time_exact(0.0, 0.0, 0.0, 0.0, s / 2, x, y, vx, vy, s / 2)
        assert contact_time_exact(*pair) == straight


# --- grazing ----------------------------------------------------------------------------------------------------


def test_grazing_a_millimetre_thin_is_never_missed():
    rng = random.Random(1)
    for _ in range(300):
        deep, at = aimed(rng, 1e-12)
        near, _ = aimed(rng, -1e-12)
        # Rounding of the aim itself is below 1e-12 only in part: the exact samples at the vertex tell which it is.
        if gap(deep, Fraction(at)) < 0:
            assert check(deep) <= at
        assert isinf(check(near)) or gap(near, Fraction(contact_time_exact(*near))) < 1e-13


def test_the_smallest_depth_that_doubles_hold():
    # Exact in doubles: the vertex of (t - 4, y0 + (t - 4)^2 / 2) is (0, y0) at time 4.
    for s in (1.0, 2.0, 7.0):
        for y, hit in ((s, False), (nextafter(s, 0), True), (s - 1e-12, True), (s + 1e-12, False)):
            pair = (0.0, 8.0, 0.0, 0.0, 0.0, 0.0, s / 2, -4.0, 0.0, 1.0, -4.0, 0.0, 1.0, s / 2, 9.0)
            moved = (0.0, -y, *pair[2:8], 8.0, *pair[9:], False)
            assert isinf(check(moved)) != hit


# --- the filter -------------------------------------------------------------------------------------------------


def test_the_filter_is_rarely_undecided():
    rng = random.Random(20_000)
    undecided = sum(isnan(contact_time_filtered(*ordinary(rng))) for _ in range(20_000))
    assert undecided < 20


def test_the_filter_agrees_on_ordinary_pairs():
    rng = random.Random(2)
    hits = sum(0.0 < check(ordinary(rng)) < inf for _ in range(2_000))
    assert hits > 50


@pytest.mark.parametrize("depth", [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_the_filter_agrees_on_grazing_pairs(depth):
    rng = random.Random(3)
    for _ in range(100):
        check(aimed(rng, depth)[0])
        check(aimed(rng, -depth)[0])


hostile = st.one_of(
    st.sampled_from([0.0, 1.0, -1.0, 2.0, 5e-324, -1e-150, 1e150, 1e-300, 1.7e308, 1 + 2 * U]),
    small,
    st.floats(-1e3, 1e3),
    st.floats(-1e150, 1e150),
)
size = hostile.map(abs)


@given(st.tuples(*[hostile] * 6, size, *[hostile] * 6, size, size, st.booleans()))
def test_the_filter_agrees_on_hostile_pairs(pair):
    filtered, t = contact_time_filtered(*pair), contact_time_exact(*pair)
    assert 0.0 <= t <= pair[14] or isinf(t)
    assert isnan(filtered) or (isinf(filtered) == isinf(t) and (filtered == 0.0) == (t == 0.0))


@given(st.integers(0, 2**32))
def test_symmetries_keep_the_bits(seed):
    rng = random.Random(seed)
    for pair in (ordinary(rng), aimed(rng, rng.choice([1e-3, 1e-9, 1e-14]))[0]):
        one, two, rest = pair[:7], pair[7:14], pair[14:]
        crossed = [(z[1], z[0], z[3], z[2], z[5], z[4], z[6]) for z in (one, two)]
        mirrored = [(-z[0], z[1], -z[2], z[3], -z[4], z[5], z[6]) for z in (one, two)]
        for answer in (contact_time_filtered, contact_time_exact):
            t = repr(answer(*pair))
            assert repr(answer(*two, *one, *rest)) == t
            assert repr(answer(*crossed[0], *crossed[1], *rest)) == t
            assert repr(answer(*mirrored[0], *mirrored[1], *rest)) == t


def in_units(pair: Pair, length: float, time: float) -> Pair:
    """The same pair, its kilometre and second so long in other units."""
    scale = (length, length, *[length / time] * 2, *[length / time / time] * 2, length)
    values = (z * unit for z, unit in zip(pair[:14], 2 * scale, strict=True))
    return (*values, pair[14] * time, pair[15])  # type: ignore[return-value]


UNITS = [
    (2.0**e, 2.0**f)
    for e, f in [(-900, -300), (-500, 0), (-300, 0), (0, 250), (0, -250), (100, 0), (450, -20)]
]


@pytest.mark.parametrize(("length", "time"), UNITS)
def test_the_filter_gives_the_same_bits_in_any_units(length, time):
    rng = random.Random(4)
    for pair in (ordinary(rng), *(aimed(rng, 10.0**-e)[0] for e in range(12))):
        for until in (pair[14], 0.0):
            here = (*pair[:14], until, pair[15])
            there = in_units(here, length, time)
            filtered, exact = contact_time_filtered(*here), contact_time_exact(*here)
            assert repr(contact_time_filtered(*there)) == repr(filtered * time)
            assert contact_time_exact(*there) == exact * time
            check(there)


@pytest.mark.parametrize("until", [1e70, 1e300, inf])
def test_a_search_without_an_end_is_filtered(until):
    rng = random.Random(6)
    for _ in range(20):
        pair = ordinary(rng)
        assert not isnan(contact_time_filtered(*pair[:14], until, pair[15]))
        check((*pair[:14], until, pair[15]))
    assert contact_time_filtered(*seen(3.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, inf)) == inf
    rest = seen(3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, inf)
    assert isnan(contact_time_filtered(*rest))
    assert check(rest) == inf


def test_what_other_units_cannot_hold_is_undecided():
    for s, vy in ((2.0**-300, 2.0**1000), (2.0**300, 3 * 2.0**-1074)):
        assert check(seen(2 * s, 0.0, -s, 0.0, 0.0, 0.0, s, 1e70)) == 1.0
        odd = seen(2 * s, 0.0, -s, vy, 0.0, 0.0, s, 1e70)
        assert isnan(contact_time_filtered(*odd))
        check(odd)


def test_times_below_the_doubles_are_rounded_once():
    s, speed = 2.0**-100, 2.0**930
    for gap, t in ((2.0**-145, 0.0), (1.5 * 2.0**-145, 2.0**-1074), (2.0**-144, 2.0**-1074)):
        soon = seen(s + gap, 0.0, -speed, 0.0, 0.0, 0.0, s, 2.0**-1000)
        assert isnan(contact_time_filtered(*soon))
        assert check(soon) == t
    # Escaped before the first double: the search must not end there.
    assert check(seen(1.0, 0.0, -1e308, 0.0, 0.0, 0.0, 2.0**-300, 1.0)) == 1e-308
    assert check(seen(2 * s, 0.0, -(2.0**1000), 0.0, 0.0, 0.0, s, 1e70)) == 0.0


def test_extremes_together():
    pair = seen(1e150, 1e-150, -1e-150, 1e-150, -1e-150, 1e-300, 1e-150, until=1.7e308)
    assert contact_time(*pair) == inf
    pair = seen(1e150, 0.0, -1e-150, 0.0, -1e-150, 0.0, 1e-150, until=1.7e308)
    assert check(pair) == pytest.approx(sqrt(2.0) * 1e150)
