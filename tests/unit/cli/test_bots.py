"""`--bots`: programs for the ships of any scene."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from fasteroids.cli._bots import read_bot
from fasteroids.cli._files import shipped_programs
from fasteroids.cli._guard import Refusal

Call = Callable[..., Result]

FLOWN = """
[world]
width = 400
height = 200

[[ship]]
name = "red"
x = 50
y = 50
radius = 10
mass = 5e15
program-text = "while (true) { skip; }"

[[ship]]
name = "blue"
x = 350
y = 150
radius = 10
mass = 5e15
"""


@pytest.fixture
def flown(tmp_path: Path) -> str:
    """A scene of two ships, one of which has a program already."""
    path = tmp_path / "flown.toml"
    path.write_text(FLOWN, encoding="utf-8")
    return str(path)


@pytest.fixture
def turning(tmp_path: Path) -> str:
    """A program in a file."""
    path = tmp_path / "turning.ast"
    path.write_text("while (true) { turn 1; }", encoding="utf-8")
    return str(path)


def test_run_gives_the_ships_their_programs(call: Call, flown: str, turning: str) -> None:
    told = call("run", flown, "--for", "0.2", "--bots", f"{turning}, spinner").stdout
    assert "0.200  red turns\n0.200  blue " in told
    assert "blue" not in call("run", flown, "--for", "0.2").stdout


def test_run_with_a_bot_is_the_scene_that_names_it(call: Call, tmp_path: Path) -> None:
    text = (
        FLOWN.partition('[[ship]]\nname = "blue"')[0]
        + "[[asteroid]]\nx = 300\ny = 100\nradius = 20\nvx = -30\n"
    )
    named, plain = tmp_path / "named.toml", tmp_path / "plain.toml"
    named.write_text(text.replace('program-text = "while (true) { skip; }"', 'program = "turret"'))
    plain.write_text(text)
    bot = call("run", str(plain), "--bots", "turret", "--events", "-")
    assert bot.stdout == call("run", str(named), "--events", "-").stdout
    assert '"effect": "fire"' in bot.stdout


def test_trace_tells_the_steps_of_a_bot(call: Call, turning: str) -> None:
    shown = call("trace", "field-2013", "--seed", "7", "--bots", turning, "--to", "0.2")
    assert shown.exit_code == 0
    assert "turns by 1" in shown.stdout
    assert call("trace", "field-2013").exit_code == 2  # nobody flies there


def test_audit_runs_a_bot(call: Call) -> None:
    asked = ["audit", "field-2013", "--for", "5", "--json"]
    assert json.loads(call(*asked, "--bots", "spinner").stdout)["events"]["tick"] == 25
    assert "tick" not in json.loads(call(*asked).stdout)["events"]


def test_explain_sees_a_bot(call: Call) -> None:
    asked = ["explain", "field-2013", "--json"]
    assert json.loads(call(*asked, "--bots", "spinner").stdout)["parts"]["ticks"]["used"] is True
    assert json.loads(call(*asked).stdout)["parts"]["ticks"]["used"] is False


@pytest.mark.parametrize("command", ["run", "audit", "trace", "explain"])
@pytest.mark.parametrize(
    ("bots", "why"),
    [
        ("turret", "flown.toml: each ship needs a program: 2 in all; got 1"),
        ("turret,turret,turret", "2 in all; got 3"),
        ("turret,turet", "there is no bot 'turet' (did you mean 'turret'?)"),
        ("turret,", "names of programs with commas between them"),
    ],
)
def test_bots_that_do_not_fit_are_refused(
    call: Call, flown: str, command: str, bots: str, why: str
) -> None:
    shown = call(command, flown, "--bots", bots)
    assert (shown.exit_code, shown.stdout) == (2, "")
    assert why in shown.stderr


def test_the_same_bot_may_fly_both(call: Call, flown: str) -> None:
    assert call("run", flown, "--bots", "spinner,spinner").exit_code == 0


# Reading them.


@pytest.mark.parametrize("name", shipped_programs())
def test_a_shipped_program_is_read_by_its_name(name: str) -> None:
    assert read_bot(name).code.source == shipped_programs()[name]


def test_a_file_wins_over_a_shipped_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "turret").write_text("skip;")
    (tmp_path / "-").write_text("fire;")
    assert read_bot("turret").code.source == "skip;"
    assert read_bot("-").code.source == "fire;"


def test_a_folder_hides_no_shipped_program_and_no_shipped_scene(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("turret", "field-2013"):
        (tmp_path / name).mkdir()
    assert read_bot("turret").code.source == shipped_programs()["turret"]
    assert call("run", "field-2013", "--bots", "turret", "--for", "0.2").exit_code == 0


def test_many_errors_are_cut_short(tmp_path: Path) -> None:
    bot = tmp_path / "bad.ast"
    bot.write_text("".join(f"a{i} := 1;\n" for i in range(30)))
    with pytest.raises(Refusal) as caught:
        read_bot(str(bot))
    head, *report = caught.value.message.split("\n")
    assert head.endswith("bad.ast has 30 errors, of which these are the first 20")
    assert sum("error FA" in line for line in report) == 20


def test_a_folder_is_no_bot(tmp_path: Path) -> None:
    with pytest.raises(Refusal, match=r"cannot read .*: Is a directory"):
        read_bot(str(tmp_path))
