"""The rules of a game beyond those of the world: waves of asteroids, lives, points, and who wins.

A game is a fold over what happens (`judged`), and what it wants of the world comes back as inputs at a time (`wishes`).
So it is a part of the past like everything else: a recording replays it, and a branch goes on with the points it had.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, inf, pi
from typing import Final, Literal, TypeAlias

from attrs import evolve, field, frozen

from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Bullet, Entity, Ship
from fasteroids.events import Happened
from fasteroids.history import Act, Add, Input, Lived, Told
from fasteroids.scene import Field, scattered
from fasteroids.state import World

__all__ = [
    "LIVES",
    "Game",
    "Mode",
    "Player",
    "Wish",
    "judged",
    "new_game",
    "points",
    "ruled",
    "wave",
    "wishes",
]

Mode: TypeAlias = Literal["waves", "duel", "free"]
"""waves: asteroids come in ever harder waves. duel: the last ship wins. free: a scene, as it is."""

LIVES: Final = 3
"""Ships a player of waves has."""

PAUSE: Final = 2.0
"""Seconds from a death to the next ship, and from the last asteroid of a wave to the next wave."""

WIDTH: Final = 1024.0
HEIGHT: Final = 768.0
"""The size of the world of a game that no scene describes, km: that of the course's own window."""

RADIUS: Final = 20.0
MASS: Final = 5e15
"""A ship of such a game, km and kg: 220 km/s^2."""


@frozen
class Player:
    """Who has a ship: a human, or a program. `ship` is its id; None while it has none."""

    name: str
    ship: int | None
    human: bool = True
    lives: int = 1
    points: int = 0
    died: float | None = None
    """When its last ship died, s."""
    program: Program | None = None
    """What flies its ships, None for a human."""


@frozen
class Game:
    """A game as it stands. `ended` says how it ended, None if it goes on; `cleared` when its wave was, s."""

    mode: Mode
    players: tuple[Player, ...]
    wave: int = 0
    cleared: float | None = None
    ended: str | None = None
    since: float = 0.0
    """When it ended or began, s."""


@frozen
class Wish:
    """Something the game wants to happen at a time (s): what, told the world of then."""

    time: float
    kind: Literal["wave", "ship"]
    player: int = field(default=0)


def new_game(
    mode: Mode, *, seed: int, names: Sequence[str], programs: Sequence[Program | None], model: str = "smooth"
) -> tuple[Game, World]:  # fmt: skip
    """A game that no scene describes, and its first world. One name and one program a player; no program: a human."""
    world = World(WIDTH, HEIGHT, seed, model)
    if mode == "waves":
        places = [(WIDTH / 2.0, HEIGHT / 2.0, pi / 2.0)]
    else:
        places = [(WIDTH / 5.0, HEIGHT / 2.0, 0.0), (4.0 * WIDTH / 5.0, HEIGHT / 2.0, pi)]
    players = []
    for name, program, (x, y, direction) in zip(names, programs, places, strict=True):
        ship = Ship(x, y, 0.0, 0.0, RADIUS, MASS, direction, program=program, name=name)
        lives = LIVES if mode == "waves" else 1
        players.append(Player(name, world.roster.next_id, program is None, lives, program=program))
        world = world.add(ship)
    if mode == "duel":
        world = world.add_all(wave(world, 1))
    return Game(mode, tuple(players)), world


def ruled(world: World, humans: int) -> Game:
    """The game of a scene: its first ships are flown by so many humans, the others by their programs or nobody.

    With two ships or more the last one wins; with fewer the scene goes on as it is.
    """
    ships = world.ships
    players = tuple(
        Player(ship.name or f"ship {ship.id}", ship.id, human=i < humans)
        for i, ship in enumerate(ships)
        if i < humans or ship.program is not None
    )
    return Game("duel" if len(players) > 1 else "free", players, since=world.time)


# What happens.


def judged(game: Game, before: World, state: Lived) -> Game:
    """The game after a state, told the world before it: points, deaths, the end."""
    if game.ended is not None:
        return game
    if isinstance(state.what, Told):
        game = _answered(game, state.what)
    if not state.died:
        return game
    time = state.place.time
    game = _scored(game, before, state)
    players = tuple(
        evolve(p, ship=None, died=time, lives=p.lives - 1) if p.ship in state.died else p
        for p in game.players
    )
    game = evolve(game, players=players)
    if game.mode == "waves" and game.cleared is None and not state.world.asteroids:
        game = evolve(game, cleared=time)
    return _ended(game, time)


def _answered(game: Game, told: Told) -> Game:
    """The game after one of its own wishes came true."""
    match told.what:
        case Add(Ship(name=name)):
            players = tuple(
                evolve(p, ship=told.born[0], died=None) if p.ship is None and p.name == name else p
                for p in game.players
            )
            return evolve(game, players=players)
        case Add(Asteroid()) if game.mode == "waves" and (
            game.cleared is not None or not game.wave
        ):
            return evolve(game, wave=game.wave + 1, cleared=None)
    return game


def _scored(game: Game, before: World, state: Lived) -> Game:
    """With the points for what a player's bullets destroyed."""
    dead = [before[i] for i in state.died if i in before]
    shooters = {e.source for e in dead if isinstance(e, Bullet)}
    if isinstance(state.what, Happened) and state.what.effect == "fire":
        shooters.add(state.what.entities[0])
    if isinstance(state.what, Told) and isinstance(state.what.what, Act):
        shooters.add(state.what.what.ship)
    players = tuple(
        evolve(p, points=p.points + sum(points(e) for e in dead if e.id != p.ship))
        if p.ship in shooters
        else p
        for p in game.players
    )
    return evolve(game, players=players)


def points(e: Entity) -> int:
    """What it is worth to shoot an entity: small asteroids are harder to hit, and another ship is the most."""
    if isinstance(e, Ship):
        return 200
    if isinstance(e, Asteroid):
        return 20 if e.radius >= 40.0 else 50 if e.radius >= 20.0 else 100
    return 0


def _won(name: str) -> str:
    return f"{name} win" if name == "you" else f"{name} wins"


def _ended(game: Game, time: float) -> Game:
    alive = [
        p for p in game.players if p.ship is not None or (game.mode == "waves" and p.lives > 0)
    ]
    if game.mode == "duel" and len(alive) < 2:
        return evolve(game, ended=_won(alive[0].name) if alive else "a draw", since=time)
    if game.mode != "duel" and game.players and not alive:
        return evolve(game, ended="game over", since=time)
    return game


# What the game wants.


def wishes(game: Game, world: World) -> Wish | None:
    """What the game wants next of the world, and when; None if nothing."""
    if game.mode != "waves" or game.ended is not None:
        return None
    wanted = [
        Wish(p.died + PAUSE, "ship", i)
        for i, p in enumerate(game.players)
        if p.ship is None and p.died is not None and p.lives > 0
    ]
    if game.wave == 0:
        wanted.append(Wish(world.time, "wave"))
    elif game.cleared is not None:
        wanted.append(Wish(game.cleared + PAUSE, "wave"))
    return min(wanted, key=lambda wish: wish.time, default=None)


def granted(game: Game, world: World, wish: Wish) -> list[Input]:
    """The inputs that make a wish come true now; none if there is no room yet."""
    if wish.kind == "wave":
        return [Add(asteroid) for asteroid in wave(world, game.wave + 1)]
    ship = _next_ship(game.players[wish.player], world)
    return [] if ship is None else [Add(ship)]


def wave(world: World, number: int) -> list[Asteroid]:
    """The asteroids of a wave, away from every ship: more of them each time, and faster."""
    count = min(3 + number, 12)
    speed = (15.0 + 5.0 * min(number, 12), 40.0 + 12.0 * min(number, 12))
    some = Field(number, count, (12.0, 55.0), speed, clear=120.0)
    listed = list(world.entities.values())
    return scattered(world.seed, world.width, world.height, [some], listed)[0]


def _next_ship(player: Player, world: World) -> Ship | None:
    """A new ship for a player, where most room is; None if there is none with room around."""
    columns, rows = 9, 7
    spots = [
        (world.width * (i + 0.5) / columns, world.height * (j + 0.5) / rows)
        for i in range(columns)
        for j in range(rows)
    ]
    middle = (world.width / 2.0, world.height / 2.0)
    others = list(world.entities.values())
    best = max([middle, *spots], key=lambda spot: min(_room(spot, others), 6.0 * RADIUS))
    if _room(best, others) < 2.0 * RADIUS:
        return None
    return Ship(*best, 0.0, 0.0, RADIUS, MASS, pi / 2.0, program=player.program, name=player.name)


def _room(spot: tuple[float, float], others: Sequence[Entity]) -> float:
    """The distance (km) from a point to the nearest rim."""
    return min((hypot(e.x - spot[0], e.y - spot[1]) - e.radius for e in others), default=inf)
