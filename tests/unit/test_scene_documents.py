"""Worlds as documents of plain tables, entities and programs as rows, and what a reader refuses of them."""

from __future__ import annotations

import json
from typing import Any

import pytest

from fasteroids import (
    Asteroid,
    Bullet,
    ModelError,
    Ship,
    World,
    dump_scene,
    evolve,
    load_scene,
)
from fasteroids.entities import Entity
from fasteroids.scene import (
    SceneError,
    document,
    entity_of,
    entity_row,
    program_in,
    program_row,
    world_of,
)
from tests.unit.making import Script, machine, rock, ship, shot
from tests.unit.making import world_of as world_with

TURN = "turn 1;\nfire;"


def through_json(value: Any) -> Any:
    return json.loads(json.dumps(value, allow_nan=False))


def wrong(*args: Any, of: Any = world_of, **named: Any) -> list[str]:
    """The problems with a document or a row."""
    with pytest.raises(SceneError) as caught:
        of(*args, **named)
    assert all(problem.line is None for problem in caught.value.problems)
    return list(map(str, caught.value.problems))


# Worlds.


def test_a_document_has_the_tables_of_the_scene_file() -> None:
    world = world_with(ship(100, 100, program=machine(TURN)), rock(500, 500), shot(300, 300))
    tables = document(world)
    assert list(tables) == ["world", "ship", "asteroid", "bullet"]
    assert tables["ship"][0]["program-text"] == TURN
    assert tables["asteroid"] == [{"x": 500.0, "y": 500.0, "vx": 0.0, "vy": 0.0, "radius": 20.0}]
    assert document(World(10.0, 20.0)) == {"world": {"width": 10.0, "height": 20.0}}
    assert world_of(through_json(tables)) == load_scene(dump_scene(world)) == world


def test_programs_are_written_and_read_as_the_caller_says() -> None:
    world = world_with(ship(100, 100, program=machine(TURN)))
    tables = document(world, row=lambda _: {"program": "a name"})
    assert "program-text" not in tables["ship"][0]
    assert world_of(tables, read=lambda name: {"a name": TURN}[name]) == world
    assert world_of(tables, read=lambda _: TURN.encode()) == world


@pytest.mark.parametrize("text", ["skip;\r\nfire;\r", "// é\nskip;", "\tskip; "])
def test_a_text_that_a_reader_gives_is_taken_as_it_is(text: str) -> None:
    world = world_with(ship(100, 100, program=machine(text)))
    tables = document(world, row=lambda _: {"program": "x"})
    assert world_of(tables, read=lambda _: text) == world


def test_a_wrong_document_is_told_without_lines() -> None:
    assert wrong({}) == ["[world]: is missing; it gives the width and the height"]
    assert wrong({"world": {"width": 10, "height": None}}) == [
        "[world], height = None: must be a number"
    ]
    assert wrong({"world": {"width": 10, "height": 10}, "ship": [5]}) == [
        "ship = [5]: must be one or more tables, each under [[ship]]"
    ]
    tables = document(
        world_with(ship(100, 100, program=machine(TURN))), row=lambda _: {"program": "x"}
    )
    assert "cannot be read from here" in wrong(tables)[0]


def test_a_program_without_a_text_is_refused_with_the_ship_that_has_it() -> None:
    with pytest.raises(ModelError, match="ship #1 has a program that is no text"):
        document(world_with(ship(100, 100, program=Script((None,)))))


# Entities.


@pytest.mark.parametrize(
    "entity",
    [
        Ship(1.5, -2.5, 3.0, -0.0, 5.0, 6.0, 1.0),
        Ship(1, 2, 3, 4, 5, 6, 1, thruster=True, name="é", max_speed=9.0, thrust_power=2.0, id=7),
        Ship(1, 2, 3, 4, 5, 6, 1, program=machine(TURN)),
        Asteroid(1e300, 2.0, 3.0, 4.0, 5e-324, name='"', max_speed=9.0),
        Asteroid(1.0, 2.0, 3.0, 4.0, 5.0, id=12),
        Bullet(1.0, 2.0, 3.0, 4.0, 5.0, 99, bounced=True, id=3),
    ],
)
def test_a_row_is_the_entity_whether_it_has_an_id_or_not(entity: Entity) -> None:
    row = through_json(entity_row(entity))
    assert entity_of(entity.kind, row) == entity
    assert ("id" in row) == (entity.id is not None)


@pytest.mark.parametrize(
    ("kind", "change", "problem"),
    [
        ("moon", {}, 'kind = "moon": must be one of ship, asteroid, bullet'),
        ("asteroid", {"radius": -1.0}, "asteroid, radius = -1.0: must be a finite number of km"),
        ("asteroid", {"id": "x"}, 'asteroid, id = "x": must be an integer'),
        ("asteroid", {"since": 1.0}, "asteroid, since = 1.0: is for an entity that flies"),
        ("asteroid", {"bounced_off": 1}, "bounced_off = 1: is for an entity that flies"),
        ("asteroid", {"mass": 1.0}, "asteroid, mass = 1.0: unknown field"),
        ("ship", {}, "ship, mass: is missing"),
        ("bullet", {"source": "red"}, 'source = "red": there is no ship of this name'),
    ],
)
def test_a_wrong_row_is_told(kind: str, change: dict[str, Any], problem: str) -> None:
    row = entity_row(rock(1, 2)) | change
    assert any(problem in told for told in wrong(kind, row, of=entity_of))


# Programs.


def test_a_row_is_the_program_as_it_is_now() -> None:
    program = machine("double x := 1; while (x < 9) { x := x + 1; skip; }")
    world = world_with(ship(100, 100, program=program))
    later = evolve(world, 0.7).ships[0].program
    assert later is not None
    assert program_in(through_json(program_row(program))) == program
    assert program_in(through_json(program_row(later))) == later != program
    assert program_in({}) is None


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ({"program-text": "fire"}, "has an error"),
        ({"program-text": 5}, "must be text"),
        ({"program": "x"}, "cannot be read from here"),
        ({"program-text": "fire;", "program-state": "{"}, "must be JSON"),
        ({"program-state": "{}"}, "needs the program"),
        ({"text": "fire;"}, "unknown field"),
    ],
)
def test_a_wrong_program_is_told(row: dict[str, Any], problem: str) -> None:
    assert problem in wrong(row, of=program_in)[0]
