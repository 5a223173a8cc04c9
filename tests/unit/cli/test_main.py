"""The command line as a whole: help, exit codes, what it loads."""

from __future__ import annotations

import gc
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import version

import click
import pytest
from click.testing import Result

from fasteroids.cli import COMMANDS, main
from fasteroids.cli._guard import guarded
from fasteroids.units import ModelError

Call = Callable[..., Result]


@pytest.mark.parametrize("flag", ["--help", "-h"])
def test_help_names_every_command(call: Call, flag: str) -> None:
    shown = call(flag)
    assert shown.exit_code == 0
    for name, text in COMMANDS.items():
        assert name in shown.stdout
        assert text in shown.stdout


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_help(call: Call, name: str) -> None:
    shown = call(name, "--help")
    assert shown.exit_code == 0
    assert {
        "check": "FILE...",
        "fmt": "FILE...",
        "new": "bot|scene NAME",
        "arena": "FIELD",
        "lsp": "--stdio",
        "verify": "FILE...",
        "diff": "A B",
        "show": "FILE",
        "export": "FILE",
        "replay": "FILE",
        "debug": "FILE|SCENE",
        "serve": "--host",
    }.get(name, "SCENE") in shown.stdout


def test_version(call: Call) -> None:
    assert call("--version").stdout == f"fasteroids {version('fasteroids')}\n"


def test_no_command_shows_help(call: Call) -> None:
    shown = call()
    assert shown.exit_code == 2
    assert "Commands:" in shown.output


def test_unknown_command_suggests_one(call: Call) -> None:
    shown = call("adit", "x")
    assert shown.exit_code == 2
    assert "audit" in shown.stderr


@pytest.mark.parametrize(
    "args",
    [["run"], ["audit"], ["explain"], ["check"], ["fmt"], ["new"], ["run", "x", "--nonsense"]],
)
def test_usage_errors(call: Call, args: list[str]) -> None:
    shown = call(*args)
    assert shown.exit_code == 2
    assert "Usage:" in shown.stderr
    assert shown.stdout == ""


@pytest.mark.parametrize("args", [["--help"], ["--version"], []])
def test_help_loads_neither_commands_nor_terminal_libraries(args: list[str]) -> None:
    code = (
        "import sys, fasteroids.cli\n"
        f"try: fasteroids.cli.main({args!r}, prog_name='fasteroids')\n"
        "except SystemExit: pass\n"
        "heavy = {'rich', 'textual', 'numpy', 'fasteroids.audit'}\n"
        "heavy |= {f'fasteroids.cli.{name}' for name in fasteroids.cli.COMMANDS}\n"
        "print('loaded', *sorted(heavy & sys.modules.keys()))\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.splitlines()[-1] == "loaded"


def test_runs_as_a_module() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "fasteroids", "--version"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout.startswith("fasteroids ")


def test_a_bug_of_ours_says_so(call: Call, scene: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def oops(*_: object, **__: object) -> None:
        raise ZeroDivisionError("the moon is full")

    monkeypatch.setattr("fasteroids.cli.run.open_scene", oops)
    shown = call("run", scene)
    assert shown.exit_code == 3
    assert "this is a bug in fasteroids: ZeroDivisionError: the moon is full" in shown.stderr
    assert "in oops" in shown.stderr
    assert shown.stdout == ""


def raising(error: BaseException) -> Callable[[], int]:
    def command() -> int:
        raise error

    return command


def test_guard_gives_codes() -> None:
    assert guarded(lambda: None) == 0
    assert guarded(lambda: 1) == 1
    assert guarded(raising(AssertionError("ours"))) == 3
    assert guarded(raising(KeyboardInterrupt())) == 130
    assert guarded(raising(BrokenPipeError())) == 0


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (ModelError("the world is flat"), "the world is flat"),
        (FileNotFoundError(2, "No such file or directory", "x"), "'x': No such file or directory"),
        (OSError("odd"), "odd"),
        (MemoryError(), "this takes more memory than there is"),
    ],
)
def test_guard_refuses(error: Exception, sentence: str) -> None:
    with pytest.raises(click.ClickException, match=sentence) as caught:
        guarded(raising(error))
    assert caught.value.exit_code == 2


def test_guard_leaves_usage_errors_to_click() -> None:
    with pytest.raises(click.UsageError):
        guarded(raising(click.UsageError("no")))
    assert main.name == "fasteroids"


def test_a_command_leaves_the_collector_as_it_was(call: Call) -> None:
    usual = gc.get_threshold()
    for args in (["explain", "FA101"], ["explain", "FA999"], ["run"]):
        call(*args)
        assert gc.get_threshold() == usual
