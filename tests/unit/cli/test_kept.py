"""Games kept in a folder: found again as they were, and never wrongly."""

from __future__ import annotations

import errno
import io
import json
import os
import platform
from pathlib import Path

import platformdirs
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.arena import Ended, Game
from fasteroids.cli import _kept
from fasteroids.cli._kept import Kept, usual_folder

TEXTS = {"a": "skip;", "b": "fire;", "c": "skip; // another"}
FIELD = ("[world]", None, 120.0)
CLEARED, DIED = Ended("cleared", 0.1 + 0.2), Ended("died", 5.0, 3, "line 2: getx null: e is null")


def kept(folder: Path, field: tuple[object, ...] = FIELD, **texts: str) -> Kept:
    return Kept(folder, field, {**TEXTS, **texts})


def only(folder: Path) -> Path:
    """The one file of a folder."""
    (place,) = folder.iterdir()
    return place


def test_games_are_found_again_as_they_were(tmp_path: Path) -> None:
    alone, duel = Game(("a",), 3), Game(("a", "b"), 3)
    first = kept(tmp_path / "new" / "folder")
    first.keep(alone, (CLEARED,))
    first.keep(duel, (Ended("won", 5.0), DIED))
    again = kept(tmp_path / "new" / "folder")
    others = [Game(("a",), 4), Game(("b",), 3), Game(("b", "a"), 3)]
    assert again.recalled([alone, duel, *others]) == {
        alone: (CLEARED,), duel: (Ended("won", 5.0), DIED),
    }  # fmt: skip
    assert again.working


@given(st.floats(0.0, 1e9), st.integers(0, 10**6), st.none() | st.text())
def test_every_ending_comes_back(time: float, fuel: int, stopped: str | None) -> None:
    ended = Ended("timed out", time, fuel, stopped)
    line = json.dumps(
        {
            "seed": 7,
            "ended": [{"outcome": "timed out", "time": time, "fuel": fuel, "stopped": stopped}],
        }
    )
    assert _kept._read(line, 1) == (7, (ended,))
    assert _kept._read(line, 2) is None


@pytest.mark.parametrize(
    "other", [("[world] ", None, 120.0), ("[world]", "spec", 120.0), ("[world]", None, 60.0)]
)
def test_another_field_model_or_limit_finds_nothing(
    tmp_path: Path, other: tuple[object, ...]
) -> None:
    kept(tmp_path).keep(Game(("a",), 3), (CLEARED,))
    assert kept(tmp_path, other).recalled([Game(("a",), 3)]) == {}


def test_a_changed_program_finds_nothing_but_another_name_does(tmp_path: Path) -> None:
    kept(tmp_path).keep(Game(("a", "b"), 3), (CLEARED, DIED))
    assert kept(tmp_path, b="thrust;").recalled([Game(("a", "b"), 3)]) == {}
    renamed = Game(("x", "b"), 3)
    assert kept(tmp_path, x=TEXTS["a"]).recalled([renamed]) == {renamed: (CLEARED, DIED)}


def test_a_changed_engine_finds_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept(tmp_path).keep(Game(("a",), 3), (CLEARED,))
    monkeypatch.setattr(_kept, "_engine", lambda: "another")
    assert kept(tmp_path).recalled([Game(("a",), 3)]) == {}


def test_every_source_of_the_package_counts(tmp_path: Path) -> None:
    package = Path(_kept.__file__).parents[1]
    names = {name for name, _ in _kept._sources(package, "")}
    assert names == {path.relative_to(package).as_posix() for path in package.rglob("*.py")}
    (tmp_path / "lang").mkdir()
    (tmp_path / "lang" / "words.py").write_bytes(b"1")
    (tmp_path / "py.typed").write_bytes(b"")
    assert list(_kept._sources(tmp_path, "")) == [("lang/words.py", b"1")]


@pytest.mark.parametrize("cut", [1, 2, 20, 60])
def test_a_torn_last_line_is_dropped_and_the_next_one_is_whole(tmp_path: Path, cut: int) -> None:
    first = kept(tmp_path)
    games = [Game(("a",), seed) for seed in range(4)]
    for game in games[:3]:
        first.keep(game, (CLEARED,))
    place = only(tmp_path)
    place.write_bytes(place.read_bytes()[:-cut])
    found = kept(tmp_path).recalled(games)
    assert set(found) == set(games[: 3 if cut == 1 else 2])  # without its end a line is still whole
    kept(tmp_path).keep(games[3], (DIED,))
    assert kept(tmp_path).recalled(games) == {**found, games[3]: (DIED,)}


@pytest.mark.parametrize(
    "line",
    [
        "", "null", "[]", "{}", "7", "\ud800".encode(errors="surrogatepass").decode("latin-1"), "[" * 100_000,
        '{"seed": 3}', '{"seed": "3", "ended": []}', '{"seed": 3, "ended": []}', '{"seed": 3, "ended": [null]}',
        '{"seed": 3, "ended": [{"outcome": "eaten", "time": 1.0, "fuel": 0, "stopped": null}]}',
        '{"seed": 3, "ended": [{"outcome": "died", "time": NaN, "fuel": 0, "stopped": null}]}',
        '{"seed": 3, "ended": [{"outcome": "died", "time": Infinity, "fuel": 0, "stopped": null}]}',
        '{"seed": 3, "ended": [{"outcome": "died", "time": -1.0, "fuel": 0, "stopped": null}]}',
        '{"seed": 3, "ended": [{"outcome": "died", "time": 1.0, "fuel": -1, "stopped": null}]}',
        '{"seed": 3, "ended": [{"outcome": "died", "time": 1.0, "fuel": 0, "stopped": 5}]}',
        '{"seed": 3, "ended": [{"outcome": "died", "time": 1.0, "fuel": 0}]}',
    ],
)  # fmt: skip
def test_lines_of_another_shape_are_passed_over(tmp_path: Path, line: str) -> None:
    games = [Game(("a",), 3), Game(("a",), 4)]
    kept(tmp_path).keep(games[1], (CLEARED,))
    place = only(tmp_path)
    place.write_text(f"{line}\n{place.read_text()}{line}\n", encoding="utf-8")
    assert kept(tmp_path).recalled(games) == {games[1]: (CLEARED,)}


def test_bytes_that_are_no_text_are_passed_over(tmp_path: Path) -> None:
    game = Game(("a",), 3)
    kept(tmp_path).keep(game, (CLEARED,))
    place = only(tmp_path)
    place.write_bytes(b"\xff\xfe\n" + place.read_bytes())
    assert kept(tmp_path).recalled([game]) == {game: (CLEARED,)}


def test_a_later_line_counts(tmp_path: Path) -> None:
    game = Game(("a",), 3)
    for ended in (CLEARED, DIED):
        kept(tmp_path).keep(game, (ended,))
    assert kept(tmp_path).recalled([game]) == {game: (DIED,)}


def test_a_folder_that_is_none_is_told_of_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / "file"
    place.write_text("mine")
    games = kept(place)
    for seed in range(3):
        games.keep(Game(("a",), seed), (CLEARED,))
    assert not games.working
    assert capsys.readouterr().err == (
        f"Warning: games are not kept: cannot write {str(place)!r}: File exists\n"
    )
    assert kept(place).recalled([Game(("a",), 3)]) == {}
    assert "Warning: games are not kept: cannot read" in capsys.readouterr().err
    assert place.read_text() == "mine"


def test_a_full_disk_is_told_of_with_its_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The error of a write does not know the file."""
    monkeypatch.setattr(Path, "open", lambda *_, **__: Full())
    games = kept(tmp_path)
    games.keep(Game(("a",), 3), (CLEARED,))
    assert not games.working
    assert capsys.readouterr().err == (
        f"Warning: games are not kept: cannot write {str(tmp_path)!r}: No space left on device\n"
    )


class Full(io.BytesIO):
    """A file on a disk that is full."""

    def write(self, _: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_games_of_another_machine_or_libm_are_not_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Sines may differ in their last bits."""
    game = Game(("a",), 3)
    kept(tmp_path).keep(game, (CLEARED,))
    for what, value in (("machine", "abacus"), ("libc_ver", ("glibc", "0.1"))):
        with monkeypatch.context() as patch:
            patch.setattr(platform, what, lambda value=value: value)
            _kept._engine.cache_clear()
            assert kept(tmp_path).recalled([game]) == {}
    _kept._engine.cache_clear()
    assert kept(tmp_path).recalled([game]) == {game: (CLEARED,)}


def test_the_usual_folder_is_in_the_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: tmp_path / name)
    assert usual_folder() == tmp_path / "fasteroids" / "arena"
