"""Handles made quickly, for the tests of the facade."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from fasteroids.facade import AsteroidHandle, BulletHandle, Facade, ShipHandle, WorldHandle
from fasteroids.lang.syntax import Program

facade = Facade()

FIRST = (Path(__file__).parents[2] / "programs" / "first.ast").read_text(encoding="utf-8")
"""The first program of 1.8: turns by 0.2, 0.3 and so on, and fires in between."""

ILL_TYPED = "double d;\nd := true;\nturn null;"
"""Two type errors, in lines 2 and 3."""


def ship(
    x: float, y: float, vx: float = 0, vy: float = 0, r: float = 10, way: float = 0, m: float = 5e15
) -> ShipHandle:
    return facade.create_ship(x, y, vx, vy, r, way, m)


def rock(x: float, y: float, vx: float = 0, vy: float = 0, r: float = 20) -> AsteroidHandle:
    return facade.create_asteroid(x, y, vx, vy, r)


def ship_in(world: WorldHandle, *args: Any, **more: Any) -> ShipHandle:
    made = ship(*args, **more)
    facade.add_ship(world, made)
    return made


def rock_in(world: WorldHandle, *args: Any, **more: Any) -> AsteroidHandle:
    made = rock(*args, **more)
    facade.add_asteroid(world, made)
    return made


def position(s: ShipHandle) -> tuple[Any, Any]:
    return facade.get_ship_x(s), facade.get_ship_y(s)


def velocity(s: ShipHandle) -> tuple[Any, Any]:
    return facade.get_ship_x_velocity(s), facade.get_ship_y_velocity(s)


def shot_by(s: ShipHandle) -> BulletHandle:
    """Fire, and find the bullet."""
    home = facade.get_ship_world(s)
    assert home is not None
    before = facade.get_bullets(home)
    facade.fire_bullet(s)
    (bullet,) = facade.get_bullets(home) - before
    return bullet


def program(text: str) -> Program:
    parsed = facade.parse_program(text).program
    assert parsed is not None
    return parsed


class Listener:
    """Writes down what it is told, and what it sees meanwhile; `at_once` is called each time."""

    def __init__(self, at_once: Callable[..., object] = lambda *_: None) -> None:
        self.told: list[tuple[Any, ...]] = []
        self.seen: list[list[tuple[Any, ...]]] = []
        self.at_once = at_once

    def boundary_collision(self, entity: Any, x: float, y: float) -> None:
        self._note(entity, x, y)

    def object_collision(self, first: Any, second: Any, x: float, y: float) -> None:
        self._note(first, second, x, y)

    def _note(self, *told: Any) -> None:
        self.told.append(told)
        self.seen.append([(*e.entity.position, *e.entity.velocity) for e in told[:-2]])
        self.at_once(*told)
