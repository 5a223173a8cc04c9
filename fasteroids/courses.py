"""When something happens to a flight under thrust: its walls, its speed limit, its contacts, the border of a cell.

A `Course` is what the engine keeps of a flight whose path is bent: how it ends if nobody meets it. Everything is a
function of flights and of the size of the world, never of when it was asked; only the border of a cell, which no
user sees, depends on the moment. `contact_ahead` and `wall_ahead` chain courses beyond the speed limit, for those who
ask about the future without letting it happen. How two bent paths touch is decided in `fasteroids.quartic`
(parabolas) and in `fasteroids.advancement` (paths at the speed limit).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import inf
from typing import NamedTuple, TypeAlias

from fasteroids import advancement, quartic
from fasteroids.entities import Entity, Ship
from fasteroids.moments import LAST_WINDOW, ORIGIN, Moment, between, later, seconds
from fasteroids.paths import Limited, Parabola, Path, falling_time, limit_time, path_of
from fasteroids.physics import NEVER
from fasteroids.rules import past_limit
from fasteroids.state import Flight, World, flight, located, path, push

__all__ = [
    "LIMIT",
    "WALLS",
    "Box",
    "Course",
    "contact_ahead",
    "course",
    "exit_time",
    "meeting",
    "wall_ahead",
]

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
    return min(_ends(f, width, height))


def _ends(f: Flight, width: float, height: float) -> list[Course]:
    """The ways in which a flight on a bent path may end: its limit, and if it does not leave that at once, walls."""
    e = f.entity
    assert f.path is not None
    at_limit = Course(_limit(f), LIMIT)
    if isinstance(f.path, Limited) and at_limit.ends == 0.0:
        return [at_limit]
    r = e.radius
    exits = _exits(e.x, e.y, e.vx, e.vy, f.path, (r, width - r, r, height - r))
    return [*map(Course, exits, WALLS), at_limit]


def _limit(f: Flight) -> float:
    """Seconds after its start when a flight reaches its speed limit, or leaves it; NEVER if it does neither."""
    e, p = f.entity, f.path
    if isinstance(p, Parabola):
        return limit_time(e.vx, e.vy, p.ax, p.ay, e.max_speed)
    return 0.0 if isinstance(p, Limited) and abs(p.half) > _INWARDS else NEVER


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


def meeting(
    f: Flight, g: Flight, ends_f: float, ends_g: float,
    exact: Callable[..., float] = quartic.contact_time_exact,
) -> float:  # fmt: skip
    """Seconds after the later of two starts until the discs touch, one of them at least on a bent path; or NEVER.

    `ends_f`, `ends_g` are the ends of their courses (infinite for a straight flight): beyond them nothing is asked.
    Two that have just bounced off each other touch, and are not asked whether they approach. `exact` decides what
    the filter for parabolas does not.
    """
    reference = max(f.since, g.since)
    a, b = located(f, reference), located(g, reference)
    s, t = between(f.since, reference), between(g.since, reference)
    until = max(min(ends_f - s, ends_g - t), 0.0)
    parted = f.bounced_off == b.id and g.bounced_off == a.id
    p, q = f.path, g.path
    # Two courses without end need no quartic: advancement asks the formula for straight lines where nothing bends.
    if until < inf and not isinstance(p, Limited) and not isinstance(q, Limited):
        axa, aya = (0.0, 0.0) if p is None else (p.ax, p.ay)
        axb, ayb = (0.0, 0.0) if q is None else (q.ax, q.ay)
        return quartic.contact_time(
            a.x, a.y, a.vx, a.vy, axa, aya, a.radius,
            b.x, b.y, b.vx, b.vy, axb, ayb, b.radius, until, parted, exact,
        )  # fmt: skip
    return advancement.contact_time(
        a.x, a.y, a.vx, a.vy, p and p.onward(s), a.radius,
        b.x, b.y, b.vx, b.vy, q and q.onward(t), b.radius, until, parted,
    )  # fmt: skip


# Beyond the limit.


def contact_ahead(a: Entity, b: Entity) -> float:
    """Seconds from now until two entities touch under `smooth` with no wall around, their thrusters as they are.

    NEVER if they do not. The flights are followed past the limit, as if it happened. That ends, because a ship leaves
    its limit on the spot or not at all, and does not leave it again when it is back there: a path has three pieces.
    """
    f, g = _launched(a), _launched(b)
    while True:
        limit_f, limit_g = _limit(f), _limit(g)
        contact = _due(max(f.since, g.since), meeting(f, g, limit_f, limit_g))
        due_f, due_g = _due(f.since, limit_f), _due(g.since, limit_g)
        turn = min(due_f, due_g)
        if contact <= turn:
            return _seconds(contact)
        if due_f == turn:
            f = past_limit(f, turn, _acceleration)
        if due_g == turn:
            g = past_limit(g, turn, _acceleration)


def wall_ahead(ship: Ship, world: World) -> tuple[float, tuple[str, ...]]:
    """Seconds from now until a ship meets a wall, its thruster as it is, and which: two in a corner, none if NEVER.

    The thrust bends its path. The flight is followed past the limit, as in `contact_ahead`.
    """
    f = flight(ORIGIN, ship, 0, None, path(world, ship))
    while True:
        ends = _ends(f, world.width, world.height)
        t, rank = min(ends)
        moment = _due(f.since, t)
        if rank != LIMIT:
            walls = tuple(WALLS[other] for at, other in ends if at == t and other in WALLS)
            when = _seconds(moment)
            return when, walls if when < NEVER else ()
        f = past_limit(f, moment, partial(push, world))


def _launched(e: Entity) -> Flight:
    """The flight on which an entity starts where there is no wall to lean on."""
    if type(e) is not Ship or not e.thruster:
        return flight(ORIGIN, e, 0, None, None)
    return flight(ORIGIN, e, 0, None, path_of(e.vx, e.vy, *e.acceleration, e.max_speed))


def _acceleration(ship: Ship) -> tuple[float, float]:
    return ship.acceleration


_NO_MOMENT: Moment = (LAST_WINDOW + 1, 0.0)


def _due(since: Moment, delay: float) -> Moment:
    """The moment `delay` s after another; `_NO_MOMENT` if its seconds are no double."""
    return min(later(since, delay), _NO_MOMENT) if delay < inf else _NO_MOMENT


def _seconds(moment: Moment) -> float:
    return seconds(*moment) if moment < _NO_MOMENT else NEVER
