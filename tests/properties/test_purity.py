"""L4: nothing changes its argument, and two futures of one world do not disturb each other."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from fasteroids import World, act, evolve, evolve_until, happenings
from fasteroids.entities import id_of
from fasteroids.testing import actions, keeping, unfold, worlds
from fasteroids.testing.runs import FOREVER
from tests.properties.laws import BURNING, EVENTS, world_law


def everything(world: World) -> tuple[Any, ...]:
    """All that a world is, cache apart, in plain values."""
    flights = {i: repr(f) for i, f in world.all_flights().items()}
    return repr(world), world.clock, world.roster.next_id, flights


@world_law
@given(BURNING, st.lists(st.booleans(), max_size=2 * EVENTS))
def test_L4_purity_of_suspended_iterators(world: World, turns: list[bool]) -> None:
    log = unfold(world, events=EVENTS).log
    before = everything(world)
    futures = [happenings(world, FOREVER, max_events=EVENTS) for _ in range(2)]
    seen: list[list[Any]] = [[], []]
    with keeping("L4_purity_of_suspended_iterators", world):
        for turn in turns:
            for happened, after in futures[turn]:
                seen[turn].append(happened)
                if len(seen[turn]) % 3 == 0:  # and somebody else looks ahead from there
                    unfold(after, events=2)
                break
        for part in seen:
            assert log[: len(part)] == part
        assert before == everything(world)


@world_law
@given(BURNING, st.data())
def test_L4_purity_of_past_states(world: World, data: st.DataObject) -> None:
    run = unfold(world, events=EVENTS)
    pictures = [everything(w) for w in run.worlds]
    with keeping("L4_purity_of_past_states", world):
        for _ in range(3):
            if not run.log:
                break
            i = data.draw(st.integers(0, len(run.log) - 1))
            again = unfold(run.worlds[i], events=len(run.log) - i - 1)
            assert run.log[i + 1 :] == again.log
        assert pictures == [everything(w) for w in run.worlds]


@world_law
@given(worlds(min_size=1, thrusters=True, programs=True), actions(), st.floats(0.0, 1.0))
def test_L4_purity_of_operations(world: World, action: Any, dt: float) -> None:
    world = unfold(world, events=3).end
    before = everything(world)
    with keeping("L4_purity_of_operations", world):
        for ship in world.ships:
            act(world, id_of(ship), action)
        for entity_id in world.entities:
            world.remove(entity_id)
        unfold(world, until=world.time + dt, events=EVENTS)
        assert before == everything(world)
        assert hash(world) == hash(world)


@given(worlds(flavours=("ordinary",), max_size=4), st.floats(0.0, 1.0))
def test_L4_purity_of_evolve(world: World, dt: float) -> None:
    before = everything(world)
    assert evolve(world, dt) == evolve(world, dt)
    assert evolve_until(world, dt) == evolve_until(world, dt)
    assert before == everything(world)
