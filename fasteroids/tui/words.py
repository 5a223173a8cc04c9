"""What happened, in plain words, as told of one who took part."""

from __future__ import annotations

from math import degrees
from typing import Final

from fasteroids.actions import Action, Fire, Skip, Thrust, ThrustOff, Turn
from fasteroids.events import Happened
from fasteroids.history.inputs import Act, Add, Instruct, Remove
from fasteroids.history.living import Told, What
from fasteroids.state import World, describe

__all__ = ["action", "called", "happened", "number"]

_PLAIN: Final[dict[type, str]] = {
    Fire: "fire",
    Skip: "skip",
    Thrust: "thrust on",
    ThrustOff: "thrust off",
}
_TICKED: Final = {
    "thrust": "thrust on",
    "thrust_off": "thrust off",
    "end": "came to its end",
    "halt": "halted",
    "fuel": "ran out of fuel",
}


def called(world: World, entity: int) -> str:
    """What to call an entity: kind, and name or id; of one that is not in this world only the id."""
    return describe(world[entity]) if entity in world else f"#{entity}"


def number(value: float) -> str:
    """A number for people, six digits at most."""
    return f"{value + 0.0:.6g}"


def action(what: Action) -> str:
    """An action as people say it; an angle in degrees."""
    if isinstance(what, Turn):
        return f"turn {number(degrees(what.angle))} deg"
    return _PLAIN[type(what)]


def happened(what: What, me: int, world: World) -> str:
    """What led to a state, as told of an entity that took part in it. `world` is for the names of others."""
    if isinstance(what, Told):
        return _told(what, me, world)
    if not isinstance(what, Happened):
        return "the past begins" if what is None else "time was cut"
    told = {"contact": _contact, "wall": _wall, "limit": _limit, "tick": _tick}[what.kind]
    sentence = told(what, me, world)
    if me not in what.entities and me in what.born:
        by = called(world, what.entities[0])
        sentence = f"fired by {by}" if what.effect == "fire" else f"split off {_parent(what)}"
    if me in what.died and what.born and what.effect == "split":
        sentence += f", leaving {_ids(what.born)}"
    if me in what.clipped:
        sentence += ", at its speed limit"
    return sentence


def _ids(ids: tuple[int, ...]) -> str:
    return " and ".join(f"#{i}" for i in ids)


def _parent(what: Happened) -> str:
    return _ids(what.died) if len(what.died) == 1 else _ids(what.entities)


def _contact(what: Happened, me: int, world: World) -> str:
    other = " and ".join(called(world, i) for i in what.entities if i != me)
    if me in what.died:
        return f"died in a contact with {other}"
    if what.died:
        return f"touched {other}, which died"
    return f"pressed on {other}" if what.effect == "press" else f"bounced off {other}"


def _wall(what: Happened, me: int, _world: World) -> str:
    return f"{'died at' if me in what.died else 'bounced off'} the {what.wall} wall"


def _limit(what: Happened, _me: int, _world: World) -> str:
    return f"{'reached' if what.effect == 'reach' else 'left'} its speed limit"


def _tick(what: Happened, me: int, world: World) -> str:
    line = "" if what.span is None else f" (line {what.span.line})"
    if me not in what.entities:
        return f"hit as {called(world, what.entities[0])} fired{line}"
    reason = f": {what.reason}" if what.reason else ""
    return f"program: {_TICKED.get(what.effect, what.effect)}{line}{reason}"


def _told(told: Told, me: int, world: World) -> str:
    match told.what:
        case Act(ship, what):
            if ship == me:
                return f"by hand: {action(what)}"
            by = called(world, ship)
            return f"hit as {by} fired" if me not in told.born else f"fired by {by}"
        case Instruct():
            return "got another program"
        case Add():
            return "came into the world"
        case Remove():
            return "was taken out"
    return "time was cut"
