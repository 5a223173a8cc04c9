"""`fasteroids explain`: which parts of the model a scene needs, and why; or what a code of a fault means."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import Any, Final

import click
from attrs import frozen

from fasteroids import models
from fasteroids.cli import _codes as codes
from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE
from fasteroids.cli._narrate import census, counted, label, listed, number
from fasteroids.cli._scenes import open_scene
from fasteroids.engine import GRID_FROM, needs
from fasteroids.entities import Bullet, Entity, Ship
from fasteroids.grid import fitting
from fasteroids.physics import distance
from fasteroids.state import World
from fasteroids.units import TICKS_PER_SECOND

__all__ = ["Advice", "advice", "command"]

_FAR: Final = 1e6
_RANGE: Final = 1e100
"""Where the formula of the text is as good as any, measured: distances up to 1e6 times the sum of the radii, and
products of lengths, speeds and masses that keep within 1e-100 to 1e100, so that none leaves the doubles."""

_MOST_NAMED = 5

_PROVEN: Final = (
    "robust gives the proven sequence of events until errors have grown by 36 bits: some 60 events among ten "
    "discs, 120 among thirty"
)
"""Measured: errors grow by 0.6 bits an event among 3 to 10 discs, by 0.3 among 30, in a box of 1000 km."""


@frozen
class Part:
    """A part of the model: is it used, and the reason in a sentence."""

    used: bool
    why: str


@frozen
class Advice:
    """The cheapest level that decides this scene well, and the reasons in a sentence each."""

    level: str
    why: tuple[str, ...]


@click.command("explain")
@options.scene
@options.model
@options.seed
@options.bots
@click.option("--json", "as_json", is_flag=True, help="Print it as JSON.")
def command(
    scene: str, model: str | None, seed: int | None, bots: tuple[str, ...], as_json: bool
) -> int:
    """Say which parts of the model SCENE needs, and why; or what a code such as FA012 means.

    A part that is left out costs nothing and changes nothing. SCENE is as for `fasteroids run`. Codes are FA and
    three digits, and stand before what `fasteroids check` finds in a program.
    """
    if codes.is_code(scene):
        if model is not None or seed is not None or bots:
            raise click.UsageError("--model, --seed and --bots are for scenes, not for codes")
        with Lines(STDIO) as lines:
            lines.write(codes.told(scene, as_json=as_json))
        return DONE
    title, world = open_scene(scene, seed=seed, model=model, bots=bots)
    parts, level = plan(world), advice(world)
    with Lines(STDIO) as lines:
        if as_json:
            lines.write(records.compact(_record(title, world, parts, level)))
        else:
            for line in _told(title, world, parts, level):
                lines.write(line)
    return DONE


def plan(world: World) -> dict[str, Part]:
    """The parts by name, from the entities as they are now."""
    used = needs(world)
    entities = [f.entity for f in world.all_flights().values()]
    ticking = [f.entity for f in world.all_flights().values() if f.next_tick is not None]
    thrusting = [e for e in entities if type(e) is Ship and e.thruster]
    bullets = [e for e in entities if type(e) is Bullet]
    return {
        "grid": Part(used.grid, _why_grid(world, entities)),
        "thrust": Part(
            used.thrust,
            f"the thruster is on: {_named(thrusting)}" if thrusting else "no ship's thruster is on",
        ),
        "bullets": Part(
            used.bullets, f"in flight: {_named(bullets)}" if bullets else "no bullet is in flight"
        ),
        "ticks": Part(
            used.ticks,
            f"a program runs: {_named(ticking)}" if ticking else "no ship runs a program",
        ),
    }


def _why_grid(world: World, entities: list[Entity]) -> str:
    few = counted(len(entities), "entity").replace("entitys", "entities")
    if len(entities) < GRID_FROM:
        return f"{few}: with fewer than {GRID_FROM} it is faster to compare every disc with every other"
    columns, rows = fitting(world.width, world.height, entities)
    widest = max(entities, key=lambda e: e.radius)
    if (columns, rows) == (1, 1):
        return (
            f"cells must be wider than the largest disc ({label(widest)}, 2 r = {number(2.0 * widest.radius)} km) "
            "and than what rounding does to positions in a world of this size, and too few of those fit"
        )
    return f"{few}: neighbours are looked for in {columns} x {rows} cells"


def advice(world: World) -> Advice:
    """Which level decides when discs of these sizes, speeds and masses touch, from cheap scalars."""
    entities = [f.entity for f in world.flights if f is not None]
    if len(entities) < 2:
        return Advice("spec", ("there is nothing to collide with",))
    small, next_small = sorted(e.radius for e in entities)[:2]
    extent, sigma = max(world.width, world.height), small + next_small
    speeds = [s for s in _speeds(entities) if s > 0.0] or [0.0]
    ships = [e.mass for e in entities if type(e) is Ship] or [1.0]
    wanting = []
    if not extent < _FAR * sigma:
        wanting.append(
            f"the world is {_roughly(extent / sigma)} times as long as the smallest sum of radii "
            f"({number(sigma)} km); from {number(_FAR)} on, rounding in the formula of the text can turn a hit into "
            "a miss"
        )
    products = [extent * max(speeds), sigma * min(speeds)]
    if not all(z == 0.0 or 1.0 / _RANGE < z < _RANGE for z in products):
        wanting.append(
            f"lengths times speeds go from {number(products[1])} to {number(products[0])} km^2/s; their squares "
            "can leave the range of doubles"
        )
    if not all(1.0 / _RANGE < mass < _RANGE for mass in ships):
        wanting.append(
            f"masses of ships go from {number(min(ships))} to {number(max(ships))} kg, far from ordinary numbers"
        )
    if wanting:
        return Advice("robust", tuple(wanting))
    return Advice(
        "spec",
        (
            f"the world is {_roughly(extent / sigma)} times as long as the smallest sum of radii, speeds and masses "
            "are ordinary: the formula of the text decides all but grazing contacts right",
        ),
    )


def _speeds(entities: Iterable[Entity]) -> Iterable[float]:
    """Speeds there are, and those that a thruster or a program can bring."""
    for e in entities:
        yield e.speed
        if type(e) is Ship and (e.thruster or e.program is not None):
            yield e.max_speed


def thrust_rules(world: World) -> str:
    """When the two rules of thrust will differ in this scene.

    A thruster without power bends no path, but under `literal` its ship's flight is cut all the same.
    """
    ships = [f.entity for f in world.all_flights().values() if type(f.entity) is Ship]
    on = [e for e in ships if e.thruster]
    burning = [e for e in on if e.thrust_power > 0.0]
    able = [e for e in ships if e.program is not None and e.program.running]
    if burning:
        fastest = max(burning, key=lambda e: distance(*e.acceleration))
        late = 0.5 * distance(*fastest.acceleration) / TICKS_PER_SECOND
        return (
            f"literal and smooth differ from the start, since the thruster is on: {_named(burning)}. Cut every "
            f"{1.0 / TICKS_PER_SECOND} s, literal leaves {label(fastest)} {_roughly(late)} km behind for each second "
            "below its speed limit, and every event anywhere moves its path; smooth flies it exactly"
        )
    if on:
        return (
            "literal and smooth differ by rounding alone until a thruster with power is switched on, since what is "
            f"on has no power: {_named(on)}"
        )
    if able:
        return f"literal and smooth give the same bits until a program switches a thruster on: {_named(able)}"
    if ships:
        return "literal and smooth give the same bits until a player switches a thruster on"
    return "literal and smooth give the same bits: there is no ship to thrust"


def _roughly(value: float) -> str:
    """A number for people who want its size: two digits."""
    return number(float(f"{value:.2g}"))


def _named(entities: list[Entity] | list[Ship] | list[Bullet]) -> str:
    names = [label(e) for e in entities[:_MOST_NAMED]]
    more = len(entities) - len(names)
    return listed([*names, f"{more} more"] if more else names)


def _told(title: str, world: World, parts: dict[str, Part], level: Advice) -> list[str]:
    promise = models.named(world.model).promise
    lines = [
        f"{title}: {census(world)} in {number(world.width)} x {number(world.height)} km; seed {world.seed}",
        f"model    {world.model}: {promise}",
    ]
    lines += [
        f"{name:8} {'used' if part.used else 'left out'}: {part.why}"
        for name, part in parts.items()
    ]
    lines.append(f"rules    {thrust_rules(world)}")
    lines.append(f"level    {_verdict(world, level)}: {'; '.join(level.why)}")
    lines.append(f"         {_PROVEN}")
    lines.append(
        "The plan is made anew from the entities whenever one changes: firing, thrusting or a program may "
        "enlarge it. A part that is left out changes nothing else."
    )
    return [line for text in lines for line in _wrapped(text)]


def _verdict(world: World, level: Advice) -> str:
    here, advised = models.named(world.model), models.named(level.level)
    if here.filtered is advised.filtered:  # smooth decides as robust does
        return f"{here.name} is enough"
    if level.level != "spec":
        return f"{level.level} is advised"
    if here.thrust != advised.thrust:
        return f"{here.name} is on the safe side; spec would decide as well, but its rule of thrust is {advised.thrust}"
    return f"spec would do, {here.name} is on the safe side"


def _wrapped(text: str) -> list[str]:
    hanging = " " * 9 if text[:1].islower() or text[:1] == " " else ""
    return textwrap.wrap(text, 100, subsequent_indent=hanging, break_long_words=False) or [text]


def _record(title: str, world: World, parts: dict[str, Part], level: Advice) -> dict[str, Any]:
    return {
        "scene": title,
        "seed": world.seed,
        "model": {"name": world.model, "promise": models.named(world.model).promise},
        "parts": {name: {"used": part.used, "why": part.why} for name, part in parts.items()},
        "thrust_rules": thrust_rules(world),
        "level": {"advised": level.level, "why": list(level.why)},
    }
