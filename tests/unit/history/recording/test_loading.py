"""Recordings as timelines, and back. That any past comes back is tested in tests/properties/test_loading.py."""

from __future__ import annotations

import json

import pytest

from fasteroids import Fire, ModelError, evolve_until, load_scene
from fasteroids.history import Timeline, begin
from fasteroids.history.recording import RecordingError, read, verified
from fasteroids.history.recording.loading import recorded, timeline_of

SCENE = """
[world]
width = 1000
height = 400
model = "smooth"

[[ship]]
name = "red"
x = 100
y = 200
radius = 20
mass = 5e15

[[asteroid]]
x = 700
y = 200
vx = -130
radius = 40
"""
LITERAL = SCENE.replace("smooth", "robust").replace("5e15", "5e15\nthruster = true")


def loaded(timeline: Timeline) -> Timeline:
    return timeline_of(read(recorded(timeline).encode()))


@pytest.fixture
def past() -> Timeline:
    world = load_scene(SCENE)
    return begin(world).evolve_until(0.5).act(1, Fire()).evolve_until(9.0)


def test_inputs_and_events_come_back_at_their_places(past: Timeline) -> None:
    again = loaded(past)
    found = [(s.place, s.what) for s in again.forwards(again.first.place)]
    expected = [(s.place, s.what) for s in past.forwards(past.first.place)]
    assert [each for each in found if each[1] is not None][-1] == expected[-1]
    assert set(found) <= set(expected)
    assert again.world == past.world
    assert [again.at(t) for t in (0.0, 0.5, 4.2)] == [past.at(t) for t in (0.0, 0.5, 4.2)]


def test_only_the_current_line_is_recorded(past: Timeline) -> None:
    branch = past.branch(2.0, "other").evolve_until(3.0)
    assert loaded(branch).world == branch.world
    assert loaded(branch.switch("main")).world == past.world


def test_bookmarks_of_other_futures_are_left_out(past: Timeline) -> None:
    past = past.bookmark("early", 1.0).bookmark("late", 8.0)
    branch = past.branch(2.0).evolve_until(3.0).bookmark("here")
    assert {*loaded(branch).bookmarks} == {"early", "here"}
    assert {*loaded(branch.switch("main")).bookmarks} == {"early", "late"}


def test_a_bookmark_keeps_its_place_and_world(past: Timeline) -> None:
    """Between two events there is no state, and nothing in the file but the name."""
    past = past.bookmark("between", 1.25).bookmark("now").bookmark("start", past.first.place)
    for name, mark in loaded(past).bookmarks.items():
        assert mark.state.place == past.bookmarks[name].state.place
        assert mark.state.world == past.bookmarks[name].state.world


def test_a_branch_between_two_events_is_a_cut_where_cuts_decide() -> None:
    past = begin(load_scene(LITERAL)).evolve_until(3.0)
    branch = past.branch(1.3).evolve_until(2.6)
    assert branch.world != past.at(2.6)
    assert loaded(branch).world == branch.world
    bare = past.branch(1.3)
    assert loaded(bare).world == bare.world


def test_bookmarks_of_one_place_stand_in_the_order_of_their_names(past: Timeline) -> None:
    names = [f"name {i}" for i in range(9)]
    for name in reversed(names):
        past = past.bookmark(name, 2.0)
    assert [each.name for each in read(recorded(past).encode()).bookmarks] == names


@pytest.mark.parametrize("text", [SCENE, LITERAL])
def test_what_was_recorded_once_is_recorded_the_same_again(text: str) -> None:
    past = begin(load_scene(text))
    for _ in range(3):
        past = past.evolve(0.1)  # the sum is not quite 0.3 s, and the clock knows
    past = past.act(1, Fire())
    assert past.world.clock[2] != 0.0
    again = loaded(past)
    assert again.world.clock == past.world.clock
    assert again.last.what == past.last.what
    assert recorded(again) == recorded(past)


def test_what_was_recorded_verifies(past: Timeline) -> None:
    recording = read(recorded(past, title="here").encode())
    told = verified(recording)
    assert (told.difference, told.short, told.until) == (None, None, 9.0)
    assert recording.header.title == "here"
    assert recording.result is not None
    assert recording.result.ended == "saved"


def test_a_program_without_a_text_cannot_be_recorded(past: Timeline) -> None:
    from fasteroids.testing import Script

    timeline = past.instruct(1, Script(()))
    with pytest.raises(ModelError):
        recorded(timeline)


def test_it_keeps_within_a_budget(past: Timeline) -> None:
    timeline = timeline_of(read(recorded(past).encode()), budget=0)
    assert timeline.states == 2
    assert timeline.at(4.2) == past.at(4.2)


def test_a_recording_that_was_cut_short_is_a_past_up_to_there(past: Timeline) -> None:
    data = recorded(past).encode()
    cut = read(data[: data.rindex(b'{"type":"result"')])
    timeline = timeline_of(cut)
    assert timeline.world.time == cut.time
    assert timeline.at(cut.time) == past.at(cut.time)


@pytest.mark.parametrize(
    ("time", "nth"), [(-0.0, 7), (0.5, 9), (1.0, 1), (9.5, 0), (1e300, 0), (9.0, 2**40)]
)
def test_a_bookmark_of_no_place_is_refused(past: Timeline, time: float, nth: int) -> None:
    head, *lines = recorded(past).splitlines(keepends=True)
    mark = json.dumps({"type": "bookmark", "time": time, "nth": nth, "name": "x"}) + "\n"
    recording = read("".join([head, mark, *lines]).encode())
    with pytest.raises(RecordingError, match="the bookmark 'x' is at a place that is not in this"):
        timeline_of(recording)


def test_the_world_may_begin_late() -> None:
    world = evolve_until(load_scene(SCENE.partition("[[asteroid]]")[0]), 5000.25)
    past = begin(world).evolve(0.7).act(1, Fire()).evolve(3.3)
    again = loaded(past)
    assert (again.first.world, again.world) == (world, past.world)
    assert again.world.clock == past.world.clock
