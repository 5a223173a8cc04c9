"""`python -m benchmarks [NAME...] [--quick] [--json | --markdown]`: measure, and say which bounds are met."""

from __future__ import annotations

import gc
import json
import sys
from argparse import ArgumentParser
from collections.abc import Callable, Mapping
from time import perf_counter

import attrs
from rich.console import Console
from rich.table import Table as Grid

from benchmarks import (
    choices,
    frames,
    history,
    memory,
    play,
    programs,
    recording,
    speed,
    startup,
)
from benchmarks.measure import FULL, QUICK, Effort, Figure, Table

GC_THRESHOLD = 200_000
"""What an application that keeps histories would set; the library itself never touches the collector."""

BENCHMARKS: Mapping[str, Callable[[Effort], Table]] = {
    "peer": speed.peer,
    "yardstick": speed.against_yardstick,
    "growth": speed.growth,
    "levels": speed.levels,
    "thrust": speed.thrust,
    "idle": speed.idle,
    "programs": programs.programs,
    "recording": recording.recording,
    "frames": frames.frames,
    "play": play.play,
    "memory": memory.memory,
    "history": history.history,
    "startup": startup.startup,
    "slots": choices.slots,
    "queue": choices.queue,
    "constructors": choices.constructors,
    "grid": choices.grid_from,
    "cells": choices.cells,
}


def printed(table: Table) -> Grid:
    """A table for people."""
    result = Grid(title=table.title, caption=table.note or None, title_justify="left")
    result.add_column("what", min_width=44)
    result.add_column("asked", justify="right")
    result.add_column(r"measured: median \[min - max]", justify="right")
    result.add_column("verdict")
    for f in table.figures:
        verdict = {True: "[green]met[/]", False: "[red]missed[/]", None: ""}[f.met]
        result.add_row(f.what, f.asked, f.measured.replace("[", r"\["), verdict)
    return result


def markdown(table: Table) -> str:
    """A table for README.md."""
    verdicts = {True: "met", False: "**missed**", None: ""}
    rows = [f"| {f.what} | {f.asked} | {f.measured} | {verdicts[f.met]} |" for f in table.figures]
    head = ["| what | asked | measured: median [min - max] | |", "|---|---|---|---|"]
    return "\n".join([f"### {table.title}", "", *head, *rows, "", table.note]).rstrip() + "\n"


def plain(f: Figure) -> dict[str, object]:
    """A figure for programs."""
    return {**attrs.asdict(f), "met": f.met}


def main() -> int:
    """Run what is asked for; exit code 1 if a bound is missed."""
    parser = ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(BENCHMARKS))
    parser.add_argument("--quick", action="store_true", help="fewer events and turns: about 30 s")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="one JSON object on stdout")
    form.add_argument("--markdown", action="store_true", help="tables as in benchmarks/README.md")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in BENCHMARKS]
    if unknown:
        parser.error(
            f"no benchmark is called {', '.join(unknown)}; there are {', '.join(BENCHMARKS)}"
        )
    gc.set_threshold(GC_THRESHOLD)
    out = Console(width=None if sys.stdout.isatty() else 120)
    tables = {}
    for name in options.names or BENCHMARKS:
        print(f"{name} ...", end=" ", file=sys.stderr, flush=True)
        start = perf_counter()
        tables[name] = BENCHMARKS[name](QUICK if options.quick else FULL)
        print(f"{perf_counter() - start:.1f} s", file=sys.stderr, flush=True)
        gc.collect()
        if options.markdown:
            print(markdown(tables[name]))
        elif not options.json:
            out.print(printed(tables[name]), "")
    if options.json:
        print(
            json.dumps(
                {name: [plain(f) for f in t.figures] for name, t in tables.items()}, indent=1
            )
        )
    elif not options.markdown and not options.names:
        out.print(
            f"The collector's first threshold was {GC_THRESHOLD:,}, as an application would set it."
        )
    return int(any(f.met is False for t in tables.values() for f in t.figures))


if __name__ == "__main__":
    sys.exit(main())
