"""Sounds: made, mixed, and played by another process that may fail in any way."""

from __future__ import annotations

import os
import subprocess
import sys
from array import array
from collections import deque
from pathlib import Path
from typing import IO, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Asteroid, Ship, World, check_program, happenings, parse_program
from fasteroids.tui import _player, sound
from fasteroids.tui.sound import (
    EFFECTS,
    MOST_VOICES,
    RATE,
    Effect,
    Sound,
    Voice,
    effect_of,
    mixed,
    samples,
    started,
)

ROOT = Path(__file__).resolve().parents[3]
voices = st.lists(st.builds(Voice, st.sampled_from(EFFECTS), st.integers(0, 30_000)), max_size=6)


class Fake:
    """A process that keeps what it is told."""

    def __init__(self, code: int | None = None) -> None:
        self.heard, self.code, self.ended = b"", code, False
        read, write = os.pipe()
        self.stdin: IO[bytes] | None = os.fdopen(write, "wb", buffering=0)
        self.pipe = os.fdopen(read, "rb", buffering=0)

    def poll(self) -> int | None:
        return self.code

    def wait(self, timeout: float | None = None) -> int:
        if self.stdin is not None and not self.stdin.closed:
            raise subprocess.TimeoutExpired("player", timeout or 0)
        self.ended = True
        return 0

    def kill(self) -> None:
        self.ended = True

    def told(self) -> list[Effect]:
        os.set_blocking(self.pipe.fileno(), False)
        return [EFFECTS[byte] for byte in self.pipe.read(100) or b""]

    def close(self) -> None:
        self.pipe.close()
        if self.stdin is not None:
            self.stdin.close()


@pytest.fixture
def player() -> Any:
    fake = Fake()
    yield fake
    fake.close()


# Making and mixing.


@pytest.mark.parametrize("effect", EFFECTS)
def test_every_sound_is_short_audible_and_ends_softly(effect: Effect) -> None:
    whole = samples(effect)
    assert 0.03 * RATE < len(whole) < RATE
    assert max(map(abs, whole)) > 3_000
    assert max(map(abs, whole[-20:])) < 300


@pytest.mark.parametrize("effect", EFFECTS)
def test_as_many_as_there_may_be_at_once_fit_in_16_bits(effect: Effect) -> None:
    assert MOST_VOICES * max(map(abs, samples(effect))) < 2**15


@given(voices, st.integers(0, 3_000))
def test_a_mix_has_the_length_asked_for_whatever_is_left_of_its_voices(
    some: list[Voice], count: int
) -> None:
    block, left = mixed(some, count)
    assert len(block) == count
    assert len(left) <= MOST_VOICES


@given(voices, st.integers(0, 2_000), st.integers(0, 2_000))
def test_a_mix_in_two_pieces_is_the_mix_in_one(some: list[Voice], a: int, b: int) -> None:
    first, left = mixed(some, a)
    second, end = mixed(left, b)
    assert (first + second, end) == mixed(some[-MOST_VOICES:], a + b)


def test_a_device_gets_silence_then_what_is_new_with_the_last_few_at_once() -> None:
    new: deque[Voice] = deque()
    playing = _player.stream(new)
    next(playing)
    assert playing.send(10) == array("h", bytes(20))
    new.extend([Voice("over"), *[Voice("shot")] * MOST_VOICES])
    assert playing.send(100) == array("h", (MOST_VOICES * value for value in samples("shot")[:100]))
    assert playing.send(RATE)
    assert playing.send(10) == array("h", bytes(20))


# What is heard.


def test_deaths_bounces_and_shots_are_heard_and_walls_are_not() -> None:
    shooter = check_program(parse_program("fire;").program).program
    world = World(1_000, 1_000).add_all(
        [
            Asteroid(100, 500, 10, 0, 20),
            Asteroid(200, 500, -10, 0, 20),
            Ship(500, 800, 0, 0, 20, 5e15, 0.0),
            Asteroid(620, 800, -50, 0, 20),
            Ship(800, 200, 0, 0, 20, 5e15, 0.0, program=shooter),
        ]
    )
    heard = {
        (happened.kind, happened.effect, effect_of(happened))
        for happened, _ in happenings(world, 6)
    }
    assert heard == {
        ("contact", "bounce", "knock"),
        ("contact", "die", "blast"),
        ("tick", "fire", "shot"),
        ("wall", "bounce", None),
        ("wall", "die", "blast"),
    }


# Playing.


def test_effects_reach_the_player_in_order(player: Fake) -> None:
    with Sound(lambda: player) as playing:
        assert (playing.on, playing.note) == (True, "")
        for effect in EFFECTS:
            playing.play(effect)
        assert player.told() == list(EFFECTS)
    assert player.ended
    assert player.stdin is not None
    assert player.stdin.closed
    assert not playing.on


def test_a_player_that_has_ended_switches_sound_off_for_good(player: Fake) -> None:
    playing = Sound(lambda: player)
    player.code = 1
    playing.play("shot")
    assert (playing.on, playing.note) == (False, "no sound: there is no device that plays it")
    playing.play("shot")
    playing.close()
    assert player.told() == []
    assert player.ended


def test_a_pipe_that_breaks_switches_sound_off(player: Fake) -> None:
    playing = Sound(lambda: player)
    player.pipe.close()
    playing.play("blast")
    assert not playing.on
    assert player.ended


def test_a_player_that_is_too_busy_misses_a_sound_and_nobody_waits(player: Fake) -> None:
    playing = Sound(lambda: player)
    for _ in range(200_000):
        playing.play("shot")
    assert playing.on
    playing.close()


@pytest.mark.parametrize(
    "error", [OSError("no process"), ValueError("bad"), subprocess.SubprocessError("x")]
)
def test_a_player_that_cannot_begin_is_silence(error: Exception) -> None:
    def fail() -> Fake:
        raise error

    playing = Sound(fail)
    playing.play("shot")
    assert (playing.on, playing.note) == (False, f"no sound: {error}")


def test_without_the_extra_there_is_silence_and_a_hint(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sound, "find_spec", lambda _: None)
    playing = Sound()
    assert (playing.on, playing.note) == (False, "no sound: install fasteroids[sound]")


def test_sound_that_is_not_wanted_begins_nothing() -> None:
    def fail() -> Fake:
        raise AssertionError

    assert Sound(fail, wanted=False).note == "sound is off"


def test_the_process_ends_quietly_where_it_cannot_play(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    # A library that complains on the terminal, as sound systems do, and fails.
    (tmp_path / "miniaudio.py").write_text(
        "import os; os.write(2, b'ALSA: no card'); raise OSError('no device')"
    )
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), str(ROOT)]))
    player = started()
    assert player.wait(60) == 1
    playing = Sound(lambda: player)
    playing.play("shot")
    assert not playing.on
    assert capfd.readouterr() == ("", "")


def test_the_process_plays_what_it_is_told_until_its_input_ends(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    # A device that asks for a second of sound when it is closed, and keeps it in a file.
    kept = tmp_path / "kept"
    (tmp_path / "miniaudio.py").write_text(
        f"""
class SampleFormat: SIGNED16 = 2
class PlaybackDevice:
    def __init__(self, output_format, nchannels, sample_rate, buffersize_msec, app_name):
        assert (output_format, nchannels) == (2, 1)
        self.rate = sample_rate
    def start(self, playing): self.playing = playing
    def close(self): open({str(kept)!r}, "wb").write(bytes(self.playing.send(self.rate)))
"""
    )
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), str(ROOT)]))
    player = started()
    assert player.stdin is not None
    player.stdin.write(bytes([EFFECTS.index("wave"), 200]))
    player.stdin.close()
    assert player.wait(60) == 0
    heard = array("h", kept.read_bytes())
    assert heard[: len(samples("wave"))] == samples("wave")
    assert len(heard) == RATE


def test_importing_sound_loads_no_library_of_sound() -> None:
    loaded = subprocess.run(
        [
            sys.executable,
            "-c",
            "import sys, fasteroids.tui.sound; print('miniaudio' in sys.modules)",
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert loaded.stdout == "False\n"
