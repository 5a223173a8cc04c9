"""The pane of a program, breakpoints, and another program from here on."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Fire, ModelError, Ship, Thrust, Turn
from fasteroids.history import (
    Act,
    Place,
    Point,
    Timeline,
    at_tick,
    begin,
    condition,
    first_difference,
    next_statement,
    next_step,
    outwardly,
    tick_at,
)
from fasteroids.lang.report import cells
from fasteroids.tui.breakpoints import AtLine, Breakpoint, When, next_break
from fasteroids.tui.edits import Edited, editing
from fasteroids.tui.program_pane import machine_of, program_rows
from fasteroids.tui.rows import Row, Style
from tests.unit.history.pasts import PILOT, fought
from tests.unit.making import machine, rock, ship, world_of

TEXT = """\
double n;
entity it;
while (true) {
  n := n + 1;
  foreach (asteroid, it) {}
  print n;
  if (n % 3 == 0) { turn 0.5; }
  skip;
}
"""


def alone(text: str = TEXT, *, fuel: int = 1000, seconds: float = 3.1) -> Timeline:
    world = world_of(
        ship(500.0, 500.0, program=machine(text), name="red"), rock(100.0, 100.0, 8.0), fuel=fuel
    )
    return begin(world).evolve(seconds)


def text(rows: tuple[Row, ...]) -> str:
    return "\n".join(row.text.rstrip() for row in rows)


def lit(rows: tuple[Row, ...], style: Style = Style.CURSOR) -> list[str]:
    """The pieces of rows in a style."""
    return [row.text[a:b] for row in rows for a, b, s in row.runs if s == style]


def after(timeline: Timeline, point: Point, steps: int) -> Point:
    for _ in range(steps):
        following = next_step(timeline, point)
        assert following is not None
        point = following
    return point


@pytest.fixture(scope="module")
def past() -> Timeline:
    return alone()


# The pane.


def test_the_pane_in_the_middle_of_a_tick(past: Timeline) -> None:
    point = after(past, at_tick(past, 1, 0.4), 10)
    rows = program_rows(point, 60, 16, name="red", lines={7}, conditions=["n > 3"])
    assert (
        text(rows).rstrip("\n")
        == """\
red program: running
tick at 0.400 s  step 10 of 17  fuel 10 of 1000 used
* when n > 3
  1  double n;
  2  entity it;
  3  while (true) {
  4    n := n + 1;
  5    foreach (asteroid, it) {}
  6    print n;
* >7    if (n % 3 == 0) { turn 0.5; }
  8    skip;
  9  }
  it = asteroid 2 at 103.2, 100
* n  = 2.0
print 2.0""".replace("* >7", "*>7")
    )
    assert lit(rows) == ["*>7  ", "n"]
    assert lit(rows, Style.CHANGED) == ["* ", "2.0"]


def test_each_step_of_a_tick_is_lit_where_it_is(past: Timeline) -> None:
    point: Point | None = at_tick(past, 1, 0.6)
    first = point
    seen = []
    while point is not None and point.tick == first.tick:  # type: ignore[union-attr]
        (_, piece) = lit(program_rows(point, 60, 20))
        seen.append(piece)
        point = next_step(past, point)
    assert seen[:7] == [
        "true",
        "while (true) {",
        "n",
        "1",
        "n + 1",
        "n := n + 1;",
        "foreach (asteroid, it) {}",
    ]
    assert "turn 0.5;" in seen


@given(st.integers(0, 100), st.integers(0, 45), st.integers(0, 60))
def test_the_pane_has_exactly_its_size_and_its_cursor_in_sight(
    past: Timeline, width: int, height: int, steps: int
) -> None:
    point = after(past, at_tick(past, 1, 0.2), steps)
    rows = program_rows(point, width, height, name="red", lines={4})
    assert len(rows) == height
    assert all(cells(row.text) == width for row in rows)
    if height >= 4 and width >= 10:
        assert f">{point.span.line}" in lit(rows)[0]


def test_a_long_line_is_scrolled_to_the_cursor() -> None:
    wide = "double n; n := " + " + ".join(str(i) for i in range(1, 60)) + "; skip;"
    timeline = alone(wide)
    for steps in (0, 40, 100, 117):
        point = after(timeline, at_tick(timeline, 1, 0.2), steps)
        rows = program_rows(point, 40, 12)
        assert len(lit(rows)) == 2
        if steps == 117:  # the whole assignment, from its first character on
            assert lit(rows)[1].startswith("n := 1 + 2")


def test_wide_and_strange_characters_keep_the_width_and_the_cursor() -> None:
    timeline = alone("double n; // 漢字 e\u0301 \u200b\n\tn := 1;\t\tprint n; skip;")
    rows = program_rows(after(timeline, at_tick(timeline, 1, 0.2), 2), 40, 8)
    assert all(cells(row.text) == 40 for row in rows)
    assert lit(rows)[1] == "n"


def test_a_program_between_two_ticks_waits(past: Timeline) -> None:
    rows = program_rows(machine_of(past.at(1.1), 1), 50, 16, name="red")
    assert rows[0].text.rstrip() == "red program: waits for its next tick"
    assert "  n  = 4.0" in text(rows)
    assert lit(rows) == [" >3  ", "true"]


def test_who_has_no_program_has_an_empty_pane(past: Timeline) -> None:
    assert machine_of(past.world, 2) is None
    assert machine_of(past.world, 77) is None
    assert program_rows(None, 20, 2)[0].text == "no program".ljust(20)


@pytest.mark.parametrize(
    ("source", "fuel", "state"),
    [
        ("double x; skip; x := getx null; skip;", 1000, "program: halted: getx null (line 1)"),
        ("skip; print 1;", 1000, "program: ended"),
        ("while (true) {}", 50, "program: out of fuel"),
    ],
)
def test_why_a_program_does_not_run(source: str, fuel: int, state: str) -> None:
    timeline = alone(source, fuel=fuel)
    tick = tick_at(timeline, 1, 0.4)
    rows = program_rows(Point(tick, len(tick.steps)), 60, 10)
    assert rows[0].text.rstrip() == state


def test_of_many_variables_those_that_changed_come_first() -> None:
    names = [f"v{i:02}" for i in range(20)]
    source = "".join(f"double {n};" for n in names) + "v17 := 1; v03 := 2; skip;"
    timeline = alone(source)
    tick = tick_at(timeline, 1, 0.2)
    rows = program_rows(Point(tick, len(tick.steps)), 40, 14)
    assert "* v03 = 2.0" in text(rows)
    assert "* v17 = 1.0" in text(rows)
    assert "more" in text(rows)


def test_the_last_printed_lines_are_shown() -> None:
    timeline = alone("print 1; print 2; print 3; print 4; print 5; print 6; print 7; skip;")
    tick = tick_at(timeline, 1, 0.2)
    rows = program_rows(Point(tick, len(tick.steps)), 40, 14)
    printed = [row.text.split()[1] for row in rows if row.text.startswith("print ")]
    assert printed == ["6.0", "7.0"]


# Breakpoints.


def all_statements(timeline: Timeline) -> list[Point]:
    point: Point | None = at_tick(timeline, 1, 0.2)
    found = []
    while point is not None and point.step < len(point.tick.steps):
        found.append(point)
        point = next_statement(timeline, point)
    return found


def keys(points: list[Point]) -> list[tuple[Place, int]]:
    return [(point.tick.place, point.step) for point in points]


def chain(
    timeline: Timeline, breakpoints: list[Breakpoint], start: Point, step: int
) -> list[Point]:
    """All points one comes to by running on and on."""
    points = []
    found = next_break(timeline, breakpoints, start, step)  # type: ignore[arg-type]
    while found.point is not None:
        points.append(found.point)
        found = next_break(timeline, breakpoints, found.point, step)  # type: ignore[arg-type]
    assert found.exhausted
    return points


def when(timeline: Timeline, text: str) -> When:
    e = timeline.first.world[1]
    assert isinstance(e, Ship)
    return When(condition(text, e))


def test_a_breakpoint_on_a_line_stops_at_each_statement_that_begins_there(past: Timeline) -> None:
    points = all_statements(past)
    wanted = [p for p in points if p.statement.line == 7]
    assert len(wanted) > 15
    assert keys(chain(past, [AtLine(7)], points[0], 1)) == keys(wanted)


def test_a_condition_stops_where_it_becomes_true(past: Timeline) -> None:
    found = next_break(past, [when(past, "n % 4 == 2")], at_tick(past, 1, 0.2))
    assert found.point is not None
    assert found.point.variables["n"] == 2.0
    assert found.point.statement.line == 5
    values = [
        p.variables["n"] for p in chain(past, [when(past, "n % 4 == 2")], at_tick(past, 1, 0.2), 1)
    ]
    assert values == [2.0, 6.0, 10.0]


def test_a_condition_on_the_world_stops_at_the_next_statement(past: Timeline) -> None:
    found = next_break(past, [when(past, "it != null && getx it > 110")], at_tick(past, 1, 0.2))
    assert found.point is not None
    assert found.point.tick.time == pytest.approx(1.4)  # 8 km/s from 100 km on
    assert found.ticks == 7


@pytest.mark.parametrize("budget", [None, 0])
@pytest.mark.parametrize("what", ["line", "condition", "both"])
def test_running_back_comes_to_the_points_that_running_on_comes_to(
    past: Timeline, what: str, budget: int | None
) -> None:
    timeline = past if budget is None else past.thin(budget)
    points: list[Breakpoint] = []
    if what != "condition":
        points.append(AtLine(8))
    if what != "line":
        points.append(when(timeline, "n % 3 == 2"))
    first = at_tick(timeline, 1, 0.2)
    onwards = chain(timeline, points, first, 1)
    tick = tick_at(timeline, 1, 3.1)
    back = chain(timeline, points, Point(tick, len(tick.steps)), -1)
    assert keys(back)[::-1] == keys(onwards)
    assert len(onwards) > 3
    assert all(a < b for a, b in pairwise(keys(onwards)))


def test_a_search_is_bounded_and_says_how_far_it_came(past: Timeline) -> None:
    start = at_tick(past, 1, 0.2)
    never = [AtLine(99)]
    found = next_break(past, never, start, ticks=4)
    assert (found.point, found.ticks, found.exhausted) == (None, 4, False)
    assert found.last.time == pytest.approx(0.8)
    rest = next_break(past, never, start, ticks=1000)
    assert (rest.ticks, rest.exhausted) == (15, True)
    for ticks in (0, -1, True, 2.0):
        with pytest.raises(ModelError, match="at least 1 tick"):
            next_break(past, never, start, ticks=ticks)  # type: ignore[arg-type]


# Another program from here on.


def edited(timeline: Timeline, ship: int, text: str, at: float) -> Edited:
    """All of it at once."""
    work = editing(timeline, ship, machine(text), at)
    while True:
        try:
            next(work)
        except StopIteration as stop:
            result: Edited = stop.value
            return result


def test_an_edited_program_runs_from_here_and_the_first_difference_is_shown() -> None:
    timeline = fought()
    outcome = edited(timeline, 1, PILOT.replace("turn 0.5", "turn 0.6"), 0.0)
    assert outcome.old == "main"
    assert outcome.timeline.name == "2"
    assert outcome.timeline.world.clock == timeline.world.clock
    assert outcome.parted is not None
    assert outcome.parted.time == pytest.approx(
        1.0
    )  # the third round: thrust, off, thrust, off, turn
    assert outcome.timeline.switch("main").world == timeline.world


def test_the_same_program_from_its_beginning_does_the_same() -> None:
    timeline = fought()
    for _ in range(2):
        outcome = edited(timeline, 2, "while (true) { fire; skip; turn 0.4; } // same", 0.0)
        assert outcome.parted is None
        assert (outcome.given, outcome.left_out) == (1, ())
        assert (
            first_difference(outcome.timeline, "main", outcome.timeline.name, by=outwardly) is None
        )
        timeline = fought("smooth")


@pytest.mark.parametrize("model", ["robust", "smooth", "spec"])
def test_inputs_of_others_are_given_again_at_their_places(model: str) -> None:
    world = world_of(
        ship(100.0, 100.0, program=machine("skip;")), ship(800.0, 800.0, mass=1e16), model=model
    )
    timeline = begin(world).act(2, Thrust())
    for i in range(8):
        timeline = timeline.evolve(0.15).act(2, Turn(0.1 * i)).evolve(0.1)
    timeline = timeline.add(rock(500.0, 500.0)).evolve(0.3).remove(3).act(2, Fire()).evolve(1.0)
    outcome = edited(timeline, 1, "print 1; skip;", 0.0)
    assert outcome.given == 11  # thrust came before
    assert outcome.left_out == ()
    assert outcome.parted is None
    assert outcome.timeline.world[2] == timeline.world[2]
    assert outcome.timeline.world.bullets == timeline.world.bullets


def test_what_makes_no_sense_any_more_is_left_out_and_why() -> None:
    world = world_of(
        ship(100.0, 100.0, program=machine("skip;"), name="red"), ship(500.0, 100.0, name="blue")
    )
    timeline = begin(world).evolve(0.5).act(1, Turn(1.0))  # of the ship whose program is edited
    timeline = timeline.evolve(3.0).act(2, Fire()).evolve(0.1)  # blue will be dead by then
    outcome = edited(timeline, 1, "fire;", 0.0)
    assert 2 not in outcome.timeline.world
    reasons = [each.reason for each in outcome.left_out]
    assert reasons == [
        "it was meant for the ship whose program was edited",
        "there is no entity with id 2 in this world",
    ]
    assert [each.place.time for each in outcome.left_out] == [0.5, 3.5]


def test_an_entity_that_an_input_brings_again_keeps_its_inputs_under_its_new_id() -> None:
    timeline = begin(world_of(ship(100.0, 100.0, program=machine("skip;"))))
    timeline = timeline.evolve(1.0).add(ship(700.0, 700.0, name="late")).act(2, Turn(1.0))
    timeline = timeline.evolve(1.0).remove(2).evolve(1.0)
    outcome = edited(timeline, 1, "fire;", 0.0)  # its bullet has id 2
    assert outcome.left_out == ()
    assert outcome.given == 3
    late = outcome.timeline.at(1.5).ships[-1]
    assert (late.name, late.direction) == ("late", 1.0)
    assert [e.id for e in outcome.timeline.world.ships] == [1]


def test_what_came_to_be_later_may_be_another_one() -> None:
    timeline = begin(world_of(ship(100.0, 100.0, program=machine("skip; fire;"))))
    timeline = timeline.evolve(1.0).remove(2).evolve(1.0)
    outcome = edited(timeline, 1, "skip; fire;", 0.0)
    (left,) = outcome.left_out
    assert left.reason == "#2 came to be after the lines part, so it may be another one"


def test_an_edit_in_a_branch_may_lie_before_it() -> None:
    timeline = fought().branch(6.0, "left").act(2, Turn(1.0)).evolve(3.0)
    outcome = edited(timeline, 1, PILOT.replace("turn 0.5", "turn 0.6"), 2.0)
    assert outcome.old == "left"
    assert outcome.timeline.line.parent == "main"
    assert outcome.timeline.world.clock == timeline.world.clock
    assert [each.what for each in outcome.left_out] == [Act(1, Fire())]
    assert outcome.given == 1
    assert outcome.parted is not None
    assert outcome.parted.time > 2.0


def test_the_future_comes_in_pieces_and_can_be_given_up() -> None:
    timeline = fought("smooth")
    work = editing(timeline, 2, machine("skip;"), 1.0)
    assert next(work) == 2.0
    assert next(work) == 3.0
    work.close()
    assert set(timeline.lines) == {"main"}
