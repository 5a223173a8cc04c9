"""`fasteroids fmt`: ship programs in their one normal form."""

from __future__ import annotations

import os
from collections.abc import Iterator
from difflib import unified_diff
from pathlib import Path

import click
from attrs import frozen

from fasteroids.cli._files import STDIO, Lines, read_program, write_whole
from fasteroids.cli._guard import DONE, FINDINGS, USAGE, Refusal
from fasteroids.cli.check import MOST_SHOWN
from fasteroids.lang.formatter import laid_out
from fasteroids.lang.parser import Parsed, parse_bytes
from fasteroids.lang.report import legible, rendered

__all__ = ["command"]


@click.command("fmt")
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.option("--check", is_flag=True, help="Write nothing; name the files that would change.")
@click.option("--diff", is_flag=True, help="Write nothing; show what would change.")
def command(files: tuple[str, ...], check: bool, diff: bool) -> int:
    """Rewrite the ship programs in each FILE in their one normal form ('-': standard input to standard output).

    Two blanks a level, one statement a line, conditions in parentheses, no other parentheses than it needs. A program
    means the same as before. Comments stay, and one empty line where there were some.

    A program with syntax errors is left alone. With --check and --diff together the diff is shown. Exit codes: 0
    done, 1 there is something to change (--check, --diff), 2 a file has syntax errors or cannot be read or written
    (the others are done all the same).
    """
    failed = False
    would_change = False
    with Lines(STDIO) as lines:
        for place in files:
            try:
                each = _read(place)
                if check or diff:
                    would_change |= each.changes
                    for line in _shown(each, diff):
                        lines.write(line)
                    lines.flush()
                else:
                    _write(each, lines)
            except Refusal as refusal:
                click.echo(refusal.message, err=True)
                failed = True
    if failed:
        return USAGE
    return FINDINGS if would_change else DONE


@frozen
class _Formatted:
    """A program, as it was and as it is to be."""

    place: str
    before: str
    after: str

    @property
    def changes(self) -> bool:
        """Is there anything to write?"""
        return self.before != self.after


def _read(place: str) -> _Formatted:
    """A program, formatted. `Refusal` says on whole lines why that cannot be."""
    try:
        data = read_program(place)
    except Refusal as refusal:
        raise _error(refusal) from None
    parsed = parse_bytes(data)
    if parsed.program is None:
        raise Refusal(_report(place, parsed))
    # Without errors the bytes are UTF-8. A byte order mark, which the tree's source lacks, is a difference.
    return _Formatted(place, data.decode(), laid_out(parsed.program))


def _report(place: str, parsed: Parsed) -> str:
    """The syntax errors of a program, as `check` shows them."""
    faults = parsed.diagnostics
    more = len(faults) - MOST_SHOWN
    count = f"{len(faults)} error{'s' if len(faults) > 1 else ''} in {_name(place)}"
    rest = f"; {more} more than are shown" if more > 0 else ""
    shown = rendered(faults[:MOST_SHOWN], parsed.tree.source, place)
    return f"{shown}\n{count}{rest}: left as it is"


def _error(refusal: Refusal) -> Refusal:
    return Refusal(f"Error: {legible(refusal.message)}")


def _name(place: str) -> str:
    return "standard input" if place == STDIO else legible(place)


def _write(each: _Formatted, lines: Lines) -> None:
    """Put the new text in the place of the old one, if it differs; to standard output in any case."""
    if each.place == STDIO:
        for line in _lines(each.after):
            lines.write(line.removesuffix("\n"))
        return
    if not each.changes:
        return
    try:
        # A new file takes the place of the old one, so ask: that needs no permission of the old one.
        if not Path(each.place).is_file():
            raise Refusal(f"cannot write {each.place!r}: it is no plain file")
        if not os.access(each.place, os.W_OK):
            raise Refusal(f"cannot write {each.place!r}: permission denied")
        write_whole(each.place, each.after)
    except Refusal as refusal:
        raise _error(refusal) from None
    click.echo(f"{_name(each.place)}: changed", err=True)


def _shown(each: _Formatted, diff: bool) -> Iterator[str]:
    """What --check and --diff print of a program: lines without their ends."""
    if not each.changes:
        return
    if not diff:
        yield each.place
        return
    name = legible(each.place)
    for line in unified_diff(_lines(each.before), _lines(each.after), name, name):
        yield line.removesuffix("\n")
        if not line.endswith("\n"):
            yield "\\ No newline at end of file"


def _lines(text: str) -> list[str]:
    """Lines with their ends, which are LF: only those count for tools that read a diff."""
    *whole, last = text.split("\n")
    return [f"{line}\n" for line in whole] + [last] * bool(last)
