"""What `smooth` promises of thrust: it is what `literal` tends to, it keeps the books, and it comes back on time."""

from __future__ import annotations

from math import cos, hypot, log, pi, sin

import attrs
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Ship, World, evolve, evolve_until, happenings
from fasteroids.testing import keeping, unfold, worlds
from tests.properties.laws import EVENTS, world_law

STEPS = (0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
angles = st.floats(0.0, 2.0 * pi)


def alone(ship: Ship, model: str) -> World:
    return World(1e6, 1e6, model=model).add(ship)


def burning(vx: float, vy: float, direction: float, **rest: float) -> Ship:
    return Ship(5e5, 5e5, vx, vy, 20, 5e15, direction, thruster=True, **rest)  # type: ignore[arg-type]


def slope(points: list[tuple[float, float]]) -> float:
    """The slope of the straight line of least squares through (log h, log error)."""
    logs = [(log(h), log(error)) for h, error in points]
    mx, my = (sum(column) / len(logs) for column in zip(*logs, strict=True))
    return float(sum((x - mx) * (y - my) for x, y in logs) / sum((x - mx) ** 2 for x, _ in logs))


def errors(ship: Ship, span: float) -> list[tuple[float, float]]:
    """How far `literal` is from `smooth` after `span` s, cut every h s, for each h."""
    end = evolve(alone(ship, "smooth"), span)[1]
    found = []
    for h in STEPS:
        world = alone(ship, "robust")
        for k in range(1, round(span / h) + 1):
            world = evolve_until(world, k * h)
        found.append((h, hypot(world[1].x - end.x, world[1].y - end.y)))
    return found


@pytest.mark.parametrize(
    "ship",
    [
        burning(0.0, 0.0, 0.0),
        burning(30.0, -40.0, 2.0),
        burning(0.0, 250.0, 0.3, max_speed=250.0),  # at its limit from the start
        burning(200.0, 0.0, 1.0, max_speed=250.0),  # reaches it on the way
        burning(0.0, 250.0, -1.0, max_speed=250.0),  # leaves it
    ],
)
def test_literal_converges_to_smooth_at_first_order(ship: Ship) -> None:
    assert slope(errors(ship, 1.0)) == pytest.approx(1.0, abs=0.1)


@world_law
@given(worlds(programs=True))
def test_without_a_thruster_on_the_two_rules_give_the_same_bits(world: World) -> None:
    with keeping("same_bits_without_thrust", world):
        literal = unfold(world, events=EVENTS)
        smooth = unfold(attrs.evolve(world, model="smooth"), events=EVENTS)
        assert literal.log == smooth.log
        assert literal.end.clock == smooth.end.clock
        assert literal.end.all_flights() == smooth.end.all_flights()


@given(st.floats(1.0, 300.0), st.sampled_from([0.0, 0.5 * pi, pi, 1.5 * pi]))
def test_a_ship_is_caught_by_its_own_thrust(speed: float, direction: float) -> None:
    """Thrown off a wall against its thrust it is back after 2 v / a, with its speed, again and again."""
    size, r = 1e4, 20.0
    c, s = round(cos(direction)), round(sin(direction))
    x, y = (0.5 * size + k * (0.5 * size - r) for k in (c, s))
    ship = Ship(x, y, -speed * c, -speed * s, r, 5e15, direction, thruster=True)
    world = World(size, size, model="smooth").add(ship)
    run = unfold(world, events=5)
    for k, (happened, after) in enumerate(zip(run.log, run.worlds, strict=True), 1):
        assert happened.kind == "wall"
        assert happened.time == pytest.approx(k * 2.0 * speed / 220.0, rel=1e-12)
        assert after[1].speed == pytest.approx(speed, rel=1e-11)


@given(st.floats(-300.0, 300.0), st.floats(-300.0, 300.0), angles, st.floats(0.01, 30.0))
def test_energy_gained_is_work_done(vx: float, vy: float, direction: float, span: float) -> None:
    ship = burning(vx, vy, direction)
    start, end = ship, evolve(alone(ship, "smooth"), span)[1]
    ax, ay = ship.acceleration
    work = ax * (end.x - start.x) + ay * (end.y - start.y)
    gained = 0.5 * (end.speed**2 - start.speed**2)
    scale = (
        end.speed**2 + start.speed**2 + (abs(ax) + abs(ay)) * 1e6
    )  # places are known to 1e-16 of 1e6 km
    assert abs(gained - work) <= 1e-12 * scale


@given(st.floats(0.0, 5.0), angles)
def test_the_limit_is_reached_once_and_held(speed: float, direction: float) -> None:
    ship = burning(speed, 0.0, direction, max_speed=250.0)
    log = [h for h, _ in happenings(alone(ship, "smooth"), 20.0)]
    assert [(h.kind, h.effect) for h in log] == [("limit", "reach")]
    after = evolve(alone(ship, "smooth"), 20.0)[1]
    assert 250.0 * (1 - 1e-14) <= after.speed <= 250.0


def test_leaving_the_limit_is_an_event() -> None:
    log = [
        h for h, _ in happenings(alone(burning(0.0, 250.0, -1.0, max_speed=250.0), "smooth"), 9.0)
    ]
    assert [(h.kind, h.effect) for h in log] == [("limit", "leave"), ("limit", "reach")]
    assert log[0].time == 0.0


def test_known_answers() -> None:
    ship = burning(0.0, 0.0, 0.0)
    assert evolve(alone(ship, "smooth"), 1.0)[1].x - 5e5 == pytest.approx(110.0, abs=1e-9)
    wide = World(1e9, 1e9, model="smooth").add(ship)
    (happened, after), *_ = happenings(wide, 2000.0)
    assert happened.kind == "limit"
    assert happened.time == pytest.approx(300_000.0 / 220.0, rel=1e-15)
    assert after[1].speed == 300_000.0
