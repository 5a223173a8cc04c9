"""Views of no world at all: a program's machine can be tested with a dictionary.

`histories` gives what one ship sees at a few ticks: entities move, die and are born, ids are never used again.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import tau
from typing import Literal

from attrs import evolve, field, frozen
from hypothesis import strategies as st
from pyrsistent import PMap, pmap

from fasteroids.lang.machine.values import Seen
from fasteroids.units import FUEL, ModelError

__all__ = ["DictView", "histories", "views"]


def _by_id(entities: Mapping[int, Seen]) -> PMap[int, Seen]:
    for key, seen in entities.items():
        if key != seen.id:
            raise ModelError(f"an entity must stand under its id; {seen.id} stands under {key}")
    return pmap(entities)


@frozen
class DictView:
    """A `fasteroids.actions.View` of a dictionary from id to `Seen`."""

    entities: Mapping[int, Seen] = field(converter=_by_id)
    self_id: int = 1
    direction: float = 0.0
    fuel: int = field(default=FUEL, kw_only=True)

    def ids(self, kind: Literal["ship", "asteroid", "bullet", "any"]) -> tuple[int, ...]:
        """The ids of all entities of a kind, ascending."""
        return tuple(i for i in sorted(self.entities) if kind in ("any", self.entities[i].kind))

    def entity(self, entity_id: int) -> Seen | None:
        """An entity, or None if there is none of this id."""
        return self.entities.get(entity_id)


_lengths = st.one_of(
    st.integers(-16, 16).map(lambda n: n / 4),
    st.floats(-1000.0, 1000.0),
    st.floats(allow_nan=False, allow_infinity=False),
)
_radii = st.one_of(st.integers(1, 40).map(lambda n: n / 4), st.floats(1e-300, 1e300))
_directions = st.one_of(st.integers(0, 7).map(lambda n: n * tau / 8), st.floats(0.0, 6.28))
_kinds: st.SearchStrategy[Literal["ship", "asteroid", "bullet"]] = st.sampled_from(
    ["asteroid", "ship", "bullet"]
)


def _seen(
    entity_id: int, kind: st.SearchStrategy[Literal["ship", "asteroid", "bullet"]]
) -> st.SearchStrategy[Seen]:
    state = (_lengths, _lengths, _lengths, _lengths, _radii)
    return st.builds(Seen, st.just(entity_id), kind, *state)


@st.composite
def views(draw: st.DrawFn, *, max_size: int = 6) -> DictView:
    """What a ship sees: itself, under any of the ids, and up to `max_size - 1` others."""
    ids = draw(st.lists(st.integers(1, 12), unique=True, min_size=1, max_size=max_size))
    mine, *others = ids
    seen = [draw(_seen(mine, st.just("ship"))), *(draw(_seen(i, _kinds)) for i in others)]
    return DictView({s.id: s for s in seen}, mine, draw(_directions))


@st.composite
def histories(draw: st.DrawFn, *, ticks: int = 4) -> tuple[DictView, ...]:
    """What a ship sees at `ticks` ticks. It lives through all of them; others move, die and are born in between."""
    view = draw(views())
    result, next_id = [view], max(view.entities) + 1
    for _ in range(ticks - 1):
        seen = []
        for old in sorted(view.entities.values(), key=lambda s: s.id):
            fate = draw(st.sampled_from(["moves", "stays", "dies"]))
            if fate == "moves":
                seen.append(evolve(old, x=draw(_lengths), y=draw(_lengths), vx=draw(_lengths)))
            elif fate == "stays" or old.id == view.self_id:
                seen.append(old)
        if draw(st.booleans()):
            seen.append(draw(_seen(next_id, _kinds)))
            next_id += 1
        view = DictView({s.id: s for s in seen}, view.self_id, draw(_directions))
        result.append(view)
    return tuple(result)
