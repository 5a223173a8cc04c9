"""`fasteroids arena` in processes of its own: Ctrl-C, and going on; processes that die; terminals."""

from __future__ import annotations

import json
import os
import pty
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

Spawn = Callable[..., "subprocess.Popen[bytes]"]

PATIENCE = 60.0  # s; far more than any of these takes
MANY = [
    "arena",
    "field-2013",
    "--bots",
    "spinner,opponent-2013",
    "--seeds",
    "0-9999",
    "--jobs",
    "2",
]
FEW = [*MANY[:5], "0-19", "--json"]


def until(process: subprocess.Popen[bytes], happened: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not happened():
        assert process.poll() is None, process.stderr and process.stderr.read()
        assert time.monotonic() < deadline
        time.sleep(0.02)


def lines(folder: Path) -> list[str]:
    return [line for place in folder.glob("*") for line in place.read_text().splitlines()]


def processes() -> dict[int, tuple[int, str]]:
    """The living processes by number: the parent of each, and its command line."""
    if not Path("/proc/self/stat").exists():
        return told_by_ps()
    found = {}
    for place in Path("/proc").glob("[0-9]*"):
        try:
            state, parent = (place / "stat").read_text().rpartition(")")[2].split()[:2]
            command = (place / "cmdline").read_text(errors="replace")
        except OSError:  # it has just ended
            continue
        if state != "Z":
            found[int(place.name)] = int(parent), command
    return found


def told_by_ps() -> dict[int, tuple[int, str]]:
    """The same where there is no /proc."""
    ps = ["ps", "-A", "-o", "pid=,ppid=,stat=,args="]
    told = subprocess.run(ps, capture_output=True, text=True, check=True).stdout
    rows = [line.split(None, 3) for line in told.splitlines()]
    return {int(row[0]): (int(row[1]), row[3]) for row in rows if row[2][0] != "Z"}


def children(pid: int) -> list[int]:
    """The living processes that a process started to play."""
    return [
        child
        for child, (parent, command) in processes().items()
        if parent == pid and "spawn_main" in command
    ]


def living(pid: int) -> bool:
    return pid in processes()


@pytest.mark.parametrize(
    ("jobs", "press"), [("1", signal.SIGINT), ("2", signal.SIGINT), ("2", signal.SIGTERM)]
)
def test_after_ctrl_c_the_same_command_goes_on(
    spawn: Spawn, tmp_path: Path, jobs: str, press: signal.Signals
) -> None:
    kept = tmp_path / "kept"
    first = spawn(*MANY, "--jobs", jobs, "--keep", str(kept))
    until(first, lambda: len(lines(kept)) > 10)
    first.send_signal(press)
    told, said = first.communicate(timeout=PATIENCE)
    assert (first.returncode, told) == (130, b"")
    match = re.fullmatch(
        r"interrupted: ([\d,]+) of 20,000 games are done; the same command goes on from there\n",
        said.decode(),
    )
    assert match is not None, said
    done = int(match[1].replace(",", ""))
    assert len([json.loads(line) for line in lines(kept)]) == done
    again = spawn(*FEW, "--keep", str(kept))
    resumed, said = again.communicate(timeout=PATIENCE)
    assert re.fullmatch(rb"kept from before: \d+ of 40 games\n", said)
    fresh, said = spawn(*FEW, "--fresh", "--keep", str(kept)).communicate(timeout=PATIENCE)
    assert said == b""
    assert resumed == fresh


def test_ctrl_c_of_all_that_was_not_kept(spawn: Spawn, tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    process = spawn(*MANY, "--keep", str(file))
    until(process, lambda: bool(children(process.pid)))
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    assert said.splitlines()[-1].endswith(
        b" of 20,000 games are done; what came after the warning is not kept"
    )
    assert b"Traceback" not in said


def test_a_killed_process_loses_no_game(spawn: Spawn, tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    asked = [*FEW, "--jobs", "2"]
    process = spawn(*asked, "--keep", str(kept))
    until(process, lambda: len(lines(kept)) > 2)
    for pid in children(process.pid)[:1]:
        os.kill(pid, signal.SIGKILL)
    told, said = process.communicate(timeout=PATIENCE)
    assert (process.returncode, said) == (0, b"")
    assert told == spawn(*asked, "--keep", str(tmp_path / "other")).communicate(timeout=PATIENCE)[0]


def test_processes_end_with_the_one_that_started_them(spawn: Spawn, tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    process = spawn(*MANY, "--keep", str(kept))
    until(process, lambda: len(lines(kept)) > 2)
    players = children(process.pid)
    assert len(players) == 2
    process.kill()
    process.wait(PATIENCE)
    deadline = time.monotonic() + PATIENCE
    while any(map(living, players)):
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_progress_on_a_terminal(tmp_path: Path) -> None:
    leader, follower = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "fasteroids", *MANY, "--keep", str(tmp_path)],
        stdout=subprocess.PIPE, stderr=follower, stdin=subprocess.DEVNULL,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "80", "NO_COLOR": "1"},
    )  # fmt: skip
    os.close(follower)
    seen, pressed = b"", False
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        try:
            seen += os.read(leader, 65536)
        except OSError:  # the other end is closed
            break
        if b" left" in seen and not pressed:
            process.send_signal(signal.SIGINT)
            pressed = True
    told, _ = process.communicate(timeout=PATIENCE)
    os.close(leader)
    assert re.search(rb"\d+ of 20,000 games, (\d+:)?\d+:\d\d left", seen)
    assert b"interrupted: " in seen.rstrip().splitlines()[-1]
    assert b"\x1b[3" not in seen  # NO_COLOR
    assert (process.returncode, told) == (130, b"")


def test_head_of_a_pipeline(tmp_path: Path) -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$@" | head -n 1', "sh", sys.executable, "-m", "fasteroids", *FEW[:-1], "--keep", tmp_path],
        capture_output=True, text=True, check=True, timeout=PATIENCE,
    )  # fmt: skip
    assert run.stdout.startswith("field-2013: 2 bots, each alone on 20 seeds")
    assert run.stderr == ""


def test_importing_the_command_line_loads_no_processes() -> None:
    code = "import sys, fasteroids.cli, fasteroids.cli.run; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"multiprocessing", "concurrent.futures", "fasteroids.arena"} & {*run.stdout.split()}
