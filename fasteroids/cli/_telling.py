"""A game told in words, line by line: for screen readers, logs and CI."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from fasteroids.actions import Action
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE
from fasteroids.cli._narrate import Narrator, census
from fasteroids.events import Happened

if TYPE_CHECKING:
    from fasteroids.tui.launching import Launched
    from fasteroids.tui.session import Session

__all__ = ["LONGEST", "told"]

LONGEST: Final = 120.0
"""Seconds of game time that are told at most."""

_STEP: Final = 0.2
"""Seconds of game time that are lived at a time."""


def told(begun: Launched, *, live: bool) -> int:
    """Tell a game that programs play, to its end or for `LONGEST` s; or, if it is not `live`, a past."""
    with Lines(STDIO) as lines:
        session = begun.session
        world = session.timeline.first.world
        lines.write(f"{begun.title}: {census(world)}; seed {world.seed}, model {world.model}")
        for line in _living(session) if live else _past(session):
            lines.write(line)
            if lines.gone:
                break
    return DONE


def _living(session: Session) -> Iterator[str]:
    from fasteroids.tui.session import beat

    actions: list[tuple[int, Action]] = []
    narrator = Narrator(session.world, LONGEST)
    end = session.world.time + LONGEST
    while session.world.time < end and session.game.ended is None:
        before = session
        session = beat(session, min(_STEP, end - session.world.time), actions)
        narrator, lines = _news(narrator, before, session)
        yield from lines
    yield f"{narrator.time(session.world.time)}  {_closing(session)}"


def _past(session: Session) -> Iterator[str]:
    from fasteroids.tui.session import played

    narrator = Narrator(session.timeline.first.world, LONGEST)
    for state in session.timeline.forwards(session.timeline.first.place):
        if isinstance(state.what, Happened):
            if (line := narrator.line(state.what, state.world)) is not None:
                yield line
        elif state.born or state.died:
            narrator = Narrator(state.world, LONGEST)
    session = played(session)
    yield f"{narrator.time(session.world.time)}  {_closing(session)}"


def _news(narrator: Narrator, before: Session, session: Session) -> tuple[Narrator, list[str]]:
    """What happened since, and who tells from now on: the names of those that came in are new to the last one."""
    from fasteroids.tui.session import game_at

    lines = []
    wave = before.game.wave
    for state in session.timeline.forwards(before.timeline.last.place):
        if isinstance(state.what, Happened):
            if (line := narrator.line(state.what, state.world)) is not None:
                lines.append(line)
        elif state.born or state.died:
            narrator = Narrator(state.world, LONGEST)
            now = game_at(session, state.place).wave
            if now != wave:
                lines.append(f"{narrator.time(state.place.time)}  wave {now}")
            wave = now
    return narrator, lines


def _closing(session: Session) -> str:
    """How it stands at the end."""
    game = session.game
    points = ", ".join(f"{player.name} {player.points:,} points" for player in game.players)
    return "; ".join(filter(None, (game.ended or "it goes on", points, f"{census(session.world)} left")))  # fmt: skip
