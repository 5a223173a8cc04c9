"""The app: which screen is shown, and the world outside: files, sound, signals, the terminal."""

from __future__ import annotations

import asyncio
import os
import signal
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from threading import current_thread, main_thread
from typing import ClassVar

from attrs import evolve
from textual import events
from textual.app import App, ScreenStackError
from textual.binding import BindingType
from textual.driver import Driver

from fasteroids.tui._store import Store
from fasteroids.tui.arena import Arena
from fasteroids.tui.boxes import Tell
from fasteroids.tui.collector import PERIOD, Collector
from fasteroids.tui.controls import Hands, reported
from fasteroids.tui.ending import End, Ended, score_of
from fasteroids.tui.keeping import Keeper
from fasteroids.tui.keyboard import KeyboardReport
from fasteroids.tui.keys import Command, Keymap, spoken
from fasteroids.tui.launching import (
    Launched,
    Library,
    Recorded,
    Wanted,
    launched,
    new_seed,
    with_seed,
)
from fasteroids.tui.options import Notices, Options
from fasteroids.tui.pictures import saved
from fasteroids.tui.play import Play
from fasteroids.tui.recent import briefs
from fasteroids.tui.screens import Help, Keys, Palette, Place, Scores
from fasteroids.tui.sound import Sound
from fasteroids.tui.start import Start
from fasteroids.units import ModelError

__all__ = ["Arcade"]

_SIGNALS = ("SIGTERM", "SIGHUP", "SIGINT")
"""What ends the app in order: its exit code is 128 and the number of the signal."""


class Arcade(App[int], inherit_bindings=False):
    """Games on a terminal. `run` returns the exit code, None if the app broke down."""

    BINDINGS: ClassVar[list[BindingType]] = []
    ENABLE_COMMAND_PALETTE = False
    TITLE = "Fasteroids"
    CSS = """
    Toast, Toast.-information, Toast.-warning, Toast.-error {
        border: ascii #7a9cc6; background: #0b0e14; padding: 0 1;
    }
    """

    def __init__(
        self,
        library: Library,
        store: Store,
        options: Options,
        *,
        first: Launched | None = None,
        notices: Notices | None = None,
        driver: type[Driver] | None = None,
    ) -> None:
        """`first` begins at once; without it the start screen asks."""
        super().__init__(driver_class=driver)
        self.options = options
        self.sound = Sound(wanted=options.sound)
        self._library, self._store, self._notices = library, store, notices
        self._first = first
        self._wanted: Wanted | None = None
        self._hands = Hands()
        self._keeper: Keeper | None = None
        self._collector = Collector()
        self._player = ""

    @property
    def keymap(self) -> Keymap:
        """What keys mean."""
        return self.options.settings.keymap

    @property
    def folder(self) -> Path | None:
        """Where recordings go."""
        return None if self.options.folder is None else self.options.folder / "recordings"

    def on_mount(self) -> None:
        """The first screens."""
        self._collector.begin()
        self.set_interval(PERIOD, self._collector.tend)
        # Event loops handle signals on POSIX alone, and there in the first thread alone.
        if os.name == "posix" and current_thread() is main_thread():
            loop = asyncio.get_running_loop()
            for name in _SIGNALS:
                number = getattr(signal, name)
                loop.add_signal_handler(number, self.exit, 128 + number)
        if self._notices is not None:
            self._notices.shown_by(self.tell)
        self.push_screen(
            Start(
                self._library,
                keymap=self.keymap,
                seed=self._seed,
                recent=lambda: briefs(self.folder) if self.folder else [],
                notes=self.options.notes,
                model=self.options.model,
            )
        )
        if self._first is not None:
            self.begin(self._first)

    def on_unmount(self) -> None:
        """Silence, and the end of the recording."""
        self.close()

    def tell(self, sentence: str) -> None:
        """Show a sentence for a while, as it is: a path may look like markup."""
        self.notify(sentence, markup=False)

    def close(self) -> None:
        """Let go of everything outside. It may be called again."""
        self._collector.end()
        self.sound.close()
        if self._keeper is not None:
            self._keeper.close()

    def _seed(self) -> int:
        """The seed of a new game: the one that was asked for, once."""
        seed, self.options = self.options.seed, evolve(self.options, seed=None)
        return new_seed() if seed is None else seed

    def on_keyboard_report(self, event: KeyboardReport) -> None:
        """The terminal tells of keys that go up, or does not."""
        if event.key_up:
            self._hands = reported(self._hands)

    def on_key(self, event: events.Key) -> None:
        """A key that nobody has. Whoever presses Ctrl-C wants to leave, and is told how."""
        if event.key == "ctrl+c":
            ways = [spoken(key) for key in self.keymap.keys[Command.QUIT]]
            self.tell(" or ".join([*ways, "Esc on the start screen"]) + " quits")

    # Games.

    def launch(self, wanted: Wanted) -> None:
        """Begin what is wanted, or say why it cannot be had."""
        try:
            begun = launched(wanted, self._library)
        except ModelError as error:
            self.push_screen(Tell("That cannot be had", str(error)))
            return
        self.begin(begun)

    def begin(self, begun: Launched) -> None:
        """Show a session, over the start screen."""
        self._leave()
        if self._wanted is not None:  # the past of another game may be garbage
            self._collector.renew()
        self._wanted = begun.wanted
        keeper = None
        if self.folder is not None and not isinstance(begun.wanted, Recorded):
            keeper = Keeper(self.folder, begun.title, self.tell)
        self._keeper = keeper
        self.push_screen(
            Play(
                begun.session,
                view=self.options.view,
                keymap=self.keymap,
                fps=self.options.settings.fps,
                keeper=keeper,
                sound=self.sound,
                hands=self._hands,
                window=self.options.window,
                timer=self.options.timer,
            )
        )

    def _leave(self) -> None:
        """Back to the start screen."""
        while len(self.screen_stack) > 1 and not isinstance(self.screen, Start):
            if isinstance(self.screen, Play):
                self.options = evolve(self.options, view=self.screen.view)
            self.pop_screen()

    @property
    def playing(self) -> Play | None:
        """The game under whatever is shown."""
        return next((each for each in reversed(self.screen_stack) if isinstance(each, Play)), None)

    @property
    def open(self) -> bool:
        """Is nothing over the game or the start screen? More keys may be on their way when a screen comes."""
        try:
            return isinstance(self.screen, Play | Start)
        except ScreenStackError:  # the app has ended
            return False

    def on_start_picked(self, event: Start.Picked) -> None:
        """The start screen says what is wanted."""
        if not isinstance(self.screen, Start):
            return
        if event.picked in ("scores", "keys"):
            self.show(event.picked)
        else:
            self.launch(event.picked)  # type: ignore[arg-type]  # the others

    def on_play_over(self) -> None:
        """A game has ended: a name for the table, and what next."""
        play = self.playing
        if play is None or not play.is_active:
            return
        recording = self._keeper.path.name if self._keeper and self._keeper.path else ""
        end = End(
            play.session,
            score=score_of(play.session, recording),
            table=self._store.scores(),
            name=self._player,
            keymap=self.keymap,
        )
        self.push_screen(end, partial(self._over, end, play))

    def _over(self, end: End, play: Play, answer: Ended | None) -> None:
        if end.score is not None and end.entered is not None:
            self._player = end.entered
            self._store.enter(evolve(end.score, name=end.entered))
        match answer:
            case "why":
                play.command(Command.WHY)
            case "again" if self._wanted is not None:
                self.launch(with_seed(self._wanted, new_seed()))
            case "same" if self._wanted is not None:
                self.launch(self._wanted)
            case "start":
                self._leave()

    # Commands.

    def on_play_asked(self, event: Play.Asked) -> None:
        """What a game cannot do by itself."""
        self.obey(event.command)

    def on_start_asked(self, event: Start.Asked) -> None:
        """What the start screen cannot do by itself."""
        self.obey(event.command)

    def obey(self, command: Command) -> None:
        """A command about the whole game."""
        if not self.open:
            return
        match command:
            case Command.QUIT:
                self.exit(0)
            case Command.BACK:
                self._leave() if self.playing else self.exit(0)
            case Command.HELP:
                self.push_screen(Help(self.keymap, *self.options.notes[:1]))
            case Command.PALETTE:
                self.push_screen(Palette(self.keymap), self._commanded)
            case Command.SCREENSHOT:
                self.photograph()
            case Command.MUTE:
                self.sound.muted = not self.sound.muted
                silent = self.sound.note or ("sound off" if self.sound.muted else "sound on")
                self.tell(silent)

    def _commanded(self, chosen: Command | Place | None) -> None:
        """What was chosen of all commands: the game does it, if there is one."""
        play = self.playing
        if isinstance(chosen, str):
            self.show(chosen)
        elif chosen is not None and play is not None:
            play.command(chosen)
        elif chosen is not None:
            self.obey(chosen)

    def photograph(self) -> None:
        """Save a picture of the screen, and the scene of this moment."""
        if self.options.folder is None:
            self.tell("no picture: there is no folder for it")
            return
        play = self.playing
        world = None if play is None else play.session.world
        with ExitStack() as stack:
            if play is not None:
                stack.enter_context(play.query_one(Arena).posing())
            picture = self.export_screenshot()
        self.tell(saved(self.options.folder / "pictures", picture, world))

    def show(self, place: Place) -> None:
        """A screen that no key leads to."""
        if place == "keys":
            self.push_screen(Keys(self.keymap, self._remapped))
        else:
            self.push_screen(Scores(self._store.scores(), self.folder), self._scored)

    def _scored(self, recording: str | None) -> None:
        """The recording of a high score was chosen."""
        if recording and self.folder is not None:
            self.launch(Recorded(self.folder / recording))

    def _remapped(self, keymap: Keymap) -> None:
        """Keys mean something else now, here and on disk."""
        self.options = evolve(self.options, settings=evolve(self.options.settings, keymap=keymap))
        self._store.keep(evolve(self._store.settings(), keymap=keymap))
        for screen in self.screen_stack:
            if isinstance(screen, Play | Start):
                screen.keymap = keymap
