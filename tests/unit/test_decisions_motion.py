"""DESIGN section 5, tests named after its rows: thrust, advance (literal), c limit."""

from __future__ import annotations

from math import pi, sqrt, ulp

import pytest

from fasteroids import (
    ModelError,
    Ship,
    Thrust,
    ThrustOff,
    Turn,
    World,
    act,
    evolve,
    happenings,
    models,
)
from fasteroids.units import SPEED_OF_LIGHT, THRUST
from tests.unit.making import STRONG, rock, run, ship, shot, staged, told, world_of

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
