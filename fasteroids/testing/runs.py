"""Running a world for a number of events instead of seconds."""

from __future__ import annotations

from typing import NamedTuple

from fasteroids.events import Happened, happenings
from fasteroids.state import World

__all__ = ["FOREVER", "Run", "unfold"]

FOREVER = 1e300
"""Seconds. Later than anything that happens at the scales the strategies draw."""


class Run(NamedTuple):
    """What happened, the world after each event, and the last world."""

    log: list[Happened]
    worlds: list[World]
    end: World

    @property
    def times(self) -> list[float]:
        """When the events happened, s."""
        return [happened.time for happened in self.log]


def unfold(world: World, *, until: float = FOREVER, events: int | None = None) -> Run:
    """Everything that happens until an absolute time (s), or for so many events."""
    log: list[Happened] = []
    worlds: list[World] = []
    unfolding = happenings(world, until, max_events=events)
    while True:
        try:
            happened, after = next(unfolding)
        except StopIteration as stop:
            return Run(log, worlds, stop.value)
        log.append(happened)
        worlds.append(after)
