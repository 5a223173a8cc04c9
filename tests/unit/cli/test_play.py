"""`fasteroids play`, `watch`, `replay` and `serve`, as far as they need no terminal."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import monotonic
from types import SimpleNamespace
from typing import Any

import pytest
from click.testing import Result

from fasteroids.cli._arcade import Screen, Shelf
from fasteroids.history import Add
from fasteroids.history.living import answered, beginning, lived
from fasteroids.history.recording import RecordingFile, headed
from fasteroids.moments import clock_at
from fasteroids.scene import load_scene
from fasteroids.tui.game import new_game, wave
from fasteroids.tui.launching import NewGame, Recorded, SceneGame
from fasteroids.units import ModelError

Call = Callable[..., Result]

SITTER = "while (true) { skip; }\n"


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of recordings, of a user who has none."""
    monkeypatch.setattr("fasteroids.tui._store.data_folder", lambda: tmp_path / "data")
    return tmp_path / "data" / "recordings"


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, Screen]]:
    """What is asked of the terminal instead of opening it."""
    found: list[tuple[Any, Screen]] = []

    def opened(wanted: Any, shown: Screen) -> int:
        found.append((wanted, shown))
        return 0

    monkeypatch.setattr("fasteroids.cli._arcade.opened", opened)
    return found


# What is wanted.


@pytest.mark.parametrize(
    ("args", "wanted"),
    [
        ([], None),
        (["--seed", "5"], None),
        (["--ai", "hunter", "--seed", "5"], NewGame("duel", (None, "hunter"), 5)),
        (["-ai", "hunter", "--seed", "5"], NewGame("duel", (None, "hunter"), 5)),
        (["--two", "--seed", "5", "--model", "robust"], NewGame("duel", (None, None), 5, "robust")),
        (["duel"], SceneGame("duel", 1)),
        (["duel", "--two"], SceneGame("duel", 2)),
        (["duel", "--ai", "ace", "--seed", "5"], SceneGame("duel", 1, ("ace",), 5)),
    ],
)
def test_play_asks_for_what_it_is_told(
    call: Call, asked: list[tuple[Any, Screen]], args: list[str], wanted: Any
) -> None:
    assert call("play", *args).exit_code == 0
    assert asked[0][0] == wanted


@pytest.mark.parametrize(
    "args",
    [
        ["--no-sound", "--window", "--arena", "block", "--fps", "60"],
        ["-nosound", "-window", "--arena", "block", "--fps", "60"],
    ],
)
def test_options_of_the_course_are_accepted(
    call: Call, asked: list[tuple[Any, Screen]], args: list[str]
) -> None:
    assert call("play", *args).exit_code == 0
    assert asked[0][1] == Screen("block", 60, silent=True, window=True)


def test_the_words_of_a_screen_say_the_same(call: Call, asked: list[tuple[Any, Screen]]) -> None:
    screen = Screen("block", 60, silent=True, window=True, seed=3, model="robust")
    call("play", *screen.words)
    call("play", *Screen().words)
    assert [shown for _, shown in asked] == [screen, Screen()]


def test_two_players_without_a_seed_get_a_new_one_each_time(
    call: Call, asked: list[tuple[Any, Screen]]
) -> None:
    for _ in range(3):
        call("play", "--two")
    assert len({wanted.seed for wanted, _ in asked}) > 1


def test_watch_has_no_humans(call: Call, asked: list[tuple[Any, Screen]]) -> None:
    assert call("watch", "duel", "--bots", "ace,hunter", "--seed", "4").exit_code == 0
    assert asked[0][0] == SceneGame("duel", 0, ("ace", "hunter"), 4)


# Refusals.


@pytest.mark.parametrize("args", [["play"], ["play", "duel"], ["watch", "duel"]])
def test_without_a_terminal_a_sentence_tells_of_the_other_way(call: Call, args: list[str]) -> None:
    shown = call(*args)
    assert (shown.exit_code, shown.stdout) == (2, "")
    assert shown.stderr.startswith("Error: there is no terminal to play on; --plain")


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (["play", "--plain", "nowhere"], "there is no scene 'nowhere'"),
        (["play", "--plain", "--ai", "hunte"], "did you mean 'hunter'?"),
        (["play", "duel", "--plain", "--two", "--ai", "ace"], "there is no ship left"),
        (["play", "field-2013", "--plain", "--two"], "two players need two ships"),
        (["watch", "duel", "--plain", "--bots", "ace,ace,ace"], "3 programs are too many"),
        (["play", "--two", "--ai", "ace"], "--two and --ai need a SCENE"),
        (["play", "-"], "standard input has the keys"),
        (["watch", "-"], "standard input has the keys"),
        (["play", "--fps", "45"], "'45' is not one of '30', '60'"),
        (["play", "--arena", "vector"], "'vector' is not one of"),
        (["replay", "x", "--json"], "--json is for the list"),
    ],
)
def test_what_cannot_be_had_is_a_sentence(
    call: Call, home: Path, args: list[str], sentence: str
) -> None:
    shown = call(*args)
    assert (shown.exit_code, shown.stdout) == (2, "")
    assert sentence in shown.stderr


def test_the_errors_of_a_program_are_shown_as_check_shows_them(call: Call, tmp_path: Path) -> None:
    bad = tmp_path / "bad.ast"
    bad.write_text("x := 1;\n")
    shown = call("play", "--plain", "--ai", str(bad))
    assert shown.exit_code == 2
    found = call("check", str(bad)).stdout.splitlines()
    assert found[0] in shown.stderr
    assert "has an error" in shown.stderr


# Plain.


def test_a_game_of_waves_is_told_in_words(call: Call) -> None:
    shown = call("play", "--plain", "--seed", "3")
    assert shown.exit_code == 0
    lines = shown.stdout.splitlines()
    assert lines[:2] == ["waves: ace: 1 ship; seed 3, model smooth", "0.000  wave 1"]
    assert any("splits into" in line for line in lines)
    assert any(line.endswith("wave 2") for line in lines)
    times = [float(line.split()[0]) for line in lines[1:]]
    assert times == sorted(times)
    assert times[-1] <= 120.0
    assert "ace" in lines[-1]
    assert "points" in lines[-1]
    assert call("play", "--plain", "--seed", "3").stdout == shown.stdout


def test_a_duel_is_told_to_its_end(call: Call, tmp_path: Path) -> None:
    sitter = tmp_path / "sitter.ast"
    sitter.write_text(SITTER)
    shown = call("play", "--plain", "--ai", str(sitter), "--seed", "2")
    assert shown.exit_code == 0
    head, *_, last = shown.stdout.splitlines()
    assert head.startswith("duel: hunter against sitter: 2 ships")
    assert "hunter wins; hunter " in last or "draw" in last


def test_a_scene_is_told_with_its_own_programs(call: Call) -> None:
    shown = call("watch", "pilot", "--plain")
    assert shown.exit_code == 0
    assert shown.stdout.startswith("pilot: 1 ship and 5 asteroids; seed 3, model smooth\n")
    assert "pilot fires bullet" in shown.stdout


def test_the_ship_of_a_human_is_flown_by_a_program(call: Call) -> None:
    assert "West fires bullet" in call("play", "duel", "--plain").stdout
    assert "West fires bullet" not in call("watch", "duel", "--plain").stdout


def test_a_scene_comes_from_standard_input(call: Call, scene: str) -> None:
    shown = call("play", "-", "--plain", input=Path(scene).read_text())
    assert shown.exit_code == 0
    assert shown.stdout.startswith("standard input: 2 ships, 1 asteroid and 1 bullet; seed 4")


# Recordings.


def recorded(home: Path, name: str, *, cut: bool = False, title: str = "waves: you") -> Path:
    """A recording of two seconds of waves."""
    home.mkdir(parents=True, exist_ok=True)
    _, world = new_game("waves", seed=8, names=["you"], programs=[None])
    place = home / f"{name}.fast.jsonl"
    header = headed(world, title=title)
    with place.open("wb") as file, RecordingFile(file, world, header, clock=monotonic) as kept:
        state = beginning(world)
        for asteroid in wave(world, 1):
            state = answered(state, Add(asteroid))
            kept.add(state)
        for each in lived(state, clock_at(2.0)):
            kept.add(each)
        if not cut:
            kept.finish(clock_at(2.0), "time")
    return place


def test_no_recordings_is_no_error(call: Call, home: Path) -> None:
    shown = call("replay")
    assert (shown.exit_code, shown.stdout) == (0, "")
    assert shown.stderr.startswith("no games are recorded in ")
    assert call("replay", "--json").output == ""


def test_the_last_games_are_listed_newest_first(call: Call, home: Path) -> None:
    recorded(home, "20260101-000000")
    recorded(home, "20260102-000000", cut=True, title="duel: you against ace")
    (home / "20260103-000000.fast.jsonl").write_text("no header\n")
    shown = call("replay")
    assert shown.exit_code == 0
    _, damaged, cut, whole = shown.stdout.splitlines()
    assert "no recording, or a damaged one" in damaged
    assert "duel: you against ace" in cut
    assert "(cut short)" in cut
    assert whole.split()[0] == "3"
    assert whole.endswith("8  2.0 s              20260101-000000.fast.jsonl")
    found = [json.loads(line) for line in call("replay", "--json").stdout.splitlines()]
    assert [each["number"] for each in found] == [1, 2, 3]
    assert [each["whole"] for each in found] == [False, False, True]
    assert found[2]["seed"] == 8
    assert found[2]["time"] == 2.0
    assert Path(found[2]["file"]).name == "20260101-000000.fast.jsonl"


@pytest.mark.parametrize(
    "name", ["1", "20260101-000000", "20260101-000000.fast.jsonl", "{home}/20260101-000000.fast.jsonl"]
)  # fmt: skip
def test_a_recording_is_opened_by_number_name_or_path(
    call: Call, home: Path, asked: list[tuple[Any, Screen]], name: str
) -> None:
    place = recorded(home, "20260101-000000")
    assert call("replay", name.format(home=home)).exit_code == 0
    assert asked[0][0] == Recorded(place)


@pytest.mark.parametrize("name", ["0", "2", "-1", "nobody"])
def test_a_recording_that_is_not_there_is_a_sentence(call: Call, home: Path, name: str) -> None:
    recorded(home, "20260101-000000")
    shown = call("replay", "--", name)
    assert shown.exit_code == 2
    assert f"there is no recording '{name}'" in shown.stderr


def test_a_recording_is_told_in_words(call: Call, home: Path) -> None:
    place = recorded(home, "20260101-000000")
    shown = call("replay", "1", "--plain")
    assert shown.exit_code == 0
    assert shown.stdout.startswith("waves: you: 1 ship; seed 8")
    assert shown.stdout.splitlines()[-1].startswith("2.000  it goes on")
    place.write_text("no header\n")
    shown = call("replay", str(place), "--plain")
    assert shown.exit_code == 2
    assert "cannot be read: line 1" in shown.stderr


# The library.


def test_what_comes_with_the_package_says_what_it_is() -> None:
    shelf = Shelf()
    for said in (*shelf.programs().values(), *shelf.scenes().values()):
        assert said
        assert "\n" not in said
        assert not said.startswith(("#", "/"))
    assert shelf.programs()["dodger"] == "A dodger: never fires."
    assert shelf.scenes()["duel"] == "Two equal ships that face each other across four asteroids."


def test_refusals_are_for_the_game_to_show(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="there is no bot 'nobody'"):
        Shelf().program("nobody")
    with pytest.raises(ModelError, match="there is no scene 'nowhere'"):
        Shelf().scene("nowhere", None, None)
    bad = tmp_path / "bad.toml"
    bad.write_text("[world]\nwidth = 3\n")
    with pytest.raises(ModelError, match=r"bad\.toml"):
        Shelf().scene(str(bad), None, None)
    title, world = Shelf().scene("duel", 77, "robust")
    assert (title, world.seed, world.model) == ("duel", 77, "robust")
    assert world.entities == load_scene(_text("duel"), seed=77, model="robust").entities


def _text(name: str) -> str:
    from fasteroids.cli._files import shipped

    return shipped()[name]


# Serving.


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What a stand-in for textual-serve is told."""
    found: list[Any] = []

    class Server:
        def __init__(self, command: str, **settings: Any) -> None:
            found.append((command, settings))

        def serve(self) -> None:
            found.append("served")

    monkeypatch.setattr("fasteroids.cli.serve.find_spec", lambda _: object())
    stand_in = SimpleNamespace(Server=Server)
    monkeypatch.setattr("fasteroids.cli.serve.import_module", lambda _: stand_in)
    return found


def test_serving_needs_an_extra(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fasteroids.cli.serve.find_spec", lambda _: None)
    shown = call("serve")
    assert shown.exit_code == 2
    assert "pip install 'fasteroids[web]'" in shown.stderr


def test_it_serves_the_game_on_loopback_by_default(call: Call, served: list[Any]) -> None:
    shown = call("serve", "--seed", "3", "--arena", "ascii", "--no-sound")
    assert (shown.exit_code, shown.stderr) == (0, "")
    (command, settings), last = served
    assert command.endswith("-m fasteroids play --arena ascii --seed 3 --no-sound")
    assert command.startswith(sys.executable)
    assert (settings["host"], settings["port"], last) == ("127.0.0.1", 8000, "served")


@pytest.mark.parametrize(
    ("host", "warned"),
    [("127.0.0.1", False), ("localhost", False), ("::1", False), ("0.0.0.0", True), ("a.b", True)],
)
def test_it_warns_where_others_can_reach_it(
    call: Call, served: list[Any], host: str, warned: bool
) -> None:
    shown = call("serve", "--host", host)
    assert shown.exit_code == 0
    assert (f"Warning: {host} is not loopback" in shown.stderr) is warned


# What is loaded.


@pytest.mark.parametrize(
    "args", [["play", "--plain", "duel"], ["replay"], ["play"], ["watch", "duel"]]
)
def test_textual_is_loaded_only_for_a_terminal(args: list[str], tmp_path: Path) -> None:
    code = (
        "import sys, fasteroids.cli\n"
        f"try: fasteroids.cli.main({args!r}, prog_name='fasteroids')\n"
        "except SystemExit: pass\n"
        "print('loaded', *sorted({'rich', 'textual'} & sys.modules.keys()))\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True,
        stdin=subprocess.DEVNULL, env={"XDG_DATA_HOME": str(tmp_path), "PYTHONPATH": ":".join(sys.path)},
    )  # fmt: skip
    assert run.stdout.splitlines()[-1] == "loaded"
