"""Whole processes, from start to exit.

Measured is their processor time: on an idle machine with warm disk caches that is how long they take.
"""

from __future__ import annotations

import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from benchmarks.measure import Effort, Table, figure, ratios, turns

_NONE = subprocess.DEVNULL
_PROGRAM = Path(__file__).parents[1] / "tests" / "programs" / "second-mended.ast"


def _spent_by_children() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def process(*command: str) -> Callable[[], float]:
    """A contender: milliseconds of a process."""

    def measured() -> float:
        before = _spent_by_children()
        subprocess.run(command, check=True, stdin=_NONE, stdout=_NONE, stderr=_NONE)
        return (_spent_by_children() - before) * 1e3

    return measured


def startup(effort: Effort) -> Table:
    """From a command to its end."""
    python = sys.executable
    command = str(Path(python).with_name("fasteroids"))
    contenders = {
        "python -c pass": process(python, "-c", "pass"),
        'python -c "import fasteroids"': process(python, "-c", "import fasteroids"),
        "fasteroids --help": process(command, "--help"),
        "fasteroids check FILE": process(command, "check", str(_PROGRAM)),
    }
    for name, measured in list(contenders.items()):
        try:
            measured()  # warms the disk cache and the byte code
        except (OSError, subprocess.CalledProcessError):
            del contenders[name]
    taken = turns(max(1, 2 * effort.rounds - 1), contenders)
    bare, *others = contenders
    return Table(
        "Start-up, whole processes",
        [
            figure(bare, taken[bare], "ms"),
            *(figure(name, taken[name], "ms", below=150.0) for name in others),
            *(figure(f"{name} over {bare}", ratios(taken[name], taken[bare])) for name in others),
        ],
        "Processor time, the time taken on an idle machine. A command that is missing or fails is left out.",
    )
