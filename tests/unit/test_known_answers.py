"""Runs whose outcome is known from elsewhere: theorems, kinetic theory, the text, arithmetic by hand."""

from __future__ import annotations

import random
from collections.abc import Iterator
from math import floor, pi, sqrt

import pytest

from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    Happened,
    Ship,
    Thrust,
    World,
    act,
    evolve,
    evolve_until,
    happenings,
    time_to_contact,
    time_to_wall,
)


def log(world: World, until: float) -> list[Happened]:
    return [happened for happened, _ in happenings(world, until)]


# A light ship between a wall and a heavy one counts the digits of pi (Galperin 2003).


def digits_of_pi(k: int, model: str) -> int:
    """Collisions of a light ship with a heavy one, 100^k times its mass, and with the wall behind it."""
    light, gap, radius = 1.0, 10.0, 1.0
    ratio = 100.0**k
    width = 20 * gap
    world = World(width, 10, model=model).add_all(
        [
            Ship(gap + radius, 5, 0, 0, radius, light, 0),
            Ship(gap + 4 * radius, 5, -1, 0, radius, light * ratio, 0),
        ]
    )
    count = 0
    for happened, after in happenings(world, 1e6):
        if happened.kind == "contact" or (happened.entities, happened.wall) == ((1,), "left"):
            assert happened.clipped == ()
            count += 1
        elif happened.entities == (2,):
            # The heavy one has left for good, and the light one is slower: the count is complete.
            assert happened.wall == "right"
            return count
        else:
            # Equal masses: the heavy one is left at rest, the light one has gone to the far wall.
            assert (k, after[2].vx) == (0, 0.0)
            return count
    raise AssertionError("the heavy ship never left")


@pytest.mark.parametrize("model", ["robust", "spec"])
@pytest.mark.parametrize("k", range(5))
def test_a_squeezed_ship_counts_the_digits_of_pi(k: int, model: str) -> None:
    assert digits_of_pi(k, model) == floor(pi * 10**k)


# A gas of hard discs (Enskog).


def gas(count: int, fraction: float, seed: int) -> World:
    """Discs of diameter 1 at rest as a whole; each component of velocity has unit root mean square."""
    rng = random.Random(seed)
    size = sqrt(count * pi / 4 / fraction)
    side = floor(sqrt(count - 1)) + 1
    pitch = size / side
    room = 0.45 * (pitch - 1.0)
    vx, vy = (scaled([rng.gauss(0, 1) for _ in range(count)]) for _ in range(2))
    return World(size, size).add_all(
        Asteroid(
            (i % side + 0.5) * pitch + rng.uniform(-room, room),
            (i // side + 0.5) * pitch + rng.uniform(-room, room),
            vx[i],
            vy[i],
            0.5,
        )
        for i in range(count)
    )


def scaled(values: list[float]) -> list[float]:
    """The values less their mean, times what makes their mean square 1."""
    mean = sum(values) / len(values)
    spread = sqrt(sum((v - mean) ** 2 for v in values) / len(values))
    return [(v - mean) / spread for v in values]


def test_a_gas_of_discs_collides_at_the_rate_of_enskog() -> None:
    count, fraction = 1000, 0.2
    density = fraction * 4 / pi
    contact_value = (1 - 7 * fraction / 16) / (1 - fraction) ** 2
    expected = (
        2 * sqrt(pi) * density * contact_value
    )  # contacts per disc and second, unit rms component
    warm, events = 10_000, 40_000
    start, contacts, end = 0.0, 0, 0.0
    for n, (happened, _) in enumerate(
        happenings(gas(count, fraction, 12345), 1e6, max_events=warm + events)
    ):
        if n < warm:
            start = happened.time
        else:
            contacts += happened.kind == "contact"
            end = happened.time
    # 37,000 contacts: the count itself scatters by 0.5 %, and each is one of two discs.
    assert contacts > 35_000
    assert 2 * contacts / count / (end - start) == pytest.approx(expected, rel=0.02, abs=0)


# The text, and its practice.


def test_the_ship_of_the_text_meets_the_top() -> None:
    """1.5.2: a ship with velocity (5, 8) collides with the top boundary; change its velocity to (5, -8)."""
    world = World(1000, 1000).add(Ship(500, 966, 5, 8, 10, 5e15, 0))
    assert time_to_wall(world[1], world) == (3.0, ("top",))
    after = evolve(world, 3.0)
    assert after[1].velocity == (5.0, -8.0)
    assert after[1].position == (515.0, 990.0)
    assert evolve(after, 1.0)[1].position == (520.0, 982.0)


def test_the_ship_into_the_corner_and_back() -> None:
    """From (100, 100) with (-10, -10) and radius 50: 5 s to the corner, 10 s back out to (150, 150)."""
    world = World(1000, 1000).add(Ship(100, 100, -10, -10, 50, 5e15, 0))
    assert time_to_wall(world[1], world) == (5.0, ("left", "bottom"))
    assert [(h.time, h.wall) for h in log(world, 15.0)] == [(5.0, "left"), (5.0, "bottom")]
    after = evolve(world, 15.0)
    assert after[1].position == (150.0, 150.0)
    assert after[1].velocity == (10.0, 10.0)


@pytest.mark.parametrize("parts", [1, 2, 3, 15, 60])
def test_the_ship_into_the_corner_however_the_time_is_cut(parts: int) -> None:
    world = World(1000, 1000).add(Ship(100, 100, -10, -10, 50, 5e15, 0))
    for _ in range(parts):
        world = evolve(world, 15 / parts)
    assert world[1].position == (150.0, 150.0)


def test_two_ships_head_on() -> None:
    """200 km apart, radii 10: 180 km to close at 30 km/s. Masses 1 and 3: exchange by hand."""
    a, b = Ship(100, 100, 10, 0, 10, 1.0, 0), Ship(300, 100, -20, 0, 10, 3.0, 0)
    assert time_to_contact(a, b) == 6.0
    world = World(1000, 200).add_all([a, b])
    (happened,) = log(world, 6.0)
    assert (happened.time, happened.kind, happened.entities, happened.at) == (
        6.0,
        "contact",
        (1, 2),
        (170.0, 100.0),
    )
    after = evolve(world, 6.0)
    # Centre of mass at -12.5 km/s: velocities mirror there.
    assert [after[i].velocity for i in (1, 2)] == [(-35.0, 0.0), (-5.0, 0.0)]


def test_an_oblique_contact_on_a_pythagorean_line() -> None:
    """Radii 10 and 15, met with the centres (15, 20) apart: only the component along (3, 4) / 5 is exchanged."""
    a, b = Asteroid(100, 300, 50, 0, 10), Asteroid(165, 320, 0, 0, 15)
    assert time_to_contact(a, b) == 1.0
    equal = World(1000, 1000).add_all(
        [Ship(100, 300, 50, 0, 10, 1e15, 0), Ship(165, 320, 0, 0, 15, 1e15, 0)]
    )
    after = evolve(equal, 1.0)
    assert [after[i].velocity for i in (1, 2)] == [
        pytest.approx((32.0, -24.0), rel=8 * 2.0**-53, abs=0),
        pytest.approx((18.0, 24.0), rel=8 * 2.0**-53, abs=0),
    ]
    assert after[1].position == (150.0, 300.0)


def test_three_in_a_row_pass_the_blow_on() -> None:
    """Newton's cradle: the first stops, the middle one stays, the last leaves with the velocity of the first."""
    row = [
        Ship(100, 500, 40, 0, 10, 5e15, 0),
        Ship(140, 500, 0, 0, 10, 5e15, 0),
        Ship(160, 500, 0, 0, 10, 5e15, 0),
    ]
    world = World(1000, 1000).add_all(row)
    assert [(h.time, h.entities) for h in log(world, 2.0)] == [(0.5, (1, 2)), (0.5, (2, 3))]
    after = evolve(world, 2.0)
    assert [e.vx for e in after.ships] == [0.0, 0.0, 40.0]
    assert [e.x for e in after.ships] == [120.0, 140.0, 220.0]


def test_a_bullet_reaches_a_distant_target() -> None:
    """Fired from 6 million km: (6e6 - 10 - 3 - 3 - 30) km at 250 km/s."""
    world = World(1e7, 1000).add_all(
        [Ship(100, 500, 0, 0, 10, 5e15, 0), Asteroid(6_000_100, 500, 0, 0, 30)]
    )
    world = act(world, 1, Fire())
    flight = (6e6 - 10 - 3 - 3 - 30) / 250
    assert time_to_contact(world[3], world[2]) == flight
    (happened,) = log(world, flight)
    assert (happened.kind, happened.died, happened.born) == ("contact", (2, 3), (4, 5))
    assert happened.time == flight


@pytest.mark.parametrize(("model", "hit"), [("robust", True), ("spec", False)])
def test_a_bullet_at_a_target_beyond_the_formula_of_the_text(model: str, hit: bool) -> None:
    """Dead centre at a thousand million km: the formula of the text sees nothing there (numbers 10^8 sigma apart)."""
    bullet = Bullet(1e8, 1e8, 150, 200, 3, 99)
    target = Asteroid(1e8 + 6e8, 1e8 + 8e8, 0, 0, 3)
    world = World(1e10, 1e10, model=model).add_all([bullet, target])
    assert (len(evolve(world, 1e9 / 250)) == 0) is hit


def test_a_bullet_bounces_once_and_dies_at_its_second_wall() -> None:
    """From x = 113 in a box of 1000: right wall after 884 km, left after 994 more."""
    world = act(World(1000, 1000).add(Ship(100, 500, 0, -0.0, 10, 5e15, 0)), 1, Fire())
    events = [(h.time, h.wall, h.effect, h.died) for h in log(world, 20.0)]
    assert events == [
        (884 / 250, "right", "bounce", ()),
        (884 / 250 + 994 / 250, "left", "die", (2,)),
    ]
    assert len(evolve(world, 20.0)) == 1


def test_thrust_for_a_second_by_the_text_in_steps() -> None:
    """220 km/s^2 from rest: n steps of 1/n s cover a/2 (1 - 1/n), as the text's rule loses a dt / 2 a second."""
    for n in (1, 2, 4, 64):
        world = act(World(1000, 1000).add(Ship(500, 500, 0, 0, 10, 1.1e18 / 256, 0)), 1, Thrust())
        for _ in range(n):
            world = evolve(world, 1 / n)
        assert world[1].vx == 256.0
        assert world[1].x == 500 + 128 * (1 - 1 / n)


def test_equal_discs_in_a_box_keep_the_energy_and_the_count() -> None:
    world = gas(100, 0.2, 7)
    before = sum(e.vx**2 + e.vy**2 for e in world.asteroids)
    run = list(happenings(world, 1e6, max_events=20_000))
    after = run[-1][1]
    assert (len(run), len(after)) == (20_000, 100)
    now = sum(e.vx**2 + e.vy**2 for e in after.asteroids)
    # 8 u a bounce if all erred one way; they do not, so this is generous.
    assert now == pytest.approx(before, rel=20_000 * 8 * 2.0**-53, abs=0)


def walls(world: World, until: float) -> Iterator[float]:
    return (h.time for h in log(world, until) if h.kind == "wall")


def test_a_disc_between_two_walls_keeps_time_for_ever() -> None:
    """A box 100 km wide, radius 10, 80 km/s: a wall each second, exactly, through many windows of time."""
    world = World(100, 100).add(Asteroid(50, 50, 80, 0, 10))
    assert list(walls(world, 5000.0)) == [k + 0.5 for k in range(5000)]
    late = evolve_until(world, 4096.0)
    assert late[1].position == (50.0, 50.0)
    assert late[1].velocity == (80.0, 0.0)
