"""One run of a scene, as the commands consume it: sliced at samples, bounded, interruptible, with progress."""

from __future__ import annotations

from collections import Counter
from collections.abc import Generator, Iterator
from itertools import count
from math import floor
from time import perf_counter
from types import TracebackType
from typing import Literal

from fasteroids.cli._guard import Refusal
from fasteroids.cli._interrupt import Interruptible
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._progress import RunProgress
from fasteroids.events import Happened, happenings
from fasteroids.state import World
from fasteroids.units import ModelError

__all__ = ["Fold", "Step", "stops"]

Step = tuple[Happened | None, World]
"""An event and the world just after it; a sample of the world has None for the event."""

_ENDS = {"max-events": "stopped", "interrupted": "interrupted", "error": "failed"}

_MOST_STEPS = 2**50  # k * every is a double of its own for every k up to here


class Fold:
    """A run until an absolute time (s), or for `max_events` events; a sample at each multiple of `every` s, if given.

    A context manager that takes Ctrl-C over, and an iterable of steps. During and after it: `world` is the last
    one, `events` counts them by kind, `died` and `born` entities, `elapsed` is the time (s) spent in the
    engine, `stopped` says why it ended: at its time, after its events, by Ctrl-C, on an `error` of the scene
    (kept, not raised), or, if nobody took the steps to the end, "left".
    """

    def __init__(
        self, world: World, until: float, *, max_events: int, every: float | None = None, progress: bool = False
    ) -> None:  # fmt: skip
        self.world, self.start = world, world.time
        self.until = until
        self.max_events = max_events
        self.events: Counter[str] = Counter()
        self.died = self.born = 0
        self.elapsed = 0.0
        self.error: ModelError | None = None
        self.stopped: Literal["time", "max-events", "interrupted", "error", "left"] = "left"
        if every is not None and not self.until / every <= _MOST_STEPS:
            raise Refusal(
                f"every {every!r} s is too often: that late as {self.until!r} s, times so close are not told apart"
            )
        self._unfold = Interruptible(_sliced(world, self.until, max_events, every))
        self._progress = RunProgress(self.start, self.until) if progress else None

    def __enter__(self) -> Fold:
        self._unfold.__enter__()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.hide_progress()
        self._unfold.__exit__(kind, error, trace)

    def hide_progress(self) -> None:
        """Clear the terminal of the progress shown."""
        if self._progress is not None:
            self._progress.close()

    @property
    def total(self) -> int:
        """How many events there were so far."""
        return self.events.total()

    @property
    def note(self) -> str | None:
        """What a user must know who expected the run to go to its end, or None."""
        if self.stopped in ("time", "left"):
            return None
        events = counted(self.total, "event")
        note = f"{_ENDS[self.stopped]} at {number(self.world.time)} s of {number(self.until)} s, after {events}"
        return note + "; --max-events allows no more" * (self.stopped == "max-events")

    def __iter__(self) -> Iterator[Step]:
        """The steps. Time is measured here: the engine works only between two of them."""
        steps = iter(self._unfold)
        while True:
            begun = perf_counter()
            try:
                step = next(steps, None)
            except ModelError as error:
                self.error, self.stopped = error, "error"
                return
            finally:
                self.elapsed += perf_counter() - begun
            if step is None:
                break
            happened, self.world = step
            if happened is not None:
                self.events[happened.kind] += 1
                self.died += len(happened.died)
                self.born += len(happened.born)
                if self._progress is not None:
                    self._progress.show(happened.time, self.total)
            yield step
        if self._unfold.interrupted:
            self.stopped = "interrupted"
        else:
            assert self._unfold.result is not None
            self.world = self._unfold.result
            ended = self.world.time >= self.until
            self.stopped = "time" if ended or self.total < self.max_events else "max-events"


def _sliced(
    world: World, until: float, max_events: int, every: float | None
) -> Generator[Step, None, World]:
    """The events, with a sample (None, world) at each multiple of `every`; returns the last world.

    Slicing changes no event (law L1), but with a thruster on at some moment under literal thrust each sample
    is a cut (assignment 1.6).
    """
    left = max_events
    for stop, sampled in stops(world.time, until, every):
        unfold = happenings(world, stop, max_events=left)
        while True:
            try:
                happened, world = next(unfold)
            except StopIteration as ended:
                world = ended.value
                break
            left -= 1
            yield happened, world
        if left == 0 and world.time < stop:
            return world
        if sampled:
            yield None, world
    return world


def stops(start: float, until: float, every: float | None) -> Iterator[tuple[float, bool]]:
    """The times (s) to go to, and whether to take a sample there: multiples of `every`, and the end."""
    if every is not None:
        for k in count(
            max(floor(start / every) - 1, 0)
        ):  # a step early, as the quotient is rounded
            time = k * every
            if time > until:
                break
            if time >= start:
                yield time, True
    yield until, False
