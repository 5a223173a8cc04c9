"""The app: which screen is shown, and the world outside: files, sound, signals, the terminal."""

from __future__ import annotations

import asyncio
import signal
from contextlib import suppress
from pathlib import Path
from typing import ClassVar

from attrs import field, frozen
from textual.app import App
from textual.binding import BindingType
from textual.driver import Driver

from fasteroids.tui.keeping import Keeper
from fasteroids.tui.keys import Command
from fasteroids.tui.picture import View
from fasteroids.tui.play import Play
from fasteroids.tui.session import Session
from fasteroids.tui.settings import DEFAULTS, Settings
from fasteroids.tui.sound import Sound

__all__ = ["Arcade", "Options"]


@frozen
class Options:
    """What the command line decides: `folder` is where recordings go, None for nowhere."""

    view: View = field(factory=View)
    settings: Settings = DEFAULTS
    folder: Path | None = None
    sound: bool = False
    window: bool = False
    title: str = "a game"


class Arcade(App[int], inherit_bindings=False):
    """Games on a terminal. `run` returns the exit code."""

    BINDINGS: ClassVar[list[BindingType]] = []
    ENABLE_COMMAND_PALETTE = False
    TITLE = "Fasteroids"
    CSS = "Screen { background: #101014; }"

    def __init__(
        self, session: Session, options: Options, *, driver: type[Driver] | None = None
    ) -> None:
        super().__init__(driver_class=driver)
        self._session, self.options = session, options
        self.sound = Sound(wanted=options.sound)

    def on_mount(self) -> None:
        """The first screen."""
        with suppress(NotImplementedError, RuntimeError, ValueError):
            asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, self.exit, 143)
        self.begin(self._session)

    def begin(self, session: Session) -> None:
        """Show a session."""
        folder = self.options.folder
        keeper = None if folder is None else Keeper(folder, self.options.title, self.notify)
        self.push_screen(
            Play(
                session,
                view=self.options.view,
                keymap=self.options.settings.keymap,
                fps=self.options.settings.fps,
                keeper=keeper,
                sound=self.sound,
            )
        )

    def on_play_asked(self, event: Play.Asked) -> None:
        """What a game cannot do by itself."""
        if event.command in (Command.BACK, Command.QUIT):
            self.exit(0)

    def on_unmount(self) -> None:
        """Silence."""
        self.sound.close()
