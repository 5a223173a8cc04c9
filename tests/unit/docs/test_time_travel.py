"""docs/time-travel.md: from a recorded bug to its cause in six commands, each of which says what stands below it."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from textwrap import dedent

import pytest
from click.testing import CliRunner

from fasteroids.cli import main

PAGE = (Path(__file__).parents[3] / "docs" / "time-travel.md").read_text(encoding="utf-8")
REPAIR = ("if (gety near", "if (near != null && gety near")


def blocks(language: str) -> list[str]:
    found = re.findall(rf"^ *```{language}\n(.*?)^ *```$", PAGE, re.DOTALL | re.MULTILINE)
    return [dedent(body) for body in found]


def fits(said: str, text: str) -> bool:
    """Is a text what the page says, where "..." stands for anything on one line?"""
    return bool(re.fullmatch(re.escape(said).replace(re.escape("..."), "[^\n]*"), text))


def run(line: str) -> str:
    """What a command says, or the last lines of its output that the page asks for."""
    command, _, tail = line.partition(" | tail -n ")
    name, *args = shlex.split(command)
    assert name == "fasteroids"
    shown = CliRunner().invoke(main, args)
    if not tail:
        return shown.output
    return "".join(shown.stdout.splitlines(keepends=True)[-int(tail) :])


def test_six_commands_lead_from_a_recorded_bug_to_its_cause(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    [scene] = blocks("toml")
    assert scene.count(REPAIR[0]) == 1
    assert REPAIR[1] in PAGE
    Path("guard.toml").write_text(scene, encoding="utf-8")
    Path("fixed.toml").write_text(scene.replace(*REPAIR), encoding="utf-8")
    commands = blocks("console")
    assert len(commands) == 6
    for block in commands:
        command, _, said = block.removeprefix("$ ").partition("\n")
        if "fixed" in command:
            run("fasteroids record fixed.toml --for 20 -o fixed.jsonl")
        text = run(command)
        assert fits(said, text), f"$ {command}\n{text}"
