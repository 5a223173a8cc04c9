"""Time for worlds that change: the one unfold of events, with a listener told on the eve of each collision."""

from __future__ import annotations

from typing import Any, Protocol

from fasteroids import rules
from fasteroids.entities import Ship
from fasteroids.events import Happened, unfold
from fasteroids.facade._handles import Handle, WorldHandle
from fasteroids.moments import Clock, advanced
from fasteroids.state import World, replaced
from fasteroids.units import ModelError, shown

__all__ = ["CollisionListener", "checked_listener", "pass_time"]


class CollisionListener(Protocol):
    """Told of each collision before it is resolved (the course's `CollisionListener`)."""

    def boundary_collision(self, entity: Any, x: float, y: float, /) -> object:
        """The entity of this handle is about to collide with a boundary, at (x, y) km."""

    def object_collision(self, first: Any, second: Any, x: float, y: float, /) -> object:
        """The entities of these handles are about to collide, at (x, y) km."""


def checked_listener(value: object) -> CollisionListener | None:
    """`value` if it is None or has both methods, else `ModelError`."""
    if value is not None and (
        isinstance(value, type)
        or not callable(getattr(value, "boundary_collision", None))
        or not callable(getattr(value, "object_collision", None))
    ):
        raise ModelError(
            "a listener must be an object with the methods boundary_collision(entity, x, y) and "
            f"object_collision(first, second, x, y), or None; got {shown(value)}"
        )
    return value  # type: ignore[return-value]


def pass_time(shell: WorldHandle, dt: float, listener: CollisionListener | None) -> None:
    """Move a world on by `dt` s. Where something raises, it stays as it was after the last event before."""
    until = advanced(shell.world.clock, dt)
    events = unfold(shell.world, until)
    while True:
        try:
            happened, after = next(events)
        except StopIteration as stop:
            shell.move_on(shell.world, stop.value)
            return
        eve = _eve(shell.world, after.clock)
        if listener is not None:
            with shell.seen_as(eve):
                _tell(shell, listener, happened)
        if shell.move_on(eve, after) is not after:
            events = unfold(shell.world, until)


def _eve(world: World, clock: Clock) -> World:
    """The world advanced to its next event, with nothing resolved: steps 1 and 2 of 1.6.

    Ships whose thruster is on are kicked, as at every cut under `literal`.
    """
    kicks = [
        (slot, rules.kick(f, clock[:2])[0])
        for slot, f in enumerate(world.flights)
        if f is not None and isinstance(f.entity, Ship) and f.entity.thruster
    ]
    return replaced(world, clock, kicks, (), ())


def _tell(shell: WorldHandle, listener: CollisionListener, happened: Happened) -> None:
    """Tell of one event, if it is a collision; the world is seen as on its eve."""
    if happened.kind == "wall":
        assert happened.at is not None
        listener.boundary_collision(shell.handle(happened.entities[0]), *happened.at)
    elif happened.kind == "contact":
        assert happened.at is not None
        first, second = map(shell.handle, happened.entities)
        listener.object_collision(first, second, *happened.at)
    elif happened.effect == "fire" and happened.died:
        bullet, occupant, at = _stillborn(shell, happened)
        listener.object_collision(bullet, occupant, *at)


def _stillborn(
    shell: WorldHandle, happened: Happened
) -> tuple[Handle[Any], Handle[Any], tuple[float, float]]:
    """A bullet fired by a program onto another entity, that entity, and where they touch.

    The bullet never enters the world (1.4: it "immediately collides"), so its handle is in none.
    """
    ship = shell.world[happened.entities[0]]
    assert isinstance(ship, Ship)
    bullet = rules.fired(ship, happened.born[0])
    (other_id,) = set(happened.died) - {bullet.id}
    other = shell.world[other_id]
    share = bullet.radius / (bullet.radius + other.radius)
    at = bullet.x + (other.x - bullet.x) * share, bullet.y + (other.y - bullet.y) * share
    return shell.shot(bullet), shell.handle(other_id), at
