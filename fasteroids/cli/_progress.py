"""Progress on standard error, for long runs on a terminal only."""

from __future__ import annotations

import sys
from time import monotonic
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress as Bar
    from rich.progress import TaskID

__all__ = ["Progress"]

_PATIENCE = 1.0  # s before anything is shown
_PERIOD = 0.2  # s between two looks
_STRIDE = 64  # events between two looks at the clock


class Progress:
    """How far a run is, and how fast. Shows nothing in its first second, nor unless stderr is a terminal."""

    def __init__(self, start: float, until: float) -> None:
        self._start, self._span = start, until - start
        self._wanted = sys.stderr is not None and sys.stderr.isatty()
        self._begun = self._last = monotonic()
        self._before = 0
        self._bar: Bar | None = None
        self._task: TaskID | None = None

    def show(self, time: float, events: int) -> None:
        """The run is at `time` s after so many events."""
        if not self._wanted or events % _STRIDE:
            return
        now = monotonic()
        if now - self._begun < _PATIENCE or now - self._last < _PERIOD:
            return
        rate = (events - self._before) / (now - self._last)
        self._last, self._before = now, events
        if self._bar is None:
            self._open()
        assert self._bar is not None
        assert self._task is not None
        said = f"{time:.6g} s, {events:,} events, {rate:,.0f} events/s"
        done = (time - self._start) / self._span if self._span > 0.0 else 1.0
        self._bar.update(self._task, completed=done, description=said)

    def _open(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, TextColumn
        from rich.progress import Progress as Bar

        self._bar = Bar(
            BarColumn(),
            TextColumn("{task.percentage:>3.0f} %"),
            TextColumn("{task.description}"),
            console=Console(stderr=True),
            transient=True,
        )
        self._task = self._bar.add_task("", total=1.0)
        self._bar.start()

    def close(self) -> None:
        """Take it off the terminal."""
        self._wanted = False
        if self._bar is not None:
            self._bar.stop()
            self._bar = None
