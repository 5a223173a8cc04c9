"""Ctrl-C at a good moment: at once while the engine computes, and only then. SIGTERM (`kill`, `timeout`) is as good."""

from __future__ import annotations

import signal
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from types import FrameType, TracebackType
from typing import Any, Generic, TypeVar

__all__ = ["Interruptible", "terminable"]

T = TypeVar("T")
R = TypeVar("R")


class Interruptible(Generic[T, R]):
    """An unfold that Ctrl-C ends between two of its items: what is done with an item is done to its end.

    A context manager that takes SIGINT and SIGTERM over, and an iterable. A second one raises wherever it comes.
    Afterwards `interrupted` says whether there was one, and `result` is what the unfold returned if not.
    """

    def __init__(self, unfold: Generator[T, None, R]) -> None:
        self._unfold = unfold
        self._computing = False
        self.interrupted = False
        self.result: R | None = None

    def __enter__(self) -> Interruptible[T, R]:
        self._previous: dict[int, Any] = {}
        with suppress(ValueError):  # not the main thread, where no signal arrives
            self._previous[signal.SIGINT] = signal.signal(signal.SIGINT, self._on_signal)
            self._previous[signal.SIGTERM] = signal.signal(signal.SIGTERM, _press)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number, previous in self._previous.items():
            if previous is not None:  # of another language than Python
                signal.signal(number, previous)

    def _on_signal(self, _number: int, _frame: FrameType | None) -> None:
        again, self.interrupted = self.interrupted, True
        if self._computing or again:
            raise KeyboardInterrupt

    def __iter__(self) -> Iterator[T]:
        """The items of the unfold, until it or the user ends it."""
        while not self.interrupted:
            try:
                self._computing = True
                item = next(self._unfold)
                self._computing = False
            except StopIteration as stop:
                self._computing = False
                self.result = stop.value
                return
            except KeyboardInterrupt:
                self._computing = False
                return
            except BaseException:
                self._computing = False
                raise
            yield item


def _press(_number: int, _frame: FrameType | None) -> None:
    """As Ctrl-C does, so that SIGTERM waits too where that is held back."""
    signal.raise_signal(signal.SIGINT)


@contextmanager
def terminable() -> Iterator[None]:
    """SIGTERM is as Ctrl-C in this block, an exception: what is half done can be cleared away."""
    previous: Any = None
    with suppress(ValueError):  # not the main thread, where no signal arrives
        previous = signal.signal(signal.SIGTERM, _press)
    try:
        yield
    finally:
        if previous is not None:
            signal.signal(signal.SIGTERM, previous)
