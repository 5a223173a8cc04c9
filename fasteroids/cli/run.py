"""`fasteroids run`: evolve a scene, and tell what happens."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import click

from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._files import STDIO, Lines, check_outputs, write_whole
from fasteroids.cli._fold import Fold
from fasteroids.cli._guard import DONE, INTERRUPTED
from fasteroids.cli._narrate import Narrator, census, counted, number
from fasteroids.cli._scenes import open_scene
from fasteroids.events import Happened
from fasteroids.state import World

__all__ = ["command"]


@click.command("run")
@options.scene
@options.span
@options.max_events
@options.model
@options.seed
@options.bots
@click.option(
    "--events", metavar="FILE",
    help="Write the events as JSON Lines, one an event; with '-' instead of the narration.",
)  # fmt: skip
@click.option(
    "--final", metavar="FILE",
    help="Write the world at the end as JSON; with '-' instead of the narration.",
)  # fmt: skip
@click.option(
    "--states", metavar="FILE",
    help="Write the world at each multiple of --every as JSON Lines; with '-' instead of the narration. "
    "Looking changes no event, except that with a thruster on, under the text's own (literal) rule of thrust, "
    "each look is a cut at which the ship is pushed.",
)  # fmt: skip
@click.option(
    "--every", metavar="S", type=options.Seconds(positive=True), help="How often --states looks, in s."
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print a summary as JSON, no narration.")
@click.option("--quiet", is_flag=True, help="Print nothing.")
def command(
    scene: str,
    span: float,
    max_events: int,
    model: str | None,
    seed: int | None,
    bots: tuple[str, ...],
    events: str | None,
    final: str | None,
    states: str | None,
    every: float | None,
    as_json: bool,
    quiet: bool,
) -> int:
    """Evolve SCENE and tell what happens, a line an event.

    SCENE is a file in TOML, '-' for standard input, or the name of a scene that comes with the package. Ctrl-C
    ends a run early: what was written stays, in whole lines, and --final gets the world as it was then.
    """
    if as_json and quiet:
        raise click.UsageError("--json and --quiet exclude each other")
    if (states is None) != (every is None):
        raise click.UsageError("--states and --every need each other")
    outputs = {"--events": events, "--final": final, "--states": states}
    check_outputs(scene, {**outputs, "--json": STDIO if as_json else None}, bots)
    title, world = open_scene(scene, seed=seed, model=model, bots=bots)
    narrated = not quiet and not as_json and STDIO not in outputs.values()
    opening = _opening(title, world, span)
    if not (narrated or quiet or as_json):
        click.echo(opening, err=True)
    watched = narrated and sys.stdout is not None and sys.stdout.isatty()
    progress = not (quiet or watched)
    fold = Fold(world, world.time + span, max_events=max_events, every=every, progress=progress)
    with fold, ExitStack() as stack:
        told: list[tuple[Lines, Callable[[Happened | None, World], str | None]]] = []
        if events is not None:
            told.append((stack.enter_context(Lines(events)), _event_line))
        if states is not None:
            told.append((stack.enter_context(Lines(states)), _state_line))
        if narrated:
            narrator = Narrator(world, span)
            narration = stack.enter_context(Lines(STDIO))
            narration.write(opening)
            told.append((narration, narrator.line))
        for step in fold:
            for lines, line_of in told:
                line = line_of(*step)
                if line is not None:
                    lines.write(line)
            if told and all(lines.gone for lines, _ in told) and not (final or as_json):
                return DONE  # nobody is listening any more
        if narrated:
            narration.write(f"{narrator.time(fold.world.time)}  {_closing(fold)}")
        stack.close()
        if final is not None:
            write_whole(final, records.indented(records.world_record(fold.world)))
        if as_json:
            with Lines(STDIO) as lines:
                lines.write(records.compact(_summary(title, fold)))
    return _ended(fold, {name: place for name, place in outputs.items() if place})


def _event_line(happened: Happened | None, _world: World) -> str | None:
    return None if happened is None else records.compact(records.event(happened))


def _state_line(happened: Happened | None, world: World) -> str | None:
    return None if happened is not None else records.compact(records.world_record(world))


def _opening(title: str, world: World, span: float) -> str:
    """What is about to run."""
    return (
        f"{title}: {census(world)} in {number(world.width)} x {number(world.height)} km, "
        f"from {number(world.time)} s to {number(world.time + span)} s; seed {world.seed}, model {world.model}"
    )


def _closing(fold: Fold) -> str:
    """What it came to."""
    kinds = ", ".join(counted(n, kind) for kind, n in sorted(fold.events.items()))
    events = counted(fold.total, "event") + (f" ({kinds})" if kinds else "")
    return f"{events}, {counted(fold.died, 'death')}; {census(fold.world)} left"


def _summary(title: str, fold: Fold) -> dict[str, Any]:
    world = fold.world
    return {
        "scene": title,
        "seed": world.seed,
        "model": world.model,
        "start": fold.start,
        "time": world.time,
        "stopped": fold.stopped,
        "events": dict(sorted(fold.events.items())),
        "deaths": fold.died,
        "births": fold.born,
        "entities": {
            "ship": len(world.ships),
            "asteroid": len(world.asteroids),
            "bullet": len(world.bullets),
        },
    }


def _ended(fold: Fold, outputs: dict[str, str]) -> int:
    """The exit code; on standard error what a user must know who expected the run to go to its end."""
    note = fold.note
    if note is not None:
        if fold.stopped != "max-events":
            for name, what in (
                ("--events", "all of them"),
                ("--final", "the world as it was then"),
            ):
                if outputs.get(name, STDIO) != STDIO:
                    note += f"; {outputs[name]!r} has {what}"
        click.echo(note, err=True)
    if fold.error is not None:
        raise fold.error
    return INTERRUPTED if fold.stopped == "interrupted" else DONE
