"""Events and worlds as JSON: floats in shortest round-trip form, null for what is not finite."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import isfinite
from typing import Any, Final

from attrs import fields

from fasteroids.actions import Action, Fire, Skip, Thrust, ThrustOff, Turn
from fasteroids.entities import Entity, Ship
from fasteroids.events import Happened
from fasteroids.lang import Span
from fasteroids.state import World

__all__ = ["action_name", "compact", "event", "indented", "world_record"]

_ACTIONS: Final[Mapping[type[Action], str]] = {
    Turn: "turn",
    Fire: "fire",
    Thrust: "thrust",
    ThrustOff: "thrust_off",
    Skip: "skip",
}


def compact(record: Mapping[str, Any]) -> str:
    """One line of JSON."""
    return json.dumps(record, default=str, allow_nan=False)


def indented(record: Mapping[str, Any]) -> str:
    """JSON for people, with the end of its last line."""
    return json.dumps(record, default=str, allow_nan=False, indent=2) + "\n"


def event(happened: Happened) -> dict[str, Any]:
    """An event: time, kind, entities, effect, and the other fields where they say something."""
    record: dict[str, Any] = {
        "time": happened.time,
        "kind": happened.kind,
        "entities": happened.entities,
        "effect": happened.effect,
    }
    for name in ("wall", "died", "born", "clipped", "prints", "span", "reason"):
        value = getattr(happened, name)
        if value is not None and value != ():
            record[name] = value._asdict() if isinstance(value, Span) else value
    if happened.at is not None:
        record["at"] = [_number(z) for z in happened.at]
    return record


def world_record(world: World) -> dict[str, Any]:
    """A world at its clock, with every entity's fields there, in id order."""
    return {
        "time": world.time,
        "width": world.width,
        "height": world.height,
        "seed": world.seed,
        "model": world.model,
        "fuel": world.fuel,
        "entities": [_entity(e) for e in world.entities.values()],
    }


def _entity(e: Entity) -> dict[str, Any]:
    """An entity: kind, id, name, the fields of its constructor, and its mass (null if that overflows)."""
    record: dict[str, Any] = {"kind": type(e).__name__.lower(), "id": e.id, "name": e.name}
    for a in fields(type(e)):
        value = getattr(e, a.name)
        record[a.name] = _number(value) if isinstance(value, float) else value
    record["mass"] = _number(e.mass)
    if isinstance(e, Ship):
        record["program"] = e.program and ("running" if e.program.running else "stopped")
    return record


def _number(value: float) -> float | None:
    return value if isfinite(value) else None


def action_name(action: Action) -> str:
    """The word of the language for an action."""
    return _ACTIONS[type(action)]
