"""Bent flights: where they turn back, and how deep two of them overlap between events.

Nothing in here solves for a contact: only places and velocities along a path are used, and how large an
acceleration can be. That is enough to bound a distance, and what cannot be bounded away is looked at closer.
"""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush
from math import inf
from typing import NamedTuple, TypeAlias

from fasteroids.moments import Moment, between
from fasteroids.paths import Limited
from fasteroids.physics import distance
from fasteroids.state import Flight

__all__ = ["bend", "deepest", "excursion", "turns"]

WORK = 4096
"""How often a distance is computed for one pair at most; the most suspicious intervals come first."""

_State: TypeAlias = tuple[float, float, float, float]


def bend(f: Flight) -> float:
    """The largest acceleration (km/s^2) on a flight."""
    return 0.0 if f.path is None else f.path.bend


def state(f: Flight, age: float) -> _State:
    """Place and velocity of a flight after `age` s, along its path whatever the speed limit."""
    e = f.entity
    if f.path is None:
        return e.x + e.vx * age, e.y + e.vy * age, e.vx, e.vy
    return f.path.after(e.x, e.y, e.vx, e.vy, age)


def excursion(f: Flight, age: float) -> float:
    """How far (km) a flight of `age` s gets from the line between its ends, at most.

    An acceleration A allows A t^2 / 8. On a limited path no more than half the way flown is possible either.
    """
    far = bend(f) * age * age / 8.0
    return min(far, 0.5 * f.path.limit * age) if isinstance(f.path, Limited) else far


def turns(f: Flight, age: float) -> list[float]:
    """Ages (s) at which a bent flight of `age` s turns back in x or in y: with its ends, all its extremes.

    A velocity component that changes its sign does so once: on a parabola it is linear in time, and a limited
    path turns towards the thrust by less than half a circle. So the change can be bisected.
    """
    if f.path is None:
        return []
    first, last = state(f, 0.0), state(f, age)
    found = []
    for axis in (2, 3):
        if not (first[axis] < 0.0 < last[axis] or last[axis] < 0.0 < first[axis]):
            continue
        low, high = 0.0, age
        while low < (middle := low + (high - low) / 2.0) < high:
            if (state(f, middle)[axis] < 0.0) == (first[axis] < 0.0):
                low = middle
            else:
                high = middle
        found.append(low)
    return found


class _Node(NamedTuple):
    """The distance of two centres at one time, how it changes, and how fast the two can go."""

    t: float
    distance: float
    closing: float
    """D', km/s; negative if they approach."""
    speed: float
    """An upper bound of |D'| between two nodes, if both have at least one as high."""


class _Pair:
    """Two flights from the later of their starts on."""

    def __init__(self, f: Flight, g: Flight) -> None:
        start = max(f.since, g.since)
        self.f, self.g = f, g
        self.s, self.t = between(f.since, start), between(g.since, start)
        self.limited = isinstance(f.path, Limited) or isinstance(g.path, Limited)

    def node(self, t: float) -> _Node:
        """How it is after `t` s.

        Without a limited path the relative velocity is linear in time and its size greatest at one of two nodes;
        with one the sum of the speeds is.
        """
        x, y, vx, vy = state(self.f, self.s + t)
        xo, yo, vxo, vyo = state(self.g, self.t + t)
        dx, dy, dvx, dvy = xo - x, yo - y, vxo - vx, vyo - vy
        d = distance(dx, dy)
        closing = 0.0 if d == 0.0 else dx / d * dvx + dy / d * dvy
        speed = distance(vx, vy) + distance(vxo, vyo) if self.limited else distance(dvx, dvy)
        return _Node(t, d, closing, speed)

    def force(self, t: float) -> float:
        """The largest relative acceleration (km/s^2) from `t` s on."""
        p, q = self.f.path, self.g.path
        if not isinstance(p, Limited) and not isinstance(q, Limited):
            ax, ay = (0.0, 0.0) if p is None else (p.ax, p.ay)
            bx, by = (0.0, 0.0) if q is None else (q.ax, q.ay)
            return distance(ax - bx, ay - by)
        return (0.0 if p is None else p.onward(self.s + t).bend) + (
            0.0 if q is None else q.onward(self.t + t).bend
        )

    def least(self, a: _Node, b: _Node) -> tuple[float, float]:
        """A lower bound (km) of the distance between two nodes, and the time (s) at which to look closer.

        D'' >= -B for a relative acceleration of at most B, wherever D > 0 (at 0 it has a kink upwards). So D lies
        above D(a) + D'(a) s - B s^2 / 2, and above the same from b backwards. Both fall away from their node or
        have their least value at an end, where D itself is known; the difference of the two is linear, so the
        larger of them is least at one of the nodes or where they cross. And D changes no faster than the speed.
        """
        w = b.t - a.t
        force = self.force(a.t)
        drop = 0.5 * force * w
        denominator = (b.closing - a.closing) + force * w
        s = (
            (a.distance - b.distance + (b.closing + drop) * w) / denominator
            if denominator > 0.0
            else 0.5 * w
        )
        s = min(max(s, 0.0), w)
        back = w - s
        crossing = min(
            a.distance + (a.closing - 0.5 * force * s) * s,
            b.distance - (b.closing + 0.5 * force * back) * back,
        )
        straight = 0.5 * (a.distance + b.distance - max(a.speed, b.speed) * w)
        middle = s if 0.0625 * w < s < 0.9375 * w else 0.5 * w
        return min(a.distance, b.distance, max(crossing, straight)), a.t + middle


def deepest(f: Flight, g: Flight, now: Moment, floor: Callable[[], float]) -> tuple[float, float]:
    """Where two flights, one of them bent at least, overlapped most until `now`: seconds after the later start, km.

    Negative depths are gaps. By branch and bound over time: an interval in which no overlap can be deeper than
    the deepest seen, or than `floor` (km), is not looked at. So the answer is exact where it is above the floor,
    and a depth that occurred anyway.
    """
    reach = f.entity.radius + g.entity.radius
    span = between(max(f.since, g.since), now)
    if not span >= 0.0:
        return 0.0, -inf
    pair = _Pair(f, g)
    first, last = pair.node(0.0), pair.node(span)
    best = min(first, last, key=lambda node: node.distance)
    least, t = pair.least(first, last)
    if not least < reach:
        return best.t, reach - best.distance
    near = reach - floor()
    waiting = [(least, 0, t, first, last)]
    for serial in range(1, WORK):
        if not waiting or not waiting[0][0] < min(best.distance, near):
            break
        _, _, t, a, b = heappop(waiting)
        if not a.t < t < b.t:
            continue
        node = pair.node(t)
        if node.distance < best.distance:
            best = node
        for i, (left, right) in enumerate(((a, node), (node, b))):
            least, t = pair.least(left, right)
            if least < min(best.distance, near):
                heappush(waiting, (least, 2 * serial + i, t, left, right))
    return best.t, reach - best.distance
