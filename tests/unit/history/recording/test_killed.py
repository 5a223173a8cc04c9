"""A recording whose process is killed outright loses its last second at the most."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fasteroids.history.recording import Event, read, verified

PROGRAM = """
import sys, time
from fasteroids import load_scene
from fasteroids.history.living import beginning, lived
from fasteroids.history.recording import RecordingFile
from fasteroids.moments import clock_at

SCENE = '''
[world]
width = 300
height = 300
model = "smooth"
[[asteroid-field]]
count = 8
radius = 15
speed = [30, 90]
'''
world = load_scene(SCENE)
with open(sys.argv[1], "wb") as file:
    writing = RecordingFile(file, world, clock=time.monotonic, packed=sys.argv[1].endswith("gz"))
    for state in lived(beginning(world), clock_at(1e9)):
        writing.add(state)
        print(time.monotonic(), flush=True)
        time.sleep(0.01)
"""


@pytest.mark.parametrize("name", ["killed.jsonl", "killed.jsonl.gz"])
def test_a_killed_process_leaves_all_but_its_last_second(tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(file)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    came = [float(process.stdout.readline())]
    while came[-1] < came[0] + 1.7:
        came.append(float(process.stdout.readline()))
    process.send_signal(signal.SIGKILL)
    killed = time.monotonic()
    rest, _ = process.communicate(timeout=30)
    came += [float(line) for line in rest.splitlines()]
    assert process.returncode == -signal.SIGKILL

    told = read(file.read_bytes())
    there = sum(isinstance(line, Event) for line in told.lines)
    assert told.short is not None
    assert 0 < there <= len(came) + 1
    missed = [moment for moment in came[there:] if moment < killed - 1.0]
    assert missed == []
    assert verified(told).difference is None
