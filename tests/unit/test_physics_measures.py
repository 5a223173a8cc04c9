"""Masses, distances, and whether discs approach."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import inf, isinf, isnan, nan, pi
from math import ulp as spacing

import pytest

from fasteroids.physics import approaching, distance, sphere_mass, unit
from fasteroids.units import ASTEROID_DENSITY, BULLET_DENSITY
from tests.unit.making import MAX, SUBNORMAL, U


def test_sphere_mass() -> None:
    # Five roundings.
    for density in (ASTEROID_DENSITY, BULLET_DENSITY):
        exact = Fraction(4, 3) * Fraction(pi) * 10**3 * Fraction(density)
        assert abs(Fraction(sphere_mass(10.0, density)) / exact - 1) <= 5 * U


@pytest.mark.parametrize("radius", [1e-108, 1e-90, 1e90, 1e97])
def test_sphere_mass_where_the_cube_alone_is_no_double(radius: float) -> None:
    exact = Fraction(4, 3) * Fraction(pi) * Fraction(radius) ** 3 * Fraction(ASTEROID_DENSITY)
    mass = sphere_mass(radius, ASTEROID_DENSITY)
    # Subnormal from 1e-107 km down: then the spacing of doubles is what may be asked.
    assert abs(Fraction(mass) - exact) <= 5 * U * exact + 3 * Fraction(spacing(float(exact)))


def test_sphere_mass_beyond_the_doubles() -> None:
    assert sphere_mass(1e100, ASTEROID_DENSITY) == inf
    assert sphere_mass(1e-120, ASTEROID_DENSITY) == 0.0
    sizes = [sphere_mass(10.0**k, ASTEROID_DENSITY) for k in range(-100, 98)]
    assert all(a < b for a, b in pairwise(sizes))


@pytest.mark.parametrize(
    ("x", "y", "vx", "vy", "closer"),
    [
        (1.0, 0.0, -1.0, 5.0, True),
        (1.0, 0.0, 1.0, 5.0, False),
        (1.0, 1.0, 1.0, -1.0, False),
        (0.0, 0.0, 1.0, 1.0, False),
        (1.0, 1.0, 0.0, 0.0, False),
        (1e-200, 0.0, -1e-200, 0.0, True),
        (1e200, 0.0, -1e200, 0.0, True),
        (SUBNORMAL, 0.0, -SUBNORMAL, 0.0, True),
        (MAX, MAX, -MAX, -MAX, True),
    ],
)
def test_approaching(x: float, y: float, vx: float, vy: float, closer: bool) -> None:
    assert approaching(x, y, vx, vy) is closer


@pytest.mark.parametrize(
    ("x", "y", "length"),
    [
        (3.0, -4.0, 5.0),
        (0.0, 0.0, 0.0),
        (3e200, 4e200, 5e200),
        (-0.0, SUBNORMAL, SUBNORMAL),
        (3 * 2.0**-1070, 4 * 2.0**-1070, 5 * 2.0**-1070),
        (MAX, MAX, inf),
        (inf, 0.0, inf),
        (-inf, 3.0, inf),
    ],
)
def test_distance(x: float, y: float, length: float) -> None:
    assert distance(x, y) == pytest.approx(length, rel=2 * float(U), abs=0)
    assert isinf(distance(x, y)) == isinf(length)


def test_distance_of_what_is_no_number_is_none() -> None:
    assert isnan(distance(nan, 1.0))
    assert isnan(distance(1.0, nan))


@pytest.mark.parametrize("size", [1.0, 5.0, 2.0**-1072, 2.0**1021])
def test_unit(size: float) -> None:
    assert unit(3.0 * size, -4.0 * size) == (0.6, -0.8)
    assert unit(0.0, -size) == (0.0, -1.0)


def test_unit_of_nothing_is_nothing() -> None:
    assert unit(0.0, -0.0) == (0.0, 0.0)


def test_unit_where_the_length_is_no_double() -> None:
    for x, y in ((MAX, -MAX), (SUBNORMAL, -SUBNORMAL)):
        ux, uy = unit(x, y)
        assert ux == -uy == pytest.approx(0.5**0.5, rel=2 * float(U))
