"""`fasteroids play`: the game."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from attrs import evolve

from fasteroids.cli import _arcade as arcade
from fasteroids.cli import _options as options
from fasteroids.cli._telling import told

if TYPE_CHECKING:
    from fasteroids.tui.launching import Wanted

__all__ = ["command"]

_PILOT, _FIGHTER = "ace", "hunter"
"""The programs that fly where --plain has no human: against asteroids, and against another ship."""


@click.command("play")
@click.argument("scene", required=False, type=click.Path(allow_dash=True))
@click.option(
    "--ai", "-ai", metavar="FILE",
    help="The program of the opponent: a file, or the name of one that comes with the package.",
)  # fmt: skip
@click.option("--two", is_flag=True, help="Two players on one keyboard.")
@arcade.seed
@options.model
@arcade.screen
@click.option(
    "--plain", is_flag=True,
    help="Tell the game in words, a line an event, without a terminal; programs fly what people would.",
)  # fmt: skip
def command(
    scene: str | None,
    ai: str | None,
    two: bool,
    seed: int | None,
    model: str | None,
    shown: arcade.Screen,
    plain: bool,
) -> int:
    """Play on the terminal.

    Without SCENE and options the start screen asks what. SCENE is a file in TOML, '-' for standard input with --plain,
    or the name of a scene that comes with the package: you fly its first ship, with --two the first two, and --ai is
    for the others. Without SCENE --ai plays against that program, and --two is for two players.

    Arrows turn and thrust, space fires; the second player has WASD, and Control, Tab or F. '?' shows all keys. Esc
    leads back to the start screen, and from there out. Games are recorded: `fasteroids replay` lists them.

    --plain reads no keys: programs that come with the package fly in place of people, for 120 s at most.
    """
    if ai is not None and two and scene is None:
        raise click.UsageError("--two and --ai need a SCENE with three ships or more")
    if scene == "-" and not plain:
        raise click.UsageError("standard input has the keys; give a file, or --plain")
    wanted = _wanted(scene, ai, 2 if two else 1, seed, model, plain)
    if plain:
        return told(arcade.begun(wanted), live=True)
    shown = evolve(shown, seed=seed, model=model)
    asked = scene is not None or ai is not None or two
    return arcade.opened(wanted if asked else None, shown)


def _wanted(
    scene: str | None, ai: str | None, humans: int, seed: int | None, model: str | None, plain: bool
) -> Wanted:
    """What the options say is to be played; with `plain` programs fly what people would."""
    from fasteroids.tui.launching import NewGame, SceneGame, new_seed

    if scene is not None:
        bots = () if ai is None else (ai,)
        return SceneGame(scene, humans, bots, seed, model, _FIGHTER if plain else None)
    duel = ai is not None or humans == 2
    person = (_FIGHTER if duel else _PILOT) if plain else None
    crew = (person, ai or person) if duel else (person,)
    drawn = new_seed() if seed is None else seed
    return NewGame("duel" if duel else "waves", crew, drawn, model or arcade.MODEL)
