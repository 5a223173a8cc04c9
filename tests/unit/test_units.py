"""The constants of the assignment, in km, s, kg and rad."""

from __future__ import annotations

import sys

import pytest

from fasteroids import ModelError, units


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("SPEED_OF_LIGHT", 300_000.0),
        ("MAX_WORLD_SIZE", sys.float_info.max),
        ("THRUST", 1.1e18),
        ("ASTEROID_DENSITY", 2.65e12),
        ("BULLET_DENSITY", 7.8e12),
        ("BULLET_RADIUS", 3.0),
        ("BULLET_SPEED", 250.0),
        ("MAX_BULLETS", 3),
        ("SPLIT_RADIUS", 30.0),
        ("CHILD_SPEED_FACTOR", 1.5),
        ("TICKS_PER_SECOND", 5),
        ("FUEL", 10_000),
        ("MAX_FUEL", 10**9),
        ("WINDOW", 1024.0),
        ("MAX_ACCELERATION", 2.0**1000),
    ],
)
def test_constants_are_those_of_the_text(name: str, value: float) -> None:
    assert getattr(units, name) == value


def test_every_constant_is_tested_here() -> None:
    public = {name for name in vars(units) if name.isupper()}
    assert public <= set(units.__all__)
    assert len(public) == 15


def test_model_error_is_a_value_error() -> None:
    assert issubclass(ModelError, ValueError)
    assert ModelError is units.ModelError
