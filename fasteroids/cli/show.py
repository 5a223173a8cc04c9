"""`fasteroids show`: what is in a recording: a summary, the world at a time, how somebody died."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any, Final

import click

from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._columns import aligned
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE, Refusal
from fasteroids.cli._narrate import census, number
from fasteroids.cli._recordings import clock_in, open_recording, titled
from fasteroids.cli._summary import Cast, summary, told
from fasteroids.entities import Asteroid, Bullet, Entity, Ship
from fasteroids.history.deaths import Death, Deed, why
from fasteroids.history.recording import Recording
from fasteroids.history.recording.loading import timeline_of
from fasteroids.scene import dump_scene
from fasteroids.state import World, describe
from fasteroids.units import ModelError

__all__ = ["command", "table"]


@click.command("show")
@click.argument("file", metavar="FILE", type=click.Path(allow_dash=True))
@click.option(
    "--at", metavar="S", type=options.Seconds(),
    help="Show the world at this time, in s, after all that happened then.",
)  # fmt: skip
@click.option("--why", "who", metavar="NAME", help="Tell how an entity died: its name or its id.")
@click.option("--scene", "as_scene", is_flag=True, help="Show the world of --at as a scene.")
@click.option("--json", "as_json", is_flag=True, help="Print it as JSON.")
def command(file: str, at: float | None, who: str | None, as_scene: bool, as_json: bool) -> int:
    """Show the recording FILE: a summary, or the world at a time of it, or how somebody died.

    The summary tells how it was made, how far it goes, what happened, who died, and its bookmarks. '-' is standard
    input.
    """
    if at is not None and who is not None:
        raise click.UsageError("--at and --why exclude each other")
    if as_scene and (at is None or as_json):
        raise click.UsageError("--scene needs --at, and excludes --json")
    recording, title = open_recording(file), titled(file)
    if recording.short is not None:
        click.echo(f"{title}: {recording.short}", err=True)
    with Lines(STDIO) as lines:
        if who is not None:
            death = _death(recording, title, who)
            lines.write(records.compact(_death_record(death)) if as_json else str(death))
        elif at is None:
            found = summary(recording, title)
            for line in [records.compact(found)] if as_json else told(found):
                lines.write(line)
        else:
            world = recording.at(clock_in(recording, title, at))
            for line in _world(title, world, as_scene=as_scene, as_json=as_json):
                lines.write(line)
    return DONE


# The world at a time.


def _world(title: str, world: World, *, as_scene: bool, as_json: bool) -> list[str]:
    if as_scene:
        return [dump_scene(world).removesuffix("\n")]
    if as_json:
        return [records.compact(records.world_record(world))]
    size = f"{number(world.width)} x {number(world.height)} km"
    return [f"{title} at {world.time!r} s: {census(world)} in {size}", "", *table(world)]


_HEADS: Final = ("id", "kind", "name", "x", "y", "vx", "vy", "radius", "")


def table(world: World) -> list[str]:
    """The entities of a world at its clock, a line each, in the order of their ids (km, km/s)."""
    if not world.entities:
        return []
    rows = [_row(e) for e in world.entities.values()]
    return aligned([_HEADS, *rows], right={0, 3, 4, 5, 6, 7})


def _row(e: Entity) -> tuple[str, ...]:
    numbers = (number(value) for value in (e.x, e.y, e.vx, e.vy, e.radius))
    name = e.name or ""
    name = name if name.isprintable() else repr(name)
    return (str(e.id), e.kind, name, *numbers, _more(e))


def _more(e: Entity) -> str:
    """What a kind has beside what all have."""
    match e:
        case Ship():
            parts = [f"mass {number(e.mass)}", f"direction {number(e.direction)}"]
            parts += ["thrusting"] * e.thruster
            if e.program is not None:
                parts.append("program runs" if e.program.running else "program stopped")
            return ", ".join(parts)
        case Bullet():
            return f"of ship #{e.source}" + ", bounced" * bool(e.bounced)
        case Asteroid():
            return ""


# How somebody died.


def _death(recording: Recording, title: str, who: str) -> Death:
    """The death meant: of the last that died of those of this name, or of the one with this id."""
    cast = Cast(recording)
    meant = cast.meant(who)
    if not meant:
        near = get_close_matches(who, sorted(cast.names.values()), n=1)
        hint = f" (did you mean {near[0]!r}?)" if near else ""
        raise Refusal(
            f"{title}: there was no {who!r}{hint}; give a name or an id, 1 to {max(cast.ids, default=1)}"
        )
    died = [i for i in meant if i in cast.died]
    try:
        return why(
            timeline_of(recording), max(died, key=cast.died.__getitem__) if died else meant[-1]
        )
    except ModelError as error:
        raise Refusal(f"{title}: {error}") from None


def _death_record(death: Death) -> dict[str, Any]:
    return {
        "entity": death.entity.id,
        "name": death.entity.name,
        "time": death.time,
        "how": death.how,
        "fixed_since": death.inevitable.time,
        "flights": [
            {
                "entity": course.entity.id,
                "who": describe(course.entity),
                "since": course.since.time,
                "x": course.entity.x,
                "y": course.entity.y,
                "vx": course.entity.vx,
                "vy": course.entity.vy,
            }
            for course in death.courses
        ],
        "shots": [_deed(deed) for deed in death.shots],
        "deeds": [_deed(deed) for deed in death.deeds],
    }


def _deed(deed: Deed) -> dict[str, Any]:
    return {"ship": deed.ship, "action": deed.action, "time": deed.state.place.time}
