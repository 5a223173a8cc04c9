"""What several unit tests make or measure with: worlds and their logs, scene texts, numbers."""

from __future__ import annotations

import sys
from fractions import Fraction
from typing import Any

import pytest
from attrs import evolve as with_
from attrs import frozen

from fasteroids import (
    Asteroid,
    Bullet,
    Happened,
    Ship,
    World,
    check_program,
    happenings,
    parse_program,
)
from fasteroids.actions import Action, Ticked
from fasteroids.entities import Entity
from fasteroids.lang import Machine
from fasteroids.scene import SceneError, load_scene
from fasteroids.state import replaced
from fasteroids.units import THRUST

U = Fraction(1, 2**53)
SUBNORMAL = 5e-324
MAX = sys.float_info.max


# Programs.


def machine(text: str) -> Machine:
    """A correct program, ready to run."""
    tree = parse_program(text).program
    assert tree is not None
    ready = check_program(tree).program
    assert ready is not None
    return ready


# Worlds. The numbers are chosen so that every result is a double: powers of two, and thrusters of 256 km/s^2.

STRONG = THRUST / 256
"""A mass (kg) that the thruster accelerates with 256 km/s^2."""


def ship(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Ship:
    """A ship of radius 10 that faces right, unless told otherwise."""
    given: dict[str, Any] = {"radius": 10.0, "mass": STRONG, "direction": 0.0}
    return Ship(x, y, vx, vy, **{**given, **fields})


def rock(
    x: float, y: float, vx: float = 0.0, vy: float = 0.0, r: float = 20.0, **f: Any
) -> Asteroid:
    return Asteroid(x, y, vx, vy, r, **f)


def shot(
    x: float, y: float, vx: float = 0.0, vy: float = 0.0, source: int = 99, **f: Any
) -> Bullet:
    return Bullet(x, y, vx, vy, 3.0, source, **f)


def world_of(*entities: Entity, width: float = 1000.0, height: float = 1000.0, **f: Any) -> World:
    return World(width, height, **f).add_all(entities)


def run(world: World, until: float, events: int = 1000) -> tuple[list[Happened], World]:
    """What happens up to `until`, and the world then."""
    log: list[Happened] = []
    unfold = happenings(world, until, max_events=events)
    while True:
        try:
            log.append(next(unfold)[0])
        except StopIteration as stop:
            assert len(log) < events
            return log, stop.value


def told(log: list[Happened]) -> list[tuple[Any, ...]]:
    """The bones of a log: time, kind, ids, wall, effect."""
    return [(h.time, h.kind, h.entities, h.wall, h.effect) for h in log]


def staged(world: World, **bounced_off: int) -> World:
    """The world with `bounced_off` set in some flights: staged(world, _1=2)."""
    changed = []
    for name, other in bounced_off.items():
        entity_id = int(name[1:])
        f = with_(world.flight_of(entity_id), bounced_off=other)
        changed.append((world.slot_of(entity_id), f))
    return replaced(world, world.clock, changed, (), ())


@frozen
class Script:
    """A program that does one thing a tick, then ends; None runs out of fuel."""

    steps: tuple[Action | None, ...]

    @property
    def running(self) -> bool:
        return bool(self.steps)

    def tick(self, _view: Any) -> Ticked:
        rest = Script(self.steps[1:])
        step = self.steps[0]
        return Ticked(rest, step) if step is not None else Ticked(rest, None, "fuel")


# Scene texts.

BOX = "[world]\nwidth = 1000\nheight = 800\n"
SHIP = "[[ship]]\nname = 'red'\nx = 100\ny = 100\nradius = 10\nmass = 1e15\n"
ROCK = "[[asteroid]]\nx = 300\ny = 100\nradius = 10\n"
SHOT = "[[bullet]]\nx = 500\ny = 100\nradius = 3\nsource = 'red'\n"


def problems(text: str, **chosen: Any) -> list[str]:
    """The lines of the error a text gives."""
    with pytest.raises(SceneError) as caught:
        load_scene(text, **chosen)
    assert str(caught.value).split("\n") == list(map(str, caught.value.problems))
    return list(map(str, caught.value.problems))


def problem(text: str) -> str:
    """The one problem of a text."""
    (line,) = problems(text)
    return line
