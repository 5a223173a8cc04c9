"""`fasteroids trace`: the small steps of a ship's program, as they are taken in a scene."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any, Final

import click

from fasteroids.actions import Action, Turn
from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._fold import Fold
from fasteroids.cli._guard import DONE, INTERRUPTED, Refusal
from fasteroids.cli._narrate import counted, label, number
from fasteroids.cli._scenes import open_scene
from fasteroids.entities import Ship, id_of
from fasteroids.events import Happened
from fasteroids.history.stepping import is_tick_of, last_steps, traced
from fasteroids.lang import Halted, Machine, Running
from fasteroids.lang.machine.traced import MOST_STEPS, Step, Traced
from fasteroids.lang.machine.values import Value, shown
from fasteroids.lang.parser.lexer import lines as source_lines
from fasteroids.lang.report import legible
from fasteroids.state import World

__all__ = ["command"]

_SPAN: Final = 1.0
"""How long (s) is traced if nobody says: five ticks."""

_WIDEST: Final = 60  # characters of source shown of one step


@click.command("trace")
@options.scene
@click.option(
    "--ship",
    metavar="NAME",
    help="The ship: its name or its id. Not needed if one only has a program.",
)
@click.option(
    "--from",
    "start",
    metavar="S",
    type=options.Seconds(),
    help="From this time of the world, s.  [default: now]",
)
@click.option(
    "--to", "end", metavar="S", type=options.Seconds(),
    help=f"Up to and including this time, s.  [default: {number(_SPAN)} s after --from]",
)  # fmt: skip
@options.max_events
@options.model
@options.seed
@options.bots
@click.option("--json", "as_json", is_flag=True, help="JSON Lines, one a step.")
def command(
    scene: str,
    ship: str | None,
    start: float | None,
    end: float | None,
    max_events: int,
    model: str | None,
    seed: int | None,
    bots: tuple[str, ...],
    as_json: bool,
) -> int:
    """Tell each small step of a ship's program in SCENE: its place and text, what it came to, what it changed.

    A step is a node of an expression or a statement that has its value; a tick may take as many as the fuel of the
    world allows.
    """
    _, world = open_scene(scene, seed=seed, model=model, bots=bots)
    pilot = _pilot(world, ship)
    start = world.time if start is None else start
    end = start + _SPAN if end is None else end
    if end < start or start < world.time:
        raise click.UsageError(
            f"--from {number(start)} and --to {number(end)} must be in order, and not before the scene's "
            f"{number(world.time)} s"
        )
    fold = Fold(traced(world, pilot), end, max_events=max_events, progress=start > world.time)
    ticks = 0
    with fold, Lines(STDIO) as lines:
        for happened, after in fold:
            if not _wanted(happened, pilot, start):
                continue
            assert happened is not None
            fold.hide_progress()
            ticks += 1
            for told in _told(happened, after, pilot, as_json=as_json):
                lines.write(told)
            if lines.gone:
                return DONE
    if fold.error is not None:
        raise fold.error
    if fold.note is not None:
        click.echo(fold.note, err=True)
    last = fold.world.time
    fate = _fate(fold.world, pilot)
    click.echo(
        f"{counted(ticks, 'tick')} from {number(start)} s to {number(max(start, last))} s{fate}",
        err=True,
    )
    return INTERRUPTED if fold.stopped == "interrupted" else DONE


def _pilot(world: World, name: str | None) -> int:
    """The id of the ship meant: by its name, else by its id. `Refusal` says which there are."""
    flown = [s for s in world.ships if isinstance(s.program, Machine)]
    if not flown:
        raise Refusal("no ship of this scene has a program")
    known = ", ".join(f"{label(s)} (id {s.id})" if s.name else str(s.id) for s in flown)
    if name is None:
        meant = flown
    else:
        meant = [s for s in world.ships if s.name == name]
        meant = meant or [s for s in world.ships if name.removeprefix("#") == str(s.id)]
    if len(meant) > 1:
        raise Refusal(f"say which ship with --ship ID: {known}")
    if not meant:
        near = get_close_matches(name or "", [s.name or str(s.id) for s in flown], n=1)
        hint = f" (did you mean {near[0]!r}?)" if near else ""
        raise Refusal(f"there is no ship {name!r}{hint}; with a program: {known}")
    if not isinstance(meant[0].program, Machine):
        raise Refusal(f"{label(meant[0])} has no program; with one: {known}")
    return id_of(meant[0])


def _fate(world: World, pilot: int) -> str:
    """Why there are no more ticks, if so."""
    if pilot not in world:
        return "; the ship is dead"
    ship = world[pilot]
    assert isinstance(ship, Ship)
    if isinstance(ship.program, Traced) and isinstance(halted := ship.program.machine, Halted):
        where = f" on line {halted.span.line}" if halted.span else ""
        return (
            f"; the program stopped{where}: {halted.reason}"
            if halted.reason
            else "; the program is over"
        )
    return ""


def _wanted(happened: Happened | None, pilot: int, start: float) -> bool:
    """Is this a tick of the ship, not before the start? (Going there first would be a cut, which thrust may feel.)"""
    return happened is not None and happened.time >= start and is_tick_of(happened, pilot)


def _told(happened: Happened, after: World, pilot: int, *, as_json: bool) -> Iterator[str]:
    """The lines of one tick."""
    steps = last_steps(after, pilot)
    if not as_json:
        yield f"{happened.time:.3f}  {label(after[pilot])}: {counted(len(steps), 'step')}"
    for i, step in enumerate(steps, 1):
        text = _source(step)
        if as_json:
            yield records.compact(_record(happened.time, i, step, text))
        else:
            yield f"  {_place(step):<7} {text}{_outcome(step)}"
    if len(steps) == MOST_STEPS:
        told = f"only the first {MOST_STEPS:,} steps of this tick are kept"
        yield records.compact({"time": happened.time, "note": told}) if as_json else f"  {told}"
    if not as_json and happened.effect == "fuel":
        yield "  no fuel left; it goes on at its next tick"


def _place(step: Step) -> str:
    return f"{step.span.line}:{step.span.column}"


def _source(step: Step) -> str:
    """The text of a step, on one line, cut where it is long."""
    lines = source_lines(step.before.code.source)[step.span.line - 1 : step.span.end_line]
    if not lines:
        return ""
    if len(lines) > 1:
        text = lines[0][step.span.column - 1 :].rstrip() + " ..."
    else:
        text = lines[0][step.span.column - 1 : step.span.end_column - 1]
    text = legible(text)
    return text if len(text) <= _WIDEST else text[: _WIDEST - 3] + "..."


def _outcome(step: Step) -> str:
    """What a step came to, for people."""
    parts = []
    if step.value is not None:
        parts.append(f"= {shown(step.value[0])}")
    parts += [f"{name} is now {shown(value)}" for name, value in step.changed.items()]
    if step.action is not None:
        parts.append(_action(step.action))
    if step.printed is not None:
        parts.append(f"prints {step.printed}")
    if isinstance(step.after, Halted):
        parts.append(f"stops: {step.after.reason}" if step.after.reason else "the end")
    return "".join(f"  -> {part}" for part in parts)


def _action(action: Action) -> str:
    if isinstance(action, Turn):
        return f"turns by {shown(action.angle)}"
    return records.action_name(action)


def _record(time: float, i: int, step: Step, text: str) -> dict[str, Any]:
    record: dict[str, Any] = {"time": time, "step": i, **step.span._asdict(), "source": text}
    if step.value is not None:
        record["value"] = _plain(step.value[0])
    if step.changed:
        record["changed"] = {name: _plain(value) for name, value in step.changed.items()}
    if step.action is not None:
        record["action"] = records.action_name(step.action)
        if isinstance(step.action, Turn):
            record["angle"] = step.action.angle
    if step.printed is not None:
        record["printed"] = step.printed
    if isinstance(step.after, Halted):
        record["halted"] = step.after.reason or "end"
    assert isinstance(step.before, Running)
    return record


def _plain(value: Value) -> object:
    """A value in JSON: numbers and truths as they are, null, an entity by what it is called; nan and inf as text."""
    if value is None or isinstance(value, bool):
        return value
    text = shown(value)
    return value if isinstance(value, float) and text not in ("nan", "inf", "-inf") else text
