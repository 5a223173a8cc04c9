"""Write the golden recordings: ``python tools/golden_recordings.py [FOLDER]``, by default tests/golden/recordings.

One game for each group of rules, small and full of what the group is about. The test suite verifies them: a change to
the engine, to the language or to a shipped rule that alters any of these games is found there. Write them anew only
when the rules are meant to change, and say so in the changelog.
"""

from __future__ import annotations

import sys
from pathlib import Path
from textwrap import dedent
from typing import NamedTuple

from fasteroids import (
    Asteroid,
    Fire,
    Ship,
    Thrust,
    ThrustOff,
    Turn,
    check_program,
    load_scene,
    parse_program,
)
from fasteroids.history import Act, Add, Input, Instruct, Remove
from fasteroids.history.living import answered, beginning, lived
from fasteroids.history.recording import Recorder, headed
from fasteroids.moments import clock_at
from fasteroids.state import World

FOLDER = Path(__file__).parents[1] / "tests" / "golden" / "recordings"


class Game(NamedTuple):
    """A scene, the seconds it runs for, the inputs at their times (s), and how often (s) it is cut beside those."""

    scene: str
    seconds: float
    inputs: tuple[tuple[float, Input], ...] = ()
    every: float = 0.0

    def world(self) -> World:
        """The first world."""
        return load_scene(dedent(self.scene))

    def times(self) -> list[float]:
        """When it is cut: at its inputs, regularly if it is, and at its end."""
        regular = (
            [k * self.every for k in range(1, int(self.seconds / self.every) + 1)]
            if self.every
            else []
        )
        return sorted({time for time, _ in self.inputs} | set(regular) | {self.seconds})


def instruct(ship: int, text: str) -> Instruct:
    """A ship gets a program."""
    program = check_program(parse_program(text)).program
    assert program is not None, text
    return Instruct(ship, program)


LATE = 123456789012 * 1024 + 1023.5
"""Seconds, at which doubles are 2^-6 s apart."""

GAMES: dict[str, Game] = {
    "bounces": Game(
        """
        [world]
        width = 400
        height = 300
        seed = 7
        model = "smooth"

        [[ship]]
        name = "slow"
        x = 200
        y = 200
        vx = 0
        vy = 60
        radius = 20
        mass = 9e15
        max_speed = 60

        [[ship]]
        name = "fast"
        x = 205
        y = 150
        vx = 5
        vy = 160
        radius = 25
        mass = 2e15
        max_speed = 180

        [[asteroid-field]]
        count = 12
        radius = [8, 30]
        speed = [40, 200]
        """,
        8.0,
    ),
    "walls-and-corners": Game(
        """
        [world]
        width = 200
        height = 200

        [[asteroid]]
        x = 100
        y = 100
        vx = 64
        vy = 64
        radius = 20

        [[ship]]
        x = 30
        y = 170
        vx = -90
        vy = 10
        radius = 10
        mass = 5e15

        [[asteroid]]
        x = 170
        y = 20
        vx = 0
        vy = -35
        radius = 15
        """,
        10.0,
    ),
    "deaths-and-splits": Game(
        """
        [world]
        width = 1000
        height = 400
        seed = 3
        model = "smooth"

        [[ship]]
        name = "gunner"
        x = 100
        y = 200
        radius = 15
        mass = 5e15
        direction = 0
        program-text = "while (true) { fire; skip; }"

        [[asteroid]]
        x = 500
        y = 200
        vx = -20
        vy = 3
        radius = 60

        [[asteroid]]
        x = 850
        y = 210
        vx = -60
        vy = 0
        radius = 35

        [[ship]]
        name = "victim"
        x = 900
        y = 330
        vx = -10
        vy = -30
        radius = 15
        mass = 5e15
        """,
        12.0,
    ),
    "bullets": Game(
        """
        [world]
        width = 600
        height = 400
        model = "smooth"

        [[ship]]
        name = "left"
        x = 60
        y = 200
        radius = 15
        mass = 5e15
        direction = 0.4
        program-text = "while (true) { fire; turn 0.37; }"

        [[ship]]
        name = "right"
        x = 540
        y = 330
        radius = 15
        mass = 5e15
        direction = 3.0

        [[ship]]
        name = "at the wall"
        x = 20.5
        y = 50
        radius = 20
        mass = 5e15
        direction = 3.0

        [[ship]]
        name = "before a rock"
        x = 300
        y = 60
        radius = 20
        mass = 5e15

        [[asteroid]]
        x = 365
        y = 60
        radius = 43
        """,
        6.0,
        (
            (0.02, Act(3, Fire())),
            (0.03, Act(4, Fire())),
            *((0.05 + 0.3 * k, Act(2, Fire())) for k in range(12)),
        ),
    ),
    "thrust-literal": Game(
        """
        [world]
        width = 800
        height = 600
        seed = 2

        [[ship]]
        x = 200
        y = 300
        vx = 10
        vy = 20
        radius = 20
        mass = 5e15
        direction = 1
        thruster = true
        program-text = "while (true) { turn 0.5; thrust; skip; thrust_off; turn 0.2; thrust; }"

        [[ship]]
        x = 600
        y = 300
        vx = -30
        vy = 4
        radius = 30
        mass = 8e15
        direction = 3
        max_speed = 90
        program-text = "while (true) { thrust; skip; skip; thrust_off; turn 2; }"

        [[asteroid]]
        x = 400
        y = 60
        vx = 50
        vy = -8
        radius = 40
        """,
        6.0,
        every=0.13,
    ),
    "thrust-smooth": Game(
        """
        [world]
        width = 800
        height = 600
        model = "smooth"

        [[ship]]
        x = 200
        y = 300
        vx = 10
        vy = 20
        radius = 20
        mass = 5e15
        direction = 1
        thruster = true
        max_speed = 150

        [[ship]]
        x = 600
        y = 200
        vx = -5
        vy = 40
        radius = 25
        mass = 4e15
        direction = 4
        thruster = true
        max_speed = 90

        [[ship]]
        x = 400
        y = 550
        radius = 20
        mass = 5e15
        direction = 0
        thruster = true

        [[ship]]
        x = 470
        y = 540
        radius = 20
        mass = 5e15
        direction = 3.1
        thruster = true

        [[ship]]
        x = 100
        y = 60
        radius = 20
        mass = 5e15
        direction = 0
        thruster = true

        [[ship]]
        x = 145
        y = 60
        radius = 25
        mass = 7e15
        direction = 3.14
        thruster = true
        """,
        6.0,
        (
            (0.03, Act(5, ThrustOff())),
            (0.03, Act(6, Turn(3.0))),
            (0.5, Act(1, Turn(1.2))),
            (1.0, Act(2, ThrustOff())),
            (1.5, Act(2, Turn(2.0))),
            (1.5, Act(2, Thrust())),
            (2.25, Act(1, Turn(-2.5))),
            (4.0, Act(1, ThrustOff())),
        ),
    ),
    "programs": Game(
        """
        [world]
        width = 1024
        height = 768
        seed = 11
        model = "smooth"

        [[ship]]
        name = "pilot"
        x = 512
        y = 384
        radius = 30
        mass = 5e15
        program-text = '''
        double a; double b; entity e; entity near; bool close;
        while (true) {
          near := null;
          foreach (asteroid, e) {
            a := (getx e - getx self) * (getx e - getx self) + (gety e - gety self) * (gety e - gety self);
            if (near == null || a < b) { near := e; b := a; }
          }
          close := near != null && b < 90000;
          print b;
          if (close) { turn 0.35; fire; } else { thrust; skip; thrust_off; }
        }
        '''

        [[asteroid-field]]
        count = 6
        radius = [15, 45]
        speed = [20, 90]
        clear = 60
        """,
        8.0,
    ),
    "programs-that-stop": Game(
        """
        [world]
        width = 900
        height = 300
        fuel = 100

        [[ship]]
        name = "null"
        x = 100
        y = 150
        radius = 20
        mass = 5e15
        program-text = "entity e; turn 1; print e; turn getx e;"

        [[ship]]
        name = "burner"
        x = 300
        y = 150
        radius = 20
        mass = 5e15
        program-text = "double i; while (i < 90) { i := i + 1; } print i; turn 1;"

        [[ship]]
        name = "ends"
        x = 500
        y = 150
        radius = 20
        mass = 5e15
        program-text = "print 1 / 0; print 0 / 0; fire; print getdir;"

        [[ship]]
        name = "angle"
        x = 700
        y = 150
        radius = 20
        mass = 5e15
        program-text = "turn 0.5; turn 1 / 0;"

        [[ship]]
        name = "reckoner"
        x = 820
        y = 60
        radius = 20
        mass = 5e15
        program-text = '''
        double i; bool b; entity e; entity f;
        print -7 % 3; print 7 % -3; print sqrt(2) - -1; print sqrt(-1); print -1 / 0;
        print !(1 < 2) || 2 <= 2 && 3 >= 4; print true || false; print false && true;
        foreach (ship, e) { f := e; print getradius e; }
        print f == e; print f != null; print f == self; print getvx self; print 1 != 1;
        while (true) {
          b := !(i < 0) && i >= 0 || -i > 5 && b;
          i := -(-i) + sqrt(i * i + 1) % 7 - 1 / 3;
          if (b || i > 50) { i := i * 0.5; } else { i := 1; }
        }
        '''
        """,
        3.0,
    ),
    "inputs": Game(
        """
        [world]
        width = 800
        height = 600
        model = "smooth"

        [[ship]]
        name = "player"
        x = 200
        y = 300
        radius = 20
        mass = 5e15
        """,
        6.0,
        (
            (0.3, Act(1, Turn(0.7))),
            (0.3, Act(1, Fire())),
            (0.8, Act(1, Thrust())),
            (1.0, Add(Asteroid(600, 500, -30, -40, 25))),
            (1.0, Add(Ship(700, 100, 0, 0, 20, 5e15, 2.0, name="second"))),
            (1.4, Act(1, ThrustOff())),
            (2.0, instruct(4, "while (true) { turn 0.4; fire; }")),
            (3.0, Remove(3)),
            (3.6, instruct(4, "thrust; skip; thrust_off;")),
        ),
    ),
    "late": Game(
        """
        [world]
        width = 500
        height = 400
        model = "smooth"
        time = [123456789012, 1023.5]

        [[ship]]
        x = 100
        y = 200
        vx = 130
        vy = 70
        radius = 20
        mass = 5e15
        program-text = "while (true) { turn 0.1; fire; }"

        [[asteroid-field]]
        count = 4
        radius = [10, 30]
        speed = [80, 200]
        clear = 30
        """,
        LATE + 8.0,
    ),
}
"""The games by the group of rules they are about."""


def recorded(name: str) -> str:
    """The text of a golden recording."""
    game = GAMES[name]
    world = game.world()
    pieces: list[str] = []
    slice = game.every or None
    header = headed(world, title=name, slice=slice, every_snapshot=2.5)
    recorder = Recorder(pieces.append, world, header)
    last = beginning(world)
    for time in game.times():
        for state in lived(last, clock_at(time)):
            last = state
            recorder.add(state)
        for at, what in game.inputs:
            if at == time:
                last = answered(last, what)
                recorder.add(last)
    recorder.finish(last.world.clock)
    return "".join(pieces)


def main(folder: Path = FOLDER) -> None:
    """Write them all."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in GAMES:
        (folder / (name + ".jsonl")).write_text(recorded(name), encoding="ascii")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
