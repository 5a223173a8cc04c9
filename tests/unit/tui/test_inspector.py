"""The pane of an entity, and why somebody died: what a person reads, and where it leads."""

from __future__ import annotations

from math import inf

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Fire, ModelError, Ship, evolve_until, happenings
from fasteroids.entities import Entity
from fasteroids.history import Place, Timeline, begin, first_difference, why
from fasteroids.history.questions import past_all_at
from fasteroids.lang.report import cells
from fasteroids.tui.chronicle import Chronicle, chronicle_of
from fasteroids.tui.inspector import ahead, entity_rows
from fasteroids.tui.rows import Row, Style
from fasteroids.tui.verdicts import death_of, death_rows, difference_rows
from tests.unit.history.pasts import fought, states
from tests.unit.making import machine, rock, ship, world_of


@pytest.fixture(scope="module")
def past() -> Timeline:
    return fought("smooth")


@pytest.fixture(scope="module")
def account(past: Timeline) -> Chronicle:
    return chronicle_of(past)


def seen(
    timeline: Timeline, entity: int, at: float, width: int = 78, height: int = 24
) -> tuple[Row, ...]:
    place = timeline.state(past_all_at(at)).place
    return entity_rows(chronicle_of(timeline), timeline.at(at), place, entity, width, height)


def text(rows: tuple[Row, ...]) -> str:
    return "\n".join(row.text.rstrip() for row in rows)


def struck() -> Timeline:
    """A ship that turns at 0.4 s and is met by a rock, which bounced off another one at 1 s, at 6.2 s."""
    world = world_of(
        ship(500.0, 500.0, program=machine("skip; turn 1.0; fire;"), name="red"),
        rock(740.0, 500.0, 50.0),
        rock(880.0, 500.0, -50.0),
    )
    return begin(world).evolve(7.0)


def test_the_pane_of_a_ship() -> None:
    timeline = struck()
    assert (
        text(seen(timeline, 1, 2.0)).rstrip("\n")
        == """\
ship #1 red  at 2.000 s
position  500, 500 km
velocity  0, 0 km/s
speed     0 km/s
radius    10 km
mass      4.29688e+15 kg
faces     57.2958 deg  thruster off
bullets   2 of 3 left
flight    since 0.000 s, straight
          the past begins
next      asteroid #2 in 4.200 s, at 6.200 s
          no wall
velocity  never changed
direction 0.400 s: program: turn (line 1)
thruster  never changed
      0.200 s  program: skip (line 1)
      0.400 s  program: turn (line 1)
      0.600 s  program: fire (line 1)
>     2.000 s  here
      6.200 s  died in a contact with asteroid #2"""
    )


def test_the_pane_of_a_rock_tells_whom_it_bounced_off() -> None:
    pane = text(seen(struck(), 2, 2.0))
    assert "flight    since 1.000 s, straight" in pane
    assert "bounced off asteroid #3" in pane
    assert "velocity  1.000 s: bounced off asteroid #3" in pane


def test_rows_of_moments_lead_there() -> None:
    rows = seen(struck(), 1, 2.0)
    leads = {row.text.strip().split("  ")[0]: row.place for row in rows if row.place is not None}
    assert leads["0.400 s"] == leads["direction 0.400 s: program: turn (line 1)"]
    assert sorted({place.time for place in leads.values()}) == pytest.approx([0.2, 0.4, 0.6, 6.2])


def test_of_the_dead_the_unborn_and_the_unknown_it_says_so() -> None:
    timeline = struck()
    assert "not there any more since 6.200 s" in text(seen(timeline, 1, 6.5))
    assert "not there before 0.600 s" in text(seen(timeline, 4, 0.3))
    assert "there is no #77 in this past" in text(seen(timeline, 77, 0.3))


@given(
    st.integers(1, 30), st.floats(0.0, 12.0), st.integers(0, 100), st.integers(0, 40)
)  # fmt: skip
def test_the_pane_has_exactly_its_size(
    past: Timeline, account: Chronicle, entity: int, at: float, width: int, height: int
) -> None:
    place = past.state(past_all_at(at)).place
    rows = entity_rows(account, past.at(at), place, entity, width, height)
    assert len(rows) == height
    assert all(cells(row.text) == width for row in rows)
    for row in rows:
        ends = [0]
        for start, end, style in row.runs:
            assert ends[-1] <= start < end <= len(row.text)
            assert Style(style)
            ends.append(end)


# What is next.


def test_what_is_predicted_happens_if_nobody_interferes(past: Timeline) -> None:
    """Every prediction of a world without programs is right up to the first thing that happens in it."""
    checked = 0
    for state in states(past)[::6]:
        world = world_of(*map(bare, state.world.entities.values()), model="smooth")
        first = next(happenings(world, 100.0, max_events=1), None)
        if first is None:
            continue
        happened = first[0]
        for entity in happened.entities:
            found = ahead(world, entity)
            if happened.kind == "contact":
                (other,) = (i for i in happened.entities if i != entity)
                assert found.other == other
                assert found.contact == pytest.approx(happened.time)
            elif happened.kind == "wall":
                assert happened.wall in found.walls
                assert found.wall == pytest.approx(happened.time)
                assert found.contact == inf or found.contact >= found.wall
            checked += 1
    assert checked > 20


def bare(e: Entity) -> Entity:
    """Without an id and a program."""
    return evolve(e, id=None, program=None) if isinstance(e, Ship) else evolve(e, id=None)


def test_a_contact_behind_a_wall_of_the_other_is_none() -> None:
    world = world_of(rock(100.0, 100.0), rock(930.0, 100.0, 50.0), rock(500.0, 500.0, 10.0))
    assert ahead(world, 1) == (inf, None, inf, ())
    again = evolve_until(world, 2.0)
    assert ahead(again, 1).other == 2


def test_two_that_have_just_bounced_are_not_said_to_meet() -> None:
    world = world_of(rock(100.0, 100.0, 30.0), rock(200.0, 100.0, -30.0))
    bounced = evolve_until(world, 1.0)
    assert bounced.flight_of(1).bounced_off == 2
    assert ahead(bounced, 1).other is None
    assert ahead(bounced, 1).walls == ("left",)


# Deaths.


def test_why_a_ship_died() -> None:
    told = death_of(struck(), 1)
    assert (
        text(death_rows(told, 76))
        == """\
ship 'red' died at 6.200 s in a contact with asteroid #2.
From 1.000 s on it was inevitable: neither flight changed in the last
  5.200 s.
ship 'red' flew so from the beginning of the past on.
asteroid #2 flew so since 1.000 s: bounced off asteroid #3.
The last deed of ship 'red': fire at 0.600 s, line 1 of its program."""
    )
    assert told.inevitable.time == 1.0
    (mine, other) = told.paths
    assert mine.points == ((500.0, 500.0),)
    assert [x for x, _ in other.points] == pytest.approx([790.0, 530.0])


def test_both_ways_end_where_the_two_touch(past: Timeline) -> None:
    dead = [i for s in states(past) for i in s.died]
    assert len(dead) > 4
    for entity in dead:
        told = death_of(past, entity)
        assert told.death == why(past, entity)
        assert [way.id for way in told.paths] == [entity, *told.death.partners]
        ends = [way.points[-1] for way in told.paths]
        if told.death.how == "contact":
            a, b = (course.entity for course in told.death.courses)
            assert ends == [(a.x, a.y), (b.x, b.y)]
            apart = ((a.x - b.x) ** 2 + (a.y - b.y) ** 2) ** 0.5
            assert apart == pytest.approx(a.radius + b.radius)
        rows = death_rows(told, 50)
        assert rows[0].place == told.death.place
        assert told.inevitable in [row.place for row in rows]
        assert all(cells(row.text) == 50 for row in rows)


def test_a_bent_way_is_drawn_bent() -> None:
    flyer = ship(200.0, 500.0, 0.0, 60.0, thruster=True, name="red")
    world = world_of(flyer, rock(460.0, 590.0), model="smooth")
    told = death_of(begin(world).evolve(5.0), 1)
    (way, still) = told.paths
    assert len(way.points) > 10
    assert still.points == ((460.0, 590.0),)
    x, y = way.points[len(way.points) // 2]
    (x0, y0), (x1, y1) = way.points[0], way.points[-1]
    off = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
    assert abs(off) > 100.0  # twice the area between the way and the straight line


def test_a_bullet_that_dies_as_it_is_fired() -> None:
    world = world_of(ship(100.0, 100.0), rock(133.0, 100.0))
    timeline = begin(world).evolve(1.0).act(1, Fire()).evolve(1.0)
    told = death_of(timeline, 2)
    assert "of a shot" in text(death_rows(told, 200))
    assert [len(way.points) for way in told.paths] == [1, 1]


def test_who_lives_has_no_death() -> None:
    with pytest.raises(ModelError, match="is alive"):
        death_of(struck(), 2)


# Differences.


def test_where_two_lines_part() -> None:
    timeline = struck().branch(2.0, "new").act(1, Fire()).evolve(5.0)
    parted = first_difference(timeline, "main", "new")
    rows = difference_rows(parted, 70, 6)
    assert (
        text(rows).rstrip("\n")
        == """\
They part at 2.000 s.
old: 2.911 s bullet #4: bounced off the top wall
new: 2.000 s ship 'red': by hand: fire"""
    )
    assert rows[2].place == Place(0, 2.0, 1)


def test_lines_that_do_the_same() -> None:
    timeline = struck().branch(2.0, "new").evolve(5.0)
    rows = difference_rows(first_difference(timeline, "main", "new"), 60, 3)
    assert rows[0].text.strip() == "Both do the same, as far as both have come."
