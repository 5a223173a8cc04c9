"""A recording written to a file while it is made, so that a crash loses the last second of it at the most."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from types import TracebackType
from typing import IO, Final

from fasteroids.history.inputs import Place
from fasteroids.history.living import Lived
from fasteroids.history.recording.lines import Header
from fasteroids.history.recording.writing import Recorder
from fasteroids.moments import Clock
from fasteroids.state import World

__all__ = ["PERIOD", "RecordingFile"]

PERIOD: Final = 0.5
"""Seconds of the given clock after which what was written is handed to the system."""

_LEVEL: Final = 1  # of compression: the fastest, as a run waits for it
_WBITS: Final = 31  # gzip


class RecordingFile:
    """A recording that grows in a binary file, which stays the caller's to open and to close. A context manager.

    `clock` tells seconds that pass, as `time.monotonic` does. Whole lines are handed to the file and flushed
    whenever something comes and `PERIOD` has passed since the last time; `tend` asks only for that. With `packed` the
    file is one of gzip, which can be read up to the last flush. An error of the file is passed on.
    """

    def __init__(
        self,
        file: IO[bytes],
        first: World,
        header: Header | None = None,
        *,
        clock: Callable[[], float],
        packed: bool = False,
    ) -> None:
        self._file, self._clock = file, clock
        self._pack = zlib.compressobj(_LEVEL, wbits=_WBITS) if packed else None
        self.recorder = Recorder(self._write, first, header)
        self._due = clock()
        self._closed = False
        self.flush()

    def __enter__(self) -> RecordingFile:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def add(self, state: Lived) -> None:
        """The next state of the past. Errors as those of `Recorder.add`."""
        self.recorder.add(state)
        if self._clock() >= self._due:
            self.flush()

    def bookmark(self, name: str, place: Place | None = None) -> None:
        """A name for a place; for the last state, if none is given."""
        self.recorder.bookmark(name, place)
        self.tend()

    def finish(self, clock: Clock, ended: str = "time") -> None:
        """The end of the recording, as `Recorder.finish`."""
        self.recorder.finish(clock, ended)
        self.close()

    def tend(self) -> None:
        """Flush, if it is time to: for whoever waits while nothing happens."""
        if self._clock() >= self._due:
            self.flush()

    def flush(self) -> None:
        """Hand all that was recorded to the system."""
        assert not self._closed
        self.recorder.flush()
        if self._pack is not None:
            self._file.write(self._pack.flush(zlib.Z_SYNC_FLUSH))
        self._file.flush()
        self._due = self._clock() + PERIOD

    def close(self) -> None:
        """Flush, and end what is compressed. Without `finish` the recording is one that was cut short."""
        if self._closed:
            return
        self.recorder.flush()
        self._closed = True
        if self._pack is not None:
            self._file.write(self._pack.flush(zlib.Z_FINISH))
        self._file.flush()

    def _write(self, text: str) -> None:
        data = text.encode("ascii")
        try:
            self._file.write(data if self._pack is None else self._pack.compress(data))
        except OSError:
            self._closed = True  # nothing may follow a hole
            raise
