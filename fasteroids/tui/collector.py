"""When Python looks for garbage while games are played.

A past is millions of objects that stay, and hardly anything in a game is part of a cycle, so reference counts free what
goes. Left alone, the collector walks through all of that past now and then and finds nothing: half a second at 70 MB of
states, during which no frame is shown. So it is told to look at what is new only, and to count that as old at once
(`gc.freeze`); at all there is it looks between two games.
"""

from __future__ import annotations

import gc
from typing import Final

__all__ = ["NEW", "PERIOD", "Collector"]

PERIOD: Final = 1.0
"""Seconds from one `tend` to the next."""

NEW: Final = 10_000
"""New objects from which on a look at them is worth it. What they refer to is walked through too: one that refers to
much, as a long persistent vector does, makes even a look at few take 20 ms."""


class Collector:
    """Python's collector as an app has it from `begin` to `end`; `end` leaves it as it was. Both may come again."""

    def __init__(self, new: int = NEW) -> None:
        self._new = new
        self._began = False
        self._enabled = False

    def begin(self) -> None:
        """From now on the collector works only when it is told to."""
        if not self._began:
            self._began, self._enabled = True, gc.isenabled()
            gc.disable()
            gc.freeze()

    def tend(self) -> None:
        """Look at what was made since the last time, if it is enough."""
        if self._began and gc.get_count()[0] >= self._new:
            gc.collect(1)
            gc.freeze()

    def renew(self) -> None:
        """Look at everything: a moment when nothing moves is best, as it takes a tenth of a second and more."""
        if self._began:
            gc.unfreeze()
            gc.collect()
            gc.freeze()

    def end(self) -> None:
        """The collector works as before."""
        if self._began:
            self._began = False
            gc.unfreeze()
            if self._enabled:
                gc.enable()
