"""Ships, asteroids and bullets: good input and bad."""

from __future__ import annotations

import copy
import pickle
import random
from collections.abc import Callable
from fractions import Fraction
from math import cos, inf, nan, pi, sin, sqrt, tau, ulp
from typing import Any

import pytest
from attrs import evolve
from attrs.exceptions import FrozenInstanceError

from fasteroids import Asteroid, Bullet, ModelError, Ship
from fasteroids.actions import Ticked
from fasteroids.entities import moving, wrapped
from fasteroids.physics import distance
from fasteroids.units import (
    ASTEROID_DENSITY,
    BULLET_DENSITY,
    MAX_ACCELERATION,
    SPEED_OF_LIGHT,
    THRUST,
)
from tests.unit.making import MAX, U

HUGE = 10**400
NO_NUMBERS: list[Any] = ["1", "", None, True, False, [], 1j, b"1", object]
NOT_FINITE: list[Any] = [nan, inf, -inf, HUGE, -HUGE, 10**5000, *NO_NUMBERS]


def kind_of(value: object) -> str:
    """A name for a parameter that may be too long to print."""
    return type(value).__name__ if isinstance(value, int) and abs(value) > 9 else repr(value)


def ship(**fields: Any) -> Ship:
    given: dict[str, Any] = {
        "x": 100.0, "y": 200.0, "vx": 3.0, "vy": -4.0, "radius": 10.0, "mass": 5e15, "direction": 0.5,
    }  # fmt: skip
    return Ship(**{**given, **fields})


def asteroid(**fields: Any) -> Asteroid:
    given: dict[str, Any] = {"x": 100.0, "y": 200.0, "vx": 3.0, "vy": -4.0, "radius": 10.0}
    return Asteroid(**{**given, **fields})


def bullet(**fields: Any) -> Bullet:
    given: dict[str, Any] = {
        "x": 100.0,
        "y": 200.0,
        "vx": 3.0,
        "vy": -4.0,
        "radius": 3.0,
        "source": 7,
    }
    return Bullet(**{**given, **fields})


def always(value: Any) -> Callable[[], Any]:
    return lambda: value


MAKERS = pytest.mark.parametrize("make", [ship, asteroid, bullet])


# What they say of themselves.


@MAKERS
def test_an_entity_says_where_it_is_and_how_it_moves(make: Callable[..., Any]) -> None:
    e = make(name="red", max_speed=100.0, id=9)
    assert e.position == (100.0, 200.0) == (e.x, e.y)
    assert e.velocity == (3.0, -4.0) == (e.vx, e.vy)
    assert e.speed == 5.0
    assert (e.name, e.max_speed, e.id) == ("red", 100.0, 9)


@MAKERS
def test_an_entity_by_default(make: Callable[..., Any]) -> None:
    e = make()
    assert (e.name, e.max_speed, e.id) == (None, SPEED_OF_LIGHT, None)


def test_a_ship_by_default() -> None:
    e = ship()
    assert (e.mass, e.direction) == (5e15, 0.5)
    assert (e.thruster, e.program, e.thrust_power) == (False, None, THRUST)


def test_a_bullet_by_default_has_not_bounced() -> None:
    assert bullet().bounced is False
    assert bullet(bounced=True).bounced is True


def test_fields_by_position() -> None:
    assert Ship(1, 2, 3, 4, 5, 6, 0.5) == ship(
        x=1, y=2, vx=3, vy=4, radius=5, mass=6, direction=0.5
    )
    assert Asteroid(1, 2, 3, 4, 5) == asteroid(x=1, y=2, vx=3, vy=4, radius=5)
    assert Bullet(1, 2, 3, 4, 5, 6) == bullet(x=1, y=2, vx=3, vy=4, radius=5, source=6)


def test_what_has_a_default_is_keyword_only() -> None:
    with pytest.raises(TypeError):
        Ship(1, 2, 3, 4, 5, 6, 0.5, True)  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        Asteroid(1, 2, 3, 4, 5, "name")  # type: ignore[call-arg]


@MAKERS
def test_numbers_become_floats(make: Callable[..., Any]) -> None:
    e = make(x=1, y=Fraction(1, 2), vx=2, vy=Fraction(3), radius=2, max_speed=9)
    numbers = (e.x, e.y, e.vx, e.vy, e.radius, e.max_speed)
    assert numbers == (1.0, 0.5, 2.0, 3.0, 2.0, 9.0)
    assert all(type(n) is float for n in numbers)
    assert all(
        type(n) is float for n in (ship(mass=3, direction=1).mass, ship(direction=1).direction)
    )


def test_the_masses_of_spheres() -> None:
    # Five roundings at most.
    for e, density in ((asteroid(radius=30.0), ASTEROID_DENSITY), (bullet(), BULLET_DENSITY)):
        exact = Fraction(4, 3) * Fraction(pi) * Fraction(e.radius) ** 3 * Fraction(density)
        assert abs(Fraction(e.mass) / exact - 1) <= Fraction(5, 2**53)


# What they refuse.


@MAKERS
@pytest.mark.parametrize("field", ["x", "y"])
@pytest.mark.parametrize("bad", NOT_FINITE, ids=kind_of)
def test_position_is_defensive(make: Callable[..., Any], field: str, bad: Any) -> None:
    with pytest.raises(ModelError, match=rf"^{field} must be a (finite )?number"):
        make(**{field: bad})


@MAKERS
@pytest.mark.parametrize("bad", [*NOT_FINITE, 0, 0.0, -0.0, -1.0], ids=kind_of)
def test_radius_is_defensive(make: Callable[..., Any], bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^radius must be a (finite )?number"):
        make(radius=bad)


@pytest.mark.parametrize("bad", [*NOT_FINITE, 0, 0.0, -1.0], ids=kind_of)
def test_mass_is_defensive(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^mass must be a (finite )?number"):
        ship(mass=bad)


@pytest.mark.parametrize("bad", NOT_FINITE, ids=kind_of)
def test_direction_that_is_no_angle_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^direction must be a (finite )?number"):
        ship(direction=bad)


@MAKERS
@pytest.mark.parametrize("bad", [*NOT_FINITE, -1.0, -5e-324, 300000.00000000006], ids=kind_of)
def test_max_speed_lies_between_nought_and_c(make: Callable[..., Any], bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^max_speed must"):
        make(max_speed=bad)


@pytest.mark.parametrize("bad", [*NOT_FINITE, -1.0], ids=kind_of)
def test_thrust_power_is_finite_and_not_negative(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^thrust_power must be a"):
        ship(thrust_power=bad)


@pytest.mark.parametrize("bad", [0, 1, "on", None, nan], ids=repr)
def test_thruster_is_on_or_off(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^thruster must be True or False; got"):
        ship(thruster=bad)


@pytest.mark.parametrize("bad", [0, 1, "yes", None], ids=repr)
def test_bounced_is_yes_or_no(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^bounced must be True or False; got"):
        bullet(bounced=bad)


@pytest.mark.parametrize("bad", ["skip;", 1, object(), print], ids=type)
def test_program_is_a_program(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^program must be a checked program or None; got"):
        ship(program=bad)


class Idle:
    """A program, but mutable; its class is none at all."""

    running = True

    def tick(self, _view: object) -> Ticked:
        return Ticked(self)


def test_the_class_of_a_program_is_no_program() -> None:
    assert ship(program=Idle()).program is not None
    with pytest.raises(ModelError, match=r"^program must be"):
        ship(program=Idle)


@MAKERS
@pytest.mark.parametrize("bad", ["", "two\nlines", "\x1b[0m", 3, b"red", True], ids=repr)
def test_name_is_printable_text(make: Callable[..., Any], bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^name must be printable text or None; got"):
        make(name=bad)


@MAKERS
@pytest.mark.parametrize("bad", [0, -1, 1.0, True, "1", nan], ids=repr)
def test_id_is_an_integer_from_one(make: Callable[..., Any], bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^id must be an integer from 1, or None; got"):
        make(id=bad)


@pytest.mark.parametrize("bad", [None, 0, -1, 1.0, True, "red", ship(), asteroid(id=3)], ids=type)
def test_a_source_is_a_ship_with_an_id(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^source must be the id of the ship"):
        bullet(source=bad)


def test_a_source_is_kept_as_its_id() -> None:
    assert bullet(source=ship(id=3)).source == 3
    assert bullet(source=3).source == 3


def test_an_error_says_what_was_given_and_what_is_allowed() -> None:
    with pytest.raises(ModelError) as caught:
        ship(radius=-2.5)
    assert str(caught.value) == "radius must be a finite number of km above 0; got -2.5"
    with pytest.raises(ModelError, match=r"between 0 and 300000 km/s; got 300001"):
        ship(max_speed=300001)


# Velocity is total.


@MAKERS
@pytest.mark.parametrize(
    ("vx", "vy", "after"),
    [
        (nan, 5.0, (0.0, 5.0)),
        (nan, nan, (0.0, 0.0)),
        (inf, 5.0, (SPEED_OF_LIGHT, 0.0)),
        (0.0, -inf, (0.0, -SPEED_OF_LIGHT)),
        (-HUGE, 0, (-SPEED_OF_LIGHT, 0.0)),
        (3e5, 4e5, (1.8e5, 2.4e5)),
        (3e305, -4e305, (1.8e5, -2.4e5)),
        (3e5, 0.0, (3e5, 0.0)),
    ],
    ids=kind_of,
)
def test_velocity_is_total(
    make: Callable[..., Any], vx: Any, vy: Any, after: tuple[float, float]
) -> None:
    assert make(vx=vx, vy=vy).velocity == after


@MAKERS
def test_speed_never_exceeds_the_limit_as_computed(make: Callable[..., Any]) -> None:
    rng = random.Random(3)
    for _ in range(300):
        limit = rng.choice((SPEED_OF_LIGHT, rng.uniform(0, 10), 0.0))
        e = make(vx=rng.uniform(-9e5, 9e5), vy=rng.uniform(-9e5, 9e5), max_speed=limit)
        assert e.speed <= limit
        assert sqrt(e.vx * e.vx + e.vy * e.vy) <= limit


@MAKERS
@pytest.mark.parametrize("bad", NO_NUMBERS, ids=kind_of)
def test_a_velocity_that_is_no_number_at_all_is_refused(make: Callable[..., Any], bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^vx must be a number; got"):
        make(vx=bad)


# Direction is nominal.


@pytest.mark.parametrize(
    ("angle", "after"),
    [
        (0.0, 0.0),
        (1.5, 1.5),
        (tau, 0.0),
        (-pi / 2, -pi / 2 + tau),
        (-1e-20, 0.0),
        (-5e-324, 0.0),
        (5 * tau + 1.0, (5 * tau + 1.0) % tau),
        (1e300, 1e300 % tau),
    ],
)
def test_direction_is_kept_within_a_turn(angle: float, after: float) -> None:
    assert ship(direction=angle).direction == after == wrapped(angle)
    assert 0.0 <= after < tau


def test_turn_gives_the_turned_ship_and_leaves_the_first() -> None:
    before = ship(direction=0.5)
    after = before.turn(1.0)
    assert (before.direction, after.direction) == (0.5, 1.5)
    assert after == evolve(before, direction=1.5)


@pytest.mark.parametrize(("angle", "after"), [(-1.0, 0.5 - 1.0 + tau), (tau, 0.5), (0, 0.5)])
def test_turn_wraps(angle: float, after: float) -> None:
    turned = ship(direction=0.5).turn(angle).direction
    assert 0.0 <= turned < tau
    assert abs(turned - after) <= ulp(tau)


@pytest.mark.parametrize("bad", NOT_FINITE, ids=kind_of)
def test_turn_by_no_angle_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"^angle must be a (finite )?number"):
        ship().turn(bad)


# Thrust.


def test_acceleration_is_power_over_mass_the_way_it_faces() -> None:
    e = ship(direction=0.5, thruster=True)
    a = THRUST / 5e15
    assert e.acceleration == (a * cos(0.5), a * sin(0.5))
    assert ship(direction=0.0, thruster=True, thrust_power=10.0, mass=4.0).acceleration == (
        2.5,
        0.0,
    )


def test_acceleration_with_the_thruster_off_or_powerless_is_nought() -> None:
    assert ship(thruster=False).acceleration == (0.0, 0.0)
    assert ship(thruster=True, thrust_power=0.0).acceleration == (0.0, 0.0)


@pytest.mark.parametrize("power", [1.0, THRUST, MAX])
def test_acceleration_of_a_feather_has_a_bound(power: float) -> None:
    feather = ship(mass=5e-324, direction=0.0, thruster=True, thrust_power=power)
    assert feather.acceleration == (MAX_ACCELERATION, 0.0)
    ax, ay = feather.turn(0.7).acceleration
    assert distance(ax, ay) == pytest.approx(MAX_ACCELERATION, rel=4 * float(U))


# Values.


@MAKERS
def test_an_entity_is_a_value(make: Callable[..., Any]) -> None:
    assert make() == make()
    assert hash(make()) == hash(make())
    assert make() != make(x=100.00000000000001)
    assert len({make(), make(), make(id=1)}) == 2
    assert asteroid() != bullet()  # type: ignore[comparison-overlap]


@MAKERS
def test_an_entity_is_frozen(make: Callable[..., Any]) -> None:
    e = make()
    with pytest.raises(FrozenInstanceError):
        e.x = 1.0
    with pytest.raises(FrozenInstanceError):
        del e.x
    with pytest.raises(AttributeError):
        e.colour = "red"


@MAKERS
@pytest.mark.parametrize("way", [copy.copy, copy.deepcopy, lambda e: pickle.loads(pickle.dumps(e))])
def test_copies_are_equal(make: Callable[..., Any], way: Callable[[Any], Any]) -> None:
    for e in (make(name="red", id=4), moving(make(id=4), 1.0, 2.0, 3.0, 4.0)):
        assert way(e) == e
        assert type(way(e)) is type(e)


@MAKERS
def test_evolve_checks_again(make: Callable[..., Any]) -> None:
    assert evolve(make(), vx=9e5, vy=0.0).vx == SPEED_OF_LIGHT
    with pytest.raises(ModelError, match="radius must"):
        evolve(make(), radius=-1.0)


@MAKERS
def test_moving_changes_place_and_velocity_only(make: Callable[..., Any]) -> None:
    e = make(name="red", id=5, max_speed=77.0)
    assert moving(e, 1.0, 2.0, 3.0, 4.0) == evolve(e, x=1.0, y=2.0, vx=3.0, vy=4.0)
    assert type(moving(e, 1.0, 2.0, 3.0, 4.0)) is type(e)


def test_moving_marks_a_bullet_that_bounced_for_ever() -> None:
    first = moving(bullet(), 1.0, 2.0, 3.0, 4.0, bounced=True)
    assert isinstance(first, Bullet)
    assert first.bounced is True
    second = moving(first, 1.0, 2.0, 3.0, 4.0)
    assert isinstance(second, Bullet)
    assert second.bounced is True
    assert moving(asteroid(), 1.0, 2.0, 3.0, 4.0, bounced=True) == asteroid(x=1, y=2, vx=3, vy=4)


def test_a_program_and_all_else_of_a_ship_survives_moving() -> None:
    e = ship(program=Idle(), thruster=True, thrust_power=3.0, name="red", id=2, max_speed=9.0)
    assert moving(e, e.x, e.y, e.vx, e.vy) == e
