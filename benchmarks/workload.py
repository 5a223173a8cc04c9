"""W(N): a box of equal discs, the load every measurement runs on.

N discs of diameter 1 km in a square of area N pi / 4 phi, on a grid jittered by up to 0.45 of the gap between
neighbours, so that none overlap. Velocities are normal, scaled so that each component has unit root mean square.
"""

from __future__ import annotations

from itertools import islice
from math import ceil, pi, sqrt, tau
from random import Random

from fasteroids import Asteroid, Ship, World, happenings

SEED = 12345
FOREVER = 1e300  # s; no run gets there
DENSE = 0.2  # area fraction of the main load
THIN = 0.02  # like a game


def workload(n: int, phi: float = DENSE, *, model: str = "robust") -> World:
    """W(n) at area fraction `phi`, as a world of asteroids."""
    side = sqrt(n * pi / 4.0 / phi)
    columns = ceil(sqrt(n))
    pitch = side / columns
    jitter = 0.45 * (pitch - 1.0)
    random = Random(SEED)
    places = [
        (
            (i % columns + 0.5) * pitch + random.uniform(-jitter, jitter),
            (i // columns + 0.5) * pitch + random.uniform(-jitter, jitter),
        )
        for i in range(n)
    ]
    vx = _unit_rms([random.gauss(0.0, 1.0) for _ in range(n)])
    vy = _unit_rms([random.gauss(0.0, 1.0) for _ in range(n)])
    return World(side, side, model=model).add_all(
        Asteroid(x, y, u, v, 0.5) for (x, y), u, v in zip(places, vx, vy, strict=True)
    )


def thrusting(n: int, burning: int, *, model: str) -> World:
    """W(n) at game density as ships, so that nobody dies; `burning` of them thrust, each its own way.

    The acceleration is such that a ship gains the speed of the others in 20 s.
    """
    discs = workload(n, THIN, model=model)
    return World(discs.width, discs.height, model=model).add_all(
        Ship(
            *e.position, *e.velocity, e.radius, 1.0, tau * i / burning,
            thruster=i < burning, thrust_power=0.05,
        )
        for i, e in enumerate(discs.asteroids)
    )  # fmt: skip


def _unit_rms(values: list[float]) -> list[float]:
    rms = sqrt(sum(value * value for value in values) / len(values))
    return [value / rms for value in values]


def after(world: World, events: int) -> World:
    """The world after so many events: the order of the start is gone by 2 N of them."""
    for _, moved in islice(happenings(world, FOREVER), events):
        world = moved
    return world
