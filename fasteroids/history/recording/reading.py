"""A recording from the bytes of its file, plain or compressed by gzip, whole or cut short anywhere.

`read` is total: it gives a `Recording`, or raises `RecordingError` with a sentence. A file that was cut short, or whose
compression is damaged from some byte on, gives what stands before that.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

from attrs import evolve, frozen

from fasteroids.history.inputs import Cut, Given, Place
from fasteroids.history.living import Lived, Past, beginning, cuts_decide, relived
from fasteroids.history.recording.errors import RecordingError
from fasteroids.history.recording.events import line
from fasteroids.history.recording.lines import (
    Bookmark,
    Entered,
    Event,
    Header,
    Line,
    Result,
    Snapshot,
    record_of,
)
from fasteroids.history.recording.parsing import Texts, header_of, line_of, reader, told
from fasteroids.history.recording.strict import parsed
from fasteroids.moments import Clock, Moment, seconds
from fasteroids.scene import world_of
from fasteroids.state import World

__all__ = ["MOST_BYTES", "Recording", "read"]

MOST_BYTES: Final = 2**30
"""A recording has at most so many bytes when it is unpacked. A limit, so that a small file cannot fill the memory."""

_GZIP: Final = b"\x1f\x8b"
_WBITS: Final = 31  # gzip, with any window
_PIECE: Final = 16 * 1024


@frozen
class Recording:
    """What a file tells: the header, the first world, and every line after the header.

    `texts` are the programs in it by their names. `short` says where the file was cut, if it has no result.
    """

    header: Header
    world: World
    lines: tuple[Line, ...]
    texts: Mapping[str, str]
    short: str | None

    @property
    def result(self) -> Result | None:
        """The last line, if the recording came to its end."""
        last = self.lines[-1] if self.lines else None
        return last if isinstance(last, Result) else None

    @property
    def givens(self) -> list[Given]:
        """The inputs, in order."""
        return [each.given for each in self.lines if isinstance(each, Entered)]

    @property
    def bookmarks(self) -> list[Bookmark]:
        """The names for places, in the order in which they were given."""
        return [each for each in self.lines if isinstance(each, Bookmark)]

    @property
    def until(self) -> Clock:
        """How far it goes."""
        if self.result is not None:
            return self.result.clock
        if not self.lines:
            return self.world.clock
        return *_last(self.lines, self.world), 0.0

    @property
    def time(self) -> float:
        """How far it goes, s."""
        return seconds(*self.until[:2])

    def past(self, until: Clock | None = None) -> Past:
        """Its past lived again from the first world, up to a clock, or to its end. Each state, then the last.

        `ModelError` if an input makes no sense where it comes, which only a file that was changed can tell.
        """
        return self.lived(
            beginning(self.world), self.givens, self.until if until is None else until
        )

    def at(self, until: Clock) -> World:
        """The world at a clock from its start to its end, lived again from the last snapshot before it.

        `ModelError` as `past`; `RecordingError` if the snapshot is no world.
        """
        begun, rest = beginning(self.world), self.lines
        for i in range(len(self.lines) - 1, -1, -1):
            snapshot = self.lines[i]
            if isinstance(snapshot, Snapshot) and snapshot.moment <= until[:2]:
                begun, rest = self._begun(snapshot, i), self.lines[i:]
                break
        givens = (each.given for each in rest if isinstance(each, Entered))
        past = self.lived(begun, givens, until)
        while True:
            try:
                next(past)
            except StopIteration as stop:
                last: Lived = stop.value
                return last.world

    def lived(self, last: Lived, givens: Iterable[Given], until: Clock) -> Past:
        """Its past from a state on, through inputs, up to a clock, and not beyond its end: see `Result.nth`."""
        givens = (each for each in givens if each.place[:2] <= until[:2])
        end = None if self.result is None else self.result.place
        past = relived(last, givens, until)
        while True:
            try:
                state = next(past)
            except StopIteration as stop:
                reached: Lived = stop.value
                return reached
            if end is not None and state.place > end:
                # In the middle of a moment: only what rounding left on the clock is still to come.
                return last._replace(world=evolve(last.world, clock=until))
            last = state
            yield last

    def _begun(self, snapshot: Snapshot, index: int) -> Lived:
        """The state that a snapshot, the line of this index, tells: after as much as happened at its moment."""
        try:
            world: World = told(lambda: world_of(snapshot.world, read=reader(self.texts)))
        except RecordingError as error:
            raise RecordingError(f'"world": {error}', index + 2) from None
        nth = 0
        for each in reversed(self.lines[:index]):
            if each.moment != snapshot.moment and not isinstance(each, Bookmark):
                break
            cut = isinstance(each, Entered) and isinstance(each.given.what, Cut)
            nth += isinstance(each, Event | Entered) and not cut
        return Lived(Place(*snapshot.moment, nth), None, world)

    def rewritten(self) -> Iterator[str]:
        """Its lines, each with its end, as a writer would write them, unknown fields kept. Places in them move."""
        yield line(record_of(self.header)) + "\n"
        for each in self.lines:
            yield line(record_of(each)) + "\n"


def read(data: bytes) -> Recording:
    """The recording in the bytes of a file; `RecordingError` with a sentence if there is none."""
    damage = None
    if data.startswith(_GZIP):
        data, damage = _unpacked(data)
    if len(data) > MOST_BYTES:
        raise RecordingError(f"a recording has at most {MOST_BYTES} bytes; this one has more")
    if not data:
        raise RecordingError(damage or "the file is empty; a recording begins with a header")
    rows = data.split(b"\n")
    cut = rows.pop()
    if cut and _is_whole(cut):  # only its end is missing
        rows.append(cut)
        cut = b""
    if not rows:
        raise RecordingError("the header is cut short, or this is no recording", 1)
    header, world, texts = _begun(rows[0])
    lines = tuple(_lines(rows, world, texts))
    short = None
    if not (lines and isinstance(lines[-1], Result)):
        where = f"in line {len(rows) + 1}" if cut else f"after line {len(rows)}"
        short = f"{damage or 'it is cut short'} {where}, at {seconds(*_last(lines, world))!r} s"
    elif cut or damage:
        raise RecordingError("stands behind the result, which is the last line", len(rows) + 1)
    return Recording(header, world, lines, texts, short)


def _is_whole(row: bytes) -> bool:
    """Is a line without an end an object of JSON all the same?"""
    try:
        parsed(row.decode())
    except ValueError:
        return False
    return True


def _begun(row: bytes) -> tuple[Header, World, Texts]:
    """What the first line tells."""
    try:
        header = header_of(parsed(_text(row)))
        texts = dict(header.programs)
        world: World = told(lambda: world_of(header.world, read=reader(texts)))
        for name in ("model", "fuel", "seed"):
            if getattr(header, name) != getattr(world, name):
                raise RecordingError(f'"{name}" is not that of its world')
        if (header.cuts == "recorded") != cuts_decide(world):
            raise RecordingError(f'"cuts" cannot be {header.cuts} under the model {world.model}')
    except RecordingError as error:
        raise RecordingError(str(error), 1) from None
    return header, world, texts


def _lines(rows: list[bytes], world: World, texts: Texts) -> Iterator[Line]:
    """What the lines after the first tell, in the order of time."""
    now, ended = world.now, False
    for number, row in enumerate(rows[1:], 2):
        try:
            made = line_of(parsed(_text(row)), texts)
            if ended:
                raise RecordingError("stands behind the result, which is the last line")
            if not isinstance(made, Bookmark):
                if made.moment < now:
                    raise RecordingError(
                        f"goes back in time, from {seconds(*now)!r} s to {seconds(*made.moment)!r} s"
                    )
                now = made.moment
        except RecordingError as error:
            raise RecordingError(str(error), number) from None
        ended = isinstance(made, Result)
        yield made


def _text(row: bytes) -> str:
    try:
        return row.decode()
    except UnicodeDecodeError as error:
        raise RecordingError(f"is no UTF-8 at byte {error.start + 1}") from None


def _last(lines: tuple[Line, ...], world: World) -> Moment:
    """The moment of the last line that is not about another."""
    return next((a.moment for a in reversed(lines) if not isinstance(a, Bookmark)), world.now)


# gzip.


def _unpacked(data: bytes) -> tuple[bytes, str | None]:
    """What gzip packed, as far as it can be had, and what is wrong where that ends."""
    parts: list[bytes] = []
    left, unzip = MOST_BYTES + 1, zlib.decompressobj(wbits=_WBITS)
    place = 0
    while left > 0:
        if unzip.eof:
            rest = unzip.unused_data + data[place:]
            if not rest:
                return b"".join(parts), None
            data, place, unzip = rest, 0, zlib.decompressobj(wbits=_WBITS)
        piece = data[place : place + _PIECE]
        if not piece:
            return b"".join(parts), "it is cut short"
        before = unzip.copy()
        try:
            part = unzip.decompress(piece, left)
        except zlib.error:
            return b"".join([*parts, _piecemeal(before, piece, left)]), "its compression is damaged"
        parts.append(part)
        left -= len(part)
        place += len(piece) - len(unzip.unconsumed_tail)
    return b"".join(parts), None


def _piecemeal(unzip: Any, piece: bytes, most: int) -> bytes:
    """What comes of a piece up to its damage."""
    parts: list[bytes] = []
    for i in range(len(piece)):
        try:
            parts.append(unzip.decompress(piece[i : i + 1], most))
        except zlib.error:
            break
    return b"".join(parts)
