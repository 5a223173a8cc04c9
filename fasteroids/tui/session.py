"""What is on screen, as a value: a timeline, where in it one looks, and how time goes. No terminal is known here.

    session = opened(world, game)
    session = beat(session, 1 / 30, [(1, Fire())])       a frame of a live game
    session = scrub(session, "event", -1)                back to the last event: now one looks into the past
    session = take_over(session)                         and lives on from there, in another line

A session is *live* while one looks at the end of its line; time then lives on. Else one looks into the past, at `at`,
and time only moves the eye. Game time goes through `Timeline.evolve` alone, by as much as went by on the wall, so a
slow terminal shows fewer frames of the same game.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final, Literal, TypeAlias

from attrs import evolve, field, frozen
from pyrsistent import PMap, pmap

from fasteroids.actions import Action
from fasteroids.history import (
    BUDGET,
    MAIN,
    Lived,
    Parted,
    Place,
    Point,
    Timeline,
    begin,
    next_state,
    previous_state,
)
from fasteroids.history.marks import Kind
from fasteroids.history.questions import past_all_at
from fasteroids.moments import advanced
from fasteroids.state import World
from fasteroids.tui.breakpoints import Breakpoint
from fasteroids.tui.game import Game, granted, judged, ruled, wishes
from fasteroids.tui.verdicts import DeathTold, death_of, fate_of
from fasteroids.units import ModelError

__all__ = [
    "FRAME",
    "SPEEDS",
    "Compared",
    "Seek",
    "Session",
    "Unit",
    "beat",
    "bookmarked",
    "doomed",
    "faster",
    "game_at",
    "ghost",
    "jump",
    "lived_on",
    "look",
    "look_at",
    "opened",
    "other_line",
    "paused",
    "played",
    "resumed",
    "reviewed",
    "scrub",
    "select_next",
    "take_over",
]

Unit: TypeAlias = Literal["frame", "event", "tick", "second"]

FRAME: Final = 1.0 / 30.0
"""Seconds of a frame, where one scrubs by frames."""

SPEEDS: Final = (0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
"""How much game time may go by in a second on the wall."""

LONGEST: Final = 0.25
"""No beat is longer than this, s: after a stall the game goes on from where it was seen last."""

_Judged: TypeAlias = tuple[tuple[Place, Game], ...]


@frozen
class Seek:
    """A breakpoint of a ship is looked for, a piece at a time: on or back through what was lived, or by living on."""

    ship: int
    step: Literal[1, -1]
    living: bool = False


@frozen
class Compared:
    """Where the line `new` first does something else than `old` does; `notes` are sentences about how it came to be."""

    old: str
    new: str
    parted: Parted | None
    notes: tuple[str, ...] = ()


@frozen
class Session:
    """A timeline, the game played in it, and how it is looked at.

    `games` tells for each line how the game stood from which place on. `at` is where one looks, None at the end of the
    line. `running` is 1 if time goes on, -1 if the past is played backwards, else 0.
    """

    timeline: Timeline
    games: PMap[str, _Judged]
    at: Place | None = None
    running: int = 1
    speed: float = 1.0
    selected: int | None = None
    said: str = ""
    """One line for the player."""
    point: Point | None = None
    """Where the debugger stood last."""
    breakpoints: PMap[int, tuple[Breakpoint, ...]] = field(factory=pmap)
    """Those of each ship's program."""
    fate: DeathTold | None = None
    """The death that was asked about, while one looks at how it came."""
    seek: Seek | None = None
    """The search for a breakpoint that goes on."""
    compared: Compared | None = None
    """The difference that was asked about; it is of interest while one is in its new line."""

    @property
    def live(self) -> bool:
        """Is it the present that one sees?"""
        return self.at is None

    @property
    def place(self) -> Place:
        """Where one looks."""
        return self.timeline.last.place if self.at is None else self.at

    @property
    def world(self) -> World:
        """The world one sees."""
        return self.timeline.world if self.at is None else self.timeline.reached(self.at).world

    @property
    def game(self) -> Game:
        """The game as it stands where one looks."""
        return game_at(self, self.place)


def opened(world: World, game: Game, *, budget: int = BUDGET) -> Session:
    """A game that begins with a world."""
    timeline = begin(world, budget=budget)
    return Session(timeline, pmap({MAIN: ((timeline.last.place, game),)}))


def reviewed(timeline: Timeline, humans: int = 0, *, game: Game | None = None) -> Session:
    """A past that was lived elsewhere, looked at from its beginning; its games are judged anew.

    `game` is the one it began with; without it, that of a scene whose first ships so many humans fly.
    """
    first = timeline.first
    game = ruled(first.world, humans) if game is None else game
    session = Session(timeline, pmap({timeline.name: ((first.place, game),)}), first.place, 0)
    return _judged(session, first, timeline.forwards(first.place))


def game_at(session: Session, place: Place) -> Game:
    """The game as it stood at a place of the line."""
    found = session.games[session.timeline.name]
    return next((game for since, game in reversed(found) if since <= place), found[0][1])


# Time.


def beat(session: Session, elapsed: float, actions: Sequence[tuple[int, Action]] = ()) -> Session:
    """So much time (s) later on the wall. Ships take their actions first, if the game is live and goes on."""
    span = min(max(elapsed, 0.0), LONGEST) * session.speed
    if not session.running:
        return session
    if session.live:
        return lived_on(_acted(session, actions), span)
    return _moved(session, span * session.running)


def _acted(session: Session, actions: Sequence[tuple[int, Action]]) -> Session:
    for ship, action in actions:
        if ship in session.timeline.world:
            session = _grown(session, session.timeline.act(ship, action))
    return session


def lived_on(session: Session, span: float) -> Session:
    """The live game some seconds later, with what it wants of the world at the very times it wants it."""
    clock = advanced(session.timeline.world.clock, span)
    end = Place(*clock[:2]).time
    while (wish := wishes(session.game, session.timeline.world)) and wish.time <= end:
        now = session.timeline.world.time
        if wish.time > now:
            session = _grown(session, session.timeline.evolve_until(wish.time))
        inputs = granted(session.game, session.timeline.world, wish)
        if not inputs:  # no room yet
            break
        for what in inputs:
            session = _grown(session, session.timeline.take(what))
    left = max(end - session.timeline.world.time, 0.0)
    return _grown(session, session.timeline.evolve(span if left >= span else left))


def _grown(session: Session, timeline: Timeline) -> Session:
    """With a timeline whose line has grown."""
    before = session.timeline.last
    news = timeline.forwards(before.place)
    return _judged(evolve(session, timeline=timeline), before, news)


def _judged(session: Session, before: Lived, states: Iterable[Lived]) -> Session:
    """With the game judged by states that come after another."""
    name = session.timeline.name
    found = session.games[name]
    game = found[-1][1]
    world = before.world
    for state in states:
        after = judged(game, world, state)
        if after is not game:
            found, game = (*found, (state.place, after)), after
        world = state.world
    return evolve(session, games=session.games.set(name, found))


def _moved(session: Session, span: float) -> Session:
    """The past some seconds on or back; it stops at its ends."""
    first, last = session.timeline.first.world.time, session.timeline.world.time
    time = session.place.time + span
    if time >= last:
        return look(session, session.timeline.last.place)
    if time <= first:
        return look(session, session.timeline.first.place)
    return evolve(session, at=_after_all(session, time))


def _after_all(session: Session, time: float) -> Place:
    """The place after all that happened at a time."""
    return session.timeline.reached(past_all_at(time)).place


# Looking.


def look(session: Session, place: Place) -> Session:
    """One looks at a place of the past, and time stands still. `said` names where, if it is an end."""
    last = session.timeline.last.place
    place = min(max(place, session.timeline.first.place), last)
    fate = session.fate
    if fate is not None and not fate.inevitable <= place <= fate.death.place:
        fate = None
    said = "the end" if place == last else ""
    return evolve(session, at=place, running=0, said=said, fate=fate)


def look_at(session: Session, time: float) -> Session:
    """One looks at a time (s) of the past, after all that happened then, or at the nearest end."""
    first, last = session.timeline.first, session.timeline.last
    if not first.world.time < time < last.world.time:
        return look(session, (last if time >= last.world.time else first).place)
    return look(session, _after_all(session, time))


def paused(session: Session) -> Session:
    """Time stands still; if it did already, it goes on."""
    if session.running:
        return evolve(session, running=0, said="paused")
    return resumed(session)


def resumed(session: Session, direction: int = 1) -> Session:
    """Time goes on; in the past the film runs, forwards or backwards."""
    if session.live and direction < 0:
        session = look(session, session.place)
    at = session.at
    if direction > 0 and at is not None and at >= session.timeline.last.place:
        at = None
    return evolve(session, at=at, running=direction, said="")


def played(session: Session) -> Session:
    """Back to the end of the line, where the game goes on when it is resumed."""
    return evolve(session, at=None, running=0, said="now", fate=None)


def faster(session: Session, step: int) -> Session:
    """Time goes by faster, or slower, by so many of the `SPEEDS`."""
    near = min(range(len(SPEEDS)), key=lambda i: abs(SPEEDS[i] - session.speed))
    speed = SPEEDS[min(max(near + step, 0), len(SPEEDS) - 1)]
    return evolve(session, speed=speed, said=f"speed x {speed:g}")


def scrub(session: Session, unit: Unit, direction: int) -> Session:
    """One looks one frame, event, tick or second further on or back."""
    if unit in ("frame", "second"):
        span = FRAME if unit == "frame" else 1.0
        return look_at(session, session.place.time + span * direction)
    entity = session.selected if unit == "tick" and _flies(session) else None
    return jump(session, "tick" if unit == "tick" else "event", direction, entity=entity)


def _flies(session: Session) -> bool:
    """Does the selected ship run a program?"""
    world = session.world
    if session.selected is None or session.selected not in world:
        return False
    return getattr(world[session.selected], "program", None) is not None


def jump(session: Session, kind: Kind, direction: int, *, entity: int | None = None) -> Session:
    """One looks at the next or the previous state of a kind, about an entity if one is given."""
    find = next_state if direction > 0 else previous_state
    state = find(session.timeline, session.place, kind, entity)
    if state is None:
        which = "later" if direction > 0 else "earlier"
        who = "" if entity is None else f" of #{entity}"
        return evolve(look(session, session.place), said=f"no {which} {kind}{who}")
    return evolve(look(session, state.place), said=str(state.what))


def select_next(session: Session, step: int) -> Session:
    """The next entity, or the one before, in the order of ids; ships first."""
    world = session.world
    ids = [f.entity.id for f in world.all_flights().values()]
    kinds = {f.entity.id: f.entity.kind for f in world.all_flights().values()}
    ids.sort(key=lambda i: (kinds[i] != "ship", i))
    if not ids:
        return evolve(session, selected=None)
    here = (
        ids.index(session.selected) + step if session.selected in ids else (0 if step > 0 else -1)
    )
    chosen = ids[here % len(ids)]
    return evolve(session, selected=chosen, said=f"{kinds[chosen]} #{chosen}")


# Other futures.


def take_over(session: Session) -> Session:
    """Time lives on from where one looks, in another line; the old future stays."""
    if session.live:
        return resumed(session)
    place = session.place
    timeline = session.timeline.branch(place)
    return evolve(
        session,
        timeline=timeline,
        games=session.games.set(timeline.name, _games_up_to(session, place)),
        at=None,
        running=1,
        fate=None,
        said=f"line {timeline.name}, from {place.time:.2f} s",
    )


def _games_up_to(session: Session, place: Place) -> _Judged:
    """How the game stood in this line up to a place: what a line that branches off there begins with."""
    games = session.games[session.timeline.name]
    return tuple(each for each in games if each[0] <= place) or games[:1]


def other_line(session: Session, timeline: Timeline) -> Session:
    """Another line, branched off this one and lived already: one looks at the first that happened in it, in a pause."""
    start = timeline.line.first
    first = next(iter(timeline.forwards(start.place)), start)
    session = evolve(
        session,
        timeline=timeline,
        games=session.games.set(timeline.name, _games_up_to(session, start.place)),
        at=first.place,
        running=0,
        point=None,
        fate=None,
        seek=None,
    )
    return _judged(session, start, timeline.forwards(start.place))


def ghost(session: Session) -> World | None:
    """The world of the line this one branched off, at the time one sees; None if it has none or ended before."""
    parent = session.timeline.line.parent
    if parent is None or session.place < session.timeline.line.first.place:
        return None
    try:
        return session.timeline.switch(parent).at(session.world.time)
    except ModelError:
        return None


def bookmarked(session: Session, name: str | None = None) -> Session:
    """With a name for where one looks; without one it gets the first free number."""
    marks = session.timeline.bookmarks
    name = name or next(str(n) for n in range(1, len(marks) + 2) if str(n) not in marks)
    timeline = session.timeline.bookmark(name, session.place)
    return evolve(session, timeline=timeline, said=f"bookmark {name}")


def doomed(session: Session, ship: int) -> Session:
    """One looks at the moment a ship's fatal contact became inevitable, with the ways of both that touched."""
    try:
        fate = death_of(session.timeline, ship)
    except ModelError as error:
        return evolve(session, said=str(error))
    session = look(session, fate.inevitable)
    return evolve(session, selected=ship, fate=fate, said=fate_of(fate.death))
