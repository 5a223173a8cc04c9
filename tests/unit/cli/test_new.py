"""`fasteroids new`: programs and scenes to start from."""

from __future__ import annotations

import errno
import io
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

import pytest
from click.testing import Result
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import load_scene
from fasteroids.cli._guard import Refusal
from fasteroids.cli.new import MOST_CHARACTERS, _check
from fasteroids.lang import diagnose

Call = Callable[..., Result]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to be in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def contents(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text("utf-8") for path in folder.iterdir()}


# What is written.


def test_a_bot_is_a_program_without_faults(call: Call, folder: Path) -> None:
    shown = call("new", "bot", "hunter")
    assert (shown.exit_code, shown.stdout) == (0, "")
    [(name, text)] = contents(folder).items()
    assert name == "hunter.ast"
    assert text.startswith("// hunter: ")
    assert "$" not in text
    assert diagnose(text) == ()
    checked = call("check", "hunter.ast")
    assert (checked.exit_code, checked.stderr) == (0, "hunter.ast: no errors\n")


def test_a_bot_is_in_the_normal_form_and_free_of_warnings(call: Call) -> None:
    call("new", "bot", "hunter")
    assert call("fmt", "--check", "hunter.ast").exit_code == 0
    assert call("check", "--strict", "hunter.ast").exit_code == 0


def test_a_scene_without_a_program_beside_it_holds_one_and_runs(call: Call, folder: Path) -> None:
    shown = call("new", "scene", "field")
    assert (shown.exit_code, shown.stdout) == (0, "")
    [(name, text)] = contents(folder).items()
    assert name == "field.toml"
    assert text.startswith("# field: ")
    assert "$" not in text
    assert "program-text = '''" in text
    ran = call("run", "field.toml", "--for", "10")
    assert ran.exit_code == 0, ran.stderr
    assert "field fires" in ran.stdout
    assert "field turns" in ran.stdout


def test_a_scene_beside_a_program_names_it_and_runs(call: Call, folder: Path) -> None:
    call("new", "bot", "hunter")
    assert call("new", "scene", "hunter").exit_code == 0
    text = contents(folder)["hunter.toml"]
    assert '\nprogram = "hunter.ast"\n' in text
    assert "program-text" not in text
    ran = call("run", "hunter.toml", "--for", "10")
    assert ran.exit_code == 0, ran.stderr
    assert "hunter fires" in ran.stdout
    assert "hunter: " in ran.stdout  # it prints
    assert "stop" not in ran.stdout


def test_a_folder_with_the_name_of_a_program_is_none(call: Call, folder: Path) -> None:
    (folder / "field.ast").mkdir()
    assert call("new", "scene", "field").exit_code == 0
    assert "program-text" in (folder / "field.toml").read_text("utf-8")


def test_the_bot_hits_asteroids(call: Call, folder: Path) -> None:
    call("new", "bot", "hunter")
    call("new", "scene", "hunter")
    text = contents(folder)["hunter.toml"]
    world = load_scene(text, read=lambda name: (folder / name).read_bytes())
    assert len(world.asteroids) == 6
    ran = call("run", "hunter.toml", "--for", "60")
    assert ran.stdout.splitlines()[-1].endswith("1 ship left")


# What is said.


def test_the_commands_that_are_said_work_in_their_order(call: Call, folder: Path) -> None:
    said = call("new", "bot", "hunter").stderr.splitlines()
    assert said[0] == "Wrote hunter.ast. Next:"
    assert len(said) == 5
    for line in said[1:]:
        program, *args = line.split()
        assert program == "fasteroids"
        shown = call(*args)
        assert shown.exit_code == 0, shown.stderr


def test_after_a_scene_it_can_be_run_and_traced(call: Call) -> None:
    said = call("new", "scene", "field").stderr.splitlines()
    assert [line.split()[1] for line in said[1:]] == ["run", "trace"]
    for line in said[1:]:
        assert call(*line.split()[1:]).exit_code == 0


def test_a_bot_beside_its_scene_is_to_be_put_into_it(call: Call) -> None:
    call("new", "scene", "field")
    said = call("new", "bot", "field").stderr
    assert 'put program = "field.ast" under a ship in field.toml' in said
    assert "new scene" not in said


# Files that are there.


@pytest.mark.parametrize(("kind", "file"), [("bot", "mine.ast"), ("scene", "mine.toml")])
def test_nothing_is_written_over_unless_forced(
    call: Call, folder: Path, kind: str, file: str
) -> None:
    (folder / file).write_text("mine")
    shown = call("new", kind, "mine")
    assert shown.exit_code == 2
    assert shown.stderr == f"Error: {file!r} is there already; --force writes over it\n"
    assert contents(folder) == {file: "mine"}
    assert call("new", kind, "mine", "--force").exit_code == 0
    forced = contents(folder).pop(file)
    (folder / file).unlink()
    call("new", kind, "mine")
    assert contents(folder) == {file: forced}


def test_force_writes_what_is_not_there_too(call: Call, folder: Path) -> None:
    assert call("new", "bot", "mine", "--force").exit_code == 0
    assert [*contents(folder)] == ["mine.ast"]


@pytest.mark.parametrize("force", [[], ["--force"]])
def test_a_folder_in_the_way_stays(call: Call, folder: Path, force: list[str]) -> None:
    (folder / "mine.ast").mkdir()
    shown = call("new", "bot", "mine", *force)
    assert shown.exit_code == 2
    assert shown.stderr.startswith("Error: ")
    assert shown.stderr.count("\n") == 1
    assert (folder / "mine.ast").is_dir()


def test_a_link_to_nowhere_is_not_followed(call: Call, folder: Path) -> None:
    (folder / "mine.ast").symlink_to(folder / "elsewhere")
    assert call("new", "bot", "mine").exit_code == 2
    assert not (folder / "elsewhere").exists()


class Full(io.BytesIO):
    """A file on a full disk."""

    def flush(self) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    def close(self) -> None:
        pass


def test_a_file_that_cannot_be_written_whole_is_not_left(
    call: Call, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = Path.open

    def full(path: Path, mode: str = "r", **rest: Any) -> IO[Any]:
        opened = real(path, mode, **rest)
        if mode != "xb":
            return opened
        opened.close()
        return Full()

    monkeypatch.setattr(Path, "open", full)
    shown = call("new", "bot", "mine")
    assert shown.exit_code == 2
    assert shown.stderr == "Error: cannot write 'mine.ast': No space left on device\n"
    assert contents(folder) == {}


@pytest.mark.parametrize("force", [[], ["--force"]])
def test_a_folder_that_is_gone_is_a_sentence(call: Call, folder: Path, force: list[str]) -> None:
    folder.rmdir()
    shown = call("new", "bot", "mine", *force)
    assert shown.exit_code == 2
    assert "No such file or directory" in shown.stderr


# Names.


@pytest.mark.parametrize(
    "name",
    ["", " ", "2x", "-", "_x", "a b", "a/b", "../a", "/tmp/a", "a\\b", "größe", "a.b", "a\n", "a'"],
)
@pytest.mark.parametrize("kind", ["bot", "scene"])
def test_a_name_is_letters_digits_and_dashes(
    call: Call, folder: Path, kind: str, name: str
) -> None:
    shown = call("new", kind, "--", name)
    assert shown.exit_code == 2
    assert "a name is a letter from a to z" in shown.stderr
    assert contents(folder) == {}


@pytest.mark.parametrize("name", ["hunter.ast", "hunter.toml"])
def test_a_name_goes_without_its_ending(call: Call, folder: Path, name: str) -> None:
    shown = call("new", "bot", name)
    assert shown.exit_code == 2
    assert "give the name without its ending: 'hunter'" in shown.stderr
    assert contents(folder) == {}


@pytest.mark.parametrize("name", ["con", "NUL", "com1", "a" * (MOST_CHARACTERS + 1)])
def test_a_name_fits_every_system(call: Call, folder: Path, name: str) -> None:
    assert call("new", "scene", name).exit_code == 2
    assert contents(folder) == {}


@given(name=st.text())
def test_any_name_is_refused_or_that_of_a_plain_file(name: str) -> None:
    with suppress(Refusal):
        _check(name)
        assert name.isascii()
        assert Path(name).name == name


def test_the_longest_name_works(call: Call) -> None:
    name = "a" * MOST_CHARACTERS
    assert call("new", "scene", name).exit_code == 0
    assert call("run", f"{name}.toml", "--for", "1").exit_code == 0


@pytest.mark.parametrize("args", [[], ["bot"], ["bird", "x"], ["bot", "x", "y"]])
def test_usage_errors_write_nothing(call: Call, folder: Path, args: list[str]) -> None:
    shown = call("new", *args)
    assert shown.exit_code == 2
    assert "Usage:" in shown.stderr
    assert contents(folder) == {}
