"""Games that are done, kept on disk, so that the same ones are never played twice.

A folder holds a file for each line-up, a line of JSON for each seed. The name of a file is a digest of everything that
decides its games, so a changed program, field or engine finds no old results. Lines are only ever appended, each in
one piece; a later one of a seed counts. What is no such line is passed over, such as the torn last one of a run that
was killed. The folder may be deleted at any time.
"""

from __future__ import annotations

import json
import platform
import sys
from collections.abc import Iterable, Mapping
from functools import cache
from hashlib import sha256
from importlib.resources import files
from importlib.resources.abc import Traversable
from math import inf
from pathlib import Path
from typing import Any, Final, get_args

import click
from attrs import asdict

from fasteroids.arena import Ended, Game
from fasteroids.arena.games import Outcome
from fasteroids.cli._guard import reason

__all__ = ["Kept", "usual_folder"]

_OUTCOMES: Final = frozenset(get_args(Outcome))


def usual_folder() -> Path:
    """Where games are kept if nobody says: in the user's cache."""
    from platformdirs import user_cache_path

    return user_cache_path("fasteroids") / "arena"


class Kept:
    """The games kept in a folder, of one field: `field` is all that decides a game beside its programs and its seed.

    `texts` are the programs by name. A folder that cannot be read or written is told of once, on standard error;
    `working` is false from then on, and nothing is kept.
    """

    def __init__(self, folder: Path, field: tuple[object, ...], texts: Mapping[str, str]) -> None:
        self.folder, self.working = folder, True
        self._field, self._texts = field, texts
        self._places: dict[tuple[str, ...], Path] = {}

    def recalled(self, games: Iterable[Game]) -> dict[Game, tuple[Ended, ...]]:
        """Those of the games that are done."""
        known: dict[tuple[str, ...], dict[int, tuple[Ended, ...]]] = {}
        found = {}
        for game in games:
            if game.bots not in known:
                known[game.bots] = self._lines(game.bots)
            if (ended := known[game.bots].get(game.seed)) is not None:
                found[game] = ended
        return found

    def _lines(self, bots: tuple[str, ...]) -> dict[int, tuple[Ended, ...]]:
        try:
            text = self._place(bots).read_text(encoding="utf-8", errors="replace")
        except FileNotFoundError:
            return {}
        except OSError as error:
            self._fail("read", error)
            return {}
        read = (_read(line, len(bots)) for line in text.splitlines())
        return dict(pair for pair in read if pair is not None)

    def keep(self, game: Game, ended: tuple[Ended, ...]) -> None:
        """Keep how a game ended."""
        if not self.working:
            return
        line = json.dumps({"seed": game.seed, "ended": [asdict(each) for each in ended]})
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with self._place(game.bots).open("ab+") as file:
                if file.tell() and (file.seek(-1, 2), file.read(1))[1] != b"\n":
                    line = f"\n{line}"  # after a torn one
                file.write(f"{line}\n".encode())
        except OSError as error:
            self._fail("write", error)

    def _place(self, bots: tuple[str, ...]) -> Path:
        """The file of a line-up."""
        if bots not in self._places:
            decisive = [_engine(), *self._field, *(self._texts[bot] for bot in bots)]
            name = sha256(json.dumps(decisive).encode()).hexdigest()
            self._places[bots] = self.folder / f"{name[:32]}.jsonl"
        return self._places[bots]

    def _fail(self, what: str, error: OSError) -> None:
        if self.working:
            why = reason(error, self.folder)
            click.echo(f"Warning: games are not kept: cannot {what} {why}", err=True)
        self.working = False


def _read(line: str, ships: int) -> tuple[int, tuple[Ended, ...]] | None:
    """The seed of a line, and how its game ended; None if it is no line of a game with so many ships."""
    try:
        record = json.loads(line)
    except (ValueError, RecursionError):
        return None
    match record:
        case {"seed": int(seed), "ended": list(rows)} if len(rows) == ships:
            ended = tuple(each for row in rows if (each := _ended(row)) is not None)
            return (seed, ended) if len(ended) == ships else None
    return None


def _ended(row: Any) -> Ended | None:
    match row:
        case {
            "outcome": str(outcome),
            "time": float(time),
            "fuel": int(fuel),
            "stopped": str() | None as stopped,
        } if outcome in _OUTCOMES and 0.0 <= time < inf and fuel >= 0:
            return Ended(outcome, time, fuel, stopped)  # type: ignore[arg-type]  # just looked up
    return None


@cache
def _engine() -> str:
    """A digest of what plays: this package's own source, the Python that runs it, the kind of machine and its libm.

    Sines differ between libraries of mathematics in their last bits, and a folder may be shared by several machines.
    """
    what = sys.version, platform.system(), platform.machine(), platform.libc_ver()
    digest = sha256(repr(what).encode())
    for name, data in sorted(_sources(files("fasteroids"), "")):
        digest.update(f"\0{name}\0{len(data)}\0".encode() + data)
    return digest.hexdigest()


def _sources(folder: Traversable, path: str) -> Iterable[tuple[str, bytes]]:
    for each in folder.iterdir():
        if each.is_dir():
            yield from _sources(each, f"{path}{each.name}/")
        elif each.name.endswith(".py"):
            yield path + each.name, each.read_bytes()
