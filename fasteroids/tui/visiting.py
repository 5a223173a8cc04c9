"""Where a debugger comes into a past: at a time, at the death of a ship, or at the end. Pure."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from attrs import evolve

from fasteroids.entities import Ship
from fasteroids.history import Lived, Timeline
from fasteroids.history.marks import wanted
from fasteroids.tui.debugging import flown
from fasteroids.tui.session import Session, lived_on, look, look_at
from fasteroids.units import ModelError

__all__ = ["death_in", "ship_meant", "visited"]


def visited(session: Session, at: float | None = None, who: str | None = None) -> Session:
    """The session in a pause where a debugger begins, with a ship selected: the one of this name or id, if given.

    A live session begins where it is; with `at` (s) it lives up to there first. A past is looked at at its end, or
    right before the death of the ship that was named. `ModelError` says which ships or times there are.
    """
    ship = None if who is None else ship_meant(session.timeline, who)
    session = evolve(session, running=0, selected=ship)
    session = _lived(session, at) if session.live else _looked(session, at)
    if ship is not None:
        return session
    ship = flown(session)
    if ship is None:
        others = session.world.ships
        said = "no ship here runs a program"
        return evolve(session, selected=others[0].id if others else None, said=said)
    return evolve(session, selected=ship)


def _lived(session: Session, at: float | None) -> Session:
    now = session.world.time
    if at is None:
        return session
    if at < now:
        raise ModelError(f"this scene begins at {now!r} s; there is no {at!r} s in it")
    return evolve(lived_on(session, at - now), running=0)


def _looked(session: Session, at: float | None) -> Session:
    timeline = session.timeline
    first, last = timeline.first.world.time, timeline.world.time
    if at is not None:
        if not first <= at <= last:
            raise ModelError(
                f"this recording goes from {first!r} s to {last!r} s; there is no {at!r} s in it"
            )
        return look_at(session, at)
    death = None if session.selected is None else death_in(timeline, session.selected)
    if death is None:
        return look(session, timeline.last.place)
    said = f"ship #{session.selected} dies here; the key for 'why' tells how it came to that"
    return evolve(look(session, death.place.before), said=said)


def death_in(timeline: Timeline, entity: int) -> Lived | None:
    """The state that the death of an entity led to; None if it does not die in this past."""
    deaths = timeline.forwards(timeline.first.place, wanted("death", entity))
    return next((state for state in deaths if entity in state.died), None)


def ship_meant(timeline: Timeline, who: str) -> int:
    """The ship of a name, the last one if several had it; else the one whose id it is. `ModelError` if none is."""
    names = {ship.id: ship.name or "" for ship in _ships(timeline) if ship.id is not None}
    named = [i for i, name in names.items() if name == who]
    if named:
        return named[-1]
    for i in names:
        if who.removeprefix("#") == str(i):
            return i
    known = [name or f"#{i}" for i, name in names.items()]
    near = get_close_matches(who, known, n=1)
    hint = f" (did you mean {near[0]!r}?)" if near else ""
    there = ", ".join(dict.fromkeys(known))
    are = "are" if "," in there else "is"
    raise ModelError(
        f"there is no ship {who!r}{hint}; there {are} {there}"
        if known
        else "there is no ship in it"
    )


def _ships(timeline: Timeline) -> Iterator[Ship]:
    """All ships of a past, in the order in which they came."""
    yield from timeline.first.world.ships
    for state in timeline.forwards(timeline.first.place, wanted("birth")):
        for i in state.born:
            if i in state.world and isinstance(ship := state.world[i], Ship):
                yield ship
