"""`fasteroids check`: every fault of ship programs, and what is odd about them, for people and for tools."""

from __future__ import annotations

import codecs
import os
import sys
from collections.abc import Callable
from typing import Final

import click

from fasteroids.cli import _faults as faults
from fasteroids.cli._faults import Checked
from fasteroids.cli._files import STDIO, Lines, read_program, write_whole
from fasteroids.cli._guard import DONE, FINDINGS, USAGE, Refusal
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnose_bytes, mended_throughout
from fasteroids.lang.lint import warnings
from fasteroids.lang.parser import parse_program
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
@click.option("--strict", is_flag=True, help="Warnings count as errors: exit code 1.")
@click.option(
    "--fix", is_flag=True, help="Put in the safe fixes that there are, and tell what is left."
)
@click.option(
    "--course", is_flag=True,
    help="Warn also of what the parser of the course of 2013 read otherwise, or refused. Off by default: "
    "that is a lot in most programs that were not written for it.",
)  # fmt: skip
def command(files: tuple[str, ...], form: str, strict: bool, fix: bool, course: bool) -> int:
    """Find every fault of the ship programs in each FILE ('-' for standard input).

    Programs are text in UTF-8. All faults of a program are found in one run, each with its place, a code and, where
    there is one, the likely fix; `fasteroids explain CODE` says more. A program without errors gets warnings about what
    is odd: it runs all the same. Exit codes: 0 no errors, 1 errors, 2 a file cannot be read (the others are checked all
    the same).
    """
    if fix and STDIO in files:
        raise click.UsageError("--fix changes files, and standard input is none")
    checked: list[Checked] = []
    unreadable = False
    with Lines(STDIO) as lines:
        for place in files:
            try:
                checked.append(_mended(place, course) if fix else _checked(place, course))
            except Refusal as refusal:
                click.echo(f"Error: {legible(refusal.message)}", err=True)
                unreadable = True
                continue
            if form == "text":
                _show(checked[-1], lines)
            click.echo(_verdict(checked[-1], form), err=True)
        if form != "text":
            for line in _FORMATS[form](checked):
                lines.write(line)
    if unreadable:
        return USAGE
    return FINDINGS if any(each.found if strict else each.errors for each in checked) else DONE


def _checked(place: str, course: bool) -> Checked:
    return Checked(place, *_found(read_program(place), course))


def _found(data: bytes, course: bool) -> tuple[str, tuple[Diagnostic, ...]]:
    """The text of a program, and its errors; its warnings if there are none."""
    text, found = diagnose_bytes(data)
    return text, found or warnings(parse_program(text).tree, course=course)


def _mended(place: str, course: bool) -> Checked:
    """A program with its fixes put in, and its file rewritten if there were any.

    Bytes that are not UTF-8 stay as they are, and so does the file: nobody knows what they mean.
    """
    data = read_program(place)
    mark = codecs.BOM_UTF8 if data.startswith(codecs.BOM_UTF8) else b""
    first, found = _found(data, course)
    if mark + first.encode(errors="replace") != data:
        return Checked(place, first, found)
    text = mended_throughout(first, lambda each: _found(each.encode(), course)[1])
    if text != first:
        write_whole(place, mark.decode() + text)
        click.echo(f"{legible(place)}: fixes put in", err=True)
        _, found = _found(text.encode(), course)
    return Checked(place, text, found)


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
