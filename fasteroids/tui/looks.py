"""How to look at a world: what is drawn besides it, and which part of it is seen.

The world is letterboxed: whole, in the middle, and with one scale for both axes, so that circles stay round. Enlarged,
the view follows the selected entity and stops at the walls.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from attrs import field, frozen

from fasteroids.state import World
from fasteroids.tui.canvas import SURFACES, Canvas
from fasteroids.tui.overlay import Overlay, Point
from fasteroids.units import ModelError, shown

__all__ = ["DEATH_LASTS", "ZOOMS", "Death", "Look", "Viewport", "viewport"]

ZOOMS: Final = (1, 2, 4)
"""How many times the whole world a look may enlarge."""

DEATH_LASTS: Final = 0.8
"""Seconds during which an explosion is seen."""


class Death(NamedTuple):
    """Somebody died not long ago."""

    x: float
    y: float
    radius: float
    age: float
    """Seconds since then; drawn from 0 up to `DEATH_LASTS`."""


def _arena(_look: Look, _attribute: object, value: object) -> None:
    if value not in SURFACES:
        raise ModelError(f"an arena is one of {', '.join(SURFACES)}; got {shown(value)}")


def _zoom(_look: Look, _attribute: object, value: object) -> None:
    if value not in ZOOMS:
        raise ModelError(f"a zoom is one of {', '.join(map(str, ZOOMS))}; got {shown(value)}")


@frozen(kw_only=True)
class Look:
    """How to look at a world, and what to draw besides it.

    Raises: `ModelError` for an unknown arena or zoom.
    """

    arena: str = field(default="ascii", validator=_arena)
    """`ascii`, `braille` or `block`."""
    selected: int | None = None
    """The id of the entity that is marked, and that the view follows if it is enlarged."""
    players: tuple[int, ...] = ()
    """Ids of ships, in the order of their colours and letters, the dead included so that nobody changes colour.
    Ships that are not named come after them, by id."""
    trails: tuple[tuple[Point, ...], ...] = ()
    """Past places of bullets, km."""
    deaths: tuple[Death, ...] = ()
    overlay: Overlay | None = None
    ghosts: World | None = None
    """Another future of this world, drawn behind it."""
    tags: bool = True
    """Are the letters of ships shown? In ASCII they always are."""
    zoom: int = field(default=1, validator=_zoom)
    centre: Point | None = None
    """The middle of an enlarged view, if nobody is selected; None is the middle of the world."""


class Viewport(NamedTuple):
    """Which part of space is seen: a place (km) in the middle of a surface, and a scale for both axes."""

    x: float
    y: float
    span: float
    """Km that stand for `dots`: two numbers and not their quotient, which need not be a double."""
    dots: float
    """Widths of a dot."""
    tall: float
    """Height of a dot over its width."""
    middle_x: float
    """The middle of the surface, in dots from the left and (`middle_y`) from the top."""
    middle_y: float

    def place(self, x: float, y: float) -> Point:
        """A place (km) in dots, to the right and downwards. Infinite or nan if it was."""
        dots, span = self.dots, self.span
        return (
            self.middle_x + (x - self.x) / span * dots,
            self.middle_y - (y - self.y) / span * dots / self.tall,
        )

    def length(self, km: float) -> float:
        """A length (km) in widths of a dot."""
        return km / self.span * self.dots


def viewport(world: World, look: Look, surface: Canvas) -> Viewport:
    """The part of a world that is seen: all of it with one dot to spare for its walls, or an enlarged part."""
    tall = surface.tall
    wide, high = max(surface.width - 2.0, 0.0), max(surface.height - 2.0, 0.0) * tall
    width, height = world.width, world.height
    # Which side is the tighter one? Quotients, since products of extreme sizes would not be doubles.
    by_width = high == 0.0 or height == 0.0 or width / height >= wide / high
    span, dots = (width, wide) if by_width else (height, high)
    span, dots = span or 1.0, dots * look.zoom
    middle_x, middle_y = surface.width / 2.0, surface.height / 2.0
    x, y = width / 2.0, height / 2.0
    if look.zoom > 1:
        if look.selected in world:
            x, y = world[look.selected].position  # type: ignore[index]
        elif look.centre is not None:
            x, y = look.centre
        if dots > 0.0:
            # No further out than the walls: half of what is seen stays on either side, as far as there is so much.
            x = _within(x, (wide / 2.0) / dots * span, width)
            y = _within(y, (high / 2.0) / dots * span, height)
    return Viewport(x, y, span, dots, tall, middle_x, middle_y)


def _within(x: float, margin: float, size: float) -> float:
    """x, at least `margin` away from 0 and from `size`; the middle if there is not so much room."""
    return min(max(x, margin), size - margin) if 2.0 * margin < size else size / 2.0
