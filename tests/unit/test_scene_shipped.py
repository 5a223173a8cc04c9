"""The scenes that come with the package, the schema, and the guide."""

from __future__ import annotations

import json
import re
import tomllib
from math import cos, pi
from pathlib import Path

import pytest
from attrs import fields as fields_of
from jsonschema import Draft202012Validator

from fasteroids import Asteroid, Bullet, Fire, Ship, World, act, evolve, happenings
from fasteroids.models import MODELS
from fasteroids.scene import dump_scene, load_scene
from fasteroids.testing import unfold
from tests.unit.making import BOX, ROCK, SHIP, SHOT, problems

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "fasteroids" / "scenes"
SHIPPED = sorted(path.name for path in SCENES.glob("*.toml"))
SCHEMA = json.loads((SCENES / "scene.schema.json").read_text(encoding="utf-8"))
GUIDE = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")


def shipped(name: str) -> World:
    """A scene that comes with the package."""
    return load_scene((SCENES / name).read_text(encoding="utf-8"))


def faults(text: str) -> list[str]:
    """What the schema has against a scene."""
    document = tomllib.loads(text)
    return [error.message for error in Draft202012Validator(SCHEMA).iter_errors(document)]


def test_scenes_that_come_with_the_package() -> None:
    assert SHIPPED == [
        "default.toml", "duel.toml", "field-2013.toml", "field-storm.toml", "gas.toml",
        "one-on-one.toml", "pilot.toml",
        "squeeze.toml", "thrust.toml",
    ]  # fmt: skip


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenes_run_and_come_back(name: str) -> None:
    world = shipped(name)
    after = unfold(world, until=20.0)
    assert after.log
    assert load_scene(dump_scene(after.end)) == after.end


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenes_keep_to_the_schema(name: str) -> None:
    assert faults((SCENES / name).read_text(encoding="utf-8")) == []
    assert faults(dump_scene(unfold(shipped(name), until=7.3).end)) == []


def test_default_scene_shows_everything() -> None:
    run = unfold(shipped("default.toml"), until=20.0)
    assert {(h.kind, h.effect) for h in run.log} == {
        ("contact", "bounce"), ("contact", "die"), ("contact", "split"), ("wall", "bounce"),
    }  # fmt: skip
    assert {h.wall for h in run.log} == {None, "left", "right", "bottom", "top"}
    assert [ship.name for ship in run.worlds[0].ships] == ["Vega", "Altair"]
    assert len(run.end.ships) == 1


def test_squeeze_counts_the_digits_of_pi() -> None:
    count = 0
    for happened, _ in happenings(shipped("squeeze.toml"), 100.0):
        if happened.wall == "right":
            break
        count += happened.kind == "contact" or happened.wall == "left"
    assert count == int(pi * 100)


def test_the_pilot_clears_its_field() -> None:
    run = unfold(shipped("pilot.toml"), until=120.0)
    assert [ship.name for ship in run.end.ships] == ["pilot"]
    assert run.end.asteroids == ()
    assert not any(h.effect in ("halt", "fuel") for h in run.log)


def test_duel_is_its_own_mirror_image() -> None:
    world = shipped("duel.toml")
    discs = {(e.x, e.y, e.vx, e.vy, e.radius) for e in world.entities.values()}
    assert discs == {(world.width - x, y, -vx, vy, r) for x, y, vx, vy, r in discs}
    west, east = world.ships
    assert cos(west.direction) == -cos(east.direction)


def test_thrust_scene_thrusts() -> None:
    run = unfold(shipped("thrust.toml"), until=20.0)
    burning, drifting = run.end.ships
    assert max(world.ships[0].speed for world in run.worlds) == pytest.approx(250.0)
    assert burning.thruster
    assert drifting.speed == pytest.approx(50.0)
    assert len([h for h in run.log if h.entities == (3,)]) == 20


def test_schema_is_one() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert SCHEMA["properties"]["world"]["properties"]["model"]["enum"] == sorted(MODELS)


def test_schema_accepts_what_is_dumped() -> None:
    world = World(1e5, 1e5, clock=(5, 0.1, 1e-14)).add_all([
        Ship(100, 100, 1, 2, 10, 1e15, 0, thruster=True, max_speed=9.0, thrust_power=5.0, name="a"),
        Asteroid(300, 100, 1, 2, 9, max_speed=8.0, id=5),
    ])  # fmt: skip
    world = evolve(act(world, 1, Fire()), 3.0)
    assert faults(dump_scene(world)) == []


@pytest.mark.parametrize(
    "text",
    [
        "", "world = 3", "[world]\nwidth = 1", BOX + "depth = 1", BOX + "time = -1",
        BOX + "time = inf", BOX + "time = [1]", BOX + "time = [1, 1024]", BOX + "seed = 1.5",
        BOX + "model = 'robst'", BOX + "next_id = 0", BOX + "[ship]", BOX + "[[shp]]\nx = 1",
        BOX + SHIP + "program = ''", BOX + SHIP + "thruster = 1", BOX + SHIP + "max_speed = 300001",
        BOX + SHIP + "thrust_power = -1", BOX + SHIP + "since = '1'", BOX + SHIP + "bounced = true",
        BOX + SHIP.replace("10\n", "0\n"), BOX + SHIP.replace("mass", "masse"),
        BOX + SHIP.replace("'red'", "''"), BOX + ROCK + "id = 0", BOX + ROCK + "mass = 1",
        BOX + ROCK + "bounced_off = -1", BOX + ROCK.replace("300", "1979-05-27"),
        BOX + ROCK.replace("300", "true"), BOX + ROCK.replace("300", "inf"),
        BOX + SHOT.replace("'red'", "0"), BOX + SHOT.replace("source", "sauce"),
        BOX + "[[asteroid-field]]\ncount = 0\nradius = 1",
        BOX + "[[asteroid-field]]\ncount = 10001\nradius = 1",
        BOX + "[[asteroid-field]]\ncount = 1\nradius = [1]",
        BOX + "[[asteroid-field]]\ncount = 1\nradius = 1\nspeed = -1",
    ],
)  # fmt: skip
def test_schema_and_loader_refuse_the_same(text: str) -> None:
    assert faults(text)
    assert problems(text)


def test_guide_has_an_example_that_loads() -> None:
    (example,) = re.findall(r"```toml\n(.*?)```", GUIDE, re.DOTALL)
    world = load_scene(example)
    assert [ship.name for ship in world.ships] == ["red", "blue"]
    assert len(world.asteroids) == 9
    assert faults(example) == []
    assert unfold(world, until=20.0).log


def test_guide_names_every_field() -> None:
    tables = SCHEMA["properties"]
    fields = set(tables["world"]["properties"])
    for name in ("ship", "asteroid", "bullet", "asteroid-field"):
        fields |= set(tables[name]["items"]["properties"])
    described = set()
    for row in re.findall(r"^\| (`.*?) \|", GUIDE, re.MULTILINE):
        described |= set(re.findall(r"`([\w-]+)`", row))
    assert described == fields


def test_schema_names_the_fields_of_the_constructors() -> None:
    flight = {"since", "bounced_off"}
    for name, kind in (("ship", Ship), ("asteroid", Asteroid), ("bullet", Bullet)):
        fields = {a.name for a in fields_of(kind)}
        own = (
            {"slowing", "program-text", "program-state", "program-tick"} if kind is Ship else set()
        )
        assert set(SCHEMA["properties"][name]["items"]["properties"]) == fields | flight | own
