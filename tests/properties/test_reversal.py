"""L6: negate all velocities and the world comes back, as near as the growth of errors allows."""

from __future__ import annotations

from itertools import pairwise

from attrs import evolve
from hypothesis import assume, given

from fasteroids import Happened, Ship, World, evolve_until
from fasteroids.chance import uniform
from fasteroids.testing import keeping, unfold, worlds
from tests.properties.laws import world_law

U = 2.0**-53
EVENTS = 12
NUDGE = 2.0**-26


def reversed_(world: World, nudge: float = 0.0) -> World:
    """The world at its clock with velocities negated, the clock at 0; nudged by some of the fastest speed."""
    fastest = max(e.speed for e in world.entities.values())

    def push(entity_id: int, axis: str) -> float:
        return nudge * fastest * (2.0 * uniform(0, entity_id, axis) - 1.0)

    return World(world.width, world.height).add_all(
        evolve(e, vx=push(i, "x") - e.vx, vy=push(i, "y") - e.vy, id=None)
        for i, e in world.entities.items()
    )


def farthest(a: World, b: World) -> float:
    """The largest difference of a coordinate between two worlds of the same ids, km."""
    pairs = zip(a.entities.values(), b.entities.values(), strict=True)
    return max((max(abs(p.x - q.x), abs(p.y - q.y)) for p, q in pairs), default=0.0)


def apart(log: list[Happened], time: float) -> bool:
    """Is no entity in two events at nearly one moment, the start and the end among them?

    There the order decides, and reversal turns it round.
    """
    times: dict[int, list[float]] = {}
    for h in log:
        for i in h.entities:
            times.setdefault(i, [0.0]).append(h.time)
    return all(
        late - early > NUDGE * time
        for ts in times.values()
        for early, late in pairwise([*ts, time])
    )


def sequence(world: World, time: float) -> list[tuple[str, tuple[int, ...], str | None]]:
    return [(h.kind, h.entities, h.wall) for h in unfold(world, until=time).log]


@world_law
@given(worlds(kinds=(Ship,), flavours=("ordinary", "thin", "squeeze"), min_size=1, max_size=12))
def test_L6_reversal(world: World) -> None:
    """The tolerance: rounding enters at each of n events at the scale of the world, u (size + speed time), and
    grows on the way back as a nudge of the velocities does, measured beside it. 2^10 covers the directions in
    which the nudge did not point."""
    log = unfold(world, events=EVENTS + 1).log
    assume(len(log) >= 2)
    time = 0.5 * (log[-2].time + log[-1].time)
    assume(not any(h.clipped for h in log) and apart(log[:-1], time))
    there = evolve_until(world, time)
    back, beside = reversed_(there), reversed_(there, NUDGE)
    # A nudge that changes the events (a graze, say) measures no growth.
    assume(sequence(back, time) == sequence(beside, time))
    assume(sequence(back, time) == sequence(reversed_(there, -NUDGE), time))
    fastest = max(e.speed for e in world.entities.values())
    scale = max(world.width, world.height) + fastest * time
    home, nudged = evolve_until(back, time), evolve_until(beside, time)
    growth = max(1.0, farthest(home, nudged) / (NUDGE * scale))
    with keeping("L6_reversal", world):
        assert farthest(world, home) <= 2.0**10 * U * len(log) * scale * growth
