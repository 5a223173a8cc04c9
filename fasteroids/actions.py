"""What a ship can be told, and the little a world knows of who tells it.

An action is a value. Players, programs and tests all hand one to `fasteroids.act`, or let a `Program` give one
at each tick (assignment 1.8). A world never looks inside a program: it holds any immutable value that keeps
the `Program` protocol, and shows it a `View`.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, Protocol, runtime_checkable

from attrs import frozen

__all__ = [
    "Action",
    "EntityState",
    "Fire",
    "Program",
    "Skip",
    "Thrust",
    "ThrustOff",
    "Ticked",
    "Turn",
    "View",
]


@frozen
class Turn:
    """Add `angle` (rad, counter-clockwise, finite) to the ship's direction."""

    angle: float


@frozen
class Fire:
    """Fire a bullet, if the rules allow one."""


@frozen
class Thrust:
    """Switch the thruster on."""


@frozen
class ThrustOff:
    """Switch the thruster off."""


@frozen
class Skip:
    """Do nothing."""


Action = Turn | Fire | Thrust | ThrustOff | Skip


class EntityState(Protocol):
    """What a program may read of an entity: km, km/s."""

    @property
    def id(self) -> int | None:
        """Its id."""

    @property
    def kind(self) -> Literal["ship", "asteroid", "bullet"]:
        """What it is."""

    @property
    def x(self) -> float:
        """km."""

    @property
    def y(self) -> float:
        """km."""

    @property
    def vx(self) -> float:
        """km/s."""

    @property
    def vy(self) -> float:
        """km/s."""

    @property
    def radius(self) -> float:
        """km."""


class View(Protocol):
    """The read-only world a program sees at its tick, from the ship that runs it."""

    @property
    def self_id(self) -> int:
        """The id of the ship that runs the program."""

    @property
    def direction(self) -> float:
        """Where that ship faces, rad in [0, 2 pi)."""

    @property
    def fuel(self) -> int:
        """How many small steps a program may take in this tick, 0 or more."""

    def ids(self, kind: Literal["ship", "asteroid", "bullet", "any"]) -> tuple[int, ...]:
        """The ids of all entities of a kind, ascending, the own ship included."""

    def entity(self, entity_id: int) -> EntityState | None:
        """An entity at this moment, or None if it is dead."""


class Ticked(NamedTuple):
    """What one tick of a program gave."""

    program: Program
    """The program as it waits for its next tick."""
    action: Action | None = None
    """The action to take now, if it reached one."""
    end: Literal["end", "halt", "fuel"] | None = None
    """Without an action: it ended, stopped on an illegal operation, or used up its fuel."""
    prints: tuple[str, ...] = ()
    span: Any = None
    """The piece of source text the tick stopped at, if the program has one."""
    reason: str | None = None
    """Why it halted."""


@runtime_checkable
class Program(Protocol):
    """A program as a world knows it: an immutable, hashable value that can be run for one tick.

    One that has an attribute `checked`, and it is not true, is refused by a ship: programs are type-correct at all
    times (assignment 1.8.3).
    """

    @property
    def running(self) -> bool:
        """Does it still have something to do? If not it has no more ticks."""

    def tick(self, view: View) -> Ticked:
        """Run until the next action, the end, an illegal operation, or no fuel. Never raises."""
