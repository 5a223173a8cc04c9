"""The figures that decided between two designs."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import attrs
from pyrsistent import pmap, pvector

from benchmarks.measure import Effort, Figure, Table, call_time, figure, rate, ratios, turns
from benchmarks.persistent import PersistentFold
from benchmarks.speed import EVENTS, engine, unfolding, yardstick
from benchmarks.workload import DENSE, THIN, after, workload
from fasteroids import Asteroid, World, grid
from fasteroids._raw import raw
from fasteroids.engine import EVERYTHING, Engine, give
from fasteroids.state import Flight


def slots(effort: Effort) -> Table:
    """Flights by slot in a PVector, or by id in a PMap."""
    figures = []
    for n in (10, 1_000, 10_000):
        one, other, value = n // 3, n - 2, object()
        vector = pvector(range(n))
        ids = pmap({i: i for i in range(n)})

        def by_slot(v=vector, a=one, b=other, x=value):
            return v[a], v[b], v.mset(a, x, b, x)

        def by_id(m=ids, a=one, b=other, x=value):
            return m[a], m[b], m.set(a, x).set(b, x)

        def by_id_at_once(m=ids, a=one, b=other, x=value):
            evolver = m.evolver()
            evolver[a] = evolver[b] = x
            return m[a], m[b], evolver.persistent()

        calls = effort.events(20_000)
        taken = turns(
            effort.rounds,
            {
                "slot": call_time(by_slot, calls),
                "id": call_time(by_id, calls),
                "evolver": call_time(by_id_at_once, calls),
            },
        )
        figures += [
            figure(f"N = {n:,}: PVector by slot", taken["slot"], "us"),
            figure(f"N = {n:,}: PMap by id, times that", ratios(taken["id"], taken["slot"])),
            figure(f"N = {n:,}: with an evolver", ratios(taken["evolver"], taken["slot"])),
            _share("PVector", n, lambda v, a, b, x: v.mset(a, x, b, x), vector),
            _share("PMap", n, lambda m, a, b, x: m.set(a, x).set(b, x), ids),
        ]
    return Table(
        "Slots against ids", figures, "What an event asks for: read two flights and replace both."
    )


def _share(name: str, n: int, update: Callable[..., Any], start: Any) -> Figure:
    """Bytes that a kept version takes, beside the values in it.

    Many versions, because PVector reuses a thousand nodes of earlier ones, which are not traced again.
    """
    versions, values = [start], [object() for _ in range(4_000)]
    tracemalloc.start()
    for i, value in enumerate(values):
        versions.append(update(versions[-1], i * 7 % n, (i * 7 + n // 2) % n, value))
    size = tracemalloc.get_traced_memory()[0] / len(values)
    tracemalloc.stop()
    return Figure(f"N = {n:,}: a kept {name}", size, size, size, "bytes")


def queue(effort: Effort) -> Table:
    """One mutable cache, or predictions in persistent collections."""
    figures = []
    for n in dict.fromkeys(effort.size(n) for n in (100, 1_000)):
        world, events = workload(n), effort.events(EVENTS // 2)
        fold = PersistentFold(world)
        fold.run(2 * n)
        taken = turns(
            effort.rounds,
            {
                "engine": rate(engine(world), events),
                "persistent": rate(fold.run, events),
                "yardstick": rate(yardstick(world), events),
            },
        )
        figures += [
            figure(f"N = {n:,}: cache (worlds, records, rules)", taken["engine"], "events/s"),
            figure(
                f"N = {n:,}: persistent queue (no worlds, no records)",
                taken["persistent"],
                "events/s",
            ),
            figure(
                f"N = {n:,}: what persistence alone costs: yardstick over it",
                ratios(taken["yardstick"], taken["persistent"]),
            ),
            _kept_predictions(fold, n, effort.events(2_000)),
        ]
    return Table("Cache against persistent queue", figures)


def _kept_predictions(fold: PersistentFold, n: int, states: int) -> Figure:
    """Bytes of a state that carries its predictions."""
    kept = []
    tracemalloc.start()
    for _ in range(states):
        fold.run(1)
        kept.append(fold.state)
    size = tracemalloc.get_traced_memory()[0] / len(kept)
    tracemalloc.stop()
    return Figure(f"N = {n:,}: a kept state with its predictions", size, size, size, "bytes")


def constructors(effort: Effort) -> Table:
    """Three ways to make the record of a moved asteroid, and of its flight."""
    asteroid = Asteroid(1.0, 2.0, 3.0, 4.0, 5.0, id=7)
    flight = Flight((0, 1.0), asteroid)
    raw_asteroid, raw_flight = raw(Asteroid), raw(Flight)

    def by_raw():
        e = asteroid
        return raw_asteroid(1.5, 2.5, 3.5, 4.5, e.radius, e.name, e.max_speed, e.id)

    def by_class():
        e = asteroid
        return Asteroid(1.5, 2.5, 3.5, 4.5, e.radius, name=e.name, max_speed=e.max_speed, id=e.id)

    contenders = {
        ("Asteroid", "raw"): by_raw,
        ("Asteroid", "constructor, with its guards"): by_class,
        ("Asteroid", "attrs.evolve"): lambda: attrs.evolve(asteroid, x=1.5, y=2.5, vx=3.5, vy=4.5),
        ("Flight", "raw"): lambda: raw_flight((0, 2.0), asteroid, 3, None, None),
        ("Flight", "constructor"): lambda: Flight((0, 2.0), asteroid, 3, None),
        ("Flight", "attrs.evolve"): lambda: attrs.evolve(flight, since=(0, 2.0), bounced_off=3),
    }
    calls = effort.events(20_000)
    taken = turns(
        effort.rounds, {" ".join(key): call_time(make, calls) for key, make in contenders.items()}
    )
    figures = []
    for record, way in contenders:
        times, base = taken[f"{record} {way}"], taken[f"{record} raw"]
        if way == "raw":
            figures.append(figure(f"{record}: {way}", times, "us"))
        else:
            figures.append(figure(f"{record}: {way}, times that", ratios(times, base)))
    return Table("Constructors", figures)


def with_grid(world: World, on: bool) -> World:
    """The world with an engine that uses its grid, or does not."""
    world._box.clear()
    give(world, Engine(world, plan=attrs.evolve(EVERYTHING, grid=on, bullets=False)))
    return world


def grid_from(effort: Effort) -> Table:
    """From which N the grid pays."""
    figures = []
    for phi in (DENSE, THIN):
        for n in (4, 6, 8, 12, 16, 24, 32, 64):
            n = effort.size(n)
            events = effort.events(4_000)
            world = after(workload(n, phi), 10 * n)
            contenders = {
                name: rate(unfolding(with_grid(after(world, 1), on)), events)
                for name, on in (("on", True), ("off", False))
            }
            taken = turns(effort.rounds, contenders)
            figures.append(
                figure(
                    f"phi = {phi}, N = {n}: with over without", ratios(taken["on"], taken["off"])
                )
            )
    return Table("Grid from which N", figures, "Rates; above 1 the grid pays.")


@contextmanager
def cells_per_disc(cells: float) -> Iterator[None]:
    """Grids made within have so many cells a disc."""
    usual = grid._CELLS_PER_DISC
    grid._CELLS_PER_DISC = cells  # type: ignore[misc,unused-ignore]
    try:
        yield
    finally:
        grid._CELLS_PER_DISC = usual  # type: ignore[misc,unused-ignore]


def cells(effort: Effort) -> Table:
    """How many cells a disc."""
    n, events = effort.size(1_000), effort.events(EVENTS // 2)
    figures = []
    for phi in (DENSE, THIN):
        contenders = {}
        for wanted in (3.0, 1.0, 2.0, 4.0, 6.0):
            with cells_per_disc(wanted):
                contenders[f"{wanted:.0f}"] = rate(engine(workload(n, phi)), events)
        taken = turns(effort.rounds, contenders)
        figures += [
            figure(f"phi = {phi}: {wanted} over 3", ratios(rates, taken["3"]))
            for wanted, rates in sorted(taken.items())
            if wanted != "3"
        ]
    return Table(
        "Cells per disc",
        figures,
        f"Rates at N = {n:,}. A cell is never narrower than a disc, so 4 and 6 are alike at phi = 0.2.",
    )
