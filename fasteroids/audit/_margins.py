"""What an audit says: the worst margin of each law, and the counts of a run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import inf, isfinite

from attrs import evolve, field, frozen

from fasteroids.moments import Moment, seconds

__all__ = ["Audit", "Faults", "Margin", "Worst"]


@frozen
class Margin:
    """The worst case of one law: the one that used most of what was allowed.

    `worst` and `allowed` are in `unit` (km, km/s, u = 2^-53, or a count); `ulps` is `worst` in units in the last
    place of the coordinates, for lengths. `time` (s) and `entities` say where; None and () if there was no case.
    `ok` is False if any case of the run exceeded what it was allowed.
    """

    law: str
    what: str
    unit: str
    worst: float = 0.0
    allowed: float = 0.0
    ulps: float | None = None
    time: float | None = None
    entities: tuple[int, ...] = ()
    ok: bool = True


@frozen
class Audit:
    """What an audit found.

    `events` counts them by kind; `clipped` the entities scaled back to their speed limit, `died` and `born`
    those; `asked` the contact times computed and `undecided` those of them that needed exact arithmetic (both
    without what the engine had counted before the run). `energy_drift` is the change of the total kinetic
    energy over the run relative to its start, for information: deaths, births, clips and thrust change it
    rightly. None without energy to compare with. `time` is where the run ended (s). `elapsed` (s) is how long
    the engine took, if the caller measured it: this module has no clock.
    """

    margins: tuple[Margin, ...]
    events: Mapping[str, int]
    clipped: int
    died: int
    born: int
    asked: int
    undecided: int
    energy_drift: float | None
    time: float
    elapsed: float | None = field(default=None, kw_only=True)

    @property
    def ok(self) -> bool:
        """Was every margin kept?"""
        return all(margin.ok for margin in self.margins)

    @property
    def total(self) -> int:
        """How many events there were."""
        return sum(self.events.values())

    @property
    def rate(self) -> float | None:
        """Events per second of `elapsed`, or None if nobody measured it."""
        return self.total / self.elapsed if self.elapsed else None


class Worst:
    """The worst case of one law so far: the one with the largest share of what it was allowed."""

    def __init__(self, law: str, what: str, unit: str) -> None:
        self.margin = Margin(law, what, unit)
        self._share = -1.0

    @property
    def share(self) -> float:
        """What it used of what it was allowed; negative if there was no case yet."""
        return self._share

    def see(
        self,
        worst: float,
        allowed: float,
        now: Moment,
        entities: Iterable[int],
        ulps: float | None = None,
    ) -> None:
        """One more case. What is infinite or not a number is not allowed."""
        ok = worst <= allowed and worst < inf
        share = worst / allowed if allowed > 0.0 and isfinite(worst) else 0.0 if ok else inf
        if share > self._share:  # of a case that is not ok it is above 1, so no other hides it
            self._share = share
            m = self.margin
            self.margin = Margin(
                m.law, m.what, m.unit, worst, allowed, ulps, seconds(*now), tuple(entities), ok
            )


class Faults(Worst):
    """A count of what must never happen, with the first case."""

    def __init__(self, law: str, what: str) -> None:
        super().__init__(law, what, "times")

    def fault(self, now: Moment, entities: Iterable[int]) -> None:
        """It happened."""
        if self.margin.ok:
            self.see(1.0, 0.0, now, entities)
        else:
            self.margin = evolve(self.margin, worst=self.margin.worst + 1.0)
