"""The panes of time travel on any past: exact sizes, answers of the timeline itself, one account of each past."""

from __future__ import annotations

from typing import Literal

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fasteroids import ModelError
from fasteroids.history import (
    Lived,
    Place,
    Point,
    Timeline,
    at_tick,
    begin,
    events_of,
    last_change,
    next_step,
    ticks_of,
    why,
)
from fasteroids.history.living import Told, cuts_decide
from fasteroids.lang.report import cells
from fasteroids.testing import actions, unfold
from fasteroids.testing.runs import FOREVER
from fasteroids.testing.strategies import machines
from fasteroids.tui.breakpoints import AtLine, next_break
from fasteroids.tui.chronicle import FIELDS, Chronicle, chronicle_of
from fasteroids.tui.edits import editing
from fasteroids.tui.inspector import entity_rows
from fasteroids.tui.program_pane import machine_of, program_rows
from fasteroids.tui.rows import Row
from fasteroids.tui.strip import Stretch, strip, whole
from fasteroids.tui.verdicts import death_of, death_rows
from tests.properties.laws import BURNING, EXAMPLES, FLOWING
from tests.unit.making import rock, ship, world_of

pane_law = settings(max_examples=min(1_000, max(EXAMPLES // 10, 5)))

EVENTS = 12


def gone_on(timeline: Timeline, events: int, part: float) -> Timeline:
    """Time goes on up to a few events from now, or less."""
    try:
        log = unfold(timeline.world, until=FOREVER, events=events + 1).log
        end = log[-1].time if len(log) == events + 1 else timeline.world.time + 1.0
        until = timeline.world.time + part * (end - timeline.world.time)
        return timeline.evolve_until(min(until, end))
    except ModelError:  # jammed: see L14
        return timeline


@st.composite
def growths(draw: st.DrawFn, world: st.SearchStrategy[object] = BURNING) -> list[Timeline]:
    """A past as it grows: runs, actions, branches, switches, bookmarks and thinning, one after another."""
    timeline = begin(draw(world))  # type: ignore[arg-type]
    found = [timeline]
    for _ in range(draw(st.integers(1, 8))):
        match draw(
            st.sampled_from(["run", "run", "run", "act", "branch", "switch", "thin", "mark"])
        ):
            case "run":
                timeline = gone_on(
                    timeline, draw(st.integers(0, EVENTS)), draw(st.floats(0.0, 1.0))
                )
            case "act":
                ships = timeline.world.ships
                if ships:
                    actor = draw(st.sampled_from(ships)).id
                    try:
                        timeline = timeline.act(actor or 0, draw(actions()))
                    except ModelError:
                        continue
            case "branch":
                timeline = timeline.branch(draw(times(timeline)))
            case "switch":
                timeline = timeline.switch(draw(st.sampled_from(sorted(timeline.lines))))
            case "mark":
                timeline = timeline.bookmark("here", draw(times(timeline)))
            case "thin":
                timeline = timeline.thin(draw(st.sampled_from([0, 4000])))
        found.append(timeline)
    return found


def times(timeline: Timeline) -> st.SearchStrategy[float]:
    """Times of a past."""
    first, last = timeline.first.world.time, timeline.world.time
    return st.floats(0.0, 1.0).map(lambda part: min(first + part * (last - first), last))


def told(chronicle: Chronicle, timeline: Timeline) -> dict[object, object]:
    """All that a chronicle says of a past."""
    ids = range(1, timeline.world.roster.next_id)
    keys: list[object] = ["event", "death", "stop", "shot", "contact", "input", *ids]
    keys += [(i, name) for i in ids for name in (*FIELDS, "contact")]
    return {key: tuple(chronicle.entries(key)) for key in keys}  # type: ignore[arg-type]


def at(timeline: Timeline, time: float) -> tuple[Lived, float]:
    world = timeline.at(time)
    return timeline.state(Place.end_of(world.now)), time


def sized(rows: tuple[Row, ...], width: int, height: int | None = None) -> None:
    assert height is None or len(rows) == height
    for row in rows:
        assert cells(row.text) == width
        end = 0
        for start, stop, _ in row.runs:
            assert end <= start < stop <= len(row.text)
            end = stop


@given(growths())
@pane_law
def test_followed_as_it_grows_an_account_is_what_it_would_be_made_anew(
    pasts: list[Timeline],
) -> None:
    chronicle = chronicle_of(pasts[0])
    for timeline in pasts:
        chronicle = chronicle.followed(timeline)
        assert told(chronicle, timeline) == told(chronicle_of(timeline), timeline)


@given(growths(FLOWING), st.data())
@pane_law
def test_an_account_says_what_the_timeline_says(pasts: list[Timeline], data: st.DataObject) -> None:
    timeline = pasts[-1]
    chronicle = chronicle_of(timeline)
    ids = range(1, timeline.world.roster.next_id)
    assume(ids)
    entity = data.draw(st.sampled_from(ids))
    lived = [(s.place, s.what) for s in events_of(timeline, entity)]
    assert list(chronicle.entries(entity)) == lived
    place, _ = at(timeline, data.draw(times(timeline)))
    for name in FIELDS:
        known = last_change(timeline, entity, name, before=Place.end_of(place.place.moment))
        mine = chronicle.last_change(entity, name, place.place)
        assert (mine and mine.place) == (known and known.state.place)


@given(
    growths(), st.data(), st.integers(1, 120), st.integers(0, 40), st.booleans(),
    st.sampled_from([1, 2]),
)  # fmt: skip
@pane_law
def test_the_panes_of_any_past_have_exactly_their_size(
    pasts: list[Timeline], data: st.DataObject, width: int, height: int, unicode: bool,
    rows: Literal[1, 2],
) -> None:  # fmt: skip
    timeline = pasts[-1]
    chronicle = chronicle_of(timeline)
    time = data.draw(times(timeline))
    state, _ = at(timeline, time)
    world = timeline.at(time)
    ids = timeline.world.roster.next_id
    for entity in range(1, min(ids, 12) + 1):
        pane = entity_rows(chronicle, world, state.place, entity, width, height)
        sized(pane, width, height)
        lived = {s.place for s in events_of(timeline, entity)} if entity < ids else set()
        if not cuts_decide(world):  # else whatever happens changes who thrusts
            assert {row.place for row in pane} - {None} <= lived
        sized(program_rows(machine_of(world, entity), width, height), width, height)
    inner = whole(timeline).zoomed(time, 0.25, whole(timeline))
    for stretch in (whole(timeline), inner):
        assert stretch.start <= time <= stretch.end
        shown = strip(chronicle, timeline, stretch, time, width, height=rows, unicode=unicode)
        sized(shown.rows, max(width, 1), rows)
        for column in range(shown.left, shown.left + shown.columns):
            place = shown.place_at(column)
            if place is not None:
                assert stretch.start <= place.time <= stretch.end
                assert shown.column_at(place.time) == column


@given(growths(), st.integers(12, 100))
@pane_law
def test_each_death_is_told_and_leads_to_its_moments(pasts: list[Timeline], width: int) -> None:
    timeline = pasts[-1]
    chronicle = chronicle_of(timeline)
    for entity in {i for _, what in chronicle.entries("death") for i in what.died}:  # type: ignore[union-attr]
        found = death_of(timeline, entity)
        assert found.death == why(timeline, entity)
        rows = death_rows(found, width)
        sized(rows, width)
        assert {found.death.place, found.inevitable} <= {row.place for row in rows}
        for way, course in zip(found.paths, found.death.courses, strict=True):
            assert way.points[-1] == course.entity.position
            assert way.id == course.entity.id


PILOTED = st.builds(
    lambda pilot, other: world_of(
        ship(500.0, 500.0, program=pilot), ship(200.0, 200.0, program=other), rock(700.0, 520.0), fuel=60
    ),
    machines(), machines(),
)  # fmt: skip


@given(growths(PILOTED), st.integers(1, 6), st.integers(1, 2))
@pane_law
def test_every_step_of_a_program_has_a_pane_and_running_back_undoes_running_on(
    pasts: list[Timeline], line: int, who: int
) -> None:
    timeline = gone_on(pasts[-1], EVENTS, 0.9)
    tick = next(ticks_of(timeline, who), None)
    assume(tick is not None)
    assert tick is not None
    point: Point | None = at_tick(timeline, who, tick.place)
    steps = 0
    while point is not None and steps < 60:
        sized(program_rows(point, 50, 20, lines={line}), 50, 20)
        found = next_break(timeline, [AtLine(line)], point, ticks=5)
        if found.point is not None:
            assert found.point.statement.line == line
            back = next_break(timeline, [AtLine(line)], found.point, -1, ticks=6)
            if point.begins and point.statement.line == line:
                assert back.point is not None
                assert (back.point.tick.place, back.point.step) == (point.tick.place, point.step)
        steps += 1
        point = next_step(timeline, point)


@given(growths(), st.data())
@pane_law
def test_a_future_edited_to_what_it_was_is_the_same_but_for_what_was_left_out(
    pasts: list[Timeline], data: st.DataObject
) -> None:
    """The edited ship gets the program it has: the line from the beginning is lived again, others' inputs included."""
    timeline = pasts[-1]
    first = timeline.first.world
    ships = [each for each in first.ships if each.program is not None and each.program.running]
    assume(ships)
    edited = data.draw(st.sampled_from(ships))
    work = editing(timeline, edited.id or 0, edited.program, timeline.first.place)  # type: ignore[arg-type]
    while True:
        try:
            next(work)
        except StopIteration as stop:
            outcome = stop.value
            break
    inputs = [s for s in timeline.forwards(timeline.first.place) if isinstance(s.what, Told)]
    assert outcome.given + len(outcome.left_out) == len(inputs)
    assert outcome.timeline.world.now == timeline.world.now
    if not outcome.left_out:
        assert outcome.parted is None
        assert outcome.timeline.world.all_flights() == timeline.world.all_flights()


def test_a_stretch_deep_in_time_is_drawn() -> None:
    stretch = Stretch(1e12, 1e12 + 10.0)
    assert stretch.zoomed(1e12 + 5.0, 0.001, stretch).span > 0.0
