"""Program steps as part of time: forwards and backwards, across ticks, exactly as they were lived."""

from __future__ import annotations

from itertools import pairwise

import pytest

from fasteroids import ModelError, Ship, World, check_program, parse_program
from fasteroids.cli._files import shipped_programs
from fasteroids.history import (
    Place,
    Point,
    Timeline,
    at_tick,
    begin,
    last_change,
    machine_at,
    next_statement,
    next_step,
    next_tick,
    previous_statement,
    previous_step,
    previous_tick,
    tick_at,
    ticks_of,
)
from fasteroids.history.stepping import is_tick_of
from fasteroids.lang import Halted, Machine, Running
from fasteroids.lang.machine.traced import machine_in
from tests.unit.history.pasts import fought, states
from tests.unit.making import Script, machine, rock, ship, world_of

TEXT = """\
double n;
while (true) {
  n := n + 1;
  print n;
  if (n % 2 == 0) { fire; }
  skip;
}
"""


def alone(text: str = TEXT, *, fuel: int = 1000, seconds: float = 1.5) -> Timeline:
    return begin(world_of(ship(500.0, 500.0, program=machine(text)), fuel=fuel)).evolve(seconds)


def walk(timeline: Timeline, point: Point) -> list[Point]:
    """Every point from one on."""
    found = [point]
    while (after := next_step(timeline, found[-1])) is not None:
        found.append(after)
    return found


def machine_of(world: World, entity: int) -> Machine:
    e = world[entity]
    assert isinstance(e, Ship)
    m = machine_in(e.program)
    assert m is not None
    return m


def test_the_ticks_of_a_ship_in_order() -> None:
    timeline = alone()
    assert [s.place.time for s in ticks_of(timeline, 1)] == pytest.approx(
        [0.2 * k for k in range(1, 8)]
    )
    assert [s.place.time for s in ticks_of(timeline, 1, after=1.0)] == pytest.approx([1.2, 1.4])
    assert list(ticks_of(timeline, 1, after=2.0)) == []


def test_a_tick_of_another_that_is_about_a_ship_is_not_its_own() -> None:
    timeline = fought()
    shot = next(s for s in states(timeline) if is_tick_of(s.what, 2) and s.born)
    assert list(ticks_of(timeline, shot.born[0])) == []


def test_steps_of_the_first_tick() -> None:
    timeline = alone()
    point = at_tick(timeline, 1, 0.2)
    assert point.span[:2] == (2, 8)
    assert point.statement[:2] == (2, 1)
    assert (point.variables, point.prints, point.step) == ({"n": 0.0}, (), 0)
    points = [p for p in walk(timeline, point) if p.tick == point.tick]
    assert [p.span[:2] for p in points] == [
        (2, 8), (2, 1), (3, 8), (3, 12), (3, 8), (3, 3), (4, 9), (4, 3),
        (5, 7), (5, 11), (5, 7), (5, 16), (5, 7), (5, 3), (6, 3),
    ]  # fmt: skip
    assert [p.begins for p in points].count(True) == 5
    assert points[6].variables == {"n": 1.0}
    assert [p.prints for p in points].count(()) == 8
    assert points[-1].prints == ("1.0",)
    assert point.tick.writes("n") == (5,)
    assert point.tick.whole
    assert point.tick.fuel == 1000


def test_statements_across_ticks_and_back() -> None:
    timeline = alone()
    point: Point | None = at_tick(timeline, 1, 0.2)
    lines = []
    while point is not None:
        lines.append((round(point.tick.time, 3), point.statement.line))
        last, point = point, next_statement(timeline, point)
    assert lines[:11] == [
        (0.2, 2), (0.2, 3), (0.2, 4), (0.2, 5), (0.2, 6),
        (0.4, 2), (0.4, 3), (0.4, 4), (0.4, 5), (0.4, 5), (0.6, 6),
    ]  # fmt: skip
    back = []
    here: Point | None = last
    while here is not None:
        back.append((round(here.tick.time, 3), here.statement.line))
        here = previous_statement(timeline, here)
    assert back == lines[::-1]


def test_behind_the_last_step_of_all_nothing_comes_until_time_goes_on() -> None:
    timeline = alone()
    end = walk(timeline, at_tick(timeline, 1, 1.4))[-1]
    assert end.step == len(end.tick.steps)
    assert end.machine == machine_of(timeline.world, 1)
    assert next_step(timeline, end) is None
    assert next_statement(timeline, end) is None
    later = next_step(timeline.evolve(1.0), end)
    assert later is not None
    assert later.tick.time == pytest.approx(1.6)


def test_before_the_first_step_of_all_nothing_was() -> None:
    timeline = alone()
    first = at_tick(timeline, 1, 0.2)
    assert previous_step(timeline, first) is None
    assert previous_statement(timeline, first) is None
    assert previous_tick(timeline, 1, 0.2) is None
    assert next_tick(timeline, 1, 1.4) is None


def test_a_tick_that_ran_out_of_fuel_goes_on_in_the_middle_of_a_statement() -> None:
    timeline = alone("double n; while (true) { n := n + 1 * 2 - 3; }", fuel=5, seconds=2.0)
    points = walk(timeline, at_tick(timeline, 1, 0.2))
    starts = [p for p in points if p.step == 0]
    assert not all(p.begins for p in starts)
    assert all(p.tick.state.what is not None for p in starts)
    step: Point | None = points[-1]
    found = []
    while step is not None:
        found.append(step)
        step = previous_step(timeline, step)
    assert found == points[::-1]
    statement = at_tick(timeline, 1, 0.2)
    passed = []
    while (following := next_statement(timeline, statement)) is not None:
        passed.append(following)
        statement = following
    assert all(p.begins for p in passed[:-1])
    assert [p for p in points if p.begins][1:] == [p for p in passed if p.begins]


def test_a_program_that_stopped_says_where() -> None:
    timeline = alone("entity e;\nskip;\nprint getx e;")
    end = walk(timeline, at_tick(timeline, 1, 0.4))[-1]
    assert isinstance(end.machine, Halted)
    assert end.statement.line == 3
    assert end.machine.reason == "getx null: e is null"
    assert not end.begins


@pytest.mark.parametrize("name", sorted(shipped_programs()))
@pytest.mark.parametrize("model", ["smooth", "robust"])
@pytest.mark.parametrize("budget", [2**28, 0])
def test_the_steps_of_every_shipped_program_lead_to_what_was_lived(
    name: str, model: str, budget: int
) -> None:
    program = check_program(parse_program(shipped_programs()[name])).program
    spinner = machine("while (true) { turn 0.3; thrust; fire; thrust_off; }")
    world = world_of(
        ship(300.0, 300.0, 5.0, thruster=True, program=program),
        ship(700.0, 700.0, program=spinner),
        rock(600.0, 200.0, -20.0, 30.0, r=32.0),
        rock(200.0, 700.0, 25.0, -20.0),
        model=model,
    )
    timeline = begin(world, budget=budget)
    for _ in range(6):
        timeline = timeline.evolve(0.37)
    ticks = [tick_at(timeline, 1, state.place) for state in ticks_of(timeline, 1)]
    assert ticks
    for tick in ticks:
        assert tick.machine(len(tick.steps)) == machine_of(tick.state.world, 1)
    for a, b in pairwise(ticks):
        waits, wakes = a.machine(len(a.steps)), b.machine(0)
        assert isinstance(waits, Running)
        assert isinstance(wakes, Running)
        assert [(f.block, f.index) for f in waits.todo] == [(f.block, f.index) for f in wakes.todo]
        assert a.machine(len(a.steps)) == machine_of(b.before, 1)


def test_a_ship_that_ticks_second_at_a_moment_sees_what_the_first_did() -> None:
    first = ship(300.0, 500.0, program=machine("fire;"))
    counts = "double n; entity e; foreach (bullet, e) { n := n + 1; } skip;"
    world = world_of(first, ship(700.0, 200.0, program=machine(counts)))
    timeline = begin(world).evolve(0.5)
    tick = tick_at(timeline, 2, 0.2)
    assert tick.place == Place(0, 0.2, 2)
    assert len(tick.before.bullets) == 1
    assert tick.machine(len(tick.steps)).store["n"] == 1.0


def test_a_tick_under_literal_thrust_is_a_cut_that_comes_first() -> None:
    looks = "double v; while (true) { v := getvx self; skip; }"
    world = world_of(ship(300.0, 500.0, program=machine(looks), thruster=True))
    timeline = begin(world).evolve(1.0)
    speeds = [tick_at(timeline, 1, s.place).machine(5).store["v"] for s in ticks_of(timeline, 1)]
    assert speeds == pytest.approx([256.0 * 0.2 * k for k in range(1, 6)])


def test_a_variable_is_traced_to_the_statement_that_wrote_it() -> None:
    timeline = alone()
    changed = last_change(timeline, 1, "program.n", before=1.3)
    assert changed is not None
    tick = tick_at(timeline, 1, changed.state.place)
    (step,) = tick.writes("n")
    assert Point(tick, step).statement.line == 3
    assert (changed.old, changed.new) == (3.0, 4.0)


def test_machine_at_is_the_machine_in_front_of_a_step() -> None:
    timeline = alone()
    assert machine_at(timeline, 1, 0.3) == at_tick(timeline, 1, 0.2).machine
    points = walk(timeline, at_tick(timeline, 1, 1.4))
    for point in points:
        assert machine_at(timeline, 1, 1.4, point.step) == point.machine


@pytest.mark.parametrize("step", [-1, 16, True, 1.0, None])
def test_a_step_that_is_none_is_refused(step: int) -> None:
    with pytest.raises(ModelError, match="has steps 0 to 15"):
        machine_at(alone(), 1, 0.2, step)


def test_what_cannot_be_stepped_is_refused() -> None:
    timeline = alone()
    with pytest.raises(ModelError, match=r"no program of ship #1 ran up to 0\.1 s"):
        at_tick(timeline, 1, 0.1)
    with pytest.raises(ModelError, match="ids in this past"):
        at_tick(timeline, 99, 1.0)
    script = begin(world_of(ship(500.0, 500.0, program=Script((None, None))))).evolve(1.0)
    with pytest.raises(ModelError, match="runs no program that could be stepped"):
        at_tick(script, 1, 1.0)


def test_stepping_leaves_the_timeline_as_it_is() -> None:
    timeline = fought()
    before = [(s.place, s.what, s.world) for s in states(timeline)]
    for state in ticks_of(timeline, 1):
        tick_at(timeline, 1, state.place)
    assert [(s.place, s.what, s.world) for s in states(timeline)] == before
    assert timeline.evolve(1.0).world == fought().evolve(1.0).world
