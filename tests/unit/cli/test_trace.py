"""`fasteroids trace`: the small steps of a program."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from tests.unit.cli.conftest import SCENE

Call = Callable[..., Result]

PROGRAM = """\
double x;
while (true) {
  x := x + getx self;
  turn 0.1;
  fire;
}
"""


@pytest.fixture
def scene(tmp_path: Path) -> str:
    (tmp_path / "red.ast").write_text(PROGRAM)
    text = SCENE.replace('name = "red"', 'name = "red"\nprogram = "red.ast"')
    (tmp_path / "scene.toml").write_text(text)
    return str(tmp_path / "scene.toml")


def test_every_step_of_the_first_second(call: Call, scene: str) -> None:
    shown = call("trace", scene, "--to", "0.4")
    assert shown.exit_code == 0
    assert shown.stdout.splitlines() == [
        "0.200  red: 9 steps",
        "  2:8     true  -> = true",
        "  2:1     while (true) { ...",
        "  3:8     x  -> = 0.0",
        "  3:17    self  -> = ship 1",
        "  3:12    getx self  -> = 62.0",
        "  3:8     x + getx self  -> = 62.0",
        "  3:3     x := x + getx self;  -> x is now 62.0",
        "  4:8     0.1  -> = 0.1",
        "  4:3     turn 0.1;  -> turns by 0.1",
        "0.400  red: 1 step",
        "  5:3     fire;  -> fire",
    ]
    assert shown.stderr == "2 ticks from 0 s to 0.4 s\n"


def test_a_piece_of_time(call: Call, scene: str) -> None:
    whole = call("trace", scene, "--to", "1").stdout
    part = call("trace", scene, "--from", "0.5", "--to", "1", "--ship", "red").stdout
    assert part
    assert whole.endswith(part)


def test_both_ends_of_a_piece_belong_to_it(call: Call, scene: str) -> None:
    assert call("trace", scene, "--from", "0.4", "--to", "0.4").stdout.startswith(
        "0.400  red: 1 step\n"
    )
    whole = call("trace", scene, "--from", "0.4", "--to", "1.8").stdout
    assert [line[:5] for line in whole.splitlines() if line[0] != " "] == [
        f"{k / 5:.3f}" for k in range(2, 10)
    ]


def test_json_lines(call: Call, scene: str) -> None:
    lines = [
        json.loads(line)
        for line in call("trace", scene, "--to", "0.2", "--json").stdout.splitlines()
    ]
    assert len(lines) == 9
    assert lines[4] == {
        "time": 0.2, "step": 5, "line": 3, "column": 12, "end_line": 3, "end_column": 21,
        "source": "getx self", "value": 62.0,
    }  # fmt: skip
    assert lines[6]["changed"] == {"x": 62.0}
    assert (lines[8]["action"], lines[8]["angle"]) == ("turn", 0.1)


@pytest.mark.parametrize(
    ("args", "why"),
    [
        (["--ship", "blue"], "blue has no program"),
        (["--ship", "rde"], "there is no ship 'rde' (did you mean 'red'?)"),
        (["--from", "2", "--to", "1"], "must be in order"),
        (["--from", "-1"], "--from"),
    ],
)
def test_what_cannot_be_traced(call: Call, scene: str, args: list[str], why: str) -> None:
    shown = call("trace", scene, *args)
    assert shown.exit_code == 2
    assert why in shown.stderr
    assert shown.stdout == ""


def test_a_scene_without_programs(call: Call) -> None:
    shown = call("trace", "default")
    assert shown.exit_code == 2
    assert "no ship of this scene has a program" in shown.stderr


def test_a_stop_is_told(call: Call, scene: str) -> None:
    Path(scene).with_name("red.ast").write_text("entity e; print getx e;")
    shown = call("trace", scene)
    assert "  1:17    getx e  -> stops: getx null: e is null\n" in shown.stdout


def test_why_there_are_no_more_ticks_is_told(call: Call, scene: str) -> None:
    program = Path(scene).with_name("red.ast")
    program.write_text("entity e; print getx e;")
    assert "the program stopped on line 1: getx null: e is null" in call("trace", scene).stderr
    program.write_text("fire;")
    assert call("trace", scene).stderr == "1 tick from 0 s to 1 s; the program is over\n"
    program.write_text("while (true) { fire; }")
    few = call("trace", scene, "--max-events", "2").stderr
    assert "stopped at" in few
    assert "from 0 s to 1 s" not in few


def test_ships_of_one_name_are_told_apart_by_id(call: Call, tmp_path: Path) -> None:
    ship = '[[ship]]\nname = "a"\nid = {}\nx = {}\ny = 50\nradius = 9\nmass = 1\nprogram-text = "skip;"\n'
    scene = tmp_path / "two.toml"
    scene.write_text(
        "[world]\nwidth = 900\nheight = 100\n" + ship.format(5, 100) + ship.format(7, 200)
    )
    for args in ([], ["--ship", "a"]):
        shown = call("trace", str(scene), *args)
        assert shown.exit_code == 2
        assert "say which ship with --ship ID: a (id 5), a (id 7)" in shown.stderr
    assert call("trace", str(scene), "--ship", "7").exit_code == 0


def test_thrust_is_not_cut_by_looking_late(call: Call, tmp_path: Path) -> None:
    """Under the literal rule of thrust every stop is a cut: going to --from first would be one."""
    scene = tmp_path / "literal.toml"
    scene.write_text(
        "[world]\nwidth = 5000\nheight = 1000\n[[ship]]\nname = 'red'\nx = 100\ny = 100\nradius = 10\n"
        "mass = 5e15\nprogram-text = 'thrust; while (true) { print getx self; skip; }'\n"
    )
    whole = call("trace", str(scene), "--to", "3.6").stdout
    assert whole.endswith(call("trace", str(scene), "--from", "3.5", "--to", "3.6").stdout)


def test_an_ill_typed_program_is_told_in_full(call: Call, scene: str) -> None:
    Path(scene).with_name("red.ast").write_text("turn true;")
    for command in ("run", "trace"):
        shown = call(command, scene)
        assert shown.exit_code == 2
        assert "red.ast:1:6: error FA1" in shown.stderr


def test_prints_are_lines_of_the_narration(call: Call, scene: str) -> None:
    Path(scene).with_name("red.ast").write_text("print 1 / 4; skip; print null; skip;")
    lines = call("run", scene, "--for", "0.5").stdout.splitlines()
    assert lines[1:3] == ["0.200  red: 0.25", "0.200  red skips"]
    assert "0.400  red: null" in lines
