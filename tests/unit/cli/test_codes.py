"""`fasteroids explain CODE`: what a code of a fault means."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest
from click.testing import Result

from fasteroids.lang.codes import CODES

Call = Callable[..., Result]


@pytest.mark.parametrize("name", CODES)
def test_tells_all_there_is(call: Call, name: str) -> None:
    code = CODES[name]
    shown = call("explain", name)
    assert (shown.exit_code, shown.stderr) == (0, "")
    assert shown.stdout.startswith(f"{name}: {code.title} ({code.phase})\n\n")
    assert code.why in shown.stdout.replace("\n", " ")
    for program in (code.wrong, code.right):
        assert all(f"    {line}\n" in shown.stdout for line in program.splitlines() if line)


def test_capitals_do_not_matter(call: Call) -> None:
    assert call("explain", "fa101").stdout == call("explain", "FA101").stdout


def test_json(call: Call) -> None:
    record = json.loads(call("explain", "FA108", "--json").stdout)
    code = CODES["FA108"]
    assert record == {
        "code": "FA108", "phase": "type", "title": code.title, "why": code.why,
        "wrong": code.wrong, "right": code.right,
    }  # fmt: skip


def test_an_unknown_code_is_refused(call: Call) -> None:
    shown = call("explain", "fa999")
    assert (shown.exit_code, shown.stdout) == (2, "")
    assert shown.stderr == (
        "Error: there is no code FA999; `fasteroids check` says the code of each fault\n"
    )


@pytest.mark.parametrize("text", ["FA1", "FA1010", "XFA101", "FA10x", "FA101.toml", "FA٣٣٣"])
def test_anything_that_is_no_code_is_a_scene(call: Call, text: str) -> None:
    shown = call("explain", text)
    assert shown.exit_code == 2
    assert f"there is no scene {text!r}" in shown.stderr


@pytest.mark.parametrize("more", [["--seed", "1"], ["--model", "spec"]])
def test_what_is_for_scenes_is_refused_for_codes(call: Call, more: list[str]) -> None:
    shown = call("explain", "FA101", *more)
    assert shown.exit_code == 2
    assert "--model, --seed and --bots are for scenes" in shown.stderr
