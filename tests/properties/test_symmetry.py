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
from tests.properties.laws import EVENTS, scaled, with_clean_ties, world_law

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
        for h in with_clean_ties(unfold(world, events=EVENTS).log)
    ]
    with keeping("L5_symmetry_of_axes", world):
        actual = with_clean_ties(unfold(turned, events=EVENTS).log)
        assert by_instant(expected) == by_instant(actual)


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
        expected = map(rename, with_clean_ties(unfold(world, events=EVENTS).log))
        actual = with_clean_ties(unfold(renamed, events=EVENTS).log)
        assert by_instant(list(expected)) == by_instant([evolve(h, at=None) for h in actual])


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
        first_window = [h for h in unfold(world, until=1023.0, events=EVENTS).log]
        expected = [scaled(h, km, km / km_s) for h in first_window]
        actual = unfold(resized, until=1023.0, events=EVENTS).log
        common = min(len(expected), len(actual))
        assert expected[:common] == actual[:common]


def by_instant(log: list[Happened]) -> list[tuple[float, Counter[Happened]]]:
    """The events of each instant as a multiset, the last instant left out (it may be cut short)."""
    times = sorted({h.time for h in log})[:-1]
    return [(t, Counter(h for h in log if h.time == t)) for t in times]


def mirrored(world: World) -> World:
    return World(world.width, world.height).add_all(
        evolve(e, x=world.width - e.x, vx=-e.vx) for e in world.entities.values()
    )


OTHER_SIDE = {"left": "right", "right": "left", "bottom": "bottom", "top": "top", None: None}


@world_law
@given(worlds(kinds=(Ship, Asteroid), flavours=("ordinary", "dense", "thin"), min_size=1))
def test_L5_symmetry_of_mirror_images(world: World) -> None:
    assume(not any(e.max_speed < 3e5 for e in world.entities.values()))
    one, two = unfold(world, events=EVENTS), unfold(mirrored(world), events=EVENTS)
    size = max(world.width, world.height)
    with keeping("L5_symmetry_of_mirror_images", world):
        for n, (h, g) in enumerate(zip(one.log, two.log, strict=False)):
            apart = max(
                (
                    max(abs(a.x - (world.width - b.x)), abs(a.y - b.y))
                    for a, b in zip(
                        one.worlds[n].entities.values(), two.worlds[n].entities.values(), strict=False
                    )
                ),
                default=0.0,
            )
            same = (h.kind, h.entities, h.wall, h.effect) == (
                g.kind, g.entities, OTHER_SIDE[g.wall], g.effect,
            )  # fmt: skip
            if not same or apart > 2.0**36 * 2.0**-53 * size:
                break
        else:
            return
        if not same:
            # Only a near tie, or errors grown by 36 bits, may change the sequence.
            gap = abs(h.time - g.time)
            slowest = min((e.speed for e in world.entities.values() if e.speed), default=1.0)
            assert gap <= 2.0**36 * 2.0**-53 * size / slowest or apart > 2.0**36 * 2.0**-53 * size
