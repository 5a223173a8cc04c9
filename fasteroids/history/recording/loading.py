"""A recording as a timeline, to ask it questions, and the line of a timeline as a recording."""

from __future__ import annotations

from typing import Final

from attrs import evolve

from fasteroids.history.inputs import Cut
from fasteroids.history.living import Lived, reached
from fasteroids.history.recording.errors import RecordingError
from fasteroids.history.recording.lines import Bookmark
from fasteroids.history.recording.reading import Recording
from fasteroids.history.recording.writing import Recorder, headed
from fasteroids.history.timeline import BUDGET, Timeline, begin
from fasteroids.history.timeline import Bookmark as Mark
from fasteroids.units import shown

__all__ = ["recorded", "timeline_of"]

_TOGETHER: Final = 4096
"""States that a timeline takes together, before it looks at its budget."""


def timeline_of(recording: Recording, *, budget: int = BUDGET) -> Timeline:
    """The past of a recording, lived again, with its bookmarks, as a timeline of one line.

    `budget`: as for `begin`. `ModelError` if an input makes no sense where it comes; `RecordingError` if a bookmark is
    at no place of this past.
    """
    timeline = begin(recording.world, budget=budget)
    past = recording.past()
    states: list[Lived] = []
    while True:
        try:
            states.append(next(past))
        except StopIteration as stop:
            last: Lived = stop.value
            break
        if len(states) > _TOGETHER:
            timeline, states = timeline.grown(states[:-1]), states[-1:]
    if states and states[-1].world.now == last.world.now:
        states[-1] = states[-1]._replace(world=last.world)  # all it can lack is what sums left over
    timeline = timeline.grown(states)
    if last.world.clock != timeline.world.clock:
        timeline = timeline.grown([Lived(last.place, Cut(last.world.clock), last.world)])
    for bookmark in recording.bookmarks:
        timeline = _with(timeline, bookmark)
    return timeline


def _with(timeline: Timeline, bookmark: Bookmark) -> Timeline:
    """The timeline with a bookmark of its recording. Where nothing happened there may be no state to find."""
    place, name = bookmark.place, bookmark.name
    inside = timeline.first.place <= place and place.moment <= timeline.world.now
    state = timeline.state(place) if inside else None
    if state is not None and state.place != place and place.nth == 0:
        state = reached(state, place.moment)
    if state is None or state.place != place:
        raise RecordingError(
            f"the bookmark {shown(name)} is at a place that is not in this past: {place.time!r} s, nth {place.nth}"
        )
    return evolve(timeline, marks=timeline.marks.set(name, Mark(name, timeline.name, state)))


def recorded(timeline: Timeline, *, title: str | None = None) -> str:
    """The recording of a timeline's line from its first state to its last, with its inputs and bookmarks: a text.

    The law: `timeline_of(read(text))` has the same world at any time (tests/properties/test_loading.py). `ModelError`
    if a ship has a program that is no text of the language.
    """
    pieces: list[str] = []
    last = timeline.first
    recorder = Recorder(pieces.append, last.world, headed(last.world, title=title))
    for state in timeline.forwards(timeline.first.place):
        recorder.add(state)
    marks = sorted((mark.state.place, mark.name, mark.line) for mark in timeline.bookmarks.values())
    for place, name, line in marks:
        if timeline.holds(line, place):
            recorder.bookmark(name, place)
    recorder.finish(timeline.world.clock, "saved")
    return "".join(pieces)
