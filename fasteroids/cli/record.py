"""`fasteroids record`: run a scene into a file that can be looked at, compared, and lived again."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic
from typing import IO, Any

import click

from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._files import STDIO, Lines, check_outputs, is_special
from fasteroids.cli._fold import Fold
from fasteroids.cli._guard import DONE, INTERRUPTED, Refusal
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._scenes import open_scene
from fasteroids.history.inputs import Cut, Place
from fasteroids.history.living import Lived
from fasteroids.history.recording import Header, RecordingFile, headed
from fasteroids.history.recording.writing import EVERY_HASH, EVERY_SNAPSHOT, LEAST_EVERY
from fasteroids.state import World

__all__ = ["command"]


class Interval(options.Seconds):
    """A number of seconds that is not too short for hashes and snapshots."""

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """The number, or a usage error."""
        seconds = super().convert(value, param, ctx)
        if seconds < LEAST_EVERY:
            self.fail(f"must be at least {LEAST_EVERY!r} s; got {value!r}", param, ctx)
        return seconds


@click.command("record")
@options.scene
@click.option(
    "-o", "--output", metavar="FILE", required=True, type=click.Path(allow_dash=True),
    help="The file of the recording, '-' for standard output; compressed by gzip if it ends in .gz.",
)  # fmt: skip
@options.span
@options.max_events
@options.model
@options.seed
@options.bots
@click.option(
    "--every", metavar="S", type=options.Seconds(positive=True),
    help="Cut time at each multiple of so many s. It changes nothing, except that under the text's own (literal) rule "
    "of thrust each cut is one at which a ship is pushed.",
)  # fmt: skip
@click.option(
    "--hashes", metavar="S", type=Interval(), default=EVERY_HASH, show_default=True,
    help="Fingerprints of the world so often, in s.",
)  # fmt: skip
@click.option(
    "--snapshots", metavar="S", type=Interval(), default=EVERY_SNAPSHOT, show_default=True,
    help="The whole world so often, in s.",
)  # fmt: skip
@click.option("--force", is_flag=True, help="Replace the file if there is one.")
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON.")
@click.option("--quiet", is_flag=True, help="Print nothing.")
def command(
    scene: str,
    output: str,
    span: float,
    max_events: int,
    model: str | None,
    seed: int | None,
    bots: tuple[str, ...],
    every: float | None,
    hashes: float,
    snapshots: float,
    force: bool,
    as_json: bool,
    quiet: bool,
) -> int:
    """Run SCENE into a recording, a file of JSON Lines.

    It tells the first world, the programs, everything that happens, and now and then the whole world. `fasteroids
    verify` runs it again and compares. Ctrl-C ends it early: what was recorded by then is whole. Whatever else ends
    it, even a crash, leaves a file that can be read up to the last second before. SCENE is as for `fasteroids run`.
    """
    if as_json and quiet:
        raise click.UsageError("--json and --quiet exclude each other")
    check_outputs(scene, {"--output": output, "--json": STDIO if as_json else None}, bots)
    replaced = _replaced(output, force=force)
    title, world = open_scene(scene, seed=seed, model=model, bots=bots)
    header = headed(world, title=title, slice=every, every_hash=hashes, every_snapshot=snapshots)
    fold = Fold(world, world.time + span, max_events=max_events, every=every, progress=not quiet)
    with fold, _opened(output, replaced=replaced) as file:
        size = _recorded(fold, world, header, file, packed=output.endswith(".gz"))
    if as_json:
        with Lines(STDIO) as lines:
            lines.write(records.compact(_summary(title, output, fold, size, replaced=replaced)))
    if fold.note is not None:
        click.echo(f"{fold.note}; {_called(output)} has all of them", err=True)
    elif not (quiet or as_json):
        click.echo(_told(title, output, fold, size, replaced=replaced), err=True)
    if fold.error is not None:
        raise fold.error
    return INTERRUPTED if fold.stopped == "interrupted" else DONE


def _recorded(fold: Fold, world: World, header: Header, file: IO[bytes], *, packed: bool) -> int:
    """Record a run to its end; the number of characters that it came to before they were compressed."""
    with RecordingFile(file, world, header, clock=monotonic, packed=packed) as recording:
        for state in _lived(fold, world):
            recording.add(state)
        recording.finish((*fold.world.now, 0.0), fold.stopped)
    return recording.recorder.size


def _lived(fold: Fold, world: World) -> Iterator[Lived]:
    """The steps of a run as states of a past: its events, and the cuts at its samples and at its end."""
    place = Place(*world.now)
    for happened, after in fold:
        if happened is None:
            place = place.reaching(after.now)
            yield Lived(place, Cut(after.clock), after)
        else:
            place = place.after(after.now)
            yield Lived(place, happened, after)
    if fold.stopped == "time":
        last = fold.world
        yield Lived(place.reaching(last.now), Cut(last.clock), last)


# The file.


def _replaced(output: str, *, force: bool) -> bool:
    """Is there a file that is to be replaced? `Refusal` if there is one that is not."""
    if output == STDIO or is_special(output) or not os.path.lexists(output):
        return False
    if not force:
        raise Refusal(f"there is a file {output!r} already; --force replaces it")
    return True


@contextmanager
def _opened(output: str, *, replaced: bool) -> Iterator[IO[bytes]]:
    """The file to write, or standard output. Its errors are a `Refusal`, but that nobody reads it any more."""
    file = _stdout() if output == STDIO else None
    try:
        if file is None:
            file = Path(output).open("wb" if replaced or is_special(output) else "xb")  # noqa: SIM115
        yield file
        if output != STDIO:
            file.close()
    except BrokenPipeError:
        raise
    except FileExistsError:
        raise Refusal(f"there is a file {output!r} by now; --force replaces it") from None
    except OSError as error:
        raise Refusal(f"cannot write {_called(output)}: {error.strerror or error}") from None
    finally:
        if file is not None and output != STDIO:
            with suppress(OSError):
                file.close()


def _stdout() -> IO[bytes]:
    """Standard output; if it is closed, a place where what is written is lost, as it is for the other commands."""
    if sys.stdout is None:
        return Path(os.devnull).open("wb")
    sys.stdout.flush()
    return sys.stdout.buffer


# What is told.


def _called(output: str) -> str:
    return "standard output" if output == STDIO else repr(output)


def _told(title: str, output: str, fold: Fold, size: int, *, replaced: bool) -> str:
    """A line for people."""
    was = ", which was replaced" if replaced else ""
    return (
        f"{title}: {counted(fold.total, 'event')} from {number(fold.start)} s to {number(fold.world.time)} s, "
        f"seed {fold.world.seed}, model {fold.world.model}: {size:,} bytes of lines in {_called(output)}{was}"
    )


def _summary(title: str, output: str, fold: Fold, size: int, *, replaced: bool) -> dict[str, Any]:
    return {
        "scene": title,
        "recording": output,
        "replaced": replaced,
        "seed": fold.world.seed,
        "model": fold.world.model,
        "start": fold.start,
        "time": fold.world.time,
        "stopped": fold.stopped,
        "events": dict(sorted(fold.events.items())),
        "bytes": size,
    }
