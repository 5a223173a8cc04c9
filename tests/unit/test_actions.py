"""What a ship can be told, and the protocols of a program and its view."""

from __future__ import annotations

from typing import Any

import pytest
from attrs import frozen

from fasteroids import Asteroid, Bullet, Fire, Ship, Skip, Thrust, ThrustOff, Turn, World
from fasteroids.actions import Program, Ticked
from fasteroids.rules import ShipView


@frozen
class Idle:
    """The smallest program there is."""

    @property
    def running(self) -> bool:
        return True

    def tick(self, _view: Any) -> Ticked:
        return Ticked(self)


def test_actions_are_values() -> None:
    assert Turn(0.5) == Turn(0.5) != Turn(0.25)
    assert Fire() == Fire() != Skip()  # type: ignore[comparison-overlap]
    assert len({Turn(1.0), Turn(1.0), Fire(), Fire(), Thrust(), ThrustOff(), Skip()}) == 5


@pytest.mark.parametrize("action", [Turn(1.0), Fire(), Thrust(), ThrustOff(), Skip()])
def test_actions_are_frozen(action: Any) -> None:
    with pytest.raises(AttributeError):
        action.angle = 2.0


def test_a_program_is_whatever_keeps_the_protocol() -> None:
    assert isinstance(Idle(), Program)
    assert not isinstance("skip;", Program)
    assert not isinstance(object(), Program)


def test_ticked_says_nothing_by_default() -> None:
    ticked = Ticked(Idle())
    assert ticked == (Idle(), None, None, (), None, None)


def test_a_view_shows_the_world_from_the_ship_that_looks() -> None:
    world = World(1000, 1000).add_all(
        [
            Asteroid(100, 100, 10, 0, 20),
            Ship(500, 500, 0, 0, 10, 1e15, 1.5),
            Bullet(700, 700, 0, 0, 3, 2),
            Ship(300, 800, 0, 0, 10, 1e15, 0),
        ]
    )
    view = ShipView(world, world.ships[0])
    assert (view.self_id, view.direction) == (2, 1.5)
    assert view.ids("any") == (1, 2, 3, 4)
    assert (view.ids("ship"), view.ids("asteroid"), view.ids("bullet")) == ((2, 4), (1,), (3,))
    assert view.entity(1) == world[1]
    assert view.entity(99) is None


def test_a_view_is_read_only() -> None:
    world = World(100, 100).add(Ship(50, 50, 0, 0, 10, 1e15, 0))
    view = ShipView(world, world.ships[0])
    with pytest.raises(AttributeError):
        view.direction = 1.0  # type: ignore[misc]
    with pytest.raises(AttributeError):
        view.entity(1).x = 1.0  # type: ignore[misc, union-attr]
