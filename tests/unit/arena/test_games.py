"""Games: who plays, what ends one, and how it ended for each."""

from __future__ import annotations

import pytest

from fasteroids import Fire, ModelError, Skip, evolve, load_scene
from fasteroids.arena import LIMIT, Ended, crew, flown, play
from fasteroids.cli._files import shipped, shipped_programs
from fasteroids.units import BULLET_RADIUS, BULLET_SPEED
from tests.unit.making import BOX, ROCK, SHIP, Script, machine, rock, ship, shot, world_of

IDLE = Script(())
SHOOTER = Script((Fire(),))


# Who plays.


SWAPPED = (
    BOX + SHIP.replace("'red'", "'blue'\nid = 7").replace("x = 100", "x = 600") + SHIP + "id = 3\n"
)
"""Two ships, that of the lower id last."""


def test_the_crew_are_the_ships_in_order_of_their_ids() -> None:
    assert crew(load_scene(SWAPPED + ROCK + "id = 5\n")) == (3, 7)
    assert crew(world_of(rock(500, 500), ship(100, 100))) == (2,)


@pytest.mark.parametrize("ships", [0, 3])
def test_other_numbers_of_ships_are_no_game(ships: int) -> None:
    world = world_of(*(ship(100 + 100 * i, 100) for i in range(ships)))
    with pytest.raises(ModelError, match=f"one ship, .* or two, .*; this one has {ships}"):
        crew(world)
    with pytest.raises(ModelError, match=f"this one has {ships}"):
        play(world)


def test_ships_get_their_programs_in_order_of_their_ids() -> None:
    world = flown(load_scene(SWAPPED), [SHOOTER, IDLE])
    assert [(s.id, s.name, s.program) for s in world.ships] == [
        (3, "red", SHOOTER), (7, "blue", IDLE),
    ]  # fmt: skip


def test_a_new_program_takes_the_place_of_the_old_one() -> None:
    world = world_of(ship(100, 100, program=Script((Skip(),) * 9)), rock(500, 500))
    assert flown(world, [SHOOTER]) == flown(world_of(ship(100, 100), rock(500, 500)), [SHOOTER])


@pytest.mark.parametrize("programs", [[], [IDLE], [IDLE] * 3])
def test_each_ship_needs_a_program(programs: list[Script]) -> None:
    with pytest.raises(ModelError, match=f"2 in all; got {len(programs)}"):
        flown(world_of(ship(100, 100), ship(300, 100)), programs)


# Alone.


def test_cleared_when_the_last_asteroid_dies() -> None:
    world = flown(world_of(ship(100, 100), rock(200, 100)), [SHOOTER])
    (ended,) = play(world)
    # Fired at 0.2 s with its centre 13 km before the ship's; they touch at 23 km.
    way = (200.0 - 20.0 - BULLET_RADIUS) - (100.0 + 10.0 + BULLET_RADIUS)
    assert ended.outcome == "cleared"
    assert ended.good
    assert ended.time == pytest.approx(0.2 + way / BULLET_SPEED, rel=1e-12)


def test_a_split_clears_nothing() -> None:
    world = flown(world_of(ship(100, 100), rock(300, 100, r=40.0)), [SHOOTER])
    (ended,) = play(world, limit=3.0)
    assert ended.outcome != "cleared"


def test_died_when_an_asteroid_meets_the_ship() -> None:
    (ended,) = play(world_of(ship(100, 100), rock(200, 100, vx=-70.0)))
    assert ended == Ended("died", 1.0)
    assert not ended.good


def test_a_death_at_the_time_of_the_clearing_is_a_death() -> None:
    """A bullet meets the last asteroid, and another one the ship, at one time."""
    last, own = rock(600, 500), shot(427, 500, vx=150.0, source=1)  # 150 km between their rims
    stray = shot(100, 263, vy=-150.0)
    world = world_of(ship(100, 100), last, own, stray)
    assert play(world) == (Ended("died", 1.0),)
    assert play(world_of(ship(100, 100), last, own)) == (Ended("cleared", 1.0),)


def test_timed_out_at_the_limit() -> None:
    world = world_of(ship(100, 100), rock(500, 500))
    assert play(world, limit=2.5) == (Ended("timed out", 2.5),)
    assert play(world) == (Ended("timed out", LIMIT),)


def test_a_game_timed_out_lasted_as_long_as_the_limit_says() -> None:
    """(0.1 + 0.2) - 0.1 is more."""
    late = evolve(world_of(ship(100, 100), rock(500, 500)), 0.1)
    assert play(late, limit=0.2) == (Ended("timed out", 0.2),)


def test_an_end_at_the_limit_counts() -> None:
    world = world_of(ship(100, 100), rock(200, 100, vx=-70.0))
    assert play(world, limit=1.0) == (Ended("died", 1.0),)
    assert play(world, limit=0.999)[0].outcome == "timed out"


def test_a_field_without_asteroids_is_cleared_at_once() -> None:
    assert play(world_of(ship(100, 100))) == (Ended("cleared", 0.0),)


def test_times_count_from_the_time_of_the_world() -> None:
    late = evolve(world_of(ship(100, 100), rock(255, 100, vx=-50.0)), 1.5)
    assert play(late) == (Ended("died", 1.0),)
    assert play(late, limit=0.5) == (Ended("timed out", 0.5),)


# Two.


def test_who_survives_has_won() -> None:
    world = world_of(ship(100, 100), ship(500, 500), rock(200, 100, vx=-70.0))
    assert play(world) == (Ended("lost", 1.0), Ended("won", 1.0))


def test_both_dead_at_one_time_is_a_draw() -> None:
    """They die at two events, of which one must come first."""
    rocks = [rock(200, 100, vx=-70.0), rock(500, 400, vy=70.0)]
    world = world_of(ship(100, 100), ship(500, 500), *rocks)
    assert play(world) == (Ended("drawn", 1.0), Ended("drawn", 1.0))
    assert not play(world)[0].good


def test_dead_a_little_later_has_won() -> None:
    rocks = [rock(200, 100, vx=-70.0), rock(500, 400, vy=69.999)]
    world = world_of(ship(100, 100), ship(500, 500), *rocks)
    assert [each.outcome for each in play(world)] == ["lost", "won"]


def test_two_go_on_when_no_asteroid_is_left() -> None:
    world = flown(world_of(ship(100, 100), ship(500, 500), rock(200, 100)), [SHOOTER, IDLE])
    assert [each.outcome for each in play(world, limit=5.0)] == ["timed out"] * 2


# What programs did.


def test_ticks_out_of_fuel_are_counted_for_each() -> None:
    script = Script((None, Skip(), None, None))
    world = flown(world_of(ship(100, 100), ship(500, 500)), [script, Script((None,))])
    assert [each.fuel for each in play(world, limit=5.0)] == [3, 1]


def test_a_program_that_stopped_says_where_and_why() -> None:
    bad = machine("entity e;\nskip;\nprint getx e;\n")
    fine = machine("while (true) { skip; }")
    world = flown(world_of(ship(100, 100), ship(500, 500)), [fine, bad])
    first, second = play(world, limit=1.0)
    assert first.stopped is None
    assert second.stopped == "line 3: getx null: e is null"


def test_the_same_world_gives_the_same_end() -> None:
    turret = machine(shipped_programs()["turret"])
    world = flown(load_scene(shipped()["field-2013"], seed=7), [turret])
    assert play(world) == play(world)
    assert play(world)[0].outcome == "cleared"
