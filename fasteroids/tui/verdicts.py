"""Why somebody died, and where two futures part: told in a few rows, each of which leads to its moment.

    told = death_of(timeline, 1)
    death_rows(told, 60), told.paths         the sentences, and both ways to draw in the arena
    difference_rows(first_difference(timeline, "main", "2"), 60, 12)

`death_of` and `first_difference` ask the timeline itself, which may have to live pieces of it again: ask once, when
somebody wants to know, and keep the answer. Rows are made of answers, at any width and at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

from attrs import frozen

from fasteroids.entities import id_of
from fasteroids.events import Happened
from fasteroids.history import (
    ABSENT,
    Course,
    Death,
    Deed,
    Difference,
    Lived,
    Parted,
    Place,
    Timeline,
    why,
)
from fasteroids.history.living import Told
from fasteroids.lang.machine.values import Seen
from fasteroids.lang.machine.values import shown as value_shown
from fasteroids.moments import Moment, between, later
from fasteroids.state import Flight, World, describe, located
from fasteroids.tui.overlay import Point
from fasteroids.tui.rows import Row, Style, clock, filled, paragraph, row
from fasteroids.tui.words import called, happened, number

__all__ = [
    "DeathTold",
    "Way",
    "death_of",
    "death_rows",
    "difference_rows",
    "fate_of",
]

_PIECES: Final = 24
"""Straight pieces that stand for a bent path."""


class Way(NamedTuple):
    """How an entity flew: a line through points, in order; one point if it took no time."""

    id: int
    points: tuple[Point, ...]


@frozen
class DeathTold:
    """Why an entity died, the world right before, and the ways of those that touched."""

    death: Death
    before: World
    paths: tuple[Way, ...]
    """From where it was inevitable to the contact; the one that died first."""

    @property
    def inevitable(self) -> Place:
        """The last place at which something could still change it."""
        return self.death.inevitable


def death_of(timeline: Timeline, entity: int) -> DeathTold:
    """How an entity died, as `fasteroids.history.why`; `ModelError` as there: it did not, or is not known.

    As slow as that: quick on kept states, but where they were thinned, as long as the pieces since the last deed of
    those involved took.
    """
    death = why(timeline, entity)
    place = death.place
    before = next(s for s in timeline.backwards(place) if s.place < place).world
    start = death.inevitable.moment
    paths = tuple(_way(before, course, start, place.moment) for course in death.courses)
    return DeathTold(death, before, paths)


def _way(world: World, course: Course, start: Moment, end: Moment) -> Way:
    """The way of one who took part, from the moment on at which both flew as they did to the end."""
    entity = id_of(course.entity)
    if entity not in world:  # a bullet that was fired where something stood
        return Way(entity, (course.entity.position,))
    f = world.flight_of(entity)
    start = max(start, f.since)
    span, pieces = between(start, end), 1 if f.path is None else _PIECES
    inner = (_at(f, later(start, k / pieces * span)) for k in range(pieces))
    return Way(entity, tuple(dict.fromkeys((*inner, _at(f, end)))))


def _at(f: Flight, moment: Moment) -> Point:
    return located(f, moment).position


def fate_of(death: Death) -> str:
    """Who died, when, and of what, without a full stop."""
    others = " and ".join(describe(course.entity) for course in death.courses[1:])
    cause = {
        "contact": f"in a contact with {others}",
        "wall": "at its second wall",
        "shot": f"of a shot, with {others}",
    }[death.how]
    return f"{describe(death.entity)} died at {clock(death.time)} s {cause}"


def death_rows(told: DeathTold, width: int) -> tuple[Row, ...]:
    """Why it died, in as many rows of `width` cells as that takes; each leads to the moment it tells of."""
    return tuple(_death(told, width))


def _death(told: DeathTold, width: int) -> Iterator[Row]:
    death, before = told.death, told.before
    yield from paragraph(width, f"{fate_of(death)}.", Style.BAD, place=death.place)
    left = between(death.inevitable.moment, death.place.moment)
    unchanged = "neither flight changed" if len(death.courses) == 2 else "its flight did not change"
    since = clock(death.inevitable.time)
    sentence = f"From {since} s on it was inevitable: {unchanged} in the last {left:.3f} s."
    yield from paragraph(width, sentence, Style.WARNING, place=death.inevitable)
    for course in death.courses:
        yield from paragraph(width, _course(course, before), place=course.since)
    for shot in death.shots:
        sentence = f"The shot was fired by {_ship(before, shot)}{_when(shot)}."
        yield from paragraph(width, sentence, place=shot.state.place)
    for deed in death.deeds:
        sentence = f"The last deed of {_ship(before, deed)}: {_deed(deed)}{_when(deed)}."
        yield from paragraph(width, sentence, place=deed.state.place)


def _course(course: Course, world: World) -> str:
    name = describe(course.entity)
    if course.began is None:
        return f"{name} flew so from the beginning of the past on."
    cause = happened(course.began.what, id_of(course.entity), world)
    return f"{name} flew so since {clock(course.since.time)} s: {cause}."


def _ship(world: World, deed: Deed) -> str:
    return describe(world[deed.ship]) if deed.ship in world else f"ship #{deed.ship}"


def _deed(deed: Deed) -> str:
    return deed.action.replace("_", " ")


def _when(deed: Deed) -> str:
    what = deed.state.what
    span = what.span if isinstance(what, Happened) else None
    line = f", line {span.line} of its program" if span is not None else ""
    hand = ", by hand" if isinstance(what, Told) else ""
    return f" at {clock(deed.state.place.time)} s{line}{hand}"


# Differences.


def difference_rows(
    parted: Parted | None, width: int, height: int, *, names: tuple[str, str] = ("old", "new")
) -> tuple[Row, ...]:
    """Where two lines part, in exactly `height` rows: the moment, what each did then, or what came out differently."""
    return filled([*_parted(parted, width, names)], width, height)


def _parted(parted: Parted | None, width: int, names: tuple[str, str]) -> Iterator[Row]:
    if parted is None:
        yield from paragraph(width, "Both do the same, as far as both have come.", Style.GOOD)
        return
    sentence = f"They part at {clock(parted.time)} s."
    yield from paragraph(width, sentence, Style.WARNING, place=parted.place)
    if parted.differences and parted.a is not None:
        yield from paragraph(width, f"both: {_happening(parted.a)}", place=parted.a.place)
        for difference in parted.differences:
            yield row(width, *_difference(difference))
        return
    for name, state in zip(names, (parted.a, parted.b), strict=True):
        what = "nothing more" if state is None else _happening(state)
        yield from paragraph(width, f"{name}: {what}", place=None if state is None else state.place)


def _happening(state: Lived) -> str:
    """What led to a state, told of the first who took part."""
    what = state.what
    if isinstance(what, Happened):
        me = what.entities[0]
    else:
        ids = (*state.born, *state.died)
        me = getattr(getattr(what, "what", None), "ship", ids[0] if ids else 0)
    who = called(state.world, me)
    return f"{clock(state.place.time)} s {who}: {happened(what, me, state.world)}"


def _difference(each: Difference) -> tuple[str | tuple[str, Style], ...]:
    who = "world" if each.entity is None else f"#{each.entity}"
    if each.field == "entity":
        there, which = (each.b, "new") if each.a is ABSENT else (each.a, "old")
        kind = getattr(there, "kind", "entity")
        return (f"{who:>5} ", Style.TITLE), f"{kind} only in the {which}"
    texts = isinstance(each.a, str) and isinstance(each.b, str) and each.field == "program"
    values = "not the same" if texts else f"{_value(each.a)} | {_value(each.b)}"
    return (f"{who:>5} ", Style.TITLE), (f"{each.field} ", Style.DIM), values


def _value(value: object) -> str:
    if isinstance(value, float):
        return number(value)
    if value is None or isinstance(value, bool | Seen):
        return value_shown(value)
    if isinstance(value, tuple) and all(isinstance(x, float) for x in value):
        return "(" + ", ".join(number(x) for x in value) + ")"
    return str(value)
