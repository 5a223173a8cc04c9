"""A recording as it is made: `Recorder` takes the states of a past one by one, and hands on whole lines.

It is pure but for what it hands them to. What it writes depends on what happened and what was told alone, never on
how often somebody looked (unless cuts decide): so `verify` makes the same lines again from the same past.
"""

from __future__ import annotations

import platform
from collections import Counter
from collections.abc import Callable, Mapping
from functools import cache
from math import floor, inf

from attrs import evolve

from fasteroids.actions import Program
from fasteroids.events import Happened
from fasteroids.history.inputs import Add, Cut, Given, Instruct, Place
from fasteroids.history.living import Lived, Told, cuts_decide
from fasteroids.history.recording.digests import digest, libm, named
from fasteroids.history.recording.events import event_line, line, print_line
from fasteroids.history.recording.lines import (
    Bookmark,
    Entered,
    Hash,
    Header,
    Line,
    Result,
    Snapshot,
    program_by_name,
    record_of,
    texts_in,
)
from fasteroids.lang import Machine
from fasteroids.moments import Clock, Moment, moment_at, seconds
from fasteroids.scene import document
from fasteroids.state import World
from fasteroids.units import ModelError, shown

__all__ = ["EVERY_HASH", "EVERY_SNAPSHOT", "LEAST_EVERY", "Recorder", "headed"]

EVERY_HASH = 1.0
"""Game seconds from hash to hash, if enough happened in them."""

EVERY_SNAPSHOT = 10.0
"""Game seconds from snapshot to snapshot, if enough happened in them."""

HAPPENINGS_A_HASH, HAPPENINGS_A_SNAPSHOT = 2, 25
"""For each entity in the world so much must happen before the next hash or snapshot.

What one of them costs grows with the entities, and is then a hundredth or two of what it cost to live so far. Where
little happens a past is lived again in no time, and needs fewer snapshots.
"""

LEAST_EVERY = 2.0**-10
"""The least of both, s."""

_HELD = 64
"""Events that wait for their lines: made together they take half as long as each by itself between two events."""

_BATCH = 512
"""Lines that are handed on together."""


def headed(
    world: World,
    *,
    title: str | None = None,
    slice: float | None = None,
    every_hash: float = EVERY_HASH,
    every_snapshot: float = EVERY_SNAPSHOT,
) -> Header:
    """The header of a recording that begins with a world, made here and now.

    `ModelError` if a ship has a program that is no text of the language, or a number is not a time above 0.
    """
    for what, value in (("every_hash", every_hash), ("every_snapshot", every_snapshot)):
        if not LEAST_EVERY <= value < inf:
            raise ModelError(f"{what} must be at least {LEAST_EVERY!r} s; got {shown(value)}")
    return Header(
        cuts="recorded" if cuts_decide(world) else "free",
        world=document(world, row=program_by_name),
        programs=texts_in(world),
        libm=libm(),
        fasteroids=_version(),
        python=platform.python_version(),
        model=world.model,
        fuel=world.fuel,
        seed=world.seed,
        every_hash=float(every_hash),
        every_snapshot=float(every_snapshot),
        slice=slice,
        title=title,
    )


@cache
def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version  # slow to load, and for this alone

    try:
        return version("fasteroids")
    except PackageNotFoundError:
        return "unknown"


class Recorder:
    """Makes the lines of a recording of a past that begins with a world.

    `write` gets pieces of text: one or more whole lines each, ASCII. They come when many wait, at each `flush`,
    and at the end. `size` counts the characters handed on so far.
    """

    def __init__(
        self, write: Callable[[str], object], first: World, header: Header | None = None
    ) -> None:
        self._write = write
        self._lines: list[str] = []
        self.size = 0
        self.header = header = headed(first) if header is None else header
        self._happened: list[tuple[Place, Happened]] = []
        self._events: Counter[str] = Counter()
        self._known = dict(header.programs)
        self._cuts = header.cuts == "recorded"
        self._world = first
        self._place = Place(*first.now)
        self._snapshots: list[tuple[float, int]] = []
        self._changes = self._at_hash = self._at_snapshot = (
            0  # happenings, in all and up to the last of each
        )
        self._hash_due = _next(first.time, header.every_hash)
        self._snapshot_due = _next(first.time, header.every_snapshot)
        self._due = min(self._hash_due, self._snapshot_due)
        self._put(header)

    # What is recorded.

    def add(self, state: Lived) -> None:
        """The next state of the past. `ModelError` if an input brings a program that is no text of the language."""
        place, what, world = state
        if type(what) is Happened:
            if what.time > self._due:
                self._look(place[:2])
            self._happened.append((place, what))
            if len(self._happened) >= _HELD:
                self._settle()
        elif isinstance(what, Told):
            self._look(place[:2])
            self._put(self._told(place, what))
            self._put(Hash(place[:2], digest(world)))  # no event may ever show what it changed
            self._changes += 1
        elif isinstance(what, Cut) and self._cuts:
            self._look(place[:2])
            self._put(Entered(Given(place, what)))
            self._changes += 1
        else:
            self._place = place
            return
        self._place, self._world = place, world

    @property
    def events(self) -> Mapping[str, int]:
        """How much happened so far, by kind."""
        self._settle()
        return self._events

    def _settle(self) -> None:
        """The lines of the events that wait."""
        lines, counts = self._lines, self._events
        for place, happened in self._happened:
            if happened.prints:
                ship, moment = happened.entities[0], place[:2]
                lines += [print_line(text, ship, moment) for text in happened.prints]
            lines.append(event_line(happened, place))
            counts[happened.kind] += 1
        self._changes += len(self._happened)
        self._happened.clear()
        if len(lines) >= _BATCH:
            self._hand_on()

    def _told(self, place: Place, told: Told) -> Entered:
        """The line of an input, which came before the place that it led to."""
        what = told.what
        new: dict[str, str] = {}
        program: Program | None = None
        if isinstance(what, Instruct):
            program = what.program
        elif isinstance(what, Add):
            program = getattr(what.entity, "program", None)
        if isinstance(program, Machine):
            text = program.code.source
            name = named(text)
            if name not in self._known:
                self._known[name] = new[name] = text
        return Entered(Given(place.before, what), told.died, told.born, new)

    def bookmark(self, name: str, place: Place | None = None) -> None:
        """A name for a place; for the last state, if none is given."""
        self._put(Bookmark(self._place if place is None else place, name))

    def finish(self, clock: Clock, ended: str = "time") -> None:
        """The end of the recording, at a clock not before the last state; `ended` is a word that tells why.

        Every event up to that clock was recorded, or, if the last state is at its moment, those up to that state.
        """
        self._look(clock[:2], last=True)
        place = self._place.reaching(clock[:2])
        self._put(
            Result(
                clock,
                place.nth,
                ended,
                dict(self._events),
                digest(self._world),
                tuple(self._snapshots),
            )
        )
        self.flush()

    # How.

    def flush(self) -> None:
        """Hand on what waits."""
        self._settle()
        self._hand_on()

    def _hand_on(self) -> None:
        if self._lines:
            text = "\n".join(self._lines) + "\n"
            self._lines.clear()
            self.size += len(text)
            self._write(text)

    def _put(self, made: Header | Line) -> None:
        self._settle()
        self._lines.append(line(record_of(made)))

    def _look(self, now: Moment, *, last: bool = False) -> None:
        """Write what is due before a moment: the world has stayed as it is since then. If it is the last, at it too.

        Where little happened since the last time there is nothing to write: a long silence costs nothing.
        """
        self._settle()
        hash_due, snapshot_due = self._hash_due, self._snapshot_due
        if hash_due < snapshot_due:
            self._look_for_hash(now, last)
        if _has_come(snapshot_due, now, last):
            if self._changes - self._at_snapshot >= HAPPENINGS_A_SNAPSHOT * max(
                len(self._world), 1
            ):
                self._snapshot(self._moment(snapshot_due, now))
                self._at_snapshot = self._changes
            self._snapshot_due = _next(seconds(*now), self.header.every_snapshot)
        if hash_due >= snapshot_due:
            self._look_for_hash(now, last)
        self._due = min(self._hash_due, self._snapshot_due)

    def _look_for_hash(self, now: Moment, last: bool) -> None:
        if _has_come(self._hash_due, now, last):
            if self._changes - self._at_hash >= HAPPENINGS_A_HASH * max(len(self._world), 1):
                self._put(Hash(self._moment(self._hash_due, now), digest(self._world)))
                self._at_hash = self._changes
            self._hash_due = _next(seconds(*now), self.header.every_hash)

    def _snapshot(self, moment: Moment) -> None:
        self.flush()
        self._snapshots.append((seconds(*moment), self.size))
        world = evolve(self._world, clock=(*moment, 0.0))  # a copy: it leaves the cache where it is
        self._put(Snapshot(moment, document(world, row=program_by_name)))

    def _moment(self, due: float, now: Moment) -> Moment:
        """The moment of a time, between the last change and now: late, a double stands for many moments."""
        return min(max(moment_at(due), self._world.now), now)


def _has_come(due: float, now: Moment, last: bool) -> bool:
    time = seconds(*now)
    return time > due or (last and time == due)


def _next(time: float, every: float) -> float:
    """The first multiple of an interval after a time (s), or rather that time where doubles are too coarse for it."""
    count = time / every
    return inf if count == inf else max((floor(count) + 1) * every, time)
