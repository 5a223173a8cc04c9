"""Another program from here on: the past is branched, the edited program runs, and the rest is given again.

    outcome = edited(timeline, 1, text, at)
    if isinstance(outcome, Edited): outcome.timeline, outcome.left_out, outcome.parted
    else: the diagnostics of the text

What players and programs of other ships did not decide, the world outside gives again: inputs at their times. An
input names entities by id. An id means the same in both futures if it was given before they part, or to what an
input brought that is given again; what names another one is left out, and so is what another program makes
impossible, and whatever the edited ship itself was told.
"""

from __future__ import annotations

from collections.abc import Iterator

from attrs import evolve, frozen

from fasteroids.actions import Program
from fasteroids.entities import Bullet, Entity
from fasteroids.history import (
    Act,
    Add,
    Cut,
    Input,
    Instruct,
    Parted,
    Place,
    Remove,
    Timeline,
    Told,
    first_difference,
    outwardly,
)
from fasteroids.history.living import cuts_decide
from fasteroids.history.marks import wanted
from fasteroids.lang import Diagnostic, check_program, parse_program
from fasteroids.moments import Clock, clock_at
from fasteroids.units import ModelError

__all__ = ["Edited", "LeftOut", "edited"]


@frozen
class LeftOut:
    """An input of the old line that was not given again, and why not, in a few words."""

    place: Place
    what: Input
    reason: str


@frozen
class Edited:
    """A past with another future."""

    timeline: Timeline
    """Time goes on in the new line."""
    old: str
    """The name of the line that was left; the new one is `timeline.name`."""
    given: int
    """How many inputs were given again."""
    left_out: tuple[LeftOut, ...]
    parted: Parted | None
    """Where the two lines first do something different, seen from outside; None if they do not."""


def edited(
    timeline: Timeline,
    ship: int,
    text: str,
    at: float | Place,
    *,
    until: float | None = None,
    name: str | None = None,
) -> Edited | tuple[Diagnostic, ...]:
    """The timeline with a branch at a time or place in which a ship runs an edited program from its beginning.

    It goes as far as the old line did, or up to `until` (s) if that is sooner. All its diagnostics if the text is no
    program without errors; then there is no branch. It takes as long as that future takes to live. `ModelError` if
    there is no such ship then, or as `Timeline.branch`.
    """
    checked = check_program(parse_program(text))
    if checked.program is None:
        return checked.diagnostics
    return instructed_at(timeline, ship, checked.program, at, until=until, name=name)


def instructed_at(
    timeline: Timeline,
    ship: int,
    program: Program,
    at: float | Place,
    *,
    until: float | None = None,
    name: str | None = None,
) -> Edited:
    """As `edited`, with a program that is ready to run."""
    fork = timeline.branch(at, name)
    start, end = fork.last.place, timeline.world.clock
    if until is not None:
        end = max(min(clock_at(until), end), fork.world.clock)
    again = _Again(fork.instruct(ship, program), ship, fork.world.roster.next_id)
    for place, what, born in _inputs(timeline, start, end):
        again.give(place, what, born)
    again.reach(end)
    parted = first_difference(again.timeline, timeline.name, again.timeline.name, by=outwardly)
    return Edited(again.timeline, timeline.name, again.given, tuple(again.left_out), parted)


def _inputs(
    timeline: Timeline, start: Place, end: Clock
) -> Iterator[tuple[Place, Input, tuple[int, ...]]]:
    """The inputs after a place, and the ids that each brought. Cuts are among them where they decide."""
    cuts = cuts_decide(timeline.world)
    for state in timeline.forwards(start, None if cuts else wanted("input")):
        if state.place.moment > end[:2]:
            return
        if isinstance(state.what, Told):
            yield state.place, state.what.what, state.what.born
        elif cuts and isinstance(state.what, Cut):
            yield state.place, state.what, ()


class _Again:
    """The new line as it grows. Mutable, and gone when it is done."""

    def __init__(self, timeline: Timeline, ship: int, next_id: int) -> None:
        self.timeline = timeline
        self.given = 0
        self.left_out: list[LeftOut] = []
        self._ship = ship
        self._common = next_id
        self._ids: dict[int, int] = {}

    def reach(self, clock: Clock) -> None:
        """Time goes on up to a clock, if it has not come there yet."""
        if clock[:2] > self.timeline.world.now:
            self.timeline = self.timeline.take(Cut(clock))

    def give(self, place: Place, what: Input, born: tuple[int, ...]) -> None:
        """An input at its time, if it makes sense."""
        if isinstance(what, Cut):
            self.reach(what.clock)
            return
        self.reach((*place.moment, 0.0))
        try:
            self.timeline = self.timeline.take(self._translated(what))
        except ModelError as error:
            self.left_out.append(LeftOut(place, what, str(error)))
            return
        self.given += 1
        if isinstance(what, Add):
            self._ids[born[0]] = self.timeline.last.born[0]

    def _translated(self, what: Act | Instruct | Add | Remove) -> Act | Instruct | Add | Remove:
        """The same input with the ids of this line; `ModelError` says why it is left out."""
        match what:
            case Act(ship) | Instruct(ship):
                if ship == self._ship:
                    raise ModelError("it was meant for the ship whose program was edited")
                return evolve(what, ship=self._known(ship))
            case Remove(entity):
                return Remove(self._known(entity))
            case Add(entity):
                return Add(self._brought(entity))

    def _known(self, entity: int) -> int:
        if entity in self._ids:
            return self._ids[entity]
        if entity < self._common:
            return entity
        raise ModelError(f"#{entity} came to be after the lines part, so it may be another one")

    def _brought(self, entity: Entity) -> Entity:
        """An entity that an input brings, without an id that may be taken."""
        if isinstance(entity, Bullet):
            return evolve(entity, id=None, source=self._known(entity.source))
        return evolve(entity, id=None)
