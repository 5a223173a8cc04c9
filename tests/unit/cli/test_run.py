"""`fasteroids run`: every option, good input and bad."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from fasteroids import Happened, ModelError, World, evolve, happenings, load_scene

Call = Callable[..., Result]


def world_of(scene: str) -> World:
    return load_scene(Path(scene).read_text(encoding="utf-8"))


def happened_in(world: World, until: float) -> list[Happened]:
    return [happened for happened, _ in happenings(world, until)]


def lines_of(path: Path) -> list[dict[str, Any]]:
    text = path.read_text(encoding="utf-8")
    assert text == "" or text.endswith("\n")
    return [json.loads(line) for line in text.splitlines()]


# Narration.


def test_narrates_a_line_an_event(call: Call, scene: str) -> None:
    shown = call("run", scene, "--for", "10")
    assert shown.exit_code == 0
    assert shown.stderr == ""
    first, *events, last = shown.stdout.splitlines()
    assert first == (
        "scene.toml: 2 ships, 1 asteroid and 1 bullet in 400 x 200 km, from 0 s to 10 s; "
        "seed 4, model robust"
    )
    assert len(events) == len(happened_in(world_of(scene), 10.0))
    assert all(re.match(r"\d+\.\d{3}  \S", line) for line in [*events, last])
    assert last.startswith(f"10.000  {len(events)} events (")
    assert "left" in last
    told = "\n".join(events)
    fates = "asteroid #3 splits into #5 and #6, bullet #4 dies"
    assert f"0.247  asteroid #3 and bullet #4 collide at (160, 100): {fates}" in told
    assert "4.250  blue bounces off the left wall" in told


def test_says_the_same_every_time(call: Call, scene: str) -> None:
    assert call("run", scene).stdout == call("run", scene).stdout


def test_runs_20_seconds_by_default(call: Call, scene: str) -> None:
    assert "from 0 s to 20 s" in call("run", scene).stdout
    assert call("run", scene).stdout.splitlines()[-1].startswith("20.000  ")


def test_quiet_prints_nothing(call: Call, scene: str) -> None:
    shown = call("run", scene, "--quiet")
    assert (shown.exit_code, shown.output) == (0, "")


def test_for_counts_from_the_time_of_the_scene(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "late.toml"
    path.write_text("[world]\nwidth = 10\nheight = 10\ntime = 2000\n")
    assert "from 2000 s to 2005 s" in call("run", str(path), "--for", "5").stdout


# Events.


def test_events_as_json_lines(call: Call, scene: str) -> None:
    shown = call("run", scene, "--for", "10", "--events", "-")
    assert shown.exit_code == 0
    assert "seed 4, model robust" in shown.stderr
    expected = happened_in(world_of(scene), 10.0)
    lines = shown.stdout.splitlines()
    assert len(lines) == len(expected)
    for line, happened in zip(lines, expected, strict=True):
        record = json.loads(line)
        assert record["time"] == happened.time
        assert repr(happened.time) in line
        assert record["kind"] == happened.kind
        assert record["entities"] == list(happened.entities)
        assert record["effect"] == happened.effect
        for name in ("died", "born", "clipped", "prints"):
            assert record.get(name, []) == list(getattr(happened, name))
            assert record.get(name) != []
        for name in ("wall", "span", "reason"):
            assert record.get(name) == getattr(happened, name)
            assert name not in record or record[name] is not None
        assert tuple(record["at"]) == happened.at


def test_event_lines_begin_as_documented(call: Call, scene: str) -> None:
    shown = call("run", scene, "--events", "-")
    pattern = r'\{"time": [0-9.e+-]+, "kind": "\w+", "entities": \[[0-9, ]+\], "effect": "\w+"'
    assert all(re.match(pattern, line) for line in shown.stdout.splitlines())


def test_events_to_a_file_leave_the_narration(call: Call, scene: str, tmp_path: Path) -> None:
    shown = call("run", scene, "--events", str(tmp_path / "events.jsonl"))
    assert len(lines_of(tmp_path / "events.jsonl")) == len(shown.stdout.splitlines()) - 2


def test_events_and_quiet(call: Call, scene: str, tmp_path: Path) -> None:
    shown = call("run", scene, "--quiet", "--events", str(tmp_path / "events.jsonl"))
    assert shown.output == ""
    assert lines_of(tmp_path / "events.jsonl")


# Worlds.


def test_final_world(call: Call, scene: str, tmp_path: Path) -> None:
    place = tmp_path / "final.json"
    assert call("run", scene, "--for", "3", "--final", str(place)).exit_code == 0
    end = evolve(world_of(scene), 3.0)
    record = json.loads(place.read_text(encoding="utf-8"))
    assert [record[name] for name in ("time", "width", "height", "seed", "model")] == [
        3.0, 400.0, 200.0, 4, "robust",
    ]  # fmt: skip
    assert [e["id"] for e in record["entities"]] == list(end.entities)
    for e in record["entities"]:
        entity = end[e["id"]]
        assert e["kind"] == type(entity).__name__.lower()
        names = ["name", "x", "y", "vx", "vy", "radius", "mass", "max_speed"]
        names += {
            "ship": ["direction", "thruster", "thrust_power"],
            "bullet": ["source", "bounced"],
            "asteroid": [],
        }[e["kind"]]
        assert set(e) - {"kind", "id", "program"} == set(names)
        assert [e[name] for name in names] == [getattr(entity, name) for name in names]
    assert {path.name for path in tmp_path.iterdir()} == {"scene.toml", "final.json"}


def test_final_to_standard_output(call: Call, scene: str) -> None:
    shown = call("run", scene, "--final", "-")
    assert json.loads(shown.stdout)["time"] == 20.0
    assert "seed 4" in shown.stderr


def test_final_replaces_a_file_and_keeps_its_mode(call: Call, scene: str, tmp_path: Path) -> None:
    place = tmp_path / "final.json"
    place.write_text("old")
    place.chmod(0o640)
    link = tmp_path / "link.json"
    link.symlink_to(place)
    assert call("run", scene, "--final", str(link)).exit_code == 0
    assert link.is_symlink()
    assert json.loads(place.read_text())["time"] == 20.0
    assert place.stat().st_mode & 0o777 == 0o640


def test_states_at_multiples(call: Call, scene: str, tmp_path: Path) -> None:
    place = tmp_path / "states.jsonl"
    call("run", scene, "--for", "2.1", "--states", str(place), "--every", "0.5")
    worlds = lines_of(place)
    assert [w["time"] for w in worlds] == [0.0, 0.5, 1.0, 1.5, 2.0]
    for w in worlds:
        world = evolve(world_of(scene), w["time"])
        assert [(e["x"], e["y"]) for e in w["entities"]] == [
            e.position for e in world.entities.values()
        ]


def test_states_include_the_end_if_it_is_a_multiple(call: Call, scene: str) -> None:
    shown = call("run", scene, "--for", "0.6", "--states", "-", "--every", "0.2")
    times = [json.loads(line)["time"] for line in shown.stdout.splitlines()]
    assert times == [0.0, 0.2, 0.4, 3 * 0.2][: len(times)]
    assert len(times) in (3, 4)  # 3 * 0.2 is a little more than 0.6
    shown = call("run", scene, "--for", "0.5", "--states", "-", "--every", "0.25")
    assert [json.loads(line)["time"] for line in shown.stdout.splitlines()] == [0.0, 0.25, 0.5]


def test_states_begin_at_the_first_multiple(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "late.toml"
    path.write_text("[world]\nwidth = 10\nheight = 10\ntime = 7.3\n")
    shown = call("run", str(path), "--for", "2", "--states", "-", "--every", "1")
    assert [json.loads(line)["time"] for line in shown.stdout.splitlines()] == [8.0, 9.0]


def test_looking_changes_no_event(call: Call, scene: str, tmp_path: Path) -> None:
    alone = call("run", scene, "--events", "-").stdout
    place = str(tmp_path / "states.jsonl")
    assert call("run", scene, "--events", "-", "--states", place, "--every", "0.1").stdout == alone


def test_max_events_bounds_a_sliced_run(call: Call, scene: str, tmp_path: Path) -> None:
    place = tmp_path / "states.jsonl"
    shown = call(
        "run", scene, "--max-events", "3", "--events", "-", "--states", str(place), "--every", "0.1"
    )
    assert len(shown.stdout.splitlines()) == 3
    third = json.loads(shown.stdout.splitlines()[-1])["time"]
    assert lines_of(place)[-1]["time"] <= third


# Summary.


def test_json_summary(call: Call, scene: str) -> None:
    shown = call("run", scene, "--for", "10", "--json")
    assert shown.stderr == ""
    assert shown.stdout.count("\n") == 1
    summary = json.loads(shown.stdout)
    log = happened_in(world_of(scene), 10.0)
    end = evolve(world_of(scene), 10.0)
    kinds = {happened.kind for happened in log}
    assert summary == {
        "scene": "scene.toml",
        "seed": 4,
        "model": "robust",
        "start": 0.0,
        "time": 10.0,
        "stopped": "time",
        "events": {kind: sum(h.kind == kind for h in log) for kind in kinds},
        "deaths": sum(len(h.died) for h in log),
        "births": sum(len(h.born) for h in log),
        "entities": {
            "ship": len(end.ships),
            "asteroid": len(end.asteroids),
            "bullet": len(end.bullets),
        },
    }


def test_max_events_says_so(call: Call, scene: str) -> None:
    shown = call("run", scene, "--max-events", "2", "--json")
    assert shown.exit_code == 0
    summary = json.loads(shown.stdout)
    assert summary["stopped"] == "max-events"
    assert sum(summary["events"].values()) == 2
    assert "stopped at" in shown.stderr
    assert "after 2 events; --max-events allows no more" in shown.stderr


def test_max_events_zero(call: Call, scene: str) -> None:
    shown = call("run", scene, "--max-events", "0", "--json")
    assert json.loads(shown.stdout)["events"] == {}
    assert "after 0 events" in shown.stderr


# Where scenes come from.


def test_scene_from_standard_input(call: Call, scene: str) -> None:
    from_file = call("run", scene).stdout.splitlines()
    from_stdin = call("run", "-", input=Path(scene).read_text()).stdout.splitlines()
    assert from_stdin[0].startswith("standard input: ")
    assert from_stdin[1:] == from_file[1:]


def shipped_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, **scenes: str) -> None:
    folder = tmp_path / "package" / "scenes"
    folder.mkdir(parents=True)
    for name, text in scenes.items():
        (folder / f"{name}.toml").write_text(text)
    monkeypatch.setattr("importlib.resources.files", lambda _: folder.parent)


def test_shipped_scene_by_name(call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shipped_folder(tmp_path, monkeypatch, duel="[world]\nwidth = 7\nheight = 8\n")
    monkeypatch.chdir(tmp_path)
    assert "duel: nothing in 7 x 8 km" in call("run", "duel").stdout
    (tmp_path / "duel").write_text("[world]\nwidth = 3\nheight = 4\n")
    assert "duel: nothing in 3 x 4 km" in call("run", "duel").stdout


def test_missing_scene_names_those_there_are(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shipped_folder(tmp_path, monkeypatch, duel="", default="")
    shown = call("run", "dual")
    assert shown.exit_code == 2
    assert "there is no scene 'dual' (did you mean 'duel'?)" in shown.stderr
    assert "or one of these: default, duel" in shown.stderr


def test_every_shipped_scene_runs(call: Call) -> None:
    from fasteroids.cli._files import shipped

    for name in shipped():
        shown = call("run", name, "--for", "2", "--max-events", "2000", "--quiet")
        assert shown.exit_code == 0, (name, shown.output)


# Overrides.


def test_model_and_seed_replace_those_of_the_scene(call: Call, scene: str) -> None:
    shown = call("run", scene, "--model", "spec", "--seed", "77", "--json")
    summary = json.loads(shown.stdout)
    assert (summary["model"], summary["seed"]) == ("spec", 77)


def test_seed_places_fields_anew(call: Call, busy: str) -> None:
    def places(seed: str) -> object:
        return json.loads(call("run", busy, "--for", "0", "--seed", seed, "--final", "-").stdout)[
            "entities"
        ]

    assert places("1") == places("1")
    assert places("1") != places("2")


# Bad input.


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("--for", "nan"), ("--for", "inf"), ("--for", "-1"), ("--for", "1e999"), ("--for", "soon"),
        ("--max-events", "-1"), ("--max-events", "1.5"), ("--max-events", "nan"),
        ("--seed", "1.5"), ("--seed", "nan"), ("--seed", "9" * 5000),
        ("--model", "robus"), ("--model", ""),
        ("--every", "0"), ("--every", "-1"), ("--every", "nan"), ("--every", "inf"),
    ],
)  # fmt: skip
def test_values_refused(call: Call, scene: str, option: str, value: str) -> None:
    states = ["--states", "-"] if option == "--every" else []
    shown = call("run", scene, *states, option, value)
    assert shown.exit_code == 2
    assert shown.stdout == ""
    assert f"Invalid value for '{option}'" in shown.stderr


def test_misspelt_model_gets_a_hint(call: Call, scene: str) -> None:
    assert "did you mean 'robust'?" in call("run", scene, "--model", "robus").stderr


@pytest.mark.parametrize(
    "options",
    [
        ["--json", "--quiet"], ["--states", "-"], ["--every", "1"],
        ["--events", "-", "--json"], ["--final", "-", "--json"], ["--events", "-", "--final", "-"],
        ["--states", "-", "--every", "1", "--events", "-"],
    ],
)  # fmt: skip
def test_options_that_exclude_each_other(call: Call, scene: str, options: list[str]) -> None:
    shown = call("run", scene, *options)
    assert shown.exit_code == 2
    assert "Usage:" in shown.stderr
    assert shown.stdout == ""


def test_one_file_for_two_outputs(call: Call, scene: str, tmp_path: Path) -> None:
    one, same = str(tmp_path / "out"), str(tmp_path / "." / "out")
    shown = call("run", scene, "--events", one, "--final", same)
    assert shown.exit_code == 2
    assert "cannot both be" in shown.stderr
    assert not (tmp_path / "out").exists()


def test_output_over_the_scene(call: Call, scene: str) -> None:
    before = Path(scene).read_text()
    assert call("run", scene, "--final", scene).exit_code == 2
    assert Path(scene).read_text() == before


def test_output_over_a_program(call: Call, tmp_path: Path) -> None:
    bot = tmp_path / "bot.ast"
    bot.write_text("fire;")
    for option in ("--events", "--final"):
        shown = call("run", "field-2013", "--bots", str(bot), option, str(bot))
        assert shown.exit_code == 2
        assert f"{option} and the program cannot both be {str(bot)!r}" in shown.stderr
        assert bot.read_text() == "fire;"


def test_nothing_is_written_for_a_bad_scene(call: Call, tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text("[world]\nwidth = 1\n")
    kept = tmp_path / "events.jsonl"
    kept.write_text("precious\n")
    assert call("run", str(tmp_path / "bad.toml"), "--events", str(kept)).exit_code == 2
    assert kept.read_text() == "precious\n"


@pytest.mark.parametrize("option", ["--events", "--final", "--states"])
def test_places_that_cannot_be_written(call: Call, scene: str, tmp_path: Path, option: str) -> None:
    every = ["--every", "1"] if option == "--states" else []
    for place in (tmp_path, tmp_path / "none" / "file", Path(scene) / "file"):
        shown = call("run", scene, option, str(place), *every)
        assert shown.exit_code == 2
        assert shown.stdout == ""
        assert shown.stderr.startswith("Error: cannot write ")
        assert shown.stderr.count("\n") == 1


@pytest.mark.parametrize("command", ["run", "audit", "explain"])
class TestBadScenes:
    """The same for every command: one sentence, exit code 2."""

    def refused(self, shown: Result) -> str:
        assert shown.exit_code == 2
        assert shown.stdout == ""
        assert "Traceback" not in shown.stderr
        return shown.stderr

    def test_missing(self, call: Call, command: str, tmp_path: Path) -> None:
        told = self.refused(call(command, str(tmp_path / "none.toml")))
        assert "there is no scene" in told
        assert told.count("\n") == 1

    def test_folder(self, call: Call, command: str, tmp_path: Path) -> None:
        told = self.refused(call(command, str(tmp_path)))
        assert told.startswith("Error: cannot read")
        assert told.count("\n") == 1

    def test_no_name(self, call: Call, command: str) -> None:
        self.refused(call(command, ""))

    def test_bytes_that_are_no_text(self, call: Call, command: str, tmp_path: Path) -> None:
        path = tmp_path / "bad.toml"
        path.write_bytes(b"[world]\nwidth = 1\n\xff\n")
        told = self.refused(call(command, str(path)))
        assert "bad.toml: a scene is text in UTF-8; the byte 0xff on line 3 is not" in told

    def test_not_toml(self, call: Call, command: str) -> None:
        told = self.refused(call(command, "-", input="[world\n"))
        assert "standard input: " in told
        assert "line 1" in told

    def test_every_problem_at_once(self, call: Call, command: str) -> None:
        told = self.refused(call(command, "-", input="[world]\nwidth = -1\nhight = 2\n"))
        assert re.search(r"standard input has \d problems:\n", told)
        assert "line 2" in told
        assert "line 3" in told

    def test_too_long(self, call: Call, command: str, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr("fasteroids.cli._files._MOST_BYTES", {"scene": 10})
        assert "at most 10 bytes" in self.refused(call(command, "-", input="[world]\nwidth = 1\n"))

    def test_mark_of_utf8_and_windows_lines_are_fine(
        self, call: Call, command: str, tmp_path: Path
    ) -> None:
        path = tmp_path / "windows.toml"
        path.write_bytes(b"\xef\xbb\xbf[world]\r\nwidth = 1\r\nheight = 1\r\n")
        assert call(command, str(path)).exit_code == 0


def test_samples_that_cannot_be_told_apart(call: Call, scene: str) -> None:
    shown = call("run", scene, "--states", "-", "--every", "1e-300")
    assert shown.exit_code == 2
    assert "too often" in shown.stderr


def test_time_past_the_end_of_floats(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "late.toml"
    path.write_text("[world]\nwidth = 10\nheight = 10\ntime = 1.7e308\n")
    shown = call("run", str(path), "--for", "1.7e308")
    assert shown.exit_code == 2
    assert "must be a finite number of seconds" in shown.stderr


# Errors of the scene during the run.


def stormy(world: World, until: float, **_: object) -> Iterator[tuple[Happened, World]]:
    """Two events, then the end of the rope."""
    unfold = happenings(world, until)
    yield next(unfold)
    yield next(unfold)
    raise ModelError("more than 7 events at the moment 1.0 s")


def test_error_of_the_scene_keeps_what_was_done(
    call: Call, scene: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fasteroids.cli._fold.happenings", stormy)
    final, events = tmp_path / "final.json", tmp_path / "events.jsonl"
    shown = call("run", scene, "--final", str(final), "--events", str(events))
    assert shown.exit_code == 2
    assert "failed at" in shown.stderr
    assert shown.stderr.endswith("Error: more than 7 events at the moment 1.0 s\n")
    assert len(lines_of(events)) == 2
    assert json.loads(final.read_text())["time"] == lines_of(events)[-1]["time"]
    assert len(shown.stdout.splitlines()) == 4


def test_json_of_what_is_not_finite(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "huge.toml"
    path.write_text(
        "[world]\nwidth = 1e200\nheight = 1e200\n[[asteroid]]\nx = 5e199\ny = 5e199\nradius = 1e150\n"
    )
    record = json.loads(call("run", str(path), "--final", "-").stdout)
    assert record["entities"][0]["mass"] is None
