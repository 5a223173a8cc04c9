"""`fasteroids diff`: where two recordings part."""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

Call = Callable[..., Result]


def rewritten(recording: str, change: Callable[[list[str]], list[str]]) -> str:
    """A copy of a recording with other lines."""
    place = Path(recording).with_name("other.jsonl")
    lines = Path(recording).read_text().splitlines(keepends=True)
    place.write_text("".join(change(lines)))
    return str(place)


def test_no_difference(call: Call, recording: str, tmp_path: Path) -> None:
    packed = tmp_path / "packed"
    packed.write_bytes(gzip.compress(Path(recording).read_bytes()))
    shown = call("diff", recording, str(packed))
    events = Path(recording).read_text().count('{"type":"event"')
    assert shown.exit_code == 0
    assert shown.output == f"no difference: {events} events to 20 s\n"
    record = json.loads(call("diff", recording, str(packed), "--json").stdout)
    assert record == {
        "files": [recording, str(packed)],
        "same": True,
        "difference": None,
        "happened": None,
    }


def test_the_first_difference_with_what_each_says(call: Call, recording: str) -> None:
    lines = Path(recording).read_text().splitlines()
    number = next(i for i, line in enumerate(lines) if '"kind":"wall"' in line)
    event = json.loads(lines[number])
    other = {"left": "right"}.get(event["wall"], "left")

    def change(lines: list[str]) -> list[str]:
        lines[number] = lines[number].replace(event["wall"], other)
        return lines

    changed = rewritten(recording, change)
    shown = call("diff", recording, changed)
    assert shown.exit_code == 1
    assert shown.stdout.splitlines() == [
        f"line {number + 1}, at {event['time']!r} s, #{event['entities'][0]}: wall",
        f"  {recording}: {event['wall']!r}",
        f"  {changed}: {other!r}",
    ]
    found = json.loads(call("diff", recording, changed, "--json").stdout)["difference"]
    assert found == {
        "line": number + 1, "time": event["time"], "entity": event["entities"][0], "field": "wall",
        "values": [event["wall"], other],
    }  # fmt: skip


def test_other_seeds_are_other_worlds(call: Call, recording: str, tmp_path: Path) -> None:
    other = str(tmp_path / "other")
    assert call("record", "one-on-one", "--seed", "6", "-o", other).exit_code == 0
    shown = call("diff", recording, other)
    assert shown.exit_code == 1
    first, *rest = shown.stdout.splitlines()
    assert (first, rest[:2]) == ("line 1, at 0.0 s: seed", [f"  {recording}: 5", f"  {other}: 6"])
    assert rest[2].startswith("what happened parts on line ")
    found = json.loads(call("diff", recording, other, "--json").stdout)["happened"]
    assert f"line {found['line']}, at {found['time']!r} s" in rest[2]


def test_games_that_begin_differently_may_go_the_same_way(
    call: Call, recording: str, tmp_path: Path
) -> None:
    other = str(tmp_path / "other")
    assert call("record", "one-on-one", "--seed", "5", "--for", "0.1", "-o", other).exit_code == 0
    head = Path(other).read_text().replace('"seed":5', '"seed":6')
    changed = tmp_path / "changed"
    changed.write_text(head)
    shown = call("diff", other, str(changed))
    assert shown.exit_code == 1
    assert shown.stdout.splitlines()[-1] == "what happened is the same"


def test_bookmarks_and_unknown_fields_are_no_difference(call: Call, recording: str) -> None:
    mark = '{"type":"bookmark","time":0.0,"nth":0,"name":"here"}\n'
    other = rewritten(recording, lambda lines: [lines[0], mark, *lines[1:]])
    assert call("diff", recording, other).exit_code == 0
    assert call("diff", other, recording).exit_code == 0


def test_one_that_was_cut_short_is_compared_as_far_as_it_goes(call: Call, recording: str) -> None:
    short = rewritten(recording, lambda lines: [*lines[:50], lines[50][:9]])
    shown = call("diff", recording, short)
    assert shown.exit_code == 0
    events = sum('{"type":"event"' in line for line in Path(short).read_text().splitlines()[:50])
    assert shown.stdout.startswith(f"no difference: {events} events to ")
    assert shown.stderr.startswith(f"{short}: it is cut short in line 51, at ")


def test_one_that_goes_on_where_the_other_ends(call: Call, recording: str, tmp_path: Path) -> None:
    longer = str(tmp_path / "longer")
    args = ["--bots", "turret,turret", "--seed", "5", "--for", "21"]
    assert call("record", "one-on-one", *args, "-o", longer).exit_code == 0
    shown = call("diff", recording, longer)
    assert shown.exit_code == 1
    assert "the line\n" in shown.stdout.splitlines(keepends=True)[0]


def test_standard_input_is_one_of_them(call: Call, recording: str) -> None:
    data = Path(recording).read_bytes()
    assert call("diff", "-", recording, input=data).exit_code == 0
    shown = call("diff", "-", "-", input=data)
    assert shown.exit_code == 2
    assert "can be read once" in shown.stderr


@pytest.mark.parametrize("args", [[], ["a"], ["a", "b", "c"]])
def test_it_takes_two(call: Call, args: list[str]) -> None:
    shown = call("diff", *args)
    assert shown.exit_code == 2
    assert "Usage: " in shown.stderr
