"""`fasteroids audit`: a table, JSON, exit codes."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import inf

import pytest
from click.testing import Result

from fasteroids import models
from fasteroids.models import Model

Call = Callable[..., Result]


@pytest.fixture
def blind(monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine that sees no contact."""
    level = Model("robust", lambda *_: inf, lambda *_: inf, "literal", "none")
    monkeypatch.setattr(models, "MODELS", {"robust": level})


def test_table(call: Call, busy: str) -> None:
    shown = call("audit", busy, "--for", "3")
    assert shown.exit_code == 0
    assert shown.stderr == ""
    lines = shown.stdout.splitlines()
    assert lines[0] == "busy.toml: 60 asteroids, from 0 s to 3 s; seed 0, model robust"
    for law in ("L7", "L8", "L9", "L10", "L14"):
        assert any(line.startswith(law) for line in lines)
    (overlap,) = [line for line in lines if "overlap" in line]
    assert " km " in overlap
    assert "asteroid #" in overlap
    assert any(line.startswith("events ") and line.endswith(" a second") for line in lines)
    assert any(line.startswith("contact times ") and "exact" in line for line in lines)
    assert any(line.startswith("energy drift ") for line in lines)
    assert lines[-1] == "every law was kept"
    assert all(line == line.rstrip() for line in lines)


def test_json(call: Call, busy: str) -> None:
    shown = call("audit", busy, "--for", "3", "--json")
    assert shown.exit_code == 0
    found = json.loads(shown.stdout)
    assert found["ok"] is True
    assert found["scene"] == "busy.toml"
    assert (found["seed"], found["model"], found["stopped"]) == (0, "robust", "time")
    assert found["time"] == 3.0
    assert found["asked"] > found["events"]["contact"] > 0
    assert found["undecided"] >= 0
    assert found["events_per_second"] > 0.0
    for margin in found["margins"]:
        assert set(margin) == {
            "law", "what", "unit", "worst", "allowed", "ulps", "time", "entities", "ok",
        }  # fmt: skip
        assert margin["ok"] is True
    (overlap,) = [margin for margin in found["margins"] if margin["what"] == "overlap"]
    assert 0.0 < overlap["worst"] <= overlap["allowed"]
    assert len(overlap["entities"]) == 2


@pytest.mark.usefixtures("blind")
def test_exceeded_margin_is_a_finding(call: Call, busy: str) -> None:
    shown = call("audit", busy, "--for", "3")
    assert shown.exit_code == 1
    (overlap,) = [line for line in shown.stdout.splitlines() if "overlap" in line]
    assert overlap.endswith("EXCEEDED")
    assert shown.stdout.splitlines()[-1] == "exceeded: L7"


@pytest.mark.usefixtures("blind")
def test_exceeded_margin_in_json(call: Call, busy: str) -> None:
    shown = call("audit", busy, "--for", "3", "--json")
    assert shown.exit_code == 1
    assert json.loads(shown.stdout)["ok"] is False


def test_names_of_the_dead_are_known(call: Call, scene: str) -> None:
    shown = call("audit", scene, "--for", "10")
    assert shown.exit_code == 0
    assert "2 deaths, 2 births, 0 clips" in shown.stdout
    assert "bullet #4" in shown.stdout


def test_max_events_model_and_seed(call: Call, busy: str) -> None:
    shown = call("audit", busy, "--max-events", "5", "--model", "spec", "--seed", "3", "--json")
    found = json.loads(shown.stdout)
    assert sum(found["events"].values()) == 5
    assert (found["model"], found["seed"], found["stopped"]) == ("spec", 3, "max-events")
    assert "--max-events allows no more" in shown.stderr


def test_empty_scene(call: Call) -> None:
    text = "[world]\nwidth = 10\nheight = 10\n"
    shown = call("audit", "-", input=text)
    assert shown.exit_code == 0
    assert "events         none" in shown.stdout
    assert "nothing to measure" in shown.stdout
    assert json.loads(call("audit", "-", "--json", input=text).stdout)["energy_drift"] is None


@pytest.mark.parametrize("option", [["--for", "nan"], ["--max-events", "-3"], ["--model", "x"]])
def test_values_refused(call: Call, scene: str, option: list[str]) -> None:
    assert call("audit", scene, *option).exit_code == 2
