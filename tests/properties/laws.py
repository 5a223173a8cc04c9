"""What the law tests share: how many examples, how many events, and ways to compare runs."""

from __future__ import annotations

import copy
from collections.abc import Sequence

from attrs import evolve
from hypothesis import settings

from fasteroids import Happened, World
from fasteroids.engine import Engine, Plan, give
from fasteroids.testing import Run, unfold

EVENTS = 40
"""Events a world runs for."""

world_law = settings(max_examples=min(2_000, settings.default.max_examples))
"""Laws on worlds: 2,000 examples in the long profile, where laws on plain numbers have 20,000."""


def forced(world: World, plan: Plan) -> World:
    """The same world with the parts of a plan forced on, and the grid only if the plan has it."""
    twin = copy.copy(world)
    give(twin, Engine(twin, plan))
    return twin


def same(expected: Run, actual: Run) -> None:
    """Same events, same worlds, same bits, and the same ids to come."""
    assert expected.log == actual.log
    assert expected.end == actual.end
    assert expected.end.roster.next_id == actual.end.roster.next_id


def continued(world: World, times: Sequence[float], events: int = EVENTS) -> Run:
    """A run cut at these times, for so many events in all."""
    log: list[Happened] = []
    worlds: list[World] = []
    for time in times:
        part = unfold(world, until=time, events=events - len(log))
        log += part.log
        worlds += part.worlds
        world = part.end
        if len(log) == events:
            break
    return Run(log, worlds, world)


def with_clean_ties(log: Sequence[Happened]) -> list[Happened]:
    """The log up to the first instant at which two events share an entity: there the order decides."""
    clean: list[Happened] = []
    for i, happened in enumerate(log):
        instant = [h for h in log if h.time == happened.time and h is not happened]
        if any(set(h.entities) & set(happened.entities) for h in instant):
            return [h for h in clean if h.time < log[i].time]
        clean.append(happened)
    return clean


def scaled(happened: Happened, length: float, time: float) -> Happened:
    """An event of a world with other units."""
    at = happened.at and (happened.at[0] * length, happened.at[1] * length)
    return evolve(happened, time=happened.time * time, at=at)
