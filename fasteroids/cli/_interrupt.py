"""Ctrl-C at a good moment: at once while the engine computes, and only then."""

from __future__ import annotations

import signal
from collections.abc import Generator, Iterator
from types import FrameType, TracebackType
from typing import Any, Generic, TypeVar

__all__ = ["Interruptible"]

T = TypeVar("T")
R = TypeVar("R")


class Interruptible(Generic[T, R]):
    """An unfold that Ctrl-C ends between two of its items: what is done with an item is done to its end.

    A context manager that takes SIGINT over, and an iterable. A second Ctrl-C raises wherever it comes.
    Afterwards `interrupted` says whether there was one, and `result` is what the unfold returned if not.
    """

    def __init__(self, unfold: Generator[T, None, R]) -> None:
        self._unfold = unfold
        self._computing = False
        self.interrupted = False
        self.result: R | None = None

    def __enter__(self) -> Interruptible[T, R]:
        self._previous: Any = None
        try:
            self._previous = signal.signal(signal.SIGINT, self._on_signal)
        except ValueError:  # not the main thread, where no signal arrives
            self._previous = None
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._previous is not None:
            signal.signal(signal.SIGINT, self._previous)

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
