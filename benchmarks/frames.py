"""Drawing: what a picture of a world costs, on each surface and at the usual sizes of a terminal.

The world is a game in full swing: 40 discs at game density, four of them ships under thrust, six bullets on their way.
Each turn draws 1/30 s after 1/30 s of it, as an application does, so nothing is drawn twice.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import accumulate
from math import cos, sin, tau
from random import Random
from time import process_time

from benchmarks.measure import Effort, Table, figure, ratios, turns
from benchmarks.workload import SEED
from fasteroids import Asteroid, Bullet, ModelError, Ship, World, evolve
from fasteroids.entities import Entity
from fasteroids.tui.camera import Look, frame
from fasteroids.tui.overlay import overlay

SURFACES = ("ascii", "braille", "block")
SIZES = ((80, 24), (120, 40), (200, 60))
RATE = 30  # frames a second
ASKED = 2.0  # ms at 120 x 40: 6 % of a core at this rate, and 12 % at twice of it
ASKED_AHEAD = 5.0  # ms


def game(n: int) -> World:
    """A world with so many entities: of ten, one ship, one or two bullets, and asteroids from 8 to 45 km."""
    random = Random(SEED)
    world = World(1600.0, 1200.0, seed=SEED, model="smooth")
    while len(world) < n:
        kind = len(world) % 10
        radius = 20.0 if kind == 0 else 3.0 if kind in (4, 7) else random.uniform(8.0, 45.0)
        x, y = random.uniform(radius, 1600.0 - radius), random.uniform(radius, 1200.0 - radius)
        heading, speed = random.uniform(0.0, tau), random.uniform(10.0, 150.0)
        vx, vy = speed * cos(heading), speed * sin(heading)
        entity: Entity
        if kind == 0:
            entity = Ship(x, y, vx, vy, radius, 5e16, heading, thruster=True)
        elif kind in (4, 7):
            entity = Bullet(x, y, vx, vy, radius, 1)
        else:
            entity = Asteroid(x, y, vx, vy, radius)
        try:
            world = world.add(entity)
        except ModelError:  # it overlaps another one
            continue
    return world


def film(world: World, length: int) -> list[World]:
    """So many worlds, one frame after the other."""
    return list(accumulate(range(length - 1), lambda w, _: evolve(w, 1.0 / RATE), initial=world))


def _each(worlds: list[World], action: Callable[[World], object]) -> Callable[[], float]:
    """A contender: milliseconds for one world."""

    def measured() -> float:
        start = process_time()
        for world in worlds:
            action(world)
        return (process_time() - start) / len(worlds) * 1e3

    return measured


def frames(effort: Effort) -> Table:
    """A picture with 40 entities, a look ahead, and the step of the game that both belong to."""
    worlds = film(game(effort.size(40)), effort.events(120))
    contenders = {
        "a step of 1/30 s from a kept world": _each(worlds, lambda w: evolve(w, 1.0 / RATE))
    }
    for surface in SURFACES:
        for columns, rows in SIZES:
            look = Look(arena=surface)
            drawn = partial(frame, look=look, columns=columns, rows=rows)
            contenders[f"{surface} {columns} x {rows}"] = _each(worlds, drawn)
    contenders["a look 4 s ahead, of all"] = _each(worlds[::8], overlay)
    for measured in contenders.values():
        measured()  # what a surface keeps of the discs it has drawn is there from the second frame on
    taken = turns(effort.rounds, contenders)
    middle = [f"{surface} 120 x 40" for surface in SURFACES]
    return Table(
        "Pictures of 40 entities",
        [
            *(
                figure(name, values, "ms", below=_bound(name, middle))
                for name, values in taken.items()
            ),
            *(
                figure(f"{surface}, 200 x 60 over 80 x 24",
                       ratios(taken[f"{surface} 200 x 60"], taken[f"{surface} 80 x 24"]))
                for surface in SURFACES
            ),
            *(
                figure(f"{name} over ascii", ratios(taken[name], taken[middle[0]]))
                for name in middle[1:]
            ),
        ],
        "The largest picture has 6.25 times as many cells as the smallest. Textual adds what it takes to show them.",
    )  # fmt: skip


def _bound(name: str, middle: list[str]) -> float | None:
    if name in middle:
        return ASKED
    return ASKED_AHEAD if "ahead" in name else None
