"""Timing in one run: contenders take turns (A B A B ...), and what is compared is the ratio within a turn.

The machine's speed wanders by a third within minutes. Neighbouring turns see the same machine, so a ratio holds
where an absolute figure does not. Time is processor time: what others do on the machine does not count, except
through the caches. Every figure is the median over the turns with the lowest and the highest.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from statistics import median
from time import process_time

from attrs import frozen


@frozen
class Effort:
    """How much work to spend: turns, and the share of the full number of events. `largest` caps N."""

    rounds: int = 5
    share: float = 1.0
    largest: int = 10_000

    def events(self, full: int) -> int:
        """So many of `full` events, at least four."""
        return max(4, round(full * self.share))

    def size(self, n: int) -> int:
        """N, or the largest N allowed."""
        return min(n, self.largest)


FULL = Effort()
QUICK = Effort(rounds=3, share=0.12)
TINY = Effort(rounds=1, share=0.001, largest=20)


@frozen
class Figure:
    """A median with its range, and the bound asked of the median."""

    what: str
    median: float
    low: float
    high: float
    unit: str = ""
    at_least: float | None = None
    below: float | None = None

    @property
    def asked(self) -> str:
        """The bound in words; empty without one."""
        if self.at_least is not None:
            return f"≥ {_short(self.at_least)} {self.unit}".rstrip()
        return f"< {_short(self.below)} {self.unit}".rstrip() if self.below is not None else ""

    @property
    def measured(self) -> str:
        """Median [lowest - highest] unit."""
        spread = f" [{_short(self.low)} - {_short(self.high)}]" if self.low != self.high else ""
        return f"{_short(self.median)}{spread} {self.unit}".rstrip()

    @property
    def met(self) -> bool | None:
        """Is the bound kept? None without one."""
        if self.at_least is not None:
            return self.median >= self.at_least
        return self.median < self.below if self.below is not None else None


@frozen
class Table:
    """The figures of one benchmark, and a line on how to read them."""

    title: str
    figures: Sequence[Figure]
    note: str = ""


def _short(value: float) -> str:
    if abs(value) >= 100.0:
        return f"{value:,.0f}"
    return f"{value:.3g}"


def figure(
    what: str,
    values: Sequence[float],
    unit: str = "",
    *,
    at_least: float | None = None,
    below: float | None = None,
) -> Figure:
    """The figure of some measured values."""
    return Figure(what, median(values), min(values), max(values), unit, at_least, below)


def ratios(above: Sequence[float], below: Sequence[float]) -> list[float]:
    """Turn by turn, one over the other."""
    return [a / b for a, b in zip(above, below, strict=True)]


def turns(
    rounds: int, contenders: Mapping[str, Callable[[], float]], *, slices: int = 1
) -> dict[str, list[float]]:
    """What each contender measures, turn by turn, all of them in every turn.

    With slices a turn goes around so many times and takes each contender's median, which close ratios need.
    """
    taken: dict[str, list[float]] = {name: [] for name in contenders}
    for _ in range(rounds):
        seen: dict[str, list[float]] = {name: [] for name in contenders}
        for _ in range(slices):
            for name, measured in contenders.items():
                seen[name].append(measured())
        for name, values in seen.items():
            taken[name].append(median(values))
    return taken


def rate(advance: Callable[[int], object], events: int) -> Callable[[], float]:
    """A contender: events per second of `advance(events)`."""

    def measured() -> float:
        start = process_time()
        advance(events)
        return events / (process_time() - start)

    return measured


def call_time(function: Callable[[], object], calls: int) -> Callable[[], float]:
    """A contender: microseconds a call, the call of an empty function included (about 0.03 us)."""

    def measured() -> float:
        start = process_time()
        for _ in range(calls):
            function()
        return (process_time() - start) / calls * 1e6

    return measured
