"""Timelines: any moment again, branches, bookmarks, a budget; and what is refused, with a sentence."""

from __future__ import annotations

import copy
import pickle
import random
import tracemalloc

import pytest

from fasteroids import (
    Asteroid,
    Fire,
    ModelError,
    Ship,
    Thrust,
    Turn,
    World,
    check_program,
    evolve_until,
    load_scene,
    parse_program,
)
from fasteroids.history import MAIN, Act, Cut, Place, Timeline, Told, begin
from fasteroids.history.recording import Recorder, read, verified
from fasteroids.history.recording.loading import recorded
from tests.unit.history.pasts import arena

SCENE = """
[world]
width = 1400
height = 1000
seed = 1
model = "smooth"

[[ship]]
x = 300
y = 700
radius = 20
mass = 5e15
program-text = "while (true) { turn 0.3; fire; thrust; skip; thrust_off; }"

[[ship]]
x = 1200
y = 700
radius = 20
mass = 5e15

[[asteroid-field]]
count = 28
radius = [10, 40]
speed = [60, 160]
clear = 20
"""


def game() -> World:
    """Two ships, of which the first has a program, among asteroids; thrust is smooth."""
    return load_scene(SCENE)


def drifting() -> World:
    """A ship (1) that drifts, thruster on, in empty space; thrust is literal."""
    return World(10_000, 10_000).add(Ship(500, 500, 1, 2, 10, 5e15, 0.3, thruster=True))


def framed(world: World, seconds: float, *, budget: int, rate: int = 30) -> Timeline:
    """A timeline cut so often a second."""
    timeline = begin(world, budget=budget)
    for k in range(1, round(seconds * rate) + 1):
        timeline = timeline.evolve_until(k / rate)
    return timeline


# Any moment.


def test_a_thousand_moments_of_a_thinned_past_are_those_of_evolve_until_from_the_first_world() -> (
    None
):
    first = game()
    timeline = framed(first, 8.0, budget=100_000)
    assert timeline.bytes <= 100_000
    assert any(kept.gap.size for chunk in timeline.line.chunks for kept in chunk.kept)
    draw = random.Random(20_000)
    for _ in range(1_000):
        time = draw.uniform(0.0, 8.0)
        assert timeline.at(time) == evolve_until(first, time)


def test_under_literal_thrust_the_cuts_that_were_made_are_made_again() -> None:
    timeline = begin(drifting())
    lived = [timeline.world]
    for _ in range(20):
        timeline = timeline.evolve(0.1)
        lived.append(timeline.world)
    thinned = timeline.thin(0)
    assert thinned.states == 2
    for world in lived:
        assert thinned.at(world.time).entities == world.entities
    assert thinned.at(1.3).entities != evolve_until(lived[0], 1.3).entities
    between = evolve_until(lived[5], 0.55)
    assert thinned.at(0.55) == timeline.at(0.55) == between


def test_a_moment_comes_after_all_that_happened_at_it() -> None:
    timeline = begin(game()).evolve_until(1.0).act(2, Turn(1.0)).act(2, Fire())
    assert timeline.at(1.0).entities == timeline.world.entities
    assert timeline.last.place == Place(0, 1.0, 3), "the tick of the other ship, and two inputs"
    assert [s.place.nth for s in timeline.backwards(timeline.last.place)][:4] == [3, 2, 1, 1]


def test_the_first_and_the_last_moment_belong_to_a_past() -> None:
    first = evolve_until(game(), 1.0)
    timeline = begin(first).evolve(1.0)
    assert timeline.at(1.0) == first
    assert timeline.at(2.0) == timeline.world
    for time in (0.9, 2.1):
        with pytest.raises(ModelError, match=r"this past goes from 1\.0 s to 2\.0 s"):
            timeline.at(time)


@pytest.mark.parametrize("time", [float("nan"), float("inf"), -1.0, "soon", None])
def test_what_is_no_time_is_refused(time: object) -> None:
    with pytest.raises(ModelError, match="a time must be"):
        begin(game()).at(time)  # type: ignore[arg-type]


def test_the_past_of_a_world_is_left_by_looking_at_it_as_it_was() -> None:
    timeline = begin(game()).evolve(2.0)
    now = timeline.world
    for time in (0.0, 0.7, 1.3, 2.0):
        evolve_until(timeline.at(time), 5.0)
    assert timeline.world is now
    assert timeline.evolve(1.0).world == evolve_until(game(), 3.0)


def test_time_goes_on_as_evolve_lets_it_with_the_rounding_of_steps_carried() -> None:
    timeline, world = begin(game()), game()
    for _ in range(10):
        timeline = timeline.evolve(0.1)
    assert timeline.world.time == 1.0
    assert timeline.world.entities == evolve_until(world, 1.0).entities


def test_time_does_not_go_back() -> None:
    timeline = begin(game()).evolve(1.0)
    with pytest.raises(ModelError, match=r"come to 1\.0 s already; branch to live on from 0\.5 s"):
        timeline.evolve_until(0.5)
    assert timeline.evolve_until(1.0).world == timeline.world


# Inputs.


def test_inputs_are_a_part_of_the_past() -> None:
    program = check_program(parse_program("turn 1; fire;")).program
    assert program is not None
    timeline = (
        begin(game())
        .evolve(0.5)
        .act(2, Thrust())
        .evolve(0.5)
        .instruct(2, program)
        .add(Asteroid(700, 980, 0, 0, 5))
        .evolve(0.5)
        .remove(3)
        .evolve(0.5)
    )
    told = [s for s in timeline.forwards(timeline.first.place) if isinstance(s.what, Told)]
    assert [s.place.time for s in told] == [0.5, 1.0, 1.0, 1.5]
    assert [(s.died, s.born) for s in told] == [((), ()), ((), ()), ((), told[2].born), ((3,), ())]
    thinned = timeline.thin(0)
    assert thinned.states == 2
    for k in range(21):
        assert thinned.at(k / 10) == timeline.at(k / 10)


def test_an_input_that_makes_no_sense_is_refused_and_leaves_no_trace() -> None:
    timeline = begin(game())
    with pytest.raises(ModelError, match="no entity with id 99"):
        timeline.act(99, Fire())
    with pytest.raises(ModelError, match="overlap"):
        timeline.add(Asteroid(300, 700, 0, 0, 5))
    assert timeline.states == 1


def test_a_shot_into_what_stands_there_tells_both_deaths() -> None:
    world = World(1_000, 1_000).add(Ship(500, 500, 0, 0, 20, 5e15, 0.0))
    world = world.add(Asteroid(525, 500, 0, 0, 4))
    state = begin(world).act(1, Fire()).last
    assert (state.died, state.born) == ((2, 3), (3,))


# Branches.


def test_a_branch_lives_on_from_a_past_moment_and_the_old_future_stays() -> None:
    old = begin(game()).evolve(3.0)
    new = old.branch(1.25, "again").act(2, Fire()).evolve(1.0)
    assert new.world.time == 2.25
    assert new.switch(MAIN).world is old.world
    assert old.name == MAIN
    assert set(old.lines) == {MAIN}
    assert new.at(1.0) == old.at(1.0)
    assert new.at(2.0) != old.at(2.0)
    assert new.lines["again"].parent == MAIN


def test_a_branch_can_begin_between_two_events_of_one_moment() -> None:
    program = check_program(parse_program("while (true) { turn 0.1; }")).program
    world = World(1_000, 1_000).add_all(
        Ship(100 * k, 500, 0, 0, 10, 5e15, 0.0, program=program) for k in (1, 3, 5)
    )
    timeline = begin(world).evolve(0.2)
    first = timeline.branch(Place(0, 0.2, 1))
    assert [ship.direction for ship in first.world.ships] == [0.1, 0.0, 0.0]
    rest = first.act(3, Turn(1.0)).evolve(0.0).thin(0)
    assert [ship.direction for ship in rest.world.ships] == [0.1, 0.1, 1.1]
    places = [s.place.nth for s in rest.forwards(rest.first.place) if not isinstance(s.what, Cut)]
    assert places == [1, 2, 3, 4]


@pytest.mark.parametrize("model", ["smooth", "robust"])
def test_an_input_right_before_a_tick_of_the_same_moment_is_lived_again_there(model: str) -> None:
    program = check_program(parse_program("while (true) { thrust; fire; skip; }")).program
    ship = Ship(300, 500, 20, 0, 10, 5e15, 0.0, program=program)
    old = begin(World(1_000, 1_000, model=model).add(ship)).evolve(1.5)
    new = old.branch(Place(0, 1.0, 0))  # the tick of 1.0 s is still to come
    new = new.act(1, Turn(1.0)).evolve(1.0)
    assert new.at(1.7) == new.thin(0).at(1.7)
    assert verified(read(recorded(new).encode())).difference is None


def test_a_branch_has_the_same_future_however_its_past_was_thinned() -> None:
    full, thin = (begin(load_scene(SCENE), budget=budget) for budget in (2**30, 0))
    times = []
    for _ in range(9):
        full, thin = full.evolve(0.1), thin.evolve(0.1)  # sums that leave something over
        times.append(full.world.time)
    assert thin.states < full.states
    for time in times:
        assert full.branch(time).world == full.at(time) == thin.branch(time).world
        assert full.branch(time).evolve(0.1).world == thin.branch(time).evolve(0.1).world


def test_a_branch_right_before_what_happens_at_a_moment_is_no_cut_there() -> None:
    literal = load_scene(SCENE.replace('"smooth"', '"robust"'))
    old = begin(literal).evolve(1.0)
    new = old.branch(Place(0, 0.6, 0))  # where the tick of 0.6 s is due
    assert new.world.time == 0.6
    assert new.line.first.what is None
    new = new.evolve_until(1.0)
    assert new.world.all_flights() == old.world.all_flights()
    pieces: list[str] = []
    recorder = Recorder(pieces.append, literal)
    for state in new.forwards(new.first.place):
        recorder.add(state)
    recorder.finish(new.world.clock)
    assert verified(read("".join(pieces).encode())).difference is None


def test_branches_of_branches_have_the_past_of_both() -> None:
    one = begin(game()).evolve(1.0)
    two = one.branch(0.5).act(2, Thrust()).evolve(0.5)
    three = two.branch(0.75).act(2, Turn(1.0)).evolve(0.5)
    early = two.branch(0.25)
    assert [three.lines[name].parent for name in (MAIN, "2", "3")] == [None, MAIN, "2"]
    assert early.lines["3"].parent == MAIN
    assert three.at(0.25) == one.at(0.25)
    assert three.at(0.7) == two.at(0.7) != one.at(0.7)
    assert three.at(0.9) != two.at(0.9)
    assert three.first.world is one.first.world


def test_a_branch_needs_a_new_name_and_a_place_of_this_past() -> None:
    timeline = begin(game()).evolve(1.0)
    with pytest.raises(ModelError, match="there is a line 'main' already"):
        timeline.branch(0.5, MAIN)
    with pytest.raises(ModelError, match=r"this past goes from 0\.0 s to 1\.0 s"):
        timeline.branch(1.5)
    with pytest.raises(ModelError, match="no place"):
        timeline.branch(Place(0, 0.123, 1))
    with pytest.raises(ModelError, match="there is no line 'x'; there are main"):
        timeline.switch("x")


# Bookmarks.


def test_a_bookmark_names_a_moment_and_survives_any_thinning() -> None:
    timeline = (
        begin(game()).evolve(2.0).bookmark("start", 0.0).bookmark("shot", 0.75).bookmark("now")
    )
    marks = timeline.thin(0).bookmarks
    assert {name: mark.state.world.time for name, mark in marks.items()} == {
        "start": 0.0, "shot": 0.75, "now": 2.0,
    }  # fmt: skip
    assert marks["shot"].state.world == evolve_until(game(), 0.75)
    assert marks["shot"].line == MAIN
    assert "shot" not in timeline.forget("shot").bookmarks
    with pytest.raises(ModelError, match="there is no bookmark 'x'"):
        timeline.forget("x")


def test_a_bookmark_is_a_place_to_branch_from() -> None:
    timeline = begin(game()).evolve(2.0).bookmark("shot", 0.75)
    again = timeline.branch(timeline.bookmarks["shot"].state.place.time)
    assert again.world == timeline.bookmarks["shot"].state.world


# The budget.


@pytest.mark.parametrize("budget", [3_000_000, 300_000, 30_000])
def test_a_timeline_stays_within_its_budget_as_it_grows(budget: int) -> None:
    timeline = begin(game(), budget=budget)
    for k in range(1, 301):
        timeline = timeline.evolve_until(k / 30)
        assert timeline.bytes <= budget
    assert timeline.first.world == game()
    assert timeline.at(5.0) == evolve_until(game(), 5.0)


def test_a_budget_of_nothing_keeps_the_first_and_the_last_state() -> None:
    timeline = framed(game(), 5.0, budget=0)
    assert timeline.states == 2
    assert timeline.at(2.5) == evolve_until(game(), 2.5)


def test_thinning_spreads_the_price_of_living_again_evenly() -> None:
    timeline = framed(game(), 30.0, budget=150_000)
    gaps = [kept.gap.size for chunk in timeline.line.chunks for kept in chunk.kept]
    happened = sum(gaps) + sum(
        not isinstance(kept.state.what, type(None))
        for chunk in timeline.line.chunks
        for kept in chunk.kept
    )
    assert max(gaps) <= timeline.line.coarse
    assert max(gaps) < happened / 4


def test_the_bytes_it_tells_are_about_those_that_python_takes() -> None:
    first = game()
    framed(first, 1.0, budget=10**9)  # what is made once
    tracemalloc.start()
    try:
        timeline = framed(first, 20.0, budget=10**9)
        taken, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert 0.7 * taken < timeline.bytes < 1.4 * taken


@pytest.mark.parametrize("budget", [-1, 1.5, None, True])
def test_a_budget_is_a_whole_number_of_bytes(budget: object) -> None:
    with pytest.raises(ModelError, match="a budget is a number of bytes"):
        begin(game(), budget=budget)  # type: ignore[arg-type]


# A value.


def test_no_operation_changes_another_timeline() -> None:
    timeline = begin(game()).evolve(1.0)
    states = list(timeline.forwards(timeline.first.place))
    timeline.evolve(1.0)
    timeline.act(2, Fire())
    timeline.branch(0.5).evolve(1.0)
    timeline.bookmark("x")
    timeline.thin(0)
    assert list(timeline.forwards(timeline.first.place)) == states
    assert timeline.world.time == 1.0
    assert not timeline.bookmarks


@pytest.mark.parametrize(
    "copied", [copy.copy, copy.deepcopy, lambda t: pickle.loads(pickle.dumps(t))]
)
def test_copies_and_pickles_have_the_same_past(copied: object) -> None:
    timeline = begin(game()).evolve(1.0).bookmark("x", 0.5).thin(0)
    other = copied(timeline)  # type: ignore[operator]
    assert other.at(0.7) == timeline.at(0.7)
    assert other.bookmarks["x"].state.world == timeline.bookmarks["x"].state.world
    assert other.evolve(1.0).world == timeline.evolve(1.0).world


def test_an_act_is_taken_as_one_of_the_inputs() -> None:
    timeline = begin(game())
    assert timeline.take(Act(2, Fire())).world == timeline.act(2, Fire()).world


def test_to_take_a_cut_is_time_going_on_with_all_that_happens() -> None:
    timeline, clock = begin(arena()), (0, 5.0, 0.0)
    cut, lived = timeline.take(Cut(clock)), timeline.evolve_until(5.0)
    assert list(cut.forwards(cut.first.place)) == list(lived.forwards(lived.first.place))
    assert cut.at(2.0) == lived.at(2.0)


def test_to_reach_a_place_lets_happen_what_came_before_it_and_no_more() -> None:
    whole = begin(arena()).evolve(5.0)
    for state in whole.forwards(whole.first.place):
        if not isinstance(state.what, Cut):
            part = begin(arena()).reach(state.place)
            assert part.last.place == state.place
            assert part.world.all_flights() == state.world.all_flights()
    past = begin(arena()).reach(Place(0, 4.999, 3))
    assert past.world.clock == (0, 4.999, 0.0)
    assert past.world == whole.at(4.999)
    assert past.reach(Place(0, 2.0)).last is past.last


def test_a_past_holds_the_places_of_its_lines_up_to_where_it_leaves_them() -> None:
    old = begin(game()).evolve(2.0)
    early, late = old.at(0.5).now, old.at(1.5).now
    new = old.branch(1.0, "new").evolve(1.0)
    assert new.holds("main", Place(*early))
    assert not new.holds("main", Place(*late))
    assert new.holds("new", Place(*late))
    back = new.switch("main")
    assert back.holds("main", Place(*late))
    assert not back.holds("new", Place(*early))
