"""`fasteroids audit`: run a scene and measure how well the laws were kept."""

from __future__ import annotations

from math import isfinite
from typing import Any

import click
from attrs import asdict, evolve

from fasteroids.audit import Audit, Auditor, Margin
from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._columns import aligned
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._fold import Fold
from fasteroids.cli._guard import DONE, FINDINGS, INTERRUPTED
from fasteroids.cli._narrate import census, counted, label, listed, number
from fasteroids.cli._scenes import open_scene
from fasteroids.state import World

__all__ = ["command"]


@click.command("audit")
@options.scene
@options.span
@options.max_events
@options.model
@options.seed
@options.bots
@click.option("--json", "as_json", is_flag=True, help="Print the findings as JSON.")
def command(
    scene: str,
    span: float,
    max_events: int,
    model: str | None,
    seed: int | None,
    bots: tuple[str, ...],
    as_json: bool,
) -> int:
    """Run SCENE and measure how well the laws were kept: for each the worst margin seen.

    Overlaps are looked for at every event and between events. The exit code is 1 if a margin was exceeded.
    Events per second are those of the engine alone. SCENE is as for `fasteroids run`.
    """
    title, world = open_scene(scene, seed=seed, model=model, bots=bots)
    names = {i: label(f.entity) for i, f in world.all_flights().items()}
    auditor = Auditor(world)
    with Fold(world, world.time + span, max_events=max_events, progress=True) as fold:
        for happened, after in fold:
            if happened is not None:
                auditor.see(happened, after)
                names |= {i: label(after.flight_of(i).entity) for i in happened.born if i in after}
        fold.hide_progress()
        found = evolve(auditor.finish(fold.world), elapsed=fold.elapsed)
        with Lines(STDIO) as lines:
            if as_json:
                lines.write(records.compact(_record(title, fold, found)))
            else:
                for line in _told(title, world, fold, found, names):
                    lines.write(line)
    if fold.note is not None:
        click.echo(fold.note, err=True)
    if fold.error is not None:
        raise fold.error
    if fold.stopped == "interrupted":
        return INTERRUPTED
    return DONE if found.ok else FINDINGS


def _told(title: str, world: World, fold: Fold, found: Audit, names: dict[int, str]) -> list[str]:
    """The findings for people."""
    rows: list[tuple[str, ...]] = [
        ("law", "what", "worst", "", "ulps", "allowed", "at (s)", "who", "")
    ]
    rows += [_row(margin, names) for margin in found.margins]
    kinds = ", ".join(counted(n, kind) for kind, n in sorted(found.events.items())) or "none"
    rate = "" if found.rate is None else f", {found.rate:,.0f} a second"
    share = f" ({100.0 * found.undecided / found.asked:.2g} %)" if found.asked else ""
    drift = "nothing to measure" if found.energy_drift is None else f"{found.energy_drift:.2g}"
    changes = f"{counted(found.died, 'death')}, {counted(found.born, 'birth')}, {counted(found.clipped, 'clip')}"
    exceeded = sorted({margin.law for margin in found.margins if not margin.ok})
    verdict = f"exceeded: {listed(exceeded)}" if exceeded else "every law was kept"
    return [
        f"{title}: {census(world)}, from {number(fold.start)} s to {number(found.time)} s; "
        f"seed {world.seed}, model {world.model}",
        *aligned(rows),
        f"events         {kinds}{rate}",
        f"changes        {changes}",
        f"contact times  {found.asked:,}, of them exact because the filter was undecided: "
        f"{found.undecided:,}{share}",
        f"energy drift   {drift} of the total (deaths, births, clips and thrust change it rightly)",
        verdict,
    ]


def _row(margin: Margin, names: dict[int, str]) -> tuple[str, ...]:
    seen = margin.time is not None
    return (
        margin.law,
        margin.what,
        f"{margin.worst:.3g}" if seen else "none",
        margin.unit,
        "" if margin.ulps is None else f"{margin.ulps:.3g}",
        f"{margin.allowed:.3g}" if seen else "",
        "" if margin.time is None else number(margin.time),
        listed(names.get(i, f"#{i}") for i in margin.entities) if margin.entities else "",
        "" if margin.ok else "EXCEEDED",
    )


def _record(title: str, fold: Fold, found: Audit) -> dict[str, Any]:
    world = fold.world
    return {
        "scene": title,
        "seed": world.seed,
        "model": world.model,
        "start": fold.start,
        "time": found.time,
        "stopped": fold.stopped,
        "ok": found.ok,
        "margins": [_plain(asdict(margin)) for margin in found.margins],
        **_plain(asdict(found, filter=lambda a, _: a.name not in ("margins", "time"))),
        "events_per_second": found.rate,
    }


def _plain(record: dict[str, Any]) -> dict[str, Any]:
    """The record with null for what is not finite."""
    return {
        key: None if isinstance(value, float) and not isfinite(value) else value
        for key, value in record.items()
    }
