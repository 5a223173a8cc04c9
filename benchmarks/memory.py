"""What a kept state weighs."""

from __future__ import annotations

import gc
import tracemalloc
from itertools import islice

from benchmarks.measure import Effort, Figure, Table
from benchmarks.workload import FOREVER, after, workload
from fasteroids import World, happenings

KEPT = 100_000


def kept_states(world: World, states: int) -> tuple[int, int]:
    """Bytes of so many worlds, one after every event, kept in a list; and how many entities changed in them."""
    changed, worlds = 0, []
    tracemalloc.start()
    for happened, moved in islice(happenings(world, FOREVER), states):
        worlds.append(moved)
        changed += len(happened.entities)
    worlds[-1]._box.clear()  # the cache of predictions belongs to the newest world alone
    gc.collect()
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return size, changed


def memory(effort: Effort) -> Table:
    """Bytes of a state kept after every event."""
    figures = []
    for n, states in ((30, KEPT), (effort.size(1_000), 10_000)):
        states = effort.events(states)
        total, changed = kept_states(after(workload(n), 2 * n), states)
        if n == 30:
            whole = total / states * KEPT / 1e6
            what = f"N = 30, {KEPT:,} states"
            figures.append(Figure(what, whole, whole, whole, "MB", below=150.0))
        each = total / changed
        figures.append(
            Figure(f"N = {n:,}, a changed entity", each, each, each, "bytes", below=700.0)
        )
    return Table(
        "Memory of a state kept after every event",
        figures,
        "Traced allocations of a run whose worlds are all kept, without the cache of the newest.",
    )
