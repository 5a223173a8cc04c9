"""The cache of predictions: it may be dropped, rebuilt, and shaped otherwise, and nothing else changes."""

from __future__ import annotations

import random
from math import sqrt
from typing import Any

import pytest
from attrs import frozen

from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    Happened,
    Ship,
    Skip,
    Thrust,
    Turn,
    World,
    act,
    evolve,
    evolve_until,
    happenings,
    rules,
)
from fasteroids.actions import Action, Ticked
from fasteroids.engine import CONTACT, GRID_FROM, TICK, WALLS, Engine, Plan, give, needs, peek, take

LEAST = Plan(grid=False, thrust=True, bullets=True, ticks=True)
MOST = Plan(grid=True, thrust=True, bullets=True, ticks=True)


@frozen
class Round:
    """A program that does the same few things for ever."""

    steps: tuple[Action, ...]

    @property
    def running(self) -> bool:
        return True

    def tick(self, _view: Any) -> Ticked:
        return Ticked(Round((*self.steps[1:], self.steps[0])), self.steps[0])


def discs(count: int, seed: int = 1, speed: float = 200.0) -> World:
    """So many small asteroids on a lattice with random velocities."""
    rng = random.Random(seed)
    side = int(sqrt(count)) + 1
    pitch = 1000.0 / side
    return World(1000, 1000, seed=seed).add_all(
        Asteroid(
            (i % side + 0.5) * pitch,
            (i // side + 0.5) * pitch,
            rng.uniform(-speed, speed),
            rng.uniform(-speed, speed),
            pitch * rng.uniform(0.1, 0.3),
        )
        for i in range(count)
    )


def battle(seed: int, *, thrust: bool) -> World:
    """Asteroids that split, bullets, and ships that turn, fire and perhaps thrust."""
    rng = random.Random(seed)
    world = World(1000, 1000, seed=seed)
    places = [(x, y) for x in range(80, 1000, 120) for y in range(80, 1000, 120)]
    rng.shuffle(places)
    steps: list[Action] = [Fire(), Turn(rng.uniform(-2, 2)), Skip(), Fire(), Turn(1.0)]
    if thrust:
        steps.append(Thrust())
    for x, y in places[:12]:
        world = world.add(
            Asteroid(x, y, rng.uniform(-90, 90), rng.uniform(-90, 90), rng.uniform(10, 55))
        )
    for x, y in places[12:16]:
        world = world.add(
            Ship(x, y, rng.uniform(-90, 90), rng.uniform(-90, 90), 12, 5e15, rng.uniform(0, 6),
                 program=Round(tuple(steps)))
        )  # fmt: skip
    for x, y in places[16:20]:
        world = world.add(Bullet(x, y, rng.uniform(-200, 200), rng.uniform(-200, 200), 3, 1))
    return world


def unfold(
    world: World, until: float, plan: Plan | None = None, drop: random.Random | None = None
) -> tuple[list[Happened], World]:
    """What happens, and the world in the end; with a cache of another shape, or one dropped now and then."""
    if plan is not None:
        world._box.clear()
        give(world, Engine(world, plan))
    log: list[Happened] = []
    unfolding = happenings(world, until, max_events=3000)
    while True:
        try:
            happened, after = next(unfolding)
        except StopIteration as stop:
            return log, stop.value
        log.append(happened)
        if drop is not None and drop.random() < 0.4:
            after._box.clear()


# The plan.


def test_needs_nothing_of_an_empty_world() -> None:
    assert needs(World(1000, 1000)) == Plan(grid=False, thrust=False, bullets=False, ticks=False)


def test_needs_what_is_there() -> None:
    world = World(1000, 1000).add(Ship(500, 500, 0, 0, 10, 1, 0))
    assert needs(world) == needs(World(1000, 1000))
    assert needs(act(world, 1, Thrust())).thrust
    assert needs(act(world, 1, Fire())).bullets
    assert needs(world.add(Ship(100, 100, 0, 0, 10, 1, 0, program=Round((Skip(),))))).ticks
    assert needs(discs(200)).grid


def test_needs_no_grid_for_a_few() -> None:
    assert not needs(discs(GRID_FROM - 1)).grid


def test_an_engine_of_many_has_a_grid_and_one_of_few_has_none() -> None:
    assert Engine(discs(200)).grid.columns > 2
    assert Engine(discs(GRID_FROM - 1)).grid.columns == 1
    assert Engine(discs(200), LEAST).grid.columns == 1


def test_ranks_are_in_the_order_of_kinds() -> None:
    assert sorted([TICK, *WALLS, CONTACT]) == [CONTACT, *WALLS, TICK]
    assert list(WALLS.values()) == ["left", "right", "bottom", "top"]


# One owner.


def test_take_leaves_the_world_without_and_give_gives() -> None:
    world = discs(10)
    assert peek(world) is None
    engine = take(world)
    give(world, engine)
    assert peek(world) is engine
    assert take(world) is engine
    assert peek(world) is None
    assert take(world) is not engine


def test_the_engine_moves_on_with_the_newest_world() -> None:
    world = discs(10)
    first = evolve(world, 0.5)
    engine = peek(first)
    assert engine is not None
    assert peek(world) is None
    second = evolve(first, 0.5)
    assert peek(second) is engine
    assert peek(first) is None
    third = second.add(Asteroid(5, 5, 0, 0, 1))
    assert peek(third) is engine
    assert peek(second) is None


def test_worlds_do_not_share_a_box() -> None:
    assert World(1, 1)._box is not World(1, 1)._box


# It changes nothing.


@pytest.mark.parametrize("plan", [LEAST, MOST], ids=["all with all", "grid"])
@pytest.mark.parametrize("seed", range(6))
def test_any_plan_has_the_same_future(plan: Plan, seed: int) -> None:
    for world, until in ((discs(60, seed), 4.0), (battle(seed, thrust=seed % 2 == 0), 4.0)):
        log, after = unfold(world, until)
        assert len(log) > 30
        assert unfold(world, until, plan) == (log, after)


@pytest.mark.parametrize("seed", range(6))
def test_dropping_the_cache_at_any_moment_changes_nothing(seed: int) -> None:
    for world in (discs(60, seed), battle(seed, thrust=seed % 2 == 0)):
        log, after = unfold(world, 4.0)
        assert unfold(world, 4.0, drop=random.Random(seed)) == (log, after)


@pytest.mark.parametrize("seed", range(4))
def test_slicing_changes_nothing(seed: int) -> None:
    world = battle(seed, thrust=False)
    log, after = unfold(world, 4.0)
    rng = random.Random(seed)
    sliced: list[Happened] = []
    times = [rng.uniform(0, 4) for _ in range(9)] + [h.time for h in rng.sample(log, 5)]
    for time in [*sorted(times), 4.0]:
        some, world = unfold(world, time)
        sliced += some
    assert (sliced, world) == (log, after)


def test_two_futures_of_one_world_do_not_disturb_each_other() -> None:
    world = battle(1, thrust=True)
    expected = unfold(world, 3.0)
    one, two = happenings(world, 3.0), happenings(world, 3.0)
    logs: tuple[list[Happened], list[Happened]] = ([], [])
    rng = random.Random(0)
    for _ in range(10_000):
        k = rng.randrange(2)
        try:
            logs[k].append(next((one, two)[k])[0])
        except StopIteration:
            break
        if rng.random() < 0.1:
            evolve(world, rng.random())
    for k, unfolding in enumerate((one, two)):
        logs[k].extend(happened for happened, _ in unfolding)
    assert logs[0] == logs[1] == expected[0]


def test_any_past_state_can_be_evolved_again() -> None:
    world = battle(2, thrust=True)
    log, after = unfold(world, 3.0)
    past = [w for _, w in happenings(world, 3.0)]
    for k in range(0, len(past), 7):
        rest, end = unfold(past[k], 3.0)
        assert (log[: k + 1] + rest, end) == (log, after)


def test_an_interrupted_event_is_not_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C in the middle of an event: the same world, asked again, has the same future."""
    world = discs(30)
    expected = unfold(discs(30), 2.0)
    contact = rules.contact
    left = 3

    def interrupted(*given: Any) -> Any:
        nonlocal left
        left -= 1
        if left == 0:
            raise KeyboardInterrupt
        return contact(*given)

    monkeypatch.setattr(rules, "contact", interrupted)
    log: list[Happened] = []
    unfolding = happenings(world, 2.0)
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012
        while True:
            happened, world = next(unfolding)
            log.append(happened)
    assert log
    rest, end = unfold(world, 2.0)
    assert (log + rest, end) == expected


def test_births_beyond_what_the_grid_was_made_for_make_another() -> None:
    world = evolve(discs(20), 0.1)
    engine = peek(world)
    assert engine is not None
    before = engine.grid
    crowd = [Asteroid(3 + 7 * i, 3, 0, 0, 1) for i in range(30)]
    for rock in crowd:
        try:
            world = world.add(rock)
        except ValueError:
            continue
    assert peek(world) is engine
    assert engine.living == len(world) > 40
    assert engine.grid is not before
    assert unfold(world, 2.0) == unfold(world, 2.0, LEAST)


def test_a_wider_disc_than_any_before_is_met() -> None:
    world = evolve(World(1000, 1000).add_all(
        Asteroid(30 + 60 * (i % 16), 30 + 60 * (i // 16), 0, 0, 2) for i in range(64)
    ), 0.1)  # fmt: skip
    world = world.add(Asteroid(500, 700, 0, -100, 200))
    log, after = unfold(world, 10.0)
    assert len(log) > 5
    assert unfold(world, 10.0, LEAST) == (log, after)


# Its counters.


def test_ordinary_runs_ask_the_exact_formula_rarely() -> None:
    world = evolve(discs(100), 20.0)
    engine = peek(world)
    assert engine is not None
    assert engine.asked > 10_000
    assert engine.undecided < engine.asked / 1000


def test_hostile_runs_ask_the_exact_formula() -> None:
    """Ships in a row that pass rocks exactly tangent."""
    row = [Asteroid(100 + 100 * i, 130, 0, 0, 20) for i in range(5)]
    world = World(1000, 1000).add_all([Ship(50, 160, 100, 0, 10, 1, 0), *row])
    world = evolve(world, 1.0)
    engine = peek(world)
    assert engine is not None
    assert engine.undecided >= 5
    assert engine.undecided <= engine.asked
    assert len(evolve_until(world, 9.0)) == 6


def test_bent_contacts_that_need_exact_arithmetic_are_counted() -> None:
    """Two ships of one thrust, one of which passes the other exactly tangent."""
    still = Ship(500, 500, 0, 0, 10, 1e18, 0.0, thruster=True)
    passing = Ship(300, 520, 100, 0, 10, 1e18, 0.0, thruster=True)
    engine = Engine(World(1000, 1000, model="smooth").add_all([still, passing]))
    assert engine.undecided >= 1
    assert engine.undecided <= engine.asked


def test_thrusters_are_the_slots_of_ships_that_thrust() -> None:
    world = World(1000, 1000).add_all(
        [Asteroid(500, 500, 0, 0, 10), Ship(100, 100, 0, 0, 10, 1e30, 0)]
    )
    engine = take(world)
    assert engine.thrusters == set()
    give(world, engine)
    on = act(world, 2, Thrust())
    assert peek(on) is engine
    assert engine.thrusters == {on.slot_of(2)}
    off = on.remove(2)
    assert peek(off) is engine
    assert engine.thrusters == set()


def test_the_queue_stays_in_proportion_to_the_living() -> None:
    world = discs(50)
    worst = 0
    for _, after in happenings(world, 1e9, max_events=5000):
        engine = peek(after)
        assert engine is not None
        worst = max(worst, len(engine._heap))
    assert worst <= 20 * 50


def test_a_ship_too_slow_for_its_world_never_leaves_its_cell() -> None:
    rocks = [Asteroid(5e78 * (i + 0.5), 9e79, 0.0, 0.0, 1e78) for i in range(GRID_FROM)]
    ship = Ship(5.1e79, 5e79, 0.0, 0.0, 1e78, 5e15, 0.0, thruster=True, max_speed=1e-240)
    world = World(1e80, 1e80, model="smooth").add_all([*rocks, ship])
    assert [h.effect for h, _ in happenings(world, 1.0)] == ["reach"]
