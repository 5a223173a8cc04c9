"""The cells in which neighbours are looked for."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest

from fasteroids import Asteroid
from fasteroids.grid import Grid, fitting


def discs(count: int, radius: float) -> list[Asteroid]:
    return [Asteroid(0, 0, 0, 0, radius)] * count


def test_a_grid_of_one_cell_is_all_with_all() -> None:
    grid = Grid(100.0, 50.0, 1, 1)
    assert grid.around == (0,)
    assert {grid.cell_at(x, y) for x in (0.0, 99.0, 1e9) for y in (-5.0, 49.0)} == {grid.stride + 1}
    cell = grid.stride + 1
    column, row = divmod(cell, grid.stride)
    assert grid.lefts[column] is grid.rights[column] is grid.bottoms[row] is grid.tops[row] is None


def test_cell_at_covers_the_world_and_stays_inside() -> None:
    grid = Grid(100.0, 30.0, 10, 3)
    assert divmod(grid.cell_at(0.0, 0.0), grid.stride) == (1, 1)
    assert divmod(grid.cell_at(99.9, 29.9), grid.stride) == (10, 3)
    assert divmod(grid.cell_at(100.0, 30.0), grid.stride) == (10, 3)
    assert divmod(grid.cell_at(-1e-9, 31.0), grid.stride) == (1, 3)
    assert divmod(grid.cell_at(10.0, 10.0), grid.stride) == (2, 2)


def test_every_cell_has_neighbours_and_an_empty_rim() -> None:
    grid = Grid(100.0, 30.0, 10, 3)
    assert len(grid.cells) == 12 * 5
    for column in range(1, 11):
        for row in range(1, 4):
            around = {column * grid.stride + row + delta for delta in grid.around}
            assert len(around) == 9
            assert all(0 <= cell < len(grid.cells) for cell in around)


def test_ahead_are_the_cells_that_become_neighbours() -> None:
    grid = Grid(100.0, 30.0, 10, 3)
    cell = grid.cell_at(50.0, 15.0)
    around = {cell + delta for delta in grid.around}
    assert set(grid.ahead) == {-1, 1, -grid.stride, grid.stride}
    for step, ahead in grid.ahead.items():
        after = cell + step
        assert {after + delta for delta in ahead} == {after + d for d in grid.around} - around


def test_borders_are_walls_at_the_rim_and_rise_between() -> None:
    grid = Grid(100.0, 30.0, 10, 3)
    columns = slice(1, None, grid.stride)  # one cell of each column, and of each row
    rows = slice(grid.stride, 2 * grid.stride)
    for lows, highs, cells, size in (
        (grid.lefts[columns], grid.rights[columns], 10, 100.0),
        (grid.bottoms[rows], grid.tops[rows], 3, 30.0),
    ):
        assert lows[1] is None
        assert highs[cells] is None
        inner = [border for border in highs[1:cells] if border is not None]
        assert len(inner) == cells - 1
        assert inner == lows[2 : cells + 1]
        assert all(a < b for a, b in pairwise([0.0, *inner, size]))


@pytest.mark.parametrize(
    ("width", "height", "count", "radius"),
    [
        (1000.0, 1000.0, 100, 5.0),
        (1000.0, 1000.0, 1000, 14.0),
        (20000.0, 70.0, 200, 30.0),
        (1e12, 1e12, 500, 1e9),
        (1e150, 1e150, 50, 1e148),
        (1e300, 1e-3, 50, 1e-4),
        (35 * 28 * (1 + 2.0**-21), 980.0, 1000, 14.0),
    ],
)
def test_cells_are_wider_than_the_largest_contact(
    width: float, height: float, count: int, radius: float
) -> None:
    columns, rows = fitting(width, height, discs(count, radius))
    assert 1 <= columns * rows <= 10 * count or min(columns, rows) == 1
    for size, cells in ((width, columns), (height, rows)):
        if cells > 1:
            assert size / cells >= 2 * radius * (1 + 2.0**-20)


def test_a_good_grid_has_a_few_cells_a_disc() -> None:
    columns, rows = fitting(1000.0, 1000.0, discs(1000, 5.0))
    assert 1000 <= columns * rows <= 4000


@pytest.mark.parametrize(
    ("width", "height", "count", "radius"),
    [
        (1000.0, 1000.0, 0, 1.0),
        (0.0, 0.0, 0, 1.0),
        (1000.0, 1000.0, 50, 400.0),
        (1e-150, 1e-150, 50, 1e-152),
        (1e6, 1e6, 50, 1e-12),
    ],
    ids=["nobody", "no room", "few cells", "smaller than the clock resolves", "tiny discs"],
)
def test_no_grid_where_cells_cannot_help(
    width: float, height: float, count: int, radius: float
) -> None:
    columns, rows = fitting(width, height, discs(count, radius))
    assert columns * rows >= 1
    if radius < 1e-9 and width < 1.0:
        assert (columns, rows) == (1, 1)
    if count == 0 or radius == 400.0:
        assert (columns, rows) == (1, 1)


def test_two_discs_that_touch_are_in_neighbouring_cells() -> None:
    rng = random.Random(9)
    columns, rows = fitting(1000.0, 700.0, discs(300, 9.0))
    grid = Grid(1000.0, 700.0, columns, rows)
    assert columns * rows > 100
    near = set(grid.around)
    for _ in range(2000):
        x, y = rng.uniform(9, 991), rng.uniform(9, 691)
        dx = rng.uniform(-18, 18)
        dy = rng.choice((-1, 1)) * (18.0**2 - dx * dx) ** 0.5
        assert grid.cell_at(x + dx, y + dy) - grid.cell_at(x, y) in near
