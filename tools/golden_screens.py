"""Write the golden screens: ``python tools/golden_screens.py`` fills tests/golden/screens.

Each file is the whole screen of a game at a fixed moment of a fixed world, as the picture that the screenshot key saves
(SVG), without the ids that Rich makes up. `tests/unit/tui/test_golden_screens.py` says which of them are not current.
Look at what changed before you keep it: a browser shows them.
"""

from __future__ import annotations

import asyncio
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

from fasteroids import Asteroid, Ship, World, load_scene
from fasteroids.cli._arcade import Shelf
from fasteroids.tui._store import Store
from fasteroids.tui.app import Arcade
from fasteroids.tui.arena import Arena
from fasteroids.tui.game import Game, Player, new_game, ruled
from fasteroids.tui.keys import Command
from fasteroids.tui.launching import Launched, NewGame, SceneGame
from fasteroids.tui.options import Notices, Options
from fasteroids.tui.picture import View
from fasteroids.tui.play import Play
from fasteroids.tui.session import Session, opened
from fasteroids.tui.visiting import visited

FOLDER = Path(__file__).resolve().parents[1] / "tests" / "golden" / "screens"

_ID = re.compile(r"terminal-\d+")

GUNS = """
[world]
width = 400
height = 200
seed = 4
[[ship]]
name = "west"
x = 60
y = 100
radius = 10
mass = 5e15
program-text = '''
double n;
while (true) {
  n := n + 1;
  print n;
  if (n < 6) { fire; } else { turn 0.3; }
  skip;
}
'''
[[ship]]
name = "east"
x = 340
y = 100
radius = 10
mass = 5e15
"""


def wave() -> Session:
    """The first wave of a game, at its beginning."""
    game, world = new_game("waves", seed=7, names=["you"], programs=[None])
    return opened(world, game)


def stepped() -> Session:
    """A program that has flown for 3 s."""
    world = load_scene(GUNS)
    return visited(opened(world, ruled(world, 0)), 3.0, "west")


def doomed() -> Session:
    """The last ship of a game, right before an asteroid hits it."""
    world = World(400, 300, 9, "smooth").add_all(
        [Ship(200, 150, 0, 0, 20, 5e15, 0.0, name="you"), Asteroid(290, 150, -100, 30, 20)]
    )
    return opened(world, Game("waves", (Player("you", 1, True, lives=1, points=500),), wave=3))


Story = tuple[Launched, View, tuple[int, int], float, tuple[Command, ...]]


def stories() -> Iterator[tuple[str, Story]]:
    """The name of each picture: what is played, how it is seen, for how long, and what is asked then."""
    c = Command
    yield (
        "wave",
        (
            Launched(NewGame("waves", (None,), 7), "waves: you", wave()),
            View("braille", overlay=True),
            (80, 24),
            3.0,
            (c.PAUSE,),
        ),
    )
    yield (
        "program",
        (
            Launched(SceneGame("guns", 0), "guns", stepped()),
            View("ascii"),
            (120, 36),
            0.0,
            (c.PROGRAM_BACK, c.PROGRAM_BACK, c.BREAKPOINT),
        ),
    )
    yield (
        "why",
        (
            Launched(NewGame("waves", (None,), 9), "waves: you", doomed()),
            View("block"),
            (110, 30),
            0.8,
            (c.PAUSE, c.WHY),
        ),
    )


async def _taken(story: Story, home: Path) -> str:
    begun, view, size, seconds, commands = story
    notices = Notices()
    store = Store(notices, folder=home, config=home / "config.toml")
    options = Options(view=view, timer=False)
    app = Arcade(Shelf(), store, options, first=begun, notices=notices)
    async with app.run_test(size=size) as pilot:
        await pilot.pause()
        play = app.screen
        assert isinstance(play, Play)
        for _ in range(round(seconds * 10)):
            play.go_on(0.1)
        for command in commands:
            play.command(command)
        for _ in range(3):
            await pilot.pause()
        with play.query_one(Arena).posing():
            return _ID.sub("terminal", app.export_screenshot())


def screens() -> dict[str, str]:
    """The content of each file, by name."""
    with tempfile.TemporaryDirectory() as home:
        return {
            "%s.svg" % name: asyncio.run(_taken(story, Path(home))) for name, story in stories()
        }


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in screens().items():
        (FOLDER / name).write_text(text, "utf-8")
