"""`fasteroids explain`: the parts of the model a scene needs, and the level it asks for."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from fasteroids import Asteroid, Bullet, Ship, World, dump_scene
from fasteroids.cli.explain import advice, plan, thrust_rules
from fasteroids.engine import GRID_FROM
from fasteroids.testing.scripts import Script

Call = Callable[..., Result]


def ship(x: float, **settings: object) -> Ship:
    return Ship(x, 50.0, 10.0, 0.0, 5.0, 5e15, 0.0, **settings)  # type: ignore[arg-type]


def test_tells_the_plan(call: Call, scene: str) -> None:
    shown = call("explain", scene)
    assert shown.exit_code == 0
    assert shown.stderr == ""
    told = " ".join(shown.stdout.split())
    assert "scene.toml: 2 ships, 1 asteroid and 1 bullet in 400 x 200 km; seed 4" in told
    assert "model robust: hit or miss is decided right for all doubles" in told
    assert f"grid left out: 4 entities: with fewer than {GRID_FROM}" in told
    assert "thrust left out: no ship's thruster is on" in told
    assert "bullets used: in flight: bullet #4" in told
    assert "ticks left out: no ship runs a program" in told
    assert "spec would do" in told
    assert all(len(line) <= 100 for line in shown.stdout.splitlines())


def test_json(call: Call, busy: str) -> None:
    record = json.loads(call("explain", busy, "--json", "--model", "spec", "--seed", "5").stdout)
    assert record["scene"] == "busy.toml"
    assert record["seed"] == 5
    assert record["model"]["name"] == "spec"
    assert "formulas of the text" in record["model"]["promise"]
    assert {name: part["used"] for name, part in record["parts"].items()} == {
        "grid": True, "thrust": False, "bullets": False, "ticks": False,
    }  # fmt: skip
    assert "cells" in record["parts"]["grid"]["why"]
    assert record["level"]["advised"] == "spec"
    assert record["level"]["why"]


def test_names_who_asks_for_a_part() -> None:
    ships = [ship(20.0 * i + 20.0, thruster=True) for i in range(GRID_FROM)]
    pilot = ship(300.0, name="ace", program=Script((None,)))
    world = World(400.0, 100.0).add_all([*ships, pilot])
    parts = plan(world)
    assert parts["thrust"].used
    assert parts["thrust"].why == (
        "the thruster is on: ship #1, ship #2, ship #3, ship #4, ship #5 and 5 more"
    )
    assert parts["ticks"].used
    assert parts["ticks"].why == "a program runs: ace"
    assert parts["grid"].used


def test_discs_too_wide_for_cells() -> None:
    giant = Asteroid(110.0, 45.0, 0.0, 0.0, 40.0, name="Vesta")
    dust = [Asteroid(5.0 + 5.0 * i, 95.0, 1.0, 0.0, 1.0) for i in range(GRID_FROM)]
    part = plan(World(150.0, 100.0).add_all([giant, *dust]))["grid"]
    assert not part.used
    assert "Vesta, 2 r = 80 km" in part.why


@pytest.mark.parametrize(
    ("world", "level", "reason"),
    [
        (World(10.0, 10.0), "spec", "nothing to collide with"),
        (World(200.0, 100.0).add_all([ship(50.0), ship(150.0)]), "spec", "decides all but grazing"),
        (World(1e9, 1e9).add_all([ship(50.0), ship(150.0)]), "robust", "as long as the smallest"),
        (
            World(1e140, 1e140).add_all(
                [
                    Asteroid(3e139, 3e139, 1e3, 0.0, 1e139),
                    Asteroid(7e139, 7e139, 1e3, 0.0, 1e139),
                ]
            ),
            "robust",
            "lengths times speeds",
        ),
        (
            World(200.0, 100.0).add_all(
                [ship(50.0), Ship(150.0, 50.0, 0.0, 0.0, 5.0, 1e-290, 0.0)]
            ),
            "robust",
            "masses of ships",
        ),
    ],
)
def test_advice(world: World, level: str, reason: str) -> None:
    found = advice(world)
    assert found.level == level
    assert reason in " ".join(found.why)


def test_bullets_need_their_rules() -> None:
    assert plan(World(99.0, 99.0).add(Bullet(50.0, 50.0, 0.0, 0.0, 3.0, 7)))["bullets"].used


def test_says_when_the_rules_of_thrust_differ() -> None:
    empty = World(400.0, 100.0)
    assert "no ship" in thrust_rules(empty)
    assert "until a player" in thrust_rules(empty.add(ship(20.0)))
    assert "until a program switches a thruster on: ace" in thrust_rules(
        empty.add(ship(20.0, name="ace", program=Script((None,))))
    )
    burning = thrust_rules(empty.add(ship(20.0, name="ace", thruster=True)))
    assert "from the start" in burning
    assert "ace" in burning
    assert "22 km behind for each second below its speed limit" in burning
    idle = thrust_rules(empty.add(ship(20.0, name="ace", thruster=True, thrust_power=0.0)))
    assert "differ by rounding alone until a thruster with power is switched on" in idle
    assert "has no power: ace" in idle


@pytest.mark.parametrize(("size", "ratio"), [(666.6667, "67"), (12345.0, "1200"), (1e9, "1e+08")])
def test_ratios_have_two_digits(size: float, ratio: str) -> None:
    why = advice(World(size, size).add_all([ship(50.0), ship(150.0)])).why
    assert f"the world is {ratio} times as long" in " ".join(why)


@pytest.mark.parametrize(
    ("size", "model", "verdict"),
    [
        (200.0, "spec", "spec is enough:"),
        (200.0, "robust", "spec would do, robust is on the safe side:"),
        (200.0, "smooth", "smooth is on the safe side; spec would decide as well, but its rule of thrust is literal:"),
        (1e9, "spec", "robust is advised:"),
        (1e9, "robust", "robust is enough:"),
        (1e9, "smooth", "smooth is enough:"),
    ],
)  # fmt: skip
def test_the_verdict_knows_that_smooth_decides_as_robust(
    call: Call, tmp_path: Path, size: float, model: str, verdict: str
) -> None:
    world = World(size, size, model=model).add_all([ship(50.0), ship(150.0)])
    scene = tmp_path / "scene.toml"
    scene.write_text(dump_scene(world), encoding="utf-8")
    assert f"level {verdict}" in " ".join(call("explain", str(scene)).stdout.split())
