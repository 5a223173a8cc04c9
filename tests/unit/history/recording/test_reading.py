"""Recordings that are read: whole, cut short, damaged, and of other versions."""

from __future__ import annotations

import gzip
import json
import zlib
from pathlib import Path
from typing import Any

import pytest

from fasteroids import World, evolve_until
from fasteroids.history.inputs import Act
from fasteroids.history.living import beginning, lived
from fasteroids.history.recording import (
    Bookmark,
    Hash,
    Recorder,
    Recording,
    RecordingError,
    Snapshot,
    headed,
    read,
    record_of,
    verified,
)
from fasteroids.history.recording import reading as module
from fasteroids.moments import clock_at
from tests.unit.making import machine, rock, ship, world_of

GOLDEN = Path(__file__).parents[3] / "golden"


def world() -> World:
    pilot = machine("while (true) { turn 0.5; print getx self; fire; }")
    return world_of(ship(500, 500, program=pilot), rock(200, 300, 70, 90), model="smooth")


def whole(until: float = 8.0) -> bytes:
    """A recording with something of everything but inputs."""
    made: list[str] = []
    first = world()
    recorder = Recorder(made.append, first, headed(first, every_hash=0.5, title="é"))
    for state in lived(beginning(first), clock_at(until)):
        recorder.add(state)
    recorder.bookmark("end")
    recorder.finish(clock_at(until))
    return "".join(made).encode()


def rows(data: bytes) -> list[dict[str, Any]]:
    return [json.loads(row) for row in data.splitlines()]


def joined(records: list[dict[str, Any]]) -> bytes:
    return "".join(json.dumps(record) + "\n" for record in records).encode()


def wrong(data: bytes) -> str:
    """The sentence on some bytes."""
    with pytest.raises(RecordingError) as caught:
        read(data)
    return str(caught.value)


# Whole.


def test_a_recording_tells_what_it_is_of() -> None:
    told = read(whole())
    assert (told.header.model, told.header.cuts, told.header.title) == ("smooth", "free", "é")
    assert told.world == world()
    assert told.time == 8.0
    assert told.short is None
    assert told.result is not None
    assert told.result.ended == "time"
    assert [each.name for each in told.bookmarks] == ["end"]
    assert sum(told.result.events.values()) > 20


def test_plain_and_packed_tell_the_same() -> None:
    data = whole()
    assert read(gzip.compress(data)) == read(data)
    assert read(gzip.compress(data[:900]) + gzip.compress(data[900:])) == read(data)


def test_a_file_that_others_wrote_is_read_too() -> None:
    """In another order, with other spaces, in UTF-8, and without the last end of line."""
    rows_ = [dict(reversed(row.items())) for row in rows(whole())]
    text = "\n".join(json.dumps(row, ensure_ascii=False, indent=None) for row in rows_)
    assert read(text.encode()) == read(whole())


def test_unknown_fields_are_kept_when_a_recording_is_written_again() -> None:
    records = rows(whole())
    for i, record in enumerate(records):
        record["x-note"] = {"line": i, "deep": [1.5, None, "é"]}
    told = read(joined(records))
    assert [json.loads(row) for row in told.rewritten()] == records
    assert verified(told).difference is None


def test_any_moment_of_it_is_lived_again_with_the_same_bits() -> None:
    told = read(whole())
    for time in (0.0, 0.1, 3.0, 7.99, 8.0):
        assert told.at(clock_at(time)) == evolve_until(world(), time)


def test_a_snapshot_that_is_no_world_is_told_with_its_line() -> None:
    records = rows(whole())
    place = 40
    snapshot = {"type": "snapshot", "time": records[place]["time"], "world": {"world": {}}}
    told = read(joined([*records[:place], snapshot, *records[place:]]))
    with pytest.raises(RecordingError, match=f'line {place + 1}: "world": .*width: is missing'):
        told.at(clock_at(8.0))


def test_a_recording_may_end_between_two_events_of_a_moment_with_a_snapshot_there() -> None:
    """Six ships whose programs all run at each k / 5 s: it ends after two of them at 11 s."""
    pilot = machine("while (true) { turn 0.5; }")
    ships = [ship(100 + 140 * i, 500, program=pilot) for i in range(6)]
    first, made = world_of(*ships, model="smooth"), list[str]()
    recorder = Recorder(made.append, first, headed(first, every_snapshot=11.0))
    states = list(lived(beginning(first), clock_at(20.0)))
    end = next(i for i, s in enumerate(states) if s.place.time == 11.0 and s.place.nth == 2)
    for state in states[: end + 1]:
        recorder.add(state)
    last = states[end]
    recorder.finish((*last.place.moment, 0.0), "enough")
    told = read("".join(made).encode())
    assert any(
        isinstance(each, Snapshot) and each.moment == last.place.moment for each in told.lines
    )
    assert told.result is not None
    assert told.result.place == last.place
    assert told.at(told.until) == last.world
    assert verified(told).difference is None


# Cut short.


def test_a_recording_cut_in_a_line_ends_with_the_line_before() -> None:
    data = whole()
    lines = data.splitlines(keepends=True)
    told = read(b"".join(lines[:9]) + lines[9][:-2])
    assert told.short == f"it is cut short in line 10, at {told.time!r} s"
    assert told.lines == read(data).lines[:8]
    assert told.until == (*told.lines[-1].moment, 0.0)


def test_a_recording_of_nothing_but_its_header_is_one() -> None:
    told = read(whole().splitlines(keepends=True)[0])
    assert told.lines == ()
    assert told.until == told.world.clock
    assert told.short == "it is cut short after line 1, at 0.0 s"


def test_a_header_cut_short_is_no_recording() -> None:
    data = whole()
    for size in (1, 50, data.index(b"\n") - 1):
        assert wrong(data[:size]) == "line 1: the header is cut short, or this is no recording"


def test_damaged_compression_gives_what_stands_before_it() -> None:
    packer = zlib.compressobj(6, wbits=31)
    lines = whole().splitlines(keepends=True)
    before = packer.compress(b"".join(lines[:9])) + packer.flush(zlib.Z_FULL_FLUSH)
    after = bytearray(packer.compress(b"".join(lines[9:])) + packer.flush())
    after[0] = 0xFF  # a block of no known type
    told = read(before + bytes(after))
    assert len(told.lines) == 8
    assert told.short == f"its compression is damaged after line 9, at {told.time!r} s"


def test_something_behind_the_compressed_data_is_damage() -> None:
    assert "line" in wrong(gzip.compress(whole()) + b"garbage")


# Wrong.


def test_what_is_no_recording_is_told_in_a_sentence() -> None:
    assert wrong(b"") == "the file is empty; a recording begins with a header"
    assert wrong(b"[world]\n") == "line 1: is no JSON: Expecting value at column 2"
    assert wrong(b"{}\n").startswith("line 1: is not the header of a recording")
    assert wrong(b"[]\n") == "line 1: must be an object of JSON; got []"
    assert wrong(b"\xff\xfe\n") == "line 1: is no UTF-8 at byte 1"


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("hello", "is no JSON: Expecting value at column 1"),
        ("", "is no JSON: Expecting value at column 1"),
        ("5", "must be an object of JSON; got 5"),
        ('{"type":"note"}', '"type" must be one of input, event,'),
        ('{"type":"hash"}', '"time" is missing'),
        ('{"type":"hash","time":0.0,"time":0.0}', "has the key 'time' twice"),
        ('{"type":"hash","time":NaN}', "NaN is no number of JSON"),
        ('{"type":"hash","time":1e999}', "'1e999' is beyond the largest double"),
        ('{"type":"hash","time":-1.0}', '"time" must be a finite number from 0.0; got -1.0'),
        ('{"type":"hash","time":true}', '"time" must be a finite number from 0.0; got True'),
        ('{"type":"hash","time":' + "9" * 400 + "}", '"time" must be a finite number from 0.0'),
        ('{"type":"hash","time":' + "9" * 9999 + "}", "has a whole number of too many digits"),
        ("[" * 100_000, "is nested too deeply"),
        ('{"type":"hash","time":1024.0,"moment":[1,0.5]}', '"moment" must be at the "time"'),
        ('{"type":"hash","time":1.0,"moment":[0,1024.0]}', '"moment" must be a number of windows'),
        ('{"type":"input","time":0.0,"nth":-1}', '"nth" must be a whole number from 0'),
        ('{"type":"input","time":0.0,"nth":0,"kind":"act","ship":1,"action":"jump"}', '"action"'),
        (
            '{"type":"input","time":0.0,"nth":0,"kind":"instruct","ship":1,"program":"ab"}',
            "there is no program 'ab' in this recording so far",
        ),
        (
            '{"type":"input","time":0.0,"nth":0,"kind":"add","entity":{"kind":"moon"}}',
            'kind = "moon": must be one of ship, asteroid, bullet',
        ),
        (
            '{"type":"input","time":0.0,"nth":0,"kind":"add","entity":{"kind":"asteroid","x":1,"y":2}}',
            "radius: is missing",
        ),
        (
            '{"type":"input","time":0.0,"nth":0,"kind":"cut","programs":[{"sha256":"ab","text":"fire;"}]}',
            "the program 'ab' has another text than it is named by",
        ),
        ('{"type":"input","time":0.0,"nth":0,"kind":"cut","residue":1.0}', '"residue" must be'),
        ('{"type":"event","time":0.0,"kind":"tick","entities":[]}', "must be one id or two"),
    ],
)
def test_a_wrong_line_is_told_with_its_number_and_what_is_allowed(line: str, sentence: str) -> None:
    lines = whole().decode().splitlines()
    lines.insert(1, line)
    told = wrong("\n".join(lines).encode())
    assert told.startswith("line 2: ")
    assert sentence in told
    assert len(told) < 600


def test_a_line_that_goes_back_in_time_is_refused_but_a_bookmark_may() -> None:
    lines = whole().decode().splitlines()
    lines.insert(-1, '{"type":"bookmark","time":0.0,"nth":0,"name":"the start"}')
    assert isinstance(read("\n".join(lines).encode()).lines[-2], Bookmark)
    lines.insert(-1, '{"type":"hash","time":0.0,"value":""}')
    number = len(lines) - 1
    assert wrong("\n".join(lines).encode()) == (
        f"line {number}: goes back in time, from 8.0 s to 0.0 s"
    )


def test_nothing_stands_behind_the_result() -> None:
    data = whole()
    number = data.count(b"\n") + 1
    for more in (data.splitlines(keepends=True)[-2], b'{"type":'):
        assert wrong(data + more) == (
            f"line {number}: stands behind the result, which is the last line"
        )


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"format": 2}, "the recording has format 2, and this version reads formats up to 1"),
        ({"format": 0}, '"format" must be a whole number from 1'),
        ({"format": "1"}, '"format" must be a whole number'),
        ({"rules": 2}, "the recording is of rules 2, and this version knows rules up to 1"),
        ({"model": "robust"}, '"model" is not that of its world'),
        ({"fuel": 9}, '"fuel" is not that of its world'),
        ({"seed": 9}, '"seed" is not that of its world'),
        ({"cuts": "recorded"}, '"cuts" cannot be recorded under the model smooth'),
        ({"cuts": "maybe"}, '"cuts" must be one of free, recorded'),
        ({"every_hash": 1e-9}, '"every_hash" must be a finite number from'),
        ({"world": {}}, "[world]: is missing"),
        ({"world": {"world": {"width": 1, "height": -1}}}, "height = -1"),
        ({"programs": []}, "there is no program"),
        ({"programs": [5]}, 'each of "programs" must be an object of JSON; got 5'),
    ],
)
def test_a_wrong_header_is_told(change: dict[str, Any], sentence: str) -> None:
    header, *rest = rows(whole())
    told = wrong(joined([header | change, *rest]))
    assert told.startswith("line 1: ")
    assert sentence in told


def test_a_small_file_cannot_fill_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_BYTES", 100_000)
    bomb = gzip.compress(b" " * 10_000_000)
    assert wrong(bomb) == "a recording has at most 100000 bytes; this one has more"


# Versions.


def test_a_file_of_format_1_still_opens() -> None:
    """It was written by the first version that wrote any; nothing may change what it tells."""
    told: Recording = read((GOLDEN / "recording-format-1.jsonl").read_bytes())
    assert told.header.fasteroids == "0.1.0"
    assert told.header.rules == 1
    assert len(told.world) == 6
    assert {type(each).__name__ for each in told.lines} == {
        "Entered", "Event", "Print", "Snapshot", "Hash", "Bookmark", "Result",
    }  # fmt: skip
    assert isinstance(told.givens[0].what, Act)
    hashes = [record_of(each)["value"] for each in told.lines if isinstance(each, Hash)]
    assert hashes[0] == "123f346cf1f74e80b1c774f9ac67b396"
