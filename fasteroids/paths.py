"""Where a thrusting ship flies under the rule `smooth`: parabolas, and curves at the speed limit (1.2, 1.6).

A constant acceleration bends a path into a parabola. At the speed limit the part of the thrust along the velocity
has no effect, and the part across it turns the direction: the ship flies a `Limited` path. Everything here is a
function of plain floats (km, s, km/s, km/s^2) and of the path, a frozen record.

The limited path. Let phi be the angle from the thrust to the velocity, c the limit, A the acceleration. Then
phi' = -(A / c) sin phi, hence tan(phi / 2) = k exp(-w t) with w = A / c and k = tan(phi_0 / 2). Integrated, the
ship has moved, after t seconds,

    along the thrust   c t + (c / w) log1p(sin^2(phi_0 / 2) expm1(-2 w t))
    across it          (c / w) 2 atan(-k expm1(-w t) / (1 + k^2 exp(-w t))),

which is (c / w) ln cosh q and (c / w) gd q, between their values at q_0 = -ln k and at q_0 + w t: the catenary of
equal strength. In this form no two large numbers are subtracted, and an infinite w (it turns at once) needs no
case of its own.
"""

from __future__ import annotations

from math import atan, copysign, exp, expm1, inf, log1p, nextafter, sqrt
from typing import TypeAlias

from attrs import evolve, frozen

from fasteroids.physics import NEVER, distance, limit_speed, unit

__all__ = [
    "Limited",
    "Parabola",
    "Path",
    "falling_time",
    "limit_time",
    "limited",
    "path_of",
    "reached",
    "to_limit",
]

_U = 2.0**-53
_AT_LIMIT = 1.0 - 16.0 * _U
_STRAIGHT = 2.0**-26
_LONGEST = nextafter(inf, 0.0)


@frozen(weakref_slot=False)
class Parabola:
    """Constant acceleration (ax, ay), km/s^2."""

    ax: float
    ay: float

    def after(
        self, x: float, y: float, vx: float, vy: float, t: float, limit: float = inf
    ) -> tuple[float, float, float, float]:
        """Position and velocity `t` s after (x, y, vx, vy); the speed never above `limit`, as computed."""
        bx, by = self.ax * t, self.ay * t
        x, y = x + (vx + 0.5 * bx) * t, y + (vy + 0.5 * by) * t
        vx, vy = limit_speed(vx + bx, vy + by, limit)
        return x, y, vx, vy

    def onward(self, t: float) -> Parabola:  # noqa: ARG002
        """The path as it goes on after `t` s: itself."""
        return self

    def acceleration(self, vx: float, vy: float) -> tuple[float, float]:  # noqa: ARG002
        """The acceleration (km/s^2) at a velocity (km/s): the same at any."""
        return self.ax, self.ay

    @property
    def bend(self) -> float:
        """The largest acceleration from here on, km/s^2."""
        return distance(self.ax, self.ay)


@frozen(weakref_slot=False)
class Limited:
    """Speed held at `limit` (km/s) while the direction turns towards the thrust; made by `limited`.

    (ux, uy) is the unit vector of the thrust, `power` its size A (km/s^2), `rate` is w = A / c (1/s), and `half`
    is tan(phi / 2), positive if the velocity lies counter-clockwise of the thrust.
    """

    ux: float
    uy: float
    limit: float
    power: float
    rate: float
    half: float

    def after(
        self, x: float, y: float, vx: float, vy: float, t: float, limit: float = inf
    ) -> tuple[float, float, float, float]:
        """Position and velocity `t` s after (x, y, vx, vy); the speed never above `limit`, as computed."""
        if t == 0.0:
            return x, y, vx, vy
        c, k, angle = self.limit, self.half, self.rate * t
        decayed = exp(-angle)
        kk = k * k
        if angle < _STRAIGHT:  # the third order of the curve, (w t)^2 c t / 6, is less than u c t
            bend = self.power * (2.0 * k / (1.0 + kk)) * 0.5 * t * t
            along, across = (1.0 - kk) / (1.0 + kk) * c * t, 2.0 * k / (1.0 + kk) * c * t
            along, across = (
                along + bend * (2.0 * k / (1.0 + kk)),
                across - bend * ((1.0 - kk) / (1.0 + kk)),
            )
        else:
            reach = c / self.rate
            along = c * t + reach * log1p(kk / (1.0 + kk) * expm1(-2.0 * angle))
            across = 2.0 * reach * atan(-k * expm1(-angle) / (1.0 + kk * decayed))
        k *= decayed
        kk = k * k
        forward, sideways = c * ((1.0 - kk) / (1.0 + kk)), c * (2.0 * k / (1.0 + kk))
        ux, uy = self.ux, self.uy
        vx, vy = limit_speed(
            forward * ux - sideways * uy, forward * uy + sideways * ux, min(c, limit)
        )
        return x + (along * ux - across * uy), y + (along * uy + across * ux), vx, vy

    def onward(self, t: float) -> Limited:
        """The path as it goes on after `t` s."""
        k = self.half * exp(-self.rate * t) if t > 0.0 else self.half
        return Limited(self.ux, self.uy, self.limit, self.power, self.rate, k)

    def acceleration(self, vx: float, vy: float) -> tuple[float, float]:
        """The acceleration (km/s^2) at a velocity (km/s): the part of the thrust across it.

        All of it if it points inwards: then the ship leaves its limit at once.
        """
        wx, wy = unit(vx, vy)
        if wx == wy == 0.0 or abs(self.half) > 1.0:
            return self.ux * self.power, self.uy * self.power
        across = self.power * (self.uy * wx - self.ux * wy)
        return -across * wy, across * wx

    @property
    def bend(self) -> float:
        """The largest acceleration from here on, km/s^2: A sin phi, which falls as the ship turns."""
        k = abs(self.half)
        return self.power * (2.0 * k / (1.0 + k * k)) if k < 1.0 else self.power


Path: TypeAlias = Parabola | Limited


def limited(vx: float, vy: float, ax: float, ay: float, limit: float) -> Limited:
    """The path of a ship at its speed limit (> 0 km/s) with velocity (vx, vy) and thrust (ax, ay) > 0 km/s^2."""
    power = distance(ax, ay)
    ux, uy = unit(ax, ay)
    wx, wy = unit(vx, vy)
    forward, sideways = wx * ux + wy * uy, wy * ux - wx * uy
    if forward >= 0.0:
        half = sideways / (1.0 + forward)
    else:  # it points inwards, and the path ends at once: any angle near pi will do where it is pi
        half = (1.0 - forward) / sideways if abs(sideways) > _STRAIGHT else 1.0 / _STRAIGHT
    return Limited(ux, uy, limit, power, power / limit, half)


def path_of(vx: float, vy: float, ax: float, ay: float, limit: float) -> Path:
    """The path on which thrust (ax, ay) sends a ship with velocity (vx, vy), km/s.

    At the limit (within 16 u of it: what `limit_speed` and turning a vector round off) it is limited, also if the
    thrust points inwards: such a path ends at once, by an event of kind `limit`, and a parabola follows.
    """
    if limit > 0.0 and (ax != 0.0 or ay != 0.0) and distance(vx, vy) >= limit * _AT_LIMIT:
        return limited(vx, vy, ax, ay, limit)
    return Parabola(ax, ay) if limit > 0.0 else Parabola(0.0, 0.0)


def reached(vx: float, vy: float, ax: float, ay: float, limit: float) -> Path:
    """The path on from where thrust (ax, ay) brought a ship to its limit, with velocity (vx, vy), km/s.

    The thrust does not point inwards there, or it would not have brought it so far; and it may be none, where a
    ship comes to lean on a wall.
    """
    if ax == 0.0 and ay == 0.0:
        return Parabola(0.0, 0.0)
    path = limited(vx, vy, ax, ay, limit)
    return path if abs(path.half) <= 1.0 else evolve(path, half=copysign(1.0, path.half))


def limit_time(vx: float, vy: float, ax: float, ay: float, limit: float) -> float:
    """Seconds until constant acceleration brings the speed to `limit`; NEVER without acceleration.

    The later root of a^2 t^2 + 2 (v.a) t - (c - |v|) (c + |v|) = 0, without cancellation, with a and v scaled by
    A and c so that no square leaves the doubles.
    """
    power = distance(ax, ay)
    if power == 0.0 or limit == 0.0:
        return NEVER
    ux, uy = unit(ax, ay)
    wx, wy = vx / limit, vy / limit
    speed = distance(wx, wy)
    room = max((1.0 - speed) * (1.0 + speed), 0.0)
    forward = wx * ux + wy * uy
    root = sqrt(forward * forward + room)
    t = room / (forward + root) if forward > 0.0 else root - forward
    return t * limit / power if t * limit < inf else t * (limit / power)


def to_limit(vx: float, vy: float, limit: float) -> tuple[float, float]:
    """The velocity scaled up or down to the limit (km/s), and not above it as computed."""
    ux, uy = unit(vx, vy)
    return limit_speed(ux * limit, uy * limit, limit)


def falling_time(gap: float, v: float, a: float) -> float:
    """Seconds until gap + v t + a t^2 / 2 falls through zero; 0.0 if it is there and falling, NEVER if it never does.

    A gap that rounding left below zero counts from the moment it closes again. The roots are taken without
    cancellation; a dip of less than 4 u of the gap may count as none. A gap beyond the doubles counts as the largest.
    """
    gap = min(max(gap, -_LONGEST), _LONGEST)
    fall = sqrt(2.0 * abs(a)) * sqrt(
        abs(gap)
    )  # the speed (km/s) that a gains or loses over the gap
    if v < 0.0 or (v == 0.0 and a < 0.0 and gap <= 0.0):
        if gap <= 0.0:
            return 0.0
        if a <= 0.0:
            root = distance(v, fall)
        elif fall > -v:
            return NEVER
        else:
            root = sqrt(-v - fall) * sqrt(fall - v)
        return gap / (root - v) * 2.0
    if a >= 0.0:
        return NEVER
    if gap >= 0.0:
        return (v + distance(v, fall)) / -a
    return (v + sqrt(max(v - fall, 0.0)) * sqrt(v + fall)) / -a
