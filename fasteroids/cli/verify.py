"""`fasteroids verify`: does what was recorded still happen?"""

from __future__ import annotations

from typing import Any

import click
from attrs import asdict

from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE, FINDINGS, INTERRUPTED, USAGE, Refusal
from fasteroids.cli._interrupt import Interruptible
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._progress import RunProgress
from fasteroids.cli._recordings import open_recording, titled
from fasteroids.history.recording import Event, Recording, Verified
from fasteroids.history.recording.verifying import verifying
from fasteroids.units import ModelError

__all__ = ["command"]


@click.command("verify")
@click.argument(
    "files", nargs=-1, required=True, metavar="FILE...", type=click.Path(allow_dash=True)
)
@click.option(
    "--slice", "slice_", metavar="S", type=options.Seconds(positive=True),
    help="Cut time at each multiple of so many s while it is lived again; that may not change anything.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="JSON Lines, one a file.")
def command(files: tuple[str, ...], slice_: float | None, as_json: bool) -> int:
    """Live each recording FILE again and compare all that it tells; a line a file, with the first difference.

    '-' is standard input. A file that was cut short is compared as far as it goes. All the files are read, also after
    one that differs or cannot be read. Exit code 1 if one differs, 2 if one is no recording.
    """
    if files.count(STDIO) > 1:
        raise click.UsageError("standard input can be read once")
    worst = DONE
    with Lines(STDIO) as lines:
        for place in files:
            try:
                recording = open_recording(place)
                found = _found(place, recording, slice_)
            except Refusal as refusal:
                lines.flush()
                refusal.show()
                worst = max(worst, USAGE)
                continue
            if found is None:
                click.echo(f"interrupted while {titled(place)} was lived again", err=True)
                return INTERRUPTED
            record = _record(place, recording, found)
            lines.write(records.compact(record) if as_json else _told(record, found))
            if lines.gone:
                return DONE
            worst = max(worst, DONE if found.difference is None else FINDINGS)
    return worst


def _found(place: str, recording: Recording, slice_: float | None) -> Verified | None:
    """What came of living a recording again; None after Ctrl-C. `Refusal` if it cannot be sliced so."""
    progress = RunProgress(recording.world.time, recording.time)
    try:
        with Interruptible(verifying(recording, slice=slice_)) as steps:
            for compared, time in enumerate(steps, 1):
                progress.show(time, compared)
        return steps.result
    except ModelError as error:
        raise Refusal(f"{titled(place)}: {error}") from None
    finally:
        progress.close()


def _record(place: str, recording: Recording, found: Verified) -> dict[str, Any]:
    compared = recording.lines[: found.lines - 1]
    return {
        "file": titled(place),
        "ok": found.difference is None,
        "events": sum(isinstance(line, Event) for line in compared),
        "lines": found.lines,
        "time": found.until,
        "short": found.short,
        "same_libm": found.same_libm,
        "difference": None if found.difference is None else asdict(found.difference),
    }


def _told(record: dict[str, Any], found: Verified) -> str:
    """A line for people."""
    told = f"{counted(record['events'], 'event')} to {number(found.until)} s"
    if found.difference is not None:
        told = f"differs after {told}: {found.difference}"
    elif found.short is not None:
        told = f"ok as far as it goes, {told}; {found.short}"
    else:
        told = f"ok, {told}"
    if not found.same_libm:
        told += "; it was recorded where sin and cos give other numbers than here"
    return f"{record['file']}: {told}"
