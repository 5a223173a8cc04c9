"""What a session looks like: the look that the camera takes, and the lines around the arena. Pure.

A session and a `View`, how the player wants to see it, are all that decides a frame; but for what is to come, which
whoever draws it asks for now and then (see `fasteroids.tui.overlay`).
"""

from __future__ import annotations

from itertools import pairwise
from typing import Final

from attrs import evolve, frozen

from fasteroids.entities import Bullet
from fasteroids.history import Lived, Place, Timeline
from fasteroids.moments import between
from fasteroids.state import World, describe, located
from fasteroids.tui import palette
from fasteroids.tui.breakpoints import AtLine, When
from fasteroids.tui.camera import DEATH_LASTS, ZOOMS, Death, Look
from fasteroids.tui.canvas import SURFACES
from fasteroids.tui.chronicle import Chronicle
from fasteroids.tui.debugging import before_tick, breakpoints_of, flown, here
from fasteroids.tui.inspector import entity_rows
from fasteroids.tui.overlay import Line, Mark, Overlay, Point
from fasteroids.tui.program_pane import machine_of, print_rows, program_rows
from fasteroids.tui.rows import Row, Style, filled, paragraph, row
from fasteroids.tui.session import Session, ghost
from fasteroids.tui.strip import Strip, strip, whole
from fasteroids.tui.verdicts import death_rows, difference_rows

__all__ = [
    "LEAST",
    "PANELS_FROM",
    "View",
    "fate_of",
    "film",
    "look_of",
    "pane",
    "status",
    "told",
    "too_small",
    "zoomed",
]

LEAST: Final = (40, 12)
"""Columns and rows below which nothing but a line is shown."""

PANELS_FROM: Final = (60, 20)
"""Columns and rows from which on there are panels."""

_TRAIL: Final = 0.25
"""Seconds of a bullet's way that are seen behind it."""


@frozen
class View:
    """How a player wants to see a session."""

    arena: str = "ascii"
    overlay: bool = False
    ghosts: bool = True
    panels: bool = True
    zoom: int = 1

    def switched(self) -> View:
        """With the next arena."""
        names = list(SURFACES)
        return evolve(self, arena=names[(names.index(self.arena) + 1) % len(names)])


def zoomed(view: View) -> View:
    """Nearer, and after the nearest the whole world again."""
    return evolve(view, zoom=ZOOMS[(ZOOMS.index(view.zoom) + 1) % len(ZOOMS)])


def look_of(session: Session, view: View, overlay: Overlay | None = None) -> Look:
    """The look the camera takes."""
    world = session.world
    return Look(
        arena=view.arena,
        selected=session.selected,
        players=_players(session),
        trails=_trails(world),
        deaths=_deaths(session.timeline, session.place),
        overlay=fate_of(session) or overlay,
        ghosts=ghost(session) if view.ghosts else None,
        zoom=view.zoom,
    )


def _players(session: Session) -> tuple[int, ...]:
    """The ids of the players' ships, in their order. A player without a ship keeps the place of the last one."""
    found = []
    games = session.games[session.timeline.name]
    for i, player in enumerate(session.game.players):
        ids = (g.players[i].ship for _, g in reversed(games) if g.players[i].ship is not None)
        found.append(next(ids, None) if player.ship is None else player.ship)
    return tuple(i for i in found if i is not None)


def _trails(world: World) -> tuple[tuple[Point, ...], ...]:
    """Where each bullet was a moment ago, since it last changed its way."""
    trails = []
    for f in world.flights:
        if f is not None and isinstance(f.entity, Bullet):
            age = min(between(f.since, world.now), _TRAIL)
            b = located(f, world.now)
            trails.append(((b.x - b.vx * age, b.y - b.vy * age), (b.x, b.y)))
    return tuple(trails)


def _deaths(timeline: Timeline, place: Place) -> tuple[Death, ...]:
    """Who died a moment ago, where."""
    found: list[Death] = []
    for state, before in pairwise(_recent(timeline, place)):
        for i in state.died:
            if i in before.world:
                e = located(before.world.flight_of(i), state.world.now)
                age = between(state.world.now, place.moment)
                found.append(Death(e.x, e.y, e.radius, age))
    return tuple(found)


def _recent(timeline: Timeline, place: Place) -> list[Lived]:
    """The states of the last moments, the newest first, and the one before them."""
    found: list[Lived] = []
    for state in timeline.backwards(place):
        found.append(state)
        if between(state.place.moment, place.moment) > DEATH_LASTS:
            break
    return found


def fate_of(session: Session) -> Overlay | None:
    """The ways that led to the death that was asked about."""
    if session.fate is None:
        return None
    told = session.fate
    lines = tuple(Line(way.id, way.points) for way in told.paths)
    seconds = between(session.place.moment, told.death.place.moment)
    ids = tuple(way.id for way in told.paths)
    return Overlay(lines, (Mark(seconds, told.paths[0].points[-1], ids, None, True),), seconds)


# The lines around the arena, and the pane beside it.


def status(session: Session, width: int, *, ascii: bool, note: str = "") -> Row:
    """The line above the arena: the game on the left, time on the right."""
    game = session.game
    ship = "^" if ascii else "▲"
    parts = []
    if game.mode == "waves":
        parts.append(f"wave {game.wave}")
    for rank, p in enumerate(game.players):
        lives = (
            f" {ship * p.lives}" if game.mode == "waves" else "" if p.ship is not None else " dead"
        )
        parts.append(f"{palette.letter(rank)} {p.name}{lives} {p.points:,}")
    if game.ended is not None:
        parts.append(game.ended.upper())
    left = "   ".join(parts)
    right = "  ".join(filter(None, (note, _pace(session), f"{session.place.time:.2f} s")))
    room = max(width - len(right) - 1, 0)
    return row(width, (f"{left[:room]:<{room}} ", Style.TITLE), (right, Style.DIM))


def _pace(session: Session) -> str:
    """How time goes."""
    if session.live:
        word = "" if session.running else "paused"
    else:
        word = {1: "past >", 0: "past", -1: "past <"}[session.running]
    line = "" if session.timeline.line.parent is None else f"line {session.timeline.name}"
    speed = "" if session.speed == 1.0 else f"x {session.speed:g}"
    return "  ".join(filter(None, (line, word, speed)))


def film(session: Session, chronicle: Chronicle, width: int, *, ascii: bool) -> Strip:
    """The filmstrip of the whole past, with the cursor where one looks."""
    return strip(
        chronicle,
        session.timeline,
        whole(session.timeline),
        session.place.time,
        width,
        selected=session.selected,
        unicode=not ascii,
    )


def pane(session: Session, chronicle: Chronicle, width: int, height: int) -> tuple[Row, ...]:
    """The pane beside the arena: how somebody died, or how two lines differ, the selected entity, its program."""
    if session.fate is not None:
        return filled(death_rows(session.fate, width), width, height)
    difference = _difference(session, width, height // 3)
    rest = _facts(session, chronicle, width, height - len(difference))
    return (*difference, *rest)


def _difference(session: Session, width: int, most: int) -> tuple[Row, ...]:
    """How this line differs from the one it branched off, if that was asked; and an empty row."""
    compared = session.compared
    if compared is None or compared.new != session.timeline.name:
        return ()
    head = row(width, (f"lines {compared.old} and {compared.new}", Style.TITLE))
    names = (f"line {compared.old}", f"line {compared.new}")
    rows = [head, *difference_rows(compared.parted, width, most, names=names)]
    while rows and not rows[-1].text.strip():
        rows.pop()
    for note in compared.notes:
        rows += paragraph(width, note, Style.DIM)
    return filled(rows[: max(most - 1, 0)], width, min(len(rows) + 1, most))


def _facts(session: Session, chronicle: Chronicle, width: int, height: int) -> tuple[Row, ...]:
    """The selected entity, and the program of a ship, with what it printed before."""
    world, place = session.world, session.place
    ship = flown(session)
    program: tuple[Row, ...] = ()
    if ship is not None and (not session.running or session.selected == ship):
        room = height if session.selected in (None, ship) and session.point else height // 2
        marks = breakpoints_of(session, ship)
        point = None if session.running else here(session)
        before = place if point is None else before_tick(point)
        printed = tuple(print_rows(chronicle, before, ship, width, room // 6))
        program = program_rows(
            point or machine_of(world, ship),
            width,
            room - len(printed),
            name=describe(world[ship]),
            lines=[each.line for each in marks if isinstance(each, AtLine)],
            conditions=[each.condition.text for each in marks if isinstance(each, When)],
        )
        program = (*program, *printed)
    if session.selected is None:
        return filled(program or tuple(_hint(width)), width, height)
    left = height - len(program)
    if left < _LEAST_PANE:
        return filled(program, width, height)
    return (*entity_rows(chronicle, world, place, session.selected, width, left), *program)


_LEAST_PANE: Final = 6  # rows


def _hint(width: int) -> list[Row]:
    """What the pane says when there is nothing to tell of."""
    return [
        *paragraph(
            width,
            "Select somebody to see what they do, what is next, and what has been.",
            Style.DIM,
        ),
        row(width),
        *paragraph(
            width,
            "Any moment can be looked at again: go back, and take over from there.",
            Style.DIM,
        ),
        row(width),
        *paragraph(width, "? shows the keys.", Style.DIM),
    ]


def told(text: str, width: int) -> Row:
    """The line below the filmstrip."""
    return row(width, (text, Style.VALUE))


def too_small(columns: int, rows: int) -> str | None:
    """What to say of a terminal that is too small; None if it is not."""
    if columns >= LEAST[0] and rows >= LEAST[1]:
        return None
    return f"needs {LEAST[0]} x {LEAST[1]}, has {columns} x {rows}"
