"""First contacts on curves without a closed form: conservative advancement (1.2, 1.5.1).

A gap D(t), between two discs or between a disc and a wall, is known together with its derivative, and its second
derivative is never below -B. From any time t the gap stays open at least until the root h of

    D + D' h - B h^2 / 2 = 0,

so t + h is never beyond the first contact. On a limited path B falls like exp(-w t), so that the steps grow; near
a contact met at speed the steps converge quadratically, as Newton's do, and from the safe side.

A second bound helps where the thrust is strong: on a limited path the whole turn still to come changes the velocity
by at most the chord 2 c sin(phi / 2) <= T = 2 c min(tan(phi / 2), 1), hence D(t + h) >= D + (D' - T) h. The longer
of the two steps is taken. Once T is no more than the rounding error of D' the path counts as straight, and the
search ends: a straight gap is convex.

Both add up what each of two discs may do, and see nothing of two that bend alike. A search that takes long asks the
series of `fasteroids.series` as well: for the line of centres n at t, |r(t + h)| >= n.r(t + h), and the series of n.r
is the difference of two, of high order.

Tolerances. A gap within its own rounding error E counts as closed, and a derivative within its own, F, as zero; both
are multiples of u = 2^-53 derived where they are computed.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf, nextafter, sqrt
from typing import TypeAlias

from fasteroids.paths import Limited, Parabola, Path
from fasteroids.physics import (
    NEVER,
    approaching,
    contact_time_exact,
    contact_time_filtered,
    distance,
)
from fasteroids.pressing import normal_acceleration
from fasteroids.series import difference, safe_time, series

__all__ = ["contact_time", "safe_step", "wall_time"]

_U = 2.0**-53
_TINY = 2.0**-1000
_FEW = 8
_PATIENCE = 4096

_Look: TypeAlias = Callable[[float], tuple[float, float, float, float, float, float]]
"""From a time to the gap D (km), D' (km/s), their rounding errors E and F, the bounds B (km/s^2) and T (km/s)."""

_Far: TypeAlias = Callable[[float, float], float]
"""From a time and a gap (km) that is open then to a time (s) within which it stays open, by the series."""


def safe_step(gap: float, rate: float, bend: float) -> float:
    """The time (s) within which a gap (km, >= 0) cannot fall below zero; inf if it never can.

    `rate` is its derivative (km/s), its second derivative is at least -`bend` (km/s^2, >= 0). The positive root of
    gap + rate h - bend h^2 / 2 = 0, from whichever form does not cancel. The root of the discriminant is taken as
    the length of (rate, sqrt(2 bend gap)), so that no square leaves the doubles.
    """
    if gap == inf or (bend == 0.0 and rate >= 0.0):
        return inf
    if bend == inf:
        return 0.0
    root = distance(rate, sqrt(2.0) * sqrt(bend) * sqrt(gap))
    if rate < 0.0:
        return gap / (0.5 * root - 0.5 * rate)
    return rate / bend + root / bend


def contact_time(
    xi: float, yi: float, vxi: float, vyi: float, path_i: Path | None, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, path_j: Path | None, rj: float,
    until: float, parted: bool,
) -> float:  # fmt: skip
    """The first time in [0, until] (s) at which two discs touch or overlap and approach; else NEVER.

    Positions km, velocities km/s, radii km; a path of None is straight. `parted` says that the two have just
    bounced: they touch, and do not approach, whatever rounding says. If then nothing carries them apart and they
    press on each other, the answer is 0.0. Discs that overlap and recede meet when they next approach.

    The bound. Let r be the relative position, v = r', a = r'', and D = |r| - s. Then D' = r.v / |r| and

        D'' = (|v|^2 - D'^2) / |r| + r.a / |r|.

    D' is the component of v along r, so the first term is not negative (it is the centrifugal one), and the second
    is at least -|a| >= -(|a_i| + |a_j|). Where r = 0, D' only jumps upwards.

    The answer t has D(t) <= E and D'(t) < 0, and D > 0 at all earlier times to within E: it is never late by more
    than rounding, and early by at most the time in which D closes E. Exchanging i and j gives the same bits.
    """
    if not (_bends(path_i) or _bends(path_j)):
        if parted:
            return NEVER
        t = contact_time_filtered(xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj)
        if t != t:
            t = contact_time_exact(xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj)
        return t if t <= until else NEVER
    s = ri + rj
    speeds = distance(vxi, vyi) + distance(vxj, vyj)
    pulls = _pull(path_i) + _pull(path_j)

    def look(t: float) -> tuple[float, float, float, float, float, float]:
        pxi, pyi, wxi, wyi = _state(path_i, xi, yi, vxi, vyi, t)
        pxj, pyj, wxj, wyj = _state(path_j, xj, yj, vxj, vyj, t)
        x, y, vx, vy = pxj - pxi, pyj - pyi, wxj - wxi, wyj - wyi
        wide, high = 0.125 * abs(pxi) + 0.125 * abs(pxj), 0.125 * abs(pyi) + 0.125 * abs(pyj)
        size = wide + high + 0.125 * s
        r = distance(x, y)
        error, blur = _errors(size, speeds, pulls, t)
        if r > 0.0:  # an error of r turns the line of centres
            rate = vx * (x / r) + vy * (y / r)
            blur += distance(vx, vy) * (error / r)
        else:
            rate = distance(vx, vy)
        bend_i, turn_i = _bounds(path_i, t)
        bend_j, turn_j = _bounds(path_j, t)
        return r - s, rate, error, blur, bend_i + bend_j, turn_i + turn_j

    if parted:
        x, y, vx, vy = xj - xi, yj - yi, vxj - vxi, vyj - vyi
        pulls_i, pulls_j = _acceleration(path_i, vxi, vyi), _acceleration(path_j, vxj, vyj)
        d2, error = normal_acceleration(x, y, vx, vy, pulls_i, pulls_j)
        if not _part(x, y, vx, vy, speeds) and d2 < -error:
            return 0.0
    unit = _unit(path_i, path_j)

    def far(t: float, gap: float) -> float:
        pxi, pyi, wxi, wyi = _state(path_i, xi, yi, vxi, vyi, t)
        pxj, pyj, wxj, wyj = _state(path_j, xj, yj, vxj, vyj, t)
        x, y = pxj - pxi, pyj - pyi
        r = distance(x, y)
        if r == 0.0 or not 0.0 < unit < inf:
            return 0.0
        nx, ny = x / r, y / r
        i = series(path_i and path_i.onward(t), wxi, wyi, nx, ny, unit)
        j = series(path_j and path_j.onward(t), wxj, wyj, nx, ny, unit)
        return unit * safe_time(gap, difference(i, j))

    return _first(look, far, until, parted)


def wall_time(
    path: Path | None, x: float, y: float, vx: float, vy: float,
    nx: float, ny: float, wall: float, until: float = inf,
) -> float:  # fmt: skip
    """The first time in [0, until] (s) at which g = nx x + ny y - wall falls through zero; else NEVER.

    (nx, ny) is one of (1, 0), (-1, 0), (0, 1), (0, -1), pointing away from the wall; x, y, wall in km, velocity in
    km/s. The answer is 0.0 if g is within its rounding error of zero, or below, and falls; if it is there and
    rises, the answer is when it falls again. g'' is a component of the acceleration, so at least -`bend`. On a
    parabola `until` must be finite.
    """
    speed, pull = distance(vx, vy), _pull(path)

    def look(t: float) -> tuple[float, float, float, float, float, float]:
        px, py, wx, wy = _state(path, x, y, vx, vy, t)
        at = nx * px + ny * py
        error, blur = _errors(0.125 * abs(at) + 0.125 * abs(wall), speed, pull, t)
        bend, turn = _bounds(path, t)
        return at - wall, nx * wx + ny * wy, error, blur, bend, turn

    unit = _unit(path)

    def far(t: float, gap: float) -> float:
        if not 0.0 < unit < inf:
            return 0.0
        _, _, wx, wy = _state(path, x, y, vx, vy, t)
        return unit * safe_time(gap, series(path and path.onward(t), wx, wy, nx, ny, unit))

    return _first(look, far, until, parted=False)


def _first(look: _Look, far: _Far, until: float, parted: bool) -> float:
    """The first time in [0, until] with gap <= E and D' < -F (at t = 0: D' < 0); else NEVER.

    Ordinary searches take a handful of looks. After `_FEW` the series is asked too: its steps are no shorter than
    0.05 / w as long as the gap is E or more, and after 40 / w a limited path is straight. A gap that is no number is
    beyond all worlds.

    It ends also where rates leave the range in which a series can be computed: after `_PATIENCE` looks the least gap
    a step is made for doubles with every step from E upwards, and is infinite after 1024 doublings.
    """
    t, looks = 0.0, 0
    least = 1.0
    while t <= until and t < inf:
        gap, rate, error, blur, bend, turn = look(t)
        if not gap < inf:
            return NEVER
        if turn <= blur:
            bend = turn = 0.0
        opening = parted and t == 0.0
        if opening:
            gap, rate = 0.0, max(rate, 0.0)
        elif gap <= error and rate < (-blur if t > 0.0 else 0.0):
            return t
        step = _step(gap, rate, error * least, blur, bend, turn, opening or gap > error)
        looks += 1
        if looks > _FEW and step < inf:
            step = max(step, far(t, max(gap, error)))
        t = max(t + step, nextafter(t, inf))
        if looks > _PATIENCE:
            least *= 2.0
    return NEVER


def _unit(*paths: Path | None) -> float:
    """The time (s) in which the fastest of some paths turns; NEVER if none does."""
    return min(
        (1.0 / p.rate for p in paths if isinstance(p, Limited) and p.rate > 0.0), default=inf
    )


def _step(
    gap: float, rate: float, least: float, blur: float, bend: float, turn: float, is_open: bool
) -> float:
    """How far (s) the next contact is at least, seen from one look.

    An open gap is taken to be at least `least` (km): less is not told from zero. Discs that overlap and recede
    meet again when D' turns, not before D' / B; a step in which a gap at rest closes by `least` is always allowed.
    """
    if bend == 0.0 and rate >= -blur:
        return inf
    if is_open:
        gap = max(gap, least)
        straight = gap / (turn - rate) if turn > rate else inf
        return max(safe_step(gap, rate, bend), straight)
    return max(max(rate, blur) / bend, safe_step(least, 0.0, bend))


def _errors(size: float, speed: float, pull: float, t: float) -> tuple[float, float]:
    """The rounding errors E of a gap (km) and F of its derivative (km/s) after `t` s.

    `size` is an eighth of the sum S of the lengths that enter the gap (S itself may be no double), `speed` and `pull`
    are the sums of the speeds at the start and of the constant accelerations. The way flown, at most
    W = (speed + pull t) t, is computed to 8 u W in each of two components; adding it to the start costs u S, the
    differences and the root of r 4 u |r| <= 4 u S, the radii or the wall and the last subtraction 3 u S. Together at
    most 8 u S + 16 u W. A velocity is computed to 5 u of its size in each component (4.2 u is the worst measured), and
    D' adds less than that: 16 u (speed + pull t). What underflow may take from the products is covered by 2^-1000.
    """
    fast = speed + pull * t
    return 64.0 * _U * size + 16.0 * _U * fast * t + _TINY, 16.0 * _U * fast + _TINY


def _state(
    path: Path | None, x: float, y: float, vx: float, vy: float, t: float
) -> tuple[float, float, float, float]:
    """Position and velocity after `t` s."""
    return (x + vx * t, y + vy * t, vx, vy) if path is None else path.after(x, y, vx, vy, t)


def _bounds(path: Path | None, t: float) -> tuple[float, float]:
    """The largest acceleration (km/s^2) and the largest change of the velocity (km/s) from `t` s on."""
    if path is None:
        return 0.0, 0.0
    ahead = path.onward(t)
    if isinstance(ahead, Limited):
        return ahead.bend, 2.0 * ahead.limit * min(abs(ahead.half), 1.0)
    bend = ahead.bend
    return bend, inf if bend > 0.0 else 0.0


def _bends(path: Path | None) -> bool:
    """Is the path anything but straight?"""
    return path is not None and path.bend > 0.0


def _pull(path: Path | None) -> float:
    """The acceleration that can change the speed (km/s^2): a limited path has none."""
    return path.bend if isinstance(path, Parabola) else 0.0


def _acceleration(path: Path | None, vx: float, vy: float) -> tuple[float, float]:
    """The acceleration now (km/s^2)."""
    return (0.0, 0.0) if path is None else path.acceleration(vx, vy)


def _part(x: float, y: float, vx: float, vy: float, speeds: float) -> bool:
    """Do discs that have just bounced move apart, by more than the rounding of their velocities?

    The velocities and the line of centres are given: only the subtraction v and the product round, 4 u speeds.
    """
    r = distance(x, y)
    if r == 0.0:
        return vx != 0.0 or vy != 0.0
    return not approaching(x, y, vx, vy) and vx * (x / r) + vy * (y / r) > 4.0 * _U * speeds
