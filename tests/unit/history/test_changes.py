"""When a value last changed, from what to what, and since which state."""

from __future__ import annotations

from itertools import pairwise
from math import pi

import pytest

from fasteroids import Happened, ModelError, ThrustOff, Turn
from fasteroids.history import ABSENT, Lived, Timeline, begin, last_change, next_state
from fasteroids.history.changes import FIELDS, value_of
from fasteroids.history.living import Told
from fasteroids.history.marks import is_of
from tests.unit.history.pasts import fought, states
from tests.unit.making import machine, rock, ship, world_of


def bouncing() -> Timeline:
    """A ship that meets the right wall at 4 s and turns at 6 s, and a rock that nothing happens to."""
    world = world_of(ship(590.0, 500.0, 100.0), rock(100.0, 100.0))
    timeline = begin(world).evolve(6.0)
    return timeline.act(1, Turn(0.5)).evolve(2.0)


def test_a_velocity_changes_at_a_bounce() -> None:
    timeline = bouncing()
    changed = last_change(timeline, 1, "vx")
    assert changed is not None
    assert (changed.entity, changed.field, changed.old, changed.new) == (1, "vx", 100.0, -100.0)
    assert changed.state == next_state(timeline, 0.0, "wall")
    assert str(changed) == (
        "#1 vx from 100.0 to -100.0 at 4.0 s: t=4 wall #1, at the right, bounce"
    )
    assert last_change(timeline, 1, "vx", before=changed.state.place) is None
    assert last_change(timeline, 1, "vx", before=4.0) is None
    after = changed.state.place.after(changed.state.place.moment)
    assert last_change(timeline, 1, "vx", before=after) == changed


def test_a_place_is_decided_where_the_flight_begins() -> None:
    timeline = bouncing()
    changed = last_change(timeline, 1, "x")
    assert changed is not None
    assert changed.state.place.time == 4.0
    assert (changed.old, changed.new) == (590.0, 990.0)


def test_a_bounce_to_the_same_number_is_a_change_of_place_all_the_same() -> None:
    world = world_of(ship(500.0, 10.0, 0.0, 98.0))
    timeline = begin(world).evolve(25.0)
    bottom = next_state(timeline, 11.0, "wall")
    assert bottom is not None
    changed = last_change(timeline, 1, "x")
    assert changed is not None
    assert (changed.old, changed.new, changed.state) == (500.0, 500.0, bottom)


def test_a_turn_is_an_input_that_changes_the_direction_alone() -> None:
    timeline = bouncing()
    changed = last_change(timeline, 1, "direction")
    assert changed is not None
    assert (changed.old, changed.new) == (0.0, 0.5)
    assert isinstance(changed.state.what, Told)
    assert "input Act(ship=1, action=Turn(angle=0.5))" in str(changed)
    flight = last_change(timeline, 1, "flight")
    assert flight is not None
    assert flight.state.place.time == 4.0


def test_what_never_changed_has_no_last_change() -> None:
    timeline = bouncing()
    for field in ("radius", "mass", "name", "thruster", "path", "program"):
        assert last_change(timeline, 1, field) is None
    for field in FIELDS:
        assert last_change(timeline, 2, field) is None


def test_to_be_born_and_to_die_are_changes_of_every_field() -> None:
    timeline = fought()
    death = next_state(timeline, 0.0, "death")
    assert death is not None
    bullet = death.died[-1]
    dies = last_change(timeline, bullet, "vx")
    assert dies is not None
    assert (dies.state, dies.new) == (death, ABSENT)
    born = last_change(timeline, bullet, "vx", before=death.place)
    assert born is not None
    assert (born.old, bullet in born.state.born) == (ABSENT, True)
    assert last_change(timeline, bullet, "vx", before=born.state.place) is None


def test_a_bent_flight_begins_anew_where_the_thruster_changes() -> None:
    world = world_of(ship(300.0, 500.0, direction=pi / 2), model="smooth")
    timeline = begin(world).evolve(1.0)
    assert last_change(timeline, 1, "path") is None
    on = begin(world_of(ship(300.0, 100.0, direction=pi / 2, thruster=True), model="smooth"))
    on = on.evolve(1.0).act(1, ThrustOff()).evolve(0.5)
    changed = last_change(on, 1, "path")
    assert changed is not None
    assert changed.new is None
    speed = last_change(on, 1, "vy")
    assert speed is not None
    assert (speed.old, speed.new) == (0.0, 256.0)
    assert speed.state.place.time == 1.0


def test_a_variable_changes_at_the_tick_that_left_another_value() -> None:
    text = (
        "double n; bool b; while (true) { n := n + 1; skip; n := n * 1; skip; b := n > 2; skip; }"
    )
    timeline = begin(world_of(ship(500.0, 500.0, program=machine(text)))).evolve(1.5)
    changed = last_change(timeline, 1, "program.n", before=1.3)
    assert changed is not None
    assert (changed.old, changed.new) == (1.0, 2.0)
    assert changed.state.place.time == pytest.approx(0.8)
    earlier = last_change(timeline, 1, "program.n", before=changed.state.place)
    assert earlier is not None
    assert earlier.state.place.time == pytest.approx(0.2)
    assert last_change(timeline, 1, "program.b") is None
    assert last_change(timeline, 1, "program.nobody") is None
    whole = last_change(timeline, 1, "program")
    assert whole is not None
    assert whole.state.place.time == pytest.approx(1.4)


def test_that_an_entity_is_seen_anew_is_no_change_of_the_variable() -> None:
    text = "entity e; foreach (asteroid, e) { } while (true) { skip; }"
    world = world_of(ship(500.0, 500.0, program=machine(text)), rock(100.0, 100.0, 10.0))
    timeline = begin(world).evolve(1.1)
    changed = last_change(timeline, 1, "program.e")
    assert changed is not None
    assert changed.state.place.time == pytest.approx(0.2)
    assert changed.old is None


def test_a_kick_changes_a_velocity_under_literal_thrust_wherever_time_was_cut() -> None:
    world = world_of(ship(100.0, 500.0, thruster=True), rock(900.0, 100.0, 0.0, 50.0))
    timeline = begin(world).evolve(0.25).evolve(0.5)
    last = last_change(timeline, 1, "vx")
    assert last is not None
    assert (last.old, last.new) == (64.0, 192.0)
    first = last_change(timeline, 1, "vx", before=last.state.place)
    assert first is not None
    assert (first.old, first.new, first.state.place.time) == (0.0, 64.0, 0.25)


@pytest.mark.parametrize("model", ["smooth", "robust"])
@pytest.mark.parametrize("budget", [2**28, 0])
def test_the_changes_are_those_one_finds_by_looking_at_every_state(model: str, budget: int) -> None:
    timeline = fought(model, budget=budget)
    past = states(timeline)
    for entity in (1, 2, 3, 8):
        for field in ("vx", "direction", "thruster", "bounced", "program.n"):
            slow: list[Lived] = []
            for before, after in pairwise(past):
                a, b = (value_of(s.world, entity, field) for s in (before, after))
                if a != b:
                    slow.append(after)
            found = []
            changed = last_change(timeline, entity, field)
            while changed is not None:
                found.append(changed.state.place)
                changed = last_change(timeline, entity, field, before=changed.state.place)
            assert found == [s.place for s in reversed(slow)]


def test_a_change_before_a_branch_is_found_from_the_branch() -> None:
    timeline = bouncing()
    branch = timeline.branch(5.0).evolve(0.5)
    changed = last_change(branch, 1, "vx")
    assert changed is not None
    assert changed.state.place.time == 4.0
    assert last_change(branch, 1, "direction") is None


def test_the_value_on_record_is_that_of_the_flight() -> None:
    world = bouncing().world
    assert value_of(world, 1, "x") == 990.0
    assert world[1].x == 590.0
    assert value_of(world, 2, "direction") is ABSENT
    assert value_of(world, 1, "program.n") is ABSENT
    assert value_of(world, 99, "x") is ABSENT


@pytest.mark.parametrize("field", ["velocitty", "", "program.", "__class__", "turn"])
def test_a_field_that_is_none_is_refused(field: str) -> None:
    with pytest.raises(ModelError, match="a field is one of x, y"):
        last_change(bouncing(), 1, field)


def test_an_entity_that_never_was_is_refused() -> None:
    with pytest.raises(ModelError, match="ids in this past go from 1 to 2"):
        last_change(bouncing(), 3, "x")


def test_the_past_of_the_tests_has_all_kinds_of_changes() -> None:
    assert any(is_of(s, "wall", 1) for s in states(fought()))
    assert any(isinstance(s.what, Happened) and s.what.effect == "turn" for s in states(fought()))
