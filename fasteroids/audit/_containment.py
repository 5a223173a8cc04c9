"""Law L7 at every moment of a run: in bounds, and no two overlap. `fasteroids.audit` says how and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from itertools import zip_longest
from math import frexp, inf, isfinite, ldexp, ulp
from typing import TypeAlias

from fasteroids.audit._curves import bend, deepest, excursion, turns
from fasteroids.audit._margins import Worst
from fasteroids.entities import Bullet, Entity
from fasteroids.moments import Moment, between, later, resolution
from fasteroids.overlap import overhang, slack
from fasteroids.physics import distance
from fasteroids.state import Flight, World, located
from fasteroids.units import WINDOW

__all__ = ["Containment"]

_Row: TypeAlias = tuple[int, float, float, float, float, float, float, int, int]
"""A flight laid flat for the inner loop: window, offset, x, y, vx, vy, radius, id, source (0 but for bullets)."""

_FLOOR = 0.25
"""Overlaps of bent flights below this share of what is allowed are not searched for."""


class Containment:
    """The flights of a run as they come and go, and the worst of their overlaps and overhangs.

    `slots` is the slot of each id. Flights of a world that were on their way before the run may have overlapped
    and stuck out as they did; that much is allowed on top.
    """

    def __init__(self, world: World) -> None:
        self.overlap = Worst("L7", "overlap", "km")
        self.overhang = Worst("L7", "out of bounds", "km")
        self.slots: dict[int, int] = {}
        self._width, self._height = world.width, world.height
        self._flights: list[Flight | None] = []
        self._rows: list[_Row | None] = []
        self._bent: set[int] = set()
        self._slack: dict[int, float] = {}
        self._given: dict[tuple[int, ...], float] = {}
        for f in world.flights:
            if f is not None:
                ends = (f.since, *_extremes(f, world.now))
                over = max(self._overhang(located(f, moment)) for moment in ends)
                self._given[_ids(f)] = max(over, 0.0)
        self.change(world, ())
        for slot, others in self._near(world.now):
            for other, _, depth in self._overlaps(slot, others, world.now):
                self._given[_ids(self._flights[slot], self._flights[other])] = depth

    def flight(self, entity_id: int) -> Flight | None:
        """The flight an entity is on, or None if there is no such entity."""
        slot = self.slots.get(entity_id)
        return None if slot is None else self._flights[slot]

    def change(
        self, world: World, parents: Iterable[int]
    ) -> list[tuple[Flight | None, Flight | None]]:
        """Go over to another world: check the flights that ended and those that start, and return them in pairs.

        What is born inherits the slack of the `parents`, the entities in the event.
        """
        now, old, new = world.now, self._flights, list(world.flights)
        changed = [
            (slot, f, g)
            for slot, (f, g) in enumerate(zip_longest(old, new))
            if f is not g and not (f is not None and g is not None and _same_path(f, g))
        ]
        elders = [self.slots[i] for i in parents if i in self.slots]
        inherited = max((self._slack_of(slot, now) for slot in elders), default=0.0)
        for slot, f, _ in changed:
            if f is not None:
                self._check_bounds(f, now)
                self._check_overlaps(slot, range(len(old)), now)
        for slot, f, g in changed:
            if f is not None:
                i = f.entity.id or 0
                self._slack[i] = self._slack_of(slot, now)
                if g is None or g.entity.id != i:
                    del self._slack[i], self.slots[i]
        self._flights = new
        self._rows += [None] * (len(new) - len(self._rows))
        for slot, _, g in changed:
            self._rows[slot] = None if g is None else _row(g)
            self._bent.discard(slot)
            if g is not None:
                if g.path is not None:
                    self._bent.add(slot)
                i = g.entity.id or 0
                self.slots[i] = slot
                self._slack.setdefault(i, inherited)
                self._check_bounds(g, g.since)
        return [(f, g) for _, f, g in changed]

    def finish(self, now: Moment) -> None:
        """Check the flights that last to the end of the run."""
        for slot, others in self._near(now):
            self._check_overlaps(slot, others, now)
        for f in self._flights:
            if f is not None:
                self._check_bounds(f, now)

    def _slack_of(self, slot: int, now: Moment) -> float:
        """How far (km) rounding may have put the entity in a slot, at most, until now."""
        f = self._flights[slot]
        assert f is not None
        own = slack(located(f, now), between(f.since, now), resolution(now), bend=bend(f))
        return max(own, self._slack.get(f.entity.id or 0, 0.0))

    # Bounds.

    def _overhang(self, e: Entity) -> float:
        """How far (km) a disc sticks out; infinitely far if it is nowhere."""
        return overhang(e, self._width, self._height) if isfinite(e.x - e.y) else inf

    def _check_bounds(self, f: Flight, until: Moment) -> None:
        """Is a flight in the world at one of its ends, and where it turned back on the way there?"""
        for moment in _extremes(f, until):
            e = located(f, moment)
            over = self._overhang(e)
            if over > 0.0:
                ids = _ids(f)
                own = slack(e, between(f.since, moment), resolution(moment), bend=bend(f))
                allowed = max(own, self._slack.get(ids[0], 0.0)) + self._given.get(ids, 0.0)
                self.overhang.see(over, allowed, moment, ids, over / _grain(e))

    # Overlaps.

    def _check_overlaps(self, slot: int, others: Iterable[int], now: Moment) -> None:
        """Does the flight in a slot overlap some others by more than it may, until now?"""
        for other, age, depth in self._overlaps(slot, others, now):
            f, g = self._flights[slot], self._flights[other]
            assert f is not None
            assert g is not None
            ids = _ids(f, g)
            allowed = self._allowed(slot, other, now)
            moment = later(f.since, age)
            grain = max(_grain(located(f, moment)), _grain(located(g, moment)))
            self.overlap.see(depth, allowed, moment, ids, depth / grain)

    def _allowed(self, slot: int, other: int, now: Moment) -> float:
        """How deep (km) two may overlap until now."""
        ids = _ids(self._flights[slot], self._flights[other])
        slacks = self._slack_of(slot, now) + self._slack_of(other, now)
        return slacks + self._given.get(ids, 0.0)

    def _floor(self, slot: int, other: int, now: Moment) -> float:
        """The depth (km) up to which an overlap of two is no news."""
        return self._allowed(slot, other, now) * max(self.overlap.share, _FLOOR)

    def _curved(
        self, slot: int, others: Iterable[int], now: Moment
    ) -> Iterator[tuple[int, float, float]]:
        """What `_overlaps` says, for pairs with a bent flight."""
        f, mine = self._flights[slot], self._rows[slot]
        assert f is not None
        assert mine is not None
        for other in others:
            g, row = self._flights[other], self._rows[other]
            if g is None or row is None or other == slot or mine[8] == row[7] or row[8] == mine[7]:
                continue
            t, depth = deepest(f, g, now, partial(self._floor, slot, other, now))
            if depth > 0.0:
                yield other, between(f.since, max(f.since, g.since)) + t, depth

    def _overlaps(
        self, slot: int, others: Iterable[int], now: Moment
    ) -> Iterator[tuple[int, float, float]]:
        """The slots whose flights overlapped that in `slot` while both lasted, until now.

        With each the age (s) of the flight in `slot` when the overlap was deepest, and how deep it was (km).
        """
        rows, mine = self._rows, self._rows[slot]
        if mine is None:
            return
        if self._bent:
            others = list(others)
            bent = [other for other in others if slot in self._bent or other in self._bent]
            yield from self._curved(slot, bent, now)
            others = [o for o in others if o not in self._bent] if slot not in self._bent else ()
        window, offset, x, y, vx, vy, r, me, source = mine
        since = (now[0] - window) * WINDOW + (now[1] - offset)
        for other in others:
            row = rows[other]
            if row is None or other == slot:
                continue
            w, o, xo, yo, vxo, vyo, ro, it, its = row
            # Both to the later of the two starts, and from there on.
            age = (window - w) * WINDOW + (offset - o)
            dvx, dvy = vxo - vx, vyo - vy
            if age >= 0.0:
                dx, dy, span = (xo + vxo * age) - x, (yo + vyo * age) - y, since
            else:
                dx, dy = xo - (x - vx * age), yo - (y - vy * age)
                span = (now[0] - w) * WINDOW + (
                    now[1] - o
                )  # not since + age, which rounds at the age
            # Where rounding could hide a gap of a whole sum of radii, nothing overlaps by more than the slack.
            reach = 2.0 * (r + ro)
            if abs(dx) - abs(dvx) * span > reach or abs(dy) - abs(dvy) * span > reach or span < 0.0:
                continue
            t = _nearest(dx, dy, dvx, dvy, span)
            depth = (r + ro) - distance(dx + dvx * t, dy + dvy * t)
            if depth > 0.0 and source != it and its != me:
                yield other, since - span + t, depth

    def _near(self, now: Moment) -> Iterator[tuple[int, list[int]]]:
        """Each slot with those whose flights swept over a common x: all that can have met. A sweep from the left."""
        spans = []
        for slot, f in enumerate(self._flights):
            if f is not None:
                e, end = f.entity, located(f, now)
                room = e.radius + self._slack_of(slot, now)
                if f.path is not None:
                    room += excursion(f, between(f.since, now))
                spans.append((min(e.x, end.x) - room, max(e.x, end.x) + room, slot))
        spans.sort()
        active: list[tuple[float, int]] = []
        for left, right, slot in spans:
            active = [item for item in active if item[0] >= left]
            yield slot, [other for _, other in active]
            active.append((right, slot))


def _row(f: Flight) -> _Row:
    e = f.entity
    source = e.source if type(e) is Bullet else 0
    return *f.since, e.x, e.y, e.vx, e.vy, e.radius, e.id or 0, source


def _ids(*flights: Flight | None) -> tuple[int, ...]:
    """The ids of flights, in order."""
    return tuple(sorted(0 if f is None else f.entity.id or 0 for f in flights))


def _grain(e: Entity) -> float:
    """The unit in the last place (km) of the coordinates of an entity."""
    return ulp(max(abs(e.x), abs(e.y), e.radius))


def _same_path(f: Flight, g: Flight) -> bool:
    """Is the second flight the first one with other intentions (a turn, a switch, a tick)?"""
    a, b = f.entity, g.entity
    return (f.since, a.id, a.x, a.y, a.vx, a.vy, f.path) == (
        g.since, b.id, b.x, b.y, b.vx, b.vy, g.path,
    )  # fmt: skip


def _extremes(f: Flight, until: Moment) -> list[Moment]:
    """Moments at which a flight is farthest out in some direction, but for its start."""
    if f.path is None:
        return [until]
    return [*(later(f.since, age) for age in turns(f, between(f.since, until))), until]


def _nearest(x: float, y: float, vx: float, vy: float, span: float) -> float:
    """When in [0, span] s a relative position (km) that moves at a relative velocity (km/s) is shortest.

    The vertex -r.v / v.v of the parabola, in scaled numbers so that no product over- or underflows.
    """
    m, n = frexp(max(abs(x), abs(y)))[1], frexp(max(abs(vx), abs(vy)))[1]
    x, y, vx, vy = ldexp(x, -m), ldexp(y, -m), ldexp(vx, -n), ldexp(vy, -n)
    b = x * vx + y * vy
    if not b < 0.0:
        return 0.0
    try:
        return min(ldexp(-b / (vx * vx + vy * vy), m - n), span)
    except OverflowError:
        return span
