"""What the tests of shipped programs share: worlds with a ship that one of them flies, and how games end."""

from __future__ import annotations

from statistics import fmean
from typing import Any, Final

from fasteroids import Happened, Ship, World, load_scene
from fasteroids.arena import Ended, flown, play
from fasteroids.cli._files import shipped, shipped_programs
from fasteroids.entities import Entity
from fasteroids.lang import Machine
from fasteroids.testing import unfold
from tests.unit.making import machine

STILL: Final = "still"
"""The name of a program that skips: what every other one is measured against."""

_TEXTS: Final = {**shipped_programs(), STILL: "while (true) { skip; }"}


def program(name: str) -> Machine:
    return machine(_TEXTS[name])


def pilot(name: str | None, x: float = 512.0, y: float = 384.0, **fields: Any) -> Ship:
    """A ship at rest that looks to the right; without a program if it has no name."""
    given: dict[str, Any] = {"vx": 0.0, "vy": 0.0, "radius": 40.0, "mass": 5e15, "direction": 0.0}
    flyer = None if name is None else program(name)
    return Ship(x, y, **{**given, **fields}, program=flyer)


def arena(*entities: Entity) -> World:
    """A world of the size of the shipped fields; ids from 1 in the order given."""
    return World(1024, 768, model="smooth").add_all(entities)


def log(world: World, until: float) -> list[Happened]:
    return list(unfold(world, until=until).log)


def end(world: World, until: float) -> World:
    return unfold(world, until=until).end


def acted(happened: list[Happened]) -> list[str]:
    """The actions, in order."""
    return [h.effect for h in happened if h.kind == "tick"]


def killer(happened: list[Happened], victim: int) -> Happened:
    """The contact in which it died."""
    return next(h for h in happened if victim in h.died)


def games(field: str, seeds: range, *names: str) -> list[Ended]:
    """How games of a shipped field end for the first of its ships."""
    return [
        play(flown(load_scene(shipped()[field], seed=seed), [program(n) for n in names]))[0]
        for seed in seeds
    ]


def lifetime(field: str, seeds: range, name: str) -> float:
    """How long it lives on average, s; 120 s if it lives to the end of the game."""
    return fmean(g.time if g.outcome == "died" else 120.0 for g in games(field, seeds, name))


def cleared(field: str, seeds: range, name: str) -> int:
    return sum(g.outcome == "cleared" for g in games(field, seeds, name))


def wins(field: str, seeds: range, name: str, other: str) -> int:
    """Games won one on one, of two for each seed: the second with sides swapped."""
    swapped = [
        play(flown(load_scene(shipped()[field], seed=seed), [program(other), program(name)]))[1]
        for seed in seeds
    ]
    return sum(g.outcome == "won" for g in games(field, seeds, name, other) + swapped)
