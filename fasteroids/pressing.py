"""Ships that press on each other: a resting contact is a train of small hops (1.5.2).

Thrust can hold two ships together that part with next to no speed, or with none. Rigid elastic discs would then hop
lower than any number can tell, without end. As in impulse-based dynamics (Mirtich and Canny 1995, "Impulse-based
simulation of rigid bodies"), such a contact is a train of micro-collisions: a bounce that would lift the two less
than a least height leaves them with the speed that lifts them that far. The hops keep that height by themselves,
since bounces are elastic; what the two do together, sliding round each other, tends to what rigid discs do as the
height goes to zero.

Notation: n is the line of centres, D the gap, D' = n.(v_j - v_i), and at D' = 0

    D'' = (|v|^2 - D'^2) / |r| + n.(a_j - a_i).

The first term is the centrifugal one. Two discs that touch press on each other where D'' < 0.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from fasteroids.physics import distance, with_component

__all__ = ["LEAST_HOP", "Mover", "lift", "normal_acceleration"]

_U = 2.0**-53

LEAST_HOP = 2.0**-20
"""The height of a hop in units of the sum of the radii: the room the grid keeps free, so geometry and not rounding."""


class Mover(NamedTuple):
    """A disc in contact: velocity (km/s), acceleration (km/s^2), mass (kg), speed limit (km/s)."""

    vx: float
    vy: float
    ax: float
    ay: float
    mass: float
    limit: float


def normal_acceleration(
    x: float, y: float, vx: float, vy: float, ai: tuple[float, float], aj: tuple[float, float]
) -> tuple[float, float]:
    """D'' at D' = 0 (km/s^2) and its rounding error, for j at (x, y) km from i, moving at (vx, vy) km/s against it.

    (0.0, 0.0) for concentric discs. Each of the accelerations is computed to 6 u of its size, the difference and the
    products with n add 5 u, the centrifugal term has 8 u: 16 u of all of them covers it.
    """
    r = distance(x, y)
    if r == 0.0:
        return 0.0, 0.0
    nx, ny = x / r, y / r
    across = vx * ny - vy * nx
    outward = across * across / r
    inward = (aj[0] - ai[0]) * nx + (aj[1] - ai[1]) * ny
    return outward + inward, 16.0 * _U * (outward + distance(*ai) + distance(*aj))


def lift(
    x: float, y: float, i: Mover, j: Mover, height: float
) -> tuple[tuple[float, float, bool], tuple[float, float, bool], bool]:
    """Velocities of i and j after a bounce in which they press on each other, and whether they do.

    `x`, `y` is the position of j seen from i (km). If D'' < 0 (up to its rounding error) and they part too slowly to
    rise by `height` (km), they part with sqrt(2 |D''| height), or 64 u of their speeds if that is more, so that no
    rounding of a velocity makes them approach. Momentum is kept, the energy gained is the work of the thrust over
    `height`. They count as pressing up to four times the height. Where the speed limit of one leaves no room for its
    share the other takes it over, and what is across n is shortened until the speed fits: both come with whether
    that clipped them.
    """
    r = distance(x, y)
    d2, error = normal_acceleration(x, y, j.vx - i.vx, j.vy - i.vy, (i.ax, i.ay), (j.ax, j.ay))
    if r == 0.0 or not d2 < error:
        return (i.vx, i.vy, False), (j.vx, j.vy, False), False
    nx, ny = x / r, y / r
    along_i, along_j = i.vx * nx + i.vy * ny, j.vx * nx + j.vy * ny
    rate = (j.vx - i.vx) * nx + (j.vy - i.vy) * ny
    least = max(
        sqrt(2.0) * sqrt(error - d2) * sqrt(height),
        64.0 * _U * (distance(i.vx, i.vy) + distance(j.vx, j.vy)),
    )
    if not rate < least:
        return (i.vx, i.vy, False), (j.vx, j.vy, False), rate < 2.0 * least
    ratio = min(i.mass, j.mass) / max(i.mass, j.mass)
    heavy = ratio / (1.0 + ratio)
    share_i, share_j = (
        (1.0 / (1.0 + ratio), heavy) if i.mass <= j.mass else (heavy, 1.0 / (1.0 + ratio))
    )
    more = least - rate
    back, forth = share_i * more, share_j * more
    short = max(back - along_i - i.limit, 0.0)
    over = max(forth + along_j - j.limit, 0.0)
    return (
        _parted(i, -nx, -ny, -along_i, back - short + over, short > 0.0),
        _parted(j, nx, ny, along_j, forth - over + short, over > 0.0),
        True,
    )


def _parted(
    e: Mover, nx: float, ny: float, along: float, more: float, short: bool
) -> tuple[float, float, bool]:
    """A velocity with `more` along n, where it has `along`, within its limit; and whether that clipped it.

    `short` says that the limit has clipped its share already.
    """
    vx, vy = e.vx + more * nx, e.vy + more * ny
    if sqrt(vx * vx + vy * vy) <= e.limit:
        return vx, vy, short
    along = min(max(along + more, -e.limit), e.limit)
    return *with_component(nx, ny, along, e.vy * nx - e.vx * ny, e.limit), True
