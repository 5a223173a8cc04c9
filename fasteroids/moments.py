"""Moments and clocks: absolute time in two parts, so that a long run loses no digits.

A *moment* is a pair (window, offset): a whole number of windows of 1024 s since the start, and an offset in
[0, 1024) s. Splitting a time is exact, moments compare as tuples do, and an offset is never coarser than
2^-43 s however late it is (a single double is coarser than 1e-4 s after 1e12 s).

A *clock* adds the rounding residue of the sums that led to it, so that ten steps of 0.1 s reach the tick at
1.0 s. The residue takes no part in comparisons with moments.

Plain tuples, because the engine makes tens of thousands of them a second.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf, ulp

from fasteroids.units import TICKS_PER_SECOND, WINDOW, ModelError, number, shown

__all__ = [
    "LAST_WINDOW",
    "ORIGIN",
    "START",
    "Clock",
    "Moment",
    "advanced",
    "between",
    "clock_at",
    "later",
    "moment_at",
    "resolution",
    "seconds",
    "tick_after",
    "tick_moment",
]

Moment = tuple[int, float]
"""(window, offset in [0, 1024) s)."""

Clock = tuple[int, float, float]
"""(window, offset, residue in s); its first two parts are a moment."""

ORIGIN: Moment = (0, 0.0)
START: Clock = (0, 0.0, 0.0)


LAST_WINDOW = 2**1014 - 1
"""The last window in which the seconds since the start are still a double."""


def moment_at(time: float) -> Moment:
    """The moment `time` s after the start, exactly. `time` is finite and not negative."""
    windows, offset = divmod(time, WINDOW)
    return int(windows), offset


def clock_at(time: float) -> Clock:
    """The clock `time` s after the start, without residue; `ModelError` if nan, negative or infinite."""
    window, offset = moment_at(checked_time(time, "a time"))
    return window, offset, 0.0


def checked_time(time: float, what: str) -> float:
    """`time` as a float; `ModelError` if it is no number, nan, negative or infinite."""
    value = number(time, what)
    if not 0.0 <= value < inf:
        raise ModelError(f"{what} must be a finite number of seconds, 0 or more; got {shown(time)}")
    return value


def seconds(window: int, offset: float) -> float:
    """Seconds from the start to a moment: the nearest double."""
    if window < 2**43:
        return window * WINDOW + offset
    return float(window * int(WINDOW) + Fraction(offset))


def between(early: Moment, late: Moment) -> float:
    """Seconds from one moment to another, negative if the second is earlier."""
    return (late[0] - early[0]) * WINDOW + (late[1] - early[1])


def later(moment: Moment, delay: float) -> Moment:
    """The moment `delay` s (not negative, finite) after another, the offset rounded to the nearest double."""
    window, offset = moment[0], moment[1] + delay
    if offset >= WINDOW:
        windows, offset = divmod(offset, WINDOW)
        window += int(windows)
    return window, offset


def advanced(clock: Clock, dt: float) -> Clock:
    """The clock `dt` s later, carrying the rounding residue; `ModelError` if dt is nan, negative or infinite."""
    windows, step = divmod(checked_time(dt, "a step"), WINDOW)
    window, offset, residue = clock
    window += int(windows)
    if window >= LAST_WINDOW:
        raise ModelError(f"the clock cannot go {shown(dt)} s beyond {seconds(*clock[:2])!r} s")
    total = offset + step
    part = total - offset  # two-sum: total + error = offset + step, exactly
    error = (offset - (total - part)) + (step - part)
    if total >= WINDOW:
        window, total = window + 1, total - WINDOW
    residue += error
    settled = total + residue
    residue -= settled - total
    if settled < 0.0:  # only from total == 0.0: the nearest offset is still the window's first
        return window, 0.0, settled
    if settled >= WINDOW:
        return window + 1, settled - WINDOW, residue
    return window, settled, residue


def resolution(moment: Moment) -> float:
    """The coarsest spacing (s) of any offset up to this moment: what "at the same time" is worth there."""
    return ulp(WINDOW / 2) if moment[0] else ulp(moment[1])


def tick_moment(k: int) -> Moment:
    """The moment of tick k: the double k / 5 s, split exactly."""
    return moment_at(k / TICKS_PER_SECOND)


def tick_after(moment: Moment) -> int:
    """The smallest k whose tick comes after this moment."""
    window, offset = moment
    low = max(window * int(WINDOW) * TICKS_PER_SECOND + int(offset * TICKS_PER_SECOND) - 1, 0)
    step = 1
    while tick_moment(low + step) <= moment:  # late, many k share one double
        step *= 2
    while step > 1:
        step //= 2
        if tick_moment(low + step) <= moment:
            low += step
    return low + 1 if tick_moment(low) <= moment else low
