"""Stepping a ship's program on screen: by statement and to breakpoints, forwards and backwards across ticks. Pure.

Where the debugger stands is a `Point` (`fasteroids.history.stepping`), and the world one sees is the one the program
sees there. Behind the last step of a line that is still live, a step forwards lets time go on to the next tick.
"""

from __future__ import annotations

from typing import Final, Literal

from attrs import evolve

from fasteroids.entities import Ship
from fasteroids.history import Place, Point, at_tick, next_statement, previous_statement, tick_at
from fasteroids.lang import Machine
from fasteroids.moments import between, tick_moment
from fasteroids.state import World
from fasteroids.tui.breakpoints import AtLine, next_break
from fasteroids.tui.session import Session, lived_on, look, played
from fasteroids.units import ModelError

__all__ = ["flown", "here", "run", "stand", "statement", "toggled"]

_NOWHERE: Final = "no ship here runs a program: select one that does"


def flown(session: Session) -> int | None:
    """The ship whose program is looked at: the selected one, else the first that has one."""
    world = session.world
    chosen = session.selected
    if chosen is not None and _flies(world, chosen):
        return chosen
    return next((ship.id for ship in world.ships if isinstance(ship.program, Machine)), None)


def _flies(world: World, ship: int) -> bool:
    e = world.entities.get(ship)
    return isinstance(e, Ship) and isinstance(e.program, Machine)


def here(session: Session) -> Point | None:
    """Where the debugger stands: if it stands in what one sees; else in front of the last tick that one sees."""
    ship = flown(session)
    if ship is None:
        return None
    point = session.point
    if point is not None and point.tick.ship == ship and session.at == _before(point):
        return point
    try:
        return at_tick(session.timeline, ship, session.place)
    except ModelError:  # it has not run yet
        return None


def _before(point: Point) -> Place:
    """The place right before a tick."""
    place = point.tick.place
    return place._replace(nth=place.nth - 1)


def stand(session: Session, point: Point) -> Session:
    """The debugger stands there, and one sees the world that the program sees."""
    session = evolve(look(session, _before(point)), point=point, selected=point.tick.ship)
    span = point.statement
    return evolve(session, said=f"line {span.line} at {point.tick.time:.1f} s, step {point.step}")


def statement(session: Session, direction: Literal[1, -1]) -> Session:
    """One statement on, or back."""
    ship, point = flown(session), here(session)
    if ship is None:
        return evolve(session, said=_NOWHERE)
    if point is None:
        return _ticked(session, ship)
    if point is not session.point:  # the debugger comes: it stands at the tick first
        return stand(session, point)
    following = (next_statement if direction > 0 else previous_statement)(session.timeline, point)
    if following is not None:
        return stand(session, following)
    if direction < 0:
        return evolve(session, said="the program begins here")
    return _ticked(session, ship)


def _ticked(session: Session, ship: int) -> Session:
    """Time goes on to the next tick of a ship, in front of whose first step one stands."""
    live = played(session)
    f = live.timeline.world.flight_of(ship) if ship in live.timeline.world else None
    if f is None or f.next_tick is None:
        return evolve(session, said="the program has come to its end")
    span = max(between(live.timeline.world.now, tick_moment(f.next_tick)), 0.0)
    live = lived_on(live, span)
    try:
        return stand(live, at_tick(live.timeline, ship, live.place))
    except ModelError as error:  # it died on the way
        return evolve(live, said=str(error))


def toggled(session: Session) -> Session:
    """A breakpoint on the line where the debugger stands; or none, if there is one."""
    point = here(session)
    if point is None:
        return evolve(session, said=_NOWHERE)
    mark = AtLine(point.statement.line)
    marks = session.breakpoints
    gone = mark in marks
    kept = tuple(each for each in marks if each != mark) if gone else (*marks, mark)
    word = "no breakpoint" if gone else "breakpoint"
    return evolve(session, breakpoints=kept, said=f"{word} on line {mark.line}")


def run(session: Session, direction: Literal[1, -1]) -> Session:
    """To the next breakpoint, or back to the last one."""
    point = here(session)
    if point is None:
        return evolve(session, said=_NOWHERE)
    if not session.breakpoints:
        return evolve(session, said="there is no breakpoint")
    found = next_break(session.timeline, session.breakpoints, point, direction)
    if found.point is not None:
        return stand(session, found.point)
    tick = tick_at(session.timeline, point.tick.ship, found.last)
    session = stand(session, Point(tick, len(tick.steps) - 1 if direction > 0 else 0))
    where = "to the end" if found.exhausted else f"in {found.ticks} ticks, and stands there"
    return evolve(session, said=f"no breakpoint was met {where}")
