"""A game: a field, a program for each of its ships, and how it ends.

A field with one ship is to be cleared: the game ends when no asteroid is left, or the ship dies. With two ships it is
one on one: the game ends when one dies. A game that lasts too long ends without a winner. A game is a function of the
world and the programs alone, so a seed opens it again.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal, TypeAlias

from attrs import frozen

from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Ship
from fasteroids.events import Happened, happenings
from fasteroids.lang import Span
from fasteroids.state import World, instructed
from fasteroids.units import ModelError

__all__ = ["LIMIT", "Ended", "Outcome", "crew", "flown", "play"]

LIMIT: Final = 120.0
"""A game ends without a winner after this time, s."""

Outcome: TypeAlias = Literal["cleared", "won", "lost", "drawn", "died", "timed out"]


@frozen
class Ended:
    """How a game ended for one of its ships.

    `outcome`: alone in its field it cleared it, died or timed out; one on one it won, lost, drew (both died at one
    time) or timed out. `time` of the end, s since the start. `fuel` counts the ticks at which its program ran out of
    it, and `stopped` is where and why that stopped at an illegal operation, None if it did not.
    """

    outcome: Outcome
    time: float
    fuel: int = 0
    stopped: str | None = None

    @property
    def good(self) -> bool:
        """Did it clear its field, or win?"""
        return self.outcome in ("cleared", "won")


def crew(world: World) -> tuple[int, ...]:
    """The ids of the ships that play, in order. `ModelError` unless the field has one or two."""
    ships = _ships(world)
    if len(ships) not in (1, 2):
        raise ModelError(
            f"a field has one ship, to clear it, or two, one against the other; this one has {len(ships)}"
        )
    return ships


def flown(world: World, programs: Sequence[Program]) -> World:
    """The world whose ships, in the order of their ids, run these programs from their next ticks on.

    `ModelError` unless there is one for each ship.
    """
    ships = _ships(world)
    if len(ships) != len(programs):
        raise ModelError(f"each ship needs a program: {len(ships)} in all; got {len(programs)}")
    for ship, program in zip(ships, programs, strict=True):
        world = instructed(world, ship, program)
    return world


def play(world: World, *, limit: float = LIMIT) -> tuple[Ended, ...]:
    """The game that starts from this world, whose ships have their programs: how it ends for each, in order.

    It lasts `limit` s at most. All that happens at the time of its end counts, so that no order of ids decides it.
    A ship without an asteroid around has cleared its field at once. `ModelError` unless the world has one or two
    ships, and if events pile up without end.
    """
    ships, start = crew(world), world.time
    fuel = dict.fromkeys(ships, 0)
    stopped: dict[int, str | None] = dict.fromkeys(ships)
    last, end = world, start if _decided(ships, world) else None
    for happened, after in happenings(world, start + limit):
        if end is not None and happened.time > end:
            break
        last = after
        if happened.effect == "fuel":
            fuel[happened.entities[0]] += 1
        elif happened.effect == "halt":
            stopped[happened.entities[0]] = _why(happened)
        elif happened.died and end is None and _decided(ships, after):
            end = happened.time
    outcomes = _decided(ships, last) or ["timed out"] * len(ships)
    time = limit if end is None else end - start
    return tuple(
        Ended(outcome, time, fuel[ship], stopped[ship])
        for ship, outcome in zip(ships, outcomes, strict=True)
    )


def _ships(world: World) -> tuple[int, ...]:
    """The ids of its ships, in order."""
    return tuple(i for i, f in world.all_flights().items() if isinstance(f.entity, Ship))


def _decided(ships: tuple[int, ...], world: World) -> Sequence[Outcome]:
    """What the deaths so far have decided, for each ship; nothing if the game goes on."""
    alive = [ship in world for ship in ships]
    if len(ships) == 1:
        if not alive[0]:
            return ("died",)
        return () if _asteroids(world) else ("cleared",)
    if all(alive):
        return ()
    return ["won" if a else "lost" for a in alive] if any(alive) else ("drawn", "drawn")


def _why(happened: Happened) -> str:
    """Where and why a program stopped."""
    where = f"line {happened.span.line}: " if isinstance(happened.span, Span) else ""
    return where + (happened.reason or "an illegal operation")


def _asteroids(world: World) -> bool:
    """Is there an asteroid left?"""
    return any(f is not None and isinstance(f.entity, Asteroid) for f in world.flights)
