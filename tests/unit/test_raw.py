"""Records made without ceremony are the records."""

from __future__ import annotations

import copy
import pickle

import pytest
from attrs import field, frozen
from attrs.exceptions import FrozenInstanceError

from fasteroids import Asteroid, Ship
from fasteroids._raw import raw
from fasteroids.state import Flight


@frozen(weakref_slot=False)
class Point:
    x: float = field(converter=float)
    y: float = field(default=0.0, kw_only=True)


@frozen
class Referable:
    x: float


point = raw(Point)


def test_a_raw_record_is_a_record() -> None:
    made = point(1.0, 2.0)
    assert type(made) is Point
    assert made == Point(1.0, y=2.0)
    assert hash(made) == hash(Point(1.0, y=2.0))
    assert repr(made) == repr(Point(1.0, y=2.0))
    assert isinstance(made, Point)


def test_a_raw_record_is_as_frozen_as_any() -> None:
    made = point(1.0, 2.0)
    with pytest.raises(FrozenInstanceError):
        made.x = 3.0  # type: ignore[misc]
    with pytest.raises(AttributeError):
        made.z = 3.0  # type: ignore[attr-defined]


def test_a_raw_record_is_neither_converted_nor_checked() -> None:
    assert point("anything", None).x == "anything"  # type: ignore[comparison-overlap]


@pytest.mark.parametrize("given", [(), (1.0,), (1.0, 2.0, 3.0)])
def test_a_raw_record_takes_every_field(given: tuple[float, ...]) -> None:
    with pytest.raises(TypeError):
        point(*given)


def test_copies_of_a_raw_record_are_records() -> None:
    made = point(1.0, 2.0)
    for again in (copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made))):
        assert type(again) is Point
        assert again == made


def test_a_record_with_weak_references_is_refused() -> None:
    with pytest.raises(AssertionError, match="not a plain slotted record"):
        raw(Referable)


def test_the_records_of_the_engine_can_be_made_raw() -> None:
    disc = raw(Asteroid)(1.0, 2.0, 3.0, 4.0, 5.0, None, 6.0, 7)
    assert disc == Asteroid(1, 2, 3, 4, 5, max_speed=6, id=7)
    flight = raw(Flight)((0, 1.0), disc, 0, None, None)
    assert flight == Flight((0, 1.0), disc)
    assert raw(Ship) is not raw(Ship)
