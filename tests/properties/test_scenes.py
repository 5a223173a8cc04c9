"""Scenes: what is written comes back, with the same future, bit for bit."""

from __future__ import annotations

from math import inf, nextafter

from attrs import evolve as with_fields
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Asteroid, Ship, World, act, evolve
from fasteroids.actions import Action
from fasteroids.entities import id_of
from fasteroids.moments import between, clock_at
from fasteroids.overlap import depth, overhang
from fasteroids.scene import Problem, SceneError, dump_scene, load_scene
from fasteroids.state import replaced
from fasteroids.testing import Script, actions, keeping, unfold, worlds
from tests.properties.laws import EVENTS, same, world_law

STARTS = st.sampled_from([0.0, 0.0, 5000.3, 1e9 + 0.7, 1e300])
"""Seconds: when a world begins. The later, the coarser its clock."""

SEEDS = st.integers(-(2**63), 2**63 - 1)


def begun_at(world: World, time: float) -> World:
    """A world like this one, everything in it added at a time (s)."""
    empty = World(world.width, world.height, world.seed, world.model, clock=clock_at(time))
    return empty.add_all(world.entities.values())


def check_round_trip(world: World) -> World:
    """Writing and reading gives an equal world, the same bits in it, and the same text again."""
    text = dump_scene(world)
    back = load_scene(text)
    assert back == world
    assert repr(back.all_flights()) == repr(world.all_flights())  # tells 0.0 from -0.0
    assert back.clock == world.clock
    assert back.roster.next_id == world.roster.next_id
    assert dump_scene(back) == text
    return back


@world_law
@given(worlds(thrusters=True), STARTS, st.integers(0, EVENTS))
def test_scene_of_a_world_just_after_an_event(world: World, start: float, events: int) -> None:
    world = unfold(begun_at(world, start), events=events).end
    back = check_round_trip(world)
    same(unfold(world, events=EVENTS), unfold(back, events=EVENTS))


@world_law
@given(worlds(), STARTS, st.integers(0, EVENTS), st.integers(1, 3))
def test_scene_of_a_world_between_events(
    world: World, start: float, events: int, steps: int
) -> None:
    world = begun_at(world, start)
    *_, before, after = [world, world, *unfold(world, events=events).worlds]
    gap = between(before.now, after.now)
    if gap > 0.0:
        for _ in range(steps):  # the sum of the steps leaves a residue on the clock
            before = evolve(before, 0.3 * gap)
    back = check_round_trip(before)
    same(unfold(before, events=EVENTS), unfold(back, events=EVENTS))


@world_law
@given(worlds(min_size=1, kinds=(Ship, Asteroid)), st.lists(actions(), max_size=8), st.data())
def test_scene_of_a_world_that_was_played(
    world: World, moves: list[Action], data: st.DataObject
) -> None:
    for move in moves:
        ships = [i for i, e in world.entities.items() if isinstance(e, Ship)]
        if not ships:
            break
        world = act(world, data.draw(st.sampled_from(ships)), move)
        world = unfold(world, events=data.draw(st.integers(0, 4))).end
    back = check_round_trip(world)
    same(unfold(world, events=EVENTS), unfold(back, events=EVENTS))


@world_law
@given(worlds(model="spec"), STARTS, st.integers(0, EVENTS))
def test_scene_of_a_world_whose_model_promises_little(
    world: World, start: float, events: int
) -> None:
    world = unfold(begun_at(world, start), events=events).end
    back = check_round_trip(world)
    same(unfold(world, events=EVENTS), unfold(back, events=EVENTS))


@world_law
@given(worlds(), st.data())
def test_scene_of_a_world_with_gaps_and_names(world: World, data: st.DataObject) -> None:
    names = st.one_of(st.none(), st.sampled_from(['"', "\\", "é ☃", "'''", "a # b", "[world]"]))
    named = World(world.width, world.height, data.draw(SEEDS))
    for entity_id, e in world.entities.items():
        named = named.add(with_fields(e, name=data.draw(names), id=3 * entity_id))
    for entity_id in data.draw(st.lists(st.sampled_from([0, *named.entities]), unique=True)):
        named = named.remove(entity_id) if entity_id else named
    check_round_trip(named)


# Fields of asteroids.

FIELD = """
[world]
width = {width!r}
height = 500
seed = {seed}

[[ship]]
x = {x!r}
y = 250.0
radius = 20
mass = 1e15

[[asteroid-field]]
count = {count}
radius = [{low!r}, 15]
speed = [10, 50]
clear = {clear!r}
"""


def field(**changed: object) -> World:
    """A world with a field of asteroids."""
    usual = {"width": 800.0, "seed": 1, "x": 400.0, "count": 40, "low": 5.0, "clear": 30.0}
    return load_scene(FIELD.format(**{**usual, **changed}))


@given(st.floats(700.0, 1e6), SEEDS, st.integers(1, 60), st.floats(0.1, 15.0), st.floats(0, 60))
def test_a_field_is_inside_apart_and_clear(
    width: float, seed: int, count: int, low: float, clear: float
) -> None:
    world = field(width=width, seed=seed, count=count, low=low, clear=clear)
    (ship,), asteroids = world.ships, world.asteroids
    assert len(asteroids) == count
    for i, a in enumerate(asteroids):
        assert low <= a.radius <= 15.0
        assert 9.999 < a.speed < 50.001
        assert overhang(a, width, 500.0) <= 0.0
        assert -depth(a, ship) >= clear
        assert all(depth(a, b) <= 0.0 for b in asteroids[:i])


@given(SEEDS, st.floats(100.0, 700.0), st.floats(100.0, 700.0))
def test_moving_a_ship_changes_the_luck_of_few(seed: int, x1: float, x2: float) -> None:
    one, other = (field(seed=seed, x=x, count=15).asteroids for x in (x1, x2))
    luck = [(a.radius, a.vx, a.vy) for a in one]
    assert luck == [(a.radius, a.vx, a.vy) for a in other]
    ships = [field(seed=seed, x=x, count=1).ships[0] for x in (x1, x2)]
    for a, b in zip(one, other, strict=True):
        near = [e for e in (a, b) for ship in ships if -depth(e, ship) < 30.0]
        crowded = [c for c in (*one, *other) for e in (a, b) if depth(c, e) > 0 and c not in (a, b)]
        assert a == b or near or crowded


# Any text.

_TABLES = ["[world]", "[[ship]]", "[[asteroid]]", "[[bullet]]", "[[asteroid-field]]", "[x]"]
_KEYS = ["x", "y", "vx", "radius", "mass", "id", "since", "time", "width", "height", "source"]
_VALUES = ["1", "2.5", "1e400", "inf", "nan", "-1", "true", '"a"', "[1, 2]", "{}", "1979-05-27"]
_SIGNS = ["'''", '"""', "'", '"', "[", "]", "{", "}", "#", ".", ",", "\\", "\r", "\x00", "é"]
_WORDS = st.sampled_from([*_TABLES, *_KEYS, *_VALUES, *_SIGNS, *["=", "\n"] * 12])
TEXTS = st.one_of(
    st.text(max_size=60),
    st.lists(_WORDS, max_size=40).map(" ".join),
    st.lists(_WORDS, max_size=40).map("".join),
)


@given(TEXTS)
def test_any_text_is_a_world_or_a_list_of_problems(text: str) -> None:
    check_text(text)


OTHER = st.sampled_from(
    ["0.0", "-1.0", "1e-300", "1e-160", "1e-10", "1e160", "1.7e308", "nan", "-inf", "300000.0"]
)
"""Numbers that a file may have in the place of those it has."""


@world_law
@given(worlds(min_size=1, thrusters=True, model="smooth"), st.integers(0, 9), st.data())
def test_other_numbers_are_a_world_or_a_list_of_problems(
    world: World, events: int, data: st.DataObject
) -> None:
    """A few numbers of a file changed, or a ship said to leave its limit."""
    lines = dump_scene(unfold(world, events=events).end).split("\n")
    numbers = [i for i, line in enumerate(lines) if " = " in line]
    for i in data.draw(st.lists(st.sampled_from(numbers), max_size=2)):
        lines[i] = f"{lines[i].partition(' = ')[0]} = {data.draw(OTHER)}"
    if "[[ship]]" in lines and data.draw(st.booleans()):
        lines.insert(lines.index("[[ship]]") + 1, "slowing = true")
    check_text("\n".join(lines))


@world_law
@given(worlds(min_size=1, thrusters=True, model="smooth"), st.integers(0, EVENTS))
def test_a_scene_that_leaves_out_an_event_is_refused(world: World, events: int) -> None:
    """The flights from before an event, with the time of it, and with the first time after it."""
    world = unfold(world, events=events).end
    run = unfold(world, events=1)
    for after, time in zip(run.worlds, run.times, strict=True):
        due, late = (
            dump_scene(replaced(world, clock, (), (), ()))
            for clock in ((*after.now, 0.0), clock_at(nextafter(time, inf)))
        )
        assert tried(due)[1] == ()
        assert tried(late)[0] is None


def check_text(text: str) -> None:
    """A text is a world, which is written and read back, or each of its problems is told on a line of it."""
    world, problems, message = tried(text)
    if world is None:
        assert problems
        assert message.split("\n") == [str(problem) for problem in problems]
        assert all(p.line is None or 1 <= p.line <= text.count("\n") + 1 for p in problems)
    else:
        assert load_scene(dump_scene(world)) == world


def tried(text: str) -> tuple[World | None, tuple[Problem, ...], str]:
    """The world in a text, or the problems with it."""
    try:
        return load_scene(text), (), ""
    except SceneError as error:
        return None, error.problems, str(error)


@world_law
@given(worlds(programs=True, thrusters=True, model="smooth", max_size=5), st.integers(0, 20))
def test_L12_a_saved_world_has_the_same_future(world: World, events: int) -> None:
    """Programs included, and also between two events of one moment, with the ticks of that moment to come."""
    for ship in world.ships:
        if isinstance(ship.program, Script):  # no text
            world = world.remove(id_of(ship))
    world = unfold(world, events=events).end
    with keeping("L12_a_saved_world", world):
        back = load_scene(dump_scene(world))
        assert back == world
        same(unfold(world, events=20), unfold(back, events=20))
