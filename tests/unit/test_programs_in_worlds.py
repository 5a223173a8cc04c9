"""Programs that fly ships: when they run, what they see, what stops them (assignment 1.6, 1.8)."""

from __future__ import annotations

import pytest
from attrs import evolve as with_

from fasteroids import (
    Asteroid,
    Bullet,
    ModelError,
    Ship,
    World,
    check_program,
    evolve,
    evolve_until,
    happenings,
    parse_program,
)
from fasteroids.lang import Halted, Running
from fasteroids.state import instructed
from fasteroids.testing import unfold
from fasteroids.units import FUEL
from tests.unit.making import machine


def space(text: str, fuel: int = FUEL) -> World:
    ship = Ship(500, 500, 0, 0, 20, 5e15, 0, program=machine(text), name="red")
    return World(1000, 1000, fuel=fuel).add(ship)


COUNT = "double n; while (true) { n := n + 1; print n; skip; }"


def prints(world: World, until: float) -> list[tuple[float, str]]:
    return [(h.time, p) for h in unfold(world, until=until).log for p in h.prints]


def test_a_program_runs_at_each_fifth_of_a_second_from_the_first_on() -> None:
    assert prints(space(COUNT), 1.0) == [(k / 5, f"{k}.0") for k in range(1, 6)]


@pytest.mark.parametrize(
    ("steps", "dt", "ticks"), [(10, 0.1, 5), (20, 0.03, 3), (5, 0.2, 5), (1, 0.19, 0)]
)
def test_the_rounding_of_steps_is_carried(steps: int, dt: float, ticks: int) -> None:
    world = space(COUNT)
    for _ in range(steps):
        world = evolve(world, dt)
    program = world.ships[0].program
    assert isinstance(program, Running)
    assert program.store["n"] == float(ticks)


def test_the_examples_turn_and_fire_by_turns() -> None:
    text = "double d; bool b; d := 0.2; b := true; while(b) { turn d; d := d + 0.1; fire; }"
    log = unfold(space(text), until=0.8).log
    assert [h.effect for h in log] == ["turn", "fire", "turn", "fire"]
    assert evolve(space(text), 0.8).ships[0].direction == 0.2 + (0.2 + 0.1)


def test_an_illegal_operation_stops_the_program_and_nothing_else() -> None:
    world = space("entity e;\nskip;\nprint getx e;\nfire;")
    log = unfold(world, until=5.0).log
    assert [(h.time, h.effect) for h in log] == [(0.2, "skip"), (0.4, "halt")]
    assert log[1].reason == "getx null: e is null"
    assert log[1].span.line == 3
    assert isinstance(evolve(world, 5.0).ships[0].program, Halted)


def test_a_loop_without_an_action_uses_its_fuel_and_goes_on_at_the_next_tick() -> None:
    world = space("double n; while (true) { n := n + 1; }", fuel=100)
    log = unfold(world, until=1.0).log
    assert [h.effect for h in log] == ["fuel"] * 5
    end = evolve(world, 1.0).ships[0].program
    assert isinstance(end, Running)
    assert end.store["n"] == 500 // 6  # a round is the test, entering, and four steps of the sum


@pytest.mark.parametrize("fuel", [0, -1, 10**9 + 1, 1.5, True, None])
def test_the_fuel_of_a_world_is_a_count(fuel: object) -> None:
    with pytest.raises(ModelError, match="fuel must be an integer from 1 to 1000000000"):
        World(1, 1, fuel=fuel)  # type: ignore[arg-type]


def test_worlds_of_other_fuel_are_others() -> None:
    assert World(1, 1, fuel=5) != World(1, 1)
    assert World(1, 1, fuel=5) == World(1, 1, fuel=5)


def test_programs_see_the_world_at_their_tick() -> None:
    text = """
    entity a; double n;
    while (true) {
      n := 0;
      foreach (any, a) { n := n + 1; print getx a; }
      print a == self; print getdir; skip;
    }"""
    world = space(text).add(Asteroid(100, 100, 50, 0, 20)).add(Bullet(700, 700, 0, 0, 3, 1))
    assert [p for t, p in prints(world, 0.3)] == ["500.0", "110.0", "700.0", "false", "0.0"]


def test_a_dead_entity_keeps_its_last_state_and_is_not_null() -> None:
    text = """
    entity a; entity x;
    foreach (asteroid, x) { a := x; }
    skip; print a == null; print getx a; skip; print a == null; print getx a; print a;"""
    world = evolve(space(text).add(Asteroid(100, 100, 50, 0, 20)), 0.5)
    gone = world.remove(2)
    assert [p for _, p in prints(gone, 1.0)] == ["false", "120.0", "asteroid 2"]


def test_ships_run_in_the_order_of_their_ids() -> None:
    world = World(1000, 1000).add_all(
        Ship(100 + 200 * i, 500, 0, 0, 20, 5e15, 0, program=machine("print getx self; skip;"))
        for i in range(3)
    )
    assert [p for _, p in prints(world, 0.2)] == ["100.0", "300.0", "500.0"]


def test_a_ship_that_gets_its_program_late_begins_at_the_next_tick() -> None:
    world = evolve(World(1000, 1000), 0.4)
    world = world.add(Ship(500, 500, 0, 0, 20, 5e15, 0, program=machine(COUNT)))
    assert prints(world, 0.7) == [(0.6, "1.0")]


def test_a_dead_ship_does_not_run() -> None:
    world = space(COUNT).add(Asteroid(560, 500, -400, 0, 30))  # meets it after 0.025 s
    assert prints(world, 1.0) == []
    assert [h.effect for h, _ in happenings(world, 1.0)] == ["die"]


def test_what_is_no_checked_program_is_refused() -> None:
    tree = parse_program("skip;").program
    for other in (tree, "skip;", check_program):
        with pytest.raises(ModelError, match="program must be a checked program"):
            Ship(500, 500, 0, 0, 20, 5e15, 0, program=other)  # type: ignore[arg-type]


def test_kept_worlds_keep_their_programs() -> None:
    run = unfold(space(COUNT), until=2.0)
    for world, happened in zip(run.worlds, run.log, strict=True):
        again = evolve_until(world, 2.0)
        assert again == run.end, happened


def test_equal_worlds_think_alike() -> None:
    """Entities that differ in the signs of zeros are equal; no program may tell them apart."""
    text = "if (1 / getvx self > 0) { fire; } else { skip; }"
    worlds = [
        World(1000, 1000).add(Ship(500, 500, zero, 0, 20, 5e15, 0, program=machine(text)))
        for zero in (0.0, -0.0)
    ]
    assert worlds[0] == worlds[1]
    assert [[h.effect for h in unfold(w, until=0.2).log] for w in worlds] == [["fire"], ["fire"]]


# Another program in the middle of a run.


def test_another_program_begins_at_the_next_tick_and_the_old_one_is_gone() -> None:
    world = evolve(space(COUNT), 0.5)
    told = instructed(world, 1, machine("while (true) { print 7; skip; }"))
    assert prints(told, 1.0) == [(0.6, "7.0"), (0.8, "7.0"), (1.0, "7.0")]
    assert prints(world, 0.8) == [(0.6, "3.0"), (0.8, "4.0")]  # the world before goes on as it did


def test_a_ship_without_a_program_gets_one_at_a_tick_and_begins_at_the_one_after() -> None:
    world = evolve(World(1000, 1000).add(Ship(500, 500, 0, 0, 20, 5e15, 0)), 0.6)
    log = unfold(instructed(world, 1, machine("skip;")), until=1.0).log
    assert [h.time for h in log] == [0.8]


def test_a_program_that_has_ended_gives_no_ticks() -> None:
    done = evolve(space("skip;"), 1.0).ships[0].program
    assert done is not None
    assert not done.running
    told = instructed(evolve(space(COUNT), 0.5), 1, done)
    assert unfold(told, until=2.0).log == []
    assert told.flight_of(1).next_tick is None


def test_another_program_changes_nothing_of_the_flight() -> None:
    """The path bent by a thruster, when it began, and whom the ship has just met."""
    pair = [Ship(x, 500, vx, 0, 20, 5e15, 0, thruster=True) for x, vx in ((300, 90), (500, -90))]
    world = evolve(World(1000, 1000, model="smooth").add_all(pair), 1.0)
    before = world.flight_of(1)
    assert before.bounced_off == 2
    assert before.path is not None
    assert before.since != world.now
    after = instructed(world, 1, machine("while (true) { skip; }")).flight_of(1)
    assert (after.since, after.bounced_off, after.path) == (
        before.since, before.bounced_off, before.path,
    )  # fmt: skip
    assert isinstance(after.entity, Ship)
    assert with_(after.entity, program=None) == before.entity


def test_the_same_program_again_starts_anew_but_flies_the_same() -> None:
    steady = machine("while (true) { thrust; }")
    ship = Ship(300, 500, 0, 40, 20, 5e15, 0, program=steady)
    world = evolve(World(1000, 1000, model="smooth").add(ship), 1.5)
    assert evolve(instructed(world, 1, steady), 3.0).ships[0].position == (
        evolve(world, 3.0).ships[0].position
    )


def test_only_ships_of_the_world_take_programs_and_only_checked_ones() -> None:
    world = space(COUNT).add(Asteroid(200, 200, 0, 0, 20))
    with pytest.raises(ModelError, match="a program is for a ship; asteroid #2 is none"):
        instructed(world, 2, machine("skip;"))
    with pytest.raises(ModelError, match="9"):
        instructed(world, 9, machine("skip;"))
    with pytest.raises(ModelError, match="program"):
        instructed(world, 1, "skip;")  # type: ignore[arg-type]
