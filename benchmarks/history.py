"""What a past costs: memory, and the time to ask it for any moment, the next and the previous happening.

The game: 30 discs in a box of 1,400 by 1,000 km, two of them ships with programs that turn and thrust under `smooth`.
The others are ships without, so that nobody dies and the game stays as busy as it begins. It is lived in cuts of
1/30 s, as a terminal game does: about 50 kept states a second.
"""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable
from functools import partial
from math import tau
from random import Random
from time import process_time

from benchmarks.measure import Effort, Figure, Table, figure
from fasteroids import Ship, World, check_program, parse_program
from fasteroids.history import Timeline, begin, next_state, previous_state

TEN_MINUTES = 600.0
HOUR = 3_600.0
BUDGET = 200 * 10**6  # bytes, for an hour
CUT = 1.0 / 30.0
ASKED = 400  # questions of a kind
NEAR = 0.2  # s
STEPS = 8  # questions near the last place, after one far from it
MB = 1e6
WITHOUT_END = 2**50  # a budget that nothing reaches

PROGRAM = "double a; while (true) { a := a + 0.1; turn a; thrust; skip; thrust_off; }"


def game(seed: int = 1) -> World:
    """Its first world."""
    random = Random(seed)
    pilot = check_program(parse_program(PROGRAM)).program
    world = World(1400.0, 1000.0, seed, "smooth")
    return world.add_all(
        Ship(
            100.0 + 200.0 * (i % 7), 100.0 + 200.0 * (i // 7),
            random.uniform(-110.0, 110.0), random.uniform(-110.0, 110.0),
            random.uniform(10.0, 40.0), 5e15, random.uniform(0.0, tau), program=pilot if i < 2 else None,
        )
        for i in range(30)
    )  # fmt: skip


def played(seconds: float, budget: int) -> Timeline:
    """So many seconds of it."""
    timeline = begin(game(), budget=budget)
    for _ in range(round(seconds / CUT)):
        timeline = timeline.evolve(CUT)
    return timeline


Ask = Callable[[], object]


def taken(ask: Ask) -> float:
    """Milliseconds of one question."""
    start = process_time()
    ask()
    return (process_time() - start) * 1e3


def answers(timeline: Timeline, seed: int, questions: int) -> dict[str, list[float]]:
    """Milliseconds of questions at random times, each with some more near the place it led to."""
    random = Random(seed)
    end = timeline.world.time
    found: dict[str, list[float]] = {}
    for where in ("anywhere", "near"):
        found |= {f"{name}, {where}": [] for name in ("at", "next", "previous")}
    for _ in range(questions):
        for name, step in (("next", next_state), ("previous", previous_state)):
            time = random.uniform(0.0, end)
            found[f"{name}, anywhere"].append(taken(partial(step, timeline, time)))
            state = step(timeline, time)
            for _ in range(STEPS):
                if state is not None:
                    found[f"{name}, near"].append(taken(partial(step, timeline, state.place)))
                    state = step(timeline, state.place)
        time = random.uniform(0.0, end)
        found["at, anywhere"].append(taken(partial(timeline.at, time)))
        for _ in range(STEPS):
            nearby = min(max(time + random.uniform(-NEAR, NEAR), 0.0), end)
            found["at, near"].append(taken(partial(timeline.at, nearby)))
    return found


def traced_bytes(seconds: float, budget: int) -> tuple[float, float]:
    """What a timeline says it costs, and what its states do by the allocations of Python; MB."""
    gc.collect()
    tracemalloc.start()
    timeline = played(seconds, budget)
    timeline.world._box.clear()  # the cache of predictions belongs to the newest world alone
    gc.collect()
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return timeline.bytes / MB, size / MB


def history(effort: Effort) -> Table:
    """Ten minutes whole and thinned, an hour within its budget, and the price a timeline tells beside the real one."""
    seconds = max(2.0, TEN_MINUTES * effort.share)
    whole = played(seconds, WITHOUT_END)
    rows = [_one("kept states a second, nothing thinned", whole.states / seconds)]
    timeline, size = whole, whole.bytes
    for part in (1, 4, 16):
        timeline = timeline.thin(size // part)
        rows += _asked(f"{seconds:,.0f} s", timeline, effort, bounds=part == 1)
    hour = max(4.0, HOUR * effort.share)
    budget = BUDGET * hour / HOUR
    timeline = played(hour, int(budget))
    rows.append(_one(f"{hour:,.0f} s, its bytes", timeline.bytes / MB, "MB", budget / MB))
    rows += _asked(f"{hour:,.0f} s", timeline, effort, bounds=True)
    told, found = traced_bytes(seconds / 8.0, WITHOUT_END)
    rows.append(
        _one(f"bytes told over bytes allocated, {seconds / 8.0:,.0f} s whole", told / found)
    )
    told, found = traced_bytes(seconds / 8.0, int(told * MB / 4.0))
    rows.append(_one("the same, thinned to a quarter", told / found))
    return Table(
        "Questions to a past of 30 entities",
        rows,
        "Processor time of one question (at, next, previous alike), with the collector at rest. Near: within "
        f"{NEAR} s of the question before, or the next happening from its answer.",
    )


def _asked(what: str, timeline: Timeline, effort: Effort, *, bounds: bool) -> list[Figure]:
    gc.collect()
    gc.disable()
    try:
        found = answers(timeline, 1, max(2, round(ASKED * effort.share)))
    finally:
        gc.enable()
    what = f"{what} in {timeline.bytes / MB:.3g} MB, {timeline.states:,} states"
    rows = []
    for where, bound in (("anywhere", 50.0), ("near", 5.0)):
        times = [t for name, each in found.items() if name.endswith(where) for t in each]
        rows.append(figure(f"{what}: {where}", times, "ms"))
        rows.append(
            _one(
                f"the slowest of them ({len(times):,})", max(times), "ms", bound if bounds else None
            )
        )
    return rows


def _one(what: str, value: float, unit: str = "", below: float | None = None) -> Figure:
    return figure(what, [value], unit, below=below)
