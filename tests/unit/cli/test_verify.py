"""`fasteroids verify`: recordings lived again."""

from __future__ import annotations

import gzip
import json
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from fasteroids.scene import dump_scene, load_scene
from tests.unit.cli.conftest import PATIENCE, SCENE, on_terminal

Call = Callable[..., Result]
Spawn = Callable[..., "subprocess.Popen[bytes]"]


def changed(recording: str, old: str, new: str, count: int = 1) -> str:
    """A copy of a recording, changed."""
    text = Path(recording).read_text()
    assert old in text
    place = Path(recording).with_name("changed.jsonl")
    place.write_text(text.replace(old, new, count))
    return str(place)


def events_in(recording: str) -> int:
    return Path(recording).read_text().count('{"type":"event"')


def test_what_was_recorded_happens_again(call: Call, recording: str) -> None:
    shown = call("verify", recording)
    assert (shown.exit_code, shown.stderr) == (0, "")
    assert shown.stdout == f"{recording}: ok, {events_in(recording)} events to 20 s\n"


@pytest.mark.parametrize("slice_", ["0.05", "0.2", "3"])
def test_however_time_is_cut(call: Call, recording: str, slice_: str) -> None:
    shown = call("verify", recording, "--slice", slice_)
    assert (shown.exit_code, shown.stderr) == (0, "")
    assert ": ok, " in shown.stdout


def test_the_first_difference_is_named(call: Call, recording: str) -> None:
    lines = Path(recording).read_text().splitlines()
    number, line = next((i, each) for i, each in enumerate(lines, 1) if '"effect":"split"' in each)
    event = json.loads(line)
    wrong = changed(recording, line, line.replace('"effect":"split"', '"effect":"bounce"'))
    shown = call("verify", wrong)
    assert shown.exit_code == 1
    assert shown.stdout.endswith(
        f": line {number}, at {event['time']!r} s, #{event['entities'][0]}: effect is recorded as 'bounce', "
        "and is 'split'\n"
    )
    assert ": differs after " in shown.stdout
    record = json.loads(call("verify", wrong, "--json").stdout)
    assert record["ok"] is False
    assert record["difference"] == {
        "line": number, "time": event["time"], "entity": event["entities"][0], "field": "effect",
        "recorded": "bounce", "found": "split",
    }  # fmt: skip


def test_another_first_world_has_another_future(call: Call, recording: str) -> None:
    text = Path(recording).read_text()
    speed = json.loads(text.splitlines()[0])["world"]["asteroid"][0]["vx"]
    shown = call("verify", changed(recording, f'"vx":{speed!r}', f'"vx":{speed + 1.0!r}'))
    assert shown.exit_code == 1
    assert ": differs after " in shown.stdout


def test_a_file_cut_short_is_compared_as_far_as_it_goes(call: Call, recording: str) -> None:
    data = Path(recording).read_bytes()
    short = Path(recording).with_name("short.jsonl")
    short.write_bytes(data[: len(data) // 2])
    shown = call("verify", str(short))
    assert shown.exit_code == 0
    lines = data[: len(data) // 2].decode().splitlines()
    events = sum(line.startswith('{"type":"event"') for line in lines[:-1])
    assert shown.stdout.startswith(f"{short}: ok as far as it goes, {events} events to ")
    assert f"; it is cut short in line {len(lines)}, at " in shown.stdout
    record = json.loads(call("verify", str(short), "--json").stdout)
    assert (record["ok"], record["events"]) == (True, events)
    assert record["short"].startswith("it is cut short")


def test_another_platform_is_told(call: Call, recording: str) -> None:
    libm = json.loads(Path(recording).read_text().splitlines()[0])["libm"]
    shown = call("verify", changed(recording, libm, "0" * 32))
    assert shown.exit_code == 0
    assert shown.stdout.endswith(
        "; it was recorded where sin and cos give other numbers than here\n"
    )


def test_all_files_are_looked_at_and_the_worst_decides(
    call: Call, recording: str, tmp_path: Path
) -> None:
    wrong = changed(recording, '"effect":"split"', '"effect":"bounce"')
    none = str(tmp_path / "none")
    shown = call("verify", none, wrong, recording)
    assert shown.exit_code == 2
    assert shown.stderr == f"Error: cannot read {none!r}: No such file or directory\n"
    first, second = shown.stdout.splitlines()
    assert first.startswith(f"{wrong}: differs")
    assert second.startswith(f"{recording}: ok")
    assert call("verify", wrong, recording).exit_code == 1


@pytest.mark.parametrize("pack", [bytes, gzip.compress])
def test_standard_input_plain_and_packed(
    call: Call, recording: str, pack: Callable[[bytes], bytes]
) -> None:
    shown = call("verify", "-", input=pack(Path(recording).read_bytes()))
    assert shown.exit_code == 0
    assert shown.stdout.startswith("standard input: ok, ")
    assert call("verify", "-", "-").exit_code == 2


def test_a_recording_with_its_cuts_has_no_other_slices(call: Call, tmp_path: Path) -> None:
    out = str(tmp_path / "out.jsonl")
    assert call("record", "thrust", "--model", "robust", "-o", out).exit_code == 0
    assert call("verify", out).exit_code == 0
    shown = call("verify", out, "--slice", "1")
    assert shown.exit_code == 2
    assert shown.stderr.startswith(
        f"Error: {out}: a recording under the model 'robust' holds its cuts"
    )


# What is no recording, for every command that reads one.

COMMANDS = {
    "verify": ["verify", "{}"],
    "diff": ["diff", "{}", "{}"],
    "show": ["show", "{}"],
    "export": ["export", "{}", "--to", "csv", "-o", "out"],
}
HEADER = '{"type":"header","format":1}\n'


@pytest.mark.parametrize("command", COMMANDS)
def test_no_name_is_that_of_no_file(call: Call, command: str) -> None:
    shown = call(*(arg.format("") for arg in COMMANDS[command]))
    assert shown.exit_code == 2
    assert shown.stderr == "Error: cannot read '': there is no such file\n"


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "the file is empty"),
        (b"\0" * 10_000, "is no recording: it does not begin with a header"),
        (b"\x1f\x8b", "it is cut short"),
        (b"\x1f\x8bnothing", "its compression is damaged"),
        (gzip.compress(b"text\n"), "line 1: is no JSON"),
        (b'{"type":"eve', "the header is cut short, or this is no recording"),
        (b"{}\n", "is not the header of a recording"),
        (b"{" * 100_000 + b"\n", "line 1: "),
        (b'{"a":' * 100_000 + b"\n", "nested too deeply"),
        (HEADER.encode(), "line 1: "),
        (HEADER.replace("1", "2").encode(), "has format 2, and this version reads formats up to 1"),
        (SCENE.encode(), "is a scene; record it first: fasteroids record "),
        (b"\xef\xbb\xbf" + SCENE.replace("\n", "\r\n").encode(), "is a scene; record it first"),
        (dump_scene(load_scene(SCENE)).encode(), "is a scene; record it first"),
    ],
    ids=range(14),
)
def test_a_file_that_is_no_recording(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str, data: bytes, why: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").write_bytes(data)
    shown = call(*(arg.format("file") for arg in COMMANDS[command]))
    assert shown.exit_code == 2
    assert shown.stdout == ""
    assert shown.stderr.startswith("Error: file")
    assert why in shown.stderr
    assert shown.stderr.count("\n") == 1
    assert [each.name for each in tmp_path.iterdir()] == ["file"]


@pytest.mark.parametrize("command", COMMANDS)
def test_places_without_a_recording(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    monkeypatch.chdir(tmp_path)
    for place, why in (
        (".", "cannot read '.': Is a directory"),
        ("none", "cannot read 'none': No such file or directory"),
        ("", "cannot read "),
        ("duel", "duel is a scene; record it first: fasteroids record duel -o FILE"),
    ):
        shown = call(*(arg.format(place) for arg in COMMANDS[command]))
        assert shown.exit_code == 2
        assert why in shown.stderr
        assert shown.stdout == ""


@pytest.mark.parametrize("command", COMMANDS)
def test_a_damaged_line_is_named(
    call: Call, recording: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = Path(recording).read_text().splitlines(keepends=True)
    for damage in ('{"type":"event"}\n', "\0\n", '{"type":"hash","time":1e999}\n', "[]\n", "é\n"):
        Path("damaged").write_text("".join([*lines[:5], damage, *lines[6:]]), encoding="latin-1")
        shown = call(*(arg.format("damaged") for arg in COMMANDS[command]))
        assert shown.exit_code == 2
        assert shown.stderr.startswith("Error: damaged: line 6: ")
        assert shown.stdout == ""
    assert not Path("out").exists()


# In processes of their own.


def test_an_endless_file_is_refused_at_once(spawn: Spawn) -> None:
    process = spawn("verify", "/dev/zero")
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2
    assert said.startswith(b"Error: /dev/zero is no recording")


@pytest.fixture
def long(call: Call, busy: str, tmp_path: Path) -> str:
    """A recording that takes some seconds to live again."""
    out = str(tmp_path / "long.jsonl")
    args = ["--for", "1e9", "--max-events", "60000"]
    assert call("record", busy, "-o", out, *args).exit_code == 0
    return out


def test_ctrl_c(spawn: Spawn, recording: str, long: str) -> None:
    process = spawn("verify", recording, long)
    assert process.stdout is not None
    assert process.stdout.readline().startswith(f"{recording}: ok".encode())
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    told, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    assert told == b""
    assert said in (f"interrupted while {long} was lived again\n".encode(), b"interrupted\n")


def test_progress_on_a_terminal(long: str) -> None:
    seen, told = on_terminal("verify", long)
    assert b"events/s" in seen
    assert told == b""
