"""Laws of questions to a past: they see what a plain list of states would show, however it is kept."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fasteroids import ModelError, World, happenings
from fasteroids.entities import id_of
from fasteroids.history import (
    Kind,
    Lived,
    Place,
    Point,
    Timeline,
    begin,
    diff,
    events_of,
    first_difference,
    first_time,
    last_change,
    last_time,
    next_state,
    next_step,
    previous_state,
    previous_step,
    tick_at,
    ticks_of,
    why,
)
from fasteroids.history.changes import value_of
from fasteroids.history.marks import is_of
from fasteroids.lang import Machine
from fasteroids.testing import actions, worlds
from fasteroids.units import FUEL
from tests.properties.laws import EXAMPLES

CALM = ("ordinary", "dense", "thin", "corners", "twins")
past_law = settings(max_examples=max(10, min(1_000, EXAMPLES // 3)))
"""A past is dear to draw: it lives through dozens of events."""

KINDS: tuple[Kind, ...] = (
    "event", "contact", "wall", "limit", "tick", "input", "death", "birth", "shot", "print"
)  # fmt: skip


@st.composite
def pasts(draw: st.DrawFn) -> tuple[Timeline, list[Lived]]:
    """A past of some dozen events with some inputs, perhaps on a branch, and its states as they were lived."""
    model = draw(st.sampled_from(["smooth", "robust"]))
    world = draw(
        worlds(flavours=CALM, min_size=2, max_size=6, thrusters=True, programs=True, model=model)
    )
    timeline = begin(world)
    for _ in range(draw(st.integers(1, 5))):
        try:
            timeline = timeline.evolve_until(_reach(timeline.world, draw(st.integers(1, 12))))
        except ModelError:  # jammed: see L14
            break
        ships = [id_of(s) for s in timeline.world.ships]
        acts = draw(st.integers(0, 1)) == 1
        if ships and acts:
            timeline = timeline.act(draw(st.sampled_from(ships)), draw(actions()))
        if draw(st.integers(0, 4)) == 0:
            at = draw(st.floats(0.0, 1.0)) * timeline.world.time
            timeline = timeline.branch(at)
    return timeline, [timeline.first, *timeline.forwards(timeline.first.place)]


def _reach(world: World, events: int) -> float:
    """When so many more events, 1 or more, have happened, or a second later."""
    times = [
        happened.time for happened, _ in happenings(world, world.time + 1.0, max_events=events)
    ]
    return times[-1] if len(times) == events else world.time + 1.0


def kept(timeline: Timeline, data: st.DataObject) -> Timeline:
    """The same past with other states kept."""
    share = data.draw(st.sampled_from([1.0, 0.5, 0.1, 0.0]))
    return timeline.thin(int(timeline.bytes * share))


@past_law
@given(pasts(), st.data())
def test_next_and_previous_are_neighbours_in_the_list_of_states(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, states = past
    asked = kept(timeline, data)
    kind = data.draw(st.sampled_from(KINDS))
    entity = data.draw(st.none() | st.integers(1, 12))
    place = data.draw(st.sampled_from(states)).place
    of_kind = [s.place for s in states if is_of(s, kind, entity)]
    after, before = (
        next_state(asked, place, kind, entity),
        previous_state(asked, place, kind, entity),
    )
    assert (after and after.place) == min((p for p in of_kind if p > place), default=None)
    assert (before and before.place) == max((p for p in of_kind if p < place), default=None)
    if after is not None and place in of_kind:
        back = previous_state(asked, after.place, kind, entity)
        assert back is not None
        assert back.place == place


@past_law
@given(pasts(), st.data())
def test_what_happened_to_all_is_what_happened(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, states = past
    asked = kept(timeline, data)
    told = {
        state.place: state.what
        for entity in range(1, timeline.world.roster.next_id)
        for state in events_of(asked, entity)
    }
    about_some = [s for s in states if is_of(s, "event") or is_of(s, "input")]
    assert told == {s.place: s.what for s in about_some}


@past_law
@given(pasts(), st.data())
def test_the_last_change_is_where_the_value_on_record_last_differed(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, states = past
    asked = kept(timeline, data)
    entity = data.draw(st.integers(1, max(timeline.world.roster.next_id - 1, 1)))
    field = data.draw(
        st.sampled_from(["vx", "vy", "direction", "thruster", "bounced", "name", "path"])
    )
    values = [(s.place, value_of(s.world, entity, field)) for s in states]
    moves = [(place, a, b) for (_, a), (place, b) in pairwise(values) if a != b]
    changed = last_change(asked, entity, field)
    told = changed and (changed.state.place, changed.old, changed.new)
    assert told == (moves[-1] if moves else None)


@past_law
@given(pasts(), st.data())
def test_what_flips_at_events_is_found_as_by_looking_at_each(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    """The number of entities, and whether somebody lives, change at happenings only."""
    timeline, states = past
    asked = kept(timeline, data)
    count = data.draw(st.integers(0, 10))
    entity = data.draw(st.integers(1, 12))

    def holds(world: World) -> bool:
        return (len(world) > count) != (entity in world)

    first = first_time(asked, holds)
    slow = [s.place for s in states if holds(s.world)]
    assert (first and first.place) == min(slow, default=None)
    last = last_time(asked, holds)
    assert (last is None) == (not slow)
    if last is not None:
        assert last.place >= max(slow)
        assert not any(s.place > last.place and holds(s.world) for s in states)


@past_law
@given(pasts(), st.data())
def test_a_moment_found_is_a_boundary_and_the_same_however_states_are_kept(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, _ = past
    asked = kept(timeline, data)
    entity = data.draw(st.integers(1, 4))
    part = data.draw(st.floats(0.0, 1.0)) * timeline.world.width

    def holds(world: World) -> bool:
        return entity in world and world[entity].x <= part

    found, again = first_time(timeline, holds), first_time(asked, holds)
    assert (found and found.place) == (again and again.place)
    if found is not None:
        assert holds(found.world)
        earlier = first_time(timeline, holds, before=found.place)
        assert earlier is not None
        assert earlier.place == found.place
    last, once_more = last_time(timeline, holds), last_time(asked, holds)
    assert (last and last.place) == (once_more and once_more.place)
    assert (found is None) == (last is None)


@past_law
@given(pasts(), st.data())
def test_every_death_has_a_reason_that_does_not_depend_on_what_is_kept(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, states = past
    asked = kept(timeline, data)
    for state in states:
        for entity in state.died:
            death = why(asked, entity)
            assert death.place == state.place
            assert death.inevitable <= state.place
            assert str(death) == str(why(timeline, entity))
    for entity in timeline.world.roster.slots:
        with pytest.raises(ModelError, match="is alive at"):
            why(asked, entity)


@past_law
@given(pasts())
def test_worlds_differ_if_and_only_if_they_are_not_equal(
    past: tuple[Timeline, list[Lived]],
) -> None:
    _, states = past
    for a, b in pairwise(s.world for s in states):
        assert (diff(a, b) == ()) == (a == b)


@past_law
@given(pasts(), st.data())
def test_a_branch_parts_where_it_takes_another_input(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, _ = past
    at = data.draw(st.floats(0.0, 1.0)) * timeline.world.time
    name = timeline.name
    smooth = timeline.world.model == "smooth"
    branch = timeline.branch(at, "other").evolve(timeline.world.time - at)
    parted = first_difference(branch, name, "other")
    if smooth and parted is not None:  # an input of the old line, or what came of it
        assert parted.a is not None
        inputs = [s.place for s in timeline.forwards(Place(0, 0.0)) if is_of(s, "input")]
        assert parted.a.place in inputs
    mirrored = first_difference(branch, "other", name)
    assert (parted is None) == (mirrored is None)


@past_law
@given(pasts(), st.data())
def test_steps_forwards_and_backwards_are_inverse_and_lead_to_what_was_lived(
    past: tuple[Timeline, list[Lived]], data: st.DataObject
) -> None:
    timeline, _ = past
    asked = kept(timeline, data)
    for entity in range(1, timeline.world.roster.next_id):
        ticks = [s for s in ticks_of(timeline, entity) if _by_machine(s, entity)]
        if not ticks:
            continue
        state = data.draw(st.sampled_from(ticks))
        tick = tick_at(asked, entity, state.place)
        left = state.world.flight_of(entity).entity
        assert tick.machine(len(tick.steps)) == left.program  # type: ignore[union-attr]
        assert 0 < len(tick.steps) <= tick.fuel <= FUEL
        point = Point(tick, data.draw(st.integers(0, len(tick.steps) - 1)))
        after, before = next_step(asked, point), previous_step(asked, point)
        assert after is not None
        assert previous_step(asked, after) == point
        if before is not None:
            assert next_step(asked, before) == point


def _by_machine(state: Lived, entity: int) -> bool:
    return isinstance(getattr(state.world.flight_of(entity).entity, "program", None), Machine)
