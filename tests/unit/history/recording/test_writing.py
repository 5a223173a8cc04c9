"""Recordings as they are made: their lines, the schema, when hashes and snapshots come, and how files are flushed."""

from __future__ import annotations

import io
import json
from importlib.resources import files
from math import inf, nan
from typing import Any

import pytest
from attrs import evolve as with_fields
from jsonschema import Draft202012Validator

from fasteroids import Happened, ModelError, Ship, Turn, World, evolve_until
from fasteroids.history.inputs import Act, Add, Cut, Instruct, Place, Remove
from fasteroids.history.living import Lived, answered, beginning, lived
from fasteroids.history.recording import Event, Recorder, RecordingFile, headed, read
from fasteroids.history.recording.digests import digest, named
from fasteroids.history.recording.events import event_line, event_record, line, when
from fasteroids.lang import Span
from fasteroids.moments import Moment, clock_at
from fasteroids.state import instructed
from tests.unit.making import Script, machine, rock, ship, shot, world_of

SCHEMA = json.loads(
    (files("fasteroids.history.recording") / "schema.json").read_text(encoding="utf-8")
)
TALKER = "double n; while (true) { n := n + 1; print n; turn 0.5; fire; thrust; skip; thrust_off; }"


def recording(world: World, until: float, *inputs: Any, **header: Any) -> list[dict[str, Any]]:
    """The records of a run up to a time, with inputs at its start."""
    made: list[str] = []
    recorder = Recorder(made.append, world, headed(world, **header))
    state = beginning(world)
    for given in (*inputs, Cut(clock_at(until))):
        told = lived(state, given.clock) if isinstance(given, Cut) else [answered(state, given)]
        for after in told:
            recorder.add(after)
            state = after
    recorder.bookmark("here")
    recorder.finish(state.world.clock)
    return [json.loads(each) for each in "".join(made).splitlines()]


def crowd(**fields: Any) -> World:
    """A world in which much happens: ships that talk, turn, fire and thrust among asteroids."""
    pilot = machine(TALKER)
    return world_of(
        ship(100, 100, program=pilot, direction=0.3),
        ship(800, 800, program=pilot, direction=3.0),
        rock(500, 500, 90, 40, r=60),
        rock(300, 700, -70, 90),
        rock(700, 200, 10, -120),
        shot(300, 200, 60, 60),
        **fields,
    )


def everything() -> list[dict[str, Any]]:
    """The records of a recording with every kind of line and input."""
    return [
        record
        for model in ("smooth", "robust")
        for record in recording(
            crowd(model=model, seed=3),
            40.0,
            Act(1, Turn(0.25)),
            Instruct(2, machine("thrust; print self;")),
            Remove(4),
            Add(rock(300, 500, 10, 20)),
            title="everything",
            every_hash=0.5,
            every_snapshot=2.0,
        )
    ]


# Lines.


def of(kind: str, records: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [record for record in records if record["type"] == kind]


def test_every_kind_of_line_and_input_is_written() -> None:
    records = everything()
    kinds = {"header", "input", "event", "print", "snapshot", "hash", "bookmark", "result"}
    assert {record["type"] for record in records} == kinds
    told = {record["kind"] for record in of("input", records)}
    assert told == {"act", "instruct", "remove", "add", "cut"}
    assert {record["kind"] for record in of("event", records)} >= {"contact", "wall", "tick"}


def test_every_line_keeps_to_the_schema() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    validator = Draft202012Validator(SCHEMA)
    for record in everything():
        assert [error.message for error in validator.iter_errors(record)] == []


@pytest.mark.parametrize(
    "wrong",
    [
        {"type": "event"},
        {"type": "hash", "time": -1.0, "value": "0" * 32},
        {"type": "input", "time": 0.0, "nth": 0, "kind": "act", "ship": 1},
        {"type": "print", "time": 0.0, "ship": 0, "text": ""},
        {"type": "bookmark", "time": 0.0, "nth": 0, "name": "x", "moment": [0, 1024.0]},
    ],
)
def test_the_schema_refuses_what_the_reader_refuses(wrong: dict[str, Any]) -> None:
    assert not Draft202012Validator(SCHEMA).is_valid(wrong)
    header = line(recording(World(9.0, 9.0), 1.0)[0])
    with pytest.raises(ModelError, match="line 2"):
        read(f"{header}\n{json.dumps(wrong)}\n".encode())


EVENTS = [
    Happened(1.5, "contact", (1, 2), at=(0.1, 2e-300)),
    Happened(1.5, "contact", (1, 12), effect="split", died=(1, 12), born=(13, 14), at=(inf, nan)),
    Happened(0.1, "wall", (3,), wall="left", clipped=(3,), at=(0.0, 7.0)),
    Happened(2.25, "limit", (3,), effect="reach"),
    Happened(0.2, "tick", (1,), effect="turn", span=Span(1, 2, 3, 4)),
    Happened(0.2, "tick", (1,), effect="halt", span=Span(1, 2, 3, 4), reason='"é"\n\ud800'),
    Happened(0.2, "tick", (1,), effect="fire", born=(9,), died=(9,), span=Span(1, 2, 3, 4)),
]


@pytest.mark.parametrize("moment", [None, (3, 1023.3), (2**33, 2.0**-43), (2**50, 482.0), (7, 0.5)])
@pytest.mark.parametrize("happened", EVENTS)
def test_the_line_of_an_event_is_the_json_of_its_record(
    happened: Happened, moment: Moment | None
) -> None:
    if moment is None:
        moment = (0, happened.time)
    told = when(moment)
    record = {"type": "event", **told}
    record |= {k: v for k, v in event_record(happened).items() if k not in ("time", "prints")}
    happened = with_fields(happened, time=told["time"])
    assert event_line(happened, Place(*moment, 1)) == line(record)


def test_prints_stand_before_the_event_of_their_tick() -> None:
    records = recording(crowd(model="smooth"), 0.3)
    rows = [(r["type"], r.get("ship") or r["entities"][0], r["time"]) for r in records[1:5]]
    assert rows == [("print", 1, 0.2), ("event", 1, 0.2), ("print", 2, 0.2), ("event", 2, 0.2)]
    assert records[1]["text"] == "1.0"


def test_a_program_is_written_once_and_named_by_its_text() -> None:
    records = everything()
    name = named(TALKER)
    header, text = records[0], json.dumps(records)
    assert header["programs"] == [{"sha256": name, "text": TALKER}]
    assert {row["program"] for row in header["world"]["ship"]} == {name}
    assert text.count(json.dumps(TALKER)) == 2  # once in each of two recordings
    told = [record for record in of("input", records) if record["kind"] == "instruct"]
    assert [each["programs"][0]["sha256"] for each in told] == [each["program"] for each in told]


def test_a_program_without_a_text_is_refused_before_anything_is_written() -> None:
    made: list[str] = []
    with pytest.raises(ModelError, match="no text"):
        Recorder(made.append, world_of(ship(100, 100, program=Script((None,)))))
    assert made == []


@pytest.mark.parametrize("every", [0.0, -1.0, nan, inf, 1e-9])
def test_intervals_are_times_that_can_be_kept(every: float) -> None:
    with pytest.raises(ModelError, match="every_hash must be"):
        headed(World(9.0, 9.0), every_hash=every)
    with pytest.raises(ModelError, match="every_snapshot must be"):
        headed(World(9.0, 9.0), every_snapshot=every)


# Cuts, hashes and snapshots.


def test_cuts_are_written_only_where_they_decide() -> None:
    for model, cuts in (("smooth", "free"), ("robust", "recorded"), ("spec", "recorded")):
        records = recording(world_of(rock(500, 500), model=model), 1.0)
        assert records[0]["cuts"] == cuts
        assert len(of("input", records)) == (cuts == "recorded")


def test_how_often_somebody_looked_changes_no_line_where_cuts_are_free() -> None:
    world = crowd(model="smooth", seed=3)
    once = recording(world, 12.0, every_hash=0.5, every_snapshot=1.0)
    looks = [Cut(clock_at(k / 7)) for k in range(1, 84)]
    often = recording(world, 12.0, *looks, every_hash=0.5, every_snapshot=1.0)
    assert once == often


def test_hashes_come_at_multiples_and_only_where_enough_happened() -> None:
    records = recording(crowd(model="smooth", seed=3), 12.0, every_hash=0.5)
    times = [record["time"] for record in of("hash", records)]
    assert len(times) > 3
    assert all(time % 0.5 == 0.0 for time in times)
    assert times == sorted(set(times))
    still = recording(world_of(rock(500, 500), model="smooth"), 1e6)
    assert of("hash", still) == of("snapshot", still) == []


def test_a_snapshot_is_the_world_at_its_time_and_the_index_finds_it() -> None:
    world, made = crowd(model="smooth", seed=3), list[str]()
    recorder = Recorder(made.append, world, headed(world, every_snapshot=2.0))
    for state in lived(beginning(world), clock_at(30.0)):
        recorder.add(state)
    recorder.finish(clock_at(30.0))
    text = "".join(made)
    result = json.loads(text.splitlines()[-1])
    assert len(result["snapshots"]) > 1
    for time, place in result["snapshots"]:
        record = json.loads(text[place : text.index("\n", place)])
        assert (record["type"], record["time"]) == ("snapshot", time)
        assert read(text.encode()).at(clock_at(time)) == evolve_until(world, time)


def test_a_digest_tells_what_decides_and_not_the_clock() -> None:
    world = crowd(model="smooth")
    assert digest(world) == digest(evolve_until(world, 0.1))
    assert digest(world) != digest(world.remove(3))
    others = [
        crowd(model="smooth").remove(1).add(ship(100, 100, direction=0.3)),
        answered(beginning(world), Act(1, Turn(0.1))).world,
        instructed(world, 1, machine(TALKER + " ")),
        evolve_until(world, 0.2),
    ]
    assert len({digest(each) for each in [world, *others]}) == 5


def test_a_digest_does_not_tell_slots() -> None:
    a, b = rock(300, 300), rock(600, 600)
    one = world_of(rock(100, 100), a, b).remove(1)
    other = world_of(rock(900, 900), a, b).remove(1)
    assert digest(one) == digest(other)
    assert digest(one.add(ship(100, 100))) == digest(other.add(ship(100, 100)))


# Files.


class Watch:
    """A clock that stands still until it is told."""

    def __init__(self) -> None:
        self.time = 0.0

    def __call__(self) -> float:
        return self.time


def states(world: World, until: float) -> list[Lived]:
    return list(lived(beginning(world), clock_at(until)))


@pytest.mark.parametrize("packed", [False, True])
def test_what_is_in_the_file_is_never_older_than_a_second(packed: bool) -> None:
    world, watch, file = crowd(model="smooth", seed=3), Watch(), io.BytesIO()
    recording = RecordingFile(file, world, clock=watch, packed=packed)
    came: list[float] = []
    for state in states(world, 4.0)[:-1]:
        watch.time += 0.37 if len(came) % 5 else 0.05
        came.append(watch.time)
        recording.add(state)
        there = sum(isinstance(each, Event) for each in read(file.getvalue()).lines)
        assert all(watch.time - time < 1.0 for time in came[there:])


@pytest.mark.parametrize("packed", [False, True])
def test_a_file_that_is_left_without_a_result_was_cut_short(packed: bool) -> None:
    world, file = crowd(model="smooth", seed=3), io.BytesIO()
    with RecordingFile(file, world, clock=Watch(), packed=packed) as writing:
        for state in states(world, 3.0):
            writing.add(state)
    told = read(file.getvalue())
    assert told.result is None
    assert told.short == f"it is cut short after line {len(told.lines) + 1}, at {told.time!r} s"


def test_waiting_flushes_what_was_marked() -> None:
    watch, file = Watch(), io.BytesIO()
    writing = RecordingFile(file, World(9.0, 9.0), clock=watch)
    writing.bookmark("tea")
    assert b"tea" not in file.getvalue()
    watch.time += 0.6
    writing.tend()
    assert b"tea" in file.getvalue()


def test_a_whole_ship_goes_through_an_input_line() -> None:
    whole = Ship(
        300.5, 400.0, 1.0, -2.0, 9.0, 7.0, 3.0,
        thruster=True, program=machine(TALKER), name="é", max_speed=50.0, thrust_power=2.0,
    )  # fmt: skip
    records = recording(world_of(model="smooth"), 5.0, Add(whole))
    told = read("".join(line(record) + "\n" for record in records).encode()).givens
    assert [given.what for given in told] == [Add(whole)]
    assert told[0].place == Place(0, 0.0, 0)


class Full(io.BytesIO):
    """A file on a disk that is full for one write, and has room again after that."""

    def __init__(self) -> None:
        super().__init__()
        self.full = False

    def write(self, data: Any) -> int:
        if self.full:
            self.full = False
            raise OSError("no space left on device")
        return super().write(data)


def write_until_full(file: Full, packed: bool) -> None:
    """A recording of 6 s into a file that is full for one write after 3 s."""
    world, watch = crowd(model="smooth", seed=3), Watch()
    with RecordingFile(file, world, clock=watch, packed=packed) as writing:
        for state in states(world, 6.0):
            file.full = state.place.time > 3.0
            watch.time += 1.0
            writing.add(state)


@pytest.mark.parametrize("packed", [False, True])
def test_nothing_is_written_behind_a_hole(packed: bool) -> None:
    file = Full()
    with pytest.raises(OSError, match="no space"):
        write_until_full(file, packed)
    told = read(file.getvalue())
    assert 2.0 < told.time <= 3.0
    assert told.result is None
