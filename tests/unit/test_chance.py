"""Randomness: a pure function of (seed, entity id, purpose)."""

from __future__ import annotations

import subprocess
import sys
from math import tau

import pytest

from fasteroids.chance import angle, uniform

DRAWS = [uniform(seed, i, "split") for seed in range(40) for i in range(1, 51)]


def test_uniform_is_a_function() -> None:
    assert uniform(7, 3, "split") == uniform(7, 3, "split")


def test_uniform_has_these_bits_for_ever() -> None:
    # Recorded scenes depend on them.
    assert uniform(0, 1, "split").hex() == "0x1.fff3492506166p-2"


@pytest.mark.parametrize(
    "other", [(1, 3, "split"), (0, 4, "split"), (0, 3, "place"), (-1, 3, "split")]
)
def test_uniform_depends_on_each_argument(other: tuple[int, int, str]) -> None:
    assert uniform(*other) != uniform(0, 3, "split")


def test_uniform_does_not_confuse_neighbouring_arguments() -> None:
    assert uniform(1, 23, "x") != uniform(12, 3, "x")


def test_uniform_lies_in_the_unit_interval_and_is_a_multiple_of_2_to_the_minus_53() -> None:
    assert all(0.0 <= u < 1.0 for u in DRAWS)
    assert all((u * 2**53).is_integer() for u in DRAWS)
    assert len(set(DRAWS)) == len(DRAWS)


def test_uniform_is_uniform() -> None:
    # 2000 draws in 20 bins: chi squared has mean 19 and deviation 6.2; beyond 50 is chance 1e-4.
    counts = [sum(int(u * 20) == k for u in DRAWS) for k in range(20)]
    assert sum((n - 100) ** 2 / 100 for n in counts) < 50


def test_uniform_takes_any_seed() -> None:
    assert 0.0 <= uniform(10**5000, 1, "split") < 1.0
    assert uniform(10**5000, 1, "split") != uniform(10**5000 + 1, 1, "split")


def test_angle_is_a_direction() -> None:
    assert angle(5, 2, "split") == uniform(5, 2, "split") * tau
    assert all(0.0 <= angle(0, i, "split") < tau for i in range(1, 200))


def test_uniform_is_the_same_in_another_process_with_another_hash_seed() -> None:
    code = "from fasteroids.chance import uniform; print(uniform(3, 4, 'split').hex())"
    run = subprocess.run(
        [sys.executable, "-c", code],
        env={"PYTHONHASHSEED": "77", "PYTHONPATH": ":".join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout.strip() == uniform(3, 4, "split").hex()
