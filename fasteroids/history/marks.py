"""What a state is about, in a few bits: so that a search passes over what cannot hold what it looks for."""

from __future__ import annotations

from functools import reduce
from typing import Final, Literal, NamedTuple, TypeAlias, get_args

from fasteroids.actions import Fire
from fasteroids.events import Happened
from fasteroids.history.inputs import Act, Add, Instruct, Remove
from fasteroids.history.living import Lived, Told
from fasteroids.units import ModelError, shown

__all__ = [
    "NOTHING",
    "Kind",
    "Marks",
    "about",
    "is_of",
    "joined",
    "kinds_of",
    "marked",
    "wanted",
    "who",
]

Kind: TypeAlias = Literal[
    "event", "contact", "wall", "limit", "tick", "input", "cut", "death", "birth", "shot", "print"
]
"""What a search can ask for. An `event` is any of contact, wall, limit and tick. A `shot` is a bullet fired, by a
program or an input, also one that dies as it is fired."""

_BITS: Final[dict[str, int]] = {kind: 1 << i for i, kind in enumerate(get_args(Kind))}
_MOST: Final = 1024  # ids that differ by this share a bit: a search then looks where nothing is
_NOBODY: Final = 1 << _MOST  # of a cut, which is about no entity: found only where none is given


class Marks(NamedTuple):
    """Bits of the kinds, and bits of the ids."""

    kinds: int
    who: int

    def may_hold(self, wanted: Marks) -> bool:
        """Can there be something among it that has any of the wanted kinds and any of the wanted ids?"""
        return bool(self.kinds & wanted.kinds and self.who & wanted.who)


NOTHING: Final = Marks(0, 0)


def joined(a: Marks, b: Marks) -> Marks:
    """The marks of both."""
    return Marks(a.kinds | b.kinds, a.who | b.who)


def wanted(kind: Kind, entity: int | None = None) -> Marks:
    """The marks of what is looked for: of a kind, and about an entity if one is given.

    `ModelError` if there is no such kind, or the entity is no id.
    """
    if kind not in _BITS:
        raise ModelError(f"a kind is one of {', '.join(_BITS)}; got {shown(kind)}")
    if entity is not None and type(entity) is not int:
        raise ModelError(f"an entity is meant by its id, an integer; got {shown(entity)}")
    return Marks(_BITS[kind], -1 if entity is None else _bit(entity))


def about(entity: int) -> Marks:
    """The marks of whatever is about an entity."""
    return Marks(-1, _bit(entity))


def is_of(state: Lived, kind: Kind, entity: int | None = None) -> bool:
    """Is what led to a state of this kind, and about this entity if one is given?"""
    return kind in kinds_of(state) and (entity is None or entity in who(state))


def marked(state: Lived) -> Marks:
    """The marks of what led to a state."""
    ids = reduce(lambda bits, i: bits | _bit(i), who(state), 0)
    return Marks(sum(_BITS[kind] for kind in kinds_of(state)), ids or _NOBODY)


def _bit(entity: int) -> int:
    return 1 << entity % _MOST


def kinds_of(state: Lived) -> set[Kind]:
    """The kinds of what led to a state: none where a past begins."""
    what = state.what
    kinds: set[Kind] = set()
    if isinstance(what, Happened):
        kinds = {"event", what.kind}  # type: ignore[arg-type]  # one of the four
        if what.prints:
            kinds.add("print")
    elif isinstance(what, Told):
        kinds = {"input"}
    elif what is not None:
        return {"cut"}
    if state.died and not (isinstance(what, Told) and isinstance(what.what, Remove)):
        kinds.add("death")  # to be taken out is none
    if state.born:
        kinds.add("birth")
        if _fires(what):
            kinds.add("shot")
    return kinds


def _fires(what: object) -> bool:
    if isinstance(what, Told):
        return isinstance(what.what, Act) and isinstance(what.what.action, Fire)
    return isinstance(what, Happened) and what.effect == "fire"


def who(state: Lived) -> tuple[int, ...]:
    """The ids of those that what led to a state is about."""
    what = state.what
    if isinstance(what, Happened):
        return (*what.entities, *what.died, *what.born, *what.clipped)
    if not isinstance(what, Told):
        return ()
    ids = (*what.died, *what.born)
    match what.what:
        case Act(ship) | Instruct(ship):
            return (ship, *ids)
        case Add() | Remove():
            return ids
    return ids
