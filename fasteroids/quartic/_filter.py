"""The filter: the Bernstein form of p over pieces of time, halved until a sign is proven or doubtful."""

from __future__ import annotations

from math import frexp, inf, ldexp, sqrt

from fasteroids.physics import NEVER, UNDECIDED, distance

__all__ = ["contact_time_filtered"]

_U = 2.0**-53  # unit roundoff of binary64
_SIGN_B = 8 * _U
_SIGN_C = 16 * _U
_SIGN_Q = 64 * _U
_NOISE = 16 * _U
_TINY = 2.0**-1000
_SMALL, _LARGE = 2.0**-480, 2.0**480
_SHORT, _LONG = 2.0**-200, 2.0**200
_LEAST = 2.0**-1022  # the smallest normal double
_PIECES = 128  # a contact is found in a handful; more only for roots closer than rounding can tell
_HALVINGS = 2.0**_PIECES  # a time shorter than `until` by more is not reached


def contact_time_filtered(
    xi: float, yi: float, vxi: float, vyi: float, axi: float, ayi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, axj: float, ayj: float, rj: float,
    until: float, parted: bool,
) -> float:  # fmt: skip
    """The same in rounded arithmetic, or UNDECIDED where a sign could be wrong or a product out of range.

    With u = 2^-53, each computed difference and s carry a relative error of at most u, each product and sum one
    more. c = r.r - s^2 is off by at most 4 u r.r + 3 u s^2 + u |c|: its sign is proven beyond 16 u (r.r + s^2).
    The sign of b = r.v is proven beyond 8 u (|x vx| + |y vy|), see `physics.contact_time_filtered`.
    Underflow: s^2 >= 2^-480 and until <= 2^200 keep every product lost to it (2^-1074, times t^2 at most) far
    below u s, hence in the share of s in each bound. Overflow makes a bound infinite or nan and comparisons fail.
    Where s or until is out of range, `_rescaled` asks the same in other units of length and time.
    """
    x = xj - xi
    y = yj - yi
    vx = vxj - vxi
    vy = vyj - vyi
    hx = 0.5 * (axj - axi)
    hy = 0.5 * (ayj - ayi)
    s = ri + rj
    ss = s * s
    if not (_SMALL <= ss <= _LARGE and (_SHORT <= until <= _LONG or until == 0.0)):
        return _rescaled(x, y, vx, vy, axj - axi, ayj - ayi, s, until, parted)
    rr = x * x + y * y
    c = rr - ss
    error = _SIGN_C * (rr + ss)
    if c > error and not parted:
        return _first_fall(x, y, vx, vy, hx, hy, s, ss, 0.0, until)
    bx = x * vx
    by = y * vy
    b = bx + by
    error_b = _SIGN_B * (abs(bx) + abs(by)) + _TINY
    if b > error_b:
        return _receding(x, y, vx, vy, hx, hy, s, ss, b, abs(c) + error, until)
    if b < -error_b and c < -error and not parted and abs(hx) + abs(hy) < inf:
        return 0.0
    return UNDECIDED


def _rescaled(
    x: float, y: float, vx: float, vy: float, ax: float, ay: float,
    s: float, until: float, parted: bool,
) -> float:  # fmt: skip
    """The same in units of length and time in which s and `until` lie between 1/2 and 1.

    Scaling by powers of two is exact and gives the same bits in any units; where it is not exact, the answer is
    UNDECIDED. So is a time below the normal doubles, which the way back would round, perhaps to 0.0.
    """
    escape = _escape(x, y, vx, vy, ax, ay, s)
    if until > _HALVINGS * escape > 0.0:
        until = escape
    if not (0.0 < s < inf and 0.0 <= until < inf):
        return UNDECIDED
    length, time = frexp(s)[1], frexp(until)[1]
    scaled = []
    try:
        for value, power in ((x, 0), (y, 0), (vx, 1), (vy, 1), (ax, 2), (ay, 2), (s, 0)):
            scaled.append(ldexp(value, power * time - length))
            if ldexp(scaled[-1], length - power * time) != value:
                return UNDECIDED
    except OverflowError:
        return UNDECIDED
    x, y, vx, vy, ax, ay, s = scaled
    until = ldexp(until, -time)
    t = contact_time_filtered(
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, x, y, vx, vy, ax, ay, s, until, parted
    )
    if t == 0.0 or t == NEVER:
        return t
    t = ldexp(t, time)
    return t if t >= _LEAST else UNDECIDED


def _escape(x: float, y: float, vx: float, vy: float, ax: float, ay: float, s: float) -> float:
    """A time (s) from which on p > 0 for good; infinite if none is known.

    |R| >= |a| t^2 / 2 - |v| t - |r|. From 4 |v| / |a| on the second is at most half of the first, and from
    sqrt(8 (|r| + s) / |a|) on what is left, |a| t^2 / 4, is at least 2 (|r| + s), so |R| > s. Without acceleration
    |v| t >= 2 (|r| + s) does. The factor 2 covers the rounding. `parted` only makes p larger.
    """
    reach, speed, pull = distance(x, y) + s, distance(vx, vy), distance(ax, ay)
    if pull > 0.0:
        return 2.0 * max(4.0 * (speed / pull), sqrt(8.0) * sqrt(reach) / sqrt(pull))
    return 4.0 * (reach / speed) if speed > 0.0 else inf


def _rising(x: float, y: float, vx: float, vy: float, hx: float, hy: float, t: float) -> float:
    """A number that proves, if it is less than b = r.v, that p rises up to `t` and by more than b t.

    p' / 2 = b + (v.v + r.a) t + 3/2 (v.a) t^2 + (a.a / 2) t^3 is above b - |r.a| t - 3/2 |v.a| t^2, and p - p(0)
    above 2 b t - |r.a| t^2 - |v.a| t^3. The number is 2 (|r.a| t + |v.a| t^2) and more, with sums of magnitudes for
    the dot products: at least 4/3 of what is needed, which covers the rounding.
    """
    linear = 4.0 * (abs(x * hx) + abs(y * hy))
    square = 4.0 * (abs(vx * hx) + abs(vy * hy))
    return t * (linear + square * t)


def _receding(
    x: float, y: float, vx: float, vy: float, hx: float, hy: float,
    s: float, ss: float, b: float, depth: float, until: float,
) -> float:  # fmt: skip
    """The time for a pair that touches or overlaps and recedes: b = r.v > 0, p(0) >= -`depth`.

    Up to `start`, as long as `_rising` proves it, p rises, and by more than b start. Once that is more than `depth`,
    p is above 0 there, and the search is the usual one. Else p may turn inside the overlap.
    """
    start = until
    for _ in range(_PIECES):
        if _rising(x, y, vx, vy, hx, hy, start) < b:
            break
        start = 0.5 * start
    else:
        return UNDECIDED
    if start == until:
        return NEVER
    return (
        _first_fall(x, y, vx, vy, hx, hy, s, ss, start, until) if b * start > depth else UNDECIDED
    )


def _first_fall(
    x: float, y: float, vx: float, vy: float, hx: float, hy: float,
    s: float, ss: float, low: float, until: float,
) -> float:  # fmt: skip
    """The first root in [low, until], knowing that p(low) > 0: halves what `_falls` cannot decide, left first."""
    ends = [until]
    for _ in range(_PIECES):
        high = ends[-1]
        verdict = _falls(x, y, vx, vy, hx, hy, s, ss, low, high)
        if verdict > 0:
            ends.pop()
            if not ends:
                return NEVER
            low = high
        elif verdict < 0:
            return _root((x, y, vx, vy, hx, hy, ss), low, high)
        else:
            ends.append(0.5 * (low + high))
    return UNDECIDED


def _falls(
    x: float, y: float, vx: float, vy: float, hx: float, hy: float,
    s: float, ss: float, low: float, high: float,
) -> int:  # fmt: skip
    """What p does from `low` to `high`: 1 if it stays above 0, -1 if it falls through 0 just once, else 0.

    The path is a parabola, a Bezier curve whose control points are A = R(low), B = A + R'(low) (high - low) / 2 and
    C = R(high). It lies in the triangle ABC: if all three are beyond s on one axis, it stays clear. The Bernstein
    coefficients of p are A.A, A.B, (A.C + 2 B.B) / 3, B.C and C.C, each minus s^2. All positive: p > 0. One change
    of sign from + to -: exactly one root, and a simple one (Descartes), whatever one doubtful coefficient between is.

    Errors: with D = max over the axes of |x| + |vx| high + |ax| high^2 / 2, plus s, Horner's rule gives A and C to
    5 u D, and B to 6 u D (its terms add up to no more than D either). With m the largest control component or s, an
    axis of a product of two points carries 12 u m D + u m^2 and 36 u^2 D^2; both axes, their sum, the mean of A.C
    and B.B, s^2 and the last difference together at most 40 u m D + 72 u^2 D^2. E = K D (m + K D), K = 64 u, covers
    them and the roundings of E itself.
    """
    width = high - low
    ax = x + low * (vx + low * hx)
    cx = x + high * (vx + high * hx)
    bx = ax + 0.5 * width * (vx + 2.0 * low * hx)
    dx = abs(x) + high * (abs(vx) + high * abs(hx))
    ay = y + low * (vy + low * hy)
    cy = y + high * (vy + high * hy)
    by = ay + 0.5 * width * (vy + 2.0 * low * hy)
    dy = abs(y) + high * (abs(vy) + high * abs(hy))
    reach = _SIGN_Q * ((dx if dx > dy else dy) + s)
    far = s + reach
    if (
        (ax > far and bx > far and cx > far)
        or (ay > far and by > far and cy > far)
        or (-ax > far and -bx > far and -cx > far)
        or (-ay > far and -by > far and -cy > far)
    ):
        return 1
    error = reach * (max(abs(ax), abs(bx), abs(cx), abs(ay), abs(by), abs(cy), s) + reach)
    first = (ax * ax + ay * ay) - ss
    if not first > error:
        return 0
    second = (ax * bx + ay * by) - ss
    third = ((ax * cx + ay * cy) + 2.0 * (bx * bx + by * by)) / 3.0 - ss
    fourth = (bx * cx + by * cy) - ss
    last = (cx * cx + cy * cy) - ss
    if last > error:
        return 1 if second > error and third > error and fourth > error else 0
    if not last < -error:
        return 0
    # + ? - - -, + + ? - - and + + + ? -: one change of sign.
    falling = (
        (third < -error and fourth < -error)
        or (second > error and fourth < -error)
        or (second > error and third > error)
    )
    return -1 if falling else 0


_Motion = tuple[float, float, float, float, float, float, float]


def _measure(motion: _Motion, t: float) -> tuple[float, float, float, float]:
    """p(t), p'(t), a bound of the error of p(t), and a bound of |p''| up to t.

    R, not the five coefficients: at the contact |R| = s, so the error is of the size u s D and not u D^2. Horner's
    rule for an axis of R carries at most 5 u (|x| + |vx| t + |ax| t^2 / 2), hence R.R twice |Rx| times that plus
    2 u R.R, and s^2 carries 3 u s^2. That is within 5 u cond t |p'|, for |dt/dz| = |dp/dz| / |p'|, where dp/dx is
    2 Rx, dp/dvx is 2 Rx t, dp/dax is Rx t^2 and dp/ds is -2 s.
    """
    x, y, vx, vy, hx, hy, ss = motion
    rx = x + t * (vx + t * hx)
    ry = y + t * (vy + t * hy)
    p = (rx * rx + ry * ry) - ss
    slope = 2.0 * (rx * (vx + 2.0 * t * hx) + ry * (vy + 2.0 * t * hy))
    dx = abs(x) + t * (abs(vx) + t * abs(hx))
    dy = abs(y) + t * (abs(vy) + t * abs(hy))
    noise = _NOISE * ((abs(rx) * dx + abs(ry) * dy) + ss)
    wx = abs(vx) + 2.0 * t * abs(hx)
    wy = abs(vy) + 2.0 * t * abs(hy)
    bend = 2.0 * ((wx * wx + wy * wy) + 2.0 * (dx * abs(hx) + dy * abs(hy)))
    return p, slope, noise, bend


def _root(motion: _Motion, low: float, high: float) -> float:
    """The one falling root between `low` and `high`, by Newton's rule, halving where it would leave the bracket.

    It stops where the value is within its error F, and one last step leaves at most F / |p'| and the curvature:
    F^2 |p''| / (2 |p'|^3). The time is accepted if 64 F |p''| <= |p'|^2, which makes that 1/128 of F / |p'| and
    keeps p' steady across the error; F itself is at least twice what `_measure` derives. Where |p'|^2 is beyond the
    doubles, so is what it is compared with, perhaps.
    """
    t = 0.5 * (low + high)
    lowest, highest = low, high
    for _ in range(_PIECES):
        value, slope, noise, bend = _measure(motion, t)
        if abs(value) <= noise:
            if not 64.0 * noise * bend <= slope * slope < inf:
                return UNDECIDED
            t -= value / slope
            return min(max(t, lowest), highest)
        if value > 0.0:
            low = t
        else:
            high = t
        following = t - value / slope if slope < 0.0 else low
        t = following if low < following < high else 0.5 * (low + high)
    return UNDECIDED
