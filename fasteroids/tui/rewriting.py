"""Another program for a ship from where one looks, and what comes of it: the first difference of two lines. Pure.

    ship, text = source_of(session)
    program = checked(text)                         or its diagnostics
    session = yield from rewriting(session, ship, program)

The past up to there stays, the rest is lived again with the other program (`fasteroids.tui.edits`). The new line is
the one that time goes on in; the old future is seen as ghosts.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Final

from attrs import evolve

from fasteroids.actions import Program
from fasteroids.entities import Ship
from fasteroids.history import condition, first_difference, outwardly
from fasteroids.lang import Diagnostic, check_program, parse_program
from fasteroids.state import describe
from fasteroids.tui.breakpoints import When
from fasteroids.tui.debugging import breakpoints_of, flown, machine_here
from fasteroids.tui.edits import Edited, editing
from fasteroids.tui.session import Compared, Session, other_line
from fasteroids.units import ModelError

__all__ = ["checked", "compared", "rewriting", "sentence", "source_of", "title_of"]

_MOST_NOTES: Final = 3


def source_of(session: Session) -> tuple[int, str] | None:
    """The ship whose program is looked at, and its text; None if no ship here runs one."""
    ship, machine = flown(session), machine_here(session)
    return None if ship is None or machine is None else (ship, machine.code.source)


def title_of(session: Session, ship: int) -> str:
    """What is edited."""
    return f"the program of {describe(session.world[ship])} from {session.place.time:.2f} s on"


def checked(text: str) -> Program | tuple[Diagnostic, ...]:
    """The program that a text is, or all its diagnostics."""
    found = check_program(parse_program(text))
    return found.diagnostics if found.program is None else found.program


def sentence(each: Diagnostic) -> str:
    """A diagnostic in one sentence, with where it is."""
    hint = "" if each.hint is None else f" ({each.hint})"
    return f"line {each.span.line}, column {each.span.column}: {each.message}{hint}"


def rewriting(session: Session, ship: int, program: Program) -> Generator[float, None, Session]:
    """The session in another line, in which a ship runs a program from where one looks on.

    In pieces: yields the time (s) it has come to. `ModelError` if there is no such ship there.
    """
    outcome = yield from editing(session.timeline, ship, program, session.place)
    compared = Compared(outcome.old, outcome.timeline.name, outcome.parted, tuple(_notes(outcome)))
    session = _kept(other_line(session, outcome.timeline), ship)
    parted = outcome.parted
    tells = "both lines do the same" if parted is None else f"they part at {parted.time:.2f} s"
    said = f"line {compared.new} with the other program: {tells}"
    return evolve(session, selected=ship, compared=compared, said=said)


def _notes(outcome: Edited) -> list[str]:
    notes = [
        f"{each.place.time:.2f} s: {each.what} was left out, as {each.reason}"
        for each in outcome.left_out[:_MOST_NOTES]
    ]
    more = len(outcome.left_out) - len(notes)
    return notes + [f"{more} more inputs were left out"] * (more > 0)


def _kept(session: Session, ship: int) -> Session:
    """With the breakpoints that still make sense: a condition may name a variable that is no more."""
    entity, kept = session.world.flight_of(ship).entity, []
    assert isinstance(entity, Ship)
    for each in breakpoints_of(session, ship):
        if isinstance(each, When):
            try:
                each = When(condition(each.condition.text, entity))
            except ModelError:
                continue
        kept.append(each)
    return evolve(session, breakpoints=session.breakpoints.set(ship, tuple(kept)))


def compared(session: Session) -> Session:
    """With the difference of this line and the one that it branched off; without it, if it is shown already."""
    timeline = session.timeline
    parent = timeline.line.parent
    if parent is None:
        return evolve(session, compared=None, said="this line branched off no other")
    if session.compared is not None and session.compared.new == timeline.name:
        return evolve(session, compared=None, said="")
    parted = first_difference(timeline, parent, timeline.name, by=outwardly)
    tells = "do the same so far" if parted is None else f"part at {parted.time:.2f} s"
    said = f"the lines {parent} and {timeline.name} {tells}"
    return evolve(session, compared=Compared(parent, timeline.name, parted), fate=None, said=said)
