"""Bounds and overlaps, with the margin that rounding earns (assignment 1.1: "a margin of error epsilon").

The margin is computed from the numbers, never a literal. A position carries the rounding of the coordinates
it was computed from and of the distance flown, at most a handful of units in the last place each: the contact
time solved for, the move to it, the move to the moment asked about, and the comparison itself. `slack` grants
16 u for all of these together. On top, a moment is no finer than the spacing of its doubles (`resolution`),
within which a disc moves speed * resolution.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ulp
from typing import NamedTuple

from fasteroids.entities import Bullet, Entity
from fasteroids.physics import distance
from fasteroids.units import WINDOW

__all__ = [
    "Placed",
    "depth",
    "first_overlap",
    "grace",
    "outside",
    "overhang",
    "own_bullet",
    "slack",
]

_ROUNDINGS = 16 * 2.0**-53


class Placed(NamedTuple):
    """An entity where it is now, and how far off (km) that may be."""

    entity: Entity
    slack: float


def slack(
    e: Entity, age: float, resolution: float, speed: float | None = None, *, bend: float = 0.0
) -> float:
    """How far (km) rounding may have put an entity that is `age` s into its flight.

    `resolution` is the spacing (s) of moments there; `speed` (km/s) replaces the entity's own where it may
    have been faster before. `bend` is the largest acceleration (km/s^2) on its path: it adds bend t to either
    component of the velocity between one end of the flight and the other, 2 bend t to the sum of both that is
    used here, but never more than twice the speed limit each; and as the distance flown is t times such a sum,
    that covers the rounding of v t and of a t^2 / 2 (at most bend t^2 in both coordinates together).
    """
    if speed is None:
        speed = abs(e.vx) + abs(e.vy)
    far = _ROUNDINGS * abs(e.x) + _ROUNDINGS * abs(e.y) + _ROUNDINGS * e.radius
    if bend == 0.0:
        return far + _ROUNDINGS * (abs(e.vx) + abs(e.vy)) * age + speed * resolution
    more = 2.0 * min(bend * age, 2.0 * e.max_speed)
    return far + _ROUNDINGS * (abs(e.vx) + abs(e.vy) + more) * age + (speed + more) * resolution


def grace(e: Entity, width: float, height: float) -> float:
    """How far (km) rounding may have put an entity before the flight it is on, of which nothing is known.

    It flew inside a world of this size, no faster than its limit, at any moment of a window. Never more than
    a part in 2^20 of its radius, the room the grid keeps free: what tiny discs do late is beyond all slack.
    """
    far = _ROUNDINGS * width + _ROUNDINGS * height + e.max_speed * ulp(WINDOW / 2.0)
    return min(far, e.radius * 2.0**-20)


def depth(a: Entity, b: Entity) -> float:
    """How deep (km) two discs overlap; negative if there is a gap between them."""
    return (a.radius + b.radius) - distance(b.x - a.x, b.y - a.y)


def overhang(e: Entity, width: float, height: float) -> float:
    """How far (km) a disc sticks out of the world; negative if it is inside."""
    r = e.radius
    return max(r - e.x, r - e.y, e.x - (width - r), e.y - (height - r))


def own_bullet(a: Entity, b: Entity) -> bool:
    """Is one a bullet of the other? A ship is never hit by its own bullets (1.1, 1.5.1)."""
    return (type(a) is Bullet and a.source == b.id) or (type(b) is Bullet and b.source == a.id)


def outside(p: Placed, width: float, height: float) -> bool:
    """Does an entity stick out of the world by more than its slack?"""
    return overhang(p.entity, width, height) > p.slack


def first_overlap(placed: Sequence[Placed], news: Sequence[Placed]) -> tuple[Entity, Entity] | None:
    """Two entities that overlap by more than their slacks, one of them in `news`, or None.

    Of those already placed only pairs with a new one are looked at. A sweep from left to right: O(n log n)
    for discs spread over the plane.
    """
    lefts = [(p.entity.x - p.entity.radius - p.slack, i, p) for i, p in enumerate([*news, *placed])]
    lefts.sort(key=lambda item: item[:2])
    count = len(news)
    active: list[tuple[float, int, Placed]] = []
    for left, i, p in lefts:
        active = [item for item in active if item[0] > left]
        for _, j, q in active:
            if (
                (i < count or j < count)
                and depth(p.entity, q.entity) > p.slack + q.slack
                and not own_bullet(p.entity, q.entity)
            ):
                return (q.entity, p.entity) if j < count <= i else (p.entity, q.entity)
        active.append((p.entity.x + p.entity.radius + p.slack, i, p))
    return None
