"""The methods of the course's `IFacade` (part III), in its order."""

from __future__ import annotations

from random import Random

from attrs import evolve

from fasteroids.actions import Action, Fire, Thrust, ThrustOff, Turn
from fasteroids.entities import Asteroid, Ship, id_of
from fasteroids.events import act
from fasteroids.facade._asking import Asking, a
from fasteroids.facade._handles import AsteroidHandle, ShipHandle, WorldHandle
from fasteroids.facade._programs import Programs
from fasteroids.facade._time import CollisionListener, checked_listener, pass_time
from fasteroids.state import World
from fasteroids.units import ModelError, shown

__all__ = ["Facade"]


class Facade(Asking, Programs):
    """The course's facade. It has no state: all of it is in the handles, so one does, and so do several.

    Every method raises `ModelError` for a handle of the wrong kind and for any other argument of the wrong type;
    below, only what else is refused is said. What raises has changed nothing, but for `evolve`.
    """

    # Worlds.

    def create_world(self, width: float, height: float, *, seed: int = 0) -> WorldHandle:
        """A new world (km). `seed` decides the luck of asteroids without a generator.

        `ModelError` unless both lie in 0 to `units.MAX_WORLD_SIZE`.
        """
        return WorldHandle(World(width, height, seed))

    def add_ship(self, world: WorldHandle, ship: ShipHandle) -> None:
        """Put a ship into a world (1.1). Touching is fine.

        `ModelError` if it is in a world already, died in one, overlaps another entity, sticks out, or is too wide.
        """
        self._add(world, a(ShipHandle, ship))

    def add_asteroid(self, world: WorldHandle, asteroid: AsteroidHandle) -> None:
        """Put an asteroid into a world, with the refusals of `add_ship`."""
        self._add(world, a(AsteroidHandle, asteroid))

    def remove_ship(self, world: WorldHandle, ship: ShipHandle) -> None:
        """Take a ship out of a world. Its bullets fly on, and keep it as their source.

        It may be added again, here or elsewhere. Bullets it fired before can then hit it, and do not count among
        its three. `ModelError` if it is not in this world.
        """
        self._remove(world, a(ShipHandle, ship))

    def remove_asteroid(self, world: WorldHandle, asteroid: AsteroidHandle) -> None:
        """Take an asteroid out of a world. It does not die, so it leaves no children. Else as `remove_ship`."""
        self._remove(world, a(AsteroidHandle, asteroid))

    def _add(self, world: WorldHandle, handle: ShipHandle | AsteroidHandle) -> None:
        shell = a(WorldHandle, world)
        with shell.changing():
            shell.add(handle)

    def _remove(self, world: WorldHandle, handle: ShipHandle | AsteroidHandle) -> None:
        shell = a(WorldHandle, world)
        with shell.changing():
            shell.remove(handle)

    def evolve(
        self, world: WorldHandle, dt: float, listener: CollisionListener | None = None
    ) -> None:
        """Move a world on by `dt` s (1.6), and tell the listener, if any, of each collision before it is resolved.

        While it is told, everything is at the moment of the collision and where it happens, alive and with its old
        velocity; the point given is that of contact (km). It may read what it likes and change other worlds; what
        would change this one raises `ModelError`. A bullet fired onto another entity by a program is told too, with
        a handle in no world. Bounces are told as well as deaths.

        What the listener raises passes through. The world is then as it was after the last event before, and
        can be evolved again. `ModelError` if dt is nan, negative or infinite.
        """
        shell, told = a(WorldHandle, world), checked_listener(listener)
        with shell.changing():
            pass_time(shell, dt, told)

    # Making entities.

    def create_ship(
        self,
        x: float,
        y: float,
        vx: float,
        vy: float,
        radius: float,
        direction: float,
        mass: float,
    ) -> ShipHandle:
        """A ship in no world (km, km/s, km, rad, kg), its thruster off, without a program.

        `ModelError` if position or direction is not finite, or radius or mass not finite and above 0. Velocities
        are total (1.2): nan counts as 0, beyond the speed of light is scaled back.
        """
        return ShipHandle(Ship(x, y, vx, vy, radius, mass, direction))

    def create_asteroid(
        self,
        x: float,
        y: float,
        vx: float,
        vy: float,
        radius: float,
        generator: Random | None = None,
    ) -> AsteroidHandle:
        """An asteroid in no world (km, km/s, km); refusals as for a ship.

        When it dies and leaves children, the first flies the way of 2 pi times the next `generator.random()`, and the
        children have the generator in their turn. What the generator raises passes through, as from a listener.

        Without one the direction is a function of the world's seed and the asteroid's id. That is how worlds draw
        luck, and `WorldHandle.world` is then what the same calls give without a facade; with a generator it is not,
        since a generator is no value: an evolved `world` depends on what was drawn before.
        """
        if generator is not None and not isinstance(generator, Random):
            raise ModelError(f"a generator must be a random.Random or None; got {shown(generator)}")
        return AsteroidHandle(Asteroid(x, y, vx, vy, radius), generator)

    # What ships do.

    def set_thruster_active(self, ship: ShipHandle, active: bool) -> None:
        """Switch its thruster on or off."""
        handle = a(ShipHandle, ship)
        if not isinstance(active, bool):
            raise ModelError(f"a thruster is on or off, True or False; got {shown(active)}")
        if handle.home is None:
            handle.alter(evolve(handle.entity, thruster=active))
        else:
            self._act(handle, handle.home, Thrust() if active else ThrustOff())

    def turn(self, ship: ShipHandle, angle: float) -> None:
        """Add an angle (rad, counter-clockwise, perhaps negative) to its direction.

        `ModelError` if it is not finite: directions are nominal (1.2), and this is the refusal.
        """
        handle = a(ShipHandle, ship)
        if handle.home is None:
            handle.alter(handle.entity.turn(angle))
        else:
            self._act(handle, handle.home, Turn(angle))

    def fire_bullet(self, ship: ShipHandle) -> None:
        """Fire (1.4).

        No effect in no world, with three of its bullets about, or if the bullet would be partly outside. If its place
        is taken, the bullet and who is there die at once.
        """
        handle = a(ShipHandle, ship)
        if handle.home is not None:
            self._act(handle, handle.home, Fire())

    def _act(self, ship: ShipHandle, shell: WorldHandle, action: Action) -> None:
        with shell.changing():
            shell.move_on(shell.world, act(shell.world, id_of(ship.entity), action))
