"""What the law tests share: how many examples, how many events, and ways to compare runs."""

from __future__ import annotations

import copy
from collections.abc import Sequence

from attrs import evolve
from hypothesis import settings
from hypothesis import strategies as st

from fasteroids import Happened, World
from fasteroids.engine import Engine, Plan, give
from fasteroids.moments import Moment, between, resolution
from fasteroids.overlap import depth, slack
from fasteroids.state import located
from fasteroids.testing import Run, formations, unfold, worlds

EVENTS = 40
"""Events a world runs for."""

EXAMPLES = settings().max_examples
world_law = settings(max_examples=min(2_000, EXAMPLES))
"""Laws on worlds: 2,000 examples in the long profile, where laws on plain numbers have 20,000."""


SMOOTH = st.one_of(worlds(thrusters=True, programs=True, model="smooth"), formations())
"""Worlds whose ships fly exact paths, switch, turn and fire, or fly side by side and press on each other."""

FLOWING = st.one_of(worlds(programs=True), SMOOTH)
"""Worlds whose future does not depend on how time is cut."""

BURNING = st.one_of(worlds(thrusters=True, programs=True), SMOOTH)
"""Worlds under both rules of thrust."""


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


def before_ties(world: World, run: Run) -> list[Happened]:
    """The log up to the first instant at which an entity has two things to do: there the order decides."""
    clean: list[Happened] = []
    for happened, after in zip(run.log, run.worlds, strict=True):
        if any(busy(world, after.now, i, happened) for i in happened.entities):
            break
        clean.append(happened)
        world = after
    return [h for h in clean if len(clean) == len(run.log) or h.time < happened.time]


def busy(world: World, now: Moment, entity_id: int, happened: Happened) -> bool:
    """Does an entity touch something at `now` besides what `happened` tells?"""
    here = {i: located(f, now) for i, f in world.all_flights().items()}
    fine = {
        i: 4.0 * slack(here[i], between(f.since, now), resolution(now))
        for i, f in world.all_flights().items()
    }
    e = here[entity_id]
    others = (i for i in here if i not in happened.entities)
    if any(depth(e, here[i]) > -fine[entity_id] - fine[i] for i in others):
        return True
    walls = {
        "left": e.radius - e.x,
        "right": e.x - (world.width - e.radius),
        "bottom": e.radius - e.y,
        "top": e.y - (world.height - e.radius),
    }
    return any(out > -fine[entity_id] for side, out in walls.items() if side != happened.wall)


def scaled(happened: Happened, length: float, time: float) -> Happened:
    """An event of a world with other units."""
    at = happened.at and (happened.at[0] * length, happened.at[1] * length)
    return evolve(happened, time=happened.time * time, at=at)
