"""`fasteroids check`: every fault of ship programs, for people and for tools."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from fasteroids.cli.check import MOST_SHOWN

Call = Callable[..., Result]
Spawn = Callable[..., "subprocess.Popen[bytes]"]

GOOD = "turn 0.5;\n"
BAD = "bool b := 1;\nturn true;\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to be in, with a program that is right and one with two errors."""
    (tmp_path / "good.ast").write_text(GOOD)
    (tmp_path / "bad.ast").write_text(BAD)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    return tmp_path


def records(shown: Result) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(shown.stdout)
    return found


# For people.


def test_a_right_program(call: Call, folder: Path) -> None:
    shown = call("check", "good.ast")
    assert (shown.exit_code, shown.stdout, shown.stderr) == (0, "", "good.ast: no errors\n")


def test_a_wrong_program(call: Call, folder: Path) -> None:
    shown = call("check", "bad.ast")
    assert shown.exit_code == 1
    assert shown.stderr == "2 errors in bad.ast\n"
    assert shown.stdout.startswith(
        "bad.ast:1:11: error FA103: `b` is a bool, but this value is a double\n  1 | bool b := 1;\n"
    )
    assert "\n\nbad.ast:2:6: error FA107: " in shown.stdout


def test_many_files_and_standard_input(call: Call, folder: Path) -> None:
    shown = call("check", "good.ast", "-", "bad.ast", input="fire")
    assert shown.exit_code == 1
    assert shown.stderr == "good.ast: no errors\n1 error in standard input\n2 errors in bad.ast\n"
    assert shown.stdout.startswith("-:1:5: error FA0")


def test_people_see_the_first_errors_and_how_many_more_there_are(call: Call, folder: Path) -> None:
    Path("long.ast").write_text("turn true;\n" * (MOST_SHOWN + 3))
    shown = call("check", "long.ast")
    assert shown.stdout.count("error FA107") == MOST_SHOWN
    assert shown.stderr == f"{MOST_SHOWN + 3} errors in long.ast; 3 more than are shown\n"
    assert len(records(call("check", "--format", "json", "long.ast"))) == MOST_SHOWN + 3


def test_colours_are_for_those_who_ask(
    call: Call, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plain = call("check", "bad.ast").stdout
    assert "\x1b" not in plain
    monkeypatch.delenv("NO_COLOR")
    assert call("check", "bad.ast").stdout == plain
    monkeypatch.setenv("FORCE_COLOR", "1")
    painted = call("check", "bad.ast", color=True).stdout
    assert "\x1b[31m\x1b[1merror FA103:\x1b[0m" in painted


# Bad input.


def test_unreadable_files_are_told_and_the_others_checked(call: Call, folder: Path) -> None:
    Path("dir.ast").mkdir()
    shown = call("check", "missing.ast", "bad.ast", "dir.ast", "no\x1bsuch", "n\0l")
    assert shown.exit_code == 2
    assert shown.stderr.splitlines() == [
        "Error: cannot read 'missing.ast': No such file or directory",
        "2 errors in bad.ast",
        "Error: cannot read 'dir.ast': Is a directory",
        r"Error: cannot read 'no\x1bsuch': No such file or directory",
        r"Error: cannot read 'n\x00l': there is no such file",
    ]
    assert shown.stdout.count(": error FA") == 2
    assert records(call("check", "--format=json", "missing.ast")) == []


def test_bytes_that_are_no_text_are_errors_at_their_place(call: Call, folder: Path) -> None:
    Path("odd.ast").write_bytes(b"turn 1;\nturn \xff\x1b[2J;\n")
    shown = call("check", "odd.ast")
    assert shown.exit_code == 1
    assert "odd.ast:2:6: error FA002: " in shown.stdout
    assert "\x1b" not in shown.stdout
    assert call("check", "-", input=bytes(range(256)) * 9).exit_code == 1


def test_what_is_far_too_long_is_refused(call: Call, folder: Path) -> None:
    shown = call("check", "-", input=b"\n" * (1024 * 1024 + 1))
    assert shown.exit_code == 2
    assert shown.stderr == (
        "Error: standard input: a program has at most 1048576 bytes; this one has more\n"
    )


@pytest.mark.parametrize("args", [["--format", "xml", "good.ast"], ["--format"]])
def test_usage_errors(call: Call, folder: Path, args: list[str]) -> None:
    shown = call("check", *args)
    assert shown.exit_code == 2
    assert shown.stdout == ""


# For tools.


def test_json(call: Call, folder: Path) -> None:
    shown = call("check", "--format", "json", "good.ast", "bad.ast")
    assert shown.exit_code == 1
    assert shown.stderr == "good.ast: no errors\n2 errors in bad.ast\n"
    first, second = records(shown)
    assert first == {
        "code": "FA103", "severity": "error", "phase": "type",
        "message": "`b` is a bool, but this value is a double", "hint": "Write `true`",
        "file": "bad.ast", "line": 1, "column": 11, "end_line": 1, "end_column": 12,
    }  # fmt: skip
    assert (second["code"], second["line"], second["hint"]) == ("FA107", 2, None)
    assert records(call("check", "--format", "json", "-", input="fire"))[0]["phase"] == "syntax"


def test_json_of_right_programs_is_an_empty_array(call: Call, folder: Path) -> None:
    shown = call("check", "--format", "json", "good.ast", "good.ast")
    assert (shown.exit_code, shown.stdout) == (0, "[]\n")


def test_github(call: Call, folder: Path) -> None:
    Path("50%,a:b.ast").write_text("bool b :=\n1 +\n2;\n")
    shown = call("check", "--format", "github", "50%,a:b.ast", "bad.ast", "good.ast")
    assert shown.exit_code == 1
    several, one, _ = shown.stdout.splitlines()
    assert several.startswith(
        "::error file=50%25%2Ca%3Ab.ast,line=2,endLine=3,title=FA103::`b` is a bool, but"
    )
    assert one == (
        "::error file=bad.ast,line=1,endLine=1,col=11,endColumn=12,title=FA103::"
        "`b` is a bool, but this value is a double%0AWrite `true`"
    )


def test_github_says_nothing_of_right_programs(call: Call, folder: Path) -> None:
    assert call("check", "--format", "github", "good.ast").stdout == ""


def test_sarif_has_what_the_standard_demands(call: Call, folder: Path) -> None:
    Path("a b.ast").write_text(BAD)
    log = json.loads(call("check", "--format", "sarif", "good.ast", "a b.ast").stdout)
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    driver = run["tool"]["driver"]
    assert driver["name"] == "fasteroids"
    assert [rule["id"] for rule in driver["rules"]] == ["FA103", "FA107"]
    assert all(rule["shortDescription"]["text"] for rule in driver["rules"])
    assert run["columnKind"] == "unicodeCodePoints"
    assert len(run["results"]) == 2
    for result in run["results"]:
        assert driver["rules"][result["ruleIndex"]]["id"] == result["ruleId"]
        assert result["level"] == "error"
        assert result["message"]["text"]
        (location,) = result["locations"]
        assert location["physicalLocation"]["artifactLocation"] == {"uri": "a%20b.ast"}
    first = run["results"][0]
    (related,) = first["relatedLocations"]
    assert related["message"]["text"] == "declared bool here"
    assert related["physicalLocation"]["region"]["endColumn"] == 5
    region = {"startLine": 1, "startColumn": 11, "endLine": 1, "endColumn": 12}
    assert first["locations"][0]["physicalLocation"]["region"] == region
    (fix,) = first["fixes"]
    assert fix["artifactChanges"][0]["replacements"] == [
        {"deletedRegion": region, "insertedContent": {"text": "true"}}
    ]


def test_sarif_of_right_programs_has_no_results(call: Call, folder: Path) -> None:
    (run,) = json.loads(call("check", "--format", "sarif", "good.ast").stdout)["runs"]
    assert run["results"] == []


# As a process.


def test_a_reader_that_leaves_is_no_error(folder: Path) -> None:
    run = subprocess.run(
        ["/bin/sh", "-c", '"$0" -m fasteroids check bad.ast bad.ast bad.ast | head -n 1', sys.executable],
        capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )  # fmt: skip
    assert run.stdout.count("\n") == 1
    assert run.stderr == "2 errors in bad.ast\n" * 3


def test_standard_input_may_be_closed(spawn: Spawn) -> None:
    process = spawn("check", "-", stdin=None, preexec_fn=lambda: os.close(0))
    _, said = process.communicate()
    assert process.returncode == 2
    assert said == b"Error: standard input is closed\n"


@pytest.mark.parametrize("form", ["text", "json"])
def test_loads_nothing_heavy(folder: Path, form: str) -> None:
    """Editors wait for it: no other command, no terminal library, nothing of ours beside the language."""
    code = (
        "import sys, fasteroids, click, json\n"
        "before = {*sys.modules}\n"
        "from fasteroids.cli import main\n"
        f"try: main(['check', '--format', {form!r}, 'bad.ast'], prog_name='fasteroids')\n"
        "except SystemExit: pass\n"
        "print('loaded', *sorted({name for name in {*sys.modules} - before "
        "if name.startswith('fasteroids')}))\n"
        "print('heavy', *sorted({'rich', 'textual', 'numpy', 'importlib.metadata', 'fasteroids.audit', "
        "'fasteroids.testing'} & sys.modules.keys()))\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )  # fmt: skip
    *_, loaded, heavy = run.stdout.splitlines()
    assert heavy == "heavy"
    ours = {name.rpartition(".")[0] for name in loaded.split()[1:]}
    assert ours <= {"", "fasteroids", "fasteroids.lang", "fasteroids.lang.lint", "fasteroids.cli"}
    commands = {name for name in loaded.split() if name.startswith("fasteroids.cli.")}
    assert commands == {
        f"fasteroids.cli.{name}" for name in ("_faults", "_files", "_guard", "check")
    }
