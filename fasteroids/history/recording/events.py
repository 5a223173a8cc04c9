"""Events as records for JSON, and as the lines of a recording, which are made much faster by hand."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import inf, isfinite
from typing import Any, Final

from fasteroids.actions import Action, Fire, Skip, Thrust, ThrustOff, Turn
from fasteroids.events import Happened
from fasteroids.history.inputs import Place
from fasteroids.lang import Span
from fasteroids.moments import Moment, moment_at, seconds
from fasteroids.units import WINDOW

__all__ = ["ACTIONS", "action_name", "event_line", "event_record", "line", "print_line", "when"]

ACTIONS: Final[Mapping[type[Action], str]] = {
    Turn: "turn",
    Fire: "fire",
    Thrust: "thrust",
    ThrustOff: "thrust_off",
    Skip: "skip",
}
"""The words of the language for actions."""


def action_name(action: Action) -> str:
    """The word of the language for an action."""
    return ACTIONS[type(action)]


def event_record(happened: Happened) -> dict[str, Any]:
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
        record["at"] = [z if isfinite(z) else None for z in happened.at]
    return record


_quoted = json.encoder.encode_basestring_ascii
_encode = json.JSONEncoder(allow_nan=False, check_circular=False, separators=(",", ":")).encode


def line(record: Mapping[str, Any]) -> str:
    """A record as a line of a recording, without its end: ASCII, floats in the fewest digits that bring them back."""
    return _encode(record)


def when(moment: Moment) -> dict[str, Any]:
    """The fields that tell a moment: its seconds, and its two parts where those do not give it exactly."""
    time = seconds(*moment)
    return {"time": time} if moment_at(time) == moment else {"time": time, "moment": list(moment)}


def event_line(happened: Happened, place: Place) -> str:
    """The line of an event, from the place after it, but for its prints, which have lines of their own.

    It is `line` of `event_record` with the type and the moment (a test compares them), at a fifth of the price.
    """
    window, offset, _ = place
    time, entities, at = happened.time, happened.entities, happened.at
    exact = more = ""
    if window and (
        time - window * WINDOW != offset if window < 2**43 else moment_at(time) != place.moment
    ):
        exact = f',"moment":[{window},{offset!r}]'
    if happened.died or happened.born or happened.clipped or happened.span is not None:
        more = _more(happened)
    if len(entities) == 2:
        a, b = entities
        who, kind = f"{a},{b}", "contact"
    else:
        if happened.wall is not None:
            more = f',"wall":"{happened.wall}"{more}'
        who, kind = entities[0], happened.kind  # type: ignore[assignment]
    told = (
        f'{{"type":"event","time":{time!r}{exact},"kind":"{kind}","entities":[{who}],'
        f'"effect":"{happened.effect}"{more}'
    )
    if at is None:
        return told + "}"
    x, y = at
    if -inf < x < inf and -inf < y < inf:
        return f'{told},"at":[{x!r},{y!r}]}}'
    return f'{told},"at":{json.dumps(event_record(happened)["at"], separators=(",", ":"))}}}'


def print_line(text: str, ship: int, moment: Moment) -> str:
    """The line of what a ship's program printed."""
    time = seconds(*moment)
    exact = (
        ""
        if not moment[0] or moment_at(time) == moment
        else f',"moment":[{moment[0]},{moment[1]!r}]'
    )
    return f'{{"type":"print","time":{time!r}{exact},"ship":{ship},"text":{_quoted(text)}}}'


def _more(happened: Happened) -> str:
    """The fields that few events have."""
    told = ""
    if happened.died:
        told += f',"died":[{",".join(map(str, happened.died))}]'
    if happened.born:
        told += f',"born":[{",".join(map(str, happened.born))}]'
    if happened.clipped:
        told += f',"clipped":[{",".join(map(str, happened.clipped))}]'
    span = happened.span
    if span is not None:
        told += f',"span":{{"line":{span[0]},"column":{span[1]},"end_line":{span[2]},"end_column":{span[3]}}}'
    if happened.reason is not None:
        told += f',"reason":{_quoted(happened.reason)}'
    return told
