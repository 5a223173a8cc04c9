"""`fasteroids arena`: its games, what is kept of them, and what is refused."""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from fasteroids.arena import Game
from fasteroids.cli._pool import played as original

Call = Callable[..., Result]

STOPPING = "entity e;\nfire;\nprint getx e;\n"
QUICK = ["--seeds", "0-5", "--jobs", "1"]


@pytest.fixture
def arena(call: Call, tmp_path: Path) -> Call:
    """Call the command in this process, its games kept in a folder of the test."""
    return lambda *args, **settings: call(
        "arena", *args, "--keep", str(tmp_path / "kept"), **settings
    )


def written(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


# The command.


def test_a_table_on_standard_output_alone(arena: Call) -> None:
    shown = arena("field-2013", "--bots", "spinner,turret", *QUICK)
    assert (shown.exit_code, shown.stderr) == (0, "")
    lines = shown.stdout.splitlines()
    assert (
        lines[0] == "field-2013: 2 bots, each alone on 6 seeds (0-5), at most 120 s; model smooth"
    )
    assert [line.split()[:3] for line in lines[4:6]] == [
        ["turret", "6", "6"],
        ["spinner", "6", "0"],
    ]
    assert all(line == line.rstrip() and len(line) <= 80 for line in lines)
    assert shown.stdout.endswith("\n")


def test_json_has_everything(arena: Call) -> None:
    shown = arena("field-2013", "--bots", "turret,spinner", *QUICK, "--for", "30", "--json")
    assert shown.stdout.count("\n") == 1
    found = json.loads(shown.stdout)
    assert {key: found[key] for key in ("field", "model", "limit", "seeds")} == {
        "field": "field-2013", "model": "smooth", "limit": 30.0, "seeds": "0-5",
    }  # fmt: skip
    turret, spinner = found["bots"]
    assert (turret["bot"], turret["games"], spinner["bot"]) == ("turret", 6, "spinner")
    assert turret["won"] + turret["lost"] + turret["timed_out"] == 6
    assert turret["low"] < turret["share"] <= turret["high"]
    (pair,) = found["pairs"]
    assert (pair["first"], pair["second"]) == ("turret", "spinner")
    assert pair["only_first"] + pair["only_second"] + pair["both"] + pair["neither"] == 6
    assert [(game["bots"], game["seed"]) for game in found["games"][:3]] == [
        (["turret"], 0), (["spinner"], 0), (["turret"], 1),
    ]  # fmt: skip
    assert len(found["games"]) == 12
    assert {*found["games"][0]["ended"][0]} == {"outcome", "time", "fuel", "stopped"}


def test_json_of_one_against_the_other(arena: Call) -> None:
    shown = arena(
        "one-on-one", "--bots", "turret,spinner", "--seeds", "0-2", "--jobs", "1", "--json"
    )
    found = json.loads(shown.stdout)
    (pair,) = found["pairs"]
    assert sum(pair[key] for key in ("only_first", "only_second", "drawn", "timed_out")) == 6
    assert [game["bots"] for game in found["games"][:2]] == [
        ["turret", "spinner"],
        ["spinner", "turret"],
    ]
    for game in found["games"]:
        west, east = (each["outcome"] for each in game["ended"])
        assert {west, east} in ({"won", "lost"}, {"drawn"}, {"timed out"})


@pytest.mark.parametrize(("field", "seeds"), [("field-2013", "0-4"), ("one-on-one", "0-1")])
def test_any_number_of_jobs_gives_the_same_bytes(
    call: Call, tmp_path: Path, field: str, seeds: str
) -> None:
    asked = ["arena", field, "--bots", "turret,spinner,opponent-2013", "--seeds", seeds, "--json"]
    one = call(*asked, "--jobs", "1", "--keep", str(tmp_path / "one"))
    three = call(*asked, "--jobs", "3", "--keep", str(tmp_path / "three"))
    assert (one.exit_code, three.exit_code) == (0, 0)
    assert one.stdout_bytes == three.stdout_bytes
    again = call(*asked, "--jobs", "3", "--keep", str(tmp_path / "one"))  # all of it kept
    assert again.stdout_bytes == one.stdout_bytes


def test_the_order_of_the_bots_changes_no_game(arena: Call) -> None:
    def games(bots: str) -> set[str]:
        found = json.loads(arena("field-2013", "--bots", bots, *QUICK, "--fresh", "--json").stdout)
        return {json.dumps(game) for game in found["games"]}

    assert games("turret,spinner") == games("spinner,turret")


def test_the_command_it_tells_shows_the_game(arena: Call, call: Call) -> None:
    shown = arena("field-2013", "--bots", "spinner", "--model", "robust", *QUICK)
    told = shown.stdout.splitlines()[-1].removeprefix("To see one: ")
    command = shlex.split(told)
    assert command[-2:] == ["--model", "robust"]
    assert command[:2] == ["fasteroids", "run"]
    run = call(*command[1:], "--events", "-")
    died = [
        event for event in map(json.loads, run.stdout.splitlines()) if 1 in event.get("died", [])
    ]
    found = json.loads(
        arena("field-2013", "--bots", "spinner", "--model", "robust", *QUICK, "--json").stdout
    )
    assert found["model"] == "robust"
    (game,) = [
        game for game in found["games"] if str(game["seed"]) == command[command.index("--seed") + 1]
    ]
    assert [event["time"] for event in died] == [game["ended"][0]["time"]]


def test_model_and_limit_reach_the_game(arena: Call, call: Call, tmp_path: Path) -> None:
    """A ship that thrusts into an asteroid: when they meet differs with the rule of thrust."""
    text = (
        "[world]\nwidth = 900\nheight = 400\n[[ship]]\nx = 50\ny = 50\nradius = 10\nmass = 5e15\n"
        "[[asteroid]]\nx = 600\ny = 50\nradius = 10\n"
    )
    field, bot = (
        written(tmp_path / "f.toml", text),
        written(tmp_path / "b.ast", "thrust; while (true) { skip; }"),
    )
    seen = {}
    for model in ("robust", "smooth"):
        asked = [field, "--bots", bot, "--model", model]
        (died,) = [
            event["time"]
            for event in map(json.loads, call("run", *asked, "--events", "-").stdout.splitlines())
            if 1 in event.get("died", [])
        ]
        for limit, outcome in ((died, "died"), (died - 0.1, "timed out")):
            shown = arena(*asked, "--seeds", "0", "--for", repr(limit), "--json")
            ((one,),) = (game["ended"] for game in json.loads(shown.stdout)["games"])
            assert (one["outcome"], one["time"]) == (outcome, limit)
        seen[model] = died
    assert len({*seen.values()}) == 2


def test_programs_that_stopped_are_named(arena: Call, tmp_path: Path) -> None:
    bot = written(tmp_path / "b.ast", STOPPING)
    shown = arena("field-2013", "--bots", f"turret,{bot}", "--seeds", "3-4", "--jobs", "1")
    said = " ".join(shown.stdout.split())
    assert f"operation {bot}: line 3: getx null: e is null; seeds 3-4 Seeds" in said
    found = json.loads(
        arena("field-2013", "--bots", f"turret,{bot}", "--seeds", "3-4", "--json").stdout
    )
    assert found["bots"][1]["stopped"] == 2
    assert found["games"][1]["ended"][0]["stopped"] == "line 3: getx null: e is null"


def test_a_field_from_standard_input_and_bots_from_files(arena: Call, tmp_path: Path) -> None:
    text = (
        "[world]\nwidth = 600\nheight = 400\n[[ship]]\nx = 99\ny = 99\nradius = 10\nmass = 1e15\n"
    )
    rock = "[[asteroid-field]]\ncount = 3\nradius = 20\nspeed = 90\n"
    bot = written(tmp_path / "b.ast", "while (true) { fire; }")
    shown = arena("-", "--bots", bot, "--seeds", "0-3", "--jobs", "2", "--json", input=text + rock)
    assert shown.exit_code == 0, shown.output
    assert json.loads(shown.stdout)["field"] == "standard input"
    assert len({game["ended"][0]["time"] for game in json.loads(shown.stdout)["games"]}) == 4


# What is kept.


def test_only_what_is_missing_is_played(
    arena: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    played: list[Game] = []

    def counting(games: Any, *rest: Any) -> Any:
        played.extend(games)
        return original(games, *rest)

    monkeypatch.setattr("fasteroids.cli.arena.played", counting)
    bot = tmp_path / "b.ast"

    def games(bots: str, seeds: str, *more: str) -> int:
        played.clear()
        shown = arena(
            "field-2013", "--bots", bots, "--seeds", seeds, "--jobs", "1", "--for", "4", *more
        )
        assert shown.exit_code == 0, shown.output
        kept = re.fullmatch(r"kept from before: (\d+) of (\d+) games?\n", shown.stderr)
        assert len(played) == (int(kept[2]) - int(kept[1]) if kept else len(played))
        return len(played)

    assert games("turret", "0-3") == 4
    assert games("turret", "0-3") == 0
    assert games("turret", "2-6") == 3  # seeds added
    assert games("spinner,turret", "0-6") == 7  # a bot added
    assert games("turret", "0-6", "--model", "robust") == 7
    assert games("turret", "0-6", "--for", "3") == 7
    assert games("turret", "0-6", "--fresh") == 7
    bot.write_text("while (true) { fire; }")
    assert games(f"turret,{bot}", "0-1") == 2
    bot.write_text("while (true) { turn 1; }")
    assert games(f"turret,{bot}", "0-1") == 2  # a bot changed
    assert games(f"turret,{bot}", "0-1") == 0


def test_a_changed_field_of_the_same_name_is_played_anew(arena: Call, tmp_path: Path) -> None:
    text = (
        "[world]\nwidth = 900\nheight = 400\n[[ship]]\nx = 50\ny = 50\nradius = 10\nmass = 1e15\n"
    )
    place, bot = tmp_path / "f.toml", written(tmp_path / "b.ast", "skip;")

    def ended(rock: str) -> tuple[str, float]:
        place.write_text(f"{text}[[asteroid]]\n{rock}\ny = 50\nradius = 10\n")
        shown = arena(str(place), "--bots", bot, "--seeds", "7", "--json")
        ((one,),) = (game["ended"] for game in json.loads(shown.stdout)["games"])
        return one["outcome"], one["time"]

    assert ended("vx = -90\nx = 160") == ("died", 1.0)
    assert ended("vx = -45\nx = 160") == ("died", 2.0)
    assert ended("vx = -90\nx = 160") == ("died", 1.0)


def test_a_folder_that_cannot_be_written_is_a_warning(call: Call, tmp_path: Path) -> None:
    file = written(tmp_path / "file", "mine")
    shown = call("arena", "field-2013", "--bots", "spinner", *QUICK, "--keep", file)
    assert shown.exit_code == 0
    assert shown.stderr.startswith("Warning: games are not kept: cannot ")
    assert shown.stderr.count("\n") == 1
    assert "spinner" in shown.stdout


# What is refused.


@pytest.mark.parametrize(
    ("args", "why"),
    [
        (["nope", "--bots", "turret"], "there is no scene 'nope'"),
        (["field-2014", "--bots", "turret"], "did you mean 'field-2013'?"),
        (["field-2013", "--bots", "turet"], "there is no bot 'turet' (did you mean 'turret'?); give a file, or one of"),
        (["field-2013", "--bots", "-"], "there is no bot '-'"),
        (["field-2013", "--bots", "turret,,spinner"], "names of programs with commas between them"),
        (["field-2013", "--bots", ""], "names of programs with commas between them"),
        (["field-2013", "--bots", "turret,spinner,turret"], "the bot 'turret' is named twice; give each once"),
        (["one-on-one", "--bots", "turret"], "one-on-one is for one against the other: give two bots or more"),
        (["field-2013", "--bots", "turret", "--seeds", "9-3"], "9-3 runs backwards"),
        (["field-2013", "--bots", "turret", "--seeds", "one"], "must be seeds such as"),
        (["field-2013", "--bots", "turret", "--for", "0"], "above 0"),
        (["field-2013", "--bots", "turret", "--jobs", "0"], "--jobs"),
        (["field-2013", "--bots", "turret", "--model", "odd"], "there is no model 'odd'"),
        (["field-2013"], "Missing option '--bots'"),
        (["--bots", "turret"], "Missing argument 'FIELD'"),
    ],
)  # fmt: skip
def test_bad_input_is_refused(arena: Call, tmp_path: Path, args: list[str], why: str) -> None:
    shown = arena(*args)
    assert shown.exit_code == 2
    assert why in shown.stderr
    assert shown.stdout == ""
    assert not (tmp_path / "kept").exists()


def test_games_are_not_kept_where_one_happens_to_be(call: Call) -> None:
    shown = call("arena", "field-2013", "--bots", "turret", "--keep", "")
    assert shown.exit_code == 2
    assert "--keep must be a folder; got ''" in shown.stderr


def test_one_file_by_two_names_is_refused(arena: Call, tmp_path: Path) -> None:
    bot = written(tmp_path / "b.ast", "fire;")
    other = str(tmp_path / ".." / tmp_path.name / "b.ast")
    shown = arena("field-2013", "--bots", f"{bot},{other}")
    assert shown.exit_code == 2
    assert f"the bot {other!r} is named twice, also as {bot!r}" in shown.stderr


def test_errors_of_a_bot_are_shown_as_check_shows_them(
    arena: Call, call: Call, tmp_path: Path
) -> None:
    bot = written(tmp_path / "b.ast", "double a;\na := tru;\nturn;\n")
    shown = arena("field-2013", "--bots", f"turret,{bot}")
    assert shown.exit_code == 2
    assert shown.stderr.startswith(f"Error: {bot} has 2 errors\n")
    assert call("check", bot).stdout.rstrip() in shown.stderr


def test_a_bot_of_the_folder_is_suggested(
    arena: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written(tmp_path / "killer.ast", "fire;")
    monkeypatch.chdir(tmp_path)
    assert "did you mean 'killer.ast'?" in arena("field-2013", "--bots", "killer").stderr


def test_a_seed_that_makes_no_field_is_named(arena: Call, tmp_path: Path) -> None:
    scene = (
        "[world]\nwidth = 210\nheight = 100\n[[ship]]\nx = 20\ny = 50\nradius = 10\nmass = 1e15\n"
        "[[asteroid-field]]\ncount = 4\nradius = 24\nspeed = 0\n"
    )
    field = written(tmp_path / "tight.toml", scene)
    shown = arena(field, "--bots", "spinner", "--seeds", "0-9", "--for", "1", "--jobs", "2")
    assert shown.exit_code == 2
    assert re.match(
        r"Error: spinner cannot play seed \d: tight.toml: .*no room for more than 3", shown.stderr
    )


@pytest.mark.parametrize("ships", [0, 3])
def test_a_field_with_no_ships_or_too_many_is_refused(arena: Call, ships: int) -> None:
    rows = [
        f"[[ship]]\nx = {50 * i + 20}\ny = 50\nradius = 10\nmass = 1e15\n" for i in range(ships)
    ]
    shown = arena(
        "-", "--bots", "turret", input="".join(["[world]\nwidth = 210\nheight = 100\n", *rows])
    )
    assert shown.exit_code == 2
    assert shown.stderr == (
        "Error: standard input: a field has one ship, to clear it, or two, one against the other; "
        f"this one has {ships}\n"
    )
