"""A short account of a past, kept while it is lived: what happened when, to whom, and which fields it changed.

The panes ask at every frame for the last and next events of an entity, for marks along a stretch of time, for the
last change of a field. To ask a thinned timeline would mean to live pieces of it again. So a `Chronicle` folds each
state once as it comes, and keeps of it its place and what led to it; no worlds.

    chronicle = chronicle_of(timeline)              once: as long as it takes to go through all states
    chronicle = chronicle.followed(timeline)        then: only what is new is looked at

It is a function of the timeline: followed or made anew, it says the same (tests/unit/tui/test_chronicle.py). A line
that branches off shares its parent's account up to there.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Final, Literal, NamedTuple, TypeAlias

from attrs import evolve, field, frozen
from pyrsistent import PMap, PVector, pmap, pvector

from fasteroids.entities import Ship, id_of
from fasteroids.events import Happened
from fasteroids.history import Cut, Lived, Place, Timeline
from fasteroids.history.changes import ABSENT, motion
from fasteroids.history.living import What, cuts_decide
from fasteroids.history.marks import kinds_of, who
from fasteroids.state import Flight, World

__all__ = ["FIELDS", "Chronicle", "Entry", "Key", "Sign", "chronicle_of"]

Sign: TypeAlias = Literal["event", "loss", "death", "stop", "shot", "contact", "input"]
"""What a mark stands for. `event` is all that happened, inputs included; a `loss` is the death of a ship; a `stop` is
the last tick of a program, as it ended or halted."""

FIELDS: Final = ("velocity", "direction", "thruster", "bounced", "flight")
"""The fields whose changes are kept, in the sense of `fasteroids.history.last_change`."""

Key: TypeAlias = str | int | tuple[int, str]
"""Whose entries: of a sign, of an entity, of an entity's contacts or prints, or of the changes of a field of it."""


class Entry(NamedTuple):
    """Something that happened: where, and what."""

    place: Place
    what: What


_NONE: Final[PVector[Entry]] = pvector()


@frozen(eq=False)
class Track:
    """The account of one line, from the first state of its past on."""

    last: Lived
    """The last state told of that was no cut."""
    entries: PMap[Key, PVector[Entry]] = field(factory=pmap)

    def extended(self, states: Iterable[Lived]) -> Track:
        """With more states, in order."""
        news: defaultdict[Key, list[Entry]] = defaultdict(list)
        last = self.last
        for state in states:
            if isinstance(state.what, Cut):
                continue
            entry = Entry(state.place, state.what)
            for key in _keys(last.world, state):
                news[key].append(entry)
            last = state
        entries = self.entries.evolver()
        for key, more in news.items():
            entries[key] = self.entries.get(key, _NONE).extend(more)
        return Track(last, entries.persistent())

    def cut(self, place: Place, last: Lived) -> Track:
        """Up to and with a place; `last` is the state there."""
        if self.last.place <= place:
            return evolve(self, last=last)
        kept = {}
        for key, entries in self.entries.items():
            if entries[-1].place > place:
                entries = entries[: _upto(entries, place)]
            if entries:
                kept[key] = entries
        return Track(last, pmap(kept))


def _upto(entries: Sequence[Entry], place: Place) -> int:
    """How many entries are not after a place."""
    return bisect_left(entries, (place, _AFTER))


class _After:
    """Greater than whatever it is compared with, and so behind all entries of one place."""

    def __gt__(self, _: object) -> bool:
        return True

    def __lt__(self, _: object) -> bool:
        return False


_AFTER: Final = _After()


def _keys(before: World, state: Lived) -> Iterator[Key]:
    """All keys under which a state is told of."""
    what, kinds = state.what, kinds_of(state)
    yield "event"
    for sign in ("death", "shot", "contact", "input"):
        if sign in kinds:
            yield sign
    if "death" in kinds and any(_is_ship(before, entity) for entity in state.died):
        yield "loss"
    if isinstance(what, Happened):
        if what.kind == "tick" and _stopped(state.world, what.entities[0]):
            yield "stop"
        if what.prints:
            yield what.entities[0], "print"
        if what.kind == "contact":
            for entity in what.entities:
                yield entity, "contact"
    about = dict.fromkeys(who(state))
    yield from about
    if cuts_decide(state.world):  # each happening is a cut, which changes each ship that thrusts
        about |= dict.fromkeys(_thrusting(before))
    for entity in about:
        for name in _changed(before, state.world, entity):
            yield entity, name


def _is_ship(world: World, entity: int) -> bool:
    f = _flight(world, entity)
    return f is not None and isinstance(f.entity, Ship)


def _thrusting(world: World) -> Iterator[int]:
    for f in world.flights:
        if f is not None and isinstance(f.entity, Ship) and f.entity.thruster:
            yield id_of(f.entity)


def _stopped(world: World, ship: int) -> bool:
    """Has a ship no tick to come?"""
    return ship in world and world.flight_of(ship).next_tick is None


def _changed(before: World, after: World, entity: int) -> Iterator[str]:
    """The fields of an entity that have another value after than before."""
    f, g = _flight(before, entity), _flight(after, entity)
    if f is g:
        return
    old, new = f and f.entity, g and g.entity
    for name in FIELDS[:-1]:
        if getattr(old, name, ABSENT) != getattr(new, name, ABSENT):
            yield name
    if f is None or g is None or motion(f) != motion(g):
        yield "flight"


def _flight(world: World, entity: int) -> Flight | None:
    slot = world.roster.slots.get(entity)
    return None if slot is None else world.flights[slot]


@frozen(eq=False)
class Chronicle:
    """The account of a timeline's past, as told of the line that time goes on in; made by `chronicle_of`.

    Under literal thrust a change that a mere cut made is told as one of the next happening.
    """

    first: Lived
    name: str
    tracks: PMap[str, Track]

    def followed(self, timeline: Timeline) -> Chronicle:
        """Of a timeline that grew, branched, was switched or thinned since. Of any other it is made anew."""
        if timeline.first is not self.first:
            return chronicle_of(timeline)
        tracks, name, parent = self.tracks, timeline.name, timeline.line.parent
        if name not in tracks and parent is not None:
            tracks = self.followed(timeline.switch(parent)).tracks
            place = timeline.line.first.place
            tracks = tracks.set(name, tracks[parent].cut(place, _told(timeline, place)))
        elif name not in tracks or not _holds(timeline, tracks[name].last):
            return chronicle_of(timeline)
        track = tracks[name]
        track = track.extended(timeline.forwards(track.last.place))
        return Chronicle(self.first, name, tracks.set(name, track))

    def entries(self, key: Key) -> Sequence[Entry]:
        """All entries under a key, in order."""
        return self.tracks[self.name].entries.get(key, _NONE)

    def until(self, key: Key, place: Place, most: int) -> Sequence[Entry]:
        """The last entries under a key up to and with a place, `most` of them at most, in order."""
        entries = self.entries(key)
        end = _upto(entries, place)
        return entries[max(end - most, 0) : end]

    def after(self, key: Key, place: Place, most: int) -> Sequence[Entry]:
        """The first entries under a key after a place, `most` of them at most, in order."""
        entries = self.entries(key)
        start = _upto(entries, place)
        return entries[start : start + most]

    def parts(self, key: Key, edges: Sequence[Place]) -> list[range]:
        """The entries under a key between each edge and the next, as indices into `entries(key)`.

        Edges ascend. What is right at an edge comes after it.
        """
        entries = self.entries(key)
        found: list[int] = []
        for edge in edges:
            found.append(bisect_left(entries, (edge,), found[-1] if found else 0))
        return [range(a, b) for a, b in pairwise(found)]

    def last_change(self, entity: int, name: str, place: Place) -> Entry | None:
        """What last changed one of `FIELDS` of an entity up to and with a place; None if nothing did."""
        found = self.until((entity, name), place, 1)
        return found[0] if found else None


def _told(timeline: Timeline, place: Place) -> Lived:
    """The last state up to a place that is no cut."""
    return next(s for s in timeline.backwards(place) if not isinstance(s.what, Cut))


def _holds(timeline: Timeline, last: Lived) -> bool:
    """Is a state that was told of still one of this past?"""
    if timeline.last.place < last.place:
        return False
    found = _told(timeline, last.place)
    return found is last or (
        (found.place, found.what) == (last.place, last.what)
        and found.world.all_flights() == last.world.all_flights()
    )


def chronicle_of(timeline: Timeline) -> Chronicle:
    """The account of all of a timeline's past. It takes as long as to go through all its states."""
    first, oldest = timeline.first, timeline.line
    while oldest.parent is not None:
        oldest = timeline.lines[oldest.parent]
    nothing = Chronicle(first, oldest.name, pmap({oldest.name: Track(first)}))
    return nothing.followed(timeline)
