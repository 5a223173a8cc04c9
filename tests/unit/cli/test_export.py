"""`fasteroids export`: tables and scenes of a recording."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import duckdb
import pytest
from click.testing import Result

from fasteroids import Asteroid, Fire, evolve_until, load_scene
from fasteroids.cli._tables import TABLES, Tables, worlds
from fasteroids.history import begin
from fasteroids.history.recording import Event, Recording, read
from fasteroids.history.recording.loading import recorded
from tests.unit.cli.conftest import PATIENCE, SCENE

Call = Callable[..., Result]
Spawn = Callable[..., "subprocess.Popen[bytes]"]


@pytest.fixture
def opened(recording: str) -> Recording:
    return read(Path(recording).read_bytes())


@pytest.fixture
def rich(tmp_path: Path) -> str:
    """A recording with lines of every kind."""
    program = "program-text = 'print 1 / 3; print self; while (true) { fire; }'"
    world = load_scene(SCENE.replace('name = "blue"', f'name = "blue"\n{program}'))
    timeline = begin(world).evolve_until(0.1).act(1, Fire()).bookmark('a, "b"\nc')
    timeline = timeline.evolve_until(5.0).remove(2).evolve_until(12.0)
    place = tmp_path / "rich.jsonl"
    place.write_text(recorded(timeline, title="rich"))
    return str(place)


def rows_of(place: str, name: str, every: float = 1.0) -> list[tuple[Any, ...]]:
    recording = read(Path(place).read_bytes())
    return list(Tables(recording, "title", every).rows(name))


def as_text(cell: object) -> str:
    if isinstance(cell, bool):
        return str(cell).lower()
    return "" if cell is None else repr(cell) if isinstance(cell, float) else str(cell)


# Tables.


def test_the_rows_of_events_are_the_events(recording: str, opened: Recording) -> None:
    happened = [line.happened for line in opened.lines if isinstance(line, Event)]
    rows = [dict(zip(TABLES["events"], row, strict=True)) for row in rows_of(recording, "events")]
    assert len(rows) == len(happened)
    lines = Path(recording).read_text().splitlines()
    for row, h in zip(rows, happened, strict=True):
        assert (row["time"], row["kind"], row["effect"]) == (h.time, h.kind, h.effect)
        assert (row["entity"], row["other"]) == (*h.entities, None)[:2]
        assert row["died"] == (" ".join(map(str, h.died)) or None)
        assert (row["x"], row["y"]) == (h.at or (None, None))
        assert json.loads(lines[row["line"] - 1])["time"] == row["time"]


def test_the_rows_of_states_are_the_worlds(recording: str, opened: Recording) -> None:
    rows = [
        dict(zip(TABLES["states"], row, strict=True)) for row in rows_of(recording, "states", 7)
    ]
    found = [(row["time"], row["id"], row["x"], row["vy"], row["radius"]) for row in rows]
    expected = []
    for at in (0.0, 7.0, 14.0, 20.0):
        world = evolve_until(opened.world, at)
        expected += [(at, e.id, e.x, e.vy, e.radius) for e in world.entities.values()]
    assert found == expected


@pytest.mark.parametrize("every", [0.1, 0.2, 1.0, 3.3, 100.0])
def test_worlds_are_had_at_each_multiple_after_all_that_happened_then(
    opened: Recording, every: float
) -> None:
    found = list(worlds(opened, every))
    times = [0.0, *(k * every for k in range(1, int(20 / every) + 1) if k * every < 20), 20.0]
    assert [world.time for world in found] == times
    assert found == [evolve_until(opened.world, at) for at in times]


def test_looking_is_no_cut_of_what_comes_later(call: Call, tmp_path: Path) -> None:
    """Under literal thrust a cut changes the future."""
    out = str(tmp_path / "out")
    assert call("record", "thrust", "--model", "robust", "-o", out).exit_code == 0
    opened = read(Path(out).read_bytes())
    *_, last = worlds(opened, 0.7)
    assert last == opened.at(opened.until)


def test_every_kind_of_line_has_its_rows(rich: str) -> None:
    counts = {name: len(rows_of(rich, name)) for name in TABLES}
    assert all(counts.values()), counts
    assert [row[2:] for row in rows_of(rich, "prints")] == [
        (2, "0.3333333333333333"),
        (2, "ship 2"),
    ]
    assert [row[3] for row in rows_of(rich, "bookmarks")] == ['a, "b"\nc']
    kinds = [(row[3], row[4]) for row in rows_of(rich, "inputs") if row[3] != "cut"]
    assert kinds == [("act", 1), ("remove", 2)]


# CSV.


@pytest.mark.parametrize("name", TABLES)
def test_csv_has_a_head_and_brings_every_number_back(
    call: Call, rich: str, tmp_path: Path, name: str
) -> None:
    out = tmp_path / "out.csv"
    shown = call("export", rich, "--to", "csv", "--table", name, "-o", str(out))
    assert shown.exit_code == 0
    expected = rows_of(rich, name)
    count = "1 row" if len(expected) == 1 else f"{len(expected)} rows"
    assert shown.stderr == f"{rich}: {count} in {str(out)!r}\n"
    with out.open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    assert head == list(TABLES[name])
    assert rows == [[as_text(cell) for cell in row] for row in expected]


def test_csv_to_standard_output_is_that_of_events(call: Call, recording: str) -> None:
    shown = call("export", recording, "--to", "csv", "-o", "-", "--quiet")
    assert shown.stderr == ""
    assert len(list(csv.reader(io.StringIO(shown.stdout)))) == len(rows_of(recording, "events")) + 1


# SQLite and Parquet.


def test_sqlite_has_every_table(call: Call, rich: str, tmp_path: Path) -> None:
    out = tmp_path / "out.sqlite"
    shown = call("export", rich, "--to", "sqlite", "-o", str(out), "--every", "0.5")
    assert shown.exit_code == 0, shown.stderr
    base = sqlite3.connect(out)
    for name in TABLES:
        assert base.execute(f'SELECT * FROM "{name}"').fetchall() == rows_of(rich, name, 0.5)
    joined = base.execute(
        "SELECT DISTINCT s.name FROM events e JOIN states s ON s.id = e.entity WHERE e.kind = 'tick'"
    )
    assert joined.fetchall() == [("blue",)]
    base.close()


@pytest.mark.parametrize("name", TABLES)
def test_parquet_has_the_same_rows_with_types(
    call: Call, rich: str, tmp_path: Path, name: str
) -> None:
    out = tmp_path / "it's.parquet"
    shown = call("export", rich, "--to", "parquet", "--table", name, "-o", str(out))
    assert shown.exit_code == 0, shown.stderr
    found = duckdb.read_parquet(str(out))
    assert found.fetchall() == rows_of(rich, name)
    assert dict(zip(found.columns, map(str, found.types), strict=True)) == TABLES[name]
    assert {path.name for path in tmp_path.iterdir()} == {"it's.parquet", "rich.jsonl"}


def test_parquet_without_duckdb_says_how_to_get_it(
    call: Call, recording: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "duckdb", None)
    shown = call("export", recording, "--to", "parquet", "-o", str(tmp_path / "out"))
    assert shown.exit_code == 2
    assert "pip install 'fasteroids[data]'" in shown.stderr
    assert not (tmp_path / "out").exists()
    for form in ("csv", "sqlite", "scene"):
        assert call("export", recording, "--to", form, "-o", str(tmp_path / form)).exit_code == 0


@pytest.mark.parametrize("form", ["parquet", "sqlite"])
def test_an_id_beyond_64_bits_is_refused(call: Call, tmp_path: Path, form: str) -> None:
    world = load_scene("[world]\nwidth = 99\nheight = 99\n")
    world = world.add(Asteroid(id=2**64, x=9, y=9, vx=-9, vy=0, radius=3))
    source, out = str(tmp_path / "source"), tmp_path / "out"
    Path(source).write_text(recorded(begin(world).evolve(5.0)))
    shown = call("export", source, "--to", form, "-o", str(out))
    assert shown.exit_code == 2
    assert "has more than 63 bits, which only --to csv can hold" in shown.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["source"]
    csv_ = call("export", source, "--to", "csv", "-o", "-").stdout
    assert str(2**64) in csv_


@pytest.mark.parametrize("form", ["csv", "parquet", "sqlite"])
def test_half_a_surrogate_pair_is_no_obstacle(
    call: Call, rich: str, tmp_path: Path, form: str
) -> None:
    text = Path(rich).read_text()
    Path(rich).write_text(text.replace('"text":"ship 2"', r'"text":"\ud800\u0000"'))
    args = [] if form == "sqlite" else ["--table", "prints"]
    shown = call("export", rich, "--to", form, "-o", str(tmp_path / "out"), *args)
    assert shown.exit_code == 0, shown.stderr


# A scene.


@pytest.mark.parametrize("time", ["0", "3", "13.37", None])
def test_a_scene_is_the_world_then(
    call: Call, recording: str, opened: Recording, tmp_path: Path, time: str | None
) -> None:
    out = tmp_path / "out.toml"
    at = [] if time is None else ["--at", time]
    assert call("export", recording, "--to", "scene", "-o", str(out), *at).exit_code == 0
    world = load_scene(out.read_text())
    assert world == evolve_until(opened.world, 20.0 if time is None else float(time))
    again = call("run", str(out), "--for", "1", "--json")
    assert again.exit_code == 0


# What cannot be.


@pytest.mark.parametrize(
    ("args", "why"),
    [
        (["--to", "csv"], "Missing option '-o'"),
        (["-o", "out"], "Missing option '--to'"),
        (["--to", "xlsx", "-o", "out"], "is not one of"),
        (["--to", "sqlite", "-o", "out", "--table", "events"], "--table is for csv and parquet"),
        (["--to", "csv", "-o", "out", "--at", "1"], "--at is for a scene"),
        (["--to", "csv", "-o", "out", "--every", "1"], "--every is for the table of states"),
        (["--to", "csv", "-o", "out", "--table", "none"], "is not one of"),
        (["--to", "sqlite", "-o", "-"], "sqlite needs a plain file"),
        (["--to", "parquet", "-o", os.devnull], "parquet needs a plain file"),
        (["--to", "csv", "-o", "none/out"], "there is no folder"),
        (["--to", "csv", "-o", "."], "it is a folder"),
        (["--to", "csv", "-o", "duel.jsonl"], "--output and the recording cannot both be"),
        (["--to", "scene", "-o", "out", "--at", "21"], "there is no 21.0 s in it"),
        (["--to", "sqlite", "-o", "out", "--every", "1e-9"], "is too often"),
    ],
)
def test_what_cannot_be_exported(
    call: Call, recording: str, monkeypatch: pytest.MonkeyPatch, args: list[str], why: str
) -> None:
    before = Path(recording).read_bytes()
    monkeypatch.chdir(Path(recording).parent)
    shown = call("export", "duel.jsonl", *args)
    assert shown.exit_code == 2
    assert why in shown.stderr
    assert [path.name for path in Path().iterdir()] == ["duel.jsonl"]
    assert Path(recording).read_bytes() == before


def test_a_file_is_replaced_as_a_whole(call: Call, recording: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.write_text("precious\n")
    Path(recording).write_text(Path(recording).read_text().replace('"type":"event"', "", 1))
    assert call("export", recording, "--to", "sqlite", "-o", str(out)).exit_code == 2
    assert out.read_text() == "precious\n"


def test_one_that_was_cut_short_is_exported_as_far_as_it_goes(call: Call, recording: str) -> None:
    data = Path(recording).read_bytes()
    Path(recording).write_bytes(data[:-3000])
    shown = call("export", recording, "--to", "csv", "-o", "-")
    assert shown.exit_code == 0
    assert shown.stderr.startswith(f"{recording}: it is cut short in line ")


# In processes of their own.


@pytest.mark.parametrize("form", ["parquet", "sqlite"])
@pytest.mark.parametrize("kind", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_work_leaves_nothing(
    spawn: Spawn, recording: str, tmp_path: Path, form: str, kind: signal.Signals
) -> None:
    out = tmp_path / "folder" / "out"
    out.parent.mkdir()
    out.write_text("precious\n")
    table = [] if form == "sqlite" else ["--table", "states"]
    process = spawn("export", recording, "--to", form, "-o", str(out), "--every", "2e-5", *table)
    deadline = time.monotonic() + PATIENCE
    while len(list(out.parent.iterdir())) == 1:
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.01)
    process.send_signal(kind)
    told, said = process.communicate(timeout=PATIENCE)
    assert (process.returncode, told, said) == (130, b"", b"interrupted\n")
    assert [path.name for path in out.parent.iterdir()] == ["out"]
    assert out.read_text() == "precious\n"


@pytest.mark.parametrize("form", ["csv", "parquet", "sqlite"])
def test_a_full_disk_leaves_nothing(recording: str, tmp_path: Path, form: str) -> None:
    """The largest size of a file plays the disk."""
    out = tmp_path / "folder" / "out"
    out.parent.mkdir()
    table = [] if form == "sqlite" else ["--table", "states"]
    run = subprocess.run(
        ["/bin/sh", "-c", 'trap "" XFSZ; ulimit -f 20; exec "$0" -m fasteroids export "$@"',
         sys.executable, recording, "--to", form, "-o", str(out), "--every", "0.05", *table],
        capture_output=True, text=True, check=False, timeout=PATIENCE,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip
    assert run.returncode == 2, run.stderr
    assert run.stderr.startswith(f"Error: cannot write {str(out)!r}: ")
    assert list(out.parent.iterdir()) == []
