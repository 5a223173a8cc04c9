"""Ships that press on each other: how a bounce lifts them, and what they do together."""

from __future__ import annotations

from math import acos, atan2, cos, hypot, inf, pi, sin, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Ship, World, evolve_until, happenings
from fasteroids.audit import audit
from fasteroids.pressing import LEAST_HOP, Mover, lift, normal_acceleration
from fasteroids.testing import unfold
from tests.unit.making import U

HEIGHT = 1e-4


def mover(vx: float, ax: float, mass: float = 1.0, limit: float = inf, vy: float = 0.0) -> Mover:
    return Mover(vx, vy, ax, 0.0, mass, limit)


def rate(i: tuple[float, float, bool], j: tuple[float, float, bool]) -> float:
    """D' of j, to the right of i."""
    return j[0] - i[0]


# When two press on each other.


def test_the_normal_acceleration_of_a_circle_is_the_centrifugal_one() -> None:
    d2, error = normal_acceleration(4.0, 0.0, 1.0, 6.0, (0.0, 0.0), (0.0, 0.0))
    assert d2 == 9.0
    assert 0.0 < error < 1e-13


def test_the_normal_acceleration_is_what_the_thrusts_make_of_the_gap() -> None:
    assert normal_acceleration(3.0, 4.0, 0.0, 0.0, (3.0, 4.0), (0.0, 0.0))[0] == -5.0
    assert normal_acceleration(0.0, 0.0, 1.0, 1.0, (3.0, 4.0), (0.0, 0.0)) == (0.0, 0.0)


@pytest.mark.parametrize("pull", [1.0, 0.0])
def test_what_does_not_press_is_left_alone(pull: float) -> None:
    i, j = mover(0.0, -pull), mover(1e-9, pull, vy=2.0)
    assert lift(2.0, 0.0, i, j, HEIGHT) == ((0.0, 0.0, False), (1e-9, 2.0, False), False)


def test_what_hops_high_is_left_alone() -> None:
    i, j = mover(-1.0, 2.0), mover(1.0, 0.0)
    assert lift(2.0, 0.0, i, j, HEIGHT) == ((-1.0, 0.0, False), (1.0, 0.0, False), False)


def test_the_hop_has_the_height_asked_for() -> None:
    i, j, pressing = lift(2.0, 0.0, mover(0.0, 220.0), mover(0.0, 0.0, mass=3.0), HEIGHT)
    assert pressing
    assert rate(i, j) ** 2 / (2.0 * 220.0) == pytest.approx(HEIGHT, rel=1e-12)
    assert i[0] == pytest.approx(-3.0 * j[0], rel=1e-15)  # momentum: the lighter one gives way
    assert not i[2]
    assert not j[2]


def test_a_hop_counts_as_pressing_up_to_four_times_the_height() -> None:
    least = sqrt(2.0 * 220.0 * HEIGHT)
    for factor, pressing in ((1.1, True), (1.9, True), (2.1, False)):
        pair = lift(2.0, 0.0, mover(0.0, 220.0), mover(factor * least, 0.0), HEIGHT)
        assert pair == ((0.0, 0.0, False), (factor * least, 0.0, False), pressing)


def test_at_its_limit_the_front_one_cannot_and_the_rear_one_gives_way() -> None:
    i, j, _ = lift(2.0, 0.0, mover(10.0, 5.0, limit=10.0), mover(10.0, 0.0, limit=10.0), HEIGHT)
    assert j[0] == 10.0
    assert rate(i, j) ** 2 / (2.0 * 5.0) == pytest.approx(HEIGHT, rel=1e-12)


def test_side_by_side_at_the_limit_the_speed_is_shortened_across() -> None:
    i = Mover(0.0, 10.0, 5.0, 0.0, 1.0, 10.0)
    j = Mover(0.0, 10.0, -5.0, 0.0, 1.0, 10.0)
    a, b, _ = lift(2.0, 0.0, i, j, HEIGHT)
    assert a[2]
    assert b[2]
    for vx, vy, _ in (a, b):
        assert sqrt(vx * vx + vy * vy) <= 10.0
        assert 9.9 < vy < 10.0
    assert rate(a, b) ** 2 / (2.0 * 10.0) == pytest.approx(HEIGHT, rel=1e-12)


speeds = st.one_of(  # a speed whose square underflows has no limit that fits it as computed
    st.just(0.0), st.floats(-100.0, 100.0).map(lambda v: v if abs(v) > 1e-100 else 0.0)
)
pulls = st.one_of(st.just(0.0), st.floats(-300.0, 300.0))
movers = st.builds(
    lambda vx, vy, ax, ay, mass, spare: Mover(
        vx, vy, ax, ay, mass, sqrt(vx * vx + vy * vy) * (1.0 + spare)
    ),
    speeds, speeds, pulls, pulls, st.floats(1e-9, 1e9), st.sampled_from([0.0, 1e-3, 1.0]),
)  # fmt: skip
angles = st.floats(0.0, 2.0 * pi)


@given(movers, movers, angles)
def test_lifting_keeps_limits_and_momentum_and_the_order_of_the_pair(
    i: Mover, j: Mover, angle: float
) -> None:
    x, y = 40.0 * cos(angle), 40.0 * sin(angle)
    a, b, pressing = lift(x, y, i, j, HEIGHT)
    assert lift(-x, -y, j, i, HEIGHT) == (b, a, pressing)
    for e, (vx, vy, _) in ((i, a), (j, b)):
        assert sqrt(vx * vx + vy * vy) <= e.limit
    before = ((j.vx - i.vx) * x + (j.vy - i.vy) * y) / 40.0
    after = ((b[0] - a[0]) * x + (b[1] - a[1]) * y) / 40.0
    speed = sum(hypot(*v) for v in ((i.vx, i.vy), (j.vx, j.vy), a[:2], b[:2]))
    assert after >= before - 16 * U * speed
    if pressing and not (a[2] or b[2]):
        assert after > 32 * U * (hypot(i.vx, i.vy) + hypot(j.vx, j.vy))
        heavy = i.mass * (hypot(i.vx, i.vy) + hypot(*a[:2])) + j.mass * (
            hypot(j.vx, j.vy) + hypot(*b[:2])
        )
        for axis in (0, 1):
            gained = i.mass * (a[axis] - i[axis]) + j.mass * (b[axis] - j[axis])
            assert abs(gained) <= 16 * U * heavy


# What they do together.


def nose_to_nose(**rest: float) -> World:
    ships = [
        Ship(480, 500, 0, 0, 20, 5e15, 0.0, thruster=True, **rest),  # type: ignore[arg-type]
        Ship(520, 500, 0, 0, 20, 5e15, pi, thruster=True, **rest),  # type: ignore[arg-type]
    ]
    return World(1000, 1000, model="smooth").add_all(ships)


def test_two_that_push_alike_stay_where_they_are() -> None:
    """The smallest scene of two that press on each other: it used to end in a storm of events at one moment."""
    run = unfold(nose_to_nose(), until=1.0, events=5000)
    assert run.end.time == 1.0
    assert {h.effect for h in run.log} == {"press"}
    least = sqrt(2.0 * 440.0 * 40.0 * LEAST_HOP)
    assert len(run.log) == pytest.approx(440.0 / (2.0 * least), rel=0.01)
    a, b = run.end.ships
    assert a.x == pytest.approx(480.0, abs=1e-4)
    assert b.x == pytest.approx(520.0, abs=1e-4)
    assert a.x + b.x == pytest.approx(1000.0, abs=1e-9)


def test_the_contact_does_not_sink_in() -> None:
    report = audit(nose_to_nose(), 4.0, max_events=4000)
    assert report.total == 4000
    assert report.ok


def test_pushed_at_the_limit() -> None:
    """Two at their limit, the rear one pushing: the front one slows and is pushed on, hop by hop."""
    ships = [
        Ship(100, 500, 100, 0, 20, 5e16, 0.0, thruster=True, max_speed=100.0),
        Ship(140, 500, 100, 0, 20, 5e15, pi, thruster=True, max_speed=100.0, thrust_power=1e17),
    ]
    world = World(1000, 1000, model="smooth").add_all(ships)
    report = audit(world, 2.0, max_events=20_000)
    assert report.ok
    assert report.time == 2.0
    a, b = evolve_until(world, 2.0).ships
    assert a.speed == pytest.approx(100.0, rel=0.01)
    assert b.x - a.x == pytest.approx(40.0, abs=1e-3)


@pytest.mark.parametrize("start", [0.05, 0.3, 0.6])
def test_a_ship_slides_off_a_heavy_one_as_off_a_sphere(start: float) -> None:
    """Without friction a body leaves a sphere where cos(angle) is 2/3 of its cosine at the start."""
    away = 40.0
    ball = Ship(1000, 1000, 0, 0, 30, 1e25, 0.0)
    x, y = 1000 + away * sin(start), 1000 + away * cos(start)
    ship = Ship(x, y, 0, 0, 10, 5e15, 1.5 * pi, thruster=True)
    world = World(2000, 2000, model="smooth").add_all([ball, ship])
    for happened, after in happenings(world, 20.0):
        if happened.kind != "contact":
            break
        last = after
    ball, ship = last.ships
    angle = atan2(ship.x - ball.x, ship.y - ball.y)
    assert angle == pytest.approx(acos(2.0 / 3.0 * cos(start)), abs=0.03)
    assert ship.speed == pytest.approx(
        sqrt(2.0 * 220.0 * away * (cos(start) - cos(angle))), rel=1e-3
    )
