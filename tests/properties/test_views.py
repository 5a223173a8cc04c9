"""The strategies of views give what they promise."""

from __future__ import annotations

from itertools import pairwise
from math import tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fasteroids.lang.values import Seen
from fasteroids.testing import DictView, histories, views
from fasteroids.units import FUEL, ModelError

ROCK = Seen(2, "asteroid", 1.0, 2.0, 3.0, 4.0, 5.0)


@given(views())
def test_a_view_shows_its_own_ship_and_every_entity_under_its_id(view: DictView) -> None:
    own = view.entity(view.self_id)
    assert own is not None
    assert own.kind == "ship"
    assert 0.0 <= view.direction < tau
    assert view.fuel == FUEL
    assert list(view.ids("any")) == sorted(view.entities)
    for kind in ("ship", "asteroid", "bullet"):
        assert view.ids(kind) == tuple(i for i in view.ids("any") if view.entities[i].kind == kind)
    assert view.entity(99) is None


@given(histories())
def test_in_a_history_nobody_comes_back_or_changes_kind(history: tuple[DictView, ...]) -> None:
    gone: set[int] = set()
    for before, after in pairwise(history):
        assert after.self_id == before.self_id
        assert after.entity(after.self_id) is not None
        gone |= set(before.entities) - set(after.entities)
        assert gone.isdisjoint(after.entities)
        for i in set(before.entities) & set(after.entities):
            assert after.entities[i].kind == before.entities[i].kind
    assert hash(history) == hash(tuple(history))


def test_histories_have_deaths_births_and_moves() -> None:
    met = {"deaths": 0, "births": 0, "moves": 0}

    @settings(max_examples=60, derandomize=True, database=None)
    @given(histories(ticks=2))
    def look(history: tuple[DictView, ...]) -> None:
        before, after = (view.entities for view in history)
        met["deaths"] += bool(set(before) - set(after))
        met["births"] += bool(set(after) - set(before))
        met["moves"] += any(after.get(i, e) != e for i, e in before.items())

    look()
    assert min(met.values()) >= 6, met


@given(st.integers(3, 9))
def test_an_entity_must_stand_under_its_id(key: int) -> None:
    with pytest.raises(ModelError, match=f"2 stands under {key}"):
        DictView({key: ROCK})
