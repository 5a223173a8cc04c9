"""Parabolas, the catenary of equal strength at the speed limit, and when a ship passes from one to the other."""

from __future__ import annotations

from decimal import Decimal
from math import atan, cos, hypot, inf, isclose, isfinite, log, nextafter, pi, sin, sinh, sqrt, tan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.paths import (
    Limited,
    Parabola,
    falling_time,
    limit_time,
    limited,
    path_of,
    reached,
    to_limit,
)
from fasteroids.physics import NEVER
from fasteroids.units import MAX_ACCELERATION
from tests.unit.making import SUBNORMAL, U

LIGHT = 300_000.0
PUSH = 220.0

# Unit limit and thrust along x: tan(phi_0 / 2), t, and the way along and across. Made in 70-digit decimal arithmetic
# by Taylor series of order 70 in steps of at most 0.2 s for x' = C, y' = S, C' = S^2, S' = -S C, with C = cos phi and
# S = sin phi: no closed form enters. The first column is tan(phi_0 / 2) rounded, for phi_0 in 1e-6, 0.3, 1, 1.5, pi/2.
WAYS = [
    (5.000000000000417e-07, 0.5, "4.999999999998419698602928612457e-1", "3.934693402873346476649022540928e-7"),
    (5.000000000000417e-07, 40.0, "3.999999999999974999999999998956e+1", "1.000000000000000049911728777498e-6"),
    (0.15113521805829508, 1e-09, "9.553364891692721710080658791066e-10", "2.955202065201789893584459141079e-10"),
    (0.15113521805829508, 3.0, "2.977471732959567096898667183829e+0", "2.849511251460894112287006371054e-1"),
    (0.5463024898437905, 0.001, "5.406562150454085890097899513552e-4", "8.412436021501382285206103911393e-4"),
    (0.5463024898437905, 0.5, "3.430043986226487688923408226543e-1", "3.600724372916760428098872621087e-1"),
    (0.9315964599440725, 1e-09, "7.073720216520102415111737972030e-11", "9.974949865687744919138379625290e-10"),
    (0.9315964599440725, 3.0, "2.377349133119511939526144411957e+0", "1.407303519403517307747233794175e+0"),
    (1.0, 0.001, "4.999999166666889096988176321604e-7", "9.999998333333750208045681325987e-4"),
    (1.0, 40.0, "3.930685281944005469058276787854e+1", "1.570796326794896610734613181057e+0"),
]  # fmt: skip

angles = st.floats(-pi / 2, pi / 2)
headings = st.floats(-pi, pi)
limits = st.floats(1e-3, 1e6)
powers = st.floats(1e-6, 1e6)
times = st.floats(0.0, 1e6)


def flying(heading: float, phi: float, limit: float, power: float) -> tuple[Limited, float, float]:
    """A limited path with its thrust at `heading`, and the velocity at its start."""
    ux, uy = cos(heading), sin(heading)
    path = Limited(ux, uy, limit, power, power / limit, tan(phi / 2.0))
    return path, limit * cos(heading + phi), limit * sin(heading + phi)


# The limited path.


@pytest.mark.parametrize(("half", "t", "along", "across"), WAYS)
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("limit", [1.0, 2.0**18])
def test_the_way_is_right_to_a_few_u(
    half: float, t: float, along: str, across: str, side: float, limit: float
) -> None:
    path = Limited(1.0, 0.0, limit, limit, 1.0, side * half)
    x, y, _, _ = path.after(0.0, 0.0, limit, 0.0, t)
    allowed = Decimal(4.0 * U * t)
    assert abs(Decimal(x / limit) - Decimal(along)) <= allowed
    assert abs(Decimal(side * y / limit) - Decimal(across)) <= allowed


@pytest.mark.parametrize("w", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("angle", [1e-9, 0.9 * 2.0**-26, 1e-3, 0.5, 3.0, 30.0])
def test_a_ship_that_starts_across_its_thrust_flies_the_catenary_of_equal_strength(
    w: float, angle: float
) -> None:
    """From phi = pi / 2 with unit c / w: along = ln cosh t = -ln cos(across)."""
    path, vx, vy = flying(0.0, pi / 2.0, 1.0, w)
    along, across, _, _ = path.after(0.0, 0.0, vx, vy, angle / w)
    # cos(across) is small where the curve nears its asymptote, so the error of `across` grows there
    if angle < 10.0:
        assert along * w == pytest.approx(-log(cos(across * w)), rel=1e-9, abs=4.0 * U)
    assert across * w == pytest.approx(atan(sinh(angle)), rel=1e-14)


@given(headings, angles, limits, powers, times)
def test_the_speed_is_never_above_the_limit(
    heading: float, phi: float, limit: float, power: float, t: float
) -> None:
    path, vx, vy = flying(heading, phi, limit, power)
    _, _, vx, vy = path.after(1.0, 2.0, vx, vy, t)
    if t > 0.0:
        assert sqrt(vx * vx + vy * vy) <= limit
        assert sqrt(vx * vx + vy * vy) >= limit * (1.0 - 16.0 * U)


@given(headings, angles, limits, powers, st.floats(0.0, 1e3), st.floats(0.0, 1e3))
def test_two_legs_are_one(
    heading: float, phi: float, limit: float, power: float, t1: float, t2: float
) -> None:
    path, vx, vy = flying(heading, phi, limit, power)
    there = path.after(0.0, 0.0, vx, vy, t1 + t2)
    back = path.onward(t1).after(*path.after(0.0, 0.0, vx, vy, t1), t2)
    # t1 + t2 is rounded, and so is w t, the exponent: its error turns the direction by at most u w t sin phi < u
    way = limit * (t1 + t2)
    assert there[:2] == pytest.approx(back[:2], rel=0.0, abs=64.0 * U * way + 1e-300)
    if t2 > 0.0:
        assert there[2:] == pytest.approx(back[2:], rel=0.0, abs=64.0 * U * limit)


@pytest.mark.parametrize("phi", [1e-6, 0.3, 1.0, -1.5])
def test_the_two_forms_of_the_path_agree_where_they_meet(phi: float) -> None:
    path, vx, vy = flying(0.4, phi, LIGHT, PUSH)
    t = 2.0**-26 / path.rate
    while path.rate * t >= 2.0**-26:
        t = nextafter(t, 0.0)
    before, after = (path.after(0.0, 0.0, vx, vy, when) for when in (t, nextafter(t, inf)))
    assert before[:2] == pytest.approx(after[:2], rel=0.0, abs=8.0 * U * LIGHT * t)
    assert before[2:] == pytest.approx(after[2:], rel=0.0, abs=8.0 * U * LIGHT)


def test_at_time_zero_nothing_has_changed() -> None:
    path, vx, vy = flying(0.4, 1.0, LIGHT, PUSH)
    assert path.after(3.0, 4.0, vx, vy, 0.0) == (3.0, 4.0, vx, vy)
    assert path.onward(0.0) == path


def test_an_infinite_rate_turns_at_once() -> None:
    path = limited(0.0, 1e-300, 1e300, 0.0, 1e-300)
    assert path.rate == inf
    assert path.after(0.0, 0.0, 0.0, 1e-300, 2.0) == (2e-300, 0.0, 1e-300, 0.0)
    assert path.onward(1.0).half == 0.0
    assert path.onward(1.0).bend == 0.0


@given(headings, angles, limits, powers, st.floats(0.0, 1e3))
def test_the_bend_only_falls_and_is_the_thrust_across(
    heading: float, phi: float, limit: float, power: float, t: float
) -> None:
    path, _, _ = flying(heading, phi, limit, power)
    assert path.bend == pytest.approx(power * abs(sin(phi)), rel=1e-12, abs=1e-300)
    assert path.onward(t).bend <= path.bend * (1.0 + 4.0 * U)


@given(headings, angles, limits, powers)
def test_limited_finds_the_angle_from_the_thrust(
    heading: float, phi: float, limit: float, power: float
) -> None:
    want, vx, vy = flying(heading, phi, limit, power)
    path = limited(vx, vy, power * cos(heading), power * sin(heading), limit)
    assert path.half == pytest.approx(want.half, rel=0.0, abs=8.0 * U)
    assert path.power == pytest.approx(power, rel=1e-15)


# The parabola.


def test_known_answers_of_the_parabola() -> None:
    """From rest, 110 km in the first second at 220 km/s^2."""
    assert Parabola(PUSH, 0.0).after(0.0, 5.0, 0.0, 0.0, 1.0) == (110.0, 5.0, 220.0, 0.0)
    assert Parabola(0.0, -2.0).after(0.0, 0.0, 3.0, 4.0, 4.0) == (12.0, 0.0, 3.0, -4.0)
    assert Parabola(3.0, -4.0).bend == 5.0
    assert Parabola(3.0, -4.0).onward(7.0) == Parabola(3.0, -4.0)


@given(headings, limits, powers)
def test_a_parabola_ends_at_the_limit_and_not_above(
    heading: float, limit: float, power: float
) -> None:
    ax, ay = power * cos(heading), power * sin(heading)
    vx, vy = 0.3 * limit, -0.4 * limit
    t = limit_time(vx, vy, ax, ay, limit)
    _, _, wx, wy = Parabola(ax, ay).after(0.0, 0.0, vx, vy, t, limit)
    assert sqrt(wx * wx + wy * wy) <= limit
    assert isclose(hypot(wx, wy), limit, rel_tol=32.0 * U)


# When the limit is reached.


def test_from_rest_the_limit_is_reached_after_c_by_a() -> None:
    assert limit_time(0.0, 0.0, PUSH, 0.0, LIGHT) == pytest.approx(LIGHT / PUSH, rel=4.0 * U)


def test_across_the_velocity_the_limit_follows_pythagoras() -> None:
    assert limit_time(3.0, 0.0, 0.0, 2.0, 5.0) == pytest.approx(2.0, rel=4.0 * U)


def test_thrust_inwards_from_the_limit_leads_through_the_disc_of_velocities() -> None:
    assert limit_time(5.0, 0.0, -2.0, 0.0, 5.0) == pytest.approx(5.0, rel=4.0 * U)
    assert limit_time(3.0, 4.0, -1.0, 0.0, 5.0) == pytest.approx(6.0, rel=8.0 * U)


def test_thrust_outwards_or_across_at_the_limit_takes_no_time() -> None:
    assert limit_time(5.0, 0.0, 2.0, 0.0, 5.0) == 0.0
    assert limit_time(5.0, 0.0, 0.0, 2.0, 5.0) == 0.0


def test_the_limit_is_never_reached_without_thrust() -> None:
    assert limit_time(1.0, 0.0, 0.0, 0.0, 5.0) == NEVER
    assert limit_time(0.0, 0.0, 1.0, 0.0, 0.0) == NEVER


def test_extreme_limits_and_thrusts_stay_in_range() -> None:
    assert limit_time(0.0, 0.0, 1e200, 0.0, 1e300) == pytest.approx(1e100)
    assert limit_time(0.0, 0.0, 1e-300, 0.0, 1e-200) == pytest.approx(1e100)


@given(headings, limits)
def test_to_limit_gives_the_limit_and_keeps_the_direction(heading: float, limit: float) -> None:
    vx, vy = to_limit(0.1 * cos(heading), 0.1 * sin(heading), limit)
    assert limit * (1.0 - 8.0 * U) <= sqrt(vx * vx + vy * vy) <= limit
    assert (vx, vy) == pytest.approx(
        (limit * cos(heading), limit * sin(heading)), abs=1e-15 * limit
    )


def test_to_limit_leaves_rest_alone() -> None:
    assert to_limit(0.0, 0.0, 5.0) == (0.0, 0.0)


# Which path.


def test_below_the_limit_a_ship_flies_a_parabola() -> None:
    assert path_of(1.0, 0.0, 0.0, 2.0, 5.0) == Parabola(0.0, 2.0)
    assert path_of(5.0 * (1.0 - 64.0 * U), 0.0, 0.0, 2.0, 5.0) == Parabola(0.0, 2.0)


@pytest.mark.parametrize("speed", [5.0, 5.0 * (1.0 - 8.0 * U)])
def test_at_the_limit_a_ship_flies_the_limited_path(speed: float) -> None:
    assert path_of(speed, 0.0, 0.0, 2.0, 5.0) == Limited(0.0, 1.0, 5.0, 2.0, 0.4, -1.0)


def test_without_thrust_or_with_no_speed_allowed_the_path_is_straight() -> None:
    assert path_of(5.0, 0.0, 0.0, 0.0, 5.0) == Parabola(0.0, 0.0)
    assert path_of(0.0, 0.0, 1.0, 0.0, 0.0) == Parabola(0.0, 0.0)


# Thrusts at the ends of the doubles.


@pytest.mark.parametrize("power", [SUBNORMAL, 2.0**-1060, MAX_ACCELERATION])
@pytest.mark.parametrize("speed", [SUBNORMAL, 2.0**-1060, LIGHT])
def test_a_limited_path_has_unit_vectors_whatever_its_numbers(power: float, speed: float) -> None:
    path = limited(speed, speed, power, -power, speed)
    assert (path.ux, path.uy) == pytest.approx((sqrt(0.5), -sqrt(0.5)))
    assert path.half == pytest.approx(1.0)
    x, y, vx, vy = path.after(0.0, 0.0, speed, speed, 2.0)
    assert hypot(x, y) <= 2.0 * speed * (1.0 + 8.0 * U)
    assert hypot(vx, vy) <= speed * (1.0 + 8.0 * U) + 2.0 * SUBNORMAL


def test_a_reached_limit_is_not_left() -> None:
    """Of a subnormal velocity rounding turns the direction: (1, 1) units may stand for (2, 1)."""
    path = reached(2.0 * SUBNORMAL, 2.0 * SUBNORMAL, 1.0, -1.5, 2.0 * SUBNORMAL)
    assert isinstance(path, Limited)
    assert path.half == 1.0
    assert reached(3.0, 4.0, -4.0, 3.0, 5.0) == limited(3.0, 4.0, -4.0, 3.0, 5.0)
    assert reached(3.0, 4.0, 0.0, 0.0, 5.0) == Parabola(0.0, 0.0)


# Falling.


@pytest.mark.parametrize("gap", [0.0, 5e-324, 1.0, 1e308, inf, -1e-300, -1.0, -inf])
@pytest.mark.parametrize("v", [0.0, 1e-300, 1.0, LIGHT, -1e-300, -LIGHT])
@pytest.mark.parametrize("a", [0.0, 5e-324, 1.0, MAX_ACCELERATION])
def test_falling_times_are_never_nan(gap: float, v: float, a: float) -> None:
    assert falling_time(gap, v, a) >= 0.0
    assert falling_time(gap, v, -a) >= 0.0


def test_what_is_thrown_up_comes_back_after_2_v_by_a() -> None:
    assert falling_time(0.0, 3.0, -2.0) == 3.0


@pytest.mark.parametrize(
    ("gap", "v", "a"), [(1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, -1.0, 1.0)]
)
def test_what_rises_rests_or_turns_in_time_never_falls(gap: float, v: float, a: float) -> None:
    assert falling_time(gap, v, a) == NEVER


def test_a_dip_is_entered_on_its_first_side() -> None:
    assert falling_time(1.5, -2.0, 1.0) == 1.0
    assert falling_time(1.5, -2.0, 0.0) == 0.75


def test_a_drop_from_rest() -> None:
    assert falling_time(4.0, 0.0, -2.0) == 2.0


def test_there_and_falling_is_now() -> None:
    assert falling_time(0.0, -1.0, 5.0) == 0.0
    assert falling_time(-1e-16, -1.0, 0.0) == 0.0
    assert falling_time(0.0, 0.0, -1.0) == 0.0


def test_a_gap_that_rounding_left_below_zero_counts_when_it_closes_again() -> None:
    assert falling_time(-1e-17, 3.0, -2.0) == pytest.approx(3.0)
    assert falling_time(-1.0, 1.0, -2.0) == 0.5
    assert falling_time(-1e-17, 3.0, 0.0) == NEVER


@pytest.mark.parametrize(
    ("gap", "v", "a", "time"),
    [
        (1e300, -1e300, -1e300, sqrt(3.0) - 1.0),
        (1.0, -1e200, 1.0, 1e-200),
        (1e-320, 0.0, -1e-320, sqrt(2.0)),
    ],
)
def test_a_fall_whose_squares_leave_the_doubles(
    gap: float, v: float, a: float, time: float
) -> None:
    assert falling_time(gap, v, a) == pytest.approx(time, rel=1e-3)  # subnormals have few digits


def test_thrust_against_the_motion_gives_numbers() -> None:
    """Such a path ends at once, but nothing that is asked of it may be nan."""
    for vy in (0.0, 1e-9, -1e-3):
        path = limited(-1.0, vy, 1.0, 0.0, 1.0)
        assert abs(path.half) > 1.0
        assert all(
            isfinite(z) for z in (*path.after(0.0, 0.0, -1.0, vy, 2.0), path.onward(800.0).half)
        )
