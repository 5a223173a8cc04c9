"""Recordings by the names of their files."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import IO, Final

from fasteroids.cli._files import STDIO, names_file, read_limited, shipped
from fasteroids.cli._guard import Refusal, reason
from fasteroids.history.recording import Recording, RecordingError, read
from fasteroids.moments import Clock, clock_at

__all__ = ["BEGIN", "clock_in", "open_recording", "titled"]

BEGIN: Final = (b"{", b"\x1f\x8b")
"""How a recording begins, plain and compressed by gzip."""

_PEEK: Final = 4096  # bytes

_TABLES: Final = ("[world]", "[[ship]]", "[[asteroid]]", "[[bullet]]", "[[asteroid-field]]")


def titled(place: str) -> str:
    """What to call a recording: its path as it was given, or standard input."""
    if place == STDIO:
        return "standard input"
    return place if place.isprintable() else repr(place)


def open_recording(place: str) -> Recording:
    """The recording in a file, or on standard input ('-'). `Refusal` with a sentence if there is none."""
    title = titled(place)
    data = _bytes(place, title)
    try:
        return read(data)
    except RecordingError as error:
        raise Refusal(f"{title}: {error}") from None


def _bytes(place: str, title: str) -> bytes:
    if place == STDIO:
        if sys.stdin is None:
            raise Refusal("standard input is closed")
        return _begun(sys.stdin.buffer, title, place)
    if not place:
        raise Refusal("cannot read '': there is no such file")
    path = Path(place)
    if not names_file(path) and path.name == place and place in shipped():
        raise Refusal(_is_scene(place, place))
    try:
        with path.open("rb") as file:
            return _begun(file, title, place)
    except OSError as error:
        raise Refusal(f"cannot read {reason(error, place)}") from None
    except ValueError:  # a null character in a name
        raise Refusal(f"cannot read {place!r}: there is no such file") from None


def _begun(file: IO[bytes], title: str, place: str) -> bytes:
    """All of a file that begins as a recording does. Of another not much more than its beginning is read."""
    head = file.read(_PEEK)
    if head and not head.startswith(BEGIN):
        if _looks_like_scene(head):
            raise Refusal(_is_scene(title, place))
        raise Refusal(
            f"{title} is no recording: it does not begin with a header, an object of JSON"
        )
    return head + read_limited(file, title, "recording")


def _looks_like_scene(head: bytes) -> bool:
    """Is there a line, in the beginning of a file, that opens a table of a scene?"""
    lines = head.decode("utf-8-sig", "replace").splitlines()
    return any(line.strip() in _TABLES for line in lines)


def _is_scene(title: str, place: str) -> str:
    return f"{title} is a scene; record it first: fasteroids record {place} -o FILE"


def clock_in(recording: Recording, title: str, time: float | None) -> Clock:
    """The clock of a time (s) in a recording, its end if None is given; `Refusal` if it does not go there."""
    if time is None or time == recording.time:
        return recording.until
    clock = clock_at(time)
    if time != recording.world.time and not recording.world.now <= clock[:2] <= recording.until[:2]:
        raise Refusal(
            f"{title} goes from {recording.world.time!r} s to {recording.time!r} s; "
            f"there is no {time!r} s in it"
        )
    return max(clock, recording.world.clock)
