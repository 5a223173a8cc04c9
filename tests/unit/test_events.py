"""The one loop over time and what it yields; the public functions, good input and bad."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Generator
from math import inf, log, nan, nextafter, pi, sqrt, ulp
from typing import Any

import pytest
from attrs import evolve as with_
from attrs.exceptions import FrozenInstanceError

import fasteroids
from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    Happened,
    ModelError,
    Ship,
    Skip,
    Thrust,
    ThrustOff,
    Turn,
    World,
    act,
    bounce,
    evolve,
    evolve_until,
    happenings,
    time_to_contact,
    time_to_wall,
)
from fasteroids.events import storm_limit
from tests.unit import making
from tests.unit.making import MAX

BAD_TIMES: list[Any] = [nan, inf, -inf, -1.0, -5e-324, None, "soon", [], 10**5000, 1j]


def kind_of(value: object) -> str:
    """A name for a parameter that may be too long to print."""
    return f"{value!r}" if isinstance(value, float) else type(value).__name__


def ship(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Ship:
    return Ship(x, y, vx, vy, 10.0, 5e15, 0.0, **fields)


def rock(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Asteroid:
    return Asteroid(x, y, vx, vy, 20.0, **fields)


def busy() -> World:
    return World(1000, 1000).add_all(
        [
            ship(100, 500, 60, 0),
            ship(300, 500),
            rock(800, 800, 70, 0),
            Bullet(500, 100, 0, 90, 3, 1),
        ]
    )


# happenings


def test_happenings_yields_each_event_with_the_world_just_after() -> None:
    world = busy()
    times = []
    for happened, after in happenings(world, 3.0):
        assert isinstance(happened, Happened)
        assert after.time == happened.time
        assert after != world
        times.append(happened.time)
        world = after
    assert times == [180 / 70, 3.0]


def ended(unfolding: Generator[Any, None, World]) -> tuple[int, World]:
    count = 0
    while True:
        try:
            next(unfolding)
        except StopIteration as stop:
            return count, stop.value
        count += 1


def test_happenings_returns_the_world_at_the_end() -> None:
    count, world = ended(happenings(busy(), 10.0))
    assert count >= 3
    assert world.time == 10.0
    assert world == evolve_until(busy(), 10.0)


@pytest.mark.parametrize("limit", [0, 1, 2])
def test_happenings_stops_after_so_many_events(limit: int) -> None:
    worlds = [busy(), *(after for _, after in happenings(busy(), 10.0))]
    assert len(worlds) > 3
    assert ended(happenings(busy(), 10.0, max_events=limit)) == (limit, worlds[limit])


def test_happenings_with_room_for_more_events_goes_to_the_end() -> None:
    count, world = ended(happenings(busy(), 3.0, max_events=3))
    assert (count, world.time) == (2, 3.0)
    # Exactly as many as there are: it stops at the last of them.
    assert ended(happenings(busy(), 2.6, max_events=1))[1].time == 180 / 70


@pytest.mark.parametrize("bad", [-1, 1.5, "3", nan, True])
def test_happenings_refuses_a_number_of_events_that_is_none(bad: Any) -> None:
    with pytest.raises(ModelError, match="max_events"):
        ended(happenings(busy(), 10.0, max_events=bad))


def test_happenings_can_be_left_and_its_worlds_evolved() -> None:
    expected = evolve_until(busy(), 10.0)
    for _, after in happenings(busy(), 10.0):
        assert evolve_until(after, 10.0) == expected


def test_happenings_survives_what_is_done_to_its_worlds() -> None:
    expected = [happened for happened, _ in happenings(busy(), 10.0)]
    log = []
    for happened, after in happenings(busy(), 10.0):
        log.append(happened)
        evolve(after, 1.0)
        act(after, 1, Turn(1.0))
        after.remove(1)
    assert log == expected


def test_happenings_changes_nothing_it_is_given() -> None:
    world = busy()
    before = copy.deepcopy(world)
    ended(happenings(world, 10.0))
    assert world == before
    assert ended(happenings(world, 10.0)) == ended(happenings(before, 10.0))


@pytest.mark.parametrize("bad", BAD_TIMES, ids=kind_of)
def test_happenings_refuses_a_time_at_once(bad: Any) -> None:
    with pytest.raises(ModelError, match=r"a time must be a (finite )?number"):
        happenings(busy(), bad)


@pytest.mark.parametrize("bad", ["0.5", True])
def test_happenings_refuses_what_only_looks_like_a_time(bad: Any) -> None:
    with pytest.raises(ModelError, match="a time must be"):
        happenings(busy(), bad)


def test_happenings_does_not_go_back() -> None:
    world = evolve(busy(), 2.0)
    with pytest.raises(
        ModelError, match=r"the world is at 2.0 s already; it cannot go back to 1.0 s"
    ):
        happenings(world, 1.0)
    with pytest.raises(ModelError, match="cannot go back"):
        evolve_until(world, nextafter(2.0, 0.0))


# evolve_until, evolve


def test_evolve_until_goes_to_a_time() -> None:
    assert evolve_until(busy(), 1.0).time == 1.0
    assert evolve_until(busy(), 1)[1].x == 160.0


def test_evolve_until_now_runs_what_is_due_and_no_more() -> None:
    world = evolve(busy(), 1.0)
    assert evolve_until(world, 1.0) == world
    touching = World(1000, 1000).add_all([ship(100, 500, 10, 0), ship(120, 500)])
    assert evolve_until(touching, 0)[2].vx == 10.0


@pytest.mark.parametrize("start", [1e4 / 3, 1e9 + 1e4 / 3, 1e12 / 7, 1e15 / 7])
def test_evolve_until_its_own_time_is_always_allowed(start: float) -> None:
    world = evolve_until(World(1000, 1000), start).add(rock(500, 500, 3, 5))
    world = evolve(world, 1 / 3)
    again = evolve_until(world, world.time)
    assert again.time == world.time


@pytest.mark.parametrize("bad", BAD_TIMES, ids=kind_of)
def test_evolve_until_refuses(bad: Any) -> None:
    with pytest.raises(ModelError, match="a time must be"):
        evolve_until(busy(), bad)


@pytest.mark.parametrize("bad", BAD_TIMES, ids=kind_of)
def test_evolve_refuses(bad: Any) -> None:
    with pytest.raises(ModelError, match="a step must be"):
        evolve(busy(), bad)


def test_evolve_is_evolve_until_at_clock_plus_dt() -> None:
    assert evolve(busy(), 2.5) == evolve_until(busy(), 2.5)
    assert evolve(evolve(busy(), 2.5), 4.0) == evolve_until(busy(), 6.5)


def test_evolve_carries_the_rounding_of_its_steps() -> None:
    world = busy()
    for _ in range(10):
        world = evolve(world, 0.1)
    assert world.time == 1.0


def test_evolve_without_an_event_touches_the_clock_only() -> None:
    world = busy()
    after = evolve(world, 0.5)
    assert after.flights is world.flights
    assert after.roster is world.roster
    assert after.time == 0.5


def test_evolve_of_a_long_time_in_an_empty_world() -> None:
    assert evolve(World(10, 10), 1e300).time == 1e300


# The clock in long runs.


def test_a_late_world_behaves_as_an_early_one() -> None:
    """The same scene at 0 s and after 2^40 windows: the same events, to the bit."""
    late = evolve_until(World(1000, 1000), 2.0**50)
    early, then = busy(), late.add_all(busy().entities.values())
    ours = [(h.kind, h.entities, w.now[1]) for h, w in happenings(early, 30.0)]
    theirs = [(h.kind, h.entities, w.now[1]) for h, w in happenings(then, 2.0**50 + 30.0)]
    assert len(ours) > 5
    assert ours == theirs


# The guard (L14).


def test_storm_limit_grows_with_the_crowd() -> None:
    assert storm_limit(0) == 10_000
    assert storm_limit(50) == 15_000


def test_a_storm_is_ended_with_the_names_of_those_in_it() -> None:
    """A world so small that 2^30 crossings of it take no time a clock at 512 s could show."""
    world = evolve(World(1e-20, 1e-20), 512.0).add(
        Asteroid(5e-21, 5e-21, 3e5, 0, 1e-21, name="mite")
    )
    with pytest.raises(ModelError, match=r"events at the moment 512.0 s, .*asteroid 'mite'"):
        evolve(world, 1.0)


def test_a_storm_leaves_a_world_that_can_be_asked_again() -> None:
    world = evolve(World(1e-20, 1e-20), 512.0).add(Asteroid(5e-21, 5e-21, 3e5, 0, 1e-21))
    for _ in range(2):
        with pytest.raises(ModelError, match="events at the moment"):
            evolve(world, 1.0)
    assert ended(happenings(world, 513.0, max_events=100))[0] == 100


# act


def test_act_turns_now() -> None:
    world = evolve(busy(), 0.5)
    after = act(world, 1, Turn(1.0))
    assert after.ships[0].direction == 1.0
    assert after.time == world.time
    assert world.ships[0].direction == 0.0


def test_act_switches_the_thruster() -> None:
    on = act(busy(), 1, Thrust())
    assert on.ships[0].thruster is True
    assert act(on, 1, Thrust()) == on
    assert act(on, 1, ThrustOff()) == busy()
    assert act(busy(), 1, ThrustOff()) == busy()


def test_act_fires_and_skips() -> None:
    assert len(act(busy(), 1, Fire()).bullets) == 2
    assert act(busy(), 1, Skip()) == busy()


@pytest.mark.parametrize("bad", [0, 99, None, "1", nan, []], ids=kind_of)
def test_act_of_nobody_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match="there is no entity with id"):
        act(busy(), bad, Fire())


def test_act_is_noticed_by_the_predictions_there_are() -> None:
    world = evolve(busy(), 0.5)
    assert act(world, 1, Thrust()) != world
    fired = act(world, 2, Fire())
    kinds = {h.entities for h, _ in happenings(fired, 10.0)}
    assert any(5 in pair for pair in kinds)


# time_to_contact


def test_time_to_contact_is_from_now() -> None:
    a, b = ship(100, 500, 60, 0), ship(300, 500)
    assert time_to_contact(a, b) == 3.0 == time_to_contact(b, a)
    world = evolve(busy(), 1.0)
    assert time_to_contact(world[1], world[2]) == 2.0


def test_time_to_contact_of_a_bullet_and_a_distant_target() -> None:
    bullet = Bullet(0, 0, 150, 200, 3, 1)
    target = rock(6e5, 8e5)
    assert time_to_contact(bullet, target) == (1e6 - 23) / 250


def test_time_to_contact_never() -> None:
    assert time_to_contact(ship(100, 500), ship(300, 500)) == inf
    assert time_to_contact(ship(100, 500, -1, 0), ship(300, 500)) == inf
    assert time_to_contact(ship(100, 500, 9, 9), ship(300, 500)) == inf


def test_time_to_contact_of_a_ship_and_its_bullet_is_never() -> None:
    mine, other = ship(100, 500, 60, 0, id=1), ship(100, 500, 60, 0, id=2)
    bullet = Bullet(300, 500, 0, 0, 3, 1, id=3)
    assert time_to_contact(mine, bullet) == time_to_contact(bullet, mine) == inf
    assert time_to_contact(other, bullet) == 187 / 60


def test_time_to_contact_overlapping_is_now_or_never() -> None:
    assert time_to_contact(ship(100, 500, 1, 0), ship(105, 500)) == 0.0
    assert time_to_contact(ship(100, 500, -1, 0), ship(105, 500)) == inf


def test_time_to_contact_by_model() -> None:
    a, b = Asteroid(0, 0, 0.6, 0.8, 3), Asteroid(6e8, 8e8, 0, 0, 3)
    assert time_to_contact(a, b) == time_to_contact(a, b, model="robust") == 999999994.0
    assert time_to_contact(a, b, model="spec") == inf
    with pytest.raises(ModelError, match="no model 'wrong'"):
        time_to_contact(a, b, model="wrong")


# under smooth: thrusters of 256 km/s^2


def burner(x: float, y: float, vx: float = 0.0, vy: float = 0.0, **fields: Any) -> Ship:
    return making.ship(x, y, vx, vy, thruster=True, **fields)


def smooth_contact(a: Any, b: Any) -> float:
    t = time_to_contact(a, b, model="smooth")
    assert time_to_contact(b, a, model="smooth") == t
    return t


def test_time_to_contact_along_a_parabola() -> None:
    a, b = burner(100, 500), rock(258, 500)  # 128 km apart
    assert smooth_contact(a, b) == 1.0
    assert time_to_contact(a, b) == time_to_contact(a, b, model="spec") == inf


def test_time_to_contact_beyond_the_limit() -> None:
    """128 km/s after half a second and 32 km; 96 km more take 0.75 s."""
    assert smooth_contact(burner(100, 500, max_speed=128.0), rock(258, 500)) == 1.25


def test_time_to_contact_when_both_reach_their_limits() -> None:
    """192 km apart: 32 + 32 in half a second, 40 + 32 in the quarter after it, and 56 at 192 + 128 km/s."""
    slow = burner(320, 500, direction=pi, max_speed=128.0)
    fast = burner(108, 500, max_speed=192.0)
    assert smooth_contact(fast, slow) == pytest.approx(0.5 + 0.25 + 56.0 / 320.0, rel=1e-15)


def test_time_to_contact_beyond_leaving_and_reaching_the_limit() -> None:
    """At full speed away from the rock, thrust towards it: back after a second at full speed, 64 km to go."""
    a = burner(500, 500, 128.0, direction=pi, max_speed=128.0)
    assert smooth_contact(a, rock(406, 500)) == pytest.approx(1.5, rel=1e-15)


def test_time_to_contact_while_turning_at_the_limit() -> None:
    """From across its thrust it flies (c / w) ln cosh w t along, and nears (c / w) pi / 2 across, where the rock is."""
    a = burner(100, 500, 0.0, 256.0, max_speed=256.0)
    b = rock(100 + 40 * 256, 500 + 128 * pi)
    assert smooth_contact(a, b) == pytest.approx(40.0 - 30.0 / 256.0 + log(2.0), rel=1e-12)


def test_time_to_contact_of_two_that_accelerate_alike() -> None:
    """Against each other they fly straight, below the limit and at it."""
    assert smooth_contact(burner(100, 500, 64, 0), burner(184, 500)) == 1.0
    a, b = (burner(x, 500, max_speed=256.0) for x in (100, 200))
    assert smooth_contact(a, b) == inf
    a, b = (burner(x, 500, 256.0, 0.0, max_speed=256.0) for x in (100, 200))
    assert smooth_contact(a, b) == inf
    a, b = (burner(x, 500, 0.0, 256.0, max_speed=256.0) for x in (100, 200))
    assert smooth_contact(a, b) == inf
    a, b = burner(100, 500, 256.0, 0.0, max_speed=256.0), burner(220, 500, max_speed=256.0)
    assert smooth_contact(a, b) == pytest.approx(1.0 - sqrt(1.0 - 100.0 / 128.0), rel=1e-15)


def test_time_to_contact_with_the_thruster_off_is_straight() -> None:
    for a, b in (
        (ship(100, 500, 60, 0), ship(300, 510)),
        (rock(0, 3, 7, 0), ship(99, 0, thruster=False)),
    ):
        assert smooth_contact(a, b) == time_to_contact(a, b)


def test_time_to_contact_knows_no_wall() -> None:
    """A ship that leans on a wall is taken to leave through it; so is one that would bounce."""
    assert smooth_contact(burner(990, 500), rock(1148, 500)) == 1.0


def test_time_to_contact_of_a_burning_ship_and_its_bullet_is_never() -> None:
    mine, bullet = burner(100, 500, id=1), Bullet(300, 500, 0, 0, 3, 1, id=3)
    assert smooth_contact(mine, bullet) == inf
    assert smooth_contact(with_(mine, id=2), bullet) < inf


def test_time_to_contact_overlapping_under_thrust() -> None:
    assert smooth_contact(burner(100, 500, 1, 0), ship(105, 500)) == 0.0
    assert smooth_contact(burner(100, 500), ship(105, 500)) == 0.0
    assert smooth_contact(burner(105, 500), ship(100, 500)) == inf


def test_time_to_contact_beyond_all_times_is_never() -> None:
    """It reaches 1e-10 km/s after 1e307 s and 5e296 km; what is left takes 1.5e308 s, or more than there are."""
    a = making.ship(0, 0, mass=1.0, thrust_power=1e-317, max_speed=1e-10, thruster=True)
    assert smooth_contact(a, rock(1.55e298, 0)) == pytest.approx(1.6e308, rel=1e-2)
    assert smooth_contact(a, rock(2.5e298, 0)) == inf


@pytest.mark.parametrize("bad", [None, 3, "ship", (0, 0)], ids=repr)
def test_time_to_contact_of_no_entity_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError):
        time_to_contact(bad, ship(0, 0))
    with pytest.raises(ModelError):
        time_to_contact(ship(0, 0), bad)


# time_to_wall


@pytest.mark.parametrize(
    ("entity", "answer"),
    [
        (ship(100, 500, 10, 0), (89.0, ("right",))),
        (ship(100, 500, -10, 0), (9.0, ("left",))),
        (ship(100, 500, 0, 10), (49.0, ("top",))),
        (ship(100, 400, 0, -10), (39.0, ("bottom",))),
        (ship(100, 500), (inf, ())),
        (ship(500, 500, 10, 10), (49.0, ("right", "top"))),
        (ship(500, 500, -10, -10), (49.0, ("left", "bottom"))),
        (ship(10, 500, -10, 0), (0.0, ("left",))),
        (ship(5, 500, -10, 0), (0.0, ("left",))),
        (ship(990, 990, 1, 1), (0.0, ("right", "top"))),
    ],
)
def test_time_to_wall(entity: Ship, answer: tuple[float, tuple[str, ...]]) -> None:
    assert time_to_wall(entity, World(1000, 1000)) == answer


@pytest.mark.parametrize(
    ("entity", "answer"),
    [
        (burner(862, 500), (1.0, ("right",))),  # 128 km to go at 256 km/s^2
        (burner(862, 500, max_speed=128.0), (1.25, ("right",))),
        (burner(926, 926, 0, 64, mass=2.0 * making.STRONG), (1.0, ("right", "top"))),
        (burner(122, 500, -256, 0), (1.0 - sqrt(1 / 8), ("left",))),
        (
            burner(139, 500, -256, 0),
            (1.0 + sqrt(979 / 128), ("right",)),
        ),  # it turns 1 km from the left
        (burner(10, 500, -128, 0, direction=0.0), (0.0, ("left",))),
        (burner(862, 500, 0, 245, thrust_power=0.0), (2.0, ("top",))),
        (burner(862, 500, thrust_power=0.0), (inf, ())),
        (burner(990, 500), (inf, ())),  # it leans there
        (burner(990, 500, 0, 49), (10.0, ("top",))),  # and slides along
        (burner(990, 500, 0, 49, max_speed=49.0), (10.0, ("top",))),
        (burner(990, 500, -128, 0), (1.0, ("right",))),
    ],
)
def test_time_to_wall_along_a_bent_path(
    entity: Ship, answer: tuple[float, tuple[str, ...]]
) -> None:
    time, walls = time_to_wall(entity, World(1000, 1000, model="smooth"))
    assert time == pytest.approx(answer[0], rel=1e-15)
    assert walls == answer[1]


def test_time_to_wall_beyond_leaving_and_reaching_the_limit() -> None:
    """Thrust back from full speed: back in place after a second, and 490 km at 128 km/s more."""
    outwards = burner(500, 500, 128.0, direction=pi, max_speed=128.0)
    time, walls = time_to_wall(outwards, World(1000, 1000, model="smooth"))
    assert time == pytest.approx(1.0 + 490.0 / 128.0, rel=1e-15)
    assert walls == ("left",)


def test_time_to_wall_knows_no_thrust_where_the_rule_is_literal() -> None:
    assert time_to_wall(burner(862, 500), World(1000, 1000)) == (inf, ())
    assert time_to_wall(burner(862, 500, 32, 0), World(1000, 1000)) == (4.0, ("right",))


def test_time_to_wall_of_a_ship_that_is_not_there() -> None:
    """It need not be in the world, nor inside it."""
    world = World(1000, 1000, model="smooth")
    for x in (-MAX, -50.0, 5.0, 995.0, 2000.0, MAX):
        for v in (-64.0, 0.0, 64.0):
            for limit in (64.0, 300_000.0):
                assert time_to_wall(burner(x, 500, v, 0, max_speed=limit), world)[0] >= 0.0


@pytest.mark.parametrize("bad", [None, 3, "ship", (0, 0)], ids=repr)
def test_time_to_wall_of_no_entity_is_refused(bad: Any) -> None:
    for model in ("robust", "smooth"):
        with pytest.raises(ModelError, match="what meets a wall"):
            time_to_wall(bad, World(1000, 1000, model=model))


# bounce


def test_bounce_of_equals_swaps_velocities() -> None:
    a, b = bounce(ship(100, 500, 10, 3), ship(120, 500, -4, 1))
    assert (a.velocity, b.velocity) == ((-4.0, 3.0), (10.0, 1.0))
    assert (a.position, b.position) == ((100.0, 500.0), (120.0, 500.0))


def test_bounce_changes_nothing_of_those_who_part() -> None:
    pair = ship(100, 500, -10, 0), ship(120, 500, 4, 1)
    assert bounce(*pair) == pair


def test_bounce_keeps_to_the_limits_of_entities_without_an_id() -> None:
    heavy, light = ship(100, 500, 2e5, 0), Ship(120, 500, 0, 0, 10, 1.0, 0)
    a, b = bounce(heavy, light)
    assert b.velocity == (3e5, 0.0)
    assert abs(a.vx - 2e5) <= 8 * ulp(2e5)


@pytest.mark.parametrize("r", [1e-120, 1e-108, 1.0, 1e97, 1e110, 1e150])
def test_bounce_of_spheres_of_any_size(r: float) -> None:
    """An asteroid and a bullet whose masses are 0 or infinite in kilograms bounce by their ratio all the same."""
    a, b = bounce(Asteroid(0, 0, 1, 0, r), Bullet(2 * r, 0, -1, 0, r, 1))
    like_c, like_d = bounce(Asteroid(0, 0, 1, 0, 1), Bullet(2, 0, -1, 0, 1, 1))
    assert a.vx == pytest.approx(like_c.vx, rel=0, abs=32 * 2.0**-53)
    assert b.vx == pytest.approx(like_d.vx, rel=0, abs=32 * 2.0**-53)


# Happened


def test_happened_is_a_value() -> None:
    one = Happened(1.5, "contact", (1, 2), at=(3.0, 4.0))
    assert one == Happened(1.5, "contact", (1, 2), at=(3.0, 4.0))
    assert one != Happened(1.5, "contact", (1, 3), at=(3.0, 4.0))
    assert hash(one) == hash(copy.copy(one))
    assert pickle.loads(pickle.dumps(one)) == one
    with pytest.raises(FrozenInstanceError):
        one.time = 2.0  # type: ignore[misc]


def test_happened_by_default_says_nothing_more() -> None:
    bare = Happened(1.5, "wall", (1,))
    assert (bare.wall, bare.effect, bare.died, bare.born, bare.clipped) == (
        None,
        "bounce",
        (),
        (),
        (),
    )
    assert (bare.at, bare.prints, bare.span, bare.reason) == (None, (), None, None)


@pytest.mark.parametrize(
    ("happened", "line"),
    [
        (Happened(1.5, "contact", (1, 2)), "t=1.5 contact #1 and #2, bounce"),
        (Happened(2.0, "wall", (3,), wall="left"), "t=2 wall #3, at the left, bounce"),
        (
            Happened(
                0.125, "contact", (1, 4), effect="split", died=(1, 4), born=(5, 6), clipped=(5, 6)
            ),
            "t=0.125 contact #1 and #4, split, died #1 #4, born #5 #6, clipped #5 #6",
        ),
        (
            Happened(0.2, "tick", (1,), effect="halt", reason="it stopped", prints=("a", "b")),
            "t=0.2 tick #1, halt, because it stopped, prints a, prints b",
        ),
    ],
)
def test_happened_prints_as_one_line(happened: Happened, line: str) -> None:
    assert str(happened) == line


def test_happened_prints_as_one_line_whatever_a_program_prints() -> None:
    text = str(Happened(0.2, "tick", (1,), prints=("a\nb\x1b[2J",), reason="no\r\nway"))
    assert text.isprintable()
    assert len(text.splitlines()) == 1


def test_happened_of_each_kind() -> None:
    log = [h for h, _ in happenings(busy(), 12.0)]
    assert {h.kind for h in log} == {"contact", "wall"}
    for h in log:
        assert (h.wall in ("left", "right", "bottom", "top")) == (h.kind == "wall")
        assert h.at is not None
        assert list(h.entities) == sorted(h.entities)


# The public names.


def test_the_public_names() -> None:
    stable = {
        "World", "Ship", "Asteroid", "Bullet", "ModelError", "evolve", "evolve_until", "happenings", "Happened",
        "time_to_contact", "time_to_wall", "bounce", "act", "Turn", "Fire", "Thrust", "ThrustOff", "Skip",
    }  # fmt: skip
    assert stable <= set(fasteroids.__all__)
    assert all(hasattr(fasteroids, name) for name in fasteroids.__all__)
