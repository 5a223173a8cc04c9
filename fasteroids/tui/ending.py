"""The end of a game: how it ended, a name for the table of high scores, and what next."""

from __future__ import annotations

import time
from typing import Final, Literal, TypeAlias

from attrs import evolve
from textual import events
from textual.app import ComposeResult
from textual.widgets import Input

from fasteroids.history import MAIN
from fasteroids.tui.boxes import Box
from fasteroids.tui.keys import Command, Keymap, spoken
from fasteroids.tui.lists import Choices
from fasteroids.tui.menu import Entry, lines, listed
from fasteroids.tui.panels import Rows
from fasteroids.tui.rows import Style
from fasteroids.tui.scores import Score, Table, place_of
from fasteroids.tui.session import Session

__all__ = ["End", "Ended", "score_of", "told"]

Ended: TypeAlias = Literal["why", "again", "same", "look", "start"]

_NEXT: Final = (
    Entry[Ended]("Why did I die?", "why"),
    Entry[Ended]("Play again", "again", "with a new seed"),
    Entry[Ended]("The same again", "same", "with this seed"),
    Entry[Ended]("Look back at it", "look", "scrub, and take over anywhere"),
    Entry[Ended]("Start screen", "start"),
)


def told(session: Session) -> str:
    """What each player reached, and in which game."""
    game = session.game
    wave = f"wave {game.wave}, " if game.mode == "waves" else ""
    rows = [f"{wave}seed {session.world.seed}"]
    rows += [f"{player.name}: {player.points:,} points" for player in game.players]
    return "\n".join(rows)


def score_of(session: Session, recording: str = "") -> Score | None:
    """The row of a human's game of waves; None for other games, and for lives that were taken over from a past."""
    game = session.game
    player = game.players[0] if game.players else None
    if game.mode != "waves" or player is None or not player.human or not player.points:
        return None
    if session.timeline.name != MAIN:
        return None
    return Score(
        "waves", "", player.points, wave=game.wave, seed=session.world.seed,
        date=time.strftime("%Y-%m-%d"), recording=recording,
    )  # fmt: skip


class End(Box[Ended]):
    """What next? `entered` is set to the name once one is given for the table."""

    DEFAULT_CSS = "End #choices { margin-top: 1; }"

    def __init__(
        self, session: Session, *, score: Score | None, table: Table, name: str, keymap: Keymap
    ) -> None:
        super().__init__(session.game.ended or "the end", "Enter chooses, Esc looks back")
        place = None if score is None else place_of(table, score)
        self.score = score if place is not None else None
        self.entered: str | None = None
        self._before, self._keymap = name, keymap
        self._told = told(session)
        if place is not None:
            self._told += f"\n\nplace {place} in the high scores; your name:"
        died = any(player.human and player.ship is None for player in session.game.players)
        why = evolve(_NEXT[0], detail=_why_key(keymap))
        self._entries = (why, *_NEXT[1:]) if died else _NEXT[1:]

    def inside(self) -> ComposeResult:
        """How it ended, the name, the choices."""
        yield Rows(id="told")
        if self.score is not None:
            yield Input(self._before, id="name", max_length=20)
        yield Choices(self._entries, id="choices")

    @property
    def choices(self) -> Choices[Ended]:
        """What next."""
        found: Choices[Ended] = self.query_one("#choices", Choices)
        return found

    def wanted(self) -> tuple[int, int]:
        """All of it."""
        rows = self._told.split("\n")
        named = 2 if self.score is not None else 1  # with a blank row
        width = max(listed(self._entries).width + 2, *map(len, rows))
        return width, len(rows) + named + len(self._entries)

    def fitted(self, columns: int, rows: int) -> None:
        """The choices are the last to go."""
        text = self._told.split("\n")
        left = max(rows - len(self._entries) - 1 - (self.score is not None), 1)
        shown = text[-left:]
        widget = self.query_one("#told", Rows)
        widget.styles.width, widget.styles.height = columns, len(shown)
        widget.show(lines("\n".join(shown), columns, Style.TITLE))
        if self.score is not None:
            self.query_one("#name").styles.width = min(columns, 22)
        self.choices.styles.width, self.choices.styles.height = columns, len(self._entries)

    def key(self, event: events.Key) -> bool:
        """Move, choose, or ask why. While a name is written, Enter and letters are for that."""
        writing = isinstance(self.focused, Input)
        if event.key == "escape":
            self._leave("look")
        elif self.choices.key(event.key):
            return True
        elif writing:
            return False
        elif event.key == "enter":
            self.chosen()
        elif self._keymap.command(event.key) is Command.WHY:
            self._leave("why")
        else:
            return False
        return True

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """The name is given: then the keys are for the choices."""
        self._take(event.value)
        event.input.disabled = True
        self.set_focus(None)

    def _take(self, name: str) -> None:
        if self.score is not None and self.entered is None:
            self.entered = name.strip() or "nobody"

    def on_choices_chosen(self) -> None:
        """A click chooses."""
        self.chosen()

    def chosen(self) -> None:
        """The answer."""
        entry = self.choices.menu.chosen
        if entry is not None:
            self._leave(entry.value)

    def _leave(self, answer: Ended) -> None:
        if self.score is not None:
            self._take(self.query_one("#name", Input).value)
        self.leave(answer)


def _why_key(keymap: Keymap) -> str:
    """What is said of the key that asks why; nothing if there is none."""
    keys = keymap.keys[Command.WHY]
    return f"or press {spoken(keys[0])}" if keys else ""
