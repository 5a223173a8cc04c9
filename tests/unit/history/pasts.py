"""Pasts that several tests ask questions of."""

from __future__ import annotations

from math import pi

from fasteroids import Fire, World
from fasteroids.history import Lived, Timeline, begin
from tests.unit.making import machine, rock, ship, world_of

PILOT = """\
double n;
entity target;
while (true) {
  n := n + 1;
  foreach (asteroid, target) { print getx target; }
  if (n % 3 == 0) { turn 0.5; } else { thrust; }
  thrust_off;
}
"""


def arena(model: str = "smooth") -> World:
    """Two ships with programs, one of which shoots, and four rocks."""
    return world_of(
        ship(120.0, 880.0, program=machine(PILOT), name="red"),
        ship(800.0, 500.0, direction=pi, program=machine("while (true) { fire; skip; turn 0.4; }")),
        rock(500.0, 520.0, 40.0, 12.0, r=32.0),
        rock(300.0, 200.0, -30.0, 60.0),
        rock(700.0, 800.0, 64.0, -24.0),
        rock(500.0, 250.0, 16.0, 80.0),
        model=model,
    )


def fought(model: str = "smooth", *, budget: int = 2**28) -> Timeline:
    """Twelve seconds of it, cut 60 times, with a shot by hand at 3 s."""
    timeline = begin(arena(model), budget=budget)
    for i in range(60):
        timeline = timeline.evolve(0.2)
        if i == 14:
            timeline = timeline.act(1, Fire())
    return timeline


def states(timeline: Timeline) -> list[Lived]:
    """Every state of a past, the first included."""
    return [timeline.first, *timeline.forwards(timeline.first.place)]
