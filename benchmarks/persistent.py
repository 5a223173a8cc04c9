"""The rejected alternative: predictions that are values too, so that every state carries its own.

The same algorithm as the yardstick, on persistent collections throughout: the rows, cells and known contacts in
PVectors, the queue a leftist heap. After every event the roots together are a complete state that can be
evolved again at no cost; `fasteroids.engine` instead keeps one mutable cache, owned by the newest world, and
builds another one when an older world is evolved again.
"""

from __future__ import annotations

from itertools import count
from math import inf
from typing import Any, NamedTuple, TypeAlias

from pyrsistent import PVector, pvector

from benchmarks.yardstick import BOTTOM, CROSSING, LEFT, NONE, RIGHT, TOP, Due, Entry
from fasteroids import World, models
from fasteroids.engine import CONTACT
from fasteroids.grid import Grid, fitting
from fasteroids.moments import seconds
from fasteroids.physics import bounce
from fasteroids.units import WINDOW

Heap: TypeAlias = tuple[int, Any, Any, Any] | None
"""A leftist heap: (rank, due, left, right)."""
Row: TypeAlias = tuple[Any, ...]
"""Window, offset, x, y, vx, vy, radius, id, bounced_off, version."""


def merge(a: Heap, b: Heap) -> Heap:
    """Both heaps in one."""
    if a is None:
        return b
    if b is None:
        return a
    if b[1] < a[1]:
        a, b = b, a
    _, due, left, right = a
    right = merge(right, b)
    assert right is not None
    if left is None:
        return 1, due, right, None
    if left[0] < right[0]:
        left, right = right, left
    return right[0] + 1, due, left, right


class State(NamedTuple):
    """Everything a fold knows, as a value."""

    rows: PVector[Any]
    cells: PVector[Any]
    cell: PVector[int]
    known: PVector[Due | None]
    heap: Heap


class PersistentFold:
    """The yardstick's fold over values; `state` is complete after every event."""

    def __init__(self, world: World) -> None:
        model = models.named(world.model)
        self.filtered, self.exact = model.filtered, model.exact
        self.width, self.height = world.width, world.height
        asteroids = world.asteroids
        window, offset = world.now
        self.grid = grid = Grid(
            self.width, self.height, *fitting(self.width, self.height, asteroids)
        )
        self.lefts, self.rights = grid.lefts, grid.rights
        self.bottoms, self.tops = grid.bottoms, grid.tops
        self.serial = count()
        self.rows: PVector[Any] = pvector(
            (window, offset, a.x, a.y, a.vx, a.vy, a.radius, a.id, 0, 0) for a in asteroids
        )
        home = [grid.cell_at(a.x, a.y) for a in asteroids]
        cells: list[tuple[int, ...]] = [()] * len(grid.cells)
        for slot, cell in enumerate(home):
            cells[cell] += (slot,)
        self.cells: PVector[Any] = pvector(cells)
        self.cell = pvector(home)
        self.known: PVector[Due | None] = pvector([None] * len(asteroids))
        self.heap: Heap = None
        for slot in range(len(asteroids)):
            self.predict(slot)

    @property
    def state(self) -> State:
        """Everything known now."""
        return State(self.rows, self.cells, self.cell, self.known, self.heap)

    def predict(self, slot: int) -> None:
        """Look around from scratch, and queue what comes first."""
        self.look(slot, self.grid.around, None)
        self.push(self.first(slot))

    def push(self, due: Due | None) -> None:
        """Queue a prediction."""
        if due is not None:
            self.heap = merge(self.heap, (1, due, None, None))

    def pop(self) -> None:
        """Drop the first of the queue."""
        assert self.heap is not None
        self.heap = merge(self.heap[2], self.heap[3])

    def look(self, slot: int, offsets: tuple[int, ...], known: Due | None) -> None:
        """Find the earliest contact of a disc with those in some cells near its own."""
        rows, cells, here, filtered = self.rows, self.cells, self.cell[slot], self.filtered
        window, offset, x, y, vx, vy, r, me, bounced_off, version = rows[slot]
        best: tuple[Any, ...] = NONE if known is None else known
        for delta in offsets:
            for other in cells[here + delta]:
                if other == slot:
                    continue
                w, o, xo, yo, vxo, vyo, ro, it, ito, _ = rows[other]
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
        due: Due | None
        if best is NONE:
            due = None
        elif best is known:
            due = known
        else:
            w, o, rank, low, high, other = best
            due = w, o, rank, low, high, next(self.serial), slot, other, version, rows[other][9]
        self.known = self.known.set(slot, due)

    def first(self, slot: int) -> Due | None:
        """The earlier of a disc's known contact and its next wall or cell border."""
        window, offset, x, y, vx, vy, r, me, _, version = self.rows[slot]
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
        t, rank, step = max(tx, 0.0), rank_x, step_x
        if max(ty, 0.0) < t:
            t, rank, step = max(ty, 0.0), rank_y, step_y
        contact = self.known[slot]
        if t == inf:
            return contact
        offset += t
        if offset >= WINDOW:
            windows, offset = divmod(offset, WINDOW)
            window += int(windows)
        due = window, offset, rank, me, 0, next(self.serial), slot, step, version, 0
        return due if contact is None or due < contact else contact

    def run(self, events: int, log: list[Entry] | None = None) -> None:
        """Let so many events happen; with a log, append (time, kind, ids) of each."""
        while events > 0 and self.heap is not None:
            window, offset, rank, low, high, _, slot, other, version, its_version = due = self.heap[
                1
            ]
            self.pop()
            if self.rows[slot][9] != version:
                continue
            if rank == CROSSING:
                cell, to = self.cell[slot], self.cell[slot] + other
                inside = tuple(i for i in self.cells[cell] if i != slot)
                self.cells = self.cells.mset(cell, inside, to, (*self.cells[to], slot))
                self.cell = self.cell.set(slot, to)
                self.look(slot, self.grid.ahead[other], self.known[slot])
                self.push(self.first(slot))
            elif rank == CONTACT and self.rows[other][9] != its_version:
                self.predict(slot)
            else:
                events -= 1
                self.happen(due)
                if log is not None:
                    kind, ids = ("contact", (low, high)) if rank == CONTACT else ("wall", (low,))
                    log.append((seconds(window, offset), kind, ids))

    def happen(self, due: Due) -> None:
        """A bounce off another disc or a wall."""
        window, offset, rank, _, _, _, slot, other, _, _ = due
        if rank == CONTACT:
            if self.rows[slot][7] > self.rows[other][7]:
                slot, other = other, slot
            x, y, vx, vy, r, me, version = self.moved(slot, window, offset)
            xo, yo, vxo, vyo, ro, it, its_version = self.moved(other, window, offset)
            vx, vy, vxo, vyo = bounce(xo - x, yo - y, vx, vy, 1.0, vxo, vyo, 1.0)
            mine = window, offset, x, y, vx, vy, r, me, it, version + 1
            its = window, offset, xo, yo, vxo, vyo, ro, it, me, its_version + 1
            self.rows = self.rows.mset(slot, mine, other, its)  # type: ignore[arg-type]
            self.predict(slot)
            self.predict(other)
            return
        x, y, vx, vy, r, me, version = self.moved(slot, window, offset)
        if rank == LEFT:
            x, vx = r, abs(vx)
        elif rank == RIGHT:
            x, vx = self.width - r, -abs(vx)
        elif rank == BOTTOM:
            y, vy = r, abs(vy)
        else:
            y, vy = self.height - r, -abs(vy)
        self.rows = self.rows.set(slot, (window, offset, x, y, vx, vy, r, me, 0, version + 1))
        self.predict(slot)

    def moved(self, slot: int, window: int, offset: float) -> Row:
        """A disc at a moment: x, y, vx, vy, radius, id, version."""
        w, o, x, y, vx, vy, r, me, _, version = self.rows[slot]
        age = (window - w) * WINDOW + (offset - o)
        return x + vx * age, y + vy * age, vx, vy, r, me, version
