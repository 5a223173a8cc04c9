"""Ships, asteroids and bullets: frozen values with the assignment's guards (1.2, 1.3, 1.4).

The guards run when a user makes one: position and radius are defensive (they raise `ModelError`), velocity is
total (it never raises; nan counts as 0, what is too fast is scaled back keeping its direction), a ship's
direction is nominal (any finite angle, kept in [0, 2 pi)). The origin is the bottom left corner of a world, y
points up, angles run counter-clockwise.

``x, y, vx, vy`` of an entity taken from a world are those at the world's clock. ``id`` is None until a world
gives one; ``name`` is for people.
"""

from __future__ import annotations

from math import cos, inf, sin, sqrt, tau
from typing import Literal, TypeAlias, final

from attrs import evolve, field, frozen

from fasteroids._raw import raw
from fasteroids.actions import Program
from fasteroids.physics import limit_speed, sphere_mass
from fasteroids.units import (
    ASTEROID_DENSITY,
    BULLET_DENSITY,
    MAX_ACCELERATION,
    SPEED_OF_LIGHT,
    THRUST,
    ModelError,
    number,
    shown,
)

__all__ = ["Asteroid", "Bullet", "Entity", "Ship", "checked", "id_of", "moving", "wrapped"]


def _finite(value: object, what: str, unit: str) -> float:
    result = number(value, what)
    if not -inf < result < inf:
        raise ModelError(f"{what} must be a finite number of {unit}; got {shown(value)}")
    return result


def _positive(value: object, what: str, unit: str) -> float:
    result = number(value, what)
    if not 0.0 < result < inf:
        raise ModelError(f"{what} must be a finite number of {unit} above 0; got {shown(value)}")
    return result


def wrapped(angle: float) -> float:
    """A finite angle (rad) brought into [0, 2 pi)."""
    angle %= tau
    return angle if angle < tau else 0.0


class _Disc:
    """What the three kinds share: the guards of a moving disc, and what follows from its fields."""

    __slots__ = ()

    x: float
    y: float
    vx: float
    vy: float
    radius: float
    name: str | None
    max_speed: float
    id: int | None

    def __attrs_post_init__(self) -> None:
        """The guards; see the module's docstring."""
        limit = number(self.max_speed, "max_speed")
        if not 0.0 <= limit <= SPEED_OF_LIGHT:
            raise ModelError(
                f"max_speed must lie between 0 and {SPEED_OF_LIGHT:.0f} km/s; got {shown(self.max_speed)}"
            )
        vx, vy = limit_speed(number(self.vx, "vx"), number(self.vy, "vy"), limit)
        self._settle(
            x=_finite(self.x, "x", "km"),
            y=_finite(self.y, "y", "km"),
            radius=_positive(self.radius, "radius", "km"),
            max_speed=limit,
            vx=vx,
            vy=vy,
        )
        if self.name is not None and not (
            isinstance(self.name, str) and self.name.isprintable() and self.name
        ):
            raise ModelError(f"name must be printable text or None; got {shown(self.name)}")
        if self.id is not None and (type(self.id) is not int or self.id < 1):
            raise ModelError(f"id must be an integer from 1, or None; got {shown(self.id)}")

    def _settle(self, **values: float) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def position(self) -> tuple[float, float]:
        """(x, y), km."""
        return self.x, self.y

    @property
    def velocity(self) -> tuple[float, float]:
        """(vx, vy), km/s."""
        return self.vx, self.vy

    @property
    def speed(self) -> float:
        """sqrt(vx^2 + vy^2), km/s, never above `max_speed`."""
        return sqrt(self.vx * self.vx + self.vy * self.vy)


@final
@frozen(weakref_slot=False)
class Ship(_Disc):
    """A space craft: a disc with a mass, a direction and a thruster, perhaps flown by a program.

    In prose. A ship is at (x, y), moves at (vx, vy) and faces `direction`. Its speed never exceeds its
    `max_speed`, which is at most the speed of light: faster velocities are scaled back, and a velocity that is
    not a number counts as 0, so making a ship never fails for its velocity. It does fail for a position or
    radius that is not finite, a radius or mass that is not positive, and a direction that is not finite. When
    its thruster is on, a force of `thrust_power` pushes it the way it faces. By default a ship has no program.

    Formally.

    Requires: x, y finite km; radius, mass finite and > 0 (km, kg); direction finite rad;
        0 <= max_speed <= c (km/s); thrust_power finite and >= 0 (kg km/s^2); program None or a `Program`.
    Returns: a ship with these fields; direction in [0, 2 pi) equal to the given one modulo 2 pi; velocity the
        given one if its speed fits, else scaled to `max_speed`.
    Raises: `ModelError` where a requirement is broken.
    Invariant: sqrt(vx*vx + vy*vy) <= max_speed, as computed (tests/properties/test_speed.py).
    Invariant: 0 <= direction < 2 pi (tests/unit/test_entities.py).
    Invariant: radius and mass never change (tests/properties/test_rules.py).
    """

    x: float
    y: float
    vx: float
    vy: float
    radius: float
    mass: float
    direction: float
    thruster: bool = field(default=False, kw_only=True)
    program: Program | None = field(default=None, kw_only=True)
    name: str | None = field(default=None, kw_only=True)
    max_speed: float = field(default=SPEED_OF_LIGHT, kw_only=True)
    thrust_power: float = field(default=THRUST, kw_only=True)
    id: int | None = field(default=None, kw_only=True)

    def __attrs_post_init__(self) -> None:
        """The guards; see the class."""
        super().__attrs_post_init__()
        power = number(self.thrust_power, "thrust_power")
        if not 0.0 <= power < inf:
            raise ModelError(
                f"thrust_power must be a finite number of kg km/s^2, 0 or more; got {shown(self.thrust_power)}"
            )
        self._settle(
            mass=_positive(self.mass, "mass", "kg"),
            direction=wrapped(_finite(self.direction, "direction", "rad")),
            thrust_power=power,
        )
        if not isinstance(self.thruster, bool):
            raise ModelError(f"thruster must be True or False; got {shown(self.thruster)}")
        if self.program is not None and (
            isinstance(self.program, type)
            or not isinstance(self.program, Program)
            or not getattr(self.program, "checked", True)
        ):
            raise ModelError(
                f"program must be a checked program or None; got {shown(self.program)}"
            )

    @property
    def kind(self) -> Literal["ship"]:
        """What it is."""
        return "ship"

    def turn(self, angle: float) -> Ship:
        """The ship turned by `angle` rad, counter-clockwise (1.2). The angle must be finite."""
        return evolve(self, direction=self.direction + _finite(angle, "angle", "rad"))

    @property
    def acceleration(self) -> tuple[float, float]:
        """(ax, ay) in km/s^2: thrust_power / mass the way it faces (1.2), or (0, 0) with the thruster off.

        Never more than `units.MAX_ACCELERATION`, be the mass as small as it may.
        """
        if not self.thruster:
            return 0.0, 0.0
        a = min(self.thrust_power / self.mass, MAX_ACCELERATION)
        return a * cos(self.direction), a * sin(self.direction)


@final
@frozen(weakref_slot=False)
class Asteroid(_Disc):
    """A rock of density 2.65e12 kg/km^3 (1.3).

    Requires: x, y finite km; radius finite and > 0 km; 0 <= max_speed <= c (km/s).
    Returns: an asteroid with these fields; velocity the given one if its speed fits, else scaled back.
    Raises: `ModelError` where a requirement is broken.
    Invariant: sqrt(vx*vx + vy*vy) <= max_speed, as computed (tests/properties/test_speed.py).
    """

    x: float
    y: float
    vx: float
    vy: float
    radius: float
    name: str | None = field(default=None, kw_only=True)
    max_speed: float = field(default=SPEED_OF_LIGHT, kw_only=True)
    id: int | None = field(default=None, kw_only=True)

    @property
    def kind(self) -> Literal["asteroid"]:
        """What it is."""
        return "asteroid"

    @property
    def mass(self) -> float:
        """4/3 pi r^3 rho, kg; inf above 2.5e98 km, 0 below 6.1e-113 km."""
        return sphere_mass(self.radius, ASTEROID_DENSITY)

    @property
    def density(self) -> float:
        """kg/km^3."""
        return ASTEROID_DENSITY


@final
@frozen(weakref_slot=False)
class Bullet(_Disc):
    """A bullet of density 7.8e12 kg/km^3, fired by the ship `source` (1.4).

    Requires: as for `Asteroid`; `source` the id of a ship, or a `Ship` that has one; never None.
    Returns: a bullet with these fields; `source` is an id and stays so when the ship dies.
    Raises: `ModelError` where a requirement is broken.
    Invariant: sqrt(vx*vx + vy*vy) <= max_speed, as computed (tests/properties/test_speed.py).
    Invariant: `bounced` is True from the first wall on, and a second wall is its death
        (tests/properties/test_rules.py).
    """

    x: float
    y: float
    vx: float
    vy: float
    radius: float
    source: int
    bounced: bool = field(default=False, kw_only=True)
    name: str | None = field(default=None, kw_only=True)
    max_speed: float = field(default=SPEED_OF_LIGHT, kw_only=True)
    id: int | None = field(default=None, kw_only=True)

    def __attrs_post_init__(self) -> None:
        """The guards; see the class."""
        super().__attrs_post_init__()
        source = self.source.id if isinstance(self.source, Ship) else self.source
        if type(source) is not int or source < 1:
            raise ModelError(
                "source must be the id of the ship that fired the bullet, or that ship as its world knows it;"
                f" got {shown(self.source)}"
            )
        object.__setattr__(self, "source", source)
        if not isinstance(self.bounced, bool):
            raise ModelError(f"bounced must be True or False; got {shown(self.bounced)}")

    @property
    def kind(self) -> Literal["bullet"]:
        """What it is."""
        return "bullet"

    @property
    def mass(self) -> float:
        """4/3 pi r^3 rho, kg; inf or 0 at extreme radii, as for an asteroid."""
        return sphere_mass(self.radius, BULLET_DENSITY)

    @property
    def density(self) -> float:
        """kg/km^3."""
        return BULLET_DENSITY


Entity: TypeAlias = Ship | Asteroid | Bullet

_ship = raw(Ship)
_asteroid = raw(Asteroid)
_bullet = raw(Bullet)


def moving(e: Entity, x: float, y: float, vx: float, vy: float, *, bounced: bool = False) -> Entity:
    """The entity at another position and velocity (km, km/s), which the caller knows to be valid.

    `bounced` marks a bullet that just met its first wall, and means nothing for the others.
    """
    if isinstance(e, Asteroid):
        return _asteroid(x, y, vx, vy, e.radius, e.name, e.max_speed, e.id)
    if isinstance(e, Ship):
        return _ship(
            x, y, vx, vy, e.radius, e.mass, e.direction,
            e.thruster, e.program, e.name, e.max_speed, e.thrust_power, e.id,
        )  # fmt: skip
    return _bullet(
        x, y, vx, vy, e.radius, e.source, e.bounced or bounced, e.name, e.max_speed, e.id
    )


def checked(value: object, what: str) -> Entity:
    """`value` if it is a ship, an asteroid or a bullet, else `ModelError` naming `what`."""
    if type(value) not in (Ship, Asteroid, Bullet):
        raise ModelError(f"{what} must be a ship, an asteroid or a bullet; got {shown(value)}")
    return value  # type: ignore[return-value]


def id_of(e: Entity) -> int:
    """The id of an entity that is in a world."""
    assert e.id is not None
    return e.id
