"""The command line in processes of its own: Ctrl-C, readers that leave, terminals."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.unit.cli.conftest import PATIENCE, on_terminal

Spawn = Callable[..., "subprocess.Popen[bytes]"]

ENDLESS = ["--for", "1e9", "--max-events", "1000000000"]


def size(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0


def interrupted(process: subprocess.Popen[bytes], under_way: Callable[[], bool]) -> str:
    """Press Ctrl-C once it is under way; what it said on standard error."""
    deadline = time.monotonic() + PATIENCE
    while not under_way():
        assert process.poll() is None, process.stderr and process.stderr.read()
        assert time.monotonic() < deadline
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130, said
    assert b"Traceback" not in said
    return said.decode()


def test_ctrl_c_leaves_whole_lines_and_the_last_world(
    spawn: Spawn, busy: str, tmp_path: Path
) -> None:
    events, final, states = (tmp_path / name for name in ("events", "final", "states"))
    process = spawn(
        "run", busy, *ENDLESS, "--quiet", "--events", str(events), "--final", str(final),
        "--states", str(states), "--every", "0.1",
    )  # fmt: skip
    said = interrupted(process, lambda: size(events) > 200_000)
    assert "interrupted at " in said
    assert f"{str(events)!r} has all of them" in said
    assert f"{str(final)!r} has the world as it was then" in said
    log = events.read_text()
    assert log.endswith("\n")
    records = [json.loads(line) for line in log.splitlines()]
    assert f"after {len(records):,} events" in said
    samples = [json.loads(line) for line in states.read_text().splitlines()]
    assert states.read_text().endswith("\n")
    end = json.loads(final.read_text())
    assert end["time"] == max(records[-1]["time"], samples[-1]["time"])
    assert {path.name for path in tmp_path.iterdir()} == {"busy.toml", "events", "final", "states"}


def test_ctrl_c_ends_the_narration_with_a_summary(spawn: Spawn, busy: str, tmp_path: Path) -> None:
    told = tmp_path / "told"
    with told.open("wb") as file:
        process = spawn("run", busy, *ENDLESS, stdout=file)
        interrupted(process, lambda: size(told) > 100_000)
    lines = told.read_text().splitlines()
    assert told.read_text().endswith("\n")
    assert f"  {len(lines) - 2:,} events (" in lines[-1]


def test_ctrl_c_in_a_run_without_events(spawn: Spawn, tmp_path: Path) -> None:
    """Between two events the engine may cross cells for ever; it is interrupted there too."""
    scene = tmp_path / "scene.toml"
    still = "".join(f"[[asteroid]]\nx = {20 * i + 20}\ny = 20\nradius = 5\n" for i in range(40))
    runner = "[[asteroid]]\nx = 5e11\ny = 5e11\nvx = 0.001\nradius = 5\n"
    scene.write_text(f"[world]\nwidth = 1e12\nheight = 1e12\n{still}{runner}")
    states = tmp_path / "states"
    process = spawn(
        "run", str(scene), "--for", "1e6", "--quiet", "--states", str(states), "--every", "0.5"
    )
    assert "after 0 events" in interrupted(process, lambda: size(states) > 100_000)
    assert all(json.loads(line) for line in states.read_text().splitlines())


def test_ctrl_c_in_an_audit_prints_what_was_found(spawn: Spawn, busy: str) -> None:
    process = spawn("audit", busy, *ENDLESS, "--json")
    begun = time.monotonic()
    deadline = begun + PATIENCE
    # Nothing shows from outside that it is under way; long after the start it is.
    while time.monotonic() < begun + 2.0:
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    found, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    assert b"interrupted" in said
    assert json.loads(found)["stopped"] == "interrupted"


def test_reader_leaves(spawn: Spawn, busy: str) -> None:
    process = spawn("run", busy, *ENDLESS)
    assert process.stdout is not None
    assert process.stdout.readline().startswith(b"busy.toml: 60 asteroids")
    process.stdout.close()
    assert process.wait(PATIENCE) == 0
    assert process.stderr is not None
    assert process.stderr.read() == b""


def test_head_of_a_pipeline(busy: str) -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$0" -m fasteroids run "$1" --for 1e9 --events - | head -n 3',
         sys.executable, busy],
        capture_output=True, text=True, check=True, timeout=PATIENCE,
    )  # fmt: skip
    assert len([json.loads(line) for line in run.stdout.splitlines()]) == 3
    assert run.stderr.count("\n") == 1  # the seed and the model


def test_reader_leaves_but_a_file_is_wanted(spawn: Spawn, busy: str, tmp_path: Path) -> None:
    final = tmp_path / "final.json"
    process = spawn("run", busy, "--for", "2", "--final", str(final))
    assert process.stdout is not None
    process.stdout.close()
    assert process.wait(PATIENCE) == 0
    assert json.loads(final.read_text())["time"] == 2.0


def test_closed_standard_output(busy: str) -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$0" -m fasteroids run "$1" --for 1 >&-', sys.executable, busy],
        capture_output=True, text=True, check=False, timeout=PATIENCE,
    )  # fmt: skip
    assert (run.returncode, run.stderr) == (0, "")


def test_closed_standard_input() -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$0" -m fasteroids run - <&-', sys.executable],
        capture_output=True, text=True, check=False, timeout=PATIENCE,
    )  # fmt: skip
    assert (run.returncode, run.stderr) == (2, "Error: standard input is closed\n")


@pytest.mark.parametrize("option", ["", "--events", "--final"])
def test_full_disk(busy: str, tmp_path: Path, option: str) -> None:
    """The largest size of a file, which is nothing, plays the disk."""
    out = tmp_path / "out"
    words = [option, str(out)] if option else []
    with (tmp_path / "told").open("wb") as told:
        run = subprocess.run(
            ["/bin/sh", "-c", 'trap "" XFSZ; ulimit -f 0; exec "$0" "$@"', sys.executable,
             "-m", "fasteroids", "run", busy, "--for", "1", *words],
            stdout=subprocess.PIPE if option else told, stderr=subprocess.PIPE,
            check=False, timeout=PATIENCE, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        )  # fmt: skip
    assert run.returncode == 2
    assert run.stderr.startswith(b"Error: cannot write ")
    assert run.stderr.endswith(b"File too large\n")
    assert run.stderr.count(b"\n") == 1


def test_names_in_any_locale(spawn: Spawn, tmp_path: Path) -> None:
    scene = tmp_path / "scène.toml"
    scene.write_text(
        '[world]\nwidth = 99\nheight = 99\n[[asteroid]]\nname = "Éris ☄"\nx = 9\ny = 9\nvx = -9\nradius = 3\n',
        encoding="utf-8",
    )
    environment = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"}
    process = spawn("run", str(scene), "--for", "1", env=environment)
    told, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, said
    assert "Éris ☄ bounces off the left wall" in told.decode("utf-8")


# Terminals.


def test_progress_on_a_terminal(busy: str) -> None:
    seen, told = on_terminal("run", busy, *ENDLESS, "--json")
    assert b"events/s" in seen
    assert b"\x1b[3" not in seen  # NO_COLOR
    assert json.loads(told)["stopped"] == "interrupted"


@pytest.mark.parametrize("options", [["--quiet"], []])
def test_no_progress_where_it_disturbs(busy: str, options: list[str]) -> None:
    bounded = ["--for", "1e9", "--max-events", "15000"]
    seen, _ = on_terminal("run", busy, *bounded, *options, narrate=not options)
    assert b"events/s" not in seen


def test_no_progress_in_a_file(spawn: Spawn, busy: str) -> None:
    process = spawn("run", busy, "--for", "1e9", "--max-events", "20000", "--json")
    _, said = process.communicate(timeout=PATIENCE)
    assert said.count(b"\n") == 1
    assert said.startswith(b"stopped at ")
