"""Two files of the user: the high scores in the data folder, the settings in the config folder; and names of new ones.

What cannot be read or written is told of once, and the game goes on without it. Both are written whole: a new file
takes the place of the old one, so a crash leaves one of the two.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Final

from attrs import evolve

from fasteroids.tui.scores import EMPTY, Score, Table, entered, merged, table_of, text_of
from fasteroids.tui.settings import DEFAULTS, Settings, read_settings
from fasteroids.tui.settings import text_of as settings_text

__all__ = ["Store", "config_file", "data_folder", "new_file"]

_PATIENCE: Final = 2.0
"""Seconds to wait for another process that writes; it takes some milliseconds."""
_MOST_BYTES: Final = 1 << 20
_MOST_ASIDE: Final = 100
_MOST_A_SECOND: Final = 1000


def data_folder() -> Path:
    """Where scores and recordings are kept if nobody says."""
    from platformdirs import user_data_path

    return user_data_path("fasteroids", appauthor=False)


def config_file() -> Path:
    """Where the settings are if nobody says."""
    from platformdirs import user_config_path

    return user_config_path("fasteroids", appauthor=False) / "config.toml"


def new_file(folder: Path, suffix: str) -> tuple[Path, IO[bytes]]:
    """A new file, open to be written, in a folder that is made if need be; it takes the place of no other.

    Its name is the local time to the second, with a number if that is taken. `OSError` if it cannot be made.
    """
    folder.mkdir(parents=True, exist_ok=True)
    stamp = time.strftime("%Y%m%d-%H%M%S")
    for number in range(1, _MOST_A_SECOND + 1):
        place = folder / f"{stamp}{'' if number == 1 else f'-{number}'}{suffix}"
        with suppress(FileExistsError):
            return place, place.open("xb")
    raise OSError(None, f"there are {_MOST_A_SECOND} files of this second", str(folder))


class Store:
    """The files of one user. `tell` is given sentences for the user, each once.

    Scores entered while the file cannot be written stay in the table that `scores` gives until the game ends.
    """

    def __init__(
        self,
        tell: Callable[[str], object],
        *,
        folder: Path | None = None,
        config: Path | None = None,
    ) -> None:
        self._tell_user = tell
        self._told: set[str] = set()
        self._config = config or config_file()
        self._scores = (folder or data_folder()) / "scores.json"
        self._table = EMPTY

    # Scores.

    def scores(self) -> Table:
        """The table as it is on disk now, with what could not be written."""
        self._table = merged(self._on_disk(), self._table)
        return evolve(self._table, damaged=False)

    def enter(self, score: Score) -> Table:
        """Enter a row, on disk too, and give the table. Rows that another process writes meanwhile are kept.

        A damaged file is kept aside first, as `scores.json.damaged` (with a number, if there is one already).
        """
        self._table = entered(self._table, score)
        try:
            self._scores.parent.mkdir(parents=True, exist_ok=True)
            with _alone(self._scores.with_name("scores.lock")):
                on_disk = self._on_disk()
                if on_disk.damaged:
                    self._put_aside()
                self._table = evolve(merged(on_disk, self._table), damaged=False)
                _write_whole(self._scores, text_of(self._table))
        except OSError as error:
            self._tell(f"scores are not kept: {_reason(error, self._scores)}")
        return self._table

    def _on_disk(self) -> Table:
        try:
            data = _read(self._scores)
        except FileNotFoundError:
            return EMPTY
        except OSError as error:
            self._tell(f"scores cannot be read: {_reason(error, self._scores)}")
            return EMPTY
        table = table_of(data.decode("utf-8", "replace"))
        if table.damaged:
            read = len(table.rows) or "none"
            self._tell(f"the file of scores is damaged; {read} could be read: {self._scores}")
        return table

    def _put_aside(self) -> None:
        """Copy the file as it is beside itself, over none of its kind."""
        data = self._scores.read_bytes()
        for number in range(1, _MOST_ASIDE):
            suffix = ".damaged" if number == 1 else f".damaged-{number}"
            aside = self._scores.with_name(self._scores.name + suffix)
            with suppress(FileExistsError), aside.open("xb") as file:
                file.write(data)
                return

    # Settings.

    def settings(self) -> Settings:
        """The settings on disk; the defaults in place of what is wrong or missing."""
        try:
            text = _read(self._config).decode("utf-8")
        except FileNotFoundError:
            return DEFAULTS
        except OSError as error:
            self._tell(f"settings cannot be read: {_reason(error, self._config)}")
            return DEFAULTS
        except UnicodeDecodeError:
            self._tell(f"settings cannot be read: {self._config} is not text in UTF-8")
            return DEFAULTS
        settings, problems = read_settings(text)
        for problem in problems:
            self._tell(f"{self._config.name}: {problem}")
        return settings

    def keep(self, settings: Settings) -> bool:
        """Write the settings; did it work?

        Of a file that says more than settings do (comments, mistakes) a copy stays beside it, as `config.toml.old`.
        """
        try:
            self._config.parent.mkdir(parents=True, exist_ok=True)
            old = _read(self._config).decode("utf-8", "replace") if self._config.exists() else ""
            if old and settings_text(read_settings(old)[0]) != old:
                _write_whole(self._config.with_name(f"{self._config.name}.old"), old)
            _write_whole(self._config, settings_text(settings))
        except OSError as error:
            self._tell(f"settings are not kept: {_reason(error, self._config)}")
            return False
        return True

    def _tell(self, sentence: str) -> None:
        if sentence not in self._told:
            self._told.add(sentence)
            self._tell_user(sentence)


def _reason(error: OSError, place: Path) -> str:
    return f"{place}: {error.strerror or error}"


def _read(place: Path) -> bytes:
    """The file; no more of it than a sound one has, and `OSError` for what is no file."""
    if place.exists() and not place.is_file():
        raise OSError(None, "not a file")
    with place.open("rb") as file:
        return file.read(_MOST_BYTES)


def _write_whole(place: Path, text: str) -> None:
    """A file has the text, or is as it was. A link stays a link."""
    target = Path(os.path.realpath(place))
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    beside = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(text.encode("utf-8"))
            file.flush()
            os.fsync(file.fileno())
        beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)


@contextmanager
def _alone(place: Path) -> Iterator[None]:
    """Run alone among the processes that ask for this lock, or after waiting long enough.

    Where files cannot be locked there is no waiting: what is written is whole all the same, but the last writer wins.
    """
    with place.open("ab") as file:
        until = time.monotonic() + _PATIENCE
        while not _locked(file.fileno()) and time.monotonic() < until:
            time.sleep(0.01)
        yield


def _locked(handle: int) -> bool:
    """Try to lock a file until it is closed; True also where that cannot be done."""
    try:
        import fcntl
    except ImportError:
        return True
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True
