"""The audit passes an honest engine and catches every kind of broken one."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from math import inf, nan
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given, settings

from fasteroids import Asteroid, Bullet, Happened, Ship, World, happenings, models, physics
from fasteroids import evolve as evolved
from fasteroids.audit import Audit, Auditor, Margin, audit, imbalance
from fasteroids.entities import Entity, moving
from fasteroids.events import storm_limit
from fasteroids.models import Model, robust
from fasteroids.state import replaced, starting
from fasteroids.testing import worlds


def head_on() -> World:
    """Two asteroids that meet in the middle after 4 s, and reach the walls at 9 s."""
    left = Asteroid(50.0, 100.0, 10.0, 0.0, 10.0)
    right = Asteroid(150.0, 100.0, -10.0, 0.0, 10.0)
    return World(200.0, 200.0).add_all((left, right))


def billiard(count: int = 25, speed: float = 70.0) -> World:
    """Asteroids on a square lattice, each off in a direction of its own."""
    side = int(count**0.5)
    rocks = [
        Asteroid(
            100.0 * i + 50.0,
            100.0 * j + 50.0,
            speed * ((7 * i + 3 * j) % 11 - 5),
            speed * ((5 * i + 8 * j) % 13 - 6),
            20.0 + i + j,
        )
        for i in range(side)
        for j in range(side)
    ]
    return World(100.0 * side, 100.0 * side).add_all(rocks)


def margin(found: Audit, what: str) -> Margin:
    (result,) = [each for each in found.margins if what in each.what]
    return result


def broken(found: Audit) -> set[str]:
    """What was exceeded."""
    return {each.what for each in found.margins if not each.ok}


def deciding(monkeypatch: pytest.MonkeyPatch, decide: Callable[..., float]) -> None:
    """Let all levels decide contact times so."""
    level = Model("robust", decide, decide, "literal", "none")
    monkeypatch.setattr(models, "MODELS", {"robust": level})


# An honest engine.


def test_honest_engine_passes() -> None:
    found = audit(billiard(), 20.0)
    assert found.ok
    assert broken(found) == set()
    assert found.events["contact"] > 100
    assert found.total == sum(found.events.values())
    assert found.time == 20.0
    for what in ("overlap", "out of bounds", "speed", "momentum", "energy"):
        seen = margin(found, what)
        assert 0.0 < seen.worst <= seen.allowed
        assert seen.time is not None
        assert seen.entities
    assert 0.0 < (margin(found, "overlap").ulps or inf) < 1000.0


@given(worlds(thrusters=True, programs=True))
@settings(max_examples=50)
def test_honest_engine_passes_in_any_world(world: World) -> None:
    found = audit(world, 100.0, max_events=60)
    assert found.ok, [each for each in found.margins if not each.ok]


def test_a_run_of_nothing() -> None:
    found = audit(World(10.0, 10.0), 5.0)
    assert found.ok
    assert found.total == 0
    assert found.energy_drift is None
    assert found.rate is None
    assert found.time == 5.0
    assert all(each.time is None and each.entities == () for each in found.margins)


def test_stops_after_max_events() -> None:
    found = audit(billiard(), 20.0, max_events=7)
    assert found.total == 7
    assert found.time < 20.0


def test_audit_leaves_the_run_alone() -> None:
    world = billiard()
    alone = list(happenings(world, 5.0))
    auditor, log = Auditor(world), []
    for happened, after in happenings(world, 5.0):
        auditor.see(happened, after)
        log.append((happened, after))
    assert log == alone
    assert auditor.finish(log[-1][1]).total == len(log)


def test_counts_events_deaths_births_and_clips() -> None:
    world = World(400.0, 200.0).add_all(
        (
            Asteroid(200.0, 100.0, 0.0, 0.0, 40.0),
            Bullet(30.0, 100.0, 100.0, 0.0, 3.0, 9),
            Ship(350.0, 30.0, 10.0, 0.0, 5.0, 1e-30, 0.0, max_speed=10.0),
            Ship(380.0, 30.0, -10.0, 0.0, 5.0, 1e30, 0.0),
        )
    )
    found = audit(world, 10.0)
    assert found.ok
    assert (found.died, found.born) == (2, 2)
    assert found.clipped >= 1
    assert found.events["contact"] >= 2
    # The clipped bounce is not measured, and there is no other.
    assert margin(found, "momentum").time is None


def test_rate_needs_the_time_it_took() -> None:
    found = audit(billiard(), 5.0)
    assert found.rate is None
    assert evolve(found, elapsed=2.0).rate == found.total / 2.0


def test_thrust_is_part_of_the_run() -> None:
    ships = [
        Ship(100.0, 100.0, 0.0, 0.0, 10.0, 5e15, 0.0, thruster=True),
        Ship(300.0, 105.0, -50.0, 0.0, 10.0, 5e15, 3.0, thruster=True),
    ]
    found = audit(World(400.0, 200.0).add_all(ships), 30.0, max_events=500)
    assert found.ok
    assert found.energy_drift is not None
    assert found.energy_drift > 1.0


def test_energy_drift_is_that_of_the_bounces() -> None:
    found = audit(billiard(), 20.0)
    assert found.energy_drift is not None
    assert abs(found.energy_drift) < 1e-13


# Broken contacts.


def test_skipped_contact_is_the_deepest_overlap_though_nothing_happened(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    deciding(monkeypatch, lambda *_: inf)
    found = audit(head_on(), 8.0)
    assert found.total == 0
    assert broken(found) == {"overlap"}
    overlap = margin(found, "overlap")
    assert overlap.worst == pytest.approx(20.0)
    assert overlap.time == pytest.approx(5.0)
    assert overlap.entities == (1, 2)
    assert overlap.ulps is not None
    assert overlap.ulps > 1e12


def test_skipped_contact_is_found_when_a_wall_ends_the_flight(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    deciding(monkeypatch, lambda *_: inf)
    found = audit(head_on(), 14.5)
    assert found.events == {"wall": 2}
    assert margin(found, "overlap").time == pytest.approx(5.0)
    assert broken(found) == {"overlap"}


@pytest.mark.parametrize("late", [1e-3, 1e-6, 1e-9, 1e-12])
def test_late_contact_is_seen(late: float, monkeypatch: pytest.MonkeyPatch) -> None:
    deciding(monkeypatch, lambda *args: robust.MODEL.contact_time(*args) * (1.0 + late))
    found = audit(head_on(), 8.0)
    assert broken(found) == {"overlap"}
    assert margin(found, "overlap").worst == pytest.approx(20.0 * 4.0 * late, rel=0.1)


@pytest.mark.parametrize("skipped", [1, 4, 9])
def test_one_contact_skipped_among_many(skipped: int, monkeypatch: pytest.MonkeyPatch) -> None:
    turns = itertools.count()

    def forgetful(*args: Any) -> float:
        time = robust.MODEL.contact_time(*args)
        return inf if time < inf and next(turns) % 10 == skipped else time

    deciding(monkeypatch, forgetful)
    assert "overlap" in broken(audit(billiard(), 20.0))


def test_the_grid_of_a_broken_engine(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where cells are narrower than discs, some that touch are not in neighbouring ones."""
    monkeypatch.setattr("fasteroids.engine.fitting", lambda *_: (40, 40))
    assert "overlap" in broken(audit(billiard(), 20.0))


def test_own_bullets_are_exempt() -> None:
    ship = Ship(100.0, 100.0, 10.0, 0.0, 20.0, 5e15, 0.0)
    world = World(400.0, 200.0).add(ship)
    world = world.add(Bullet(150.0, 100.0, -50.0, 0.0, 3.0, 1))
    found = audit(world, 2.0)
    assert found.ok
    assert margin(found, "overlap").time is None


def test_what_overlapped_before_is_not_the_doing_of_the_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with monkeypatch.context() as patch:
        deciding(patch, lambda *_: inf)
        middle = evolved(head_on(), 5.0)
    assert audit(middle, 20.0).ok


# Other broken parts.


def test_walls_missed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "fasteroids.engine.Engine._first", lambda self, slot, _: self._contact[slot]
    )
    found = audit(World(200.0, 200.0).add(Asteroid(100.0, 100.0, 10.0, 0.0, 10.0)), 10.0)
    assert broken(found) == {"out of bounds"}
    assert margin(found, "out of bounds").worst == pytest.approx(10.0)
    assert margin(found, "out of bounds").time == 10.0


def test_bounce_that_loses_energy(monkeypatch: pytest.MonkeyPatch) -> None:
    honest = physics.bounce

    def soft(*args: float) -> tuple[float, ...]:
        return tuple(v * (1.0 - 2.0**-48) for v in honest(*args))

    monkeypatch.setattr(physics, "bounce", soft)
    found = audit(billiard(), 1.0)
    assert {"energy of a bounce", "momentum of a bounce"} <= broken(found)


def test_bounce_that_gives_to_one_only(monkeypatch: pytest.MonkeyPatch) -> None:
    def unfair(*args: float) -> tuple[float, ...]:
        return (-args[2], -args[3], args[5], args[6])

    monkeypatch.setattr(physics, "bounce", unfair)
    found = audit(head_on(), 8.0)
    assert "momentum of a bounce" in broken(found)
    assert "energy of a bounce" not in broken(found)


def test_speed_limit_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    def unlimited(_x: float, _y: float, *args: float) -> tuple[float | bool, ...]:
        return (args[0], args[1], args[3], args[4], False, False)

    monkeypatch.setattr(physics, "limit_contact", unlimited)
    light = Ship(50.0, 100.0, 10.0, 0.0, 10.0, 1.0, 0.0, max_speed=10.0)
    heavy = Ship(150.0, 100.0, -10.0, 0.0, 10.0, 1e20, 0.0)
    found = audit(World(200.0, 200.0).add_all((light, heavy)), 5.0)
    assert broken(found) == {"speed, against the limit"}
    assert margin(found, "speed").worst == pytest.approx(30.0)
    assert margin(found, "speed").allowed == 10.0


# What an engine may not say: a fold over made-up events.


def told(world: World, happened: Happened, after: World) -> Audit:
    auditor = Auditor(world)
    auditor.see(happened, after)
    return auditor.finish(after)


def with_entity(world: World, entity: Entity) -> World:
    """The world with another flight for an entity, from now on."""
    slot = world.slot_of(entity.id or 0)
    return replaced(world, world.clock, ((slot, starting(world, entity)),), (), ())


def test_the_dead_walk() -> None:
    found = told(head_on(), Happened(0.0, "contact", (1, 2), effect="die", died=(1,)), head_on())
    assert broken(found) == {"dead entity in the world"}
    assert margin(found, "dead").entities == (1,)


def test_somebody_else_changes() -> None:
    world = head_on()
    a = world[1]
    after = with_entity(world, moving(a, a.x, a.y, -a.vx, a.vy))
    found = told(world, Happened(0.0, "wall", (2,), wall="right"), after)
    assert broken(found) == {"entity changed by an event of others"}
    assert margin(found, "changed").entities == (1,)


def test_faults_are_counted_and_the_first_is_kept() -> None:
    auditor, world = Auditor(head_on()), head_on()
    for i in (1, 2, 1):
        auditor.see(Happened(0.0, "contact", (1, 2), effect="die", died=(i,)), world)
    dead = margin(auditor.finish(world), "dead")
    assert (dead.worst, dead.entities, dead.ok) == (3.0, (1,), False)


def test_own_bullet_hits() -> None:
    world = World(400.0, 200.0).add(Ship(100.0, 100.0, 10.0, 0.0, 20.0, 5e15, 0.0))
    world = world.add(Bullet(150.0, 100.0, -50.0, 0.0, 3.0, 1))
    happened = Happened(0.0, "contact", (1, 2), effect="die", died=(1, 2))
    found = told(world, happened, world.remove(1).remove(2))
    assert broken(found) == {"ship met its own bullet"}


def test_bullet_survives_its_second_wall() -> None:
    world = World(400.0, 200.0).add(Bullet(3.0, 100.0, -50.0, 0.0, 3.0, 1, bounced=True))
    bullet = world[1]
    after = with_entity(world, moving(bullet, 3.0, 100.0, 50.0, 0.0))
    found = told(world, Happened(0.0, "wall", (1,), wall="left"), after)
    assert broken(found) == {"bullet survived its second wall"}


def test_fourth_bullet() -> None:
    world = World(400.0, 200.0).add(Ship(100.0, 100.0, 0.0, 0.0, 20.0, 5e15, 0.0))
    bullets = [Bullet(200.0 + 20.0 * i, 100.0, 9.0, 0.0, 3.0, 1) for i in range(4)]
    three = world.add_all(bullets[:3])
    four = three.add(bullets[3])
    shot = Happened(0.0, "tick", (1,), effect="fire", born=(5,))
    assert broken(told(three, shot, four)) == {"bullets of a ship that fired"}
    three_shots = Happened(0.0, "tick", (1,), effect="fire", born=(4,))
    assert told(world.add_all(bullets[:2]), three_shots, three).ok


def test_time_runs_backwards() -> None:
    later, earlier = evolved(head_on(), 1.0), head_on()
    assert "event before the one before it" in broken(
        told(later, Happened(0.0, "wall", (1,)), earlier)
    )


def test_storm() -> None:
    world = World(10.0, 10.0)
    auditor = Auditor(world)
    for _ in range(storm_limit(0)):
        auditor.see(Happened(0.0, "tick", ()), world)
    assert auditor.finish(world).ok
    auditor.see(Happened(0.0, "tick", ()), world)
    found = auditor.finish(world)
    assert broken(found) == {"events at one moment"}
    assert margin(found, "one moment").worst == storm_limit(0) + 1


@pytest.mark.parametrize("place", [(nan, 100.0), (100.0, nan), (inf, 100.0)])
def test_place_that_is_none(place: tuple[float, float]) -> None:
    world = head_on()
    after = with_entity(world, moving(world[1], *place, 0.0, 0.0))
    found = told(world, Happened(0.0, "contact", (1, 2)), after)
    assert "out of bounds" in broken(found)
    assert margin(found, "out of bounds").worst == inf


def test_speed_that_is_none() -> None:
    world = head_on()
    after = with_entity(world, moving(world[1], 50.0, 100.0, nan, 0.0))
    found = told(world, Happened(0.0, "wall", (1,)), after)
    assert "speed, against the limit" in broken(found)


# Counters of the engine.


def test_contact_times_are_those_of_the_engine() -> None:
    found = audit(billiard(), 3.0)
    assert found.asked > found.events["contact"]
    assert found.undecided == 0


def test_counts_start_with_the_run() -> None:
    world = billiard()
    alone = audit(world, 3.0)
    middle = evolved(world, 3.0)  # has an engine, which has counted
    second = audit(middle, 3.0)
    assert second.total == 0
    assert second.asked == 0
    whole = audit(world, 6.0)
    assert whole.asked == alone.asked + audit(evolved(world, 3.0), 6.0).asked


def test_undecided_contacts_are_counted() -> None:
    grazing = World(1000.0, 1000.0).add_all(
        (Asteroid(100.0, 100.0, 10.0, 0.0, 10.0), Asteroid(500.0, 120.0, -10.0, 0.0, 10.0))
    )
    found = audit(grazing, 1.0)
    assert found.undecided >= 1
    assert found.undecided <= found.asked


def test_engines_built_anew_add_up() -> None:
    world = billiard()
    auditor = Auditor(world)
    middle = evolved(world, 0.0)
    for happened, after in happenings(world, 2.0, max_events=10):
        auditor.see(happened, after)
        middle = after
    first = auditor.finish(middle).asked
    auditor = Auditor(world)
    for happened, after in happenings(world, 2.0, max_events=10):
        auditor.see(happened, after)
        middle = after
    fresh = evolve(middle)  # without a cache
    for happened, after in happenings(fresh, 2.0):
        auditor.see(happened, after)
        fresh = after
    assert auditor.finish(fresh).asked > first


# Conservation.


def test_imbalance_of_an_exact_bounce() -> None:
    a, b = head_on().asteroids
    assert imbalance(a, b, moving(a, 0, 0, -10.0, 0.0), moving(b, 0, 0, 10.0, 0.0)) == (0.0, 0.0)


def test_imbalance_in_units_of_u() -> None:
    a, b = head_on().asteroids
    ulp = 2.0**-49  # of 10
    momentum, energy = imbalance(
        a, b, moving(a, 0, 0, -10.0 + ulp, 0.0), moving(b, 0, 0, 10.0, 0.0)
    )
    # One mass, one ulp, over two masses and 40 km/s: 2^-49 / 40 / 2^-53.
    assert momentum == pytest.approx(16 / 40)
    # Half a mass times 2 v ulp, over two masses and 20^2 (km/s)^2.
    assert energy == pytest.approx(16 * 10 / 800)


def test_imbalance_at_rest_and_without_mass() -> None:
    a = Asteroid(0.0, 0.0, 0.0, 0.0, 1.0)
    assert imbalance(a, a, a, a) == (0.0, 0.0)
    dust, rock = Asteroid(0.0, 0.0, 1.0, 0.0, 1e-200), Asteroid(0.0, 0.0, 0.0, 0.0, 1e150)
    assert imbalance(dust, rock, evolve(dust, vx=-1.0), rock) == (0.0, 0.0)


@pytest.mark.parametrize("masses", [(1e-290, 1e290), (1e290, 1e-290), (5e15, 5e15), (1.0, 3.0)])
@pytest.mark.parametrize("speed", [1e-300, 1.0, 3e5])
def test_imbalance_of_the_bounces_of_ships(masses: tuple[float, float], speed: float) -> None:
    ships = [
        Ship(50.0, 100.0, speed, 0.3 * speed, 10.0, masses[0], 0.0),
        Ship(150.0, 105.0, -0.5 * speed, 0.2 * speed, 10.0, masses[1], 0.0),
    ]
    found = audit(World(200.0, 200.0).add_all(ships), 70.0 / speed)
    assert found.events["contact"] >= 1
    assert found.ok


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("late", [0.02048, 0.3])
def test_the_clock_of_the_audit_is_as_fine_as_the_worlds(side: float, late: float) -> None:
    """An old flight and a new, very fast one: the sum of age and time since would lose 5e-8 km."""
    world = evolved(
        World(40_000.0, 4_000.0).add(Asteroid(20_000.0, 2_000.0, 0.0, 0.0, 1024.0)), 10_240.0
    )
    fast = Asteroid(20_000.0 + side * 10_000.0, 2_000.0, -side * 3e5, 0.0, 1024.0)
    report = audit(evolved(world, late).add(fast), 20_000.0, max_events=3)
    assert [m for m in report.margins if not m.ok] == []
    assert max(m.worst for m in report.margins if m.what == "overlap") < 1e-10
