"""The app in tests: with no clock of its own, its files in a folder of the test, and its screen as text."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from pathlib import Path
from typing import Any

from attrs import evolve
from textual.pilot import Pilot
from textual.widgets import Input

from fasteroids.actions import Program
from fasteroids.lang import check_program, parse_program
from fasteroids.scene import load_scene
from fasteroids.state import World
from fasteroids.tui._store import Store
from fasteroids.tui.app import Arcade
from fasteroids.tui.launching import Launched, NewGame, Recorded, SceneGame, Wanted, launched
from fasteroids.tui.lists import Choices
from fasteroids.tui.menu import put
from fasteroids.tui.options import Notices, Options
from fasteroids.tui.panels import Rows
from fasteroids.tui.play import Play
from fasteroids.units import ModelError

__all__ = [
    "Library",
    "Scenario",
    "arcade",
    "chosen",
    "flown",
    "live",
    "run",
    "settled",
    "text",
    "typed",
]

Scenario = Callable[[Arcade, Pilot[int]], Awaitable[None]]

SHOOTER = "while (true) { fire; skip; }"
SITTER = "while (true) { skip; }"

DUEL = """
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
[[ship]]
name = "east"
x = 340
y = 100
radius = 10
mass = 5e15
program-text = "while (true) { skip; }"
"""

REPORT = "bad.ast has an error\nbad.ast:1:1 error FA101\n  1 | x := 1;"


class Library:
    """Two programs and one scene, and a program with an error."""

    def programs(self) -> Mapping[str, str]:
        return {"shooter": "Fires.", "sitter": "Sits."}

    def scenes(self) -> Mapping[str, str]:
        return {"pair": "Two ships."}

    def program(self, name: str) -> Program:
        if name.endswith("bad.ast"):
            raise ModelError(REPORT)
        source = {"shooter": SHOOTER, "sitter": SITTER}.get(name)
        if source is None:
            raise ModelError(f"there is no bot {name!r}")
        machine = check_program(parse_program(source)).program
        assert machine is not None
        return machine

    def scene(self, name: str, seed: int | None, model: str | None) -> tuple[str, World]:
        if name != "pair":
            raise ModelError(f"there is no scene {name!r}")
        return name, load_scene(DUEL, seed=seed, model=model)


def arcade(home: Path, *, wanted: Wanted | Launched | None = None, **options: Any) -> Arcade:
    """The app in ASCII, its files in a folder."""
    notices = Notices()
    store = Store(notices, folder=home, config=home / "config.toml")
    chosen = Options(folder=home, settings=store.settings(), timer=False)
    first = launched(wanted, Library()) if isinstance(wanted, NewGame | SceneGame) else wanted
    assert not isinstance(first, Recorded)
    return Arcade(Library(), store, evolve(chosen, **options), first=first, notices=notices)


def run(app: Arcade, scenario: Scenario, *, size: tuple[int, int] = (80, 24)) -> Arcade:
    """Run a scenario in an app of this size; the app afterwards."""

    async def whole() -> None:
        async with app.run_test(size=size, notifications=True) as pilot:
            await settled(pilot)
            await scenario(app, pilot)

    asyncio.run(whole())
    return app


async def settled(pilot: Pilot[int]) -> None:
    """Everything that was asked for is done: screens come and go in several steps."""
    for _ in range(3):
        await pilot.pause()


async def typed(pilot: Pilot[int], *keys: str) -> None:
    """Press keys, and let them have their effect."""
    await pilot.press(*keys)
    await settled(pilot)


async def chosen(app: Arcade, pilot: Pilot[int], label: str) -> None:
    """Choose the entry of this label in the menu that is shown: go near it at once, then with an arrow and Enter."""
    choices = app.screen.query_one(Choices)
    [at] = [i for i, entry in enumerate(choices.menu.entries) if entry.label == label]
    choices.menu = put(choices.menu, (at - 1) % len(choices.menu.entries), choices.size.height)
    await pilot.press("down")
    assert any(line.startswith(f"> {label}") for line in text(app)), text(app)
    await typed(pilot, "enter")


def text(app: Arcade) -> list[str]:
    """The lines of text that the screen on top shows, in no picture of the arena."""
    lines = [row.text.rstrip() for each in app.screen.query(Rows) for row in each.rows]
    assert all(map(str.isascii, lines)), lines
    return lines + [each.value for each in app.screen.query(Input)]


def live(app: Arcade) -> Play:
    """The game on top."""
    assert isinstance(app.screen, Play), (app.screen, text(app))
    return app.screen


def flown(play: Play, seconds: float) -> None:
    """So many seconds go by."""
    for _ in range(round(seconds * 10)):
        play.go_on(0.1)
