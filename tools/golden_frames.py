"""Write the golden frames: ``python tools/golden_frames.py`` fills tests/golden/frames.

Each file is one picture of a fixed world at a fixed time: the text of `fasteroids.tui.camera.frame`, then the runs of
colours row by row. `tests/unit/tui/test_golden_frames.py` says which of them are not current. Look at what changed
before you keep it: the text is meant to be read.
"""

from __future__ import annotations

from importlib.resources import files
from math import tau
from pathlib import Path
from typing import Iterator

from fasteroids import Asteroid, Fire, Ship, Thrust, Turn, World, act, evolve, load_scene
from fasteroids.tui.camera import Death, Look, frame
from fasteroids.tui.canvas import SURFACES
from fasteroids.tui.overlay import overlay
from fasteroids.tui.palette import COLOURS

FOLDER = Path(__file__).resolve().parents[1] / "tests" / "golden" / "frames"

SIZE = (80, 24)


def scene(name: str) -> World:
    """A shipped scene."""
    return load_scene((files("fasteroids.scenes") / (name + ".toml")).read_text("utf-8"))


def compass() -> World:
    """Ships that face eight ways, small and large, the thrusters of the small ones on."""
    world = World(1000.0, 700.0)
    for i in range(16):
        place = 110.0 + (i % 8) * 110.0, 550.0 if i < 8 else 250.0
        direction, small = i % 8 * tau / 8.0, i < 8
        radius = 18.0 if small else 42.0
        world = world.add(Ship(*place, 0.0, 0.0, radius, 5e15, direction, thruster=small))
    return world


def sizes() -> World:
    """Asteroids from a dot to a fifth of the world."""
    world, x = World(1400.0, 700.0), 20.0
    for i, radius in enumerate((2.0, 6.0, 12.0, 20.0, 30.0, 45.0, 65.0, 95.0, 140.0)):
        x += radius
        world = world.add(Asteroid(x, 350.0 + 20.0 * (-1) ** i, 0.0, 0.0, radius))
        x += radius + 25.0
    return world


def battle() -> tuple[World, dict[str, object]]:
    """Everything at once: a thrusting and a firing ship, a death, a trail, ghosts, a look ahead, a selection."""
    start = evolve(scene("default"), 2.0)
    start = act(act(act(start, 1, Thrust()), 2, Turn(0.8)), 2, Fire())
    world = evolve(start, 0.4)
    bullet = world.bullets[-1]
    return world, {
        "selected": 1,
        "players": (1, 2),
        "overlay": overlay(world, [1, 2]),
        "ghosts": evolve(start, 0.9),
        "deaths": (Death(700.0, 600.0, 40.0, 0.3),),
        "trails": ((start.ships[1].position, bullet.position),),
    }


def looks() -> Iterator[tuple[str, World, dict[str, object]]]:
    """The name of each picture, what it shows and how."""
    duel = evolve(scene("duel"), 3.0)
    yield ("default", evolve(scene("default"), 1.0), {})
    yield ("storm", evolve(scene("field-storm"), 4.0), {})
    yield ("compass", compass(), {})
    yield ("sizes", sizes(), {})
    yield ("battle", *battle())
    yield ("close", duel, {"selected": 2, "zoom": 4})


def frames() -> dict[str, str]:
    """The content of each file, by name."""
    texts = {}
    for name, world, given in looks():
        for arena in SURFACES:
            picture = frame(world, Look(arena=arena, **given), *SIZE)  # type: ignore[arg-type]
            runs = [
                "%d: %s"
                % (y, ", ".join("%d-%d %s" % (a, b, COLOURS[c].name) for a, b, c in row.runs))
                for y, row in enumerate(picture.rows)
                if row.runs
            ]
            texts["%s.%s.txt" % (name, arena)] = "%s\n%s\n" % (picture, "\n".join(runs))
    return texts


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in frames().items():
        (FOLDER / name).write_text(text, "utf-8")
