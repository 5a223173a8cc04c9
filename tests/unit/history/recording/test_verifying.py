"""Recordings that are lived again: what differs is named, by its time, entity and field."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from fasteroids import ModelError, Thrust, Turn, World
from fasteroids.history.inputs import Act, Add, Cut, Input, Instruct, Remove
from fasteroids.history.living import answered, beginning, lived
from fasteroids.history.recording import (
    Difference,
    Recorder,
    Recording,
    differing,
    digests,
    headed,
    read,
    verified,
    verifying,
)
from fasteroids.moments import clock_at
from tests.unit.making import machine, rock, ship, world_of

PILOT = "while (true) { print getx self; turn 0.5; fire; skip; }"


def world(model: str = "smooth", **changed: Any) -> World:
    pilot = machine(PILOT)
    return world_of(
        ship(150, 150, program=pilot),
        ship(850, 850),
        rock(500, 500, 90, 40, r=60),
        rock(300, 700, -70, changed.pop("vy", 90)),
        model=model,
        **changed,
    )


def rows(first: World, until: float, *inputs: Input) -> list[dict[str, Any]]:
    """The records of a run with inputs."""
    made: list[str] = []
    recorder = Recorder(made.append, first, headed(first, every_hash=0.5, every_snapshot=1.0))
    state = beginning(first)
    for given in (*inputs, Cut(clock_at(until))):
        told = lived(state, given.clock) if isinstance(given, Cut) else [answered(state, given)]
        for after in told:
            recorder.add(after)
            state = after
    recorder.finish(state.world.clock)
    return [json.loads(each) for each in "".join(made).splitlines()]


def opened(records: list[dict[str, Any]]) -> Recording:
    return read("".join(json.dumps(record) + "\n" for record in records).encode())


PLAYED = (
    Act(2, Thrust()),
    Cut(clock_at(0.7)),
    Act(2, Turn(1.0)),
    Cut(clock_at(1.3)),
    Instruct(2, machine("print self; fire;")),
    Cut(clock_at(3.0)),
    Remove(4),
    Add(rock(600, 200, 50, 60)),
)


@pytest.mark.parametrize("model", ["smooth", "robust", "spec"])
def test_a_game_with_every_input_happens_again(model: str) -> None:
    recording = opened(rows(world(model), 20.0, *PLAYED))
    told = verified(recording)
    assert told.difference is None
    assert (told.until, told.lines, told.short) == (20.0, len(recording.lines) + 1, None)
    assert told.same_libm


@pytest.mark.parametrize("slice", [20.0, 1.0, 0.3, 0.011])
def test_a_game_happens_again_however_time_is_cut(slice: float) -> None:
    assert verified(opened(rows(world(), 20.0, *PLAYED)), slice=slice).difference is None


def test_recorded_cuts_are_lived_again_and_no_others() -> None:
    """Under literal thrust a cut decides: the same game without one of them is another."""
    cuts = [Cut(clock_at(k / 8)) for k in range(1, 40)]
    records = rows(world("robust"), 6.0, Act(2, Thrust()), *cuts)
    assert verified(opened(records)).difference is None
    fewer = [r for r in records if r.get("kind") != "cut" or r["time"] != 2.0]
    assert len(fewer) == len(records) - 1
    assert verified(opened(fewer)).difference is not None
    with pytest.raises(ModelError, match="holds its cuts"):
        verified(opened(records), slice=1.0)


@pytest.mark.parametrize("slice", [0.0, -1.0, float("nan"), float("inf"), 1e-9])
def test_a_slice_is_a_time_that_fits(slice: float) -> None:
    with pytest.raises(ModelError, match="a slice must be"):
        verified(opened(rows(world(), 1.0)), slice=slice)


# Differences.


def first(type_: str, **fields: Any) -> Callable[[list[dict[str, Any]]], int]:
    """The place of the first record of a kind with these fields, after the first ten lines."""

    def place(records: list[dict[str, Any]]) -> int:
        return next(
            i
            for i, r in enumerate(records)
            if i > 10 and r["type"] == type_ and fields.items() <= r.items()
        )

    return place


@pytest.mark.parametrize(
    ("where", "field", "value", "entity"),
    [
        (first("event", kind="wall"), "at", [1.0, 2.0], 4),
        (first("event", kind="wall"), "wall", "left", 4),
        (first("event", effect="fire"), "born", [77], 1),
        (first("event", effect="turn"), "effect", "skip", 1),
        (first("event", effect="turn"), "entities", [2], 2),
        (first("print"), "text", "12.0", 1),
        (first("print"), "ship", 2, 2),
        (first("hash"), "value", "0" * 32, None),
        (first("result"), "hash", "0" * 32, None),
        (first("result"), "events", {"tick": 3}, None),
    ],
)
def test_the_first_difference_is_named(
    where: Callable[[list[dict[str, Any]]], int], field: str, value: Any, entity: int | None
) -> None:
    records = rows(world(), 20.0)
    place = where(records)
    was = records[place].get(field)
    records[place][field] = value
    told = verified(opened(records))
    time = records[place]["time"]
    assert told.difference == Difference(place + 1, time, entity, field, value, was)
    assert told.lines == place
    assert told.until <= time
    assert str(told.difference).startswith(f"line {place + 1}, at {time!r} s")


def test_a_difference_in_a_snapshot_names_the_entity_and_its_field() -> None:
    records = rows(world(), 60.0)
    place = first("snapshot")(records)
    row = records[place]["world"]["asteroid"][0]
    was, row["vx"] = row["vx"], 1.5
    told = verified(opened(records)).difference
    assert told == Difference(place + 1, records[place]["time"], row.get("id", 3), "vx", 1.5, was)
    assert told is not None
    assert f"#{told.entity}: vx is recorded as 1.5, and is {was!r}" in str(told)
    del records[place]["world"]["asteroid"][0]
    told = verified(opened(records)).difference
    assert told is not None
    assert (told.field, told.recorded) in [("the entity", None), ("kind", "asteroid")]


def test_a_line_left_out_or_too_many_is_a_difference_of_that_line() -> None:
    records = rows(world(), 20.0)
    place = first("event", effect="fire")(records)
    told = verified(opened([*records[:place], *records[place + 1 :]])).difference
    assert told is not None
    assert told.line == place + 1
    twice = verified(opened([*records[: place + 1], *records[place:]])).difference
    assert twice is not None
    assert twice.line == place + 2


def test_an_input_that_makes_no_sense_is_a_difference_with_its_reason() -> None:
    records = rows(world(), 3.0, Act(2, Turn(1.0)))
    records[1]["ship"] = 99
    told = verified(opened(records)).difference
    assert told is not None
    assert told.line == 2
    assert told.found == "there is no entity with id 99 in this world"


def test_another_first_world_is_found_at_the_first_event_that_it_changes() -> None:
    records, others = rows(world(), 20.0), rows(world(vy=91), 20.0)
    mixed = verified(opened([others[0], *records[1:]])).difference
    assert mixed is not None
    assert 0.0 < mixed.time < 5.0


def test_a_recording_cut_short_is_compared_as_far_as_it_goes() -> None:
    records = rows(world(), 5.0, *PLAYED)
    for size in range(1, len(records)):
        recording = opened(records[:size])
        told = verified(recording)
        assert told.difference is None, str(told.difference)
        assert told.lines == size
        assert told.short == recording.short is not None


def test_another_libm_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    recording = opened(rows(world(), 1.0))
    monkeypatch.setattr(verifying, "libm", lambda: "another")
    assert not verified(recording).same_libm
    assert len(digests.libm()) == 32


# Two recordings.


def test_a_recording_differs_from_itself_in_nothing_and_bookmarks_are_no_difference() -> None:
    records = rows(world(), 5.0, *PLAYED)
    marked = [*records[:5], {"type": "bookmark", "time": 0.0, "nth": 0, "name": "x"}, *records[5:]]
    marked[0] = marked[0] | {"title": "marked", "python": "2.7"}
    assert differing(opened(records), opened(records)) is None
    assert differing(opened(records), opened(marked)) is None


def test_two_games_part_where_the_first_line_differs() -> None:
    one, other = rows(world(), 9.0), rows(world(), 9.0, Cut(clock_at(4.0)), Act(2, Turn(1.0)))
    told = differing(opened(one), opened(other))
    assert told is not None
    assert told.field == "the line"
    assert told.found["kind"] == "act"
    back = differing(opened(other), opened(one))
    assert back is not None
    assert (back.recorded, back.found) == (told.found, told.recorded)


def test_two_first_worlds_are_compared_by_entity_and_field() -> None:
    told = differing(opened(rows(world(), 1.0)), opened(rows(world(vy=91), 1.0)))
    assert told == Difference(1, 0.0, 4, "vy", 90.0, 91.0)
    told = differing(opened(rows(world(), 1.0)), opened(rows(world(seed=2), 1.0)))
    assert told == Difference(1, 0.0, None, "seed", None, 2)


def test_a_game_that_goes_on_differs_from_one_that_ended_but_not_from_one_cut_short() -> None:
    long, ended = rows(world(), 9.0), rows(world(), 4.0)
    assert differing(opened(long), opened(ended)) is not None
    assert differing(opened(long), opened(ended[:-1])) is None
    assert differing(opened(long[:-1]), opened(long)) is None
