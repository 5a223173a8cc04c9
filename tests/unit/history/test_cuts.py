"""Cuts in a past: each is lived again once, and time may stay where it is."""

from __future__ import annotations

from fasteroids import Ship, World, evolve_until
from fasteroids.history import Cut, Given, begin
from fasteroids.history.living import beginning, lived, relived


def pushed() -> World:
    """A ship so light and strong that one push leads to a wall within the same moment of the clock."""
    world = World(width=1.5e-115, height=1e-115, model="robust")
    return world.add(
        Ship(
            x=8.3e-116, y=2.06e-116, vx=0.0, vy=0.0, radius=1.84e-116, mass=5.4e-157,
            direction=1.64, thruster=True, thrust_power=1e125,
        )
    )  # fmt: skip


def test_a_cut_is_lived_again_once() -> None:
    """Twice at one moment would be another past: what the first one led to would happen before the second."""
    start, clock = beginning(pushed()), (0, 1.18e-100, 0.0)
    states = list(lived(start, clock))
    assert [state.what for state in states] == [Cut(clock)]
    given = Given(states[0].place, Cut(clock))
    assert next(relived(start, [given], clock)) == states[0]


def test_a_timeline_may_stay_at_its_own_time_however_late() -> None:
    """The time of a late world is only the double nearest to its clock."""
    timeline = begin(evolve_until(World(width=9, height=9), 17027.0))
    for _ in range(40):
        timeline = timeline.evolve(0.8900346 / 3)
        world = timeline.world
        assert timeline.evolve_until(world.time).world == evolve_until(world, world.time)
