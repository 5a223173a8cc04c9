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
* `parted`: the pair has just bounced off one another, so it recedes up to rounding. Then p'(0) counts as
  max(p'(0), 0), and the rules above apply: what rounding left between the two, or overlapping, does not add up
  from one bounce to the next, since they meet again at s.

Every sum of an x-term and a y-term is symmetric and every quantity even in (r, v, a), so swapping the discs,
negating an axis or swapping the axes gives the same bits.
"""

from __future__ import annotations

from collections.abc import Callable

from fasteroids.quartic._exact import contact_time_exact as contact_time_exact
from fasteroids.quartic._filter import contact_time_filtered as contact_time_filtered

__all__ = ["contact_time", "contact_time_exact", "contact_time_filtered"]


def contact_time(
    xi: float, yi: float, vxi: float, vyi: float, axi: float, ayi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, axj: float, ayj: float, rj: float,
    until: float, parted: bool, exact: Callable[..., float] = contact_time_exact,
) -> float:  # fmt: skip
    """Seconds until two discs touch or 0.0 or NEVER, as the module says: the filter, and what it leaves, `exact`.

    The class (hit or miss) is right for the doubles given, whatever they are; the time is off by at most
    ulp/2 + 16 u cond t, where cond t is the sum over the inputs z of |dt/dz| |z|.
    """
    t = contact_time_filtered(
        xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj, until, parted
    )
    if t == t:
        return t
    return exact(xi, yi, vxi, vyi, axi, ayi, ri, xj, yj, vxj, vyj, axj, ayj, rj, until, parted)
