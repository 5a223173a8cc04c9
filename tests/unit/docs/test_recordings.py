"""docs/recordings.md: every command on it says what stands below it, in one folder from top to bottom."""

from __future__ import annotations

import doctest
import json
import re
import shlex
from collections.abc import Iterator
from importlib import import_module
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from fasteroids.cli import main

PAGE = (Path(__file__).parents[3] / "docs" / "recordings.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def blocks(language: str) -> list[str]:
    return [body for each, body in BLOCKS if each == language]


def commands() -> Iterator[tuple[str, str]]:
    """The commands of the page, each with what stands below it."""
    for block in blocks("console"):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, told = part.partition("\n")
            yield command, told


def fits(said: str, text: str) -> bool:
    """Is a text what the page says, where "..." stands for anything on one line?"""
    return bool(re.fullmatch(re.escape(said).replace(re.escape("..."), "[^\n]*"), text))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the scene of the page, in which its commands were run."""
    monkeypatch.chdir(tmp_path)
    [scene] = blocks("toml")
    Path("game.toml").write_text(scene, encoding="utf-8")
    return tmp_path


def test_the_commands_say_what_the_page_says(folder: Path) -> None:
    for command, said in commands():
        name, *args = shlex.split(command)
        assert name == "fasteroids"
        shown = CliRunner().invoke(main, args)
        assert fits(said, shown.output), f"$ {command}\n{shown.output}"


@pytest.fixture
def game(folder: Path) -> Path:
    command, _ = next(commands())
    assert CliRunner().invoke(main, shlex.split(command)[1:]).exit_code == 0
    return folder / "game.jsonl"


def test_the_lines_shown_are_lines_of_the_recording(game: Path) -> None:
    lines = game.read_text().splitlines()
    [shown] = blocks("json")
    for said in shown.splitlines():
        assert any(fits(said, line) for line in lines), said


def test_the_code_gives_what_the_page_says(game: Path) -> None:
    names: dict[str, object] = {}
    for code in blocks("pycon"):
        test = doctest.DocTestParser().get_doctest(code, names, "recordings.md", None, None)
        told: list[str] = []
        failed, tried = doctest.DocTestRunner(verbose=False).run(
            test, out=told.append, clear_globs=False
        )
        assert (failed, tried > 0) == (0, True), "".join(told)
        names = test.globs


def test_duckdb_and_pandas_read_a_packed_recording_too(game: Path) -> None:
    duckdb: Any = import_module("duckdb")
    pandas: Any = import_module("pandas")
    packed = "packed.jsonl.gz"
    args = ["record", "game.toml", "--for", "4", "-o", packed]
    assert CliRunner().invoke(main, args).exit_code == 0
    count = game.read_text().count('"type":"event"')
    found = duckdb.read_json(packed, format="newline_delimited", sample_size=-1)  # noqa: F841
    assert duckdb.sql("SELECT count(*) FROM found WHERE type = 'event'").fetchall() == [(count,)]
    frame = pandas.read_json(packed, lines=True)
    assert (frame.type == "event").sum() == count


def test_the_table_names_the_fields_of_the_schema() -> None:
    schema = json.loads(
        (files("fasteroids") / "history/recording/schema.json").read_text(encoding="utf-8")
    )
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", PAGE, re.MULTILINE))
    assert list(rows) == [each["$ref"].rpartition("/")[2] for each in schema["oneOf"]]
    for kind, row in rows.items():
        told = schema["$defs"][kind]
        fields = set(told["properties"]) - {"type"}
        for each in told.get("oneOf", []):
            fields |= set(each["properties"])
        assert set(re.findall(r"`([\w-]+)`", row)) == fields, kind
