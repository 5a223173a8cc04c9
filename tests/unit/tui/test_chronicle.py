"""The account of a past: what it says is what the timeline says, however it came to be."""

from __future__ import annotations

import pytest

from fasteroids import Fire, Turn
from fasteroids.history import Place, Timeline, begin, events_of, last_change
from fasteroids.history.marks import is_of
from fasteroids.tui.chronicle import FIELDS, Chronicle, Sign, chronicle_of
from tests.unit.history.pasts import arena, fought, states
from tests.unit.making import machine, ship, world_of

SIGNS: tuple[Sign, ...] = ("event", "loss", "death", "stop", "shot", "contact", "input")


@pytest.fixture(scope="module")
def past() -> Timeline:
    return fought()


def told(chronicle: Chronicle, entities: int) -> dict[object, object]:
    """All that a chronicle says."""
    keys = [*SIGNS, *range(1, entities)]
    keys += [(e, name) for e in range(1, entities) for name in (*FIELDS, "contact")]
    return {key: tuple(chronicle.entries(key)) for key in keys}


def test_the_events_of_an_entity_are_those_of_the_timeline(past: Timeline) -> None:
    chronicle = chronicle_of(past)
    for entity in range(1, past.world.roster.next_id):
        lived = [(s.place, s.what) for s in events_of(past, entity)]
        assert list(chronicle.entries(entity)) == lived


def test_each_sign_marks_what_is_of_its_kind(past: Timeline) -> None:
    chronicle = chronicle_of(past)
    for sign in ("death", "shot", "contact", "input"):
        wanted = [s.place for s in states(past) if is_of(s, sign)]
        assert [entry.place for entry in chronicle.entries(sign)] == wanted
        assert wanted
    happenings = [s.place for s in states(past) if is_of(s, "event") or is_of(s, "input")]
    assert [entry.place for entry in chronicle.entries("event")] == happenings


@pytest.mark.parametrize("model", ["robust", "smooth"])
def test_the_last_change_of_a_field_is_that_of_the_timeline(model: str) -> None:
    timeline = fought(model)
    chronicle = chronicle_of(timeline)
    found = 0
    for entity in range(1, timeline.world.roster.next_id):
        for name in FIELDS:
            for time in (0.0, 1.0, 3.0, 4.4, 7.7, 12.0):
                known = last_change(timeline, entity, name, before=Place(0, time, 1000))
                mine = chronicle.last_change(entity, name, Place(0, time, 999))
                assert (mine and mine.place) == (known and known.state.place)
                found += known is not None
    assert found > 100


def test_followed_step_by_step_it_says_what_it_says_made_at_once() -> None:
    timeline = begin(arena("smooth"), budget=0)  # thinned all the time
    chronicle = chronicle_of(timeline)
    for i in range(40):
        timeline = timeline.evolve(0.15)
        if i % 7 == 3:
            timeline = timeline.act(1, Fire())
        chronicle = chronicle.followed(timeline)
    ids = timeline.world.roster.next_id
    assert told(chronicle, ids) == told(chronicle_of(timeline), ids)
    assert chronicle.entries("input")


def test_a_branch_has_the_account_of_its_parent_up_to_there() -> None:
    timeline = fought()
    chronicle = chronicle_of(timeline)
    for place in (states(timeline)[50].place, 4.05, timeline.last.place):
        branch = timeline.branch(place).act(2, Turn(1.0)).evolve(2.0)
        followed = chronicle.followed(branch)
        ids = branch.world.roster.next_id
        assert told(followed, ids) == told(chronicle_of(branch), ids)
        back = followed.followed(branch.switch("main"))
        assert told(back, ids) == told(chronicle, ids)


def test_another_past_of_the_same_beginning_is_told_anew() -> None:
    first = begin(arena())
    one, other = first.evolve(2.0), first.act(2, Turn(1.0)).evolve(4.0)
    chronicle = chronicle_of(one).followed(other)
    ids = other.world.roster.next_id
    assert told(chronicle, ids) == told(chronicle_of(other), ids)
    assert told(chronicle.followed(one), ids) == told(chronicle_of(one), ids)


def test_entries_around_a_place(past: Timeline) -> None:
    chronicle = chronicle_of(past)
    entries = chronicle.entries(1)
    here = entries[10].place
    assert list(chronicle.until(1, here, 3)) == list(entries[8:11])
    assert list(chronicle.after(1, here, 3)) == list(entries[11:14])
    assert list(chronicle.until(1, Place(0, 0.0), 3)) == []
    assert list(chronicle.after(1, entries[-1].place, 3)) == []


def test_a_program_that_halts_or_ends_is_a_stop() -> None:
    world = world_of(
        ship(100.0, 100.0, program=machine("skip; print getx null;")),
        ship(300.0, 100.0, program=machine("skip; skip;")),
    )
    timeline = begin(world).evolve(2.0)
    stops = chronicle_of(timeline).entries("stop")
    assert [(e.place.time, str(e.what)) for e in stops] == [
        (0.4, "t=0.4 tick #1, halt, because getx null"),
        (0.4, "t=0.4 tick #2, skip"),
    ]
