"""The decisions on the assignment's open points: DESIGN section 5, a test or a few for each row, named after it.

The numbers are chosen so that every result is a double: powers of two, and thrusters of 256 km/s^2.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf, nextafter, pi, sqrt, ulp
from typing import Any

import pytest
from attrs import evolve as with_
from attrs import frozen

from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    Happened,
    ModelError,
    Ship,
    Skip,
    Thrust,
    ThrustOff,
    Turn,
    World,
    act,
    bounce,
    chance,
    evolve,
    evolve_until,
    happenings,
    models,
)
from fasteroids.actions import Action, Ticked
from fasteroids.entities import Entity
from fasteroids.state import Flight, replaced
from fasteroids.units import SPEED_OF_LIGHT, THRUST

STRONG = THRUST / 256
"""A mass (kg) that the thruster accelerates with 256 km/s^2."""


def ship(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Ship:
    """A ship of radius 10 that faces right, unless told otherwise."""
    given: dict[str, Any] = {"radius": 10.0, "mass": STRONG, "direction": 0.0}
    return Ship(x, y, vx, vy, **{**given, **fields})


def rock(
    x: float, y: float, vx: float = 0.0, vy: float = 0.0, r: float = 20.0, **f: Any
) -> Asteroid:
    return Asteroid(x, y, vx, vy, r, **f)


def shot(
    x: float, y: float, vx: float = 0.0, vy: float = 0.0, source: int = 99, **f: Any
) -> Bullet:
    return Bullet(x, y, vx, vy, 3.0, source, **f)


def world_of(*entities: Entity, width: float = 1000.0, height: float = 1000.0, **f: Any) -> World:
    return World(width, height, **f).add_all(entities)


def run(world: World, until: float, events: int = 1000) -> tuple[list[Happened], World]:
    """What happens up to `until`, and the world then."""
    log: list[Happened] = []
    unfold = happenings(world, until, max_events=events)
    while True:
        try:
            log.append(next(unfold)[0])
        except StopIteration as stop:
            assert len(log) < events
            return log, stop.value


def told(log: list[Happened]) -> list[tuple[Any, ...]]:
    """The bones of a log: time, kind, ids, wall, effect."""
    return [(h.time, h.kind, h.entities, h.wall, h.effect) for h in log]


def staged(world: World, **bounced_off: int) -> World:
    """The world with `bounced_off` set in some flights: staged(world, _1=2)."""
    changed = []
    for name, other in bounced_off.items():
        entity_id = int(name[1:])
        f = with_(world.flight_of(entity_id), bounced_off=other)
        changed.append((world.slot_of(entity_id), f))
    return replaced(world, world.clock, changed, (), ())


# thrust unit


def test_thrust_unit_newton_is_a_thousandth_of_ours() -> None:
    assert THRUST == 1.1e21 / 1000


def test_thrust_unit_a_ship_of_5e15_kg_gains_220_km_per_second_each_second() -> None:
    after = evolve(world_of(ship(500, 500, mass=5e15, thruster=True)), 1.0)
    assert abs(after[1].vx - 220.0) <= ulp(220.0)
    assert after[1].vy == 0.0


def test_thrust_unit_power_and_limit_are_those_of_the_ship() -> None:
    world = world_of(ship(500, 500, mass=4.0, thrust_power=32.0, thruster=True, max_speed=10.0))
    assert evolve(world, 1.0)[1].velocity == (8.0, 0.0)
    assert evolve(world, 2.0)[1].velocity == (10.0, 0.0)


# thrust rule


def test_thrust_rule_is_literal_by_default() -> None:
    assert models.named(World(10, 10).model).thrust == "literal"


# advance (literal)


def test_advance_literal_moves_with_the_old_velocity_then_accelerates() -> None:
    after = evolve(world_of(ship(100, 500, 8, 4, thruster=True)), 0.5)
    assert after[1].position == (104.0, 502.0)
    assert after[1].velocity == (136.0, 4.0)
    after = evolve(after, 0.25)
    assert after[1].position == (138.0, 503.0)
    assert after[1].velocity == (200.0, 4.0)


def test_advance_literal_without_thrust_moves_only() -> None:
    after = evolve(world_of(ship(100, 500, 8, 4), rock(700, 700, -8, 2)), 0.5)
    assert [e.position for e in after.entities.values()] == [(104.0, 502.0), (696.0, 701.0)]
    assert [e.velocity for e in after.entities.values()] == [(8.0, 4.0), (-8.0, 2.0)]


def test_advance_literal_kicks_at_every_cut_even_of_others() -> None:
    """A rock meets a wall at 0.25 s: the step of 0.5 s is two advances for the ship, too."""
    alone = world_of(ship(100, 500, 8, 0, thruster=True))
    beside = alone.add(rock(24, 800, -16, 0))
    log, after = run(beside, 0.5)
    assert told(log) == [(0.25, "wall", (2,), "left", "bounce")]
    assert evolve(alone, 0.5)[1].x == 104.0
    assert after[1].position == (100 + 2.0 + 72 * 0.25, 500.0)
    assert after[1].velocity == (136.0, 0.0)


def test_advance_literal_what_is_no_event_is_no_cut() -> None:
    """Stale predictions, crossings of cells and windows of time are no cuts."""
    crowd = [rock(50 + 100 * i, 950, 0, 0, 4) for i in range(8)]
    world = world_of(ship(100, 500, 8, 0, thruster=True), *crowd, rock(300, 800, 30, -10, 4))
    log, after = run(world, 2.0)
    assert log == []
    assert after[1].position == (116.0, 500.0)
    slow = world_of(ship(100, 500, 2.0**-6, 0, thruster=True, mass=STRONG * 2.0**30))
    assert evolve(slow, 2048.0)[1].x == 132.0


def test_advance_literal_kick_comes_before_its_event() -> None:
    """It reaches the wall at 1 s with 8 km/s, is kicked to 264, and only then turned round."""
    world = world_of(ship(982, 500, 8, 0, thruster=True))
    (happened, after), *_ = happenings(world, 1.0)
    assert (happened.time, happened.wall) == (1.0, "right")
    assert after[1].velocity == (-264.0, 0.0)
    assert after[1].x == 990.0


def test_advance_literal_an_event_at_the_end_is_kicked_once() -> None:
    after = evolve(world_of(ship(982, 500, 8, 0, thruster=True)), 1.0)
    assert after[1].velocity == (-264.0, 0.0)
    assert after[1].position == (990.0, 500.0)
    assert evolve(after, 0.0) == after


def test_advance_literal_of_no_length_changes_nothing() -> None:
    world = world_of(ship(100, 500, 8, 4, thruster=True), rock(500, 500))
    assert evolve(world, 0.0) == world
    later = evolve(world, 0.3)
    assert evolve(evolve(later, 0.0), 0) == later


def test_advance_literal_two_events_at_one_moment_kick_once() -> None:
    """A rock in a corner has two events at 0.25 s; the ship gains 0.25 s of thrust there, not 0.5 s."""
    world = world_of(ship(500, 100, 8, 0, thruster=True), rock(24, 976, -16, 16))
    log, after = run(world, 0.25)
    assert [h.wall for h in log] == ["left", "top"]
    assert after[1].velocity == (72.0, 0.0)
    assert after[1].x == 502.0


def test_advance_literal_kick_starts_a_flight_and_clears_bounced_off() -> None:
    world = staged(world_of(ship(100, 500, 8, 0, thruster=True), ship(500, 500)), _1=2, _2=1)
    after = evolve(world, 0.5)
    assert after.flight_of(1).since == (0, 0.5)
    assert after.flight_of(1).bounced_off == 0
    assert after.flight_of(2) is world.flight_of(2)


def test_advance_literal_switching_on_starts_a_flight() -> None:
    world = evolve(world_of(ship(100, 500, 8, 0)), 1.0)
    on = act(world, 1, Thrust())
    assert on.flight_of(1).since == (0, 1.0)
    assert on[1].position == (108.0, 500.0)
    after = evolve(on, 0.5)
    assert after[1].position == (112.0, 500.0)
    assert after[1].velocity == (136.0, 0.0)  # half a second of thrust, not one and a half


def test_advance_literal_switching_off_ends_it() -> None:
    world = evolve(world_of(ship(100, 500, 8, 0, thruster=True)), 0.5)
    after = evolve(act(world, 1, ThrustOff()), 1.0)
    assert after[1].position == (240.0, 500.0)
    assert after[1].velocity == (136.0, 0.0)


def test_advance_literal_turning_changes_the_thrust_from_the_next_cut() -> None:
    world = evolve(world_of(ship(100, 500, 8, 0, thruster=True)), 0.5)
    assert isinstance(world[1], Ship)
    after = evolve(act(world, 1, Turn(pi)), 0.5)
    assert after[1].x == 172.0
    assert after[1].vx == 8.0


def test_advance_literal_contact_that_no_longer_approaches_gives_no_impulse() -> None:
    """The ship flies left at 8 and faces right: at the contact at 1 s it is kicked to 248 and just leaves."""
    world = world_of(ship(528, 500, -8, 0, thruster=True), ship(500, 500))
    (happened, after), *_ = happenings(world, 1.0)
    assert told([happened]) == [(1.0, "contact", (1, 2), None, "bounce")]
    assert [after[i].velocity for i in (1, 2)] == [(248.0, 0.0), (0.0, 0.0)]
    assert [after[i].position for i in (1, 2)] == [(520.0, 500.0), (500.0, 500.0)]
    assert [after.flight_of(i).bounced_off for i in (1, 2)] == [2, 1]


def test_advance_literal_contact_that_no_longer_approaches_still_kills() -> None:
    log, after = run(world_of(ship(538, 500, -8, 0, thruster=True), rock(500, 500)), 1.0)
    assert told(log) == [(1.0, "contact", (1, 2), None, "die")]
    assert log[0].died == (1,)
    assert list(after.entities) == [2]


@pytest.mark.parametrize(
    ("thrusting", "wall", "after"),
    [
        (ship(18, 500, -8, 0, thruster=True), "left", (248.0, 0.0)),
        (ship(982, 500, 8, 0, thruster=True), "right", (-264.0, 0.0)),
    ],
)
def test_advance_literal_wall_sets_its_component_inwards(
    thrusting: Ship, wall: str, after: tuple[float, float]
) -> None:
    (happened, world), *_ = happenings(world_of(thrusting), 1.0)
    assert happened.wall == wall
    assert world[1].velocity == after


# c limit


def test_c_limit_keeps_the_direction_and_fits_as_computed() -> None:
    world = world_of(ship(500, 500, 3e5, 0, thruster=True, direction=pi / 2, mass=STRONG / 1024))
    after = evolve(world, 1e-9)[1]
    assert after.vx > 0.0
    assert sqrt(after.vx * after.vx + after.vy * after.vy) <= SPEED_OF_LIGHT
    turned = 256 * 1024 * 1e-9 / 3e5
    assert after.vy / after.vx == pytest.approx(turned, rel=8 * 2.0**-53, abs=0)


def test_c_limit_is_reported_as_clipped_by_thrust() -> None:
    world = world_of(ship(982, 500, 8, 0, thruster=True, max_speed=100.0), rock(500, 500))
    log, after = run(world, 1.0)
    assert [(h.wall, h.clipped) for h in log] == [("right", (1,))]
    assert after[1].velocity == (-100.0, 0.0)


def test_c_limit_is_reported_as_clipped_in_a_bounce() -> None:
    """A light ship is struck by a heavy one and would leave at nearly twice its speed."""
    heavy = ship(100, 500, 2e5, 0, mass=1e30)
    log, after = run(world_of(heavy, ship(500, 500, mass=1.0), width=1e6), 0.01)
    assert [(h.kind, h.clipped) for h in log] == [("contact", (2,))]
    assert after[2].velocity == (SPEED_OF_LIGHT, 0.0)
    assert after[1].velocity == (2e5, 0.0)


def test_c_limit_children_too() -> None:
    world = world_of(rock(500, 500, 2.5e5, 0, 40), shot(500.0, 457.0, 2.5e5, 250), width=1e7)
    (happened, after), *_ = happenings(world, 0.0)
    assert (happened.effect, happened.died, happened.clipped) == ("split", (1, 2), (3, 4))
    for child in after.asteroids:
        assert SPEED_OF_LIGHT - 8 * ulp(SPEED_OF_LIGHT) <= child.speed <= SPEED_OF_LIGHT


def test_c_limit_still_approaching_takes_the_partners_component_along_the_line() -> None:
    """1 leaves the bounce with (200, 100), is clipped to 189 km/s, hence to 169 along x, before 2 with 180."""
    slow = ship(520, 500, 160, 100, mass=1e-12, max_speed=189.0)
    fast = ship(500, 500, 180, 0, mass=1e12)
    (happened, after), *_ = happenings(world_of(slow, fast), 0.0)
    assert (happened.kind, happened.clipped) == ("contact", (1,))
    assert after[2].velocity == (180.0, 0.0)
    assert after[1].vx == 180.0
    room = sqrt(189.0**2 - 180.0**2)
    assert room - 16 * ulp(room) <= after[1].vy <= room
    assert after[1].speed <= 189.0


def test_c_limit_of_each_is_its_own() -> None:
    heavy = ship(480, 500, 200, 0, mass=1e30)
    light = ship(500, 500, mass=1.0, max_speed=300.0)
    (happened, after), *_ = happenings(world_of(heavy, light), 0.0)
    assert happened.clipped == (2,)
    assert (after[1].vx, after[2].vx) == (200.0, 300.0)


def test_c_limit_squeeze_against_a_wall_is_named() -> None:
    """A light ship between a wall and a heavy one can push it back only by hits faster than its limit allows.

    The gap closes below the resolution of the clock while a million hits are still to come: law L14 names the
    two, and the world of before is still there.
    """
    light = ship(10, 500, mass=1e10, max_speed=10.0, name="light")
    heavy = ship(200, 500, -100, 0, mass=5e15, name="heavy")
    world = world_of(light, heavy)
    with pytest.raises(
        ModelError, match=r"events at the moment 1\.7 s.*'(light|heavy)'.*no room to move"
    ):
        evolve(world, 4.0)
    assert evolve(world, 1.5).time == 1.5


def test_c_limit_squeeze_goes_on_while_the_clock_resolves_it() -> None:
    light = ship(10, 500, mass=1e15, max_speed=100.0)
    heavy = ship(200, 500, -100, 0, mass=5e15)
    world = world_of(light, heavy)
    assert any(happened.clipped for happened, _ in happenings(world, 4.0))
    after = evolve(world, 4.0)
    assert after[2].vx > 0.0  # it turned back in time


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


# births


def test_births_a_bullet_starts_next_to_its_ship_at_250_whatever_the_ship_does() -> None:
    world = act(world_of(ship(100, 500, 77, -5, radius=16.0)), 1, Fire())
    (bullet,) = world.bullets
    assert bullet == Bullet(119.0, 500.0, 250.0, 0.0, 3.0, 1, id=2)
    assert bullet.max_speed == SPEED_OF_LIGHT
    assert world[1] == ship(100, 500, 77, -5, radius=16.0, id=1)


def test_births_the_way_it_faces() -> None:
    (bullet,) = act(world_of(ship(500, 500, direction=pi / 2)), 1, Fire()).bullets
    assert bullet.y == 513.0
    assert bullet.vy == 250.0
    assert abs(bullet.x - 500.0) <= ulp(500.0)


def test_births_partly_outside_no_effect_and_no_id() -> None:
    world = world_of(ship(nextafter(984, inf) + 1e-9, 500))
    assert act(world, 1, Fire()) == world
    assert act(world, 1, Fire()).add(rock(100, 100)).asteroids[0].id == 2


def test_births_touching_the_wall_is_inside() -> None:
    assert len(act(world_of(ship(984, 500)), 1, Fire()).bullets) == 1


def test_births_at_most_three_bullets() -> None:
    world = world_of(ship(100, 500))
    for n in (1, 2, 3):
        world = act(world, 1, Fire())
        assert len(world.bullets) == n
        world = evolve(world, 0.125)
    assert act(world, 1, Fire()) == world
    assert act(world, 1, Fire()).add(rock(100, 100)).asteroids[0].id == 5
    world = world.remove(3)
    assert len(act(world, 1, Fire()).bullets) == 3


def test_births_bullets_of_others_do_not_count() -> None:
    world = world_of(ship(100, 500), *(shot(100 + 50 * i, 800, source=9) for i in range(5)))
    assert len(act(world, 1, Fire()).bullets) == 6


@pytest.mark.parametrize("v", [0.0, 300.0, -300.0])
def test_births_on_another_both_die_approaching_or_not(v: float) -> None:
    world = act(world_of(ship(100, 500), rock(130, 500, v, 0)), 1, Fire())
    assert list(world.entities) == [1]
    assert world.add(rock(500, 500)).asteroids[0].id == 4  # the bullet had 3


def test_births_on_another_is_one_event() -> None:
    world = world_of(ship(100, 500, program=Script((Fire(),))), rock(130, 500, 0, 0, 19))
    log, after = run(world, 0.2)
    assert told(log) == [(0.2, "tick", (1,), None, "fire")]
    assert (log[0].died, log[0].born) == ((2, 3), (3,))
    assert list(after.entities) == [1]


def test_births_on_a_large_asteroid_split_it() -> None:
    world = world_of(ship(100, 500, program=Script((Fire(),))), rock(150, 500, 0, 0, 38))
    log, after = run(world, 0.2)
    assert (log[0].died, log[0].born) == ((2, 3), (3, 4, 5))
    assert list(after.entities) == [1, 4, 5]


def test_births_on_two_kills_the_lower_id() -> None:
    world = world_of(ship(100, 500), rock(121, 519, 0, 0, 18), rock(121, 481, 0, 0, 18))
    assert list(act(world, 1, Fire()).entities) == [1, 3]
    world = world_of(ship(100, 500), rock(121, 481, 0, 0, 18), rock(121, 519, 0, 0, 18))
    assert list(act(world, 1, Fire()).entities) == [1, 3]


def test_births_an_own_earlier_bullet_counts() -> None:
    world = act(world_of(ship(100, 500)), 1, Fire())
    assert list(world.entities) == [1, 2]
    after = act(world, 1, Fire())
    assert list(after.entities) == [1]
    assert after.add(rock(500, 500)).asteroids[0].id == 4


def test_births_a_bullet_never_hits_its_own_ship() -> None:
    """The ship overtakes its bullet, and meets it again on its way back from the wall."""
    world = act(world_of(ship(500, 500, 400, 0, max_speed=400.0)), 1, Fire())
    log, after = run(world, 2.3)
    assert [h.kind for h in log] == ["wall"] * len(log)
    assert {h.entities for h in log} == {(1,), (2,)}
    assert list(after.entities) == [1, 2]


def test_births_touching_exactly_is_no_hit_yet() -> None:
    world = world_of(ship(100, 500), rock(136, 500))
    fired = act(world, 1, Fire())
    assert list(fired.entities) == [1, 2, 3]
    assert list(evolve(fired, 0.0).entities) == [1]


# children


def split(
    r: float, vx: float, vy: float, seed: int = 0, **fields: Any
) -> tuple[World, Happened, World]:
    """An asteroid at rest against a bullet that is upon it, before, what happened, and after."""
    parent = rock(500, 500, vx, vy, r, **fields)
    world = world_of(parent, shot(500 - r - 3, 500, vx + 250, vy), seed=seed)
    (happened, after), *_ = happenings(world, 0.0)
    return world, happened, after


@pytest.mark.parametrize("seed", range(8))
def test_children_lie_on_one_line_through_the_parent_and_fly_apart_along_it(seed: int) -> None:
    _, happened, after = split(40.0, 30.0, -40.0, seed)
    assert (happened.effect, happened.died, happened.born) == ("split", (1, 2), (3, 4))
    a, b = after.asteroids
    assert (a.id, b.id) == (3, 4)
    assert a.radius == b.radius == 20.0
    assert (a.vx, a.vy) == (-b.vx, -b.vy)
    assert abs(a.x + b.x - 1000.0) <= 2 * ulp(1000.0)
    assert abs(a.y + b.y - 1000.0) <= 2 * ulp(1000.0)
    for child in (a, b):
        dx, dy = child.x - 500.0, child.y - 500.0
        assert abs(sqrt(dx * dx + dy * dy) - 20.0) <= 2 * ulp(500.0)
        assert abs(child.speed - 75.0) <= 4 * ulp(75.0)
        # along the axis, outwards: the cross product is rounding of the places, times the speed
        assert abs(dx * child.vy - dy * child.vx) <= 4 * 75.0 * ulp(500.0)
        assert dx * child.vx + dy * child.vy > 0.0


def test_children_go_a_random_way() -> None:
    ways = {split(40.0, 30.0, -40.0, seed)[2].asteroids[0].velocity for seed in range(20)}
    assert len(ways) == 20
    assert {(vx > 0, vy > 0) for vx, vy in ways} == {
        (a, b) for a in (True, False) for b in (True, False)
    }


@pytest.mark.parametrize(
    ("r", "count"), [(30.0, 2), (nextafter(30.0, 0.0), 0), (29.0, 0), (60.0, 2)]
)
def test_children_come_from_30_km_on(r: float, count: int) -> None:
    _, happened, after = split(r, 0.0, 0.0)
    assert len(after) == count
    assert happened.effect == ("split" if count else "die")


def test_children_of_a_resting_parent_rest() -> None:
    _, _, after = split(40.0, 0.0, 0.0)
    assert [child.velocity for child in after.asteroids] == [(0.0, 0.0)] * 2
    assert run(after, 10.0)[0] == []


def test_children_inherit_the_limit_and_obey_it() -> None:
    _, happened, after = split(40.0, 30.0, -40.0, max_speed=60.0)
    assert happened.clipped == (3, 4)
    a, b = after.asteroids
    assert a.max_speed == b.max_speed == 60.0
    assert (a.vx, a.vy) == (-b.vx, -b.vy)
    assert 60.0 - 8 * ulp(60.0) <= a.speed <= 60.0


def test_children_none_of_an_asteroid_outside_a_world() -> None:
    world = world_of(rock(500, 500, 0, 0, 40)).remove(1)
    assert len(world) == 0
    assert world.add(rock(100, 100)).asteroids[0].id == 2


def test_children_none_where_the_ship_dies() -> None:
    log, after = run(world_of(ship(440, 500, 10, 0), rock(500, 500, 0, 0, 40)), 1.0)
    assert [(h.effect, h.died, h.born) for h in log] == [("die", (1,), ())]
    assert list(after.entities) == [2]


# source died


def test_source_died_its_bullets_fly_on_and_keep_its_id() -> None:
    world = act(world_of(ship(100, 500), rock(100, 530, 0, -1, 19)), 1, Fire())
    after = evolve(world, 1.0)
    assert 1 not in after
    (bullet,) = after.bullets
    assert bullet.source == 1
    assert bullet.position == (363.0, 500.0)


# adding


def test_adding_touching_is_fine() -> None:
    world = world_of(rock(20, 20), rock(60, 20), ship(90, 20), rock(980, 980))
    assert len(world) == 4


def test_adding_rounding_overlap_is_fine() -> None:
    assert len(world_of(ship(100.1, 500), ship(nextafter(120.1, 0.0), 500))) == 2
    assert len(world_of(ship(nextafter(10.0, 0.0), 500))) == 1


@pytest.mark.parametrize(
    ("entity", "reason"),
    [
        (rock(139, 500), "overlap by"),
        (rock(15, 500), "sticks out"),
        (rock(900, 990), "sticks out"),
        (rock(500, 500, 0, 0, 500), "too wide"),
        (rock(500, 500, 0, 0, 700), "too wide"),
        (rock(500, 700, id=1), "taken"),
    ],
)
def test_adding_is_refused_with_the_reason(entity: Asteroid, reason: str) -> None:
    with pytest.raises(ModelError, match=reason):
        world_of(rock(100, 500)).add(entity)


def test_adding_a_bullet_onto_its_source_is_fine() -> None:
    world = world_of(ship(500, 500), shot(505, 500, source=1))
    assert len(world) == 2
    assert run(world, 1.0)[0] == []


# ticks


@frozen
class Script:
    """A program that does one thing a tick, then ends; None runs out of fuel."""

    steps: tuple[Action | None, ...]

    @property
    def running(self) -> bool:
        return bool(self.steps)

    def tick(self, _view: Any) -> Ticked:
        rest = Script(self.steps[1:])
        step = self.steps[0]
        return Ticked(rest, step) if step is not None else Ticked(rest, None, "fuel")


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


# randomness


def test_randomness_is_keyed_by_seed_id_and_purpose() -> None:
    _, _, after = split(40.0, 30.0, -40.0, seed=5)
    angle = chance.angle(5, 1, "split")
    a, _ = after.asteroids
    assert (a.vx > 0.0) == (-pi / 2 < (angle if angle < pi else angle - 2 * pi) < pi / 2)
    assert (a.vy > 0.0) == (angle < pi)


def test_randomness_adding_an_entity_does_not_change_anothers_luck() -> None:
    world, _, after = split(40.0, 30.0, -40.0, seed=5)
    (_, with_more), *_ = happenings(world.add(rock(900, 900, 5, 5, 50)), 0.0)
    luck = [child.velocity for child in after.asteroids]
    assert [child.velocity for child in with_more.asteroids if child.radius == 20.0] == luck


def test_randomness_another_seed_or_id_is_another_luck() -> None:
    one = split(40.0, 30.0, -40.0, seed=5)[2].asteroids[0].velocity
    assert split(40.0, 30.0, -40.0, seed=6)[2].asteroids[0].velocity != one
    (_, other), *_ = happenings(
        world_of(rock(500, 500, 30, -40, 40, id=2), shot(457, 500, 280, -40), seed=5), 0.0
    )
    assert other.asteroids[0].velocity != one


def test_randomness_asks_nobody_twice() -> None:
    assert split(40.0, 30.0, -40.0, seed=5)[2] == split(40.0, 30.0, -40.0, seed=5)[2]
    assert isinstance(split(40.0, 0.0, 0.0)[2].flight_of(3), Flight)
