"""`time_to_contact` and `time_to_wall` tell what `happenings` lets happen, thrusters and speed limits included."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import cos, inf, pi, sin, tau, ulp

from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import (
    Happened,
    Ship,
    World,
    happenings,
    time_to_contact,
    time_to_wall,
)
from fasteroids.moments import seconds
from fasteroids.paths import Limited, Parabola
from fasteroids.state import located
from fasteroids.testing import formations, keeping, worlds
from fasteroids.testing.runs import FOREVER
from tests.properties.laws import world_law

U = Fraction(1, 2**53)
FEW = worlds(max_size=2, thrusters=True, model="smooth")
"""Two entities at most, at time 0."""

MOST_LIMITS = 4
"""Each of two ships leaves its limit once at most, and reaches it once."""

signed = st.floats(-1.0, 1.0)
spreads = st.sampled_from([0.0, 0.01, 0.3, 2.0])


@st.composite
def duels(draw: st.DrawFn) -> World:
    """Two in a wide world that fly and thrust towards each other more or less, often at their limits or alike."""
    size, reach = 1e4, 2.0 ** draw(st.floats(6.0, 11.0))
    aim, alike = draw(st.floats(0.0, tau)), draw(st.booleans())
    fleet = Ship(
        0.5 * size, 0.5 * size, 0.0, 0.0, 1.0, 1.0, aim + draw(signed),
        thruster=True, thrust_power=2.0 ** draw(st.floats(0.0, 10.0)), max_speed=2.0 ** draw(st.floats(3.0, 11.0)),
    )  # fmt: skip
    pair = []
    for there in (aim, aim + pi):
        course = there + draw(spreads) * draw(signed)
        speed = fleet.max_speed * draw(st.one_of(st.just(1.0), st.floats(0.0, 1.0)))
        ship = evolve(
            fleet,
            x=fleet.x - reach * cos(there),
            y=fleet.y - reach * sin(there),
            vx=speed * cos(course),
            vy=speed * sin(course),
            radius=draw(st.floats(2.0, 60.0)),
        )
        if not alike:
            ship = evolve(
                ship,
                direction=there + draw(spreads) * draw(signed),
                thrust_power=ship.thrust_power * 2.0 ** draw(signed),
                max_speed=ship.max_speed * 2.0 ** draw(signed),
                thruster=draw(st.booleans()),
            )
        pair.append(ship)
    return World(size, size, model="smooth").add_all(pair)


def first(world: World) -> tuple[Happened | None, World]:
    """The first contact or wall there will be, if any, and the world just before it."""
    before = world
    for happened, after in happenings(world, FOREVER, max_events=MOST_LIMITS + 1):
        if happened.kind != "limit":
            return happened, before
        before = after
    return None, before


def spread(before: World, time: float) -> Fraction | float:
    """How far (s) two answers for the contact of the two flights may lie apart that both keep their promise.

    On a limited path, or between straight lines, there is one answer. For two parabolas the search depends on when
    it has to end, and that is a wall in `happenings` but not in `time_to_contact`. Then each of them is off by at most
    ulp/2 + 16 u cond t, cond t = sum |dt/dz| |z| over the inputs z, plus the rounding to a moment.
    """
    f, g = before.all_flights().values()
    if isinstance(f.path, Limited) or isinstance(g.path, Limited) or f.path is None is g.path:
        return 0
    start = max(f.since, g.since)
    t = Fraction(time) - Fraction(seconds(*start))
    slope, terms = Fraction(0), Fraction(0)
    e, o = located(f, start), located(g, start)
    pulls = [(p.ax, p.ay) if isinstance(p, Parabola) else (0.0, 0.0) for p in (f.path, g.path)]
    for x, v, a in (
        ((e.x, o.x), (e.vx, o.vx), (pulls[0][0], pulls[1][0])),
        ((e.y, o.y), (e.vy, o.vy), (pulls[0][1], pulls[1][1])),
    ):
        x_, v_, a_ = (Fraction(z[1]) - Fraction(z[0]) for z in (x, v, a))
        way = x_ + v_ * t + a_ * t * t / 2
        slope += 2 * way * (v_ + a_ * t)
        largest = [sum(Fraction(abs(part)) for part in z) for z in (x, v, a)]
        terms += 2 * abs(way) * (largest[0] + largest[1] * t + largest[2] * t * t / 2)
    terms += 2 * (Fraction(e.radius) + Fraction(o.radius)) ** 2
    if slope == 0:
        return inf
    return 2 * (Fraction(ulp(time)) + 16 * U * terms / abs(slope))


@world_law
@given(st.one_of(FEW, duels(), formations(max_size=2)))
def test_the_first_contact_or_wall_is_foretold(world: World) -> None:
    with keeping("ahead", world):
        happened, before = first(world)
        walls = {i: time_to_wall(e, world) for i, e in world.entities.items()}
        contact = min(
            (
                time_to_contact(a, b, model="smooth")
                for a, b in combinations(world.entities.values(), 2)
            ),
            default=inf,
        )
        soonest = min((when for when, _ in walls.values()), default=inf)
        if happened is None:
            assert min(soonest, contact) > FOREVER
        elif happened.kind == "wall":
            (i,) = happened.entities
            assert walls[i][0] == happened.time == soonest
            assert walls[i][1][0] == happened.wall
            assert contact >= happened.time or happened.time - contact <= spread(before, contact)
        else:
            assert happened.kind == "contact"
            assert soonest >= happened.time
            assert contact == happened.time or abs(
                Fraction(contact) - Fraction(happened.time)
            ) <= spread(before, happened.time)
