"""The cache: who meets whom next, when, and who meets which wall.

Event-driven molecular dynamics in its standard form. Each flight keeps its earliest contact, and queues the
earlier of that and its next geometry event (a wall, or the border of its grid cell) in one binary heap. Contacts
are looked for in the nine cells around a disc. Crossings of cells are bookkeeping: nobody sees them.

Everything in here can be rebuilt from the flights at any moment without changing the future, because

* a contact time is a function of two flights and nothing else (reference moment: the later of their starts);
* events are ordered by (moment, rank, ids), never by who found them or when;
* a prediction is valid if and only if the flights in it are (identity) the current ones.

A pair is known to the one of the two that looked around last, unless that one has something earlier to do. If
its partner has changed since, the prediction is stale: when it comes up, the disc looks around again.

An engine belongs to exactly one world at a time; `take` and `give` move it.
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heapify, heappop, heappush, heapreplace
from itertools import count
from math import inf
from typing import Any, TypeAlias

from attrs import frozen

from fasteroids import models, quartic
from fasteroids.courses import LIMIT, WALLS, Course, course, exit_time, meeting
from fasteroids.entities import Bullet, Ship
from fasteroids.grid import Grid, fitting
from fasteroids.moments import Clock, Moment, later, resolution, tick_moment
from fasteroids.overlap import own_bullet
from fasteroids.state import Flight, World, located
from fasteroids.units import WINDOW

__all__ = [
    "CONTACT",
    "GRID_FROM",
    "LIMIT",
    "TICK",
    "WALLS",
    "Due",
    "Engine",
    "Plan",
    "give",
    "needs",
    "peek",
    "take",
]

CONTACT, TICK = 0, 6
"""Ranks, the order of events at one moment: contact, the four walls, limit, tick (see `fasteroids.courses`)."""
_CROSSING = -1  # before all events: it only widens what a disc knows
_LEFT, _RIGHT, _BOTTOM, _TOP = WALLS
_NONE = (inf,)  # later than every prediction

GRID_FROM = 10
"""With fewer entities every disc is compared with every other (measured, see benchmarks/README.md)."""

Due: TypeAlias = tuple[int, float, int, int, int, int, int, int, Flight, Flight | None]
"""A prediction: window, offset, rank, the two ids in order (0 for none), a serial number, the slot of the disc
that holds it, the slot of its partner (for a crossing: the step between cells), and the flights of both.

The heap compares them as tuples: the first five are the order of events, the serial number settles the rest."""

_Row: TypeAlias = tuple[int, float, float, float, float, float, float, int, int, int]
"""A flight laid flat for the inner loop: window, offset, x, y, vx, vy, radius, id, bounced_off, source."""


@frozen
class Plan:
    """Which parts of the model are in use. Leaving out what a scene does not need changes nothing (law L13)."""

    grid: bool
    thrust: bool
    bullets: bool
    ticks: bool


EVERYTHING = Plan(grid=True, thrust=True, bullets=True, ticks=True)


def needs(world: World) -> Plan:
    """The parts a world needs, from its flights alone."""
    flights = [f for f in world.flights if f is not None]
    return Plan(
        grid=len(flights) >= GRID_FROM
        and fitting(world.width, world.height, [f.entity for f in flights]) != (1, 1),
        thrust=any(type(f.entity) is Ship and f.entity.thruster for f in flights),
        bullets=any(type(f.entity) is Bullet for f in flights),
        ticks=any(f.next_tick is not None for f in flights),
    )


class Engine:
    """Predictions for the flights of one world. Mutable, and never seen by users.

    `asked` counts contact times computed, `undecided` those that needed exact arithmetic. `thrusters` are the
    slots of ships that are kicked at each cut: the thruster is on, under `literal`. A `plan` can force parts on or
    leave the grid out, for tests.
    """

    def __init__(self, world: World, plan: Plan | None = None) -> None:
        model = models.named(world.model)
        self._filtered, self._exact = model.filtered, model.exact
        self._width, self._height = world.width, world.height
        self._forced = plan
        self._serial = count()
        self.asked = self.undecided = 0
        self.flights: list[Flight | None] = list(world.flights)
        self._build(world.now)

    # Taking over flights.

    def _build(self, now: Moment) -> None:
        """Everything from the flights alone."""
        size = len(self.flights)
        self._happening: tuple[int, Flight] | None = (
            None  # who had queued the event that is being applied
        )
        self._now = now
        self.thrusters: set[int] = set()
        self._courses: dict[int, Course] = {}
        self._bullets = self._forced is not None and self._forced.bullets
        self._rows: list[_Row | None] = [None] * size
        self._cell: list[int] = [0] * size
        self._contact: list[Due | None] = [None] * size
        self._heap: list[Due] = []
        living = [f.entity for f in self.flights if f is not None]
        wants_grid = len(living) >= GRID_FROM if self._forced is None else self._forced.grid
        shape = fitting(self._width, self._height, living) if wants_grid else (1, 1)
        self.grid = Grid(self._width, self._height, *shape)
        self._widest = max((e.radius for e in living), default=0.0)
        self._grid_fits = max(2 * len(living), GRID_FROM - 1)
        self.living = 0
        for slot, f in enumerate(self.flights):
            if f is not None:
                self._enter(slot, f, now)
                self._predict(slot, f)

    def replace(
        self,
        clock: Clock,
        changed: Sequence[tuple[int, Flight]],
        born: Sequence[tuple[int, Flight]],
        dead: Sequence[int],
    ) -> None:
        """Take over the flights of a new world: (slot, flight) of the changed and born, slots of the dead."""
        for slot in dead:
            self.flights[slot] = self._rows[slot] = self._contact[slot] = None
            self.grid.cells[self._cell[slot]].remove(slot)
            self.thrusters.discard(slot)
            self._courses.pop(slot, None)
            self.living -= 1
        for slot, f in changed:
            self.flights[slot] = f
            self._lay(slot, f)
        now = self._now = clock[:2]
        for slot, f in born:
            while slot >= len(self.flights):
                self.flights.append(None)
                self._rows.append(None)
                self._contact.append(None)
                self._cell.append(0)
            self.flights[slot] = f
            self._enter(slot, f, now)
        if born and (
            self.living > self._grid_fits or any(f.entity.radius > self._widest for _, f in born)
        ):
            self._build(now)
            return
        for slot, f in changed:
            self._predict(slot, f)
        for slot, f in born:
            self._predict(slot, f)
        if self._happening is not None:
            slot, f = self._happening
            self._happening = None
            if self.flights[slot] is f:  # it flies on, and this event was all it had queued
                self._predict(slot, f)
        if len(self._heap) > 8 * self.living + 64:
            self._compact()

    def _enter(self, slot: int, f: Flight, now: Moment) -> None:
        """Give a disc a row and a cell."""
        e = located(f, now)
        cell = self.grid.cell_at(e.x, e.y)
        self._cell[slot] = cell
        self.grid.cells[cell].append(slot)
        self.living += 1
        self._lay(slot, f)

    def _lay(self, slot: int, f: Flight) -> None:
        """Lay a flight flat for the inner loop."""
        e = f.entity
        source = 0
        if type(e) is Ship:
            if f.path is not None:
                self._courses[slot] = course(f, self._width, self._height)
            else:
                self._courses.pop(slot, None)
            if e.thruster and f.path is None:
                self.thrusters.add(slot)
            else:
                self.thrusters.discard(slot)
        elif type(e) is Bullet:
            source = e.source
            self._bullets = True
        window, offset = f.since
        self._rows[slot] = (
            window, offset, e.x, e.y, e.vx, e.vy, e.radius, e.id or 0, f.bounced_off, source,
        )  # fmt: skip

    def _predict(self, slot: int, f: Flight) -> None:
        """Look around from scratch, and queue what comes first."""
        self._contact[slot] = None
        self._look(slot, f, self.grid.around)
        due = self._first(slot, f)
        if due is not None:
            heappush(self._heap, due)
        if f.next_tick is not None:
            self._tick(slot, f)

    # Predicting.

    def _look(self, slot: int, f: Flight, offsets: tuple[int, ...]) -> None:
        """Find the earliest contact of a disc with those in some cells near its own.

        It replaces the contact the disc knows already only if it comes first.
        """
        rows, cells, here = self._rows, self.grid.cells, self._cell[slot]
        filtered, bullets = self._filtered, self._bullets
        window, offset, x, y, vx, vy, r, me, bounced_off, source = rows[slot]  # type: ignore[misc]
        courses, bent = self._courses, []
        asked = 0
        known = self._contact[slot]
        best: tuple[Any, ...] = _NONE if known is None else known
        for delta in offsets:
            for other in cells[here + delta]:
                if other == slot:
                    continue
                if courses and (slot in courses or other in courses):
                    bent.append(other)
                    continue
                w, o, xo, yo, vxo, vyo, ro, it, ito, its = rows[other]  # type: ignore[misc]
                if (bounced_off == it and ito == me) or (bullets and (source == it or its == me)):
                    continue
                asked += 1
                # Both to the later of the two starts.
                age = offset - o if window == w else (window - w) * WINDOW + (offset - o)
                if age >= 0.0:
                    w, o = window, offset
                    t = filtered(x, y, vx, vy, r, xo + vxo * age, yo + vyo * age, vxo, vyo, ro)
                    if t != t:
                        self.undecided += 1
                        t = self._exact(
                            x, y, vx, vy, r, xo + vxo * age, yo + vyo * age, vxo, vyo, ro
                        )
                else:
                    t = filtered(x - vx * age, y - vy * age, vx, vy, r, xo, yo, vxo, vyo, ro)
                    if t != t:
                        self.undecided += 1
                        t = self._exact(x - vx * age, y - vy * age, vx, vy, r, xo, yo, vxo, vyo, ro)
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
        for other in bent:
            best = min(best, self._meet(slot, f, other))
        self.asked += asked
        if best is not known and best is not _NONE:
            w, o, rank, low, high, other = best
            serial, g = next(self._serial), self.flights[other]
            self._contact[slot] = w, o, rank, low, high, serial, slot, other, f, g

    def _meet(self, slot: int, f: Flight, other: int) -> tuple[Any, ...]:
        """The contact of two discs, one of them at least on a bent path."""
        g, courses = self.flights[other], self._courses
        assert g is not None
        me, it = f.entity.id or 0, g.entity.id or 0
        if own_bullet(f.entity, g.entity):
            return _NONE
        self.asked += 1
        mine, its = (courses[s].ends if s in courses else inf for s in (slot, other))
        if me < it:
            t = meeting(f, g, mine, its, self._exact_bent)
        else:
            t = meeting(g, f, its, mine, self._exact_bent)
        if t == inf:
            return _NONE
        window, offset = later(max(f.since, g.since), t)
        return window, offset, CONTACT, min(me, it), max(me, it), other

    def _exact_bent(self, *pair: Any) -> float:
        """What `quartic.contact_time_exact` says, counted."""
        self.undecided += 1
        return quartic.contact_time_exact(*pair)

    def _first_bent(self, slot: int, f: Flight) -> Due | None:
        """The same as `_first` for a disc on a bent path; it may come to a border and stay in its cell."""
        ends, rank = self._courses[slot]
        contact, best = self._contact[slot], None
        if ends < inf:
            best = (*later(f.since, ends), rank)
        grid, cell, now = self.grid, self._cell[slot], max(self._now, f.since)
        if len(grid.around) > 1 and ends > 0.0:
            stay = exit_time(f, now, grid.box(cell))
            if stay < inf:
                stay = max(stay, resolution(now), grid.shy / f.entity.max_speed)
            if stay < inf:
                crossing = (*later(now, stay), _CROSSING)
                best = crossing if best is None else min(best, crossing)
        if best is None:
            return contact
        due = *best, f.entity.id or 0, 0, next(self._serial), slot, 0, f, None
        return due if contact is None or due < contact else contact

    def _first(self, slot: int, f: Flight) -> Due | None:
        """The earlier of the contact a disc knows and its next wall or cell border; None if it has neither.

        The times are those of `physics.wall_time`, written out.
        """
        if slot in self._courses:
            return self._first_bent(slot, f)
        window, offset, x, y, vx, vy, r, me, _, _ = self._rows[slot]  # type: ignore[misc]
        grid, cell = self.grid, self._cell[slot]
        tx = ty = inf
        rank_x = rank_y = _CROSSING
        step_x = step_y = 0
        if vx > 0.0:
            edge, step_x = grid.rights[cell], grid.stride
            if edge is None:
                edge, rank_x = self._width - r, _RIGHT
            tx = (edge - x) / vx
        elif vx < 0.0:
            edge, step_x = grid.lefts[cell], -grid.stride
            if edge is None:
                edge, rank_x = r, _LEFT
            tx = (edge - x) / vx
        if vy > 0.0:
            edge, step_y = grid.tops[cell], 1
            if edge is None:
                edge, rank_y = self._height - r, _TOP
            ty = (edge - y) / vy
        elif vy < 0.0:
            edge, step_y = grid.bottoms[cell], -1
            if edge is None:
                edge, rank_y = r, _BOTTOM
            ty = (edge - y) / vy
        if not tx > 0.0:
            tx = 0.0
        if not ty > 0.0:
            ty = 0.0
        t, rank, step = (tx, rank_x, step_x) if tx <= ty else (ty, rank_y, step_y)
        contact = self._contact[slot]
        if t == inf:
            return contact
        offset += t
        if offset >= WINDOW:
            windows, offset = divmod(offset, WINDOW)
            window += int(windows)
        due = window, offset, rank, me, 0, next(self._serial), slot, step, f, None
        return due if contact is None or due < contact else contact

    def _tick(self, slot: int, f: Flight) -> None:
        window, offset = tick_moment(f.next_tick or 0)
        due = (window, offset, TICK, f.entity.id or 0, 0, next(self._serial), slot, 0, f, None)
        heappush(self._heap, due)

    # Coming due.

    def next_due(self, until: Moment) -> Due | None:
        """Take the next event up to a moment (inclusive) off the queue, or None if there is none.

        The caller applies it and tells `replace`; stale predictions and crossings are dealt with on the way.
        """
        heap, flights = self._heap, self.flights
        window, offset = until
        while heap:
            due = heap[0]
            if due[0] >= window and (due[0] > window or due[1] > offset):
                return None
            _, _, rank, _, _, _, slot, other, f, g = due
            if flights[slot] is not f:
                heappop(heap)
                continue
            if rank == _CROSSING:
                self._now = due[:2]
                if other == 0:
                    self._reassign(slot, f)
                else:
                    cells, cell = self.grid.cells, self._cell[slot]
                    cells[cell].remove(slot)
                    self._cell[slot] = cell + other
                    cells[cell + other].append(slot)
                    self._look(slot, f, self.grid.ahead[other])
            elif rank == CONTACT and flights[other] is not g:
                self._contact[slot] = None
                self._look(slot, f, self.grid.around)
            else:
                heappop(heap)
                self._happening = slot, f
                return due
            following = self._first(slot, f)
            if following is None:
                heappop(heap)
            else:
                heapreplace(heap, following)
        return None

    def _reassign(self, slot: int, f: Flight) -> None:
        """The cell of a disc on a bent path, now."""
        e = located(f, self._now)
        cell, to = self._cell[slot], self.grid.cell_at(e.x, e.y)
        if to != cell:
            self.grid.cells[cell].remove(slot)
            self._cell[slot] = to
            self.grid.cells[to].append(slot)
            self._look(slot, f, self.grid.around)

    def _compact(self) -> None:
        """Drop the predictions of flights that are over."""
        flights = self.flights
        self._heap = [due for due in self._heap if flights[due[6]] is due[8]]
        heapify(self._heap)


def take(world: World) -> Engine:
    """The engine of a world, which then has none; a new one, built from the flights, if it has none."""
    try:
        engine: Engine = world._box.pop()
    except IndexError:
        return Engine(world)
    return engine


def give(world: World, engine: Engine) -> None:
    """Make a world the owner of an engine that is up to date with it."""
    world._box.append(engine)


def peek(world: World) -> Engine | None:
    """The engine a world has, left where it is, for who reads its counters; None if it has none."""
    return world._box[0] if world._box else None
