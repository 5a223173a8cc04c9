"""Questions to a past: what comes next, what happened to an entity, when something first held.

A question is asked of the line that time goes on in, with all the lines it branched off. What is asked *at* is a
place or a time. A time is a whole moment: what happens at it comes neither before nor after it.

No answer depends on what was thinned, but for one: a cut that decides nothing is gone for good with its state, so a
search for kind `cut` finds fewer in a thinned past.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import floor, inf, nextafter
from typing import Final, TypeAlias

from fasteroids.history.inputs import Cut, Place
from fasteroids.history.living import Lived, cuts_decide, reached
from fasteroids.history.marks import Kind, about, is_of, wanted, who
from fasteroids.history.timeline import Timeline
from fasteroids.moments import Moment, clock_at, moment_at, resolution, seconds
from fasteroids.state import World
from fasteroids.units import TICKS_PER_SECOND, WINDOW, ModelError, number, shown

__all__ = [
    "At",
    "Predicate",
    "before_all_at",
    "events_of",
    "first_time",
    "known",
    "last_time",
    "next_state",
    "past_all_at",
    "previous_state",
]

At: TypeAlias = Place | float
"""A place, or a time (s): the whole moment."""

Predicate: TypeAlias = Callable[[World], bool]
"""What may hold in a world. It looks at nothing else, so that it holds again when it is asked again."""

EVERY: Final = 1.0 / TICKS_PER_SECOND
"""How often (s) a condition is looked at between two happenings, if nobody says: as often as a program is run."""


def before_all_at(at: At) -> Place:
    """A place as it is; of a time the place before all that happens at it. `ModelError` if it is no time."""
    return at if isinstance(at, Place) else Place(*clock_at(at)[:2])


def past_all_at(at: At) -> Place:
    """A place as it is; of a time a place after all that happens at it. `ModelError` if it is no time."""
    return at if isinstance(at, Place) else Place.end_of(clock_at(at)[:2])


def known(timeline: Timeline, entity: int) -> int:
    """The id of an entity that can have been in this past; `ModelError` if no id as large was ever given."""
    most = timeline.world.roster.next_id - 1
    if type(entity) is not int or not 1 <= entity <= most:
        raise ModelError(f"ids in this past go from 1 to {most}; got {shown(entity)}")
    return entity


# What comes next.


def next_state(
    timeline: Timeline, at: At, kind: Kind = "event", entity: int | None = None
) -> Lived | None:
    """The first state after a place or time that something of this kind led to; about an entity, if one is given.

    None if there is none up to the end of the line.
    """
    place = past_all_at(at)
    for state in timeline.forwards(place, wanted(kind, entity)):
        if is_of(state, kind, entity):
            return state
    return None


def previous_state(
    timeline: Timeline, at: At, kind: Kind = "event", entity: int | None = None
) -> Lived | None:
    """The last state before a place or time that something of this kind led to; about an entity, if one is given.

    None if there is none back to the first state.
    """
    place = before_all_at(at)
    for state in timeline.backwards(place, wanted(kind, entity)):
        if state.place < place and is_of(state, kind, entity):
            return state
    return None


def events_of(timeline: Timeline, entity: int) -> Iterator[Lived]:
    """All that happened to an entity or that it did, inputs included, in order. `ModelError` as `known`.

    A ship takes no part in what its bullets do. What a cut does to a thrusting ship (1.6) is no happening.
    """
    marks = about(known(timeline, entity))
    return (
        state for state in timeline.forwards(timeline.first.place, marks) if entity in who(state)
    )


# When something holds.


def first_time(
    timeline: Timeline,
    holds: Predicate,
    *,
    after: At | None = None,
    before: At | None = None,
    every: float = EVERY,
) -> Lived | None:
    """The first state of a stretch of the past in which a condition holds; None if it was never found to hold.

    The stretch goes from `after` to `before`, both included; without them from the first state to the last. If the
    condition holds at its start already that is the answer. Between two happenings the answer is a state without a
    `what`, at the very first moment that the clock can tell, if the condition becomes true once in the piece searched.

    It is looked at in each state, right before each, and in between at the whole multiples of `every` (s). What holds
    only between two looks, with no happening meanwhile, is missed; and of a condition that changes several times
    between two looks some change is found, not always the first. `every` decides about both, and costs time.
    """
    every = _interval(every, timeline)
    for state, until in _pieces(timeline, after, before):
        if holds(state.world):
            return state
        off = state.place.moment
        for moment in _looks(state.place.moment, until, every):
            if holds(reached(state, moment).world):
                return _boundary(state, holds, moment, off)
            off = moment
    return None


def last_time(
    timeline: Timeline,
    holds: Predicate,
    *,
    after: At | None = None,
    before: At | None = None,
    every: float = EVERY,
) -> Lived | None:
    """As `first_time`, but going back: the last state of a stretch in which a condition holds.

    If it holds at the end of the stretch that is the answer. Between two happenings the answer is the very last moment.
    """
    every = _interval(every, timeline)
    for state, until in _pieces_back(timeline, after, before):
        off: Moment | None = None
        for moment in (*reversed([*_looks(state.place.moment, until, every)]), None):
            here = state if moment is None else reached(state, moment)
            if holds(here.world):
                return here if off is None else _boundary(state, holds, here.place.moment, off)
            off = moment
    return None


def _interval(every: float, timeline: Timeline) -> float:
    every, least = number(every, "the time between two looks"), resolution(timeline.world.now)
    if not least <= every < inf:
        raise ModelError(
            f"the time between two looks must be finite and at least {least!r} s, what the clock can tell; got "
            f"{shown(every)}"
        )
    return every


_Piece: TypeAlias = tuple[Lived, Moment]
"""A state, and the last moment to which nothing happens."""


def _pieces(timeline: Timeline, after: At | None, before: At | None) -> Iterator[_Piece]:
    """The pieces of a stretch in order."""
    state, end = _stretch(timeline, after, before)
    for following in timeline.forwards(state.place):
        if following.place > end:
            break
        if not _idle(following):
            yield state, _earlier(following.place.moment)
            state = following
    yield state, min(end.moment, timeline.world.now)


def _pieces_back(timeline: Timeline, after: At | None, before: At | None) -> Iterator[_Piece]:
    """The pieces of a stretch, the last one first."""
    start, end = _stretch(timeline, after, before)
    until = min(end.moment, timeline.world.now)
    for state in timeline.backwards(end):
        if state.place <= start.place:
            break
        if not _idle(state):
            yield state, until
            until = _earlier(state.place.moment)
    yield start, until


def _idle(state: Lived) -> bool:
    """Is it that of a cut that changed nothing? So a question gets the same answer where those are dropped."""
    return isinstance(state.what, Cut) and not cuts_decide(state.world)


def _stretch(timeline: Timeline, after: At | None, before: At | None) -> tuple[Lived, Place]:
    """The state at the start of a stretch, before all that happens at a time, and the place of its end.

    `ModelError` if it ends before it starts, or is not in this past.
    """
    first, last = timeline.first.place, timeline.world.now
    start = first if after is None else before_all_at(after)
    end = Place.end_of(last) if before is None else past_all_at(before)
    if not first <= start <= end or start.moment > last:
        raise ModelError(
            f"a stretch of this past lies between {first.time!r} s and {timeline.world.time!r} s and ends after it "
            f"starts; got {shown(after)} to {shown(before)}"
        )
    state = next(s for s in timeline.backwards(start) if not _idle(s))
    return reached(state, start.moment), end


def _looks(start: Moment, until: Moment, every: float) -> Iterator[Moment]:
    """The moments after the start at which a condition is looked at, up to and with the last."""
    if until <= start:
        return
    k = floor(seconds(*start) / every)
    while (moment := moment_at(k * every)) < until:
        if moment > start:
            yield moment
        k += 1
    yield until


def _earlier(moment: Moment) -> Moment:
    """The moment right before another, as the clock can tell."""
    window, offset = moment
    if offset > 0.0:
        return window, nextafter(offset, 0.0)
    return (window - 1, nextafter(WINDOW, 0.0)) if window else moment


def _boundary(state: Lived, holds: Predicate, on: Moment, off: Moment) -> Lived:
    """The state at the moment nearest to `off` at which a condition holds, as it does at `on` but not at `off`."""
    while True:
        middle = _between(min(on, off), max(on, off))
        if middle in (on, off):
            return reached(state, on)
        if holds(reached(state, middle).world):
            on = middle
        else:
            off = middle


def _between(low: Moment, high: Moment) -> Moment:
    """A moment between two, halfway or at the start of a window; one of the two if there is none."""
    if high[0] > low[0] + 1:
        return (low[0] + high[0]) // 2, 0.0
    if high[0] > low[0] and high[1] > 0.0:
        return high[0], 0.0
    top = high[1] if high[0] == low[0] else WINDOW
    middle = low[1] + 0.5 * (top - low[1])
    return (low[0], middle) if middle < WINDOW else high
