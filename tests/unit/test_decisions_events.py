"""DESIGN section 5, tests named after its rows: which events there are, in which order, and ticks."""

from __future__ import annotations

from fractions import Fraction
from math import nextafter
from typing import Any

import pytest
from attrs import frozen

from fasteroids import (
    Fire,
    Happened,
    Ship,
    Skip,
    Thrust,
    ThrustOff,
    Turn,
    World,
    bounce,
    evolve,
    evolve_until,
    happenings,
)
from fasteroids.actions import Ticked
from tests.unit.making import STRONG, Script, rock, run, ship, shot, staged, told, world_of

# overlapping and approaching


def overlapping(v: float) -> World:
    """Two ships that overlap by the last place, the left one flying at v."""
    return world_of(ship(100.1, 500, v, 0), ship(nextafter(120.1, 0.0), 500))


def test_overlapping_and_approaching_collides_now() -> None:
    world = overlapping(10.0)
    log, after = run(world, 0.0)
    assert told(log) == [(0.0, "contact", (1, 2), None, "bounce")]
    assert [after[i].velocity for i in (1, 2)] == [(0.0, 0.0), (10.0, 0.0)]
    assert [after[i].position for i in (1, 2)] == [world[i].position for i in (1, 2)]


def test_overlapping_and_receding_is_no_event() -> None:
    assert run(overlapping(-10.0), 5.0)[0] == []
    assert run(overlapping(0.0), 5.0)[0] == []


def test_overlapping_scheduled_times_are_never_in_the_past() -> None:
    world = evolve(World(1000, 1000), 7.0).add_all(
        [ship(100.1, 500, 10, 0), ship(nextafter(120.1, 0.0), 500)]
    )
    assert [h.time for h in run(world, 7.5)[0]] == [7.0]


def test_overlapping_no_entity_is_moved_but_onto_its_wall() -> None:
    world = world_of(rock(nextafter(20.0, 0.0), 0.1 + 30, -7, 3))
    (happened, after), *_ = happenings(world, 0.0)
    assert happened.wall == "left"
    assert after[1].position == (20.0, 30.1)
    assert after[1].velocity == (7.0, 3.0)


# just bounced


def test_just_bounced_is_skipped_iff_each_names_the_other() -> None:
    world = overlapping(10.0)
    assert run(staged(world, _1=2, _2=1), 1.0)[0] == []
    for partly in (staged(world, _1=2), staged(world, _2=1), staged(world, _1=2, _2=3)):
        assert told(run(partly, 0.0)[0]) == [(0.0, "contact", (1, 2), None, "bounce")]


def test_just_bounced_a_bounce_sets_both() -> None:
    after = evolve(world_of(ship(100, 500, 10, 0), ship(140, 500)), 2.0)
    assert [after.flight_of(i).bounced_off for i in (1, 2)] == [2, 1]
    assert [after.flight_of(i).since for i in (1, 2)] == [(0, 2.0), (0, 2.0)]


def test_just_bounced_a_wall_clears_its_own_and_they_may_meet_again() -> None:
    """Between the left wall and a heavy ship, a light one bounces off both in turn."""
    world = world_of(ship(20, 500, mass=1.0), ship(60, 500, -16, 0, mass=15.0))
    log, _ = run(world, 3.0)
    assert [h.wall or h.kind for h in log][:3] == ["contact", "left", "contact"]
    pairs = [
        (w.flight_of(1).bounced_off, w.flight_of(2).bounced_off) for _, w in happenings(world, 3.0)
    ]
    assert pairs[:3] == [(2, 1), (0, 1), (2, 1)]


def test_just_bounced_every_event_gives_new_flights_to_those_it_moves() -> None:
    world = world_of(ship(100, 500, 10, 0), ship(140, 500), rock(800, 800, 5, 5))
    after = evolve(world, 2.0)
    assert all(after.flight_of(i) is not world.flight_of(i) for i in (1, 2))
    assert after.flight_of(3) is world.flight_of(3)


def test_just_bounced_a_ship_leaves_the_flight_of_an_asteroid_alone() -> None:
    world = world_of(ship(100, 500, 10, 0), rock(150, 500, -3, 1))
    after = evolve(world, 3.0)
    assert list(after.entities) == [2]
    assert after.flight_of(2) is world.flight_of(2)


# impulse


def test_impulse_of_the_largest_masses_does_not_overflow() -> None:
    a, b = bounce(ship(100, 500, 10, 3, mass=1.7e308), ship(120, 500, -10, 4, mass=1.7e308))
    assert (a.velocity, b.velocity) == ((-10.0, 3.0), (10.0, 4.0))


def test_impulse_keeps_the_energy_whatever_the_gap() -> None:
    """The text divides by sigma^2; a gap of half sigma would then cost or make energy."""
    for gap in (0.0, 10.0, -5.0):
        a, b = (
            ship(100, 500, 30, 40),
            ship(116 + 0.8 * gap, 512 + 0.6 * gap, -20, -5, mass=STRONG / 4),
        )
        c, d = bounce(a, b)
        before, after = (
            sum(
                (Fraction(e.mass) * (Fraction(e.vx) ** 2 + Fraction(e.vy) ** 2) for e in pair),
                Fraction(0),
            )
            for pair in ((a, b), (c, d))
        )
        assert c != a
        assert abs(after / before - 1) <= 16 * Fraction(1, 2**53)


# ties


def test_ties_are_ordered_by_ids() -> None:
    world = world_of(rock(900, 100, 80, 0), rock(900, 300, 80, 0), rock(900, 500, 80, 0))
    assert told(run(world, 1.0)[0]) == [
        (1.0, "wall", (1,), "right", "bounce"),
        (1.0, "wall", (2,), "right", "bounce"),
        (1.0, "wall", (3,), "right", "bounce"),
    ]


def test_ties_are_ordered_by_kind_then_ids() -> None:
    """At 1 s: top, bottom, right, left for 1 to 4, ticks of 5 and 6, and a contact of 7 and 8."""
    world = world_of(
        rock(500, 972, 0, 8),
        rock(500, 28, 0, -8),
        rock(972, 500, 8, 0),
        rock(28, 500, -8, 0),
        ship(300, 300, program=Script((None,) * 4 + (Skip(),))),
        ship(300, 700, program=Script((None,) * 4 + (Skip(),))),
        rock(700, 700, 8, 0),
        rock(748, 700),
    )
    log = [h for h in run(world, 1.0)[0] if h.time == 1.0]
    assert [(h.wall or h.kind, h.entities) for h in log] == [
        ("contact", (7, 8)),
        ("left", (4,)),
        ("right", (3,)),
        ("bottom", (2,)),
        ("top", (1,)),
        ("tick", (5,)),
        ("tick", (6,)),
    ]


def test_ties_three_in_a_row() -> None:
    """At 1 s both outer ones reach the middle one; the pair of lower ids goes first, and again in the end."""
    world = world_of(rock(400, 500, 60, 0), rock(500, 500), rock(600, 500, -60, 0))
    log, after = run(world, 1.0)
    assert told(log) == [
        (1.0, "contact", (1, 2), None, "bounce"),
        (1.0, "contact", (2, 3), None, "bounce"),
        (1.0, "contact", (1, 2), None, "bounce"),
    ]
    assert [after[i].vx for i in (1, 2, 3)] == [-60.0, 0.0, 60.0]


def test_ties_two_walls_of_one_entity_are_two_events() -> None:
    log, after = run(world_of(rock(28, 972, -8, 8)), 1.0)
    assert told(log) == [
        (1.0, "wall", (1,), "left", "bounce"),
        (1.0, "wall", (1,), "top", "bounce"),
    ]
    assert after[1].velocity == (8.0, -8.0)


def test_ties_a_bullet_in_an_exact_corner_meets_two_walls_and_dies() -> None:
    log, after = run(world_of(shot(11, 989, -8, 8)), 1.0)
    assert told(log) == [
        (1.0, "wall", (1,), "left", "bounce"),
        (1.0, "wall", (1,), "top", "die"),
    ]
    assert len(after) == 0


def test_ties_do_not_depend_on_how_the_world_was_filled() -> None:
    discs = [rock(400, 500, 60, 0, id=7), rock(500, 500, id=8), rock(600, 500, -60, 0, id=9)]
    one = world_of(*discs)
    two = world_of(*(rock(100, 100 + 100 * i) for i in range(3)))
    two = two.remove(1).remove(2).remove(3).add_all(discs)
    assert [one.slot_of(i) for i in (7, 8, 9)] != [two.slot_of(i) for i in (7, 8, 9)]
    assert len(run(one, 3.0)[0]) >= 3
    assert run(one, 3.0) == run(two, 3.0)


# contact at exactly t + dt


def test_contact_at_exactly_t_plus_dt_belongs_to_the_step() -> None:
    world = world_of(ship(100, 500, 10, 0), ship(140, 500))
    assert evolve(world, 2.0)[2].velocity == (10.0, 0.0)
    assert evolve(world, nextafter(2.0, 0.0))[2].velocity == (0.0, 0.0)
    assert [h.time for h in run(world, 2.0)[0]] == [2.0]
    assert run(evolve(world, 2.0), 3.0)[0] == []


def test_contact_at_exactly_t_plus_dt_at_nought_is_due_now() -> None:
    world = world_of(ship(100, 500, 10, 0), ship(120, 500))
    assert evolve(world, 0.0)[2].velocity == (10.0, 0.0)


# ticks


@frozen
class Diary:
    """A program that never ends and prints what it sees."""

    @property
    def running(self) -> bool:
        return True

    def tick(self, view: Any) -> Ticked:
        me = view.entity(view.self_id)
        return Ticked(self, Skip(), prints=(f"{view.self_id} at {me.x:g} of {view.ids('any')}",))


@frozen
class Stops:
    """A program that halts at its first tick."""

    @property
    def running(self) -> bool:
        return True

    def tick(self, _view: Any) -> Ticked:
        return Ticked(Script(()), None, "halt", ("so far",), (1, 2), "it divided by a ship")


def runs(world: World, entity_id: int = 1) -> int:
    """How often a `Script` of a ship has run."""
    e = world[entity_id]
    assert isinstance(e, Ship)
    assert isinstance(e.program, Script)
    return 100 - len(e.program.steps)


LONG = Script((Skip(),) * 100)


@pytest.mark.parametrize(
    ("steps", "dt", "count"), [(10, 0.1, 5), (20, 0.03, 3), (1, 1.0, 5), (1, 0.2, 1)]
)
def test_ticks_come_five_times_a_second_however_the_time_is_cut(
    steps: int, dt: float, count: int
) -> None:
    world = world_of(ship(500, 500, program=LONG))
    for _ in range(steps):
        world = evolve(world, dt)
    assert runs(world) == count


def test_ticks_the_first_of_a_new_world_is_at_a_fifth() -> None:
    log, _ = run(world_of(ship(500, 500, program=Diary())), 1.0)
    assert [h.time for h in log] == [1 / 5, 2 / 5, 3 / 5, 4 / 5, 1.0]
    assert all((h.kind, h.effect, h.entities) == ("tick", "skip", (1,)) for h in log)


def test_ticks_happen_at_the_double_k_over_five_for_ever() -> None:
    world = evolve_until(World(1000, 1000), 1e9).add(ship(500, 500, program=Diary()))
    log, _ = run(world, 1e9 + 2)
    assert [h.time for h in log] == [(5 * 10**9 + k) / 5 for k in range(1, 11)]


def test_ticks_a_ship_added_late_begins_at_the_next_fifth_after() -> None:
    for start, first in ((0.1, 0.2), (0.2, 0.4), (0.30000000000000004, 0.4), (0.6, 0.8)):
        world = evolve_until(World(1000, 1000), start).add(ship(500, 500, program=Diary()))
        assert run(world, 1.0)[0][0].time == first


def test_ticks_of_ships_come_in_id_order() -> None:
    world = world_of(
        ship(100, 500, program=Diary(), id=3),
        ship(300, 500, program=Diary()),
        ship(500, 500, program=Diary()),
    )
    log, _ = run(world, 0.4)
    assert [(h.time, h.entities) for h in log] == [
        (0.2, (3,)), (0.2, (4,)), (0.2, (5,)), (0.4, (3,)), (0.4, (4,)), (0.4, (5,)),
    ]  # fmt: skip


def test_ticks_a_ship_without_a_running_program_has_none() -> None:
    assert run(world_of(ship(500, 500), ship(100, 100, program=Script(()))), 5.0)[0] == []


def test_ticks_end_with_the_program() -> None:
    log, after = run(world_of(ship(500, 500, program=Script((Skip(), Turn(1.0))))), 3.0)
    assert [(h.time, h.effect) for h in log] == [(0.2, "skip"), (0.4, "turn")]
    assert after.flight_of(1).next_tick is None
    assert after.ships[0].direction == 1.0


def test_ticks_a_dead_ship_does_not_run() -> None:
    """At 0.2 s, exactly, 1 reaches the rock (contacts come before ticks)."""
    world = world_of(
        ship(100, 500, 160, 0, program=Diary()), rock(162, 500), ship(800, 800, program=Diary())
    )
    log, _ = run(world, 0.2)
    assert [(h.kind, h.entities) for h in log if h.time == 0.2] == [
        ("contact", (1, 2)),
        ("tick", (3,)),
    ]


def test_ticks_a_ship_shot_by_a_tick_before_its_own_does_not_run() -> None:
    world = world_of(ship(100, 500, program=Script((Fire(),))), ship(124, 500, program=Diary()))
    log, after = run(world, 0.2)
    assert [(h.kind, h.entities, h.died) for h in log] == [("tick", (1,), (2, 3))]
    assert list(after.entities) == [1]


def test_ticks_say_what_the_program_did() -> None:
    script = Script((Turn(0.5), Thrust(), ThrustOff(), Fire(), Skip(), None))
    log, after = run(world_of(ship(100, 500, program=script, mass=1e30)), 1.2)
    assert [h.effect for h in log] == ["turn", "thrust", "thrust_off", "fire", "skip", "fuel"]
    assert [h.born for h in log] == [(), (), (), (2,), (), ()]
    assert after.ships[0].direction == 0.5
    assert after.ships[0].thruster is False


def test_ticks_carry_prints_and_why_a_program_halted() -> None:
    log, after = run(
        world_of(ship(100, 500, 10, 0, program=Diary()), ship(500, 500, program=Stops())), 0.5
    )
    assert log[0].prints == ("1 at 102 of (1, 2)",)
    assert log[1] == Happened(
        0.2,
        "tick",
        (2,),
        effect="halt",
        prints=("so far",),
        span=(1, 2),
        reason="it divided by a ship",
    )
    assert [h.entities for h in log] == [(1,), (2,), (1,)]
    assert after.flight_of(2).next_tick is None


def test_ticks_are_cuts_for_thrusters() -> None:
    world = world_of(ship(100, 500, 8, 0, thruster=True), ship(500, 100, program=Diary()))
    after = evolve(world, 0.25)
    first = 8 + 256 * 0.2
    assert after[1].x == 100 + 8 * 0.2 + first * 0.04999999999999999
    assert after[1].vx == first + 256 * 0.04999999999999999


def test_ticks_leave_a_flight_where_it_began() -> None:
    world = world_of(ship(100, 500, 10, 0, program=LONG))
    after = evolve(world, 1.0)
    assert after.flight_of(1).since == (0, 0.0)
    assert after.flight_of(1).next_tick == 6
