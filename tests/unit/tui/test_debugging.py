"""Stepping, breakpoints, other programs: what the debugger does to a session, and where it comes in."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import pytest
from attrs import evolve

from fasteroids import Asteroid, Fire, ModelError, World
from fasteroids.history import Timeline, begin, next_statement, previous_statement
from fasteroids.lang import Diagnostic
from fasteroids.tui import debugging as d
from fasteroids.tui import session as s
from fasteroids.tui.breakpoints import AtLine, When
from fasteroids.tui.chronicle import chronicle_of
from fasteroids.tui.commanding import commanded, victim
from fasteroids.tui.game import ruled
from fasteroids.tui.keys import Command
from fasteroids.tui.picture import pane
from fasteroids.tui.rewriting import checked, compared, rewriting, sentence, source_of
from fasteroids.tui.session import Session
from fasteroids.tui.visiting import visited
from tests.unit.making import machine, rock, ship, world_of

COUNTER = """\
double n;
while (true) {
  n := n + 1;
  print n;
  if (n == 7) { turn 0.5; }
  skip;
}
"""
TURNS, SKIPS = 5, 6  # lines

Way = Literal[1, -1]


def world(text: str = COUNTER, *, other: str | None = None) -> World:
    """A ship with a program, and one with another or none, far from each other."""
    second = machine(other) if other else None
    return world_of(
        ship(500.0, 500.0, program=machine(text), name="red"),
        ship(100.0, 100.0, name="blue", program=second),
    )


def fresh(text: str = COUNTER, **given: str) -> Session:
    begun = world(text, **given)
    return evolve(s.opened(begun, ruled(begun, 0)), running=0)


def lived(seconds: float, text: str = COUNTER, **given: str) -> Session:
    return s.lived_on(fresh(text, **given), seconds)


def searched(session: Session, way: Way) -> Session:
    """A search to its end."""
    session = d.run(session, way)
    for _ in range(1000):
        if session.seek is None:
            return session
        session = d.sought(session)
    raise AssertionError(session.said)


def where(session: Session) -> tuple[float, int, int]:
    """The tick, the step and the line where the debugger stands."""
    point = d.here(session)
    assert point is not None
    return round(point.tick.time, 6), point.step, point.statement.line


# Stepping.


def test_one_comes_to_stand_behind_the_last_tick_that_one_sees() -> None:
    session = lived(1.1)
    point = d.here(session)
    assert point is not None
    assert point.step == len(point.tick.steps)
    assert round(point.tick.time, 6) == 1.0
    back = d.statement(session, -1)
    assert not back.live
    assert where(back)[::2] == (1.0, SKIPS)


def test_every_statement_back_is_one_that_steps_forward_again() -> None:
    session, found = lived(2.1), []
    while (back := d.statement(session, -1)).said != "the program begins here":
        found.append(where(back))
        session = back
    assert found[-1] == (0.2, 0, 2)
    again = [where(session)]
    for _ in found[1:]:
        session = d.statement(session, 1)
        again.append(where(session))
    assert again == found[::-1]


def test_steps_are_those_of_the_past_and_the_world_one_sees_is_the_one_the_program_sees() -> None:
    session = d.statement(lived(2.1), -1)
    for way in (-1, -1, 1, -1):
        point = session.point
        assert point is not None
        follow: Callable[..., object] = next_statement if way > 0 else previous_statement
        expected = follow(session.timeline, point)
        session = d.statement(session, way)
        assert session.point == expected
        assert session.point is not None
        before = session.point.tick.before
        assert session.world.all_flights() == before.all_flights()


def test_behind_the_end_time_goes_on_to_the_next_tick() -> None:
    session = fresh()
    assert d.here(session) is None
    assert d.statement(session, -1).said == "the program begins here"
    session = d.statement(session, 1)
    assert where(session) == (0.2, 0, 2)
    while where(session)[0] < 2.0:
        session = d.statement(session, 1)
    assert session.timeline.world.time == pytest.approx(2.0)


def test_in_the_past_a_program_that_has_not_run_yet_begins_where_it_did() -> None:
    session = lived(2.0)
    early = s.look_at(session, 0.1)
    assert where(d.statement(early, 1)) == (0.2, 0, 2)
    assert d.statement(early, 1).timeline is session.timeline


def test_a_program_that_ends_is_stepped_to_its_end_and_no_further() -> None:
    session = fresh("print 1; skip; print 2;")
    seen = []
    for _ in range(20):
        session = d.statement(session, 1)
        seen.append(session.said)
    assert seen[-2:] == ["the program has come to its end"] * 2


def test_a_dead_ship_is_stepped_back_from_its_death() -> None:
    doomed = world_of(ship(200.0, 200.0, program=machine(COUNTER)), rock(300.0, 200.0, vx=-100.0))
    session = s.lived_on(evolve(s.opened(doomed, ruled(doomed, 0)), running=0), 3.0)
    session = evolve(session, selected=1)
    assert 1 not in session.world
    assert d.statement(session, 1).said == "ship #1 is dead here"
    back = d.statement(session, -1)
    assert 1 in back.world
    assert back.point is not None
    assert d.statement(evolve(session, selected=None), -1).said.startswith("no ship here runs")


# Breakpoints.


def test_a_breakpoint_on_a_line_is_set_and_removed_where_one_stands() -> None:
    session = d.toggled(d.statement(lived(1.1), -1))
    assert d.breakpoints_of(session, 1) == (AtLine(SKIPS),)
    assert session.said == f"breakpoint on line {SKIPS}"
    assert d.breakpoints_of(d.toggled(session), 1) == ()
    unborn = d.toggled(fresh())
    assert d.breakpoints_of(unborn, 1) == (AtLine(2),)


def test_a_breakpoint_is_written_as_a_line_or_as_a_condition() -> None:
    session = d.broken_at(d.broken_at(lived(1.1), " 5 "), "n == 3")
    line, when = d.breakpoints_of(session, 1)
    assert line == AtLine(5)
    assert isinstance(when, When)
    assert when.condition.text == "n == 3"
    assert d.breakpoints_of(d.broken_at(session, "n == 3"), 1) == (AtLine(5),)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("0", "the program has the lines 1 to 7; there is no line 0"),
        ("8", "there is no line 8"),
        ("m == 3", "`m` is not declared"),
        ("n := 3", "condition"),
        ("n + 1", "condition"),
    ],
)
def test_a_breakpoint_that_makes_no_sense_is_told(text: str, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        d.broken_at(lived(1.0), text)


def test_breakpoints_are_of_one_ship() -> None:
    session = evolve(lived(1.1, other=COUNTER), selected=1)
    session = d.broken_at(session, "3")
    other = evolve(session, selected=2)
    assert d.run(other, -1).said == "there is no breakpoint"
    assert d.breakpoints_of(d.broken_at(other, "4"), 1) == (AtLine(3),)


def test_back_from_a_breakpoint_and_on_comes_to_it_again() -> None:
    session = d.broken_at(lived(5.1), "n == 4")
    session = searched(session, -1)
    first = where(session)
    assert first[0] == pytest.approx(0.8)
    assert session.said.startswith("breakpoint, line 4 at 0.8 s")
    assert searched(session, -1).said == "no breakpoint back to the beginning"
    assert where(searched(d.statement(session, -1), 1)) == first


def test_all_stops_on_the_way_on_are_those_on_the_way_back() -> None:
    session = d.broken_at(d.broken_at(lived(5.1), f"{TURNS}"), "n == 4")
    back = []
    at = session
    while (at := searched(at, -1)).said.startswith("breakpoint"):
        back.append(where(at))
    on: list[tuple[float, int, int]] = []
    while (at := searched(at, 1)).said.startswith("breakpoint") and len(on) < len(back):
        on.append(where(at))
    assert len(back) > 10
    assert on == back[::-1]


def test_a_search_through_a_long_past_comes_in_pieces_and_can_be_given_up() -> None:
    session = d.broken_at(lived(10.1), "n == 2")
    session = d.run(session, -1)
    times = [session.place.time]
    while session.seek is not None:
        assert session.said.endswith("Esc stops")
        given_up = d.stopped(session)
        assert given_up.seek is None
        assert given_up.place == session.place
        session = d.sought(session)
        times.append(session.place.time)
    assert len(times) > 5
    assert times == sorted(times, reverse=True)
    assert times[-1] == pytest.approx(0.4)


def test_from_the_end_time_lives_on_to_a_breakpoint() -> None:
    session = searched(d.broken_at(fresh(), "n == 40"), 1)
    assert where(session)[0] == pytest.approx(8.2)
    assert session.timeline.world.time == pytest.approx(8.2)
    plain = s.lived_on(fresh(), 8.2)
    assert session.timeline.world.all_flights() == plain.timeline.world.all_flights()


def test_a_search_stops_at_the_end_of_the_past_before_it_lives_on() -> None:
    session = s.look_at(d.broken_at(lived(5.1), "n == 40"), 1.0)
    end = searched(session, 1)
    assert end.said == "no breakpoint on to the end; once more lives on"
    assert end.timeline is session.timeline
    assert where(searched(end, 1))[0] == pytest.approx(8.2)


def test_a_search_ends_with_its_ship_and_with_its_program() -> None:
    doomed = world_of(ship(200.0, 200.0, program=machine(COUNTER)), rock(300.0, 200.0, vx=-100.0))
    session = evolve(s.opened(doomed, ruled(doomed, 0)), running=0)
    assert "died before its next tick" in searched(d.broken_at(session, "n == 90"), 1).said
    short = d.broken_at(fresh("double n; n := 1; skip; n := 2;"), "n == 9")
    assert searched(short, 1).said == "the program has come to its end"


def test_any_other_command_ends_a_search() -> None:
    session = d.run(d.broken_at(lived(10.1), "n == 2"), -1)
    assert session.seek is not None
    after = commanded(session, Command.BACK_FRAME)
    assert after is not None
    assert after.seek is None


# Another program.


def rewritten(session: Session, text: str) -> Session:
    program = checked(text)
    assert not isinstance(program, tuple)
    work = rewriting(session, 1, program)
    while True:
        try:
            next(work)
        except StopIteration as stop:
            new: Session = stop.value
            return new


def test_another_program_makes_another_line_from_where_one_looks() -> None:
    session = s.look_at(lived(6.0), 2.0)
    assert source_of(session) == (1, COUNTER)
    new = rewritten(session, COUNTER.replace("turn 0.5", "fire"))
    assert new.timeline.name == "2"
    assert new.world.time == session.world.time
    assert new.timeline.world.time == session.timeline.world.time
    assert source_of(new) == (1, COUNTER.replace("turn 0.5", "fire"))
    assert s.ghost(new) == session.world
    assert new.compared is not None
    assert new.compared.parted is not None
    assert new.compared.parted.time == pytest.approx(3.4)
    assert new.said == "line 2 with the other program: they part at 3.40 s"
    shown = "\n".join(row.text for row in pane(new, chronicle_of(new.timeline), 40, 30))
    assert "lines main and 2" in shown
    assert "They part at 3.400 s." in shown


def test_the_new_line_is_judged_as_if_it_had_been_played() -> None:
    session = s.look_at(lived(3.0), 1.0)
    hits = rewritten(session, "turn 0 - 2.35619449; skip; while (true) { fire; skip; }")
    played = s.played(hits).game
    assert [p.name for p in played.players] == [p.name for p in session.game.players]
    anew = s.reviewed(hits.timeline, game=session.games["main"][0][1])
    assert s.played(anew).game == played


def test_conditions_go_where_their_variables_go() -> None:
    session = d.broken_at(d.broken_at(d.broken_at(lived(3.0), "n == 4"), "2"), "getx self < 0")
    new = rewritten(session, "skip; skip;")
    kept = d.breakpoints_of(new, 1)
    assert [type(each) for each in kept] == [AtLine, When]
    same = rewritten(session, COUNTER)
    assert len(d.breakpoints_of(same, 1)) == 3


def test_a_text_with_errors_flies_not_and_each_is_a_sentence_with_its_place() -> None:
    found = checked("double n;\nn := m;\nfirre;")
    assert isinstance(found, tuple)
    assert all(isinstance(each, Diagnostic) for each in found)
    assert sentence(found[0]).startswith("line 2, column 6: `m` is not declared")
    assert sentence(found[-1]).startswith("line 3, column 1: ")


def test_the_difference_of_a_line_is_shown_and_hidden() -> None:
    session = lived(3.0)
    assert compared(session).said == "this line branched off no other"
    other = s.take_over(s.look_at(session, 1.0))
    other = s.beat(other, 0.2, [(2, Fire())])
    told = compared(other)
    assert told.compared is not None
    assert told.compared.parted is not None
    assert told.compared.parted.time == pytest.approx(1.0)
    assert told.said == "the lines main and 2 part at 1.00 s"
    assert compared(told).compared is None
    same = s.beat(s.take_over(s.look_at(session, 1.0)), 0.2)
    assert compared(same).said == "the lines main and 2 do the same so far"


# Prints.


def test_the_last_prints_up_to_where_one_looks_are_in_the_pane() -> None:
    session = evolve(s.look_at(lived(5.0), 3.1), selected=1)
    rows = pane(session, chronicle_of(session.timeline), 40, 40)
    told = [row for row in rows if row.place is not None and "print" in row.text]
    assert [row.text.split() for row in told][-1] == ["2.800", "s", "print", "13.0"]
    assert all(row.place is not None and row.place < session.place for row in told)
    assert any(row.text.startswith("print 14.0") for row in rows)


# Coming in.


def past(seconds: float = 3.0) -> Timeline:
    """Red is hit by a rock after some 1.6 s."""
    begun = world_of(
        ship(200.0, 200.0, program=machine(COUNTER), name="red"),
        ship(800.0, 800.0, program=machine(COUNTER), name="blue"),
        Asteroid(400.0, 200.0, -100.0, 0.0, 20.0),
    )
    return begin(begun).evolve(seconds)


def test_a_recording_opens_at_its_end_or_where_the_ship_is_about_to_die() -> None:
    timeline = past()
    end = visited(s.reviewed(timeline))
    assert end.place == timeline.last.place
    assert end.selected == 2
    red = visited(s.reviewed(timeline), who="red")
    assert red.selected == 1
    assert 1 in red.world
    assert red.place.time == pytest.approx(timeline.forwards(red.place).__next__().world.time)
    assert 1 not in s.jump(red, "death", 1).world
    assert d.here(red) is not None
    assert visited(s.reviewed(timeline), who="blue").place == timeline.last.place


def test_the_one_who_is_about_to_die_is_who_why_asks_about() -> None:
    red = visited(s.reviewed(past()), who="red")
    assert victim(red) == 1
    told = commanded(red, Command.WHY)
    assert told is not None
    assert told.fate is not None


def test_a_recording_opens_at_a_time() -> None:
    session = visited(s.reviewed(past()), 1.0, "#2")
    assert session.world.time == 1.0
    assert (session.selected, session.running) == (2, 0)


def test_a_scene_opens_in_a_pause_and_lives_up_to_a_time_first() -> None:
    begun = world()
    assert visited(s.opened(begun, ruled(begun, 0))).timeline.world == begun
    session = visited(s.opened(begun, ruled(begun, 0)), 2.0)
    assert (session.world.time, session.running, session.selected) == (2.0, 0, 1)
    assert session.timeline.world.all_flights() == begin(begun).evolve(2.0).world.all_flights()


@pytest.mark.parametrize(
    ("at", "who", "told"),
    [
        (3.5, None, r"this recording goes from 0.0 s to 3.0 s; there is no 3.5 s in it"),
        (None, "rad", r"there is no ship 'rad' \(did you mean 'red'\?\); there are red, blue"),
        (None, "3", r"there is no ship '3'"),
    ],
)
def test_what_is_not_there_is_told(at: float | None, who: str | None, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        visited(s.reviewed(past()), at, who)


def test_a_scene_without_ships_or_programs_opens_too() -> None:
    empty = World(100.0, 100.0)
    session = visited(s.opened(empty, ruled(empty, 0)))
    assert session.selected is None
    assert d.statement(session, 1).said.startswith("no ship here runs a program")
    drones = world_of(ship(100.0, 100.0, name="drone"))
    assert visited(s.opened(drones, ruled(drones, 0))).selected == 1
