"""`fasteroids debug`: a recording or a scene, in a pause, at the moment and the ship that matter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from attrs import evolve

from fasteroids.cli import _arcade as arcade
from fasteroids.cli import _options as options
from fasteroids.cli._files import STDIO, names_file, shipped
from fasteroids.cli._guard import Refusal, reason
from fasteroids.cli._recordings import BEGIN
from fasteroids.cli.replay import found_in_list
from fasteroids.units import ModelError

if TYPE_CHECKING:
    from fasteroids.tui.launching import Wanted

__all__ = ["command"]


@click.command("debug")
@click.argument("place", metavar="FILE|SCENE", type=click.Path(allow_dash=True))
@click.option(
    "--at", metavar="S", type=options.Seconds(), help="Begin at this time, in s; a scene lives up to there first."
)  # fmt: skip
@click.option("--ship", "who", metavar="NAME", help="Select this ship: its name or its id.")
@options.bots
@options.seed
@options.model
@arcade.screen
def command(
    place: str,
    at: float | None,
    who: str | None,
    bots: tuple[str, ...],
    seed: int | None,
    model: str | None,
    shown: arcade.Screen,
) -> int:
    """Debug ship programs: FILE is a recording, or the number or name of one that `fasteroids replay` lists.

    It opens in a pause: where the ship of --ship is about to die, if it does, else at its end. A SCENE, a file in TOML
    or the name of one that comes with the package, opens at its beginning, and lives when time goes on.

    Step by statement with F7 and F8, set breakpoints with F9 and F10, run to them with F4 and F5, edit the program
    with F2. '?' shows all keys.
    """
    if place == STDIO:
        raise click.UsageError("standard input has the keys; give a file")
    wanted = _wanted(place, bots, seed, model)
    arcade.insist()
    begun = arcade.begun(wanted)
    from fasteroids.tui.visiting import visited

    try:
        begun = evolve(begun, session=visited(begun.session, at, who))
    except ModelError as error:
        raise Refusal(f"{begun.title}: {error}") from None
    return arcade.opened(begun, evolve(shown, seed=seed, model=model))


def _wanted(place: str, bots: tuple[str, ...], seed: int | None, model: str | None) -> Wanted:
    """What is meant: a file wins over a scene of the package, that over the list of recordings."""
    from fasteroids.tui.launching import Recorded, SceneGame

    recording = _recording(place)
    if recording is None:
        return SceneGame(place, 0, bots, seed, model)
    if bots or seed is not None or model is not None:
        raise click.UsageError("--bots, --seed and --model are for scenes; a recording has its own")
    return Recorded(recording)


def _recording(place: str) -> Path | None:
    """The recording that is meant; None if it is a scene, or nothing that is there."""
    path = Path(place)
    if path.is_file():
        try:
            with path.open("rb") as file:
                return path if file.read(2).startswith(BEGIN) else None
        except OSError as error:
            raise Refusal(f"cannot read {reason(error, place)}") from None
    return None if names_file(path) or place in shipped() else found_in_list(place)
