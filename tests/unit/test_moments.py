"""Moments and clocks: times that do not go blunt."""

from __future__ import annotations

import random
import sys
from fractions import Fraction
from math import inf, nan, ulp
from types import FrameType
from typing import Any

import pytest

from fasteroids import ModelError
from fasteroids.moments import (
    ORIGIN,
    START,
    Clock,
    Moment,
    advanced,
    between,
    clock_at,
    later,
    moment_at,
    resolution,
    seconds,
    tick_after,
    tick_moment,
)

TIMES = [
    0.0,
    5e-324,
    0.1,
    1.0,
    1023.9999999999999,
    1024.0,
    1e4 / 3,
    1e9 + 0.1,
    1e15 / 7,
    2.0**60,
    1e300,
]
BAD: list[Any] = [nan, inf, -inf, -1.0, -5e-324, None, "soon", [], 10**5000, -(10**400)]


def kind_of(value: object) -> str:
    """A name for a parameter that may be too long to print."""
    return f"{value!r}" if isinstance(value, float) else type(value).__name__


def exactly(moment: Moment) -> Fraction:
    return Fraction(moment[0]) * 1024 + Fraction(moment[1])


@pytest.mark.parametrize("time", TIMES)
def test_moment_at_splits_exactly(time: float) -> None:
    window, offset = moment_at(time)
    assert type(window) is int
    assert 0.0 <= offset < 1024.0
    assert exactly((window, offset)) == Fraction(time)


@pytest.mark.parametrize("time", TIMES)
def test_seconds_is_the_way_back(time: float) -> None:
    assert seconds(*moment_at(time)) == time


@pytest.mark.parametrize("window", [0, 1, 7, 2**30 + 1, 2**43 - 1, 2**43, 2**43 + 1, 2**60 + 1])
@pytest.mark.parametrize("offset", [0.0, 5e-324, 0.1, 512.0, 1023.9999999999999])
def test_seconds_is_the_nearest_double(window: int, offset: float) -> None:
    assert seconds(window, offset) == float(exactly((window, offset)))


def test_the_origin_and_the_start() -> None:
    assert moment_at(0.0) == ORIGIN
    assert clock_at(0.0) == START


@pytest.mark.parametrize("bad", BAD, ids=kind_of)
def test_clock_at_refuses(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"a time must be a (finite )?number"):
        clock_at(bad)


@pytest.mark.parametrize("bad", ["0.5", True, b"1"])
def test_clock_at_takes_numbers_only(bad: Any) -> None:
    with pytest.raises(ModelError, match="a time must be"):
        clock_at(bad)


@pytest.mark.parametrize("good", [3, Fraction(3), 3.0, -0.0])
def test_clock_at_takes_any_real_number(good: Any) -> None:
    assert clock_at(good) == (0, float(good), 0.0)


def test_between_is_signed() -> None:
    assert between((0, 1000.5), (2, 0.25)) == 1047.75
    assert between((2, 0.25), (0, 1000.5)) == -1047.75
    assert between((3, 7.0), (3, 7.0)) == 0.0


def test_between_does_not_lose_digits_in_late_windows() -> None:
    late = 2**60
    assert between((late, 0.1), (late, 0.3)) == 0.3 - 0.1
    assert between((late, 1023.5), (late + 1, 0.25)) == 0.75


def test_later_carries_into_the_next_window() -> None:
    assert later((0, 1000.0), 24.0) == (1, 0.0)
    assert later((5, 1.5), 2.0**20 + 0.25) == (5 + 2**10, 1.75)
    assert later((5, 1.5), 0.0) == (5, 1.5)


def test_later_of_a_long_delay_is_a_moment() -> None:
    window, offset = later((3, 1000.0), 1e300)
    assert 0.0 <= offset < 1024.0
    # One rounding of the sum.
    assert (
        abs(exactly((window, offset)) - 3 * 1024 - 1000 - Fraction(1e300))
        <= Fraction(ulp(1e300)) / 2
    )


def total(clock: Clock) -> Fraction:
    return exactly(clock[:2]) + Fraction(clock[2])


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3, 1e6, 1e-18])
def test_advanced_carries_what_rounding_left(scale: float) -> None:
    rng = random.Random(str(scale))
    clock, exact = START, Fraction(0)
    for _ in range(2000):
        dt = rng.uniform(0.0, scale)
        clock = advanced(clock, dt)
        exact += Fraction(dt)
        _, offset, residue = clock
        assert 0.0 <= offset < 1024.0
        # The residue is what the offset could not hold: half a spacing at most.
        assert abs(residue) <= ulp(offset) / 2
    # Only the residue itself is rounded: half a spacing of the residue a step.
    assert abs(total(clock) - exact) <= 2000 * Fraction(ulp(ulp(1024.0) / 2)) / 2


@pytest.mark.parametrize(
    ("step", "count", "time"),
    [(0.1, 10, 1.0), (0.1, 1000, 100.0), (0.03, 20, 0.6), (0.7, 1000, 700.0)],
)
def test_advanced_steps_reach_their_sum(step: float, count: int, time: float) -> None:
    clock = START
    for _ in range(count):
        clock = advanced(clock, step)
    # To the double: the sum of the doubles differs from `time` by less than half a spacing.
    assert abs(Fraction(step) * count - Fraction(time)) < Fraction(ulp(clock[1])) / 2
    assert seconds(*clock[:2]) == time


def test_advanced_by_nothing_is_the_same() -> None:
    for clock in (START, (3, 0.5, 1e-20), (4, 0.0, -1e-20), (4, 1023.9999999999999, -1e-20)):
        assert advanced(clock, 0.0) == clock


def test_advanced_never_goes_back() -> None:
    rng = random.Random(4)
    clock = (2, 1023.9999999999, -3e-14)
    for _ in range(5000):
        after = advanced(clock, rng.choice((0.0, 5e-324, 1e-300, 1e-17, 1e-14, 1e-13)))
        assert after[:2] >= clock[:2]
        clock = after


def test_advanced_into_late_windows() -> None:
    assert advanced((2**70, 1000.0, 0.0), 24.5) == (2**70 + 1, 0.5, 0.0)


@pytest.mark.parametrize("bad", BAD, ids=kind_of)
def test_advanced_refuses(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"a step must be a (finite )?number"):
        advanced(START, bad)


@pytest.mark.parametrize("bad", ["0.5", True])
def test_advanced_takes_numbers_only(bad: Any) -> None:
    with pytest.raises(ModelError, match="a step must be"):
        advanced(START, bad)


def test_a_clock_beyond_the_doubles_is_refused_or_has_a_time() -> None:
    late = clock_at(sys.float_info.max)
    try:
        clock = advanced(late, sys.float_info.max)
    except ModelError:
        return
    assert seconds(*clock[:2]) == inf


@pytest.mark.parametrize("time", TIMES)
def test_resolution_is_the_coarsest_spacing_so_far(time: float) -> None:
    moment = moment_at(time)
    assert resolution(moment) == (ulp(1023.0) if time >= 1024.0 else ulp(time))


@pytest.mark.parametrize("k", [0, 1, 2, 3, 5, 7, 5119, 5120, 5121, 10**9 + 1, 10**15 + 3])
def test_tick_moment_is_the_double_k_over_five(k: int) -> None:
    assert exactly(tick_moment(k)) == Fraction(k / 5)


def following(moment: Moment) -> int:
    """The smallest k whose tick comes after this moment, by searching upwards from well below."""
    k = max(0, int(exactly(moment) * 5) - 4)
    while Fraction(k / 5) <= exactly(moment):
        k += 1
    return k


@pytest.mark.parametrize(
    ("moment", "k"),
    [((0, 0.0), 1), ((0, 0.19999999999999998), 1), ((0, 0.2), 2), ((0, 0.6), 4), ((1, 0.0), 5121)],
)
def test_tick_after(moment: Moment, k: int) -> None:
    assert tick_after(moment) == k


def test_tick_after_is_the_smallest() -> None:
    rng = random.Random(5)
    moments = [moment_at(k / 5) for k in range(300)]
    moments += [(w, rng.uniform(0, 1024)) for w in (0, 1, 5, 10**6) for _ in range(100)]
    moments += [(w, k / 5) for w in (1, 3, 10**5) for k in range(100)]
    for moment in moments:
        assert tick_after(moment) == following(moment), moment


def test_tick_after_ends_however_late() -> None:
    left = 100_000

    def count(_frame: FrameType, event: str, _arg: Any) -> Any:
        nonlocal left
        left -= event == "line"
        if left < 0:
            raise AssertionError("still looking for a tick")
        return count

    before = sys.gettrace()
    sys.settrace(count)
    try:
        for time in (1e16, 1e20, 1e30, 1e300):
            moment = moment_at(time)
            assert tick_moment(tick_after(moment)) > moment
    finally:
        sys.settrace(before)
