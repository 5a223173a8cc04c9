"""Recordings: what is written is read, lived again with the same bits, and no damage raises anything but a sentence."""

from __future__ import annotations

import gzip
import io
import json
from itertools import islice
from typing import Any

from attrs import evolve as with_fields
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fasteroids import ModelError, Ship, World
from fasteroids.entities import id_of
from fasteroids.history.inputs import Act, Add, Instruct, Remove
from fasteroids.history.living import Lived, Past, answered, beginning, lived
from fasteroids.history.recording import (
    Recording,
    RecordingError,
    RecordingFile,
    Snapshot,
    differing,
    headed,
    read,
    verified,
)
from fasteroids.history.recording.digests import digest
from fasteroids.moments import advanced, between, clock_at
from fasteroids.scene import document, dump_scene, world_of
from fasteroids.testing import Script, actions, machines, unfold
from fasteroids.testing.runs import FOREVER
from tests.properties.laws import BURNING, EXAMPLES, FLOWING, same

recording_law = settings(max_examples=max(EXAMPLES // 3, 20))
"""Each example lives a past twice or more."""

_TEXTS = st.sampled_from(["here", "", '"\\\n', "é ☃ \U0001f600", "\ud800"])
_EVERY = st.sampled_from([1.0, 10.0, 0.3, 2.0**-10, 1e300])


def without_scripts(world: World) -> World:
    """The world without the ships whose programs have no text."""
    for ship in world.ships:
        if isinstance(ship.program, Script):
            world = world.remove(id_of(ship))
    return world


@st.composite
def recorded(
    draw: st.DrawFn, worlds: st.SearchStrategy[World], *, packed: bool = False
) -> tuple[bytes, Lived]:
    """The bytes of a recording of a world that runs, is cut, and is told things; and its last state."""
    world = without_scripts(draw(worlds))
    header = headed(
        world, title=draw(st.none() | _TEXTS), every_hash=draw(_EVERY), every_snapshot=draw(_EVERY)
    )
    file, state = io.BytesIO(), beginning(world)
    writing = RecordingFile(file, world, header, clock=lambda: 0.0, packed=packed)
    moves = ["run", "run", "cut", "act", "act", "instruct", "remove", "add", "bookmark"]
    for move in draw(st.lists(st.sampled_from(moves), max_size=10)):
        for after in _moved(draw, state, move):
            writing.add(after)
            state = after
        if move == "bookmark":
            writing.bookmark(draw(_TEXTS))
    writing.finish((*state.world.now, state.world.clock[2]), "enough")
    return file.getvalue(), state


def _moved(draw: st.DrawFn, state: Lived, move: str) -> list[Lived]:
    """The states that a move leads to."""
    world = state.world
    ships = [i for i, e in world.entities.items() if isinstance(e, Ship)]
    match move:
        case "run":
            return list(islice(lived(state, clock_at(FOREVER)), draw(st.integers(1, 40))))
        case "cut":
            after = next(lived(state, clock_at(FOREVER)))
            gap = between(world.now, after.world.now)
            if gap > 0.0:
                return list(
                    lived(state, advanced(world.clock, draw(st.sampled_from([0.3, 1.0])) * gap))
                )
        case "act" if ships:
            return [answered(state, Act(draw(st.sampled_from(ships)), draw(actions())))]
        case "instruct" if ships:
            return [answered(state, Instruct(draw(st.sampled_from(ships)), draw(machines())))]
        case "remove" if len(world):
            return [answered(state, Remove(draw(st.sampled_from(list(world.entities)))))]
        case "add" if len(world):
            gone = world[draw(st.sampled_from(list(world.entities)))]
            state = answered(state, Remove(id_of(gone)))
            try:
                again = answered(state, Add(with_fields(gone, id=None)))
            except ModelError:  # the rounding that was forgiven to the old one
                return [state]
            return [state, again]
    return []


@recording_law
@given(recorded(BURNING))
def test_a_recording_of_any_world_happens_again(made: tuple[bytes, Lived]) -> None:
    data, last = made
    recording = read(data)
    assert recording.short is None
    told = verified(recording)
    assert told.difference is None, str(told.difference)
    assert told.lines == len(recording.lines) + 1
    assert recording.at(recording.until) == last.world


@recording_law
@given(recorded(FLOWING), st.integers(1, 40))
def test_a_recording_happens_again_however_time_is_cut(
    made: tuple[bytes, Lived], slices: int
) -> None:
    recording = read(made[0])
    assume(recording.header.cuts == "free" and 0.0 < recording.time / slices)
    told = verified(recording, slice=recording.time / slices)
    assert told.difference is None, str(told.difference)


@recording_law
@given(recorded(BURNING))
def test_a_recording_is_written_again_as_it_was(made: tuple[bytes, Lived]) -> None:
    recording = read(made[0])
    text = "".join(recording.rewritten())
    assert text.encode() == made[0]
    assert differing(recording, read(text.encode())) is None


@recording_law
@given(recorded(BURNING), st.floats(0.0, 1.0))
def test_any_moment_lived_from_a_snapshot_is_that_lived_from_the_first_world(
    made: tuple[bytes, Lived], share: float
) -> None:
    recording = read(made[0])
    moments = [(*line.moment, 0.0) for line in recording.lines if isinstance(line, Snapshot)]
    start, end = recording.world.time, recording.time
    if start < (time := start + share * (end - start)) < end:
        moments.append(clock_at(time))
    for moment in moments:
        assert recording.at(moment) == ended(recording.past(moment))


def ended(past: Past) -> World:
    """The last world of a past."""
    while True:
        try:
            next(past)
        except StopIteration as stop:
            world: World = stop.value.world
            return world


@recording_law
@given(recorded(BURNING), st.data())
def test_a_recording_cut_at_any_byte_tells_what_stands_before(
    made: tuple[bytes, Lived], data: st.DataObject
) -> None:
    plain, _ = made
    whole = read(plain)
    for file in (plain, gzip.compress(plain, 1)):
        size = data.draw(st.integers(0, len(file) - 1))
        cut = tried(file[:size])
        if isinstance(cut, str):
            assert file is not plain or b"\n" not in file[:size]
            continue
        assert cut.lines == whole.lines[: len(cut.lines)]
        assert cut.short is not None or cut.lines == whole.lines
        told = verified(cut)
        assert told.difference is None, str(told.difference)


@recording_law
@given(
    recorded(BURNING),
    st.booleans(),
    st.lists(st.tuples(st.floats(0, 1), st.integers(0, 7)), min_size=1, max_size=3),
)
def test_flipped_bits_give_a_sentence_or_another_recording(
    made: tuple[bytes, Lived], packed: bool, flips: list[tuple[float, int]]
) -> None:
    file = bytearray(gzip.compress(made[0], 1) if packed else made[0])
    for place, bit in flips:
        file[min(int(place * len(file)), len(file) - 1)] ^= 1 << bit
    check_bytes(bytes(file))


_ODD = [
    "NaN",
    "Infinity",
    "1e999",
    "-1",
    "1" * 5000,
    "[" * 5000,
    "{}",
    "null",
    '"x"',
    "true",
    "9" * 300,
    "1e308",
]


@recording_law
@given(recorded(BURNING), st.data())
def test_other_values_give_a_sentence_or_another_recording(
    made: tuple[bytes, Lived], data: st.DataObject
) -> None:
    """One value somewhere in a line, replaced or left out, or a whole line."""
    lines = made[0].decode().splitlines()
    i = data.draw(st.integers(0, len(lines) - 1))
    record = json.loads(lines[i])
    odd = data.draw(st.sampled_from(_ODD))
    match data.draw(st.sampled_from(["value", "value", "value", "missing", "line", "twice"])):
        case "value":
            holder: Any = record
            key: Any = data.draw(st.sampled_from(sorted(record)))
            while isinstance(holder[key], dict | list) and holder[key] and data.draw(st.booleans()):
                holder = holder[key]
                key = data.draw(
                    st.sampled_from(
                        sorted(holder) if isinstance(holder, dict) else range(len(holder))
                    )
                )
            holder[key] = "@"
            lines[i] = json.dumps(record).replace('"@"', odd)
        case "missing":
            del record[data.draw(st.sampled_from(sorted(record)))]
            lines[i] = json.dumps(record)
        case "line":
            lines[i] = odd
        case "twice":
            lines.insert(i, lines[i])
    check_bytes("\n".join(lines).encode())


@given(st.binary(max_size=200))
def test_any_bytes_are_a_recording_or_a_sentence(data: bytes) -> None:
    check_bytes(data)
    check_bytes(b"\x1f\x8b" + data)
    check_bytes(gzip.compress(data))


def check_bytes(data: bytes) -> None:
    """They give a recording that can be lived again, to a difference perhaps, or a sentence."""
    recording = tried(data)
    if isinstance(recording, str):
        assert recording
    else:
        verified(recording)
        assert "".join(recording.rewritten())


def tried(data: bytes) -> Recording | str:
    """The recording in some bytes, or what is wrong with them."""
    try:
        return read(data)
    except RecordingError as error:
        return str(error)


# Documents of worlds.


@recording_law
@given(BURNING, st.integers(0, 20))
def test_a_document_is_the_world_also_after_a_way_through_json(world: World, count: int) -> None:
    world = unfold(without_scripts(world), events=count).end
    table = document(world)
    back = world_of(json.loads(json.dumps(table, allow_nan=False)))
    assert back == world
    assert digest(back) == digest(world)  # tells 0.0 from -0.0
    assert back.roster.next_id == world.roster.next_id
    assert document(back) == table
    assert dump_scene(back) == dump_scene(world)
    same(unfold(world, events=20), unfold(back, events=20))
