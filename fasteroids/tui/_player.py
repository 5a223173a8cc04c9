"""The process that plays sounds: `python -m fasteroids.tui._player`. See `fasteroids.tui.sound`.

Each byte on its standard input is the number of an effect. It ends with its input, and with an exit code that is not 0
if it cannot play.
"""

from __future__ import annotations

import os
import sys
from array import array
from collections import deque
from collections.abc import Generator
from importlib import import_module

from fasteroids.tui.sound import EFFECTS, MOST_VOICES, RATE, Voice, mixed, samples

__all__ = ["main", "stream"]

_BUFFER = 50  # milliseconds from a byte to its sound


def stream(new: deque[Voice]) -> Generator[array[int], int, None]:
    """What a device plays: sent a number of samples, it gives so many. It takes voices that begin from `new`."""
    voices: tuple[Voice, ...] = ()
    count = yield array("h")
    while True:
        while new:
            voices = (*voices, new.popleft())[-MOST_VOICES:]
        block, voices = mixed(voices, count)
        count = yield block


def main() -> int:
    """Play what standard input says."""
    try:
        miniaudio = import_module("miniaudio")
        device = miniaudio.PlaybackDevice(
            output_format=miniaudio.SampleFormat.SIGNED16,
            nchannels=1,
            sample_rate=RATE,
            buffersize_msec=_BUFFER,
            app_name="fasteroids",
        )
    except Exception:  # whatever a sound system does, the game is told by the exit code
        return 1
    for effect in EFFECTS:
        samples(effect)
    new: deque[Voice] = deque()
    playing = stream(new)
    next(playing)
    device.start(playing)
    try:
        while data := os.read(sys.stdin.fileno(), 64):
            new.extend(Voice(EFFECTS[byte]) for byte in data if byte < len(EFFECTS))
    finally:
        device.close()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
