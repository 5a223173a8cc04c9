"""A picture of a world: `frame` maps a world and a look at it to rows of characters and colours.

No clock, no terminal: the same world, look and size give the same frame, so frames are tested as text, kept in files
and compared to find out that nothing moved. Drawn last, and so never hidden, are the ships.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from math import cos, pi, sin, tau
from typing import Final

from attrs import frozen

from fasteroids.entities import Asteroid, Bullet, Entity, Ship, id_of
from fasteroids.physics import distance
from fasteroids.state import World, located
from fasteroids.tui import palette
from fasteroids.tui.canvas import Canvas, Cells, canvas
from fasteroids.tui.looks import DEATH_LASTS, ZOOMS, Death, Look, Viewport, viewport
from fasteroids.tui.overlay import Overlay, Point

__all__ = ["DEATH_LASTS", "ZOOMS", "Death", "Frame", "Look", "Viewport", "frame", "viewport"]

_LEAST: Final = 3.0
"""Radius in dots below which a ship is drawn larger than it is, to see where it points."""

_FAR: Final = 1e6
"""Dots: nothing that far out is in sight."""

_FEW_MARKS: Final = 6
"""Up to so many predicted meetings all tell their time; beyond that only those of the selected entity."""


@frozen
class Frame:
    """A picture: so many rows of so many cells. Two that compare equal look the same."""

    columns: int
    rows: tuple[Cells, ...]

    def __str__(self) -> str:
        """The text without colours."""
        return "".join(f"{row.text}\n" for row in self.rows)


def frame(world: World, look: Look, columns: int, rows: int) -> Frame:
    """The picture of a world on so many cells (0 or more each). It never raises for what a world holds."""
    columns, rows = max(columns, 0), max(rows, 0)
    surface = canvas(look.arena, columns, rows)
    if surface.width > 2 and surface.height > 2:
        _Painter(world, look, surface).paint()
    return Frame(columns, surface.read())


class _Painter:
    """One picture in the making."""

    def __init__(self, world: World, look: Look, surface: Canvas) -> None:
        self.world, self.look, self.surface = world, look, surface
        self.view = viewport(world, look, surface)
        self.plain = look.arena == "ascii"
        self.ranks = _ranks([world, *([look.ghosts] if look.ghosts else [])], look.players)

    def paint(self) -> None:
        """From the back to the front."""
        look, world, surface = self.look, self.world, self.surface
        size = (surface.columns, surface.rows)
        surface.begin_as(_walls(look.arena, size, self.view, world.width, world.height))
        if look.ghosts is not None:
            self._ghosts(look.ghosts)
        for trail in look.trails:
            self._track(trail, palette.TRAIL, ".")
        if look.overlay is not None:
            for way in look.overlay.lines:
                points = _off(
                    way.points, self.world[way.id].radius if way.id in self.world else 0.0
                )
                self._track(points, palette.OVERLAY, ".", every=1 if self.plain else 3)
        entities = _present(self.world)
        for e in entities:
            if type(e) is Asteroid:
                x, y = self.view.place(e.x, e.y)
                self.surface.circle(x, y, self.view.length(e.radius), palette.ASTEROID)
        for e in entities:
            if type(e) is Bullet:
                self._bullet(e)
        for death in look.deaths:
            self._explosion(death)
        if look.overlay is not None:
            self._marks(look.overlay)
        ships = [e for e in entities if type(e) is Ship]
        for ship in ships:
            self._ship(ship)
        self._tags(ships)
        self._selection(entities)

    # What there is.

    def _bullet(self, bullet: Bullet) -> None:
        surface = self.surface
        x, y = self.view.place(bullet.x, bullet.y)
        rank = self.ranks.get(bullet.source)
        colour = palette.BULLET if rank is None else palette.player(rank)
        radius = self.view.length(bullet.radius)
        if self.plain:
            surface.dot(x, y, colour)
        elif radius >= 2.0:
            surface.circle(x, y, radius, colour)
        else:
            for i in (0.0, 1.0) if self.look.arena == "braille" else (0.0,):
                surface.dot(x + i, y, colour)
                surface.dot(x + i, y + i, colour)
                surface.dot(x, y + i, colour)

    def _ship(self, ship: Ship, ghost: bool = False) -> None:
        x, y = self.view.place(ship.x, ship.y)
        if not (abs(x) < _FAR and abs(y) < _FAR and self.view.length(ship.radius) < _FAR):
            return
        rank = self.ranks[id_of(ship)]
        colour = palette.GHOST if ghost else palette.player(rank)
        if self.plain:
            self._lettered(ship, rank, x, y, colour, ghost)
        else:
            self._figured(ship, rank, x, y, colour, ghost)

    def _figured(self, ship: Ship, rank: int, x: float, y: float, colour: int, ghost: bool) -> None:
        """A ship as a figure that points where it faces, at least big enough to see where."""
        surface = self.surface
        size = max(self.view.length(ship.radius), _LEAST)
        c, s = cos(ship.direction) * size, sin(ship.direction) * size
        tall = surface.tall
        if ship.thruster and not ghost:
            for side in (-0.35, 0.0, 0.35):
                long = 2.2 if side == 0.0 else 1.7
                surface.line(
                    x - 1.1 * c - side * s, y + (1.1 * s - side * c) / tall,
                    x - long * c - side * s, y + (long * s - side * c) / tall,
                    palette.FLAME,
                )  # fmt: skip
        for polyline in palette.figure(rank):
            corners = [
                (x + forward * c - left * s, y - (forward * s + left * c) / tall)
                for forward, left in polyline
            ]
            for (ax, ay), (bx, by) in pairwise(corners):
                surface.line(ax, ay, bx, by, colour, every=2 if ghost else 1)

    def _lettered(
        self, ship: Ship, rank: int, x: float, y: float, colour: int, ghost: bool
    ) -> None:
        """A ship in ASCII: its outline if that is larger than three cells, its letter, and a nose beside it."""
        surface = self.surface
        radius = self.view.length(ship.radius)
        letter = palette.letter(rank)
        if radius >= 2.5:
            surface.circle(x, y, radius, colour, sparse=ghost)
        right, down, shaft, nose = _NOSES[round(ship.direction / (pi / 4.0)) % 8]
        reach = min(max(1, round(radius)), surface.columns)
        high = max(1, round(reach / 2.0)) if down else 0
        steps = high if down else reach  # a diagonal goes down a row for each column
        dx, dy = (right * reach / steps, float(down))
        if ship.thruster and not ghost:
            back = steps if radius >= 2.5 else 1  # behind the outline, if there is one
            sign = "~" if right else '"'
            surface.dot(x - dx * back, y - dy * back, palette.FLAME, sign)
        for i in range(1, steps):
            surface.dot(x + dx * i, y + dy * i, colour, "." if ghost else shaft)
        surface.dot(x + dx * steps, y + dy * steps, colour, "." if ghost else nose)
        surface.dot(x, y, colour, letter.lower() if ghost else letter)

    def _explosion(self, death: Death) -> None:
        """Fragments that fly apart from where somebody was."""
        share = death.age / DEATH_LASTS
        if not 0.0 <= share < 1.0:
            return
        surface = self.surface
        x, y = self.view.place(death.x, death.y)
        radius = min(max(self.view.length(death.radius), 2.0), 64.0)
        sign = "*" if share < 0.4 else "+" if share < 0.7 else "."
        fragments = 16 if radius >= 6.0 else 8
        for i in range(fragments):
            far = radius * (0.3 + 1.2 * share) * (0.7 if i % 2 else 1.0)
            angle = i * tau / fragments
            surface.dot(
                x + far * cos(angle), y - far * sin(angle) / surface.tall, palette.EXPLOSION, sign
            )

    # What might be, and was.

    def _ghosts(self, ghosts: World) -> None:
        """The entities of another future that are not where they are in this one."""
        here = {id_of(e): (e.x, e.y) for e in _present(self.world)}
        for e in _present(ghosts):
            if here.get(id_of(e)) == (e.x, e.y):
                continue
            if type(e) is Ship:
                self._ship(e, ghost=True)
                continue
            x, y = self.view.place(e.x, e.y)
            self.surface.circle(x, y, self.view.length(e.radius), palette.GHOST, sparse=True)

    def _track(self, points: Sequence[Point], colour: int, sign: str, every: int = 1) -> None:
        places = [self.view.place(x, y) for x, y in points]
        for (ax, ay), (bx, by) in pairwise(places):
            self.surface.line(ax, ay, bx, by, colour, every=every, sign=sign)

    def _marks(self, overlay: Overlay) -> None:
        """Where the next meetings will be, and when."""
        surface, selected = self.surface, self.look.selected
        for mark in overlay.marks:
            x, y = self.view.place(*mark.at)
            if not (0.0 <= x <= surface.width and 0.0 <= y <= surface.height):
                continue
            column = min(int(x) // surface.across, surface.columns - 1)
            row = min(int(y) // surface.down, surface.rows - 1)
            surface.text(column, row, "X" if mark.fatal else "x", palette.OVERLAY)
            if selected in mark.ids or len(overlay.marks) <= _FEW_MARKS:
                self._beside(column, row, f"{mark.seconds:.1f}s", palette.OVERLAY)

    def _tags(self, ships: Iterable[Ship]) -> None:
        if self.plain or not self.look.tags:
            return
        surface = self.surface
        for ship in ships:
            rank = self.ranks[id_of(ship)]
            x, y = self.view.place(ship.x, ship.y)
            size = max(self.view.length(ship.radius), _LEAST) * 1.2
            if not (abs(x) + size < _FAR and abs(y) < _FAR):
                continue
            # On the side the ship turns its back to, so that the letter never covers its nose.
            side = -1 if cos(ship.direction) > 0.0 else 1
            column = int(x + side * (size + surface.across)) // surface.across
            surface.text(column, int(y) // surface.down, palette.letter(rank), palette.player(rank))

    def _selection(self, entities: Iterable[Entity]) -> None:
        """Brackets around the selected entity, and its id."""
        surface = self.surface
        for e in entities:
            if e.id != self.look.selected:
                continue
            x, y = self.view.place(e.x, e.y)
            if not (abs(x) < _FAR and abs(y) < _FAR):
                continue
            column, row = int(x) // surface.across, int(y) // surface.down
            size = min(self.view.length(e.radius), _FAR)
            tag = 0
            if type(e) is Ship and not self.plain:
                size, tag = 1.3 * max(size, _LEAST), int(self.look.tags)
            reach = int(size / surface.across) + 2 + tag
            left, right = column - reach, column + reach
            surface.text(left, row, "[", palette.SELECTED)
            surface.text(right, row, "]", palette.SELECTED)
            self._beside(right, row, f"#{e.id}", palette.SELECTED)

    def _beside(self, column: int, row: int, text: str, colour: int) -> None:
        """Text to the right of a cell, or to its left, or above or below it: where there is room, else nowhere."""
        length = len(text)
        for at, line in (
            (column + 1, row), (column - length, row), (column + 1, row - 1), (column + 1, row + 1),
            (column - length, row - 1), (column - length, row + 1),
        ):  # fmt: skip
            if self.surface.free(at, line, length):
                self.surface.text(at, line, text, colour)
                return


@lru_cache(maxsize=16)
def _walls(
    arena: str, size: tuple[int, int], view: Viewport, width: float, height: float
) -> Canvas:
    """The border of a world, just outside of it. It is the same in most frames of a game."""
    surface = canvas(arena, *size)
    left, bottom = view.place(0.0, 0.0)
    right, top = view.place(width, height)
    # Half a dot outwards from the border, so that a wall is next to what touches it.
    left, right, top, bottom = left - 0.5, right + 0.5, top - 0.5, bottom + 0.5
    for y in (top, bottom):
        surface.line(left, y, right, y, palette.WALL, sign="-")
    for x in (left, right):
        surface.line(x, top, x, bottom, palette.WALL, sign="|")
    for x in (left, right):
        for y in (top, bottom):
            surface.dot(x, y, palette.WALL, "+")
    return surface


_NOSES: Final = (
    (1, 0, "-", ">"), (1, -1, "/", "/"), (0, -1, "|", "^"), (-1, -1, "\\", "\\"),
    (-1, 0, "-", "<"), (-1, 1, "/", "/"), (0, 1, "|", "v"), (1, 1, "\\", "\\"),
)  # fmt: skip
"""Columns to the right, rows down, and the signs of a nose, by eighths of a turn."""


def _present(world: World) -> list[Entity]:
    """Who is in a world, where it is now, in id order."""
    now, flights = world.now, world.flights
    return [located(flights[slot], now) for _, slot in sorted(world.roster.slots.items())]  # type: ignore[arg-type]


def _off(points: Sequence[Point], radius: float) -> Sequence[Point]:
    """A way without the part that its entity covers, if that is part of its first piece."""
    if len(points) > 1:
        (x, y), (to_x, to_y) = points[:2]
        length = distance(to_x - x, to_y - y)
        if radius < length:
            share = radius / length
            return [(x + (to_x - x) * share, y + (to_y - y) * share), *points[1:]]
    return points


def _ranks(worlds: Iterable[World], players: Sequence[int]) -> dict[int, int]:
    """The rank of each ship, which decides its colour, figure and letter: players first, then by world and id."""
    ranks = {i: rank for rank, i in enumerate(dict.fromkeys(players))}
    for world in worlds:
        for i, slot in sorted(world.roster.slots.items()):
            f = world.flights[slot]
            if f is not None and type(f.entity) is Ship:
                ranks.setdefault(i, len(ranks))
    return ranks
