"""The exact time: every double is an integer times a power of two, and Sturm's chains decide the rest."""

from __future__ import annotations

import struct
from math import inf
from sys import float_info

from fasteroids.physics import NEVER
from fasteroids.quartic._polynomials import (
    Polynomial,
    derivative,
    odd_part,
    primitive,
    product,
    sign_after,
    sturm_chain,
    value_at,
    variations,
)

__all__ = ["contact_time_exact"]


def contact_time_exact(
    xi: float, yi: float, vxi: float, vyi: float, axi: float, ayi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, axj: float, ayj: float, rj: float,
    until: float, parted: bool,
) -> float:  # fmt: skip
    """The same, always decided and correctly rounded, in integer arithmetic.

    p has integer coefficients once every double is an integer times one power of two. Its changes of sign are the
    roots of its odd part (`odd_part`), all of them simple and alternating, and Sturm's chain counts those up to
    any double. Inputs that are not finite give NEVER.
    """
    values = (xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj)
    if not all(-inf < value < inf for value in values):
        return NEVER
    until = min(until, float_info.max)
    p = _polynomial(values, parted)
    slope = derivative(p)
    trend = sign_after(slope, 0, 0)
    if not p or p[0] <= 0:
        if trend <= 0:
            return 0.0 if trend < 0 else NEVER
        turn = _turn(p, slope, until)
        if turn is not None:
            return turn
    odd = odd_part(p)
    # Falling and rising roots alternate: the first one falls if p is positive at first, else the second one.
    return _rounded(odd, 1 if sign_after(odd, 0, 0) > 0 else 2, until)


def _polynomial(values: tuple[float, ...], parted: bool) -> Polynomial:
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
        linear = max(linear, 0)
    square = 4 * (vx * vx + vy * vy + x * ax + y * ay)
    return primitive([constant, linear, square, 4 * (vx * ax + vy * ay), ax * ax + ay * ay])


def _turn(p: Polynomial, slope: Polynomial, until: float) -> float | None:
    """Where p, rising from p(0) <= 0, turns to fall with p <= 0 still; NEVER if it does not turn; None if p > 0.

    The turn t is the first root of the odd part f of p'. The sign of p there is exact by Tarski's query: along the
    chain of f and f' p, the variations lost from one point to another are the sum of sign(p) over the roots of f
    between.
    """
    f = odd_part(slope)
    chain = sturm_chain(f, derivative(f))
    bracket = _bracket(chain, 1, until)
    if bracket is None:
        return NEVER
    query = sturm_chain(f, product(derivative(f), p))
    low, high = (variations(query, *end.as_integer_ratio()) for end in bracket)
    return _nearest(chain, 1, *bracket) if low - high <= 0 else None


def _rounded(odd: Polynomial, number: int, until: float) -> float:
    """The root of this number (from 1) of a polynomial with simple roots, in (0, until], correctly rounded."""
    chain = sturm_chain(odd, derivative(odd))
    bracket = _bracket(chain, number, until)
    return NEVER if bracket is None else _nearest(chain, number, *bracket)


def _bracket(chain: list[Polynomial], number: int, until: float) -> tuple[float, float] | None:
    """Neighbouring doubles (low, high] around the root of this number beyond 0; None if it is beyond `until`.

    Halves the positions of doubles, not their values: 64 steps reach any of them. The chain counts the roots up to
    a time. Once one is left between the two ends the sign of the polynomial alone tells on which side it is: the
    roots are simple, and it changes at each of them.
    """
    start = variations(chain, 0, 1)

    def roots_up_to(t: float) -> int:
        return start - variations(chain, *t.as_integer_ratio())

    low, high = 0, _position(until)
    below, above = 0, roots_up_to(until)
    if above < number:
        return None
    first = sign_after(chain[0], 0, 0)
    while high - low > 1:
        middle = (low + high) // 2
        t = _double(middle)
        if above - below > 1:
            count = roots_up_to(t)
        else:
            unchanged = sign_after(chain[0], *t.as_integer_ratio()) == first * (-1) ** below
            count = below if unchanged else above
        if count < number:
            low, below = middle, count
        else:
            high, above = middle, count
    return _double(low), _double(high)


def _nearest(chain: list[Polynomial], number: int, low: float, high: float) -> float:
    """Whichever of two neighbouring doubles is nearer to the root in (low, high]; of equals, the even one."""
    (m, d), (n, e) = low.as_integer_ratio(), high.as_integer_ratio()
    numerator, denominator = m * e + n * d, 2 * d * e
    lost = variations(chain, 0, 1) - variations(chain, numerator, denominator)
    if lost < number:
        return high
    if value_at(chain[0], numerator, denominator) == 0:
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
