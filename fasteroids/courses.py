"""When something happens to a flight under thrust: its walls, its speed limit, its contacts, the border of a cell.

A `Course` is what the engine keeps of a flight whose path is bent: how it ends if nobody meets it. Everything is a
function of flights and of the size of the world, never of when it was asked; only the border of a cell, which no
user sees, depends on the moment. How two bent paths touch is decided in `fasteroids.quartic` (parabolas) and in
`fasteroids.advancement` (paths at the speed limit).
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple, TypeAlias

from fasteroids import advancement, quartic
from fasteroids.moments import Moment, between
from fasteroids.paths import Limited, Parabola, Path, falling_time, limit_time
from fasteroids.state import Flight, located

__all__ = ["LIMIT", "WALLS", "Box", "Course", "course", "exit_time", "meeting"]

LIMIT = 5
WALLS = {1: "left", 2: "right", 3: "bottom", 4: "top"}
"""Ranks of what ends a course; see `fasteroids.engine` for the others."""

_LEFT, _RIGHT, _BOTTOM, _TOP = WALLS

Box: TypeAlias = tuple[float | None, float | None, float | None, float | None]
"""Left, right, bottom and top border (km), None where there is none."""

_INWARDS = 1.0 + 32.0 * 2.0**-53
"""tan(phi / 2) of a thrust across the velocity is 1; it is computed to 8 u, and to 32 u it still counts as across."""


class Course(NamedTuple):
    """A bent flight as it goes on if nobody meets it."""

    ends: float
    """Seconds after its start when it meets a wall or its limit; infinite if it does neither."""
    rank: int
    """Which of them: a rank of `WALLS`, or `LIMIT`."""


def course(f: Flight, width: float, height: float) -> Course:
    """The course of a flight on a bent path."""
    e, path = f.entity, f.path
    assert path is not None
    if isinstance(path, Limited) and abs(path.half) > _INWARDS:
        return Course(0.0, LIMIT)
    r = e.radius
    times = [
        (t, rank)
        for rank, t in enumerate(
            _exits(e.x, e.y, e.vx, e.vy, path, (r, width - r, r, height - r)), 1
        )
    ]
    if isinstance(path, Parabola):
        times.append((limit_time(e.vx, e.vy, path.ax, path.ay, e.max_speed), LIMIT))
    return Course(*min(times))


def _exits(x: float, y: float, vx: float, vy: float, path: Path, box: Box) -> list[float]:
    """Seconds until a point on a path goes out over the left, right, bottom and top border."""
    left, right, bottom, top = box
    if isinstance(path, Parabola):
        ax, ay = path.ax, path.ay
        return [
            inf if left is None else falling_time(x - left, vx, ax),
            inf if right is None else falling_time(right - x, -vx, -ax),
            inf if bottom is None else falling_time(y - bottom, vy, ay),
            inf if top is None else falling_time(top - y, -vy, -ay),
        ]
    assert isinstance(path, Limited)
    wall_time = advancement.wall_time
    return [
        inf if left is None else wall_time(path, x, y, vx, vy, 1.0, 0.0, left),
        inf if right is None else wall_time(path, x, y, vx, vy, -1.0, 0.0, -right),
        inf if bottom is None else wall_time(path, x, y, vx, vy, 0.0, 1.0, bottom),
        inf if top is None else wall_time(path, x, y, vx, vy, 0.0, -1.0, -top),
    ]


def exit_time(f: Flight, now: Moment, box: Box) -> float:
    """Seconds from `now` until the centre of a disc on a bent path leaves a box it is in."""
    assert f.path is not None
    e = located(f, now)
    path = f.path.onward(between(f.since, now))
    return min(_exits(e.x, e.y, e.vx, e.vy, path, box))


def meeting(f: Flight, g: Flight, ends_f: float, ends_g: float) -> float:
    """Seconds after the later of two starts until the discs touch, one of them at least on a bent path; or NEVER.

    `ends_f`, `ends_g` are the ends of their courses (infinite for a straight flight): beyond them nothing is asked.
    Two that have just bounced off each other touch, and are not asked whether they approach.
    """
    reference = max(f.since, g.since)
    a, b = located(f, reference), located(g, reference)
    s, t = between(f.since, reference), between(g.since, reference)
    until = max(min(ends_f - s, ends_g - t), 0.0)
    parted = f.bounced_off == b.id and g.bounced_off == a.id
    p, q = f.path, g.path
    # A course without end is straight: advancement then asks the formula for straight lines.
    if until < inf and not isinstance(p, Limited) and not isinstance(q, Limited):
        axa, aya = (0.0, 0.0) if p is None else (p.ax, p.ay)
        axb, ayb = (0.0, 0.0) if q is None else (q.ax, q.ay)
        return quartic.contact_time(
            a.x, a.y, a.vx, a.vy, axa, aya, a.radius,
            b.x, b.y, b.vx, b.vy, axb, ayb, b.radius, until, parted,
        )  # fmt: skip
    return advancement.contact_time(
        a.x, a.y, a.vx, a.vy, p and p.onward(s), a.radius,
        b.x, b.y, b.vx, b.vy, q and q.onward(t), b.radius, until, parted,
    )  # fmt: skip
