"""Contact time of two discs whose accelerations are constant, on plain floats: a filter, and exact integers.

Notation: r, v, a are the relative position, velocity and acceleration (j seen from i), s is the sum of the radii,
R(t) = r + v t + a t^2 / 2 and

    p(t) = R.R - s^2 = (r.r - s^2) + 2 (r.v) t + (v.v + r.a) t^2 + (v.a) t^3 + (a.a / 4) t^4.

The discs overlap or touch where p <= 0 and approach where p falls. A contact is the first time from 0 to `until`
at which they do both:

* p(0) > 0: the first root at which p changes its sign from + to -. A root that only touches zero is a miss.
* p(0) <= 0 and p falls right after 0: time 0.
* p(0) <= 0 and p rises right after 0: they recede. The next contact is where p turns from rising to falling, if
  p <= 0 there still (the turn inside an overlap), else the next root at which p falls.
* `parted`: the pair has just bounced off one another, so it touches and recedes up to rounding. Then p(0) counts
  as 0 and p'(0) as max(p'(0), 0), and the rules above apply.

Every sum of an x-term and a y-term is symmetric and every quantity even in (r, v, a), so swapping the discs,
negating an axis or swapping the axes gives the same bits.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from itertools import pairwise
from math import gcd, inf, sqrt

from fasteroids.physics import NEVER, UNDECIDED

__all__ = ["contact_time", "contact_time_exact", "contact_time_filtered"]

_U = 2.0**-53  # unit roundoff of binary64
_SIGN_B = 8 * _U
_SIGN_C = 16 * _U
_SIGN_Q = 64 * _U
_NOISE = 16 * _U
_TINY = 2.0**-1000
_SMALL = 2.0**-480
_LONG = 2.0**200
_PIECES = 128  # a contact is found in a handful; more only for roots closer than rounding can tell


def contact_time(
    xi: float, yi: float, vxi: float, vyi: float, axi: float, ayi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, axj: float, ayj: float, rj: float,
    until: float, parted: bool,
) -> float:  # fmt: skip
    """Seconds until two discs touch or 0.0 or NEVER, as the module says: the filter, and what it leaves, exactly.

    The class (hit or miss) is right for the doubles given, whatever they are; the time is off by at most
    ulp/2 + 16 u cond t, where cond t is the sum over the inputs z of |dt/dz| |z|.
    """
    t = contact_time_filtered(
        xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj, until, parted
    )
    if t == t:
        return t
    return contact_time_exact(
        xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj, until, parted
    )


# --- the filter -------------------------------------------------------------------------------------------------


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
    """
    x = xj - xi
    y = yj - yi
    vx = vxj - vxi
    vy = vyj - vyi
    hx = 0.5 * (axj - axi)
    hy = 0.5 * (ayj - ayi)
    s = ri + rj
    ss = s * s
    if not (ss >= _SMALL and until <= _LONG):
        return UNDECIDED
    if parted:
        return _time_parted(x, y, vx, vy, hx, hy, until)
    rr = x * x + y * y
    c = rr - ss
    error = _SIGN_C * (rr + ss)
    if c > error:
        return _first_fall(x, y, vx, vy, hx, hy, s, ss, 0.0, until, False)
    bx = x * vx
    by = y * vy
    b = bx + by
    error_b = _SIGN_B * (abs(bx) + abs(by)) + _TINY
    if b > error_b and _rising(x, y, vx, vy, hx, hy, until) < b:
        return NEVER
    if b < -error_b and c < -error and abs(hx) + abs(hy) < inf:
        return 0.0
    return UNDECIDED


def _rising(x: float, y: float, vx: float, vy: float, hx: float, hy: float, t: float) -> float:
    """A number that proves, if it is less than b = r.v, that p rises up to `t` and by more than b t.

    p' / 2 = b + (v.v + r.a) t + 3/2 (v.a) t^2 + (a.a / 2) t^3 is above b - |r.a| t - 3/2 |v.a| t^2, and p - p(0)
    above 2 b t - |r.a| t^2 - |v.a| t^3. The number is 2 (|r.a| t + |v.a| t^2) and more, with sums of magnitudes for
    the dot products: at least 4/3 of what is needed, which covers the rounding.
    """
    linear = 4.0 * (abs(x * hx) + abs(y * hy))
    square = 4.0 * (abs(vx * hx) + abs(vy * hy))
    return t * (linear + square * t)


def _time_parted(
    x: float, y: float, vx: float, vy: float, hx: float, hy: float, until: float
) -> float:
    """The time for a pair that has just bounced: p without its constant, so that p(0) = 0.

    Only for b clearly above 0. Then p rises at first: no contact as long as `_rising` proves it. From there on p is
    above 0 and the search is the usual one, with r.r for s^2.
    """
    bx = x * vx
    by = y * vy
    b = bx + by
    if not b > _SIGN_B * (abs(bx) + abs(by)) + _TINY:
        return UNDECIDED
    start = until
    for _ in range(_PIECES):
        if _rising(x, y, vx, vy, hx, hy, start) < b:
            break
        start = 0.5 * start
    else:
        return UNDECIDED
    if start == until:
        return NEVER
    rr = x * x + y * y
    if not rr >= _SMALL:
        return UNDECIDED
    return _first_fall(x, y, vx, vy, hx, hy, sqrt(rr), rr, start, until, True)


def _first_fall(
    x: float, y: float, vx: float, vy: float, hx: float, hy: float,
    s: float, ss: float, low: float, until: float, parted: bool,
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
            measure = _measure_parted if parted else _measure
            return _root(measure, (x, y, vx, vy, hx, hy, ss), low, high)
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
_Measure = Callable[[_Motion, float], tuple[float, float, float, float]]


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


def _measure_parted(motion: _Motion, t: float) -> tuple[float, float, float, float]:
    """The same for g(t) = p(t) / t of a parted pair, p = R.R - r.r.

    With w = v + a t / 2, R = r + t w and g = w.(2 r + t w): nothing is left of the constant, so a pair that falls
    back to where it parted has no error from r. What rounding does to w is a change of v and a by 3 u, to r one by
    u; the other roundings carry at most 4 u |wx| (2 |x| + t |wx|) an axis, where |wx| t <= |Rx| + |x|: within
    8 u cond t |p'| / t together.
    """
    x, y, vx, vy, hx, hy, _ = motion
    wx = vx + t * hx
    wy = vy + t * hy
    ex = 2.0 * x + t * wx
    ey = 2.0 * y + t * wy
    g = wx * ex + wy * ey
    slope = (hx * ex + wx * (wx + t * hx)) + (hy * ey + wy * (wy + t * hy))
    fx = abs(vx) + t * abs(hx)
    fy = abs(vy) + t * abs(hy)
    noise = _NOISE * (fx * (2.0 * abs(x) + t * fx) + fy * (2.0 * abs(y) + t * fy))
    bend = 4.0 * ((fx * abs(hx) + fy * abs(hy)) + t * (hx * hx + hy * hy))
    return g, slope, noise, bend


def _root(measure: _Measure, motion: _Motion, low: float, high: float) -> float:
    """The one falling root between `low` and `high`, by Newton's rule, halving where it would leave the bracket.

    It stops where the value is within its error F, and one last step leaves at most F / |p'| and the curvature:
    F^2 |p''| / (2 |p'|^3). The time is accepted if 64 F |p''| <= |p'|^2, which makes that 1/128 of F / |p'| and
    keeps p' steady across the error; F itself is at least twice what its measure derives.
    """
    t = 0.5 * (low + high)
    lowest, highest = low, high
    for _ in range(_PIECES):
        value, slope, noise, bend = measure(motion, t)
        if abs(value) <= noise:
            if not 64.0 * noise * bend <= slope * slope:
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


# --- the exact time ---------------------------------------------------------------------------------------------

_Polynomial = list[int]  # coefficients from the constant on; the last is not 0, and [] is 0


def contact_time_exact(
    xi: float, yi: float, vxi: float, vyi: float, axi: float, ayi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, axj: float, ayj: float, rj: float,
    until: float, parted: bool,
) -> float:  # fmt: skip
    """The same, always decided and correctly rounded, in integer arithmetic.

    p has integer coefficients once every double is an integer times one power of two. Its changes of sign are the
    roots of its odd part (`_odd_part`), all of them simple and alternating, and Sturm's chain counts those up to
    any double. Inputs that are not finite give NEVER.
    """
    values = (xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj)
    if not all(-inf < value < inf for value in values):
        return NEVER
    p = _polynomial(values, parted)
    slope = _derivative(p)
    trend = _sign_after(slope, 0, 0)
    if not p or p[0] <= 0:
        if trend <= 0:
            return 0.0 if trend < 0 else NEVER
        turn = _turn(p, slope, until)
        if turn is not None:
            return turn
    odd = _odd_part(p)
    # Falling and rising roots alternate: the first one falls if p is positive at first, else the second one.
    return _rounded(odd, 1 if _sign_after(odd, 0, 0) > 0 else 2, until)


def _polynomial(values: tuple[float, ...], parted: bool) -> _Polynomial:
    """4 p with integer coefficients, up to one power of two."""
    ratios = [value.as_integer_ratio() for value in values]
    common = max(denominator for _, denominator in ratios)  # powers of two all
    xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj = (
        numerator * (common // denominator) for numerator, denominator in ratios
    )
    x, y, vx, vy, ax, ay, s = xj - xi, yj - yi, vxj - vxi, vyj - vyi, axj - axi, ayj - ayi, ri + rj
    constant = 4 * (x * x + y * y - s * s)
    linear = 8 * (x * vx + y * vy)
    if parted:
        constant, linear = 0, max(linear, 0)
    square = 4 * (vx * vx + vy * vy + x * ax + y * ay)
    return _primitive([constant, linear, square, 4 * (vx * ax + vy * ay), ax * ax + ay * ay])


def _turn(p: _Polynomial, slope: _Polynomial, until: float) -> float | None:
    """Where p, rising from p(0) <= 0, turns to fall with p <= 0 still; NEVER if it does not turn; None if p > 0.

    The turn t is the first root of the odd part f of p'. The sign of p there is exact by Tarski's query: along the
    chain of f and f' p, the variations lost from one point to another are the sum of sign(p) over the roots of f
    between.
    """
    f = _odd_part(slope)
    chain = _chain(f, _derivative(f))
    bracket = _bracket(chain, 1, until)
    if bracket is None:
        return NEVER
    query = _chain(f, _product(_derivative(f), p))
    low, high = (_variations(query, *end.as_integer_ratio()) for end in bracket)
    return _nearest(chain, 1, *bracket) if low - high <= 0 else None


def _rounded(odd: _Polynomial, number: int, until: float) -> float:
    """The root of this number (from 1) of a polynomial with simple roots, in (0, until], correctly rounded."""
    chain = _chain(odd, _derivative(odd))
    bracket = _bracket(chain, number, until)
    return NEVER if bracket is None else _nearest(chain, number, *bracket)


def _bracket(chain: list[_Polynomial], number: int, until: float) -> tuple[float, float] | None:
    """Neighbouring doubles (low, high] around the root of this number beyond 0; None if it is beyond `until`.

    Halves the positions of doubles, not their values: 64 steps reach any of them.
    """
    start = _variations(chain, 0, 1)

    def beyond(t: float) -> bool:
        return start - _variations(chain, *t.as_integer_ratio()) < number

    if beyond(until):
        return None
    low, high = 0, _position(until)
    while high - low > 1:
        middle = (low + high) // 2
        if beyond(_double(middle)):
            low = middle
        else:
            high = middle
    return _double(low), _double(high)


def _nearest(chain: list[_Polynomial], number: int, low: float, high: float) -> float:
    """Whichever of two neighbouring doubles is nearer to the root in (low, high]; of equals, the even one."""
    (m, d), (n, e) = low.as_integer_ratio(), high.as_integer_ratio()
    numerator, denominator = m * e + n * d, 2 * d * e
    lost = _variations(chain, 0, 1) - _variations(chain, numerator, denominator)
    if lost < number:
        return high
    if _value(chain[0], numerator, denominator) == 0:
        return low if _position(low) % 2 == 0 else high
    return low


def _position(t: float) -> int:
    """How many doubles lie between 0.0 and t >= 0."""
    position: int = struct.unpack("<q", struct.pack("<d", abs(t)))[0]
    return position


def _double(position: int) -> float:
    """The double at this position above 0.0."""
    t: float = struct.unpack("<d", struct.pack("<q", position))[0]
    return t


def _variations(chain: list[_Polynomial], numerator: int, denominator: int) -> int:
    """The changes of sign along a chain, just after numerator / denominator."""
    signs = [_sign_after(f, numerator, denominator) for f in chain]
    return sum(one != other for one, other in pairwise(signs))


def _sign_after(f: _Polynomial, numerator: int, denominator: int) -> int:
    """The sign of f just after a point: of the first of f, f', f'', ... that is not 0 there."""
    while f:
        value = _value(f, numerator, denominator) if numerator else f[0]
        if value:
            return 1 if value > 0 else -1
        f = _derivative(f)
    return 0


def _value(f: _Polynomial, numerator: int, denominator: int) -> int:
    """f(numerator / denominator) times a power of the denominator (positive)."""
    value, power = 0, 1
    for coefficient in reversed(f):
        value = value * numerator + coefficient * power
        power *= denominator
    return value


def _derivative(f: _Polynomial) -> _Polynomial:
    return [k * coefficient for k, coefficient in enumerate(f)][1:]


def _product(f: _Polynomial, g: _Polynomial) -> _Polynomial:
    if not f or not g:
        return []
    product = [0] * (len(f) + len(g) - 1)
    for i, one in enumerate(f):
        for j, other in enumerate(g):
            product[i + j] += one * other
    return product


def _primitive(f: _Polynomial) -> _Polynomial:
    """f without leading zeros and common factors; signs stay."""
    while f and f[-1] == 0:
        f = f[:-1]
    content = gcd(*f)
    return [coefficient // content for coefficient in f]


def _divided(f: _Polynomial, g: _Polynomial) -> tuple[_Polynomial, _Polynomial]:
    """Quotient and remainder of f by g, each up to a positive factor."""
    lead, sign = abs(g[-1]), 1 if g[-1] > 0 else -1
    quotient = [0] * max(len(f) - len(g) + 1, 0)
    while len(f) >= len(g):
        top, shift = sign * f[-1], len(f) - len(g)
        quotient = [lead * coefficient for coefficient in quotient]
        quotient[shift] = top
        f = [lead * coefficient for coefficient in f]
        for k, coefficient in enumerate(g):
            f[k + shift] -= top * coefficient
        f = f[:-1]
    return _primitive(quotient), _primitive(f)


def _chain(f: _Polynomial, g: _Polynomial) -> list[_Polynomial]:
    """f, g and so on: each the negative remainder of the two before it, as Sturm has it. Ends with gcd(f, g)."""
    chain = [_primitive(f)]
    g = _primitive(g)
    while g:
        chain.append(g)
        g = [-coefficient for coefficient in _divided(chain[-2], g)[1]]
    return chain


def _odd_part(f: _Polynomial) -> _Polynomial:
    """The product of the factors of odd multiplicity, each once: f over a square, its roots where f changes sign."""
    rest = _chain(f, _derivative(f))[-1]
    if len(rest) <= 1 or len(f) <= 1:
        return f
    factors, _ = _divided(f, rest)  # every factor once; `rest` has it once less than f
    odd, multiplicity = [1], 1
    while len(factors) > 1:
        repeated = _chain(rest, factors)[-1]
        if multiplicity % 2 == 1:
            odd = _product(odd, _divided(factors, repeated)[0])
        factors, rest = repeated, _divided(rest, repeated)[0]
        multiplicity += 1
    return odd if (odd[-1] > 0) == (f[-1] > 0) else [-coefficient for coefficient in odd]
