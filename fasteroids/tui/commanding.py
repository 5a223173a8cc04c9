"""What each command does to a session and to how it is seen. Pure; what needs a terminal or a file is not here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Final

from attrs import evolve

from fasteroids.history.marks import Kind, wanted
from fasteroids.tui.debugging import run, statement, toggled
from fasteroids.tui.keys import Command
from fasteroids.tui.picture import View
from fasteroids.tui.rewriting import compared
from fasteroids.tui.session import (
    Session,
    bookmarked,
    doomed,
    faster,
    jump,
    look,
    paused,
    played,
    scrub,
    select_next,
    take_over,
)
from fasteroids.tui.visiting import death_in

__all__ = ["commanded", "victim", "viewed"]


def commanded(session: Session, command: Command) -> Session | None:
    """The session after a command; None if the command is about something else."""
    done = _DONE.get(command)
    return None if done is None else done(evolve(session, seek=None))


def viewed(view: View, command: Command) -> View | None:
    """The view after a command; None if the command is about something else."""
    match command:
        case Command.ARENA:
            return view.switched()
        case Command.OVERLAY:
            return evolve(view, overlay=not view.overlay)
        case Command.GHOSTS:
            return evolve(view, ghosts=not view.ghosts)
        case Command.PANELS:
            return evolve(view, panels=not view.panels)
    return None


def victim(session: Session) -> int | None:
    """Whose death is asked about: the selected entity if it dies in this past, else the player who died last."""
    place, selected = session.place, session.selected
    if selected is not None and (
        selected not in session.world or death_in(session.timeline, selected) is not None
    ):
        return selected
    ships = {
        p.ship for _, game in session.games[session.timeline.name] for p in game.players if p.ship
    }
    for state in session.timeline.backwards(place, wanted("death")):
        died = [i for i in state.died if i in ships]
        if died:
            return died[0]
    return None


def _why(session: Session) -> Session:
    ship = victim(session)
    if ship is None:
        return evolve(session, said="nobody has died yet")
    return doomed(session, ship)


def _first(session: Session) -> Session:
    return look(session, session.timeline.first.place)


def _contact(session: Session, direction: int) -> Session:
    return jump(session, "contact", direction, entity=session.selected)


def _jump(session: Session, kind: Kind, direction: int) -> Session:
    return jump(session, kind, direction)


def _to_bookmark(session: Session, direction: int) -> Session:
    """The nearest bookmark of this past on one side."""
    timeline, here = session.timeline, session.place
    marks = [
        (b.state.place, b.name)
        for b in timeline.bookmarks.values()
        if timeline.holds(b.line, b.state.place)
    ]
    ahead = [m for m in marks if (m[0] > here if direction > 0 else m[0] < here)]
    if not ahead:
        return evolve(session, said=f"no {'later' if direction > 0 else 'earlier'} bookmark")
    place, name = min(ahead) if direction > 0 else max(ahead)
    return evolve(look(session, place), said=f"bookmark {name}")


def _scrub(unit: str, direction: int) -> Callable[[Session], Session]:
    return lambda session: scrub(session, unit, direction)  # type: ignore[arg-type]  # one of the four


_DONE: Final[Mapping[Command, Callable[[Session], Session]]] = {
    Command.PAUSE: paused,
    Command.SLOWER: partial(faster, step=-1),
    Command.FASTER: partial(faster, step=1),
    Command.BACK_FRAME: _scrub("frame", -1),
    Command.FORWARD_FRAME: _scrub("frame", 1),
    Command.BACK_EVENT: _scrub("event", -1),
    Command.FORWARD_EVENT: _scrub("event", 1),
    Command.BACK_TICK: _scrub("tick", -1),
    Command.FORWARD_TICK: _scrub("tick", 1),
    Command.BACK_SECOND: _scrub("second", -1),
    Command.FORWARD_SECOND: _scrub("second", 1),
    Command.FIRST: _first,
    Command.LAST: played,
    Command.TAKE_OVER: take_over,
    Command.PREVIOUS_DEATH: partial(_jump, kind="death", direction=-1),
    Command.NEXT_DEATH: partial(_jump, kind="death", direction=1),
    Command.PREVIOUS_SHOT: partial(_jump, kind="shot", direction=-1),
    Command.NEXT_SHOT: partial(_jump, kind="shot", direction=1),
    Command.PREVIOUS_CONTACT: partial(_contact, direction=-1),
    Command.NEXT_CONTACT: partial(_contact, direction=1),
    Command.BOOKMARK: bookmarked,
    Command.PREVIOUS_BOOKMARK: partial(_to_bookmark, direction=-1),
    Command.NEXT_BOOKMARK: partial(_to_bookmark, direction=1),
    Command.PROGRAM_BACK: partial(statement, direction=-1),
    Command.PROGRAM_FORWARD: partial(statement, direction=1),
    Command.BREAKPOINT: toggled,
    Command.RUN_BACK: partial(run, direction=-1),
    Command.RUN_FORWARD: partial(run, direction=1),
    Command.DIFFERENCE: compared,
    Command.WHY: _why,
    Command.SELECT_PREVIOUS: partial(select_next, step=-1),
    Command.SELECT_NEXT: partial(select_next, step=1),
}
