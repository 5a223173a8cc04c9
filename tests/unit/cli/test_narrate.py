"""Events in words."""

from __future__ import annotations

from math import pi

import pytest

from fasteroids import Asteroid, Bullet, Happened, Ship, World, happenings
from fasteroids.cli._narrate import Narrator, census, counted, label, listed, number
from fasteroids.lang import Span


def space() -> World:
    return World(1000.0, 1000.0).add_all(
        (
            Ship(100.0, 100.0, 0.0, 0.0, 10.0, 5e15, 0.0, name="red"),
            Ship(300.0, 100.0, 0.0, 0.0, 10.0, 5e15, 0.0),
            Asteroid(500.0, 500.0, 0.0, 0.0, 40.0),
            Asteroid(700.0, 500.0, 0.0, 0.0, 20.0, name="Ceres"),
            Bullet(900.0, 500.0, 0.0, 0.0, 3.0, 1),
        )
    )


def told(happened: Happened, after: World | None = None, span: float = 20.0) -> str:
    line = Narrator(space(), span).line(happened, after or space())
    assert line is not None
    time, _, rest = line.partition("  ")
    assert float(time) == pytest.approx(happened.time)
    return rest


@pytest.mark.parametrize(
    ("happened", "line"),
    [
        (
            Happened(1.0, "contact", (1, 2), at=(512.0, 300.123456)),
            "red and ship #2 bounce at (512, 300.123)",
        ),
        (
            Happened(1.0, "contact", (1, 2), clipped=(1,)),
            "red and ship #2 bounce; red clipped to the speed limit",
        ),
        (
            Happened(1.0, "contact", (1, 4), effect="die", died=(1,), at=(1.0, 2.0)),
            "red and Ceres collide at (1, 2): red dies",
        ),
        (
            Happened(1.0, "contact", (4, 5), effect="die", died=(4, 5), at=(1.0, 2.0)),
            "Ceres and bullet #5 collide at (1, 2): Ceres dies, bullet #5 dies",
        ),
        (
            Happened(1.0, "contact", (3, 5), effect="split", died=(3, 5), born=(6, 7)),
            "asteroid #3 and bullet #5 collide: asteroid #3 splits into #6 and #7, bullet #5 dies",
        ),
        (Happened(1.0, "wall", (1,), wall="left"), "red bounces off the left wall"),
        (
            Happened(1.0, "wall", (5,), wall="top", effect="die", died=(5,)),
            "bullet #5 dies at the top wall",
        ),
        (Happened(1.0, "limit", (1,)), "red reaches its speed limit"),
        (Happened(1.0, "tick", (1,), effect="turn"), "red turns"),
        (Happened(1.0, "limit", (1,), effect="reach"), "red reaches its speed limit"),
        (
            Happened(1.0, "limit", (1,), effect="leave"),
            "red leaves its speed limit: its thrust slows it",
        ),
        (Happened(1.0, "tick", (1,), effect="thrust"), "red switches its thruster on"),
        (Happened(1.0, "tick", (1,), effect="thrust_off"), "red switches its thruster off"),
        (Happened(1.0, "tick", (1,), effect="skip"), "red skips"),
        (Happened(1.0, "tick", (1,), effect="end"), "red comes to the end of its program"),
        (
            Happened(1.0, "tick", (1,), effect="fuel"),
            "red has no fuel left; it goes on at its next tick",
        ),
        (
            Happened(1.0, "tick", (1,), effect="fuel", span=Span(7, 3, 7, 9)),
            "red has no fuel left on line 7; it goes on at its next tick",
        ),
        (
            Happened(1.0, "tick", (1,), effect="halt", reason="getx null", span=Span(7, 3, 7, 9)),
            "red stops its program on line 7: getx null",
        ),
        (
            Happened(1.0, "tick", (1,), effect="halt", reason="getx of null"),
            "red stops its program: getx of null",
        ),
        (Happened(1.0, "tick", (1,), effect="fire"), "red fires in vain"),
        (Happened(1.0, "tick", (1,), effect="fire", born=(6,)), "red fires bullet #6"),
        (
            Happened(1.0, "tick", (1,), effect="fire", died=(3, 6), born=(6, 7, 8)),
            "red fires into what is there: asteroid #3 splits into #7 and #8, bullet #6 dies",
        ),
        (
            Happened(1.0, "tick", (1,), effect="skip", prints=("hello", "a\x1b[31m")),
            "red: hello\n1.000  red: 'a\\x1b[31m'\n1.000  red skips",
        ),
    ],
)
def test_line(happened: Happened, line: str) -> None:
    assert told(happened) == line


def test_what_is_born_has_a_name_from_then_on() -> None:
    narrator, after = Narrator(space(), 20.0), space().add(Asteroid(50.0, 900.0, 0, 0, 30.0))
    narrator.line(Happened(1.0, "contact", (3,), effect="split", born=(6,)), after)
    assert narrator.name(6) == "asteroid #6"


def test_no_event_no_line() -> None:
    assert Narrator(space(), 20.0).line(None, space()) is None


@pytest.mark.parametrize(
    ("span", "start"),
    [(20.0, "1.235  "), (1e-9, "1.23456789  "), (1e12, "1.23456789  "), (0.0, "1.23456789  ")],
)
def test_digits_of_the_time_fit_the_run(span: float, start: str) -> None:
    line = Narrator(space(), span).line(Happened(1.23456789, "limit", (1,)), space())
    assert line is not None
    assert line.startswith(start)


def test_words() -> None:
    assert listed(["a"]) == "a"
    assert listed(["a", "b"]) == "a and b"
    assert listed(["a", "b", "c"]) == "a, b and c"
    assert counted(1, "wall") == "1 wall"
    assert counted(1234, "wall") == "1,234 walls"
    assert number(1024.0) == "1024"
    assert label(space()[1]) == "red"
    assert label(space()[5]) == "bullet #5"
    assert census(space()) == "2 ships, 2 asteroids and 1 bullet"
    assert census(World(1.0, 1.0)) == "nothing"


def test_two_that_press_are_told_of_once_until_something_else_happens() -> None:
    left = Ship(480, 500, 0, 0, 20, 5e15, 0.0, thruster=True, name="red")
    right = Ship(520, 500, 0, 0, 20, 5e15, pi, thruster=True, name="blue")
    world = World(1000, 1000, model="smooth").add_all([left, right])
    narrator = Narrator(world, 1.0)
    told = [narrator.line(*step) for step in happenings(world, 0.1, max_events=50)]
    assert told[0] == "0.000  red and blue press on each other at (500, 500)"
    assert not any(told[1:])
    wall = Happened(1.0, "wall", (1,), wall="left")
    assert narrator.line(wall, world) == "1.000  red bounces off the left wall"
    again = next(happenings(world, 0.1))
    assert narrator.line(*again) == told[0]
