"""The recordings in a folder, told in short: what a list of them needs, without living them again."""

from __future__ import annotations

import gzip
import json
import time
import zlib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, Final

from attrs import frozen

from fasteroids.tui.keeping import recordings

__all__ = ["Brief", "brief", "briefs"]

_HEAD: Final = 1 << 20
"""Bytes in which a header is looked for."""

_TAIL: Final = 1 << 16
"""Bytes at the end in which the last line is looked for."""

_LARGEST: Final = 1 << 28
"""Bytes of a packed recording that are looked at."""


@frozen
class Brief:
    """A recording in short. `title` says that it is damaged if nothing can be told; `whole`: did it come to its end?"""

    place: Path
    title: str
    seed: int | None = None
    seconds: float | None = None
    whole: bool = False
    size: int = 0
    when: str = ""
    """Local time, of its last writing."""


def briefs(folder: Path) -> list[Brief]:
    """The recordings in a folder, the newest first. Never raises."""
    return [brief(place) for place in recordings(folder)]


def brief(place: Path) -> Brief:
    """A recording in short. Never raises."""
    try:
        found = place.stat()
        when = time.strftime("%Y-%m-%d %H:%M", time.localtime(found.st_mtime))
        head, tail = _ends(place)
    except (OSError, EOFError, zlib.error, ValueError) as error:
        return Brief(place, f"cannot be read: {getattr(error, 'strerror', None) or error}")
    first = _record(head.partition(b"\n")[0])
    if first.get("type") != "header":
        return Brief(place, "no recording, or a damaged one", size=found.st_size, when=when)
    last = next((row for row in _records(tail) if "time" in row), {})
    title, seed, seconds = first.get("title"), first.get("seed"), last.get("time")
    return Brief(
        place,
        title if isinstance(title, str) else place.name,
        seed if isinstance(seed, int) else None,
        float(seconds) if isinstance(seconds, int | float) else None,
        last.get("type") == "result",
        found.st_size,
        when,
    )


def _ends(place: Path) -> tuple[bytes, bytes]:
    """The first and the last bytes."""
    with place.open("rb") as file:
        packed = file.read(2) == b"\x1f\x8b"
    if packed:
        with gzip.open(place, "rb") as stream:
            data = stream.read(_LARGEST)
        return data[:_HEAD], data[-_TAIL:]
    with place.open("rb") as file:
        return file.read(_HEAD), _end(file)


def _end(file: IO[bytes]) -> bytes:
    size = file.seek(0, 2)
    file.seek(max(size - _TAIL, 0))
    return file.read()


def _records(tail: bytes) -> Iterator[dict[str, Any]]:
    """The last lines, from the end."""
    for row in reversed(tail.split(b"\n")):
        yield _record(row)


def _record(row: bytes) -> dict[str, Any]:
    with suppress(ValueError, RecursionError):
        found = json.loads(row)
        if isinstance(found, dict):
            return found
    return {}
