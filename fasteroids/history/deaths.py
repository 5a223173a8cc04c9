"""Why somebody died: the contact, the two flights that led to it, and what the ships had done.

A contact is a function of two flights. From the moment the later of the two began it was fixed: nothing that happened
to either changed its flight any more. So the later beginning is the moment to look at for whoever asks how it could
have been avoided, and what began that flight, a bounce, a turn under thrust, a shot, is the cause.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, Literal

from attrs import frozen

from fasteroids.actions import Action, Fire, Thrust, ThrustOff, Turn
from fasteroids.entities import Bullet, Entity, Ship, id_of
from fasteroids.events import Happened
from fasteroids.history.changes import last_change, told
from fasteroids.history.inputs import Act, Place, Remove
from fasteroids.history.living import Lived, Told
from fasteroids.history.marks import about, wanted
from fasteroids.history.questions import known
from fasteroids.history.timeline import Timeline
from fasteroids.rules import fired
from fasteroids.state import World, describe, located
from fasteroids.units import ModelError

__all__ = ["Course", "Death", "Deed", "why"]


@frozen
class Course:
    """The last flight of one who took part in a death."""

    entity: Entity
    """As it was when it happened, right before."""
    began: Lived | None
    """The state its flight began with; None if with this past."""
    since: Place
    """Where that is."""

    def __str__(self) -> str:
        """One line for people."""
        what = None if self.began is None else self.began.what
        return f"the flight of {describe(self.entity)} began at {self.since.time!r} s: {told(what)}"


@frozen
class Deed:
    """A ship did something that was no `skip`, as its program or a player told it."""

    ship: int
    action: str
    """One of turn, fire, thrust and thrust_off."""
    state: Lived
    """The state right after it; a tick's `what` has the place in the source."""

    def __str__(self) -> str:
        """A few words for people."""
        span = self.state.what.span if isinstance(self.state.what, Happened) else None
        line = f" (line {span.line})" if span is not None else ""
        return f"{self.action} at {self.state.place.time!r} s{line}"


@frozen
class Death:
    """How an entity died.

    `courses` are its own and that of the one it touched, if it did; `shots` how the bullets among them were fired,
    if this past knows; `deeds` the last deed of each ship involved, up to and with the death: those that touched, and
    those that fired the bullets; `stops` the ticks in which programs of theirs had stopped by then, for good. `how`: by
    a contact, a bullet at its second wall, or by a shot: fired where it stood.
    """

    how: Literal["contact", "wall", "shot"]
    state: Lived
    courses: tuple[Course, ...]
    shots: tuple[Deed, ...]
    deeds: tuple[Deed, ...]
    stops: tuple[Lived, ...] = ()

    @property
    def entity(self) -> Entity:
        """Who died, as it was right before."""
        return self.courses[0].entity

    @property
    def place(self) -> Place:
        """Where in the past it died."""
        return self.state.place

    @property
    def time(self) -> float:
        """When it died, s."""
        return self.place.time

    @property
    def partners(self) -> tuple[int, ...]:
        """The id of the one it touched, if it touched one."""
        return tuple(id_of(course.entity) for course in self.courses[1:])

    @property
    def inevitable(self) -> Place:
        """From here on it was fixed: the later of the places where the flights began."""
        return max(course.since for course in self.courses)

    def __str__(self) -> str:
        """A few lines for people."""
        others = " and ".join(describe(course.entity) for course in self.courses[1:])
        cause = {
            "contact": f"in a contact with {others}",
            "wall": "at its second wall",
            "shot": f"of a shot, with {others}",
        }[self.how]
        unchanged = (
            "neither flight changed" if len(self.courses) == 2 else "its flight did not change"
        )
        rows = [
            f"{describe(self.entity)} died at {self.time!r} s {cause}",
            f"it was fixed from {self.inevitable.time!r} s on: {unchanged} after that",
            *map(str, self.courses),
            *(f"ship #{shot.ship} fired: {shot}" for shot in self.shots),
            *(f"ship #{deed.ship} did last: {deed}" for deed in self.deeds),
            *map(_stopped, self.stops),
        ]
        return "\n  ".join(rows)


def why(timeline: Timeline, entity: int) -> Death:
    """How an entity died.

    `ModelError` if it did not: it is alive at the end of the line, was taken out, or never was.
    """
    state = _death(timeline, known(timeline, entity))
    world = _before(timeline, state.place)
    how, ids, shooter = _parts(state, entity)
    courses = tuple(_course(timeline, world, state, i, shooter) for i in ids)
    bullets = [course.entity for course in courses if isinstance(course.entity, Bullet)]
    shots = [_shot(timeline, bullet, state) for bullet in bullets]
    ships = {id_of(course.entity) for course in courses if isinstance(course.entity, Ship)}
    ships |= {bullet.source for bullet in bullets}
    deeds = [_last_deed(timeline, ship, state.place) for ship in sorted(ships)]
    stops = [_stop(timeline, ship, state.place) for ship in sorted(ships)]
    return Death(
        how,
        state,
        courses,
        tuple(shot for shot in shots if shot is not None),
        tuple(deed for deed in deeds if deed is not None),
        tuple(stop for stop in stops if stop is not None),
    )


def _death(timeline: Timeline, entity: int) -> Lived:
    """The state in which an entity was dead at first."""
    if entity in timeline.world:
        raise ModelError(
            f"{describe(timeline.world[entity])} is alive at {timeline.world.time!r} s"
        )
    for state in timeline.backwards(timeline.last.place, about(entity)):
        if entity in state.died:
            if isinstance(state.what, Told) and isinstance(state.what.what, Remove):
                raise ModelError(
                    f"#{entity} did not die; it was taken out at {state.place.time!r} s"
                )
            return state
    raise ModelError(f"there was no entity #{entity} in this past")


def _before(timeline: Timeline, place: Place) -> World:
    """The world right before a happening, as the state before it left it."""
    return next(state for state in timeline.backwards(place) if state.place < place).world


def _parts(
    state: Lived, entity: int
) -> tuple[Literal["contact", "wall", "shot"], tuple[int, ...], int | None]:
    """How it died, who took part, itself first, and the ship that fired if it was a shot."""
    what = state.what
    if isinstance(what, Happened) and what.kind in ("contact", "wall"):
        others = tuple(i for i in what.entities if i != entity)
        return ("contact" if what.kind == "contact" else "wall"), (entity, *others), None
    ship = what.entities[0] if isinstance(what, Happened) else _actor(what)
    bullet = next(i for i in state.died if i in state.born)
    other = next(i for i in state.died if i != bullet)
    return "shot", (entity, other if entity == bullet else bullet), ship


def _actor(what: object) -> int:
    assert isinstance(what, Told)
    assert isinstance(what.what, Act), "only a shot is an input that kills"
    return what.what.ship


def _course(
    timeline: Timeline, world: World, state: Lived, entity: int, shooter: int | None
) -> Course:
    """The last flight of one who took part; a bullet that died as it was fired began then."""
    moment = state.place.moment
    if entity not in world:
        assert shooter is not None
        ship = located(world.flight_of(shooter), moment)
        assert isinstance(ship, Ship)
        return Course(fired(ship, entity), state, state.place)
    here = located(world.flight_of(entity), moment)
    changed = last_change(timeline, entity, "flight", before=state.place)
    if changed is None:
        return Course(here, None, timeline.first.place)
    return Course(here, changed.state, changed.state.place)


# What ships did.

_DEEDS: Final = {Turn: "turn", Fire: "fire", Thrust: "thrust", ThrustOff: "thrust_off"}


def _deed(state: Lived, ship: int) -> str | None:
    """What a ship did in a state, if it did something."""
    what = state.what
    if isinstance(what, Happened):
        mine = what.kind == "tick" and what.entities == (ship,)
        return what.effect if mine and what.effect in _DEEDS.values() else None
    match what:
        case Told(Act(actor, action)) if actor == ship:
            return _called(action)
    return None


def _called(action: Action) -> str | None:
    return _DEEDS.get(type(action))  # a skip has no name here


def _last_deed(timeline: Timeline, ship: int, place: Place) -> Deed | None:
    """The last deed of a ship up to a place."""
    for state in timeline.backwards(place, about(ship)):
        action = _deed(state, ship)
        if action is not None:
            return Deed(ship, action, state)
    return None


def _stop(timeline: Timeline, ship: int, place: Place) -> Lived | None:
    """The state in which the program of a ship stopped for good, if it has by a place: its last tick."""
    for state in timeline.backwards(place, wanted("tick", ship)):
        what = state.what
        if isinstance(what, Happened) and what.kind == "tick" and what.entities == (ship,):
            flown = state.world.entities.get(ship)
            program = flown.program if isinstance(flown, Ship) else None
            return state if program is not None and not program.running else None
    return None


def _stopped(state: Lived) -> str:
    """One line for people: when and why a program stopped."""
    what = state.what
    assert isinstance(what, Happened)
    if what.reason is None:
        why = "it came to its end"
    else:
        why = f"line {what.span.line}: {what.reason}" if what.span is not None else what.reason
    return f"the program of ship #{what.entities[0]} had stopped at {what.time!r} s: {why}"


def _shot(timeline: Timeline, bullet: Bullet, death: Lived) -> Deed | None:
    """How a bullet was fired; None if it was in the first world, or brought by an input."""
    born: Iterator[Lived] = timeline.backwards(death.place, wanted("birth", bullet.id))
    for state in born:
        if bullet.id in state.born:
            return Deed(bullet.source, "fire", state) if _deed(state, bullet.source) else None
    return None
