"""Games are recorded by themselves: one file for each line that is lived, the last ten are kept.

What is written is flushed every second (`fasteroids.history.recording`), so whatever ends the game leaves a recording
of it. Trouble with files is told once, and the game goes on without.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import IO, Final

from attrs import evolve

from fasteroids.history.recording import RecordingFile, headed
from fasteroids.tui._store import new_file
from fasteroids.tui.session import Session, game_at
from fasteroids.units import ModelError

__all__ = ["GAME", "KEPT", "SUFFIX", "Keeper", "recordings"]

GAME: Final = "game"
"""The field of a recording's header that tells which game is played."""

KEPT: Final = 10
"""Recordings that are kept; older ones make room."""

SUFFIX: Final = ".fast.jsonl"


def recordings(folder: Path) -> list[Path]:
    """The recordings in a folder, the newest first. What is no file, as a pipe that nobody writes to, is none."""
    with suppress(OSError):
        names = (SUFFIX, f"{SUFFIX}.gz")
        found = [each for each in folder.iterdir() if each.name.endswith(names) and each.is_file()]
        return sorted(found, key=lambda each: each.name, reverse=True)
    return []


def _rules(session: Session) -> dict[str, object]:
    """What a recording says of the game that is played in it: its mode, and how many of the first ships humans fly."""
    game = game_at(session, session.timeline.first.place)
    return {"mode": game.mode, "humans": sum(player.human for player in game.players)}


class Keeper:
    """Writes what a session lives. `tell` is given a sentence if files make trouble."""

    def __init__(self, folder: Path, title: str, tell: Callable[[str], object]) -> None:
        self._folder, self._title, self._tell = folder, title, tell
        self._file: IO[bytes] | None = None
        self._recording: RecordingFile | None = None
        self._session: Session | None = None
        self.path: Path | None = None
        self.working = True

    def follow(self, session: Session) -> None:
        """The session went on, or lives on in another line: then another recording begins, with the past of it."""
        if not self.working:
            return
        before, self._session = self._session, session
        try:
            if before is None or before.timeline.name != session.timeline.name:
                self._close(before)
                self._open(session)
                start = session.timeline.first.place
            else:
                start = before.timeline.last.place
            assert self._recording is not None
            for state in session.timeline.forwards(start):
                self._recording.add(state)
            self._recording.tend()
        except (OSError, ModelError) as error:
            self._fail(error)

    def close(self) -> None:
        """The game is over: the recording gets its end."""
        session, self._session = self._session, None
        try:
            self._close(session)
        except OSError as error:
            self._fail(error)

    def _open(self, session: Session) -> None:
        self.path, self._file = new_file(self._folder, SUFFIX)
        first = session.timeline.first.world
        header = evolve(headed(first, title=self._title), extra={GAME: _rules(session)})
        self._recording = RecordingFile(self._file, first, header, clock=time.monotonic)
        for old in recordings(self._folder)[KEPT:]:
            with suppress(OSError):
                old.unlink()

    def _close(self, session: Session | None) -> None:
        recording, file = self._recording, self._file
        self._recording = self._file = None
        if recording is not None and session is not None:
            for mark in session.timeline.bookmarks.values():
                if session.timeline.holds(mark.line, mark.state.place):
                    recording.bookmark(mark.name, mark.state.place)
            recording.finish(session.timeline.world.clock)
            recording.close()
        if file is not None:
            file.flush()
            with suppress(OSError):
                os.fsync(file.fileno())
            file.close()

    def _fail(self, error: Exception) -> None:
        self.working = False
        reason = str(error)
        if isinstance(error, OSError) and error.strerror:
            reason = f"{error.filename or self._folder}: {error.strerror}"
        self._tell(f"this game is not recorded: {reason}")
