"""`fasteroids check`: warnings, and fixes put in."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

Call = Callable[..., Result]

ODD = "double d;\nwhile (true) { }\n"
COURSE = "turn 3 - 2 -1;\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to be in, with programs that have warnings only."""
    (tmp_path / "odd.ast").write_text(ODD)
    (tmp_path / "course.ast").write_text(COURSE)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    return tmp_path


def test_a_program_with_warnings_is_no_failure_unless_it_is_asked_to_be(
    call: Call, folder: Path
) -> None:
    shown = call("check", "odd.ast")
    assert shown.exit_code == 0
    assert shown.stderr == "2 warnings in odd.ast\n"
    assert shown.stdout.startswith("odd.ast:1:8: warning FA206: `d` is not used\n  1 | double d;\n")
    assert "\n\nodd.ast:2:1: warning FA203: " in shown.stdout
    strict = call("check", "--strict", "odd.ast")
    assert (strict.exit_code, strict.stdout) == (1, shown.stdout)
    assert call("check", "--strict", "-", input="fire;").exit_code == 0


def test_there_are_no_warnings_beside_errors(call: Call, folder: Path) -> None:
    shown = call("check", "-", input=ODD + "turn true;")
    assert shown.exit_code == 1
    assert shown.stderr == "1 error in standard input\n"


def test_what_2013_read_otherwise_is_told_on_demand(call: Call, folder: Path) -> None:
    assert call("check", "course.ast").stdout == ""
    shown = call("check", "--course", "course.ast")
    assert shown.exit_code == 0
    assert "warning FA211" in shown.stdout
    assert "warning FA212" in shown.stdout


def test_warnings_in_the_formats_of_tools(call: Call, folder: Path) -> None:
    first, second = json.loads(call("check", "--format", "json", "odd.ast").stdout)
    assert (first["code"], first["severity"], first["phase"]) == ("FA206", "warning", "lint")
    assert second["code"] == "FA203"
    github = call("check", "--format", "github", "odd.ast").stdout
    assert github.startswith("::warning file=odd.ast,line=1,")
    (run,) = json.loads(call("check", "--format", "sarif", "odd.ast").stdout)["runs"]
    assert [each["level"] for each in run["results"]] == ["warning", "warning"]
    assert run["results"][0]["fixes"]


def test_fixes_are_put_in_and_the_rest_is_told(call: Call, folder: Path) -> None:
    shown = call("check", "--fix", "odd.ast")
    assert shown.exit_code == 0
    assert shown.stderr == "odd.ast: fixes put in\n1 warning in odd.ast\n"
    assert shown.stdout.startswith("odd.ast:1:1: warning FA203: ")
    assert Path("odd.ast").read_text() == "while (true) { }\n"
    again = call("check", "--fix", "odd.ast")
    assert (again.stdout, again.stderr) == (shown.stdout, "1 warning in odd.ast\n")


def test_errors_are_mended_first_and_then_what_comes_to_light(call: Call, folder: Path) -> None:
    Path("wrong.ast").write_bytes(b"\xef\xbb\xbfdouble d;\r\nturn 3 - 2 -1\r\n")
    shown = call("check", "--fix", "--course", "wrong.ast")
    assert shown.exit_code == 0
    assert shown.stderr == "wrong.ast: fixes put in\nwrong.ast: no errors\n"
    assert Path("wrong.ast").read_bytes() == b"\xef\xbb\xbfturn (3 - 2) - 1;\r\n"


def test_what_cannot_be_mended_stays_as_it_is(call: Call, folder: Path) -> None:
    bad = b"double d;\nturn \xff;\nturn 1"
    Path("bad.ast").write_bytes(bad)
    shown = call("check", "--fix", "bad.ast")
    assert shown.exit_code == 1
    assert "fixes put in" not in shown.stderr
    assert Path("bad.ast").read_bytes() == bad
    assert call("check", "--fix", "missing.ast").exit_code == 2


def test_standard_input_cannot_be_mended(call: Call, folder: Path) -> None:
    shown = call("check", "--fix", "odd.ast", "-", input=ODD)
    assert shown.exit_code == 2
    assert "--fix changes files" in shown.stderr
    assert Path("odd.ast").read_text() == ODD


def test_a_scene_runs_with_a_program_that_has_warnings(call: Call, folder: Path) -> None:
    ship = 'x = 50\ny = 50\nradius = 10\nmass = 5e15\nprogram = "odd.ast"\n'
    Path("scene.toml").write_text(f"[world]\nwidth = 100\nheight = 100\n[[ship]]\n{ship}")
    shown = call("run", "scene.toml", "--for", "0.5")
    assert shown.exit_code == 0
