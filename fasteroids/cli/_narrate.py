"""A run told in words: one line an event."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from fasteroids.entities import Asteroid, Bullet, Entity, Ship
from fasteroids.events import Happened
from fasteroids.lang import Span
from fasteroids.state import World
from fasteroids.units import SPLIT_RADIUS

__all__ = ["Narrator", "census", "counted", "label", "listed", "number"]

_KINDS: Final = {Ship: "ship", Asteroid: "asteroid", Bullet: "bullet"}

_TICKS: Final = {
    "turn": "turns",
    "thrust": "switches its thruster on",
    "thrust_off": "switches its thruster off",
    "skip": "skips",
    "end": "comes to the end of its program",
}


def label(e: Entity) -> str:
    """What people call an entity: its name, or its kind and id."""
    return e.name if e.name is not None else f"{_KINDS[type(e)]} #{e.id}"


def listed(names: Iterable[str]) -> str:
    """Names in a row: "a", "a and b", "a, b and c"."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


def counted(amount: int, what: str) -> str:
    """An amount of something, in the singular or with an s."""
    return f"{amount:,} {what}" if amount == 1 else f"{amount:,} {what}s"


def number(value: float) -> str:
    """A number for people: six digits, no zeros at the end."""
    return f"{value:.6g}"


def census(world: World) -> str:
    """How many of each kind there are: "2 ships and 5 asteroids"."""
    kinds = [type(f.entity) for f in world.flights if f is not None]
    amounts = [(kinds.count(kind), name) for kind, name in _KINDS.items()]
    return listed([counted(n, name) for n, name in amounts if n] or ["nothing"])


def _line(happened: Happened) -> str:
    """Where in its text a program stopped."""
    return f" on line {happened.span.line}" if isinstance(happened.span, Span) else ""


class Narrator:
    """Tells events in the names of a world's entities, which it keeps up to date.

    `span` is the length of the run (s); it decides how many digits the times have.
    """

    def __init__(self, world: World, span: float) -> None:
        self._form = ".3f" if 0.1 <= span <= 1e6 else ".9g"
        self._names: dict[int, str] = {}
        self._splitting: set[int] = set()
        self._pressing: set[tuple[int, ...]] = set()
        for f in world.flights:
            if f is not None:
                self._meet(f.entity)

    def _meet(self, e: Entity) -> None:
        self._names[e.id or 0] = label(e)
        if type(e) is Asteroid and e.radius >= SPLIT_RADIUS:
            self._splitting.add(e.id or 0)

    def name(self, entity_id: int) -> str:
        """The name of an entity, living or dead. One that never entered a world is a bullet."""
        return self._names.get(entity_id, f"bullet #{entity_id}")

    def time(self, seconds: float) -> str:
        """The start of a line."""
        return f"{seconds:{self._form}}"

    def line(self, happened: Happened | None, world: World) -> str | None:
        """The line of an event, with the world just after it. None without an event.

        Two that press on each other do so in many small hops: they are told of once, until something else happens
        to one of them.
        """
        if happened is None or self._known(happened):
            return None
        told = self._told(happened)
        for i in happened.born:
            if i in world:
                self._meet(world.flight_of(i).entity)
        if happened.clipped:
            names = listed(self.name(i) for i in happened.clipped)
            told += f"; {names} clipped to the speed limit"
        time = self.time(happened.time)
        prints = [
            f"{time}  {self.name(happened.entities[0])}: {line if line.isprintable() else repr(line)}"
            for line in happened.prints
        ]
        return "\n".join([*prints, f"{time}  {told}"])

    def _known(self, happened: Happened) -> bool:
        """Is this one more hop of two that press on each other?"""
        if happened.effect == "press" and happened.entities in self._pressing:
            return True
        self._pressing = {pair for pair in self._pressing if not {*pair} & {*happened.entities}}
        if happened.effect == "press":
            self._pressing.add(happened.entities)
        return False

    def _told(self, happened: Happened) -> str:
        names = [self.name(i) for i in happened.entities]
        where = "" if happened.at is None else f" at ({', '.join(map(number, happened.at))})"
        match happened.kind, happened.effect:
            case "contact", "bounce":
                return f"{listed(names)} bounce{where}"
            case "contact", "press":
                return f"{listed(names)} press on each other{where}"
            case "contact", _:
                return f"{listed(names)} collide{where}: {self._fates(happened)}"
            case "wall", "bounce":
                return f"{names[0]} bounces off the {happened.wall} wall"
            case "wall", _:
                return f"{names[0]} dies at the {happened.wall} wall"
            case "limit", "leave":
                return f"{names[0]} leaves its speed limit: its thrust slows it"
            case "limit", _:
                return f"{names[0]} reaches its speed limit"
            case "tick", "fire":
                return f"{names[0]} {self._shot(happened)}"
            case "tick", "halt":
                reason = happened.reason or "an illegal operation"
                return f"{names[0]} stops its program{_line(happened)}: {reason}"
            case "tick", "fuel":
                return f"{names[0]} has no fuel left{_line(happened)}; it goes on at its next tick"
            case "tick", effect if effect in _TICKS:
                return f"{names[0]} {_TICKS[effect]}"
        return str(happened)

    def _fates(self, happened: Happened) -> str:
        """Who died, and what was left."""
        left = [i for i in happened.born if i not in happened.died]
        fates = []
        for i in happened.died:
            fate = "dies"
            if i in self._splitting and left:
                fate = f"splits into {listed(f'#{child}' for child in left)}"
            fates.append(f"{self.name(i)} {fate}")
        return ", ".join(fates)

    def _shot(self, happened: Happened) -> str:
        if not happened.born:
            return "fires in vain"
        if happened.died:
            return f"fires into what is there: {self._fates(happened)}"
        return f"fires bullet #{happened.born[0]}"
