"""L5: swapping a pair, mirrors, quarter turns, renaming and powers of two change no bit."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from attrs import evolve
from hypothesis import assume, given
from hypothesis import strategies as st

from fasteroids import Asteroid, Happened, Ship, World
from fasteroids.entities import Entity
from fasteroids.models import MODELS
from fasteroids.physics import bounce
from fasteroids.testing import keeping, pairs, unfold, worlds
from tests.properties.laws import EVENTS, before_ties, scaled, world_law

Vector = tuple[float, float]
Map = Callable[[float, float], Vector]

PLANE: dict[str, Map] = {
    "negate x": lambda x, y: (-x, y),
    "negate y": lambda x, y: (x, -y),
    "quarter turn": lambda x, y: (-y, x),
    "swap axes": lambda x, y: (y, x),
}
numbers = st.floats(-1e100, 1e100)
masses = st.floats(1e-290, 1e290)


@given(pairs(), st.sampled_from(sorted(MODELS)))
def test_L5_symmetry_of_contact_times(pair: tuple[float, ...], model: str) -> None:
    time = MODELS[model].contact_time
    expected = time(*pair)
    assert expected == time(*pair[5:], *pair[:5])
    for turn in PLANE.values():
        i, j = pair[:5], pair[5:]
        turned = [(*turn(*d[:2]), *turn(*d[2:4]), d[4]) for d in (i, j)]
        assert expected == time(*turned[0], *turned[1])


@given(numbers, numbers, numbers, numbers, masses, numbers, numbers, masses)
def test_L5_symmetry_of_bounces(
    x: float, y: float, vxi: float, vyi: float, mi: float, vxj: float, vyj: float, mj: float
) -> None:
    after = bounce(x, y, vxi, vyi, mi, vxj, vyj, mj)
    assert (*after[2:], *after[:2]) == bounce(-x, -y, vxj, vyj, mj, vxi, vyi, mi)
    for turn in PLANE.values():
        expected = (*turn(*after[:2]), *turn(*after[2:]))
        assert expected == bounce(*turn(x, y), *turn(vxi, vyi), mi, *turn(vxj, vyj), mj)


def other_axes(e: Entity) -> Entity:
    return evolve(e, x=e.y, y=e.x, vx=e.vy, vy=e.vx)


calm = worlds(kinds=(Ship, Asteroid))  # no splits, shots or thrust
OTHER_WALL = {"left": "bottom", "right": "top", "bottom": "left", "top": "right", None: None}


@world_law
@given(calm)
def test_L5_symmetry_of_axes(world: World) -> None:
    turned = World(world.height, world.width).add_all(map(other_axes, world.entities.values()))
    expected = [
        evolve(h, wall=OTHER_WALL[h.wall], at=h.at and h.at[::-1])
        for h in before_ties(world, unfold(world, events=EVENTS))
    ]
    with keeping("L5_symmetry_of_axes", world):
        same_instants(expected, unfold(turned, events=EVENTS).log)


@world_law
@given(calm, st.randoms(use_true_random=False))
def test_L5_symmetry_of_names(world: World, random: object) -> None:
    order = list(world.entities)
    random.shuffle(order)  # type: ignore[attr-defined]
    renamed = World(world.width, world.height).add_all(evolve(world[i], id=None) for i in order)
    new = {old: i for i, old in enumerate(order, 1)}

    def rename(h: Happened) -> Happened:
        return evolve(
            h,
            entities=tuple(sorted(new[i] for i in h.entities)),
            died=tuple(sorted(new[i] for i in h.died)),
            clipped=tuple(sorted(new[i] for i in h.clipped)),
            at=None,  # the same point, seen from the other disc: not the same bits
        )

    with keeping("L5_symmetry_of_names", world):
        expected = [rename(h) for h in before_ties(world, unfold(world, events=EVENTS))]
        actual = [evolve(h, at=None) for h in unfold(renamed, events=EVENTS).log]
        same_instants(expected, actual)


@world_law
@given(
    worlds(kinds=(Ship, Asteroid), flavours=("ordinary", "dense", "thin", "touching", "twins")),
    st.integers(-20, 20),
    st.integers(-20, 0),
)
def test_L5_symmetry_of_units(world: World, length: int, speed: int) -> None:
    km, km_s = 2.0**length, 2.0**speed
    resized = World(world.width * km, world.height * km).add_all(
        evolve(
            e,
            x=e.x * km,
            y=e.y * km,
            radius=e.radius * km,
            vx=e.vx * km_s,
            vy=e.vy * km_s,
            max_speed=e.max_speed * km_s,
        )
        for e in world.entities.values()
    )
    with keeping("L5_symmetry_of_units", world):
        first_window = list(unfold(world, until=1023.0, events=EVENTS).log)
        expected = [scaled(h, km, km / km_s) for h in first_window]
        actual = unfold(resized, until=1023.0, events=EVENTS).log
        common = min(len(expected), len(actual))
        assert expected[:common] == actual[:common]


def same_instants(expected: list[Happened], actual: list[Happened]) -> None:
    """The same events at each instant, in any order; the last instants may be cut short."""
    times = sorted({h.time for h in expected})[:-1]
    for time in times:
        assert Counter(h for h in expected if h.time == time) == Counter(
            h for h in actual if h.time == time
        )


def mirrored(world: World) -> World:
    return World(world.width, world.height).add_all(
        evolve(e, x=world.width - e.x, vx=-e.vx) for e in world.entities.values()
    )


GROWN = 2.0**36 * 2.0**-53
OTHER_SIDE = {"left": "right", "right": "left", "bottom": "bottom", "top": "top", None: None}


def distance_when(
    time: float, p: Entity, q: Entity, since_p: float, since_q: float, width: float
) -> float:
    """How far apart (km) an entity and its mirror image are at a time: an error of a velocity grows until then."""
    t, u = time - since_p, time - since_q
    x, y = p.x + p.vx * t, p.y + p.vy * t
    return max(abs(x - (width - q.x - q.vx * u)), abs(y - q.y - q.vy * u))


@world_law
@given(worlds(kinds=(Ship, Asteroid), flavours=("ordinary", "dense", "thin"), min_size=1))
def test_L5_symmetry_of_mirror_images(world: World) -> None:
    assume(not any(e.max_speed < 3e5 for e in world.entities.values()))
    one, two = unfold(world, events=EVENTS), unfold(mirrored(world), events=EVENTS)
    size = max(world.width, world.height)
    slowest = min((e.speed for e in world.entities.values() if e.speed), default=1.0)
    for n, (h, g) in enumerate(zip(one.log, two.log, strict=False)):
        if (h.kind, h.entities, h.wall, h.effect) != (
            g.kind,
            g.entities,
            OTHER_SIDE[g.wall],
            g.effect,
        ):
            a, b = (one.worlds[n - 1], two.worlds[n - 1]) if n else (world, mirrored(world))
            apart = max(
                distance_when(min(h.time, g.time), p, q, a.time, b.time, world.width)
                for p, q in zip(a.entities.values(), b.entities.values(), strict=True)
            )
            with keeping("L5_symmetry_of_mirror_images", world):
                # Only a near tie, or errors grown by 36 bits, may change the sequence.
                near_tie = abs(h.time - g.time) <= GROWN * size / slowest
                assert near_tie or apart > GROWN * size
            return
