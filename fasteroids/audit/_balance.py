"""Conservation, measured in exact fractions so that the measure adds no error of its own."""

from __future__ import annotations

from fractions import Fraction
from math import inf, isfinite, pi
from sys import float_info

from fasteroids import rules
from fasteroids.entities import Asteroid, Entity, Ship
from fasteroids.physics import distance
from fasteroids.state import World
from fasteroids.units import ASTEROID_DENSITY, BULLET_DENSITY

__all__ = ["BOUNCE_LIMIT", "drift", "imbalance", "kinetic_energy"]

_U = Fraction(1, 2**53)

BOUNCE_LIMIT = 8.0
"""What a bounce may change of the momentum and energy of a pair, in units of u = 2^-53 (derived in `imbalance`)."""


def imbalance(a: Entity, b: Entity, after_a: Entity, after_b: Entity) -> tuple[float, float]:
    """What a bounce changed of the momentum and of the energy of a pair, in units of u = 2^-53. Law L9 allows 8.

    Measured in exact fractions, with the masses the bounce works with, relative to sum m (|v| + |v'|) for
    momentum and to sum m (|v| + |v'|)^2 for energy (v before, v' after; eight times the energy of a pair whose
    speeds stay the same). Derivation, to first order, for `physics.bounce`:

    * Its impulses should be J and -J. Rounded apart from one another are the quotients w, the products w f and
      w f x (3 u for one partner) and for the other the ratio of the masses as well (4 u). The sum v + w f x
      adds u |v'|. Momentum: 7 u |J| + u sum m |v'|. As |J| <= m (|v| + |v'|) for both partners, it is at most
      half the scale: 4.5 u in all.
    * Energy changes by J.(e v'_a - d v'_b) for relative errors e, d of the two impulses; for those rounded
      apart that is at most 4 u sum m |v'| (|v| + |v'|), which is half the scale if energy is kept: 2 u. An
      error common to both, e, gives e sum m (v' - v)^2 / 2, at most e times half the scale: 4 u in r.r, the
      quotient f and 1 + ratio, and half a u that the ratio brings there, 2.25 u. The dot product b is off by at
      most 3 u |r| |dv|, which gives 6 u mu dv^2, and mu dv^2 <= sum m (v^2 + v'^2) / 2 <= half the scale: 3 u.
      The last sums, u sum m v'^2: half a u. Together 7.75 u.

    Where products fall below the normal doubles digits are lost whatever the rounding; the smallest normal
    double, times 1 + the speeds, is added to each speed of the scale for it.
    """
    if not all(isfinite(e.vx - e.vy) for e in (after_a, after_b)):
        return inf, inf
    speeds = [distance(e.vx, e.vy) for e in (a, b, after_a, after_b)]
    least = float_info.min * (1.0 + sum(speeds))
    px = py = energy = momentum_scale = energy_scale = Fraction(0)
    for mass, e, g, v, w in zip(
        rules.masses(a, b), (a, b), (after_a, after_b), speeds[:2], speeds[2:], strict=True
    ):
        m, reach = Fraction(mass), Fraction(v + w + least)
        momentum_scale += m * reach
        energy_scale += m * reach * reach
        vx, vy, wx, wy = (Fraction(c) for c in (e.vx, e.vy, g.vx, g.vy))
        px += m * (wx - vx)
        py += m * (wy - vy)
        energy += m * (wx * wx - vx * vx + wy * wy - vy * vy) / 2
    if not momentum_scale:
        return 0.0, 0.0
    unit = _U * momentum_scale
    return distance(float(px / unit), float(py / unit)), float(abs(energy) / (_U * energy_scale))


def kinetic_energy(world: World) -> Fraction:
    """The total kinetic energy, exactly but for the factor in the masses of discs; 0 if a velocity is none."""
    total = Fraction(0)
    for f in world.flights:
        if f is not None:
            e = f.entity
            density = ASTEROID_DENSITY if type(e) is Asteroid else BULLET_DENSITY
            mass = (
                Fraction(e.mass)
                if type(e) is Ship
                else Fraction(4.0 / 3.0 * pi * density) * Fraction(e.radius) ** 3
            )
            if not isfinite(e.vx - e.vy):
                return Fraction(0)
            total += mass * (Fraction(e.vx) ** 2 + Fraction(e.vy) ** 2) / 2
    return total


def drift(start: Fraction, end: Fraction) -> float | None:
    try:
        return float((end - start) / start) if start else None
    except OverflowError:
        return inf
