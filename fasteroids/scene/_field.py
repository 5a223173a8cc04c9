"""Fields of asteroids: many of them at random places, none upon another.

Each asteroid draws its radius, speed and direction, then places until one is free, all as functions of (seed,
number of the field, number of the asteroid, purpose). So what else is in a scene changes the luck of those
only whose place it takes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import cos, sin

from attrs import frozen

from fasteroids import chance
from fasteroids.entities import Asteroid, Entity, Ship
from fasteroids.overlap import depth

__all__ = ["MOST_ASTEROIDS", "MOST_TRIES", "Field", "scattered"]

MOST_ASTEROIDS = 10_000
"""As many asteroids a field may have. A limit, so that a slip of the pen does not fill the memory."""

MOST_TRIES = 1_000
"""Places an asteroid tries before its field is called full. Discs thrown at random jam at 0.547 of the area."""

_CELLS = 4096  # of the hash, along a side: so that the number of a cell stays small in any world


@frozen
class Field:
    """Asteroids to be placed: how many, and from what ranges (low, high) to draw.

    `radius` in km, `speed` in km/s; `clear` is the least distance (km) from rim to rim to every ship.
    """

    number: int
    count: int
    radius: tuple[float, float]
    speed: tuple[float, float] = (0.0, 0.0)
    clear: float = 0.0


class _Room:
    """Who is where: the entities listed one by one, the scattered ones in a hash of square cells."""

    def __init__(self, listed: Sequence[Entity], cell: float) -> None:
        self._listed, self._cell = listed, cell
        self._cells: dict[tuple[int, int], list[Asteroid]] = {}

    def _at(self, a: Asteroid) -> tuple[int, int]:
        return int(a.x / self._cell), int(a.y / self._cell)

    def is_free(self, a: Asteroid, clear: float) -> bool:
        """Is there room for an asteroid, `clear` km away from every ship? Touching is fine."""
        for e in self._listed:
            if -depth(a, e) < (clear if type(e) is Ship else 0.0):
                return False
        column, row = self._at(a)
        for i in (column - 1, column, column + 1):
            for j in (row - 1, row, row + 1):
                if any(depth(a, other) > 0.0 for other in self._cells.get((i, j), ())):
                    return False
        return True

    def take(self, a: Asteroid) -> None:
        """Put an asteroid where it is."""
        self._cells.setdefault(self._at(a), []).append(a)


def scattered(
    seed: int, width: float, height: float, fields: Iterable[Field], listed: Sequence[Entity]
) -> list[list[Asteroid]]:
    """The asteroids of each field, beside the entities `listed` and those of the fields before it.

    Radius, speed and direction are uniform, and so is the place over the rectangle that leaves the disc inside
    a world of `width` by `height` km, which must hold the widest. A list is shorter than its field's count if
    one found no place in `MOST_TRIES`.
    """
    fields = list(fields)
    widest = 2.0 * max((field.radius[1] for field in fields), default=0.0)
    room = _Room(listed, max(widest, width / _CELLS, height / _CELLS))
    return [list(_placed(seed, width, height, field, room)) for field in fields]


def _placed(
    seed: int, width: float, height: float, field: Field, room: _Room
) -> Iterable[Asteroid]:
    for i in range(1, field.count + 1):
        radius = _between(*field.radius, seed, i, f"field {field.number} radius")
        speed = _between(*field.speed, seed, i, f"field {field.number} speed")
        angle = chance.angle(seed, i, f"field {field.number} direction")
        vx, vy = speed * cos(angle), speed * sin(angle)
        for k in range(MOST_TRIES):
            x = _between(radius, width - radius, seed, i, f"field {field.number} x {k}")
            y = _between(radius, height - radius, seed, i, f"field {field.number} y {k}")
            asteroid = Asteroid(x, y, vx, vy, radius)
            if room.is_free(asteroid, field.clear):
                room.take(asteroid)
                yield asteroid
                break
        else:
            return


def _between(low: float, high: float, seed: int, index: int, purpose: str) -> float:
    """A number drawn uniformly from [low, high]."""
    return min(low + (high - low) * chance.uniform(seed, index, purpose), high)
