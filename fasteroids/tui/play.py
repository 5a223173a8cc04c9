"""The screen of a game: it tells the time, reads keys, and shows what the session has become. The rest is pure."""

from __future__ import annotations

from time import perf_counter
from typing import ClassVar, Final

from attrs import evolve
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import Horizontal, Vertical
from textual.message import Message
from textual.screen import Screen
from textual.timer import Timer

from fasteroids.entities import Ship
from fasteroids.events import Happened
from fasteroids.tui.arena import Arena
from fasteroids.tui.camera import Frame, frame
from fasteroids.tui.canvas import Cells
from fasteroids.tui.chronicle import chronicle_of
from fasteroids.tui.commanding import commanded, viewed
from fasteroids.tui.controls import Hands, acted, let_go, pressed, released, reported, synced
from fasteroids.tui.debugging import sought, stopped
from fasteroids.tui.editor import Breaking, Editor
from fasteroids.tui.keeping import Keeper
from fasteroids.tui.keyboard import KeyAgain, KeyboardReport, KeyUp
from fasteroids.tui.keys import FLIGHT, Command, Keymap
from fasteroids.tui.overlay import Overlay, overlay
from fasteroids.tui.panels import Pane, Rows
from fasteroids.tui.picture import (
    PANELS_FROM,
    View,
    film,
    look_of,
    pane,
    status,
    told,
    too_small,
)
from fasteroids.tui.rewriting import source_of
from fasteroids.tui.session import Session, beat, look, look_at, paused
from fasteroids.tui.sound import Sound, effect_of
from fasteroids.tui.strip import Strip

__all__ = ["Play"]

LINGER: Final = 1.0
"""Seconds of game time from the end of a game to the telling of it: one sees what happened."""

WINDOW: Final = (100, 32)
"""Columns and rows of a game in a window."""

_WIDE: Final = 100
"""Columns from which on the panel stays while a game is played; in fewer it comes when one looks at the past."""

_SELDOM: Final = 6
"""Pictures of the panes in a second of a running game, more or less."""

_FORESEEN: Final = 0.2
"""Seconds of wall time for which a prediction is drawn before it is made anew."""


class Play(Screen[None], inherit_bindings=False):
    """A session on screen. It posts `Play.Asked` for what needs another screen."""

    BINDINGS: ClassVar[list[BindingType]] = []
    DEFAULT_CSS = """
    Play { layout: vertical; background: #0b0e14; }
    Play #middle { height: 1fr; }
    Play #status, Play #strip, Play #said { height: 1; }
    Play #side { width: 40; display: none; padding: 0 0 0 1; }
    Play #pane { height: 1fr; }
    Play.wide #side { display: block; }
    Play.narrow #side { display: block; width: 32; }
    Play.window { align: center middle; background: #1c2230; }
    Play.window #status, Play.window #middle, Play.window #strip, Play.window #said { max-width: 100; }
    Play.window #middle { max-height: 29; }
    """

    class Asked(Message):
        """A command that this screen does not do by itself."""

        def __init__(self, command: Command) -> None:
            super().__init__()
            self.command = command

    class Over(Message):
        """The game has ended, a moment ago."""

    def __init__(
        self, session: Session, *, view: View, keymap: Keymap, fps: int, keeper: Keeper | None, sound: Sound,
        hands: Hands | None = None, window: bool = False, timer: bool = True,
    ) -> None:  # fmt: skip
        """`window`: in a frame of `WINDOW` cells. Without `timer` time goes on by `go_on` alone."""
        super().__init__(classes="window" if window else "")
        self.session, self.view, self.keymap = session, view, keymap
        self.hands = hands or Hands()
        self.over = session.game.ended is not None
        self._window, self._ticking = window, timer
        self.frames = 0
        self._fps, self._keeper, self._sound = fps, keeper, sound
        self._last = 0.0
        self._timer: Timer | None = None
        self._overlay: Overlay | None = None
        self._foreseen = -1.0
        self._chronicle = chronicle_of(session.timeline)
        self._film: Strip | None = None
        self._has_pane = False
        self._due = True

    def compose(self) -> ComposeResult:
        """A line above, the arena and the panes, two lines below."""
        yield Rows(id="status")
        with Horizontal(id="middle"):
            yield Arena(id="arena")
            with Vertical(id="side"):
                yield Pane(id="pane")
        yield Rows(id="strip")
        yield Rows(id="said")

    def on_mount(self) -> None:
        """Time begins."""
        self._last = perf_counter()
        if self._ticking:
            self._timer = self.set_interval(1.0 / self._fps, self._beat)
        self._keep()

    def on_unmount(self) -> None:
        """The recording gets its end."""
        if self._keeper is not None:
            self._keeper.close()

    # Time.

    def _beat(self) -> None:
        now = perf_counter()
        elapsed, self._last = now - self._last, now
        if self.is_active:
            self.go_on(elapsed)

    def go_on(self, elapsed: float) -> None:
        """So much wall time (s) later."""
        before = self.session
        if before.seek is not None:
            self.become(sought(before))
            return
        actions = []
        if before.live and before.running:
            self.hands, told = acted(self.hands, elapsed * before.speed)
            humans = [p for p in before.game.players if p.human]
            actions = [
                (ship, action)
                for player, action in told
                if player <= len(humans) and (ship := humans[player - 1].ship) is not None
            ]
        session = beat(before, elapsed, actions)
        if session is not before:
            self.become(session)

    def become(self, session: Session) -> None:
        """Show another session."""
        before, self.session = self.session, session
        if session.timeline is not before.timeline:
            self._keep()
            if session.live and session.timeline.name == before.timeline.name:
                self._heard(before)
            self._take_hands(before)
        self._tell_end()
        if (session.live and session.running) != (before.live and before.running):
            self._laid_out()
            self.call_after_refresh(self.picture)
        self.picture()

    def _tell_end(self) -> None:
        """Tell of the end of the game, once, a moment after it."""
        game = self.session.game
        if game.ended is None:
            self.over = self.over and not self.session.live
        elif self.session.live and not self.over and self.session.world.time >= game.since + LINGER:
            self.over = True
            self.post_message(self.Over())

    def _keep(self) -> None:
        if self._keeper is not None:
            self._keeper.follow(self.session)

    def _heard(self, before: Session) -> None:
        for state in self.session.timeline.forwards(before.timeline.last.place):
            if isinstance(state.what, Happened) and (effect := effect_of(state.what)):
                self._sound.play(effect)

    def _take_hands(self, before: Session) -> None:
        """A player with another ship, or in another line, has the thruster as that ship has it."""
        old = [p.ship for p in before.game.players if p.human]
        humans = [p.ship for p in self.session.game.players if p.human]
        for number, ship in enumerate(humans[:2], 1):
            moved = self.session.timeline.name != before.timeline.name
            if ship is not None and (moved or number > len(old) or old[number - 1] != ship):
                flown = self.session.timeline.world[ship]
                assert isinstance(flown, Ship)
                self.hands = synced(self.hands, 1 if number == 1 else 2, flown.thruster)

    # Keys.

    def on_key(self, event: events.Key) -> None:
        """A key went down."""
        if self.query_one(Pane).key(event.key):
            event.stop()
            event.prevent_default()
            return
        command = self.keymap.command(event.key)
        if command is None:
            return
        event.stop()
        event.prevent_default()
        self.command(command, again=isinstance(event, KeyAgain))

    def command(self, command: Command, *, again: bool = False) -> None:
        """Do what a command asks."""
        if command is Command.BACK and self.session.seek is not None:
            self.become(stopped(self.session))
            return
        if command in FLIGHT:
            if not self.session.live and not again:
                return
            self.hands = pressed(self.hands, command, again=again)
            return
        if (view := viewed(self.view, command)) is not None:
            self.view = view
            self._anew()
            self._laid_out()
            self.picture()
            return
        if self._worked(command):
            return
        session = commanded(self.session, command)
        if session is None:
            if not again:  # a key that is held asks once
                self.post_message(self.Asked(command))
            return
        self.hands = let_go(self.hands)
        self._anew()
        self.become(session)

    def _anew(self) -> None:
        """What is made now and then only is made at once."""
        self._foreseen, self._due = -1.0, True

    # The program, and the panel.

    def _worked(self, command: Command) -> bool:
        """Do a command that works on the program or in the panel in a pause, if this is one."""
        if command not in (Command.EDIT, Command.BREAK_WHEN, Command.CHOOSE):
            return False
        session = evolve(self.session, seek=None)
        session = paused(session) if session.running else session
        self.hands = let_go(self.hands)
        source = source_of(session)
        if command is Command.CHOOSE:
            self.become(session)
            self._choose()
        elif source is None:
            self.become(evolve(session, said="no ship here runs a program"))
        elif command is Command.EDIT:
            self.become(session)
            editor = Editor(session, *source, timer=self._ticking)
            self.app.push_screen(editor, self._answered)
        else:
            self.become(session)
            self.app.push_screen(Breaking(session), self._answered)
        return True

    def _answered(self, session: Session | None) -> None:
        """Another screen had an answer, or none."""
        if session is not None:
            self.become(session)

    def _choose(self) -> None:
        """A row of the panel is to be chosen."""
        begun = self._has_pane and self.query_one(Pane).begin()
        told = "arrows and Enter choose a line, Esc leaves" if begun else "no line leads anywhere"
        self.become(evolve(self.session, said=told))

    def on_key_up(self, event: KeyUp) -> None:
        """A key went up, where the terminal tells."""
        self.hands = released(self.hands, self.keymap.command(event.key))

    def on_keyboard_report(self, event: KeyboardReport) -> None:
        """The terminal says whether it tells of keys that go up."""
        if event.key_up:
            self.hands = reported(self.hands)
            self.picture()

    def on_app_blur(self) -> None:
        """Somebody looks elsewhere: nothing stays held."""
        self.hands = let_go(self.hands)

    def on_screen_suspend(self) -> None:
        """Another screen takes the keys: nothing stays held."""
        self.hands = let_go(self.hands)

    # Pictures.

    def on_resize(self) -> None:
        """Another size: the panes come and go."""
        self._anew()
        self._laid_out()
        self.call_after_refresh(self.picture)

    def on_arena_resized(self) -> None:
        """The arena has another size: by the terminal, or as the pane came or went."""
        self._anew()
        self.picture()

    @property
    def room(self) -> tuple[int, int]:
        """Columns and rows of the game."""
        columns, rows = self.size
        return (min(columns, WINDOW[0]), min(rows, WINDOW[1])) if self._window else (columns, rows)

    def _laid_out(self) -> None:
        columns, rows = self.room
        panels = self.view.panels and columns >= PANELS_FROM[0] and rows >= PANELS_FROM[1]
        looks = not (self.session.live and self.session.running)
        self._has_pane = panels and (columns >= _WIDE or looks)
        self.set_class(self._has_pane and columns >= _WIDE, "wide")
        self.set_class(self._has_pane and columns < _WIDE, "narrow")

    def picture(self) -> None:
        """Show the session as it is."""
        if not self.is_mounted:
            return
        columns, rows = self.room
        small = too_small(columns, rows)
        arena = self.query_one(Arena)
        self.frames += 1
        if small is not None:
            arena.show(Frame(columns, (Cells(small[:columns].ljust(columns), ()),)))
            for name in ("#status", "#strip", "#said"):
                self.query_one(name, Rows).show(())
            return
        width, height = arena.content_size
        look = look_of(self.session, self.view, self._ahead())
        arena.show(frame(self.session.world, look, width, height))
        ascii = self.view.arena == "ascii"
        note = f"keys: {self.hands.mode}"
        self.query_one("#status", Rows).show(
            [status(self.session, columns, ascii=ascii, note=note)]
        )
        self.query_one("#said", Rows).show([told(self.session.said, columns)])
        running = self.session.live and self.session.running
        if self._due or self.frames % max(self._fps // _SELDOM, 1) == 0 or not running:
            self._due = False
            self._panes(columns, ascii=ascii)

    def _panes(self, columns: int, *, ascii: bool) -> None:
        """The filmstrip and the pane: while a game is played a few times a second is enough."""
        self._chronicle = self._chronicle.followed(self.session.timeline)
        self._film = film(self.session, self._chronicle, columns, ascii=ascii)
        self.query_one("#strip", Rows).show(self._film.rows)
        side = self.query_one(Pane)
        if self._has_pane:
            width, height = side.content_size
            side.show(pane(self.session, self._chronicle, width, height))

    def on_rows_clicked(self, event: Rows.Clicked) -> None:
        """A click on the filmstrip, or on a line of the pane that leads somewhere."""
        if event.place is not None:
            self.become(look(self.session, event.place))
        elif event.rows.id == "strip" and self._film is not None:
            place = self._film.place_at(event.column)
            time = self._film.time_at(event.column)
            self.become(look(self.session, place) if place else look_at(self.session, time))

    def _ahead(self) -> Overlay | None:
        """What is to come, made anew now and then."""
        if not self.view.overlay:
            return None
        now = perf_counter()
        if self._overlay is None or self._foreseen < 0.0 or now - self._foreseen > _FORESEEN:
            self._overlay, self._foreseen = overlay(self.session.world), now
        return self._overlay
