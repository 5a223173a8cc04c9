"""Hypothesis strategies for entities and worlds, valid by construction.

Discs are laid into the cells of a rectangular lattice, so nothing is filtered and everything shrinks to few
discs, simple numbers and rest. A `flavour` says what makes a world hard:

``ordinary``  any radius, any place;      ``dense``   discs that nearly fill their cells;
``thin``      small discs, far apart;     ``touching``  every neighbour and wall touched at the start;
``corners``   diagonal flights that reach two walls at once;
``twins``     a world and its mirror image, so that events come in pairs at one moment;
``squeeze``   head-on in one row, with masses far apart;
``extreme``   lengths from 1e-150 to 1e150 km, masses from 1e-290 to 1e290 kg, speeds to the limit, and
              thrusters from 1e-308 to 1e307 kg km/s^2.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin, tau
from typing import Any, NamedTuple

from attrs import evolve
from hypothesis import strategies as st

from fasteroids.actions import Action, Fire, Program, Skip, Thrust, ThrustOff, Turn
from fasteroids.entities import Asteroid, Bullet, Entity, Ship
from fasteroids.lang import Machine, check_program, syntax
from fasteroids.state import World
from fasteroids.testing.programs import programs as written
from fasteroids.testing.scripts import Script
from fasteroids.units import FUEL, SPEED_OF_LIGHT, THRUST

__all__ = ["FLAVOURS", "actions", "discs", "formations", "machines", "pairs", "scripts", "worlds"]

FLAVOURS = ("ordinary", "dense", "thin", "touching", "corners", "twins", "squeeze", "extreme")

_CELL = 64.0  # km, before scaling
_FILL = {"dense": (0.8, 1.0), "thin": (1 / 64, 0.1), "touching": (1.0, 1.0)}

_unit = st.floats(0.0, 1.0)
_signed = st.floats(-1.0, 1.0)
_dyadic = st.integers(-8, 8).map(lambda n: n / 8)
_angles = st.one_of(st.integers(0, 7).map(lambda n: n * tau / 8), st.floats(0.0, tau))


def actions(*, thrust: bool = True) -> st.SearchStrategy[Action]:
    """Any action; without the two of the thruster if `thrust` is False."""
    some: list[st.SearchStrategy[Any]] = [
        st.just(Skip()),
        st.just(Fire()),
        st.builds(Turn, _angles),
    ]
    if thrust:
        some += [st.just(Thrust()), st.just(ThrustOff())]
    return st.one_of(some)


def scripts(*, thrust: bool = True) -> st.SearchStrategy[Script]:
    """Programs of up to eight actions, some of them ticks out of fuel."""
    steps = st.one_of(actions(thrust=thrust), st.none())
    return st.builds(Script, st.lists(steps, min_size=1, max_size=8).map(tuple))


def machines(*, thrust: bool = True) -> st.SearchStrategy[Machine]:
    """Type-correct programs of the ship language, ready to run; without thrust if `thrust` is False."""
    return written(thrust=thrust).map(_ready)


def _ready(tree: syntax.Program) -> Machine:
    machine = check_program(tree).program
    assert machine is not None
    return machine


class _Scale(NamedTuple):
    """Factors for lengths (km) and speeds (km/s), the exponents of ships' masses and, if not usual, thrusts."""

    length: float
    speed: float
    masses: tuple[int, int]
    thrusts: tuple[int, int] | None


def _thrusts(exponents: tuple[int, int] | None) -> st.SearchStrategy[float]:
    """The usual thrust, or in extreme worlds also any other."""
    if exponents is None:
        return st.just(THRUST)
    return st.one_of(st.just(THRUST), st.integers(*exponents).map(lambda e: 10.0**e))


def _scales(flavour: str) -> st.SearchStrategy[_Scale]:
    if flavour == "extreme":
        return st.builds(
            _Scale,
            st.integers(-498, 490).map(lambda e: 2.0**e),
            st.one_of(st.just(SPEED_OF_LIGHT), st.integers(-30, 5).map(lambda e: 10.0**e)),
            st.just((-290, 290)),
            st.just((-308, 307)),
        )
    speeds = st.sampled_from([64.0, 1.0, 1024.0, SPEED_OF_LIGHT])
    lengths = st.sampled_from([1.0, 0.3, 17.0])
    wide = flavour == "squeeze"
    return st.builds(_Scale, lengths, speeds, st.just((-8, 8) if wide else (14, 16)), st.none())


@st.composite
def worlds(
    draw: st.DrawFn,
    *,
    flavours: Sequence[str] = FLAVOURS,
    min_size: int = 0,
    max_size: int = 30,
    kinds: Sequence[type[Entity]] = (Ship, Asteroid, Bullet),
    thrusters: bool = False,
    programs: bool = False,
    model: str = "robust",
) -> World:
    """A valid world of `min_size` to `max_size` entities at time 0.

    `kinds` are the kinds of entities to draw from; `thrusters` lets ships start with theirs on, `programs` lets
    ships run a `Script`, or one of two programs of the language (with thrust only if `thrusters`).
    """
    flavour = draw(st.sampled_from(list(flavours)))
    scale = draw(_scales(flavour))
    count = draw(st.integers(min_size, max_size))
    half = count // 2 if flavour == "twins" else count
    columns = half if flavour == "squeeze" else draw(st.integers(1, max(half, 1)))
    rows = -(-half // max(columns, 1))
    pad = 1 if min(columns, rows) <= 1 else draw(st.integers(0, 1))
    pilots: st.SearchStrategy[Program | None] = st.none()
    if programs:
        pilots |= scripts(thrust=thrusters)
        fleet = draw(st.lists(machines(thrust=thrusters), max_size=2))
        pilots |= st.sampled_from(fleet) if fleet else st.none()
    fuel = draw(st.sampled_from([30, 300])) if programs else FUEL
    entities = [
        draw(_entity(flavour, scale, kinds, i, columns, thrusters, pilots)) for i in range(half)
    ]
    width = (max(columns, 1) + pad) * _CELL * scale.length
    height = (max(rows, 1) + pad) * _CELL * scale.length
    if flavour == "twins":
        entities += [_mirrored(e, 2.0 * width) for e in entities]
        width *= 2.0
    world = World(width, height, draw(st.integers(0, 9)), model, fuel=fuel)
    return world.add_all(_with_sources(entities))


@st.composite
def _entity(
    draw: st.DrawFn, flavour: str, scale: _Scale, kinds: Sequence[type[Entity]], index: int,
    columns: int, thrusters: bool, pilots: st.SearchStrategy[Program | None],
) -> Entity:  # fmt: skip
    """An entity in the cell `index` of the lattice; a bullet's source is for `_with_sources` to settle."""
    low, high = _FILL.get(flavour, (1 / 8, 0.9))
    numbers, places = (
        (_dyadic, st.just(0.5)) if flavour in ("corners", "twins") else (_signed, _unit)
    )
    fill = draw(st.just(low) if low == high else st.floats(low, high))
    radius = 0.5 * _CELL * fill
    room = _CELL - 2.0 * radius
    column, row = index % columns, index // columns
    across, up = draw(places), draw(places)
    if flavour == "squeeze":
        across, up = 0.5, 0.5
    x = column * _CELL + radius + across * room
    y = row * _CELL + radius + up * room
    u, v = draw(numbers), draw(numbers)
    if flavour == "corners":
        v = u if draw(st.booleans()) else -u
    if flavour == "squeeze":
        v = 0.0
    length, speed, _, _ = scale
    moving = (x * length, y * length, u * speed, v * speed, radius * length)
    limit = draw(
        st.sampled_from([SPEED_OF_LIGHT, SPEED_OF_LIGHT, min(1.5 * speed, SPEED_OF_LIGHT)])
    )
    kind = draw(st.sampled_from(list(kinds)))
    if kind is Asteroid:
        return Asteroid(*moving, max_speed=limit)
    if kind is Bullet:
        return Bullet(*moving, 1, bounced=draw(st.booleans()), max_speed=limit)
    mass = draw(st.floats(1.0, 9.0)) * 10.0 ** draw(st.integers(*scale.masses))
    return Ship(
        *moving,
        mass,
        draw(_angles),
        thruster=thrusters and draw(st.booleans()),
        program=draw(pilots),
        max_speed=limit,
        thrust_power=draw(_thrusts(scale.thrusts)),
    )


def _mirrored(e: Entity, width: float) -> Entity:
    """The mirror image at the vertical line through the middle of a world."""
    image = evolve(e, x=width - e.x, vx=-e.vx)
    return evolve(image, direction=tau / 2 - image.direction) if isinstance(image, Ship) else image


def _with_sources(entities: list[Entity]) -> list[Entity]:
    """Bullets get the ships for sources, three each at the most, then ships long dead."""
    ships = [i for i, e in enumerate(entities, 1) if isinstance(e, Ship) for _ in range(3)]
    dead = len(entities) + 1000
    return [
        evolve(e, source=ships.pop() if ships else dead + i) if isinstance(e, Bullet) else e
        for i, e in enumerate(entities)
    ]


@st.composite
def discs(draw: st.DrawFn, kind: type[Entity] = Ship) -> Entity:
    """One entity anywhere, with any finite numbers its constructor takes."""
    numbers = st.floats(allow_nan=False, allow_infinity=False)
    positive = st.floats(min_value=0.0, exclude_min=True, allow_infinity=False)
    x, y, vx, vy, r = *(draw(numbers) for _ in range(4)), draw(positive)
    limit = draw(st.one_of(st.just(SPEED_OF_LIGHT), st.floats(0.0, SPEED_OF_LIGHT)))
    if kind is Asteroid:
        return Asteroid(x, y, vx, vy, r, max_speed=limit)
    if kind is Bullet:
        return Bullet(x, y, vx, vy, r, draw(st.integers(1, 9)), max_speed=limit)
    return Ship(x, y, vx, vy, r, draw(positive), draw(_angles), max_speed=limit)


@st.composite
def pairs(draw: st.DrawFn) -> tuple[float, ...]:
    """The ten numbers of a contact time (x, y, vx, vy, radius of i, then of j), hostile ones among them.

    Any doubles, or a pair aimed at a hit, a graze or a near miss and moved by a few ulps, at any scale.
    """
    if draw(st.booleans()):
        number = st.floats(allow_nan=False, allow_infinity=False)
        positive = st.floats(min_value=0.0, exclude_min=True, allow_infinity=False)
        i = [draw(number) for _ in range(4)] + [draw(positive)]
        j = [draw(number) for _ in range(4)] + [draw(positive)]
        return tuple(i + j)
    length = 2.0 ** draw(st.integers(-500, 400))
    speed = 2.0 ** draw(st.integers(-500, 17))
    ri, rj = (draw(st.floats(1 / 1024, 1.0)) for _ in range(2))
    far = draw(st.floats(1.0, 16.0)) * 2.0 ** draw(st.integers(0, 40))
    graze = draw(st.sampled_from([0.0, 1.0, -1.0])) * (
        1.0 + draw(st.sampled_from([0.0, 1.0, -1.0])) * 2.0 ** draw(st.integers(-60, -1))
    )
    offset = (ri + rj) * (graze if draw(st.booleans()) else draw(_signed))
    turn = draw(st.integers(0, 3))
    x, y, vx, vy = far, offset, -1.0, 0.0
    for _ in range(turn):
        x, y, vx, vy = -y, x, -vy, vx
    px, py, pvx, pvy = (draw(_signed) for _ in range(4))
    return (
        px * length, py * length, pvx * speed, pvy * speed, ri * length,
        (px + x) * length, (py + y) * length, (pvx + vx) * speed, (pvy + vy) * speed, rj * length,
    )  # fmt: skip


@st.composite
def formations(draw: st.DrawFn, *, max_size: int = 4, model: str = "smooth") -> World:
    """Two to `max_size` ships in a row, side by side, that fly and thrust nearly alike, or press on each other.

    They touch or nearly do, at rest, below their speed limit or at it. What each of them does by itself is much more
    than what they do to each other, so contacts are slow, grazing, or held by the thrust.
    """
    aim, row = draw(_angles), draw(_angles)
    limit = draw(st.sampled_from([250.0, 50.0, SPEED_OF_LIGHT]))
    speed = draw(st.sampled_from([0.0, min(limit, 100.0), min(limit, 250.0)]))
    spread = draw(st.sampled_from([0.0, 1e-9, 1e-6, 1e-3, 0.5]))
    turn = draw(st.one_of(st.just(row), _angles))
    entities: list[Ship] = []
    x = y = 1e4
    for _ in range(draw(st.integers(2, max_size))):
        radius = draw(st.sampled_from([20.0, 16.0]))
        if entities:
            away = (entities[-1].radius + radius) * (
                1.0 + draw(st.sampled_from([2.0**-52, 1e-9, 1e-4]))
            )
            x, y = x + away * cos(row), y + away * sin(row)
        here = aim + spread * draw(_signed)
        entities.append(
            Ship(
                x,
                y,
                speed * cos(here),
                speed * sin(here),
                radius,
                draw(st.sampled_from([5e15, 5e15, 1e16, 1e18]))
                * (1.0 + 0.5 * spread * draw(_signed)),
                turn + spread * draw(_signed) + draw(st.sampled_from([0.0, 0.0, pi])),
                thruster=draw(st.integers(0, 3)) > 0,
                max_speed=limit,
            )
        )
    return World(2e4, 2e4, draw(st.integers(0, 9)), model).add_all(entities)
