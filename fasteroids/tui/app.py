"""The app: which screen is shown, and the world outside: files, sound, signals, the terminal."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import ClassVar

from attrs import evolve, field, frozen
from textual import work
from textual.app import App
from textual.binding import BindingType
from textual.driver import Driver

from fasteroids.tui._store import Store
from fasteroids.tui.boxes import Tell
from fasteroids.tui.collector import PERIOD, Collector
from fasteroids.tui.controls import Hands, reported
from fasteroids.tui.ending import End, score_of
from fasteroids.tui.keeping import Keeper
from fasteroids.tui.keyboard import KeyboardReport
from fasteroids.tui.keys import Command, Keymap
from fasteroids.tui.launching import (
    Launched,
    Library,
    Recorded,
    Wanted,
    launched,
    new_seed,
    with_seed,
)
from fasteroids.tui.picture import View
from fasteroids.tui.pictures import saved
from fasteroids.tui.play import Play
from fasteroids.tui.recent import briefs
from fasteroids.tui.screens import Help, Keys, Palette, Place, Scores
from fasteroids.tui.settings import DEFAULTS, Settings
from fasteroids.tui.sound import Sound
from fasteroids.tui.start import Start
from fasteroids.units import ModelError

__all__ = ["Arcade", "Notices", "Options"]

_SIGNALS = ("SIGTERM", "SIGHUP")
"""What ends the app in order: its exit code is 128 and the number of the signal."""


@frozen
class Options:
    """What the command line decides.

    `folder` is where recordings and pictures go, None for nowhere; `seed` and `model` None where nobody says; `notes`
    are shown on the start screen; without `timer` the time of games goes on by `Play.go_on` alone.
    """

    view: View = field(factory=View)
    settings: Settings = DEFAULTS
    folder: Path | None = None
    sound: bool = False
    window: bool = False
    seed: int | None = None
    model: str = "smooth"
    notes: tuple[str, ...] = ()
    timer: bool = True


class Notices:
    """Takes sentences for the user, and keeps them until there is somewhere to show them."""

    def __init__(self) -> None:
        self._waiting: list[str] = []
        self._show: Callable[[str], object] | None = None

    def __call__(self, sentence: str) -> None:
        """Show a sentence, now or later."""
        if self._show is None:
            self._waiting.append(sentence)
        else:
            self._show(sentence)

    def shown_by(self, show: Callable[[str], object]) -> None:
        """From now on sentences are shown this way, those that wait first."""
        self._show = show
        for sentence in self._waiting:
            show(sentence)
        self._waiting.clear()


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
        for name in _SIGNALS:
            with suppress(AttributeError, NotImplementedError, RuntimeError, ValueError):
                number = getattr(signal, name)
                loop = asyncio.get_running_loop()
                loop.add_signal_handler(number, self.exit, 128 + number)
        if self._notices is not None:
            self._notices.shown_by(self.notify)
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
            keeper = Keeper(self.folder, begun.title, self.notify)
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

    def on_start_picked(self, event: Start.Picked) -> None:
        """The start screen says what is wanted."""
        if event.picked in ("scores", "keys"):
            self.show(event.picked)
        else:
            self.launch(event.picked)  # type: ignore[arg-type]  # the others

    @work(exclusive=True)
    async def on_play_over(self) -> None:
        """A game has ended: a name for the table, and what next."""
        play = self.playing
        if play is None:
            return
        recording = self._keeper.path.name if self._keeper and self._keeper.path else ""
        score = score_of(play.session, recording)
        end = End(
            play.session,
            score=score,
            table=self._store.scores(),
            name=self._player,
            keymap=self.keymap,
        )
        answer = await self.push_screen_wait(end)
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
        """A command about the whole game; others go to the game, if there is one."""
        match command:
            case Command.QUIT:
                self.exit(0)
            case Command.BACK:
                self._leave() if self.playing else self.exit(0)
            case Command.HELP:
                self.push_screen(Help(self.keymap, *self.options.notes[:1]))
            case Command.PALETTE:
                self.choose_command()
            case Command.SCREENSHOT:
                self.photograph()
            case Command.MUTE:
                self.sound.muted = not self.sound.muted
                silent = self.sound.note or ("sound off" if self.sound.muted else "sound on")
                self.notify(silent)

    @work(exclusive=True)
    async def choose_command(self) -> None:
        """All commands, by name."""
        chosen = await self.push_screen_wait(Palette(self.keymap))
        play = self.playing
        if isinstance(chosen, str):
            self.show(chosen)
        elif chosen is not None:
            if play is not None:
                play.command(chosen)
            else:
                self.obey(chosen)

    def photograph(self) -> None:
        """Save a picture of the screen, and the scene of this moment."""
        if self.options.folder is None:
            self.notify("no picture: there is no folder for it")
            return
        play = self.playing
        world = None if play is None else play.session.world
        self.notify(saved(self.options.folder / "pictures", self.export_screenshot(), world))

    @work(exclusive=True)
    async def show(self, place: Place) -> None:
        """A screen that no key leads to."""
        if place == "keys":
            await self.push_screen_wait(Keys(self.keymap, self._remapped))
            return
        name = await self.push_screen_wait(Scores(self._store.scores(), self.folder))
        if name and self.folder is not None:
            self.launch(Recorded(self.folder / name))

    def _remapped(self, keymap: Keymap) -> None:
        """Keys mean something else now, here and on disk."""
        self.options = evolve(self.options, settings=evolve(self.options.settings, keymap=keymap))
        self._store.keep(evolve(self._store.settings(), keymap=keymap))
        for screen in self.screen_stack:
            if isinstance(screen, Play | Start):
                screen.keymap = keymap
