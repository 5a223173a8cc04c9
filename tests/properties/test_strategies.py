"""The strategies have tests of their own: what they promise, and that they reach what makes worlds hard."""

from __future__ import annotations

import itertools
from math import inf, isinf
from pathlib import Path

import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

from fasteroids import Asteroid, Bullet, Ship, World, load_scene, time_to_contact
from fasteroids.overlap import depth
from fasteroids.physics import UNDECIDED, contact_time_filtered
from fasteroids.testing import (
    Script,
    actions,
    discs,
    failures,
    formations,
    keeping,
    pairs,
    scripts,
    unfold,
    worlds,
)
from fasteroids.testing.strategies import FLAVOURS
from fasteroids.units import SPEED_OF_LIGHT
from tests.properties.laws import world_law

search = settings(max_examples=2_000, derandomize=True, database=None)
glance = settings(search, phases=(Phase.generate,))  # one will do, it need not be small


def exists(strategy: st.SearchStrategy, condition: object) -> None:
    find(strategy, condition, settings=glance)  # type: ignore[arg-type]


@world_law
@given(worlds(thrusters=True, programs=True))
def test_worlds_are_valid(world: World) -> None:
    assert 0 <= len(world) <= 30
    assert list(range(1, len(world) + 1)) == list(world.entities)
    empty = World(world.width, world.height, world.seed, fuel=world.fuel)
    assert world == empty.add_all(world.entities.values())


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_worlds_come_in_all_sizes_and_move(flavour: str) -> None:
    some = worlds(flavours=[flavour])
    exists(some, lambda w: len(w) == 0)
    exists(some, lambda w: len(w) >= 20)
    exists(some, lambda w: any(h.kind == "contact" for h in unfold(w, events=20).log))
    exists(some, lambda w: any(h.kind == "wall" for h in unfold(w, events=20).log))


def test_formations_press_graze_and_reach_their_limit() -> None:
    for what in ("press", "reach", "leave"):
        exists(formations(), lambda w: any(h.effect == what for h in unfold(w, events=20).log))  # noqa: B023
    exists(formations(), lambda w: not unfold(w, events=1).log)
    assert len(find(formations(), lambda _: True, settings=search)) == 2


def test_worlds_shrink_to_nothing() -> None:
    assert len(find(worlds(), lambda _: True, settings=search)) == 0
    smallest = find(worlds(), lambda w: len(w.ships) > 0, settings=search)
    assert len(smallest) == 1
    assert smallest.ships[0].velocity == (0.0, 0.0)


def test_worlds_touch_at_the_start() -> None:
    some = worlds(flavours=["touching"], min_size=4)
    exists(some, lambda w: touching(w) >= 3)
    exists(some, lambda w: any(h.time == 0.0 for h in unfold(w, events=5).log))


def touching(world: World) -> int:
    all_ = list(world.entities.values())
    return sum(depth(a, b) == 0.0 for i, a in enumerate(all_) for b in all_[:i])


def test_worlds_have_exact_ties() -> None:
    def tie(world: World) -> bool:
        log = unfold(world, events=20).log
        return any(
            a.time == b.time and a.entities != b.entities for a, b in itertools.pairwise(log)
        )

    def corner(world: World) -> bool:
        log = unfold(world, events=20).log
        return any(
            a.time == b.time and a.entities == b.entities and a.kind == b.kind == "wall"
            for a, b in itertools.pairwise(log)
        )

    exists(worlds(flavours=["twins"]), tie)
    exists(worlds(flavours=["corners"]), corner)


def test_worlds_go_to_extremes() -> None:
    some = worlds(flavours=["extreme"], min_size=2)
    exists(some, lambda w: 0 < w.width < 1e-140)
    exists(some, lambda w: w.width > 1e140)
    exists(
        some,
        lambda w: any(s.mass < 1e-280 for s in w.ships) and any(s.mass > 1e280 for s in w.ships),
    )
    exists(some, lambda w: any(e.speed > 0.99 * SPEED_OF_LIGHT for e in w.entities.values()))
    exists(some, lambda w: any(h.kind == "contact" for h in unfold(w, events=10).log))
    exists(some, lambda w: any(s.thrust_power / s.mass == inf for s in w.ships))
    exists(some, lambda w: any(s.thrust_power / s.mass < 1e-300 for s in w.ships))


def test_worlds_clip_split_fire_and_thrust() -> None:
    some = worlds(thrusters=True, programs=True, min_size=2)
    exists(some, lambda w: any(h.clipped for h in unfold(w, events=30).log))
    exists(some, lambda w: any(h.effect == "split" for h in unfold(w, events=30).log))
    exists(some, lambda w: any(h.effect == "fire" and h.born for h in unfold(w, events=30).log))
    exists(some, lambda w: any(h.effect == "fire" and h.died for h in unfold(w, events=30).log))
    exists(some, lambda w: any(h.effect == "thrust" for h in unfold(w, events=30).log))
    exists(some, lambda w: any(s.thruster for s in w.ships))


def test_pairs_hit_miss_graze_and_overlap() -> None:
    exists(pairs(), lambda p: isinf(contact_time_filtered(*p)))
    exists(pairs(), lambda p: 0.0 < contact_time_filtered(*p) < 1e300)
    exists(pairs(), lambda p: contact_time_filtered(*p) == 0.0)
    exists(pairs(), lambda p: contact_time_filtered(*p) != contact_time_filtered(*p))
    assert UNDECIDED != UNDECIDED


@given(st.sampled_from([Ship, Asteroid, Bullet]).flatmap(discs), discs())
def test_discs_are_what_constructors_take(a: Ship, b: Ship) -> None:
    assert a.speed <= a.max_speed
    assert time_to_contact(a, b) >= 0.0


@given(scripts(), scripts(thrust=False), actions(thrust=False))
def test_scripts_run_out(any_: Script, calm: Script, action: object) -> None:
    assert any_.running
    assert not Script(()).running
    assert {type(a).__name__ for a in (*calm.actions, action)} <= {
        "Skip",
        "Fire",
        "Turn",
        "NoneType",
    }


def test_a_failing_world_is_kept_as_a_scene(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(failures, "FOLDER", tmp_path / "failures")
    program = Script((None,))
    world = World(100, 100, 7).add(Ship(50, 50, 1, 2, 5, 1e15, 0, program=program, name="red"))
    with pytest.raises(ZeroDivisionError), keeping("some_law", world):
        raise ZeroDivisionError
    text = (tmp_path / "failures" / "some_law.toml").read_text()
    assert text.startswith("# ship 1 runs Script(actions=(None,))\n")
    kept = load_scene(text)
    assert [ship.program for ship in kept.ships] == [None]
    assert world[1].position == kept[1].position
    with keeping("fine", world):
        pass
    assert not (tmp_path / "failures" / "fine.toml").exists()
