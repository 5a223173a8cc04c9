"""What differs between two worlds, and where two lines of a timeline part."""

from __future__ import annotations

from itertools import pairwise

import pytest
from attrs import evolve as with_

from fasteroids import Fire, ModelError, Turn, World, act, evolve
from fasteroids.history import (
    ABSENT,
    Difference,
    Timeline,
    begin,
    diff,
    first_difference,
    outwardly,
)
from fasteroids.history.living import Told
from fasteroids.state import instructed
from tests.unit.history.pasts import PILOT, arena, fought, states
from tests.unit.making import machine, rock, ship, staged, world_of


def fields(a: World, b: World) -> list[tuple[int | None, str]]:
    return [(d.entity, d.field) for d in diff(a, b)]


def test_equal_worlds_do_not_differ() -> None:
    assert diff(arena(), arena()) == ()
    past = fought()
    assert diff(past.world, fought(budget=0).world) == ()


@pytest.mark.parametrize("model", ["smooth", "robust"])
def test_worlds_differ_if_and_only_if_they_are_not_equal(model: str) -> None:
    worlds = [s.world for s in states(fought(model))]
    for a, b in pairwise(worlds):
        assert (diff(a, b) == ()) == (a == b)
        assert (diff(b, a) == ()) == (a == b)


def test_a_moved_entity_differs_where_it_is() -> None:
    world = world_of(ship(100.0, 500.0, 8.0), rock(500.0, 500.0))
    later = evolve(world, 1.0)
    assert diff(world, later) == (
        Difference(None, "time", 0.0, 1.0),
        Difference(1, "x", 100.0, 108.0),
    )
    assert [str(d) for d in diff(world, later)] == ["world time: 0.0 | 1.0", "#1 x: 100.0 | 108.0"]


def test_a_clock_whose_time_is_the_same_differs_by_its_residue() -> None:
    once, by_steps = evolve(World(9, 9), 1.0), World(9, 9)
    for _ in range(10):
        by_steps = evolve(by_steps, 0.1)
    assert once.time == by_steps.time
    assert fields(once, by_steps) == [(None, "clock")]


def test_fields_of_the_world() -> None:
    a, b = World(100, 200, 1, "robust", fuel=10), World(150, 250, 2, "smooth", fuel=20)
    assert fields(a, b) == [(None, f) for f in ("model", "width", "height", "seed", "fuel")]


def test_an_entity_that_only_one_has() -> None:
    a = world_of(rock(100.0, 100.0))
    b = a.add(rock(300.0, 300.0, name="new"))
    (only,) = diff(a, b)
    assert (only.entity, only.field, only.a, only.b) == (2, "entity", ABSENT, b[2])
    assert str(only).startswith("#2 only in the second: Asteroid(")
    assert str(diff(b, a)[0]).startswith("#2 only in the first: Asteroid(")


def test_what_nobody_sees_differs_too() -> None:
    a = world_of(rock(100.0, 100.0), rock(300.0, 300.0))
    assert fields(a, staged(a, _1=2)) == [(1, "bounced_off")]


def test_two_flights_that_come_to_one_place_differ() -> None:
    a = world_of(rock(100.0, 100.0, 16.0), rock(900.0, 900.0))
    later = evolve(a, 1.0)
    fresh = later.remove(1).add(with_(later[1], id=3))
    one, other = fresh.flight_of(3), later.flight_of(1)
    assert one.since != other.since
    assert (3, "entity") in fields(later, fresh)
    turned = act(world_of(ship(100.0, 100.0, 8.0)), 1, Turn(0.0))
    assert diff(turned, world_of(ship(100.0, 100.0, 8.0))) == ()


def test_programs_differ_by_variable_by_place_and_by_text() -> None:
    a = evolve(world_of(ship(100.0, 100.0, program=machine(PILOT))), 0.0)
    b = evolve(a, 0.2)
    assert fields(a, b) == [
        (None, "time"), (1, "thruster"), (1, "program.n"), (1, "program"),
        (1, "since"), (1, "next_tick"),
    ]  # fmt: skip
    places = next(d for d in diff(a, b) if d.field == "program")
    assert (places.a, places.b) == ("running at 3:8", "running at 7:3")
    c = instructed(a, 1, machine("skip;"))
    text = next(d for d in diff(a, c) if d.field == "program")
    assert (text.a, text.b) == (PILOT, "skip;")
    none = world_of(ship(100.0, 100.0))
    assert next(d for d in diff(none, c) if d.field == "program").a is None


# Lines.


def forked(at: float = 3.0) -> Timeline:
    """Two lines that are one up to a time: `main` and `2`."""
    return fought().branch(at)


def test_lines_that_are_the_same_do_not_part() -> None:
    timeline = forked().evolve(0.01)
    assert first_difference(timeline, "main", "main") is None
    same = begin(arena()).evolve(8.0)
    same = same.branch(2.0).evolve(1.5).evolve(1.5)
    assert first_difference(same, "main", "2") is None
    assert first_difference(same, "2", "main") is None


def test_lines_part_at_an_input() -> None:
    timeline = begin(arena()).evolve(8.0).branch(2.5).act(1, Fire()).evolve(2.0)
    parted = first_difference(timeline, "main", "2")
    assert parted is not None
    assert parted.time == 2.5
    assert parted.b is not None
    assert isinstance(parted.b.what, Told)
    assert parted.differences == ()
    assert (
        str(parted).splitlines()[1].startswith("second: at 2.5 s input Act(ship=1, action=Fire()")
    )
    mirrored = first_difference(timeline, "2", "main")
    assert mirrored is not None
    assert (mirrored.a, mirrored.b) == (parted.b, parted.a)


def test_lines_are_compared_as_far_as_both_have_come() -> None:
    timeline = begin(arena()).evolve(8.0).branch(2.5)
    assert first_difference(timeline, "main", "2") is None
    gone = timeline.evolve(1.0)
    assert first_difference(gone, "main", "2") is None
    taken = gone.switch("main").act(1, Fire())
    assert first_difference(taken, "main", "2") is None


def test_a_line_in_which_less_happens_parts_where_the_other_goes_on() -> None:
    world = world_of(rock(500.0, 100.0, 0.0, -40.0), rock(100.0, 800.0))
    timeline = begin(world).evolve(5.0).branch(1.0).remove(1).evolve(5.0)
    parted = first_difference(timeline, "main", "2", by=lambda s: _events_only(s))
    assert parted is not None
    assert (parted.time, parted.b) == (2.0, None)
    assert str(parted).endswith("second: nothing more")


def _events_only(state: object) -> object:
    what = getattr(state, "what", None)
    return (
        what if what is not None and not isinstance(what, Told) and hasattr(what, "kind") else None
    )


def test_an_edited_program_that_acts_the_same_differs_inwardly_only() -> None:
    chatty = machine(PILOT.replace("n := n + 1;", "n := n + 1; print 7;"))
    timeline = begin(arena()).evolve(6.0).branch(1.0).instruct(1, chatty).evolve(1.5)
    inward = first_difference(timeline, "main", "2")
    assert inward is not None
    assert inward.time == 1.0
    started_over = first_difference(timeline, "main", "2", by=outwardly)
    assert started_over is not None
    assert 1.0 < started_over.time <= 2.5


def test_an_edited_program_is_told_by_its_first_other_deed() -> None:
    a = "double n; while (true) { n := n + 1; if (n == 9) { turn 1.0; } skip; }"
    b = "double n; while (true) { n := n + 1; if (n == 4) { fire; } skip; }"
    world = world_of(ship(500.0, 500.0, program=machine(a)), rock(100.0, 100.0, 30.0, 40.0))
    timeline = begin(world).evolve(6.0).branch(0.0).instruct(1, machine(b)).evolve(6.0)
    parted = first_difference(timeline, "main", "2", by=outwardly)
    assert parted is not None
    assert parted.time == pytest.approx(0.8)
    assert parted.b is not None
    assert "fire" in str(parted.b.what)


def test_the_same_happening_that_comes_out_differently_is_told_by_field() -> None:
    """A rock was put in another's way, so that the same tick finds another world."""
    world = world_of(ship(500.0, 500.0, program=machine("while (true) { skip; }")))
    timeline = begin(world).evolve(2.0).branch(0.5).act(1, Turn(0.25)).evolve(1.0)
    parted = first_difference(
        timeline, "main", "2", by=lambda s: None if isinstance(s.what, Told) else outwardly(s)
    )
    assert parted is not None
    assert parted.time == pytest.approx(0.6)
    assert [(d.entity, d.field, d.a, d.b) for d in parted.differences] == [
        (1, "direction", 0.0, 0.25)
    ]
    assert str(parted).splitlines() == [
        "both: at 0.6 s t=0.6 tick #1, skip",
        "  #1 direction: 0.0 | 0.25",
    ]


def test_branches_of_branches_are_one_up_to_where_the_first_leaves() -> None:
    timeline = begin(arena()).evolve(8.0)
    timeline = timeline.branch(4.0, "a").evolve(1.0).act(1, Turn(0.3)).evolve(1.0)
    timeline = timeline.branch(4.5, "b").act(1, Turn(0.6)).evolve(1.0)
    parted = first_difference(timeline, "a", "b")
    assert parted is not None
    assert parted.time == 4.5
    parted = first_difference(timeline, "main", "b")
    assert parted is not None
    assert parted.time == 4.5


def test_a_line_that_is_none_is_refused() -> None:
    with pytest.raises(ModelError, match="there is no line 'c'"):
        first_difference(forked(), "main", "c")
