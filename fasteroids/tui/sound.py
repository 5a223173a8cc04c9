"""Short sounds, made here and mixed here, played by another process.

Opening a sound device can write to the terminal from within a C library, take its time, or crash. So a small process
does it (`fasteroids.tui._player`): it makes and mixes the sounds, and is told what to play by a byte each. It needs the
extra `sound` (miniaudio). Without it, without a device, or when that process ends for any reason, there is silence.
"""

from __future__ import annotations

import os
import subprocess
import sys
from array import array
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from math import exp, pi, sin
from random import Random
from types import TracebackType
from typing import IO, Final, Literal, NamedTuple, Protocol, TypeAlias, get_args

from fasteroids.events import Happened

__all__ = [
    "EFFECTS",
    "MOST_VOICES",
    "RATE",
    "Effect",
    "Player",
    "Sound",
    "Voice",
    "effect_of",
    "mixed",
    "samples",
    "started",
]

Effect: TypeAlias = Literal["shot", "blast", "knock", "loss", "wave", "over"]
"""A bullet fired, a death, a bounce, the death of one's own ship, a new wave, the end of the game."""

EFFECTS: Final[tuple[Effect, ...]] = get_args(Effect)

RATE: Final = 22_050
"""Samples a second; one channel of 16 bits."""

MOST_VOICES: Final = 4
"""Sounds at once; the oldest ends when one more begins."""

_LOUDNESS: Final = 8_000  # of one voice; four of them fit in 16 bits


# Making. Each formula gives a value in [-1, 1] at a time in seconds.


def _sweep(t: float, start: float, end: float, length: float) -> float:
    """A tone whose frequency (Hz) goes from one to another, and which fades."""
    phase = 2 * pi * (start * t + (end - start) * t * t / (2 * length))
    return sin(phase) * (1 - t / length)


def _shot(length: float) -> list[float]:
    return [_sweep(t, 1_200, 250, length) for t in _times(length)]


def _blast(length: float) -> list[float]:
    noise, level, values = Random(7), 0.0, []
    for t in _times(length):
        level += 0.2 * (noise.uniform(-1, 1) - level)  # without its highest tones
        values.append(min(1.0, max(-1.0, 2.5 * level)) * exp(-6 * t / length))
    return values


def _knock(length: float) -> list[float]:
    return [sin(2 * pi * 190 * t) * exp(-5 * t / length) * (1 - t / length) for t in _times(length)]


def _loss(length: float) -> list[float]:
    return [_sweep(t, 420, 60, length) for t in _times(length)]


def _notes(length: float, *tones: float) -> list[float]:
    each = length / len(tones)
    return [_sweep(t, tone, tone, each) for tone in tones for t in _times(each)]


def _times(length: float) -> Iterable[float]:
    return (i / RATE for i in range(int(length * RATE)))


_MAKERS: Final[dict[Effect, Callable[[], list[float]]]] = {
    "shot": lambda: _shot(0.11),
    "blast": lambda: _blast(0.45),
    "knock": lambda: _knock(0.06),
    "loss": lambda: _loss(0.7),
    "wave": lambda: _notes(0.3, 440, 660),
    "over": lambda: _notes(0.9, 440, 330, 220),
}


@cache
def samples(effect: Effect) -> array[int]:
    """A sound, as samples of 16 bits."""
    return array("h", (round(_LOUDNESS * value) for value in _MAKERS[effect]()))


# Mixing.


class Voice(NamedTuple):
    """A sound that is being played, and how many of its samples have been."""

    effect: Effect
    played: int = 0


def mixed(voices: Sequence[Voice], count: int) -> tuple[array[int], tuple[Voice, ...]]:
    """The next samples of some voices together, and the voices that go on after them.

    Of more than `MOST_VOICES` the last ones are heard.
    """
    sums = array("h", bytes(2 * count))
    left = []
    for voice in voices[-MOST_VOICES:]:
        whole = samples(voice.effect)
        for i, value in enumerate(whole[voice.played : voice.played + count]):
            sums[i] += value
        if voice.played + count < len(whole):
            left.append(Voice(voice.effect, voice.played + count))
    return sums, tuple(left)


def effect_of(happened: Happened) -> Effect | None:
    """The sound of what happened in a world, None if it makes none."""
    if happened.died:
        return "blast"
    if happened.effect == "fire":
        return "shot"
    return "knock" if happened.kind == "contact" else None


# Playing.


class Player(Protocol):
    """What `Sound` needs of a process."""

    @property
    def stdin(self) -> IO[bytes] | None:
        """Where it is told what to play."""

    def poll(self) -> int | None:
        """Its exit code, None while it runs."""

    def wait(self, timeout: float | None = None) -> int:
        """Wait for its end."""

    def kill(self) -> None:
        """End it."""


def started() -> Player:
    """The process that plays."""
    return subprocess.Popen(
        [sys.executable, "-m", "fasteroids.tui._player"],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        bufsize=0,
        start_new_session=True,  # what a user's Ctrl-C ends is the game, which ends this one
    )


class Sound:
    """Plays effects, or does nothing. Nothing it does raises, or waits. A context manager.

    `on` tells whether it can play; `note` says why not, in words for the user, and is empty while it can. While `muted`
    nothing is played.
    """

    def __init__(self, start: Callable[[], Player] | None = None, *, wanted: bool = True) -> None:
        """`start` begins the process; it is `started` if the extra is there. Not `wanted`: silence."""
        self.note = ""
        self.muted = False
        self._player: Player | None = None
        if not wanted:
            self.note = "sound is off"
            return
        if start is None:
            if find_spec("miniaudio") is None:
                self.note = "no sound: install fasteroids[sound]"
                return
            start = started
        try:
            player = start()
            if player.stdin is not None and hasattr(os, "set_blocking"):
                os.set_blocking(player.stdin.fileno(), False)
            self._player = player
        except (OSError, ValueError, subprocess.SubprocessError) as error:
            self.note = f"no sound: {error}"

    @property
    def on(self) -> bool:
        """Can it play?"""
        return self._player is not None

    def play(self, effect: Effect) -> None:
        """Play a sound now, beside those that are being played. A player that is too busy misses it."""
        if self._player is None or self._player.stdin is None or self.muted:
            return
        try:
            if self._player.poll() is None:
                self._player.stdin.write(bytes([EFFECTS.index(effect)]))
                return
        except BlockingIOError:
            return
        except (OSError, ValueError):
            pass
        self._stop("no sound: there is no device that plays it", patience=0.0)

    def close(self) -> None:
        """Silence, for good."""
        self._stop("sound is off", patience=0.5)

    def _stop(self, note: str, patience: float) -> None:
        """Let the process end by itself for some seconds, then end it."""
        player, self._player = self._player, None
        if player is None:
            return
        self.note = note
        with suppress(OSError, ValueError):
            if player.stdin is not None:
                player.stdin.close()
        try:
            player.wait(timeout=patience)
        except subprocess.TimeoutExpired:
            player.kill()
            player.wait()

    def __enter__(self) -> Sound:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
