"""Progress on standard error, for long work on a terminal only."""

from __future__ import annotations

import os
import sys
from time import monotonic
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress as Bar
    from rich.progress import TaskID

__all__ = ["GamesProgress", "Progress", "RunProgress"]

_PATIENCE = 1.0  # s before anything is shown
_PERIOD = 0.2  # s between two looks
_STRIDE = 64  # events between two looks at the clock


class Progress:
    """A bar with a few words. Shows nothing in its first second, nor unless stderr is a terminal."""

    def __init__(self) -> None:
        terminal = sys.stderr is not None and sys.stderr.isatty()
        self.wanted = terminal and os.environ.get("TERM") != "dumb"  # that takes no line back
        self._begun = self._last = monotonic()
        self._bar: Bar | None = None
        self._task: TaskID | None = None

    def due(self) -> tuple[float, float] | None:
        """The seconds since it began and since it was last due, if it is to be shown now; else None."""
        if not self.wanted:
            return None
        now = monotonic()
        since, before = now - self._begun, now - self._last
        if since < _PATIENCE or before < _PERIOD:
            return None
        self._last = now
        return since, before

    def update(self, share: float, said: str) -> None:
        """Show that a share of the work, from 0 to 1, is done."""
        if self._bar is None:
            self._open()
        assert self._bar is not None
        assert self._task is not None
        self._bar.update(self._task, completed=share, description=said)

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
        self.wanted = False
        if self._bar is not None:
            self._bar.stop()
            self._bar = None


class RunProgress(Progress):
    """How far a run is, and how fast."""

    def __init__(self, start: float, until: float) -> None:
        super().__init__()
        self._start, self._span = start, until - start
        self._before = 0

    def show(self, time: float, events: int) -> None:
        """The run is at `time` s after so many events."""
        if not self.wanted or events % _STRIDE or (due := self.due()) is None:
            return
        rate = (events - self._before) / due[1]
        self._before = events
        done = (time - self._start) / self._span if self._span > 0.0 else 1.0
        self.update(done, f"{time:.6g} s, {events:,} events, {rate:,.0f} events/s")


class GamesProgress(Progress):
    """How many games are done, and how long the others will take. `done` counts those that were done before."""

    def __init__(self, done: int, games: int) -> None:
        super().__init__()
        self._before, self._games = done, games

    def show(self, done: int) -> None:
        """So many games are done."""
        if (due := self.due()) is None or done == self._before:
            return
        left = round(due[0] / (done - self._before) * (self._games - done))
        hours, minutes = divmod(left // 60, 60)
        clock = f"{hours}:{minutes:02}:{left % 60:02}" if hours else f"{minutes}:{left % 60:02}"
        self.update(done / self._games, f"{done:,} of {self._games:,} games, {clock} left")
