"""The look ahead: it says what will happen, and the world does not notice."""

from __future__ import annotations

from copy import copy
from itertools import pairwise
from math import atan2, inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import (
    Asteroid,
    Bullet,
    ModelError,
    Ship,
    World,
    check_program,
    evolve,
    evolve_until,
    parse_program,
    time_to_contact,
    time_to_wall,
)
from fasteroids.engine import peek
from fasteroids.events import unfold
from fasteroids.moments import advanced, between
from fasteroids.testing import worlds
from fasteroids.tui.overlay import overlay


def rock(x: float, y: float, vx: float = 0.0, vy: float = 0.0, r: float = 20.0) -> Asteroid:
    return Asteroid(x, y, vx, vy, r)


def ship(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: object) -> Ship:
    return Ship(x, y, vx, vy, 20.0, 5e15, 0.0, **fields)  # type: ignore[arg-type]


def ahead(world: World, seconds: float, most: int) -> World:
    """The world so much later, or after `most` events."""
    future = unfold(world, advanced(world.clock, seconds), most)
    while True:
        try:
            next(future)
        except StopIteration as stop:
            after: World = stop.value
            return after


@given(worlds(), st.floats(0.0, 2.0), st.integers(0, 12))
def test_a_line_ends_where_its_entity_will_be(world, seconds, most):
    seen = overlay(world, None, seconds, most)
    after = ahead(world, seconds, most)
    assert seen.seconds in (seconds, between(world.now, after.now))
    assert [line.id for line in seen.lines] == list(world.entities)
    for line in seen.lines:
        assert line.points[0] == world[line.id].position
        if line.id in after:
            assert line.points[-1] == after[line.id].position


@given(worlds(), st.integers(0, 12))
def test_who_looks_ahead_does_not_change_the_future(world, most):
    world = ahead(world, 0.0, most)
    engine, untouched = peek(world), copy(world)
    overlay(world, None, 1.0, most)
    assert engine is not None
    assert peek(world) is engine
    assert ahead(world, 1.0, most) == ahead(untouched, 1.0, most)


def test_the_next_wall_is_told_with_its_time_and_place():
    world = World(1000, 500).add(rock(500, 100, 100.0, 0.0))
    when, _ = time_to_wall(world[1], world)
    (mark,) = overlay(world, None, 20.0).marks
    assert (mark.seconds, mark.at, mark.ids, mark.wall) == (when, (1000.0, 100.0), (1,), "right")
    assert not mark.fatal


def test_the_next_contact_is_told_with_its_time_and_place():
    world = World(1000, 500).add_all([rock(300, 100, 100.0), rock(700, 100)])
    (mark, *_) = overlay(world, None, 4.0).marks
    assert mark.seconds == time_to_contact(world[1], world[2])
    assert (mark.at, mark.ids, mark.wall) == ((680.0, 100.0), (1, 2), None)


def test_a_line_bends_where_its_entity_bounces():
    world = World(1000, 500).add(rock(900, 100, 100.0, 50.0))
    (line,) = overlay(world, None, 2.0).lines
    assert line.points == ((900.0, 100.0), (980.0, 140.0), (860.0, 200.0))


def test_a_bent_path_is_shown_by_points_on_it():
    world = World(10_000, 5_000, model="smooth").add(ship(500, 2500, 0.0, 300.0, thruster=True))
    (line,) = overlay(world, None, 4.0).lines
    assert len(line.points) > 8
    step = 4.0 / (len(line.points) - 1)
    for i, (x, y) in enumerate(line.points):
        assert (x, y) == pytest.approx(evolve(world, i * step)[1].position)
    headings = [atan2(b[1] - a[1], b[0] - a[0]) for a, b in pairwise(line.points)]
    assert all(later < earlier for earlier, later in pairwise(headings))


def test_a_line_ends_where_its_entity_dies():
    world = World(1000, 500).add_all([ship(100, 100), Bullet(500, 100, -100.0, 0.0, 3.0, 7)])
    seen = overlay(world, None, 9.0)
    (mark,) = seen.marks
    assert mark.fatal
    assert mark.ids == (1, 2)
    assert [line.points[-1] for line in seen.lines] == [(100.0, 100.0), (123.0, 100.0)]


def test_only_those_asked_for_are_told_and_strangers_left_out():
    world = World(1000, 500).add_all([rock(300, 100, 100.0), rock(700, 100), rock(300, 300, 10.0)])
    seen = overlay(world, [1, 99], 5.0)
    assert [line.id for line in seen.lines] == [1]
    assert [mark.ids for mark in seen.marks] == [(1, 2)]


def test_only_the_next_meeting_of_each_is_told():
    world = World(300, 500).add_all([rock(150, 100, 100.0), rock(150, 300, 90.0)])
    assert [mark.ids for mark in overlay(world, None, 60.0).marks] == [(1,), (2,)]


def test_a_look_ahead_ends_after_so_many_events_and_says_so():
    world = World(300, 500).add(rock(150, 100, 100.0))
    seen = overlay(world, None, 60.0, most=3)
    assert seen.seconds == pytest.approx((130.0 + 2 * 260.0) / 100.0)
    assert len(seen.lines[0].points) == 5
    assert overlay(world, None, 60.0).seconds == 60.0


def test_ticks_of_programs_count_as_events_and_are_obeyed():
    tree = parse_program("turn 1.5707963267948966; thrust; skip;").program
    assert tree is not None
    world = World(1000, 900, model="smooth").add(
        ship(500, 100, program=check_program(tree).program)
    )
    (line,) = overlay(world, None, 2.0).lines
    assert line.points[-1][1] > 300.0
    assert all(b[1] >= a[1] for a, b in pairwise(line.points))


@pytest.mark.parametrize("seconds", [nan, inf, -1.0])
def test_a_time_that_makes_no_sense_is_refused(seconds):
    with pytest.raises(ModelError, match="how far to look ahead"):
        overlay(World(10, 10), None, seconds)


def test_at_the_end_of_time_nothing_is_ahead():
    world = evolve_until(World(100, 100).add(rock(50, 50)), 1.79769e308)
    seen = overlay(world, None, 1e308)
    assert seen.seconds == 0.0
    assert seen.lines[0].points[0] == (50.0, 50.0)
