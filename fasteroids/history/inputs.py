"""What the world outside does to a world: the only part of a past that no re-run can find out by itself.

An input is a value. A first world, its inputs and the places where they came give every later state again, with the
same bits (law L11); that is what a timeline thins its states by, and what a recording keeps.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple, TypeAlias

from attrs import frozen

from fasteroids.actions import Action, Program
from fasteroids.entities import Entity
from fasteroids.events import act
from fasteroids.moments import Clock, Moment, seconds
from fasteroids.state import World, instructed

__all__ = ["Act", "Add", "Cut", "Given", "Input", "Instruct", "Place", "Remove", "applied"]


class Place(NamedTuple):
    """A place in a past: right after the nth happening of a moment; an event and an input are a happening each.

    A moment can have many happenings, and a state between two of them is as good as any other. Places compare in the
    order in which they are lived. A cut is no happening, so a place does not depend on how often somebody looked.
    """

    window: int
    offset: float
    nth: int = 0
    """0 is the moment as time reaches it, before anything happens at it."""

    @classmethod
    def end_of(cls, moment: Moment) -> Place:
        """A place after all that happens at a moment. It is a bound to look by; no state stands there."""
        return cls(*moment, inf)  # type: ignore[arg-type]  # more than any number of happenings

    @property
    def moment(self) -> Moment:
        """The moment of it."""
        return self.window, self.offset

    @property
    def time(self) -> float:
        """Seconds since the start: the double nearest to the moment."""
        return seconds(self.window, self.offset)

    @property
    def before(self) -> Place:
        """The place right before the happening that led here; there is one, so `nth` is 1 or more."""
        return self._replace(nth=self.nth - 1)

    def after(self, moment: Moment) -> Place:
        """The place right after the next happening, which is at a moment not before this one."""
        return Place(*moment, self.nth + 1 if moment == self[:2] else 1)

    def reaching(self, moment: Moment) -> Place:
        """The place when time has come to a moment not before this one, and nothing happened since."""
        return self if moment == self[:2] else Place(*moment)


@frozen
class Act:
    """A ship takes an action, as `fasteroids.act` does."""

    ship: int
    action: Action


@frozen
class Instruct:
    """A ship gets another program, from its next tick on."""

    ship: int
    program: Program


@frozen
class Add:
    """An entity comes into the world. Without an id it gets the next one."""

    entity: Entity


@frozen
class Remove:
    """An entity is taken out of the world. Not a death."""

    entity: int


@frozen
class Cut:
    """The caller's advance ended here, at this clock. It decides something under literal thrust only (1.6)."""

    clock: Clock


Input: TypeAlias = Act | Instruct | Add | Remove | Cut


class Given(NamedTuple):
    """An input and the place it came at: after the happenings before it."""

    place: Place
    what: Input
    residue: float = 0.0
    """That of the clock as it came, s: what the caller's steps had left over (see `fasteroids.moments`)."""


def applied(world: World, what: Act | Instruct | Add | Remove) -> World:
    """The world after an input, now; `ModelError` if it makes no sense there."""
    match what:
        case Act(ship, action):
            return act(world, ship, action)
        case Instruct(ship, program):
            return instructed(world, ship, program)
        case Add(entity):
            return world.add(entity)
        case Remove(entity_id):
            return world.remove(entity_id)
