"""The yardstick: the algorithm of `fasteroids.engine` without worlds.

Equal discs only, as in the workload. The same cells, the same filter, one heap with stale entries dropped when
they come up, the same order of events; but plain lists, changed in place. It makes no records, keeps no worlds
and yields nothing, so the distance between its rate and the engine's is what values, records and rules cost. Its
log of (time, kind, ids) equals the engine's bit for bit (tests/unit/test_benchmarks.py), or the comparison would
be worth nothing.
"""

from __future__ import annotations

from heapq import heappop, heappush, heapreplace
from itertools import count
from math import inf
from typing import Any, TypeAlias

from fasteroids import World, models
from fasteroids.engine import CONTACT
from fasteroids.grid import Grid, fitting
from fasteroids.moments import seconds
from fasteroids.physics import bounce
from fasteroids.units import WINDOW

CROSSING, LEFT, RIGHT, BOTTOM, TOP = -1, 1, 2, 3, 4
NONE = (inf,)  # later than every prediction

Entry: TypeAlias = tuple[str | float | tuple[int, ...], ...]
Due: TypeAlias = tuple[int, float, int, int, int, int, int, int, int, int]
"""Window, offset, rank, the two ids, a serial number, slot and partner's slot (for a crossing: the step between
cells), and how often each had changed its path when this was predicted."""


class Yardstick:
    """A fold over the events of a world of equal asteroids, in place."""

    def __init__(self, world: World) -> None:
        model = models.named(world.model)
        self.filtered, self.exact = model.filtered, model.exact
        self.width, self.height = world.width, world.height
        asteroids = world.asteroids
        window, offset = world.now
        # Window, offset, x, y, vx, vy, radius, id, bounced_off.
        self.rows: list[list[Any]] = [
            [window, offset, a.x, a.y, a.vx, a.vy, a.radius, a.id, 0] for a in asteroids
        ]
        self.versions = [0] * len(asteroids)
        self.known: list[Due | None] = [None] * len(asteroids)
        self.grid = grid = Grid(
            self.width, self.height, *fitting(self.width, self.height, asteroids)
        )
        self.lefts, self.rights = grid.lefts, grid.rights
        self.bottoms, self.tops = grid.bottoms, grid.tops
        self.cell = [grid.cell_at(a.x, a.y) for a in asteroids]
        for slot, cell in enumerate(self.cell):
            grid.cells[cell].append(slot)
        self.serial = count()
        self.heap: list[Due] = []
        for slot in range(len(asteroids)):
            self.predict(slot)

    def predict(self, slot: int) -> None:
        """Look around from scratch, and queue what comes first."""
        self.known[slot] = None
        self.look(slot, self.grid.around)
        due = self.first(slot)
        if due is not None:
            heappush(self.heap, due)

    def look(self, slot: int, offsets: tuple[int, ...]) -> None:
        """Find the earliest contact of a disc with those in some cells near its own."""
        rows, cells, here, filtered = self.rows, self.grid.cells, self.cell[slot], self.filtered
        window, offset, x, y, vx, vy, r, me, bounced_off = rows[slot]
        known = self.known[slot]
        best: tuple[Any, ...] = NONE if known is None else known
        for delta in offsets:
            for other in cells[here + delta]:
                if other == slot:
                    continue
                w, o, xo, yo, vxo, vyo, ro, it, ito = rows[other]
                if bounced_off == it and ito == me:
                    continue
                age = offset - o if window == w else (window - w) * WINDOW + (offset - o)
                if age >= 0.0:
                    w, o = window, offset
                    t = filtered(x, y, vx, vy, r, xo + vxo * age, yo + vyo * age, vxo, vyo, ro)
                    if t != t:
                        t = self.exact(
                            x, y, vx, vy, r, xo + vxo * age, yo + vyo * age, vxo, vyo, ro
                        )
                else:
                    t = filtered(x - vx * age, y - vy * age, vx, vy, r, xo, yo, vxo, vyo, ro)
                    if t != t:
                        t = self.exact(x - vx * age, y - vy * age, vx, vy, r, xo, yo, vxo, vyo, ro)
                if t == inf:
                    continue
                o += t
                if o >= WINDOW:
                    windows, o = divmod(o, WINDOW)
                    w += int(windows)
                found = (
                    (w, o, CONTACT, me, it, other) if me < it else (w, o, CONTACT, it, me, other)
                )
                if found < best:
                    best = found
        if best is not known and best is not NONE:
            w, o, rank, low, high, other = best
            mine, its = self.versions[slot], self.versions[other]
            self.known[slot] = w, o, rank, low, high, next(self.serial), slot, other, mine, its

    def first(self, slot: int) -> Due | None:
        """The earlier of a disc's known contact and its next wall or cell border."""
        window, offset, x, y, vx, vy, r, me, _ = self.rows[slot]
        cell = self.cell[slot]
        tx = ty = inf
        rank_x = rank_y = CROSSING
        step_x = step_y = 0
        if vx > 0.0:
            edge, step_x = self.rights[cell], self.grid.stride
            if edge is None:
                edge, rank_x = self.width - r, RIGHT
            tx = (edge - x) / vx
        elif vx < 0.0:
            edge, step_x = self.lefts[cell], -self.grid.stride
            if edge is None:
                edge, rank_x = r, LEFT
            tx = (edge - x) / vx
        if vy > 0.0:
            edge, step_y = self.tops[cell], 1
            if edge is None:
                edge, rank_y = self.height - r, TOP
            ty = (edge - y) / vy
        elif vy < 0.0:
            edge, step_y = self.bottoms[cell], -1
            if edge is None:
                edge, rank_y = r, BOTTOM
            ty = (edge - y) / vy
        if not tx > 0.0:
            tx = 0.0
        if not ty > 0.0:
            ty = 0.0
        t, rank, step = (tx, rank_x, step_x) if tx <= ty else (ty, rank_y, step_y)
        contact = self.known[slot]
        if t == inf:
            return contact
        offset += t
        if offset >= WINDOW:
            windows, offset = divmod(offset, WINDOW)
            window += int(windows)
        serial, version = next(self.serial), self.versions[slot]
        due = window, offset, rank, me, 0, serial, slot, step, version, 0
        return due if contact is None or due < contact else contact

    def run(self, events: int, log: list[Entry] | None = None) -> None:
        """Let so many events happen; with a log, append (time, kind, ids) of each."""
        heap, versions = self.heap, self.versions
        while events > 0 and heap:
            due = heap[0]
            window, offset, rank, low, high, _, slot, other, version, its_version = due
            if versions[slot] != version:
                heappop(heap)
                continue
            if rank == CROSSING:
                cells, cell = self.grid.cells, self.cell[slot]
                cells[cell].remove(slot)
                self.cell[slot] = cell + other
                cells[cell + other].append(slot)
                self.look(slot, self.grid.ahead[other])
            elif rank == CONTACT and versions[other] != its_version:
                self.known[slot] = None
                self.look(slot, self.grid.around)
            else:
                heappop(heap)
                events -= 1
                if rank == CONTACT:
                    self.contact(window, offset, slot, other)
                else:
                    self.wall(window, offset, slot, rank)
                if log is not None:
                    kind, ids = ("contact", (low, high)) if rank == CONTACT else ("wall", (low,))
                    log.append((seconds(window, offset), kind, ids))
                continue
            following = self.first(slot)
            if following is None:
                heappop(heap)
            else:
                heapreplace(heap, following)

    def move(self, row: list[Any], window: int, offset: float) -> None:
        """Move a disc to a moment."""
        age = (window - row[0]) * WINDOW + (offset - row[1])
        row[0], row[1] = window, offset
        row[2] += row[4] * age
        row[3] += row[5] * age

    def contact(self, window: int, offset: float, slot: int, other: int) -> None:
        """Two discs bounce."""
        if self.rows[slot][7] > self.rows[other][7]:
            slot, other = other, slot
        a, b = self.rows[slot], self.rows[other]
        self.move(a, window, offset)
        self.move(b, window, offset)
        a[4], a[5], b[4], b[5] = bounce(b[2] - a[2], b[3] - a[3], a[4], a[5], 1.0, b[4], b[5], 1.0)
        a[8], b[8] = b[7], a[7]
        self.versions[slot] += 1
        self.versions[other] += 1
        self.predict(slot)
        self.predict(other)

    def wall(self, window: int, offset: float, slot: int, rank: int) -> None:
        """A disc is set onto a wall and turned inwards."""
        row = self.rows[slot]
        self.move(row, window, offset)
        if rank == LEFT:
            row[2], row[4] = row[6], abs(row[4])
        elif rank == RIGHT:
            row[2], row[4] = self.width - row[6], -abs(row[4])
        elif rank == BOTTOM:
            row[3], row[5] = row[6], abs(row[5])
        else:
            row[3], row[5] = self.height - row[6], -abs(row[5])
        row[8] = 0
        self.versions[slot] += 1
        self.predict(slot)
