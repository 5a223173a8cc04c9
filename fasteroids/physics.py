"""The laws of motion on plain floats: contact time, wall time, bounce, speed limit, thrust, mass.

Everything here takes and returns floats (km, s, km/s, kg), knows no world and raises nothing. Only ``+ - * /``,
``sqrt`` and exact scalings are used wherever another backend must agree bit for bit.

Notation of the contact formulas (assignment 1.5.1): r = r_j - r_i and v = v_j - v_i are the relative position
and velocity, s the sum of the radii, a = v.v, b = v.r, c = r.r - s^2, k = v x r (2-D cross product).
The discs touch when a t^2 + 2 b t + c = 0, whose discriminant is

    d = b^2 - a c = a s^2 - k^2.

The second form is the *impact form*: k / sqrt(a) is the impact parameter, the distance at which the centres
would pass. It does not cancel for distant targets, where b^2 and a r.r agree to (r/s)^2.
"""

from __future__ import annotations

from math import frexp, inf, isqrt, ldexp, nan, pi, sqrt

__all__ = [
    "NEVER",
    "UNDECIDED",
    "approaching",
    "bounce",
    "contact_time_exact",
    "contact_time_filtered",
    "distance",
    "limit_contact",
    "limit_speed",
    "sphere_mass",
    "thrust",
    "unit",
    "wall_time",
    "with_component",
]

NEVER = inf
"""The time of an event that will not happen."""

UNDECIDED = nan
"""A filter's answer when rounding may have changed the decision: ask the exact formula."""

_U = 2.0**-53  # unit roundoff of binary64
_SIGN_B = 8 * _U
_SIGN_D = 16 * _U
_TINY = 2.0**-1000
_SMALL = 2.0**-480
_LARGE = 2.0**480


def contact_time_filtered(
    xi: float, yi: float, vxi: float, vyi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, rj: float,
) -> float:  # fmt: skip
    """Seconds until two discs touch, 0.0 if they overlap and approach, NEVER, or UNDECIDED.

    Every answer but UNDECIDED has the right class (hit or miss) for the ten doubles given, whatever they are.
    UNDECIDED comes when a sign could be wrong, or when a product could have left the range of doubles.

    The constants, derived. With u = 2^-53, each computed difference (and the sum s) carries a relative error of
    at most u, each product and sum one more. To first order, and as long as nothing underflows:

    * b is a sum of two products of two differences: abs(error) <= 4 u B, with B = |vx x| + |vy y|.
      The sign of b is proven when |b| >= 8 u B: the factor 2 covers the second-order terms and the roundings of
      the bound itself. Underflow adds at most 2^-1073 to b, covered by the added 2^-1000.
    * a s^2 carries at most 8 u a s^2 (two for v, one product, one sum, two for s, two products).
    * k carries at most 4 u K, with K = |vx y| + |vy x|; hence k^2 at most 8 u K |k| + u k^2 <= 9 u K |k|.
    * the difference d carries at most u |d| <= u max(a s^2, k^2) on top.

      Together at most 9 u a s^2 + 10 u K |k|. E = 16 u (a s^2 + K |k|) covers it with its second-order terms.
      A miss is proven when d < -E. A hit is accepted only when d > 16 E, since then sqrt d is off by at most
      1/32 and the first-order bound of the time (below) holds to a few per cent.
    * Underflow: with a and s^2 above 2^-480 their product has full precision, and the errors of at most
      2^-1073 in the products of k change k^2 by less than 2^-1071 |k|, which E covers. If a product overflows,
      E is infinite or nan and both comparisons fail.

    The time is c / (sqrt d - b), a quotient without cancellation. Write C / sqrt d for cond * t, the sum over
    the ten inputs z of |dt/dz| |z|. The subtractions are backward stable (u C / sqrt d together); c contributes
    at most 3/4, a s^2 and K |k| together 11/4, b 3/2 and the two last roundings 1, all times u C / sqrt d. So
    7 u cond t is proven to first order; the contract, tested against the exact formula, is
    ulp/2 + 4 u cond t, and the largest factor ever seen is below 2.
    """
    x = xj - xi
    y = yj - yi
    vx = vxj - vxi
    vy = vyj - vyi
    bx = vx * x
    by = vy * y
    b = bx + by
    error = _SIGN_B * (abs(bx) + abs(by)) + _TINY
    if not b < -error:
        if b > error or (vx == 0.0 and vy == 0.0):
            return NEVER
        return UNDECIDED
    s = ri + rj
    ss = s * s
    a = vx * vx + vy * vy
    if a < _SMALL or ss < _SMALL:
        return UNDECIDED
    p = vx * y
    q = vy * x
    k = p - q
    ass = a * ss
    d = ass - k * k
    error = _SIGN_D * (ass + (abs(p) + abs(q)) * abs(k))
    if not d > 16.0 * error:
        return NEVER if d < -error else UNDECIDED
    c = x * x + y * y - ss
    if c > 0.0:
        t = c / (sqrt(d) - b)
        return t if t < inf else UNDECIDED
    return 0.0


def _integers(*values: float) -> tuple[list[int], int]:
    """The values as integers times one power of two: ([n, ...], e) with value = n * 2^e, exactly."""
    ratios = [value.as_integer_ratio() for value in values]
    shift = max(denominator.bit_length() for _, denominator in ratios) - 1
    return [n << (shift - (m.bit_length() - 1)) for n, m in ratios], -shift


def _quotient(numerator: int, denominator: int, exponent: int) -> float:
    """numerator / denominator * 2^exponent, correctly rounded; inf above the doubles."""
    if exponent >= 0:
        numerator <<= exponent
    else:
        denominator <<= -exponent
    try:
        return numerator / denominator
    except OverflowError:
        return inf


def contact_time_exact(
    xi: float, yi: float, vxi: float, vyi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, rj: float,
) -> float:  # fmt: skip
    """The same as `contact_time_filtered`, always decided and correctly rounded, in integer arithmetic.

    Every double is an integer times a power of two, so the signs of b, c and d are exact. sqrt d is bracketed
    by two neighbouring multiples of 2^-m; m doubles until both ends of the bracket round to the same time. It
    ends because c / (sqrt d - b) is rational only if d is a square, and then one quotient settles it. Inputs
    that are not finite give NEVER.
    """
    if not all(-inf < value < inf for value in (xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj)):
        return NEVER
    (ixi, iyi, iri, ixj, iyj, irj), length = _integers(xi, yi, ri, xj, yj, rj)
    (ivxi, ivyi, ivxj, ivyj), speed = _integers(vxi, vyi, vxj, vyj)
    x, y, s = ixj - ixi, iyj - iyi, iri + irj
    vx, vy = ivxj - ivxi, ivyj - ivyi
    b = vx * x + vy * y
    if b >= 0:
        return NEVER
    c = x * x + y * y - s * s
    if c <= 0:
        return 0.0
    d = b * b - (vx * vx + vy * vy) * c
    if d <= 0:
        return NEVER
    scale = length - speed  # lengths are multiples of 2^length km, speeds of 2^speed km/s
    bits = max(0, 80 - d.bit_length() // 2)
    while True:
        root = isqrt(d << 2 * bits)
        numerator = c << bits
        low = _quotient(numerator, root + 1 - (b << bits), scale)
        high = _quotient(numerator, root - (b << bits), scale)
        if low == high or root * root == d << 2 * bits:
            return high
        bits = 2 * bits + 64


def wall_time(x: float, v: float, low: float, high: float) -> float:
    """Seconds until a coordinate `x` (km) moving at `v` (km/s) meets the end of [low, high] ahead of it.

    0.0 if it is there or beyond already; NEVER if v is zero. The wall is chosen by the sign of the velocity
    alone, so a disc that rounding left beyond a wall it is moving away from meets nothing there.
    """
    if v > 0.0:
        t = (high - x) / v
    elif v < 0.0:
        t = (low - x) / v
    else:
        return NEVER
    return t if t > 0.0 else 0.0


def distance(x: float, y: float) -> float:
    """sqrt(x^2 + y^2) without overflow or underflow on the way."""
    big = max(abs(x), abs(y))
    if big == 0.0 or big == inf:
        return big
    scale = frexp(big)[1]
    x, y = ldexp(x, -scale), ldexp(y, -scale)
    root = sqrt(x * x + y * y)
    try:
        return ldexp(root, scale)
    except OverflowError:
        return inf


def unit(x: float, y: float) -> tuple[float, float]:
    """The unit vector along the finite (x, y), without overflow or underflow on the way; (0, 0) for (0, 0)."""
    big = max(abs(x), abs(y))
    if big == 0.0:
        return 0.0, 0.0
    scale = frexp(big)[1]
    x, y = ldexp(x, -scale), ldexp(y, -scale)
    root = sqrt(x * x + y * y)
    return x / root, y / root


def approaching(x: float, y: float, vx: float, vy: float) -> bool:
    """Does a relative velocity (km/s) shorten a relative position (km)? The sign of b, as computed.

    Scaled by powers of two first, so that the sign is not lost to underflow.
    """
    big = max(abs(x), abs(y))
    fast = max(abs(vx), abs(vy))
    if big == 0.0 or fast == 0.0:
        return False
    m, n = -frexp(big)[1], -frexp(fast)[1]
    return ldexp(vx, n) * ldexp(x, m) + ldexp(vy, n) * ldexp(y, m) < 0.0


def bounce(
    x: float, y: float,
    vxi: float, vyi: float, mi: float,
    vxj: float, vyj: float, mj: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Velocities (vxi, vyi, vxj, vyj) after an elastic bounce of two discs (assignment 1.5.2).

    `x`, `y` is the position of j seen from i (km), the line of centres; `mi`, `mj` are masses (kg, positive).
    If the two do not approach, or the centres coincide, nothing changes.

    The impulse of the text in reduced-mass form, v_i + 2 w_i (b / r.r) r with w_i = m_j / (m_i + m_j), divided
    by the true squared distance instead of sigma^2: the balance of energy is then exact whatever rounding left
    between the discs, and no product of masses overflows. An extreme r is scaled by a power of two, the weights
    come from the smaller ratio of the masses.
    """
    big = max(abs(x), abs(y))
    if big == 0.0:
        return vxi, vyi, vxj, vyj
    if not _SMALL < big < _LARGE:  # scaling is exact: it only keeps the squares in range
        scale = -frexp(big)[1]
        x, y = ldexp(x, scale), ldexp(y, scale)
    b = (vxj - vxi) * x + (vyj - vyi) * y
    if not b < 0.0:
        return vxi, vyi, vxj, vyj
    if mi <= mj:
        ratio = mi / mj
        wi, wj = 1.0 / (1.0 + ratio), ratio / (1.0 + ratio)
    else:
        ratio = mj / mi
        wi, wj = ratio / (1.0 + ratio), 1.0 / (1.0 + ratio)
    f = 2.0 * b / (x * x + y * y)
    fi, fj = wi * f, wj * f
    return vxi + fi * x, vyi + fi * y, vxj - fj * x, vyj - fj * y


def limit_speed(vx: float, vy: float, limit: float) -> tuple[float, float]:
    """The velocity itself if sqrt(vx^2 + vy^2) as computed is at most `limit`, else scaled back to it (km/s).

    Total (assignment 1.2): nan counts as 0, an infinite component outweighs every finite one. The direction is
    kept; the two components step down together until the speed as computed fits.
    """
    vx = 0.0 if vx != vx else vx
    vy = 0.0 if vy != vy else vy
    if sqrt(vx * vx + vy * vy) <= limit:
        return vx, vy
    big = max(abs(vx), abs(vy))
    if big == inf:
        vx = (1.0 if vx > 0.0 else -1.0) if abs(vx) == inf else 0.0
        vy = (1.0 if vy > 0.0 else -1.0) if abs(vy) == inf else 0.0
    else:
        vx, vy = vx / big, vy / big
    norm = sqrt(vx * vx + vy * vy)
    factor = limit / norm
    vx, vy = vx * factor, vy * factor
    shrink = 2.0 * _U
    while sqrt(vx * vx + vy * vy) > limit:
        vx, vy = vx * (1.0 - shrink), vy * (1.0 - shrink)
        shrink *= 2.0  # where squares are subnormal, one double is not enough
    return vx, vy


def limit_contact(
    x: float, y: float,
    vxi: float, vyi: float, limit_i: float,
    vxj: float, vyj: float, limit_j: float,
) -> tuple[float, float, float, float, bool, bool]:  # fmt: skip
    """Velocities after a bounce, brought under the speed limits, and whether i and j were clipped.

    `x`, `y` is the position of j seen from i (km); speeds and limits in km/s. A clip keeps the direction. If
    the pair still approaches afterwards, the clipped entity takes its partner's velocity component along the
    line of centres (half way between, if both were clipped) and its tangential component is shortened until
    the speed fits. A limit too low for that component is met along the line, and the partner takes it over.
    """
    ci = sqrt(vxi * vxi + vyi * vyi) > limit_i
    cj = sqrt(vxj * vxj + vyj * vyj) > limit_j
    if not (ci or cj):
        return vxi, vyi, vxj, vyj, False, False
    if ci:
        vxi, vyi = limit_speed(vxi, vyi, limit_i)
    if cj:
        vxj, vyj = limit_speed(vxj, vyj, limit_j)
    if not approaching(x, y, vxj - vxi, vyj - vyi):
        return vxi, vyi, vxj, vyj, ci, cj
    big = max(abs(x), abs(y))
    x, y = x / big, y / big
    norm = sqrt(x * x + y * y)
    x, y = x / norm, y / norm
    along_i, along_j = vxi * x + vyi * y, vxj * x + vyj * y
    common = 0.5 * (along_i + along_j) if ci and cj else along_j if ci else along_i
    lowest = min(limit_i, limit_j)
    common = min(max(common, -lowest), lowest)
    if ci or abs(along_i) > lowest:
        vxi, vyi = with_component(x, y, common, vyi * x - vxi * y, limit_i)
    if cj or abs(along_j) > lowest:
        vxj, vyj = with_component(x, y, common, vyj * x - vxj * y, limit_j)
    return vxi, vyi, vxj, vyj, ci, cj


def with_component(
    nx: float, ny: float, along: float, across: float, limit: float
) -> tuple[float, float]:
    """The velocity with component `along` on the unit vector (nx, ny) and at most `across` beside it, km/s.

    |along| is at most `limit`; `across` is shortened until the speed as computed fits.
    """
    room = limit * limit - along * along
    room = sqrt(room) if room > 0.0 else 0.0
    across = min(max(across, -room), room)
    vx, vy = along * nx - across * ny, along * ny + across * nx
    shrink = 2.0 * _U
    while across != 0.0 and sqrt(vx * vx + vy * vy) > limit:
        across = across * (1.0 - shrink) if shrink < 1.0 else 0.0
        shrink *= 2.0
        vx, vy = along * nx - across * ny, along * ny + across * nx
    return limit_speed(vx, vy, limit)


def thrust(
    vx: float, vy: float, ax: float, ay: float, dt: float, limit: float
) -> tuple[float, float, bool]:
    """Velocity after `dt` s of acceleration (ax, ay) km/s^2, under the limit, and whether it was clipped (1.6).

    Where a dt leaves the doubles it points along a.
    """
    vx, vy = vx + ax * dt, vy + ay * dt
    if sqrt(vx * vx + vy * vy) <= limit:
        return vx, vy, False
    if abs(vx) == inf or abs(vy) == inf:
        ux, uy = unit(ax, ay)
        vx, vy = ux * limit, uy * limit
    vx, vy = limit_speed(vx, vy, limit)
    return vx, vy, True


def sphere_mass(radius: float, density: float) -> float:
    """4/3 pi r^3 rho in kg (1.3, 1.4), the large factors first; inf or 0 only where the mass itself is no double."""
    return 4.0 / 3.0 * pi * density * radius * radius * radius
