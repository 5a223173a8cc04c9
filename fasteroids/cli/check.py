"""`fasteroids check`: every fault of ship programs, for people and for tools."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Final

import click

from fasteroids.cli import _faults as faults
from fasteroids.cli._faults import Checked
from fasteroids.cli._files import STDIO, Lines, read_program
from fasteroids.cli._guard import DONE, FINDINGS, USAGE, Refusal
from fasteroids.lang.front import diagnose_bytes
from fasteroids.lang.report import Role, legible, rendered

__all__ = ["MOST_SHOWN", "command"]

MOST_SHOWN: Final = 20
"""Diagnostics of one file that are shown to people. Tools get all."""

_FORMATS: Final[dict[str, Callable[[list[Checked]], list[str]]]] = {
    "json": faults.as_json,
    "github": faults.as_github,
    "sarif": faults.as_sarif,
}
"""Those for tools."""

_LOOKS: Final[dict[Role, dict[str, object]]] = {
    "place": {"bold": True},
    "error": {"fg": "red", "bold": True},
    "warning": {"fg": "yellow", "bold": True},
    "message": {"bold": True},
    "gutter": {"dim": True},
    "mark": {"fg": "red", "bold": True},
    "note": {"fg": "blue", "bold": True},
    "hint": {"fg": "green", "bold": True},
}


@click.command("check")
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.option(
    "--format", "form", type=click.Choice(["text", *_FORMATS]), default="text", show_default=True,
    help="text is for people; json is one array of objects; github are commands to its workflows; "
    "sarif is SARIF 2.1.0.",
)  # fmt: skip
def command(files: tuple[str, ...], form: str) -> int:
    """Find every fault of the ship programs in each FILE ('-' for standard input).

    Programs are text in UTF-8. All faults of a program are found in one run, each with its place, a code and, where
    there is one, the likely fix; `fasteroids explain CODE` says more. Exit codes: 0 no errors, 1 errors, 2 a file
    cannot be read (the others are checked all the same).
    """
    checked: list[Checked] = []
    unreadable = False
    with Lines(STDIO) as lines:
        for place in files:
            try:
                text, found = diagnose_bytes(read_program(place))
            except Refusal as refusal:
                click.echo(f"Error: {legible(refusal.message)}", err=True)
                unreadable = True
                continue
            checked.append(Checked(place, text, found))
            if form == "text":
                _show(checked[-1], lines)
            click.echo(_verdict(checked[-1], form), err=True)
        if form != "text":
            for line in _FORMATS[form](checked):
                lines.write(line)
    if unreadable:
        return USAGE
    return FINDINGS if any(each.errors for each in checked) else DONE


def _show(each: Checked, lines: Lines) -> None:
    if each.found:
        paint = _painted if _coloured() else _plain
        shown = each.found[:MOST_SHOWN]
        lines.write(rendered(shown, each.text, each.place, paint=paint) + "\n")
        lines.flush()


def _verdict(each: Checked, form: str) -> str:
    """What one file came to, in a line."""
    name = "standard input" if each.place == STDIO else legible(each.place)
    if not each.found:
        return f"{name}: no errors"
    errors, warnings = each.errors, len(each.found) - each.errors
    counts = [
        f"{count} {word}{'s' if count > 1 else ''}"
        for count, word in ((errors, "error"), (warnings, "warning"))
        if count
    ]
    more = len(each.found) - MOST_SHOWN
    shown = f"; {more} more than are shown" if more > 0 and form == "text" else ""
    return f"{' and '.join(counts)} in {name}{shown}"


def _coloured() -> bool:
    """Colours are for terminals, unless the user says otherwise (https://no-color.org, FORCE_COLOR)."""
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    terminal = sys.stdout is not None and sys.stdout.isatty()
    return terminal and os.environ.get("TERM") != "dumb"


def _painted(role: Role, text: str) -> str:
    return click.style(text, **_LOOKS[role])  # type: ignore[arg-type]


def _plain(_role: Role, text: str) -> str:
    return text
