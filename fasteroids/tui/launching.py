"""What can be played, as values, and the session that each begins.

Where programs and scenes come from is not known here: a `Library` is asked, and answers with `ModelError` if it has
not got what it is asked for; its sentence is for the player.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from pathlib import Path, PurePath
from typing import Final, Literal, Protocol, TypeAlias

from attrs import evolve, frozen

from fasteroids.actions import Program
from fasteroids.history.recording import Recording, RecordingError, read
from fasteroids.history.recording.loading import timeline_of
from fasteroids.state import World, instructed
from fasteroids.tui.game import LIVES, Game, Player, new_game, ruled
from fasteroids.tui.keeping import GAME
from fasteroids.tui.session import Session, opened, reviewed
from fasteroids.units import ModelError

__all__ = [
    "FILE",
    "Launched",
    "Library",
    "NewGame",
    "Recorded",
    "SceneGame",
    "Wanted",
    "launched",
    "new_seed",
    "with_seed",
]

FILE: Final = "a file ..."
"""What is shown for a program, scene or recording that is none of those listed."""


class Library(Protocol):
    """What comes with the package, and files. All but the first two raise `ModelError` with a sentence, or a report."""

    def programs(self) -> Mapping[str, str]:
        """The programs that come with the package: by name, what is said of them."""

    def scenes(self) -> Mapping[str, str]:
        """The scenes that come with the package: by name, what is said of them."""

    def program(self, name: str) -> Program:
        """A program by its name, or of a file."""

    def scene(self, name: str, seed: int | None, model: str | None) -> tuple[str, World]:
        """What to call a scene, and its world. The seed and the model replace those of the scene."""


@frozen
class NewGame:
    """A game that no scene describes: for each ship the name of its program, None for a human."""

    mode: Literal["waves", "duel"]
    crew: tuple[str | None, ...]
    seed: int
    model: str = "smooth"


@frozen
class SceneGame:
    """A scene. Its first ships are flown by so many humans; `bots` are programs for the others, in order.

    With fewer bots than ships the last one is for all that are left; without any they have what the scene says. A
    `pilot` is a program that flies the ships of the humans, but for those that have one in the scene.
    """

    scene: str
    humans: int = 1
    bots: tuple[str, ...] = ()
    seed: int | None = None
    model: str | None = None
    pilot: str | None = None


@frozen
class Recorded:
    """A recording."""

    place: Path


Wanted: TypeAlias = NewGame | SceneGame | Recorded


@frozen
class Launched:
    """What was wanted, what to call it, and the session that begins."""

    wanted: Wanted
    title: str
    session: Session


def new_seed() -> int:
    """A seed that nobody chose, another one each time, short enough to be told to a friend."""
    return random.SystemRandom().randrange(1_000_000)


def with_seed(wanted: Wanted, seed: int) -> Wanted:
    """The same with another seed; a recording stays as it is."""
    return wanted if isinstance(wanted, Recorded) else evolve(wanted, seed=seed)


def launched(wanted: Wanted, library: Library) -> Launched:
    """What is wanted, begun. `ModelError` says why it cannot be had."""
    if isinstance(wanted, NewGame):
        return _new(wanted, library)
    if isinstance(wanted, SceneGame):
        return _scene(wanted, library)
    return _recorded(wanted, wanted.place)


def _new(wanted: NewGame, library: Library) -> Launched:
    programs = [None if name is None else library.program(name) for name in wanted.crew]
    names = _names(wanted.crew)
    game, world = new_game(
        wanted.mode, seed=wanted.seed, names=names, programs=programs, model=wanted.model
    )
    title = f"{wanted.mode}: {' against '.join(names)}"
    return Launched(wanted, title, _told(opened(world, game), wanted.seed))


def _names(crew: tuple[str | None, ...]) -> list[str]:
    """A name for each ship, all different."""
    human = ["you"] if crew.count(None) == 1 else ["one", "two"]
    names: list[str] = []
    for program in crew:
        name = human.pop(0) if program is None else PurePath(program).name.removesuffix(".ast")
        names.append(name if name not in names else f"{name} {len(names) + 1}")
    return names


def _told(session: Session, seed: int) -> Session:
    return evolve(session, said=f"seed {seed}")


def _scene(wanted: SceneGame, library: Library) -> Launched:
    title, world = library.scene(wanted.scene, wanted.seed, wanted.model)
    ships = [ship.id for ship in world.ships if ship.id is not None]
    humans = min(wanted.humans, len(ships))
    if wanted.humans > 1 and humans < wanted.humans:
        raise ModelError(f"{title}: two players need two ships; this scene has {len(ships)}")
    if wanted.bots and len(ships) <= humans:
        raise ModelError(f"{title}: there is no ship left for a program")
    if len(wanted.bots) > len(ships) - humans:
        raise ModelError(
            f"{title}: {len(wanted.bots)} programs are too many for {len(ships) - humans} ships"
        )
    for ship in world.ships[:humans]:
        assert ship.id is not None
        if wanted.pilot is None:
            world = instructed(world, ship.id, None)
        elif ship.program is None:
            world = instructed(world, ship.id, library.program(wanted.pilot))
    for number, drone in enumerate(ships[humans:] if wanted.bots else ()):
        bot = wanted.bots[min(number, len(wanted.bots) - 1)]
        world = instructed(world, drone, library.program(bot))
    session = opened(world, ruled(world, humans if wanted.pilot is None else 0))
    return Launched(wanted, title, _told(session, world.seed))


# Recordings.


def _recorded(wanted: Recorded, place: Path) -> Launched:
    try:
        data = place.read_bytes()
    except (OSError, ValueError) as error:  # the latter for a name that no file can have
        raise ModelError(
            f"cannot read {place}: {getattr(error, 'strerror', None) or error}"
        ) from None
    try:
        recording = read(data)
        timeline = timeline_of(recording)
    except RecordingError as error:
        raise ModelError(f"{place.name} cannot be read: {error}") from None
    world = timeline.first.world
    session = reviewed(timeline, game=_game(recording))
    said = recording.short or f"seed {world.seed}"
    return Launched(wanted, recording.header.title or place.name, evolve(session, said=said))


def _game(recording: Recording) -> Game:
    """The game that a recording begins with, as its header says; else the first ships without programs are humans'."""
    world = recording.world
    match recording.header.extra.get(GAME):
        case {"mode": "waves", "humans": 0 | 1} if len(world.ships) == 1:
            [ship] = world.ships
            human = ship.program is None
            player = Player(ship.name or "you", ship.id, human, LIVES, program=ship.program)
            return Game("waves", (player,), since=world.time)
        case {"humans": int(humans)}:
            return ruled(world, humans)
    free = [ship.program is None for ship in world.ships[:2]]
    return ruled(world, free.index(False) if False in free else len(free))
