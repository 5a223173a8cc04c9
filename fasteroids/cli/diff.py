"""`fasteroids diff`: where do two recordings part?"""

from __future__ import annotations

from typing import Any

import click
from attrs import asdict

from fasteroids.cli import _records as records
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE, FINDINGS
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._recordings import open_recording, titled
from fasteroids.history.recording import Difference, Event, Recording, differing, parting
from fasteroids.units import shown

__all__ = ["command"]


@click.command("diff")
@click.argument("first", metavar="A", type=click.Path(allow_dash=True))
@click.argument("second", metavar="B", type=click.Path(allow_dash=True))
@click.option("--json", "as_json", is_flag=True, help="Print it as JSON.")
def command(first: str, second: str, as_json: bool) -> int:
    """Find the first difference of two recordings, A and B: its time, entity and field, and what each says there.

    If they begin differently it also tells where what happened parts. Bookmarks, titles and versions do not count. If
    one was cut short they are compared as far as it goes. Nothing is lived again: `fasteroids verify` does that. '-' is
    standard input. Exit code 1 if there is a difference.
    """
    if first == second == STDIO:
        raise click.UsageError("standard input can be read once")
    a, b = open_recording(first), open_recording(second)
    found = differing(a, b)
    later = parting(a, b) if found is not None and found.line == 1 else None
    names = titled(first), titled(second)
    with Lines(STDIO) as lines:
        if as_json:
            lines.write(records.compact(_record(names, found, later)))
        elif found is None:
            lines.write(_same(a, b))
        else:
            for line in _told(names, found):
                lines.write(line)
            if found.line == 1:
                for line in _parted(names, later):
                    lines.write(line)
        for name, recording in zip(names, (a, b), strict=True):
            if recording.short is not None and not as_json:
                click.echo(f"{name}: {recording.short}", err=True)
    return DONE if found is None else FINDINGS


def _same(a: Recording, b: Recording) -> str:
    """That there is no difference, and how far."""
    shorter = min(a, b, key=lambda recording: recording.until[:2])
    events = sum(isinstance(line, Event) for line in shorter.lines)
    return f"no difference: {counted(events, 'event')} to {number(shorter.time)} s"


def _told(names: tuple[str, str], found: Difference) -> list[str]:
    """A difference for people: where it is, and what each of the two says."""
    who = "" if found.entity is None else f", #{found.entity}"
    sides = zip(names, (found.recorded, found.found), strict=True)
    return [
        f"line {found.line}, at {found.time!r} s{who}: {found.field}",
        *(f"  {name}: {'nothing' if value is None else shown(value)}" for name, value in sides),
    ]


def _parted(names: tuple[str, str], later: Difference | None) -> list[str]:
    """Where what happened parts, of two that begin differently."""
    if later is None:
        return ["what happened is the same"]
    first, *rest = _told(names, later)
    return [f"what happened parts on {first}", *rest]


def _record(
    names: tuple[str, str], found: Difference | None, later: Difference | None
) -> dict[str, Any]:
    return {
        "files": names,
        "same": found is None,
        "difference": found and _values(found),
        "happened": later and _values(later),
    }


def _values(found: Difference) -> dict[str, Any]:
    difference = asdict(found)
    difference["values"] = [difference.pop("recorded"), difference.pop("found")]
    return difference
