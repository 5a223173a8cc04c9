"""The user's files: scores that survive, settings that are told of."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fasteroids.tui._store import Store, config_file, data_folder
from fasteroids.tui.keys import Command
from fasteroids.tui.scores import EMPTY, Score, best, table_of
from fasteroids.tui.settings import DEFAULTS, Settings

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def told() -> list[str]:
    return []


@pytest.fixture
def store(told: list[str], tmp_path: Path) -> Store:
    return new(told, tmp_path)


def new(told: list[str], folder: Path) -> Store:
    """As another start of the game has it."""
    return Store(told.append, folder=folder / "data", config=folder / "config" / "config.toml")


def test_scores_are_there_at_the_next_start(store: Store, told: list[str], tmp_path: Path) -> None:
    assert store.scores() == EMPTY
    table = store.enter(Score("one", "Ada", 50, date="2026-11-25", recording="a.jsonl"))
    assert new(told, tmp_path).scores() == table
    assert told == []
    assert sorted(path.name for path in (tmp_path / "data").iterdir()) == [
        "scores.json",
        "scores.lock",
    ]


def test_a_row_that_another_game_entered_meanwhile_is_kept(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    store.scores()
    new(told, tmp_path).enter(Score("one", "Bob", 70))
    table = store.enter(Score("one", "Ada", 50))
    assert [row.name for row in best(table, "one")] == ["Bob", "Ada"]
    assert new(told, tmp_path).scores() == table


def test_processes_that_write_at_once_lose_no_row(told: list[str], tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from fasteroids.tui._store import Store; "
        "from fasteroids.tui.scores import Score\n"
        "store = Store(print, folder=Path(sys.argv[1]) / 'data', config=Path(sys.argv[1]) / 'c')\n"
        "print('ready', flush=True); sys.stdin.read()\n"
        "for i in range(40): store.enter(Score(f'{sys.argv[2]} {i}', 'Ada', i))"
    )
    writers = [
        subprocess.Popen(
            [sys.executable, "-c", code, str(tmp_path), str(number)],
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for number in range(3)
    ]
    for writer in writers:
        assert writer.stdout is not None
        assert writer.stdout.readline() == "ready\n"
    for writer in writers:
        assert writer.stdin is not None
        writer.stdin.close()
    for writer in writers:
        assert writer.stdout is not None
        assert writer.stdout.read() == ""
        writer.stdout.close()
        assert writer.wait(60) == 0
    assert len(new(told, tmp_path).scores().rows) == 120
    assert told == []


def test_a_damaged_file_is_told_of_kept_aside_and_its_rows_are_saved(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    store.enter(Score("one", "Ada", 50))
    store.enter(Score("one", "Bob", 40))
    place = tmp_path / "data" / "scores.json"
    damaged = place.read_bytes().replace(b"Bob", b"B\xff\x00")[:-20]
    place.write_bytes(damaged)

    again = new(told, tmp_path)
    assert [row.name for row in again.scores().rows] == ["Ada"]
    assert told == [f"the file of scores is damaged; 1 could be read: {place}"]
    assert place.read_bytes() == damaged  # looking changes nothing
    again.enter(Score("one", "Cy", 30))
    assert place.with_name("scores.json.damaged").read_bytes() == damaged
    assert not table_of(place.read_text(encoding="utf-8")).damaged
    assert [row.name for row in new(told, tmp_path).scores().rows] == ["Ada", "Cy"]
    assert len(told) == 1


def test_a_file_of_which_nothing_can_be_read_is_told_of_in_words(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    place = tmp_path / "data" / "scores.json"
    place.parent.mkdir()
    place.write_bytes(b"rubbish")
    assert store.scores().rows == ()
    assert told == [f"the file of scores is damaged; none could be read: {place}"]


def test_an_older_file_kept_aside_stays(store: Store, tmp_path: Path) -> None:
    place = tmp_path / "data" / "scores.json"
    place.parent.mkdir()
    for rubbish in (b"first", b"second", b"third"):
        place.write_bytes(rubbish)
        store.enter(Score("one", "Ada", 1))
    aside = [f"scores.json.damaged{end}" for end in ("", "-2", "-3")]
    assert [place.with_name(name).read_bytes() for name in aside] == [b"first", b"second", b"third"]


def test_a_folder_that_cannot_be_made_is_told_of_once_and_the_game_goes_on(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    (tmp_path / "data").write_text("a file where the folder should be")
    store.enter(Score("one", "Ada", 50))
    table = store.enter(Score("one", "Bob", 70))
    assert [row.name for row in table.rows] == ["Bob", "Ada"]
    assert store.scores() == table
    assert len([sentence for sentence in told if sentence.startswith("scores are not kept: ")]) == 1


def test_rows_that_could_not_be_written_are_written_once_that_is_possible(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    (tmp_path / "data").write_text("in the way")
    store.enter(Score("one", "Ada", 50))
    (tmp_path / "data").unlink()
    table = store.enter(Score("one", "Bob", 70))
    assert new([], tmp_path).scores() == table
    assert [row.name for row in table.rows] == ["Bob", "Ada"]


def test_a_file_that_cannot_be_replaced_is_left_as_it_was(
    store: Store, told: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store.enter(Score("one", "Ada", 50))
    place = tmp_path / "data" / "scores.json"
    before = place.read_bytes()

    def full(handle: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    store.enter(Score("one", "Bob", 70))
    assert place.read_bytes() == before
    assert told == [f"scores are not kept: {place}: No space left on device"]
    assert len(list(place.parent.iterdir())) == 2


def test_a_link_to_the_scores_stays_a_link(store: Store, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere.json"
    elsewhere.write_text("")
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "scores.json").symlink_to(elsewhere)
    store.enter(Score("one", "Ada", 50))
    assert (tmp_path / "data" / "scores.json").is_symlink()
    assert "Ada" in elsewhere.read_text()


def test_a_folder_in_place_of_a_file_is_told_of(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    (tmp_path / "data" / "scores.json").mkdir(parents=True)
    (tmp_path / "config" / "config.toml").mkdir(parents=True)
    assert store.scores() == EMPTY
    assert store.settings() == DEFAULTS
    assert told == [
        f"scores cannot be read: {tmp_path / 'data' / 'scores.json'}: not a file",
        f"settings cannot be read: {tmp_path / 'config' / 'config.toml'}: not a file",
    ]


# Settings.


def test_without_a_file_there_are_the_defaults_and_nothing_is_said(
    store: Store, told: list[str]
) -> None:
    assert store.settings() == DEFAULTS
    assert told == []


def test_settings_are_there_at_the_next_start(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    settings = Settings(arena="block", fps=60, sound=False)
    assert store.keep(settings)
    assert new(told, tmp_path).settings() == settings
    assert told == []


def test_what_is_wrong_in_the_file_is_told_and_the_rest_is_used(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    place = tmp_path / "config" / "config.toml"
    place.parent.mkdir()
    place.write_text('fps = 0\nsound = false\n[keys]\nmute = ["u"]\n')
    settings = store.settings()
    assert (settings.fps, settings.sound) == (30, False)
    assert settings.keymap.command("u") is Command.MUTE
    assert told == ["config.toml: line 1: fps = 0: must be an integer from 1 to 120"]
    store.settings()
    assert len(told) == 1


def test_a_file_with_comments_stays_beside_the_one_that_is_written(
    store: Store, tmp_path: Path
) -> None:
    place = tmp_path / "config" / "config.toml"
    old = place.with_name("config.toml.old")
    assert store.keep(Settings(fps=60))
    assert store.keep(Settings(fps=50))
    assert not old.exists()
    place.write_text("fps = 40 # as my screen\n")
    assert store.keep(Settings(fps=50))
    assert store.keep(Settings(fps=30))
    assert old.read_text() == "fps = 40 # as my screen\n"
    assert store.settings().fps == 30


def test_a_file_that_is_no_text_is_told_of(store: Store, told: list[str], tmp_path: Path) -> None:
    place = tmp_path / "config" / "config.toml"
    place.parent.mkdir()
    place.write_bytes(b"fps = 60 # \xff")
    assert store.settings() == DEFAULTS
    assert told == [f"settings cannot be read: {place} is not text in UTF-8"]


def test_settings_that_cannot_be_kept_are_told_of(
    store: Store, told: list[str], tmp_path: Path
) -> None:
    (tmp_path / "config").write_text("in the way")
    assert store.keep(DEFAULTS) is False
    assert len(told) == 1
    assert told[0].startswith("settings are not kept: ")


def test_the_files_are_in_the_users_folders(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    assert data_folder().is_relative_to(tmp_path)
    assert data_folder().name == "fasteroids"
    assert config_file().is_relative_to(tmp_path)
    assert config_file().parts[-2:] == ("fasteroids", "config.toml")
