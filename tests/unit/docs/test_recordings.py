"""docs/recordings.md: its lines run on a file, and it tells of every kind of line and of no field that there is not."""

from __future__ import annotations

import gzip
import json
import pathlib
import re
from collections import Counter
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

import fasteroids.history.recording

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "recordings.md").read_text(encoding="utf-8")
CODE = re.findall(r"^```python\n(.*?)\n```$", PAGE, re.DOTALL | re.MULTILINE)
FILE = ROOT / "tests" / "golden" / "recording-format-1.jsonl"
SCHEMA = json.loads(
    (files("fasteroids.history.recording") / "schema.json").read_text(encoding="utf-8")
)


@pytest.fixture(params=["game.jsonl", "game.jsonl.gz"])
def place(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A recording in the folder that the page means."""
    name: str = request.param
    data = FILE.read_bytes()
    (tmp_path / name).write_bytes(gzip.compress(data) if name.endswith("gz") else data)
    monkeypatch.chdir(tmp_path)
    return name


def effects() -> Counter[str]:
    records = map(json.loads, FILE.read_text(encoding="utf-8").splitlines())
    return Counter(record["effect"] for record in records if record["type"] == "event")


def ran(number: int, place: str, **names: Any) -> Any:
    """The value of a block of code on the page."""
    return eval(CODE[number].replace("game.jsonl", place), names)


def test_duckdb_reads_it_by_one_line(place: str) -> None:
    duckdb = pytest.importorskip("duckdb")
    assert dict(ran(0, place, duckdb=duckdb).fetchall()) == effects()


def test_pandas_reads_it_by_one_line(place: str) -> None:
    pandas = pytest.importorskip("pandas")
    assert ran(1, place, pandas=pandas).to_dict() == effects()


def test_python_reads_it_by_one_line(place: str) -> None:
    lines = ran(2, place, fasteroids=fasteroids, pathlib=pathlib)
    assert len(lines) == FILE.read_text(encoding="utf-8").count("\n") - 1


def test_the_page_names_every_kind_of_line_and_only_fields_that_there_are() -> None:
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", PAGE, re.MULTILINE))
    kinds = {ref["$ref"].rpartition("/")[2] for ref in SCHEMA["oneOf"]}
    assert rows.keys() == kinds
    for kind, text in rows.items():
        definition = json.dumps(SCHEMA["$defs"][kind])
        for word in re.findall(r"`(\w+)`", text):
            assert f'"{word}"' in definition
