"""Scenes on disk, and ways to call the command line."""

from __future__ import annotations

import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from fasteroids.cli import main

PATIENCE = 60.0  # s; far more than any of these takes

SCENE = """
[world]
width = 400
height = 200
seed = 4

[[ship]]
name = "red"
x = 50
y = 20
vx = 60
radius = 10
mass = 5e15

[[ship]]
name = "blue"
x = 350
y = 180
vx = -80
radius = 10
mass = 5e15

[[asteroid]]
x = 200
y = 100
radius = 40

[[bullet]]
x = 120
y = 100
vx = 150
radius = 3
source = "red"
"""

BUSY = """
[world]
width = 2000
height = 2000

[[asteroid-field]]
count = 60
radius = 30
speed = [100, 900]
"""


@pytest.fixture(autouse=True)
def cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of its own for each test, also for the processes it starts: none touches that of the user."""
    folder = tmp_path_factory.mktemp("cache")
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder))
    monkeypatch.setenv("COLUMNS", "100")
    return folder


@pytest.fixture
def scene(tmp_path: Path) -> str:
    """A scene in which something of everything happens in 10 s."""
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return str(path)


@pytest.fixture
def busy(tmp_path: Path) -> str:
    """A scene with thousands of events a second of its own time."""
    path = tmp_path / "busy.toml"
    path.write_text(BUSY, encoding="utf-8")
    return str(path)


@pytest.fixture
def call() -> Callable[..., Result]:
    """Call the command line in this process."""
    return lambda *args, **settings: CliRunner().invoke(main, list(args), **settings)


@pytest.fixture
def recording(call: Callable[..., Result], tmp_path: Path) -> str:
    """A recording of 20 s of two ships that shoot at each other and at asteroids, with two snapshots."""
    path = tmp_path / "duel.jsonl"
    shown = call("record", "one-on-one", "--bots", "turret,turret", "--seed", "5", "-o", str(path))
    assert shown.exit_code == 0, shown.stderr
    return str(path)


@pytest.fixture
def spawn() -> Iterator[Callable[..., subprocess.Popen[bytes]]]:
    """Start the command line in a process of its own, its output in pipes."""
    started: list[subprocess.Popen[bytes]] = []

    def start(*args: str, **settings: Any) -> subprocess.Popen[bytes]:
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.DEVNULL}
        environment = {**os.environ, "COLUMNS": "100"}
        command = [sys.executable, "-m", "fasteroids", *args]
        started.append(subprocess.Popen(command, **{**pipes, "env": environment, **settings}))
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.wait()
        for stream in (process.stdout, process.stderr):
            if stream is not None:
                stream.close()


def on_terminal(*args: str, narrate: bool = False) -> tuple[bytes, bytes]:
    """What a command writes to a terminal that is its standard error, and to its standard output.

    Ctrl-C is pressed when it shows how many events a second there are.
    """
    leader, follower = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "fasteroids", *args],
        stdout=follower if narrate else subprocess.PIPE, stderr=follower, stdin=subprocess.DEVNULL,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "1"},
    )  # fmt: skip
    os.close(follower)
    seen, pressed = b"", False
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        try:
            piece = os.read(leader, 65536)
        except OSError:  # the other end is closed
            break
        seen += piece
        if b"events/s" in seen and process.poll() is None and not pressed:
            process.send_signal(signal.SIGINT)
            pressed = True
    told, _ = process.communicate(timeout=PATIENCE)
    os.close(leader)
    return seen, told or b""
