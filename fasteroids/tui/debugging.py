"""Stepping a ship's program on screen: by statement and to breakpoints, forwards and backwards across ticks. Pure.

Where the debugger stands is a `Point` (`fasteroids.history.stepping`), and the world one sees is the one the program
sees there. Behind the last step of a line that is still live, a step forwards lets time go on to the next tick.

A search for a breakpoint goes on in pieces, so that a screen stays awake: `run` begins it, `sought` takes it a piece
further as long as `Session.seek` says so, and `stopped` gives up.
"""

from __future__ import annotations

from typing import Final, Literal

from attrs import evolve

from fasteroids.entities import Ship
from fasteroids.history import (
    Lived,
    Place,
    Point,
    at_tick,
    condition,
    next_statement,
    next_tick,
    previous_statement,
    tick_at,
    ticks_of,
)
from fasteroids.lang import Machine
from fasteroids.lang.machine import place as place_in
from fasteroids.lang.machine.traced import machine_in
from fasteroids.moments import between, tick_moment
from fasteroids.state import World
from fasteroids.tui.breakpoints import AtLine, Breakpoint, Found, When, next_break
from fasteroids.tui.session import Seek, Session, lived_on, look, played
from fasteroids.units import ModelError

__all__ = [
    "before_tick",
    "breakpoints_of",
    "broken_at",
    "flown",
    "here",
    "machine_here",
    "run",
    "sought",
    "stand",
    "statement",
    "stopped",
    "toggled",
]

_NOWHERE: Final = "no ship here runs a program"
_BEGINS: Final = "the program begins here"
_ENDED: Final = "the program has come to its end"

_AT_ONCE: Final = 5
"""Ticks that are looked through at once; a tick of many steps takes some 20 ms."""

_IN_FRONT: Final = -1
"""The step in front of all steps of a tick: where the first of them comes next."""


def flown(session: Session) -> int | None:
    """The ship whose program is looked at: the selected one, else the first that has one."""
    world = session.world
    chosen = session.selected
    if chosen is not None and _flies(world, chosen):
        return chosen
    return next((ship.id for ship in world.ships if machine_in(ship.program) is not None), None)


def _flies(world: World, ship: int) -> bool:
    return _aboard(world, ship) is not None


def machine_here(session: Session) -> Machine | None:
    """The program that is looked at, as it is where one looks; None if there is none."""
    ship, point = flown(session), here(session)
    if point is not None:
        return point.machine
    return None if ship is None else _aboard(session.world, ship)


def _aboard(world: World, ship: int) -> Machine | None:
    """The program that a ship carries; None if it is dead, or has none."""
    e = world.entities.get(ship)
    return machine_in(e.program) if isinstance(e, Ship) else None


def here(session: Session) -> Point | None:
    """Where the debugger stands, if that is in what one sees; else behind the last tick that one sees.

    None if no program is there, or if it has not run yet.
    """
    ship = flown(session)
    return None if ship is None else _here(session, ship)


def _here(session: Session, ship: int) -> Point | None:
    point = _standing(session, ship)
    if point is not None:
        return point
    try:
        tick = tick_at(session.timeline, ship, session.place)
    except ModelError:  # it has not run yet
        return None
    point, now = Point(tick, len(tick.steps)), _aboard(session.world, ship)
    if now is not None and now.code.source != point.machine.code.source:  # the ship got another one
        return None
    return point


def _standing(session: Session, ship: int) -> Point | None:
    """Where the debugger stands, if that is in what one sees."""
    point = session.point
    if point is None or point.tick.ship != ship or session.at != before_tick(point):
        return None
    return point


def before_tick(point: Point) -> Place:
    """The place right before the tick of a point."""
    return point.tick.place.before


def stand(session: Session, point: Point) -> Session:
    """The debugger stands there, and one sees the world that the program sees."""
    session = evolve(look(session, before_tick(point)), point=point, selected=point.tick.ship)
    span = point.statement
    return evolve(session, said=f"line {span.line} at {point.tick.time:.1f} s, step {point.step}")


def statement(session: Session, direction: Literal[1, -1]) -> Session:
    """One statement on, or back."""
    ship = _stepped(session)
    if isinstance(ship, str):
        return evolve(session, said=ship)
    point = _here(session, ship)
    if point is None:
        return evolve(session, said=_BEGINS) if direction < 0 else _first(session, ship)
    if direction > 0 and ship not in session.world:
        return evolve(session, said=f"ship #{ship} is dead here")
    following = (next_statement if direction > 0 else previous_statement)(session.timeline, point)
    if following is not None:
        return stand(session, following)
    if direction < 0:
        return evolve(session, said=_BEGINS)
    return _ticked(session, ship)


def _stepped(session: Session) -> int | str:
    """The ship whose program is stepped: one that is selected but dead by then had one too. Else why there is none."""
    chosen, ship = session.selected, flown(session)
    if chosen is not None and chosen not in session.world:
        try:
            return tick_at(session.timeline, chosen, session.place).ship
        except ModelError:
            pass
    return _NOWHERE if ship is None else ship


def _first(session: Session, ship: int) -> Session:
    """In front of the first step of a program that has not run yet."""
    tick = next_tick(session.timeline, ship, session.place)
    return _ticked(session, ship) if tick is None else stand(session, Point(tick))


def _ticked(session: Session, ship: int) -> Session:
    """Time goes on to the next tick of a ship, in front of whose first step one stands."""
    live, state = _lived_on(session, ship)
    if state is None:
        return live
    return stand(live, at_tick(live.timeline, ship, state.place))


def _lived_on(session: Session, ship: int) -> tuple[Session, Lived | None]:
    """Time goes on to the next tick of a ship: what that led to. None, and what is said, if there is no tick."""
    live = played(session)
    world, last = live.timeline.world, live.timeline.last.place
    f = world.flight_of(ship) if ship in world else None
    if f is None:
        return evolve(session, said=f"ship #{ship} is dead at the end"), None
    if f.next_tick is None:
        return evolve(session, said=_ENDED), None
    live = lived_on(live, max(between(world.now, tick_moment(f.next_tick)), 0.0))
    state = next(ticks_of(live.timeline, ship, after=last), None)
    return (live if state else evolve(live, said=f"ship #{ship} died before its next tick")), state


# Breakpoints.


def breakpoints_of(session: Session, ship: int | None) -> tuple[Breakpoint, ...]:
    """The breakpoints of a ship's program."""
    return () if ship is None else session.breakpoints.get(ship, ())


def toggled(session: Session) -> Session:
    """A breakpoint on the line where the debugger stands; or none, if there is one."""
    point, machine = here(session), machine_here(session)
    if machine is None:
        return evolve(session, said=_NOWHERE)
    line = (place_in(machine) if point is None else point.statement).line
    return _with_or_without(session, AtLine(line))


def broken_at(session: Session, text: str) -> Session:
    """A breakpoint as people write it, or none if there is such a one: the number of a line, or a condition.

    `ModelError` with a sentence, or with the report of the first fault of a condition.
    """
    ship, machine = flown(session), machine_here(session)
    if ship is None or machine is None:
        raise ModelError(_NOWHERE)
    if not text.strip().isdecimal():
        seen_from = session.world.flight_of(ship).entity
        assert isinstance(seen_from, Ship)
        return _with_or_without(session, When(condition(text.strip(), seen_from)))
    line, most = int(text), machine.code.source.rstrip("\n").count("\n") + 1
    if not 1 <= line <= most:
        raise ModelError(f"the program has the lines 1 to {most}; there is no line {line}")
    return _with_or_without(session, AtLine(line))


def _with_or_without(session: Session, mark: Breakpoint) -> Session:
    ship = flown(session)
    assert ship is not None
    marks = breakpoints_of(session, ship)
    gone = mark in marks
    kept = tuple(each for each in marks if each != mark) if gone else (*marks, mark)
    where = f"on line {mark.line}" if isinstance(mark, AtLine) else f"when {mark.condition.text}"
    said = f"{'no breakpoint' if gone else 'breakpoint'} {where}"
    return evolve(session, breakpoints=session.breakpoints.set(ship, kept), said=said)


# Running to them.


def run(session: Session, direction: Literal[1, -1]) -> Session:
    """To the next breakpoint, or back to the last one: the first piece of the search.

    Where the last tick that was lived has no breakpoint any more, time lives on until there is one.
    """
    ship = _stepped(session)
    if isinstance(ship, str):
        return evolve(session, said=ship)
    marks = breakpoints_of(session, ship)
    if not marks:
        return evolve(session, said="there is no breakpoint")
    start = _start(session, ship)
    if start is None and direction < 0:
        return evolve(session, said=_BEGINS)
    if direction > 0 and (start is None or start.tick.place >= _last_tick(session, ship)):
        rest = (
            None if start is None else next_break(session.timeline, marks, start, 1, ticks=1).point
        )
        return sought(evolve(session, seek=Seek(ship, 1, living=rest is None)))
    return sought(evolve(session, seek=Seek(ship, direction)))


def _start(session: Session, ship: int) -> Point | None:
    """Where a search begins: where the debugger stands, or in front of the first tick; None if there is none."""
    point = _here(session, ship)
    if point is not None:
        return point
    first = next_tick(session.timeline, ship, session.place)
    return None if first is None else Point(first, _IN_FRONT)


def _last_tick(session: Session, ship: int) -> Place:
    return tick_at(session.timeline, ship, session.timeline.last.place).place


def sought(session: Session) -> Session:
    """The search a piece further: `seek` is None where it has ended, and one stands where it came to."""
    seek = session.seek
    if seek is None:
        return session
    ship, marks = seek.ship, breakpoints_of(session, seek.ship)
    if seek.living:
        return _sought_living(session, ship)
    start = _start(session, ship)
    if start is None:
        return stopped(session)
    found = next_break(session.timeline, marks, start, seek.step, ticks=_AT_ONCE)
    if found.point is not None:
        return _met(session, found)
    tick = tick_at(session.timeline, ship, found.last)
    session = stand(session, Point(tick, len(tick.steps) - 1 if seek.step > 0 else 0))
    if not found.exhausted:
        return evolve(session, said=f"no breakpoint yet, at {tick.time:.1f} s; Esc stops")
    end = "on to the end; once more lives on" if seek.step > 0 else "back to the beginning"
    return evolve(session, seek=None, said=f"no breakpoint {end}")


def _sought_living(session: Session, ship: int) -> Session:
    ended = session.game.ended
    session, state = _lived_on(session, ship)
    if state is None:
        return evolve(session, seek=None)
    start = Point(tick_at(session.timeline, ship, state.place), _IN_FRONT)
    marks = breakpoints_of(session, ship)
    found = next_break(session.timeline, marks, start, 1, ticks=1)
    if found.point is not None:
        return _met(session, found)
    if session.game.ended is not ended:
        return evolve(session, seek=None, said="no breakpoint, and the game has ended")
    return evolve(session, said=f"no breakpoint yet, at {state.place.time:.1f} s; Esc stops")


def _met(session: Session, found: Found) -> Session:
    """One stands at a breakpoint."""
    assert found.point is not None
    session = stand(session, found.point)
    met = found.breakpoint
    why = f": {met.condition.text}" if isinstance(met, When) else ""
    return evolve(session, seek=None, said=f"breakpoint, {session.said}{why}")


def stopped(session: Session) -> Session:
    """A search is given up; one stands where it came to."""
    return evolve(session, seek=None, said="the search has stopped")
