"""Events and worlds as JSON: floats in shortest round-trip form, null for what is not finite."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import isfinite
from typing import Any

from attrs import fields

from fasteroids.entities import Entity, Ship
from fasteroids.history.recording.events import action_name as action_name
from fasteroids.history.recording.events import event_record as event
from fasteroids.state import World

__all__ = ["action_name", "compact", "event", "indented", "world_record"]


def compact(record: Mapping[str, Any]) -> str:
    """One line of JSON."""
    return json.dumps(record, default=str, allow_nan=False)


def indented(record: Mapping[str, Any]) -> str:
    """JSON for people, with the end of its last line."""
    return json.dumps(record, default=str, allow_nan=False, indent=2) + "\n"


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
