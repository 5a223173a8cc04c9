"""`fasteroids arena`: programs of ships compared over many seeds of a field."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import click

from fasteroids.arena import LIMIT, Ended, Game, crew, fixtures
from fasteroids.cli import _options as options
from fasteroids.cli import _records as records
from fasteroids.cli._bots import read_bot
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE, INTERRUPTED, Refusal
from fasteroids.cli._interrupt import Interruptible
from fasteroids.cli._kept import Kept, usual_folder
from fasteroids.cli._league import League, record, told
from fasteroids.cli._narrate import counted
from fasteroids.cli._pool import Stage, cores, played
from fasteroids.cli._progress import GamesProgress
from fasteroids.cli._scenes import read_scene
from fasteroids.cli._seeds import seeds_of
from fasteroids.units import ModelError

__all__ = ["command"]


class Seeds(click.ParamType[tuple[int, ...]]):
    """Seeds such as 7, 0-299 or 1,4,9-12."""

    name = "SEEDS"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """The seeds in order, or a usage error."""
        try:
            return seeds_of(value)
        except ValueError as error:
            self.fail(str(error), param, ctx)


@click.command("arena")
@click.argument("field", type=click.Path(allow_dash=True))
@click.option(
    "--bots", type=options.BotNames(), required=True, metavar="A,B,...",
    help="The programs to compare: files, or names of those that come with the package.",
)  # fmt: skip
@click.option(
    "--seeds", type=Seeds(), default="0-99", show_default=True, metavar="SEEDS",
    help="The seeds of the field, such as 7, 0-299 or 1,4,9-12.",
)  # fmt: skip
@click.option(
    "--for", "limit", type=options.Seconds(positive=True), default=LIMIT, show_default=True,
    help="A game ends without a winner after so many simulated seconds.",
)  # fmt: skip
@options.model
@click.option(
    "--jobs", type=click.IntRange(min=1), metavar="N",
    help="Play by so many processes.  [default: one for each processor]",
)  # fmt: skip
@click.option(
    "--keep", metavar="DIR", type=click.Path(),
    help="Keep the games in this folder.  [default: one in the user's cache]",
)  # fmt: skip
@click.option("--fresh", is_flag=True, help="Play also what is kept.")
@click.option("--json", "as_json", is_flag=True, help="Print everything, and each game, as JSON.")
def command(
    field: str,
    bots: tuple[str, ...],
    seeds: tuple[int, ...],
    limit: float,
    model: str | None,
    jobs: int | None,
    keep: str | None,
    fresh: bool,
    as_json: bool,
) -> int:
    """Compare ship programs in FIELD: how many of its seeds each clears, and whether one is better than another.

    FIELD is a scene as for `fasteroids run`. If it has one ship, each program is alone with each seed; it is to leave
    no asteroid. If it has two, every two programs play one against the other, twice on each seed, with sides swapped.
    Games that are done are kept, so that after Ctrl-C the same command goes on, and a new program or seed does not
    have the old ones played again. `fasteroids run FIELD --seed N --bots A --for 120` shows any of the games.
    """
    if keep == "":
        raise click.UsageError("--keep must be a folder; got ''")
    scene = read_scene(field)
    _refuse_twins(bots)
    programs = {bot: read_bot(bot) for bot in bots}
    world = scene.world(seed=seeds[0], model=model)
    try:
        ships = len(crew(world))
    except ModelError as error:
        raise Refusal(f"{scene.title}: {error}") from None
    if len(bots) < ships:
        raise Refusal(f"{scene.title} is for one against the other: give two bots or more")
    games = fixtures(bots, ships, seeds)
    kept = Kept(
        usual_folder() if keep is None else Path(keep),
        (scene.text, world.model, limit),
        {bot: program.code.source for bot, program in programs.items()},
    )
    stage = Stage(scene, programs, model, limit)
    done = {} if fresh else kept.recalled(games)
    if done:
        click.echo(f"kept from before: {len(done):,} of {counted(len(games), 'game')}", err=True)
    if not _finished(games, stage, kept, done, cores() if jobs is None else jobs):
        click.echo(_parting(len(done), len(games), kept, fresh=fresh), err=True)
        return INTERRUPTED
    league = League(
        scene.title, field, model, world.model, limit, seeds, bots,
        {game: done[game] for game in games},
    )  # fmt: skip
    with Lines(STDIO) as lines:
        for line in [records.compact(record(league))] if as_json else told(league):
            lines.write(line)
    return DONE


def _refuse_twins(bots: Sequence[str]) -> None:
    """`Refusal` if a program is named twice."""
    seen: dict[str, str] = {}
    for bot in bots:
        place = os.path.realpath(bot) if Path(bot).exists() else bot
        if place in seen:
            also = f", also as {seen[place]!r}" if seen[place] != bot else ""
            raise Refusal(f"the bot {bot!r} is named twice{also}; give each once")
        seen[place] = bot


def _finished(
    games: Sequence[Game],
    stage: Stage,
    kept: Kept,
    done: dict[Game, tuple[Ended, ...]],
    jobs: int,
) -> bool:
    """Play the games that are not `done`, put them there and keep them; false if Ctrl-C came before the end."""
    missing = [game for game in games if game not in done]
    progress = GamesProgress(len(done), len(games))
    try:
        with closing(played(missing, stage, jobs)) as unfold, Interruptible(unfold) as results:
            for game, ended in results:
                done[game] = ended
                kept.keep(game, ended)
                progress.show(len(done))
    finally:
        progress.close()
    return len(done) == len(games)


def _parting(done: int, games: int, kept: Kept, *, fresh: bool) -> str:
    """What to say of an arena that was interrupted."""
    if not kept.working:
        then = "what came after the warning is not kept"
    else:
        then = f"the same command {'without --fresh ' if fresh else ''}goes on from there"
    return f"interrupted: {done:,} of {counted(games, 'game')} are done; {then}"
