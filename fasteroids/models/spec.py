"""`spec`: the formula of the text, word for word, in plain doubles (assignment 1.5.1).

Contract: the right class wherever d = b^2 - a c is not lost to rounding and nothing over- or underflows
(distances up to about 1e6 times the sum of the radii, grazing depths above 1e-10 of it). The text lets a result
be anything after an overflow; here a zero denominator or nan is NEVER, and a negative time is now.
"""

from __future__ import annotations

from math import sqrt

from fasteroids.models._model import Model
from fasteroids.physics import NEVER

__all__ = ["MODEL", "contact_time"]


def contact_time(
    xi: float, yi: float, vxi: float, vyi: float, ri: float,
    xj: float, yj: float, vxj: float, vyj: float, rj: float,
) -> float:  # fmt: skip
    """Seconds until two discs touch, or NEVER, by the formula of the text."""
    x = xj - xi
    y = yj - yi
    vx = vxj - vxi
    vy = vyj - vyi
    vr = vx * x + vy * y
    if not vr < 0.0:
        return NEVER
    s = ri + rj
    vv = vx * vx + vy * vy
    d = vr * vr - vv * (x * x + y * y - s * s)
    if not (d > 0.0 and vv > 0.0):
        return NEVER
    t = -(vr + sqrt(d)) / vv
    if t != t:
        return NEVER
    return t if t > 0.0 else 0.0


MODEL = Model(
    name="spec",
    filtered=contact_time,
    exact=contact_time,
    thrust="literal",
    promise="the formulas of the text, word for word; decisions can be lost to rounding in extreme scenes",
)
