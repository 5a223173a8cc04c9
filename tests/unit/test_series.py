"""Taylor series of bent paths: what they say of the path, what they leave out, and the time they grant."""

from __future__ import annotations

from math import cos, exp, hypot, inf, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.paths import Limited, Parabola, Path, limited
from fasteroids.series import ORDER, difference, safe_time, series
from tests.unit.making import U

angles = st.floats(0.0, 2.0 * pi)


def moved(path: Path | None, vx: float, vy: float, nx: float, ny: float, t: float) -> float:
    """How far along n after t s, by the closed form."""
    x, y = path.after(0.0, 0.0, vx, vy, t)[:2] if path else (vx * t, vy * t)
    return nx * x + ny * y


def summed(terms: list[float], t: float) -> float:
    total = 0.0
    for term in reversed(terms):
        total = (total + term) * t
    return total


@given(angles, angles, st.floats(-pi / 2, pi / 2), st.floats(0.01, 1e3), st.floats(0.0, 2.0))
def test_the_series_of_a_limited_path_is_the_path_but_for_what_is_left(
    aim: float, n: float, turn: float, power: float, time: float
) -> None:
    c = 250.0
    vx, vy = c * cos(aim), c * sin(aim)
    path = limited(vx, vy, power * cos(aim + turn), power * sin(aim + turn), c)
    nx, ny, unit = cos(n), sin(n), 1.0 / path.rate
    terms, left = series(path, vx, vy, nx, ny, unit)
    assert len(terms) == ORDER - 1
    error = abs(summed(terms, time) - moved(path, vx, vy, nx, ny, time * unit))
    assert error <= left * time**ORDER + 64 * U * c * unit * max(time, 1.0) ** (ORDER - 1)


def test_what_is_left_is_not_much_more_than_the_next_term() -> None:
    """The poles lie pi / 2 away, so terms shrink by 2 / pi each; the bound pays for a circle of radius 1."""
    path = Limited(1.0, 0.0, 250.0, 250.0, 1.0, 1.0)
    terms, left = series(path, 0.0, 250.0, 1.0, 0.0, 1.0)
    scale = 250.0 * (2.0 / pi) ** ORDER
    assert max(map(abs, terms[-2:])) > 0.1 * scale / ORDER
    assert left < 100.0 * scale


def test_parabolas_and_lines_are_their_own_series() -> None:
    terms, left = series(Parabola(3.0, -4.0), 5.0, 7.0, 0.6, 0.8, 2.0)
    assert left == 0.0
    assert terms[0] == pytest.approx(2.0 * (3.0 + 5.6))
    assert terms[1] == pytest.approx(0.5 * 4.0 * (1.8 - 3.2))
    assert not any(terms[2:])
    assert series(None, 5.0, 7.0, 1.0, 0.0, 2.0)[0] == [10.0, *[0.0] * (ORDER - 2)]


def test_two_that_bend_alike_stay_apart_for_ever_but_for_what_is_left() -> None:
    path = Limited(1.0, 0.0, 250.0, 220.0, 0.88, 0.5)
    one = series(path, 200.0, 150.0, 0.6, 0.8, 1.0)
    change = difference(one, one)
    assert change == ([0.0] * (ORDER - 1), 2.0 * one[1])
    gap = 1e-6
    assert safe_time(gap, change) == pytest.approx((gap / change[1]) ** (1 / ORDER), rel=0.01)


def test_what_opens_a_gap_grants_all_time() -> None:
    assert safe_time(1.0, ([3.0, 2.0], 0.0)) == inf


@given(
    st.floats(1e-9, 1e3),
    st.lists(st.floats(-1e3, 1e3), min_size=ORDER - 1, max_size=ORDER - 1),
    st.floats(0.0, 1e3),
    st.floats(0.0, 1.0),
)
def test_a_gap_is_open_for_the_time_granted(
    gap: float, terms: list[float], left: float, part: float
) -> None:
    time = safe_time(gap, (terms, left))
    if time < inf:
        t = part * time
        assert gap + summed([*terms, -left], t) > -1e-9 * gap
        closing = [min(term, 0.0) for term in [*terms, -left]]
        assert gap + summed(closing, 1.01 * time + 1e-300) < 0.2 * gap  # near the longest


def test_late_on_the_path_little_is_left() -> None:
    path = Limited(1.0, 0.0, 250.0, 220.0, 0.88, 1.0)
    early, late = (series(path.onward(t), 0.0, 250.0, 0.0, 1.0, 1.0)[1] for t in (0.0, 30.0))
    assert late == pytest.approx(early * 2.0 * exp(-0.88 * 30.0), rel=1e-6)
    assert hypot(*path.after(0.0, 0.0, 0.0, 250.0, 30.0)[2:]) == pytest.approx(250.0)
