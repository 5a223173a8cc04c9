"""What the commands that open the terminal game share: its options, where its programs and scenes come from, its start.

Textual is loaded only by `opened`, when there is a terminal to show a game on.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Mapping
from functools import wraps
from typing import TYPE_CHECKING, Any, Final, TypeVar

import click
from attrs import evolve, frozen

from fasteroids.actions import Program
from fasteroids.cli._bots import read_bot
from fasteroids.cli._files import shipped, shipped_programs
from fasteroids.cli._guard import BUG, Refusal, reason
from fasteroids.cli._scenes import open_scene
from fasteroids.state import World
from fasteroids.units import ModelError

if TYPE_CHECKING:
    from fasteroids.tui.launching import Launched, Wanted

__all__ = [
    "MODEL",
    "WEB",
    "Screen",
    "Shelf",
    "begun",
    "insist",
    "on_terminal",
    "opened",
    "plain",
    "screen",
    "seed",
]

F = TypeVar("F", bound=Callable[..., Any])

MODEL: Final = "smooth"
"""The model of games that no scene describes, if nobody says."""

WEB: Final = "TEXTUAL_DRIVER"
"""The variable by which a server of Textual tells a game that a browser shows it."""

_SENTENCE: Final = re.compile(r"(?:(?!\.\s).)+\.?", re.DOTALL)


@frozen
class Screen:
    """How a game is shown, as far as the command line says; None where the settings or the terminal decide."""

    arena: str | None = None
    fps: int | None = None
    silent: bool = False
    window: bool = False
    seed: int | None = None
    model: str | None = None

    @property
    def words(self) -> list[str]:
        """The options that say the same on a command line."""
        said = [
            ("--arena", self.arena), ("--fps", self.fps), ("--seed", self.seed), ("--model", self.model)
        ]  # fmt: skip
        words = [word for name, value in said if value is not None for word in (name, str(value))]
        return words + ["--no-sound"] * self.silent + ["--window"] * self.window


def screen(command: Callable[..., int]) -> Callable[..., int]:
    """The options of `Screen`: the command gets what they say as one parameter, `shown`."""

    @wraps(command)
    def shown(
        *, arena: str | None, fps: str | None, silent: bool, window: bool, **others: Any
    ) -> int:
        how = Screen(arena, None if fps is None else int(fps), silent, window)
        return command(shown=how, **others)

    for option in (
        click.option(
            "--fps", type=click.Choice(["30", "60"]),
            help="Frames a second; without it the settings decide, else 30.",
        ),
        click.option(
            "--arena", type=click.Choice(["ascii", "braille", "block"]),
            help="How the arena is drawn; without it the settings decide, else what the terminal can show.",
        ),
        click.option("--window", "-window", is_flag=True, help="Play in 100 x 32 cells in the middle."),
        click.option("--no-sound", "-nosound", "silent", is_flag=True, help="No sound."),
    ):  # fmt: skip
        shown = option(shown)
    return shown


def plain(command: F) -> F:
    """--plain, for a game that one only looks at."""
    return click.option(
        "--plain", is_flag=True, help="Tell it in words, a line an event, without a terminal."
    )(command)


def seed(command: F) -> F:
    """--seed of games, which draw one if nobody says."""
    return click.option(
        "--seed", type=int, metavar="N", help="The seed; without it a game draws one, and a scene has its own."
    )(command)  # fmt: skip


class Shelf:
    """What comes with the package, and files: the library of the game. Its refusals are `ModelError`."""

    def programs(self) -> Mapping[str, str]:
        """The programs that come with the package, with what their first lines say."""
        return {name: _said(text, "//") for name, text in shipped_programs().items()}

    def scenes(self) -> Mapping[str, str]:
        """The scenes that come with the package, with what their first lines say."""
        return {name: _said(text, "#") for name, text in shipped().items()}

    def program(self, name: str) -> Program:
        """A program by its name, or of a file."""
        return _told(lambda: read_bot(name))

    def scene(self, name: str, seed: int | None, model: str | None) -> tuple[str, World]:
        """What to call a scene, and its world."""
        return _told(lambda: open_scene(name, seed=seed, model=model))


T = TypeVar("T")


def _told(get: Callable[[], T]) -> T:
    try:
        return get()
    except Refusal as refusal:
        raise ModelError(refusal.message) from None
    except OSError as error:
        raise ModelError(f"cannot read {reason(error)}") from None


def _said(text: str, sign: str) -> str:
    """The first sentence of the comment that a text begins with, in one line."""
    words = []
    for line in text.splitlines():
        if not line.startswith(sign):
            break
        if not line.startswith(f"{sign}:"):
            words += line.removeprefix(sign).split()
    found = _SENTENCE.match(" ".join(words))
    return found[0] if found else ""


def begun(wanted: Wanted) -> Launched:
    """What is wanted, begun; a `Refusal` says why it cannot be had."""
    from fasteroids.tui.launching import launched

    try:
        return launched(wanted, Shelf())
    except ModelError as error:
        raise Refusal(str(error)) from None


def on_terminal() -> bool:
    """Is there a terminal, or a browser, to play on?"""
    if os.environ.get(WEB):
        return True
    streams = (sys.stdin, sys.stdout, sys.stderr)
    return all(stream is not None and stream.isatty() for stream in streams)


def insist(instead: str = "") -> None:
    """`Refusal` if there is no terminal; `instead` says what else can be done."""
    if not on_terminal():
        raise Refusal("; ".join(filter(None, ("there is no terminal to play on", instead))))


def opened(wanted: Wanted | Launched | None, shown: Screen) -> int:
    """Play on the terminal, from the start screen or at once what is wanted, or has begun already; the exit code.

    `Refusal` if there is no terminal, or if what is wanted cannot be had: before anything is shown.
    """
    insist("--plain tells a game in words, line by line")
    from fasteroids.tui.launching import Launched

    first = wanted if wanted is None or isinstance(wanted, Launched) else begun(wanted)
    from fasteroids.tui._store import Store, data_folder
    from fasteroids.tui.app import Arcade
    from fasteroids.tui.driving import chosen_driver
    from fasteroids.tui.options import Notices, Options
    from fasteroids.tui.picture import View
    from fasteroids.tui.terminal import terminal_of

    terminal = terminal_of(os.environ)
    notices = Notices()
    store = Store(notices)
    settings = store.settings()
    if shown.fps is not None:
        settings = evolve(settings, fps=shown.fps)
    chosen = shown.arena or settings.arena
    driver, note = (None, "") if os.environ.get(WEB) else chosen_driver()
    app = Arcade(
        Shelf(),
        store,
        Options(
            view=View(arena=chosen or terminal.arena),
            settings=settings,
            folder=data_folder(),
            sound=settings.sound and not shown.silent,
            window=shown.window,
            seed=shown.seed if first is None else None,
            model=shown.model or MODEL,
            notes=tuple(filter(None, ("" if chosen else terminal.note, note))),
        ),
        first=first,
        notices=notices,
        driver=driver,
    )
    try:
        code = app.run()
    finally:
        app.close()
    if app.return_code == 1 and code is None:
        click.echo("this is a bug in fasteroids", err=True)
        return BUG
    return code or 0
