"""Programs in scene files."""

from __future__ import annotations

import attrs
import pytest

from fasteroids import ModelError, World, dump_scene, evolve, load_scene
from fasteroids.lang import Machine, Running
from fasteroids.scene import SceneError
from fasteroids.testing import unfold
from tests.unit.making import machine

SCENE = """
[world]
width = 1000
height = 1000

[[ship]]
name = "red"
x = 500
y = 500
radius = 20
mass = 5e15
"""
COUNT = "double n; while (true) { n := n + 1; print n; skip; }"


def read(name: str) -> bytes:
    try:
        return {"count.ast": COUNT.encode(), "bytes.ast": b"skip;\n\xff", "bad.ast": b"x := 1"}[
            name
        ]
    except KeyError:
        raise ModelError(f"there is no file {name}") from None


def refused(text: str) -> str:
    with pytest.raises(SceneError) as caught:
        load_scene(text, read=read)
    return str(caught.value)


def test_a_program_is_read_or_stands_in_the_file() -> None:
    by_name = load_scene(SCENE + 'program = "count.ast"', read=read)
    by_text = load_scene(SCENE + f'program-text = "{COUNT}"')
    assert by_name == by_text
    assert [h.prints for h in unfold(by_name, until=0.4).log] == [("1.0",), ("2.0",)]


def test_what_is_wrong_with_a_program_is_told_with_its_place() -> None:
    told = refused(SCENE + 'program = "bad.ast"')
    assert told.startswith('line 12: [[ship]] "red", program = "bad.ast": has 2 errors\n')
    assert "bad.ast:1:7: error FA" in told
    assert "program-text:1:6: error" in refused(SCENE + 'program-text = "turn true;"')
    assert "bytes.ast:2:1: error" in refused(SCENE + 'program = "bytes.ast"')
    assert "there is no file x.ast" in refused(SCENE + 'program = "x.ast"')


@pytest.mark.parametrize(
    ("fields", "why"),
    [
        ('program = "count.ast"\nprogram-text = "skip;"', "program-text exclude each other"),
        ('program-state = "{}"', "needs the program"),
        ('program-text = "skip;"\nprogram-state = "{"', "must be JSON"),
        ('program-text = "skip;"\nprogram-state = "[]"', "as dump_scene writes it"),
        ('program-text = "skip;"\nprogram-tick = 2', "must be 1"),
        ('program-text = "skip;"\nprogram-tick = -1', "must be 1"),
        ("program-tick = 1", "is for a ship with a program"),
        ("program = 1", "must be text"),
    ],
)
def test_programs_that_are_refused(fields: str, why: str) -> None:
    assert why in refused(SCENE + fields)


def test_without_a_reader_only_text_is_read() -> None:
    with pytest.raises(
        SceneError, match="cannot be read from here; write the program in program-text"
    ):
        load_scene(SCENE + 'program = "count.ast"')


def test_a_program_is_written_as_it_is() -> None:
    world = load_scene(SCENE + 'program = "count.ast"', read=read)
    fresh = dump_scene(world)
    assert COUNT in fresh
    assert "program-state" not in fresh
    later = dump_scene(evolve(world, 0.5))
    assert "program-state = " in later
    program = load_scene(later).ships[0].program
    assert isinstance(program, Running)
    assert program.store["n"] == 2.0


def test_a_text_of_several_lines_is_shown_as_such() -> None:
    text = 'double n;\n// says "\\ hello """ and \u2028 \U0001f680\n\tprint n;\r\nskip;\n'
    world = load_scene(SCENE, read=read)
    ship = world.ships[0]
    world = World(1000, 1000).add(attrs.evolve(ship, program=machine(text), id=None))
    dumped = dump_scene(world)
    assert 'program-text = """\ndouble n;\n' in dumped
    back = load_scene(dumped).ships[0].program
    assert isinstance(back, Machine)
    assert back.code.source == text


def test_fuel_is_kept() -> None:
    world = load_scene(SCENE.replace("height = 1000", "height = 1000\nfuel = 77"))
    assert world.fuel == 77
    assert "fuel = 77" in dump_scene(world)
    assert "fuel must" not in refused(SCENE.replace("height = 1000", "height = 1000\nfuel = 0"))
    assert "from 1 to" in refused(SCENE.replace("height = 1000", "height = 1000\nfuel = 0"))


def test_a_mark_at_the_start_of_a_text_comes_back() -> None:
    for text in ("\ufefffire;", "\ufeff\nfire; skip;"):
        world = load_scene(SCENE)
        ship = attrs.evolve(world.ships[0], program=machine(text), id=None)
        world = World(1000, 1000).add(ship)
        assert load_scene(dump_scene(world)) == world


def test_a_text_no_file_can_hold_is_not_written() -> None:
    ship = attrs.evolve(load_scene(SCENE).ships[0], program=machine("skip; // \ud800"), id=None)
    with pytest.raises(ModelError, match="lone surrogates, which no file of text can hold"):
        dump_scene(World(1000, 1000).add(ship))


def test_of_many_errors_the_first_are_shown() -> None:
    told = refused(SCENE + f'program-text = "{"fire " * 50}"')
    assert "has 50 errors, of which these are the first 10" in told
    assert told.count("error FA") == 10
