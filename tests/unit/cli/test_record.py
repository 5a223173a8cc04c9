"""`fasteroids record`: a run into a file."""

from __future__ import annotations

import gzip
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from fasteroids import happenings, load_scene
from fasteroids.history.inputs import Cut
from fasteroids.history.recording import Entered, Event, Recording, read, verified
from tests.unit.cli.conftest import PATIENCE, on_terminal

Call = Callable[..., Result]
Spawn = Callable[..., "subprocess.Popen[bytes]"]

ENDLESS = ["--for", "1e9", "--max-events", "1000000000"]

LITERAL = """
[world]
width = 5000
height = 1000
model = "robust"

[[ship]]
name = "red"
x = 100
y = 100
radius = 10
mass = 5e15
program-text = 'thrust; while (true) { skip; }'
"""


def read_from(path: Path | str) -> Recording:
    return read(Path(path).read_bytes())


def test_every_event_of_the_run_is_in_it_and_happens_again(
    call: Call, scene: str, tmp_path: Path
) -> None:
    out = tmp_path / "out.jsonl"
    shown = call("record", scene, "-o", str(out), "--for", "10")
    assert shown.exit_code == 0
    assert shown.stdout == ""
    world = load_scene(Path(scene).read_text())
    happened = [each for each, _ in happenings(world, 10.0)]
    found = read_from(out)
    assert [line.happened for line in found.lines if isinstance(line, Event)] == happened
    assert (found.world, found.time, found.short) == (world, 10.0, None)
    assert found.header.title == "scene.toml"
    assert found.result is not None
    assert found.result.ended == "time"
    assert verified(found).difference is None
    assert shown.stderr == (
        f"scene.toml: {len(happened)} events from 0 s to 10 s, seed 4, model robust: "
        f"{out.stat().st_size:,} bytes of lines in {str(out)!r}\n"
    )


def test_the_same_run_gives_the_same_bytes(call: Call, scene: str, tmp_path: Path) -> None:
    places = [tmp_path / name for name in "ab"]
    for place in places:
        assert call("record", scene, "-o", str(place)).exit_code == 0
    assert places[0].read_bytes() == places[1].read_bytes()


def test_gz_is_gzip_of_the_same_lines(call: Call, scene: str, tmp_path: Path) -> None:
    plain, packed = tmp_path / "a.jsonl", tmp_path / "a.jsonl.gz"
    for place in (plain, packed):
        assert call("record", scene, "-o", str(place)).exit_code == 0
    assert gzip.decompress(packed.read_bytes()) == plain.read_bytes()
    assert packed.stat().st_size < plain.stat().st_size


def test_standard_output(call: Call, scene: str, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    call("record", scene, "-o", str(out))
    shown = call("record", scene, "-o", "-")
    assert shown.stdout_bytes == out.read_bytes()
    assert shown.stderr.endswith("bytes of lines in standard output\n")


def test_seed_model_and_bots_are_in_the_header(call: Call, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    args = ["--seed", "9", "--model", "robust", "--bots", "turret,turret", "--for", "1"]
    assert call("record", "one-on-one", "-o", str(out), *args).exit_code == 0
    header = read_from(out).header
    assert (header.seed, header.model, len(header.programs)) == (9, "robust", 1)


def test_how_often_there_are_hashes_and_snapshots(call: Call, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    args = ["--for", "1", "--hashes", "0.1", "--snapshots", "0.25"]
    ball = "[world]\nwidth = 50\nheight = 50\n[[asteroid]]\nx = 9\ny = 9\nvx = 9000\nradius = 9\n"
    assert call("record", "-", "-o", str(out), *args, input=ball).exit_code == 0
    kinds = [json.loads(line)["type"] for line in out.read_text().splitlines()]
    assert (kinds.count("hash"), kinds.count("snapshot")) == (10, 4)


@pytest.mark.parametrize("option", ["--hashes", "--snapshots"])
@pytest.mark.parametrize("value", ["0", "1e-9", "nan", "often"])
def test_intervals_that_make_no_sense(
    call: Call, scene: str, tmp_path: Path, option: str, value: str
) -> None:
    out = tmp_path / "out.jsonl"
    shown = call("record", scene, "-o", str(out), option, value)
    assert shown.exit_code == 2
    assert option in shown.stderr
    assert not out.exists()


def test_under_literal_thrust_the_cuts_are_recorded(call: Call, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(LITERAL)
    ends = []
    for every in ("0.5", "0.7"):
        out = tmp_path / every
        shown = call(
            "record", str(tmp_path / "scene.toml"), "-o", str(out), "--for", "5", "--every", every
        )
        assert shown.exit_code == 0, shown.stderr
        found = read_from(out)
        assert (found.header.cuts, found.header.slice) == ("recorded", float(every))
        assert verified(found).difference is None
        cuts = [line.given.what for line in found.lines if isinstance(line, Entered)]
        assert len(cuts) == {"0.5": 12, "0.7": 9}[every]  # those at 0 s and at the end too
        assert all(isinstance(cut, Cut) for cut in cuts)
        assert found.result is not None
        ends.append(found.result.hash)
    assert ends[0] != ends[1]


def test_cuts_change_nothing_where_they_are_free(call: Call, tmp_path: Path) -> None:
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    for out, args in ((whole, []), (cut, ["--every", "0.3"])):
        assert call("record", "thrust", "--model", "smooth", "-o", str(out), *args).exit_code == 0
    head, *lines = cut.read_text().splitlines()
    assert json.loads(head)["slice"] == 0.3
    bare = [line for line in whole.read_text().splitlines()[1:] if '"result"' not in line]
    assert [line for line in lines if '"result"' not in line] == bare


def test_a_file_is_not_overwritten_unless_that_is_wanted(
    call: Call, scene: str, tmp_path: Path
) -> None:
    out = tmp_path / "out.jsonl"
    out.write_text("precious\n" * 10_000)
    shown = call("record", scene, "-o", str(out))
    assert shown.exit_code == 2
    assert shown.stderr == f"Error: there is a file {str(out)!r} already; --force replaces it\n"
    assert out.read_text() == "precious\n" * 10_000
    forced = call("record", scene, "-o", str(out), "--force")
    assert forced.exit_code == 0
    assert forced.stderr.endswith(", which was replaced\n")
    assert read_from(out).short is None


def test_a_bad_scene_leaves_the_old_file_alone(call: Call, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    out.write_text("precious\n")
    shown = call("record", "-", "-o", str(out), "--force", input="[world]\nwidth = -1\n")
    assert shown.exit_code == 2
    assert out.read_text() == "precious\n"


def test_summary_as_json(call: Call, scene: str, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    shown = call("record", scene, "-o", str(out), "--json")
    assert shown.stderr == ""
    summary: dict[str, Any] = json.loads(shown.stdout)
    assert summary["recording"] == str(out)
    assert summary["bytes"] == out.stat().st_size
    result = read_from(out).result
    assert result is not None
    assert summary["events"] == dict(result.events)
    assert (summary["stopped"], summary["time"]) == ("time", 20.0)


def test_quiet(call: Call, scene: str, tmp_path: Path) -> None:
    shown = call("record", scene, "-o", str(tmp_path / "out"), "--quiet")
    assert (shown.exit_code, shown.output) == (0, "")


def test_stopped_after_so_many_events(call: Call, busy: str, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    shown = call("record", busy, "-o", str(out), "--max-events", "100")
    assert shown.exit_code == 0
    assert "--max-events allows no more" in shown.stderr
    found = read_from(out)
    assert found.result is not None
    assert (found.result.ended, sum(found.result.events.values())) == ("max-events", 100)
    assert verified(found).difference is None


@pytest.mark.parametrize(
    ("args", "why"),
    [
        ([], "Missing option '-o'"),
        (["-o", "."], "it is a folder"),
        (["-o", "none/x"], "there is no folder"),
        (["-o", "x", "--json", "--quiet"], "exclude each other"),
        (["-o", "-", "--json"], "cannot both be standard output"),
        (["-o", "x", "--every", "1e-300"], "too often"),
    ],
)
def test_what_cannot_be_recorded(
    call: Call,
    scene: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    args: list[str],
    why: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    shown = call("record", scene, *args)
    assert shown.exit_code == 2
    assert why in shown.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["scene.toml"]


def test_the_scene_is_not_overwritten(call: Call, scene: str) -> None:
    before = Path(scene).read_text()
    shown = call("record", scene, "-o", scene, "--force")
    assert shown.exit_code == 2
    assert "cannot both be" in shown.stderr
    assert Path(scene).read_text() == before


# In processes of their own.


def under_way(process: subprocess.Popen[bytes], out: Path, size: int) -> None:
    """Wait until so many bytes are in the file."""
    deadline = time.monotonic() + PATIENCE
    while not out.exists() or out.stat().st_size < size:
        assert process.poll() is None, process.stderr and process.stderr.read()
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.mark.parametrize("name", ["out.jsonl", "out.jsonl.gz"])
@pytest.mark.parametrize("kind", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_ends_a_recording_that_is_whole(
    spawn: Spawn, busy: str, tmp_path: Path, kind: signal.Signals, name: str
) -> None:
    out = tmp_path / name
    process = spawn("record", busy, *ENDLESS, "-o", str(out))
    under_way(process, out, 50_000)
    process.send_signal(kind)
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130, said
    assert said.startswith(b"interrupted at ")
    assert said.endswith(f"{str(out)!r} has all of them\n".encode())
    found = read_from(out)
    assert found.short is None
    assert found.result is not None
    assert found.result.ended == "interrupted"
    assert f"after {sum(found.result.events.values()):,} events" in said.decode()
    assert verified(found).difference is None


@pytest.mark.parametrize("name", ["out.jsonl", "out.jsonl.gz"])
def test_what_is_killed_can_be_read_up_to_the_last_flush(
    spawn: Spawn, call: Call, busy: str, tmp_path: Path, name: str
) -> None:
    out = tmp_path / name
    process = spawn("record", busy, *ENDLESS, "-o", str(out))
    under_way(process, out, 50_000)
    process.kill()
    process.communicate(timeout=PATIENCE)
    found = read_from(out)
    assert found.short is not None
    assert len(found.lines) > 100
    shown = call("verify", str(out))
    assert shown.exit_code == 0
    assert shown.stdout.startswith(f"{out}: ok as far as it goes, ")


def test_a_reader_that_leaves_ends_it_quietly(busy: str) -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$0" -m fasteroids record "$1" --for 1e9 -o - | head -n 3',
         sys.executable, busy],
        capture_output=True, text=True, check=True, timeout=PATIENCE,
    )  # fmt: skip
    assert [json.loads(line)["type"] for line in run.stdout.splitlines()][:2] == ["header", "event"]
    assert run.stderr == ""


def test_closed_standard_output(busy: str) -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$0" -m fasteroids record "$1" --for 1 -o - --quiet >&-', sys.executable,
         busy],
        capture_output=True, text=True, check=False, timeout=PATIENCE,
    )  # fmt: skip
    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize("to_stdout", [True, False])
def test_full_disk(busy: str, tmp_path: Path, to_stdout: bool) -> None:
    """The largest size of a file, which is nothing, plays the disk."""
    out = "-" if to_stdout else str(tmp_path / "out")
    with (tmp_path / "told").open("wb") as told:
        run = subprocess.run(
            ["/bin/sh", "-c", 'trap "" XFSZ; ulimit -f 0; exec "$0" "$@"', sys.executable,
             "-m", "fasteroids", "record", busy, "--for", "1", "-o", out],
            stdout=told, stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE,
            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        )  # fmt: skip
    assert run.returncode == 2
    what = "standard output" if to_stdout else repr(out)
    assert run.stderr == f"Error: cannot write {what}: File too large\n"


@pytest.mark.parametrize("name", ["out.jsonl", "out.jsonl.gz"])
def test_a_disk_that_gets_full_leaves_what_can_be_read(
    busy: str, tmp_path: Path, name: str
) -> None:
    """The largest size of a file plays the disk; the system then says "File too large"."""
    out = tmp_path / name
    run = subprocess.run(
        ["/bin/sh", "-c", 'trap "" XFSZ; ulimit -f 100; exec "$0" -m fasteroids record "$1" --for 1e9 -o "$2"',
         sys.executable, busy, str(out)],
        capture_output=True, text=True, check=False, timeout=PATIENCE,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip
    assert run.returncode == 2
    assert run.stderr == f"Error: cannot write {str(out)!r}: File too large\n"
    found = read_from(out)
    assert found.short is not None
    assert verified(found).difference is None
    assert len(found.lines) > 100


def test_progress_on_a_terminal(busy: str, tmp_path: Path) -> None:
    seen, _ = on_terminal("record", busy, *ENDLESS, "-o", str(tmp_path / "out"))
    assert b"events/s" in seen
    assert b"interrupted at " in seen
    assert read_from(tmp_path / "out").short is None
