"""`fasteroids show`: a summary, a moment, a death."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from fasteroids import Fire, World, evolve_until, load_scene
from fasteroids.cli import _records as records
from fasteroids.history import begin
from fasteroids.history.recording import Recording, read
from fasteroids.history.recording.loading import recorded

Call = Callable[..., Result]


@pytest.fixture
def opened(recording: str) -> Recording:
    return read(Path(recording).read_bytes())


@pytest.fixture
def played(scene: str, tmp_path: Path) -> str:
    """A recording with inputs and bookmarks, in which a ship dies."""
    world = load_scene(Path(scene).read_text(encoding="utf-8"))
    timeline = begin(world).evolve_until(0.1).act(2, Fire()).bookmark("before the\nend")
    timeline = timeline.evolve_until(0.2).remove(1).evolve_until(30.0).bookmark("end")
    place = tmp_path / "played.jsonl"
    place.write_text(recorded(timeline, title="scene.toml"))
    return str(place)


def rows(text: str) -> dict[str, list[str]]:
    """The rows of a summary by their heads."""
    found: dict[str, list[str]] = {}
    for line in text.splitlines():
        head, _, said = line.partition(" ")
        found.setdefault(head, []).append(said.strip())
    return found


# Summary.


def test_summary(call: Call, recording: str, opened: Recording) -> None:
    shown = call("show", recording)
    assert (shown.exit_code, shown.stderr) == (0, "")
    told = rows(shown.stdout)
    assert told["recording"] == [recording]
    assert told["of"] == ["one-on-one: 2 ships and 4 asteroids"]
    assert told["game"] == ["model smooth, seed 5, fuel 10000"]
    assert told["time"] == ["from 0 s to 20 s, ended by time"]
    assert opened.result is not None
    assert told["events"][0].startswith(f"{sum(opened.result.events.values())} events (")
    assert told["lines"][0].startswith(f"{len(opened.lines) + 1} lines, 0 inputs, 0 prints, 2 snap")
    assert re.fullmatch(r"[0-9a-f]{12} \(\d+ lines\)", told["programs"][0])
    assert "bookmark" not in told


def test_summary_as_json(call: Call, recording: str, opened: Recording) -> None:
    found: dict[str, Any] = json.loads(call("show", recording, "--json").stdout)
    assert opened.result is not None
    assert found["events"] == dict(opened.result.events)
    assert (found["ended"], found["short"], found["start"], found["time"]) == ("time", None, 0, 20)
    happened = [line.happened for line in opened.lines if hasattr(line, "happened")]
    dead = [(h.time, list(h.died)) for h in happened if h.died]
    assert [(death["time"], death["died"]) for death in found["deaths"]] == dead
    splits = [h for h in happened if h.effect == "split"]
    left = [death["left"] for death in found["deaths"] if death["left"]]
    assert [len(each) for each in left] == [len(h.born) for h in splits]


def test_deaths_are_told_in_words(call: Call, recording: str) -> None:
    deaths = json.loads(call("show", recording, "--json").stdout)["deaths"]
    told = rows(call("show", recording).stdout)["death"]
    assert len(told) == min(len(deaths), 20)
    split = next(i for i, death in enumerate(deaths) if death["left"])
    one, other = deaths[split]["who"]
    a, b = deaths[split]["left"]
    assert told[split].endswith(f"s: {one} and {other} die in a contact, which leaves {a} and {b}")


def test_a_shipped_recording_needs_no_rules_to_be_told(call: Call, recording: str) -> None:
    """A summary is what the file says: it is not lived again, which may come to something else."""
    text = Path(recording).read_text()
    Path(recording).write_text(text.replace('"effect":"split"', '"effect":"bounce"', 1))
    assert call("show", recording).exit_code == 0


def test_inputs_and_bookmarks(call: Call, played: str) -> None:
    told = rows(call("show", played).stdout)
    assert " 5 inputs," in told["lines"][0]  # two, and three cuts
    assert told["bookmark"] == [r"'before the\nend' at 0.1 s", "'end' at 30 s"]
    found = json.loads(call("show", played, "--json").stdout)
    assert [mark["time"] for mark in found["bookmarks"]] == [0.1, 30.0]


def test_cut_short(call: Call, recording: str) -> None:
    data = Path(recording).read_bytes()
    Path(recording).write_bytes(data[:-1000])
    shown = call("show", recording)
    assert shown.exit_code == 0
    assert shown.stderr.startswith(f"{recording}: it is cut short in line ")
    assert rows(shown.stdout)["time"][0].split(", ")[1].startswith("it is cut short in line ")
    assert json.loads(call("show", recording, "--json").stdout)["ended"] is None


@pytest.mark.parametrize("field", ["title", "fasteroids", "python", "ended"])
def test_what_a_terminal_would_obey_is_not_printed(call: Call, recording: str, field: str) -> None:
    text = Path(recording).read_text()
    changed, count = re.subn(f'"{field}":"[^"]*"', rf'"{field}":"\\u001b[2Jgone"', text)
    assert count == 1
    Path(recording).write_text(changed)
    shown = call("show", recording)
    assert shown.exit_code == 0
    assert "\x1b" not in shown.stdout
    assert r"\x1b[2Jgone" in shown.stdout


# The world at a time.


def world_at(opened: Recording, time: float) -> World:
    return evolve_until(opened.world, time)


@pytest.mark.parametrize("time", [0.0, 0.2, 9.99, 10.0, 13.7, 20.0])
def test_the_world_at_a_time(call: Call, recording: str, opened: Recording, time: float) -> None:
    world = world_at(opened, time)
    shown = call("show", recording, "--at", repr(time), "--json")
    assert shown.exit_code == 0
    assert shown.stdout == records.compact(records.world_record(world)) + "\n"
    scene = call("show", recording, "--at", repr(time), "--scene").stdout
    assert load_scene(scene) == world


def test_the_world_as_a_table(call: Call, recording: str, opened: Recording) -> None:
    world = world_at(opened, 3.0)
    head, blank, names, *lines = call("show", recording, "--at", "3").stdout.splitlines()
    assert head.startswith(f"{recording} at 3.0 s: ")
    assert blank == ""
    assert names.split() == ["id", "kind", "name", "x", "y", "vx", "vy", "radius"]
    assert len(lines) == len(world.entities)
    for line, e in zip(lines, world.entities.values(), strict=True):
        assert line.split()[:2] == [str(e.id), e.kind]
        assert f"{e.x:.6g}" in line
        assert f"{e.vy:.6g}" in line
    assert "West" in lines[0]
    assert lines[0].endswith(", program runs")


def test_an_empty_world(call: Call, tmp_path: Path) -> None:
    out = str(tmp_path / "out")
    call("record", "-", "-o", out, input="[world]\nwidth = 9\nheight = 9\n")
    shown = call("show", out, "--at", "1")
    assert shown.exit_code == 0
    assert shown.stdout == f"{out} at 1.0 s: nothing in 9 x 9 km\n\n"


@pytest.mark.parametrize("time", ["20.0001", "1e9", "1e308"])
def test_a_time_that_is_not_in_it(call: Call, recording: str, time: str) -> None:
    shown = call("show", recording, "--at", time)
    assert shown.exit_code == 2
    assert "goes from 0.0 s to 20.0 s; there is no" in shown.stderr


@pytest.mark.parametrize(
    "args",
    [["--at", "-1"], ["--at", "nan"], ["--at", "1", "--why", "x"], ["--scene"],
     ["--at", "1", "--scene", "--json"]],
)  # fmt: skip
def test_options_that_make_no_sense(call: Call, recording: str, args: list[str]) -> None:
    shown = call("show", recording, *args)
    assert shown.exit_code == 2
    assert "Usage: " in shown.stderr


# How somebody died.


def test_why_a_bullet_and_an_asteroid_died(call: Call, recording: str) -> None:
    deaths = json.loads(call("show", recording, "--json").stdout)["deaths"]
    contact = next(death for death in deaths if death["how"] == "contact")
    bullet = next(
        i for i, who in zip(contact["died"], contact["who"], strict=True) if "bullet" in who
    )
    shown = call("show", recording, "--why", str(bullet))
    assert shown.exit_code == 0
    head, fixed, *rest = shown.stdout.splitlines()
    assert head.startswith(f"bullet #{bullet} died at {contact['time']!r} s in a contact with ast")
    assert fixed.startswith("  it was fixed from ")
    assert any(re.fullmatch(r"  ship #\d fired: fire at .* s \(line \d+\)", line) for line in rest)
    found = json.loads(call("show", recording, "--why", f"#{bullet}", "--json").stdout)
    assert (found["entity"], found["time"], found["how"]) == (bullet, contact["time"], "contact")
    assert found["flights"][0]["entity"] == bullet
    assert found["shots"][0]["action"] == "fire"


@pytest.mark.parametrize(
    ("who", "why"),
    [
        ("West", "ship 'West' is alive at 20.0 s"),
        ("1", "ship 'West' is alive at 20.0 s"),
        ("Wset", "there was no 'Wset' (did you mean 'West'?)"),
        ("9999", "there was no '9999'; give a name or an id, 1 to "),
        ("", "there was no ''"),
    ],
)
def test_who_did_not_die(call: Call, recording: str, who: str, why: str) -> None:
    shown = call("show", recording, "--why", who)
    assert shown.exit_code == 2
    assert why in shown.stderr
    assert shown.stdout == ""


def test_taken_out_is_no_death(call: Call, played: str) -> None:
    shown = call("show", played, "--why", "red")
    assert shown.exit_code == 2
    assert "did not die; it was taken out at 0.2 s" in shown.stderr


def test_of_those_of_a_name_the_one_that_died_last(call: Call, tmp_path: Path) -> None:
    still = "[[asteroid]]\nname = 'target'\nid = {}\nx = {}\ny = 50\nradius = 9\n"
    shot = "[[bullet]]\nx = {}\ny = 50\nvx = {}\nradius = 2\nsource = 9\n"
    text = "[world]\nwidth = 900\nheight = 100\n" + still.format(1, 100) + still.format(2, 500)
    out = str(tmp_path / "out")
    scene = text + still.format(3, 800) + shot.format(200, -10) + shot.format(400, 100)
    assert call("record", "-", "-o", out, input=scene).exit_code == 0
    found = json.loads(call("show", out, "--why", "target", "--json").stdout)
    assert found["entity"] == 1  # 2 dies sooner, 3 lives
    assert json.loads(call("show", out, "--why", "2", "--json").stdout)["time"] < found["time"]
