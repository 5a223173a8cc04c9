"""The part of the facade that asks: what is what, and getters. Nothing here changes anything."""

from __future__ import annotations

from typing import Any, TypeVar

from fasteroids.entities import id_of
from fasteroids.facade._handles import (
    AsteroidHandle,
    BulletHandle,
    Handle,
    ShipHandle,
    WorldHandle,
)
from fasteroids.units import ModelError, shown

__all__ = ["Asking", "a"]

H = TypeVar("H", bound=Handle[Any] | WorldHandle)

_CALLED: dict[type, str] = {
    WorldHandle: "a world",
    ShipHandle: "a ship",
    AsteroidHandle: "an asteroid",
    BulletHandle: "a bullet",
}


def a(kind: type[H], value: object) -> H:
    """`value` if it is a handle of this kind, else `ModelError`."""
    if not isinstance(value, kind):
        raise ModelError(f"{_CALLED[kind]} made by a facade is needed; got {shown(value)}")
    return value


class Asking:
    """Questions about worlds and entities."""

    # Kinds.

    def is_ship(self, thing: object) -> bool:
        """Is it a ship? Of anything, without refusal."""
        return isinstance(thing, ShipHandle)

    def is_asteroid(self, thing: object) -> bool:
        """Is it an asteroid? Of anything, without refusal."""
        return isinstance(thing, AsteroidHandle)

    def is_bullets(self, thing: object) -> bool:
        """Is it a bullet? Of anything, without refusal. The plural is the course's."""
        return isinstance(thing, BulletHandle)

    # Worlds.

    def get_world_width(self, world: WorldHandle) -> float:
        """km."""
        return a(WorldHandle, world).world.width

    def get_world_height(self, world: WorldHandle) -> float:
        """km."""
        return a(WorldHandle, world).world.height

    def get_ships(self, world: WorldHandle) -> set[ShipHandle]:
        """The ships in a world, as a new set."""
        shell = a(WorldHandle, world)
        return {a(ShipHandle, shell.handle(id_of(e))) for e in shell.world.ships}

    def get_asteroids(self, world: WorldHandle) -> set[AsteroidHandle]:
        """The asteroids in a world, as a new set."""
        shell = a(WorldHandle, world)
        return {a(AsteroidHandle, shell.handle(id_of(e))) for e in shell.world.asteroids}

    def get_bullets(self, world: WorldHandle) -> set[BulletHandle]:
        """The bullets in a world, as a new set."""
        shell = a(WorldHandle, world)
        return {a(BulletHandle, shell.handle(id_of(e))) for e in shell.world.bullets}

    # Ships.

    def get_ship_x(self, ship: ShipHandle) -> float:
        """km."""
        return a(ShipHandle, ship).entity.x

    def get_ship_y(self, ship: ShipHandle) -> float:
        """km."""
        return a(ShipHandle, ship).entity.y

    def get_ship_x_velocity(self, ship: ShipHandle) -> float:
        """km/s."""
        return a(ShipHandle, ship).entity.vx

    def get_ship_y_velocity(self, ship: ShipHandle) -> float:
        """km/s."""
        return a(ShipHandle, ship).entity.vy

    def get_ship_radius(self, ship: ShipHandle) -> float:
        """km."""
        return a(ShipHandle, ship).entity.radius

    def get_ship_direction(self, ship: ShipHandle) -> float:
        """Rad, in [0, 2 pi)."""
        return a(ShipHandle, ship).entity.direction

    def get_ship_mass(self, ship: ShipHandle) -> float:
        """kg."""
        return a(ShipHandle, ship).entity.mass

    def get_ship_world(self, ship: ShipHandle) -> WorldHandle | None:
        """The world it is in; None before it is added and after it died or was removed."""
        return a(ShipHandle, ship).home

    def is_ship_thruster_active(self, ship: ShipHandle) -> bool:
        """Is its thruster on?"""
        return a(ShipHandle, ship).entity.thruster

    # Asteroids.

    def get_asteroid_x(self, asteroid: AsteroidHandle) -> float:
        """km."""
        return a(AsteroidHandle, asteroid).entity.x

    def get_asteroid_y(self, asteroid: AsteroidHandle) -> float:
        """km."""
        return a(AsteroidHandle, asteroid).entity.y

    def get_asteroid_x_velocity(self, asteroid: AsteroidHandle) -> float:
        """km/s."""
        return a(AsteroidHandle, asteroid).entity.vx

    def get_asteroid_y_velocity(self, asteroid: AsteroidHandle) -> float:
        """km/s."""
        return a(AsteroidHandle, asteroid).entity.vy

    def get_asteroid_radius(self, asteroid: AsteroidHandle) -> float:
        """km."""
        return a(AsteroidHandle, asteroid).entity.radius

    def get_asteroid_mass(self, asteroid: AsteroidHandle) -> float:
        """kg."""
        return a(AsteroidHandle, asteroid).entity.mass

    def get_asteroid_world(self, asteroid: AsteroidHandle) -> WorldHandle | None:
        """As `get_ship_world`."""
        return a(AsteroidHandle, asteroid).home

    # Bullets.

    def get_bullet_x(self, bullet: BulletHandle) -> float:
        """km."""
        return a(BulletHandle, bullet).entity.x

    def get_bullet_y(self, bullet: BulletHandle) -> float:
        """km."""
        return a(BulletHandle, bullet).entity.y

    def get_bullet_x_velocity(self, bullet: BulletHandle) -> float:
        """km/s."""
        return a(BulletHandle, bullet).entity.vx

    def get_bullet_y_velocity(self, bullet: BulletHandle) -> float:
        """km/s."""
        return a(BulletHandle, bullet).entity.vy

    def get_bullet_radius(self, bullet: BulletHandle) -> float:
        """km."""
        return a(BulletHandle, bullet).entity.radius

    def get_bullet_mass(self, bullet: BulletHandle) -> float:
        """kg."""
        return a(BulletHandle, bullet).entity.mass

    def get_bullet_world(self, bullet: BulletHandle) -> WorldHandle | None:
        """The world it is in; None after it died."""
        return a(BulletHandle, bullet).home

    def get_bullet_source(self, bullet: BulletHandle) -> ShipHandle:
        """The ship that fired it, dead or alive; never None (1.4)."""
        return a(BulletHandle, bullet).source
