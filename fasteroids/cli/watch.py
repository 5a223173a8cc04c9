"""`fasteroids watch`: look on while programs play."""

from __future__ import annotations

import click

from fasteroids.cli import _arcade as arcade
from fasteroids.cli import _options as options
from fasteroids.cli._telling import told

__all__ = ["command"]


@click.command("watch")
@options.scene
@options.bots
@options.seed
@options.model
@arcade.screen
@arcade.plain
def command(
    scene: str,
    bots: tuple[str, ...],
    seed: int | None,
    model: str | None,
    shown: arcade.Screen,
    plain: bool,
) -> int:
    """Look on while the programs of SCENE play, on the terminal.

    SCENE is a file in TOML, '-' for standard input with --plain, or the name of a scene that comes with the package.
    Time can be paused, and gone back in; any moment can be taken over. '?' shows the keys.
    """
    from fasteroids.tui.launching import SceneGame

    if scene == "-" and not plain:
        raise click.UsageError("standard input has the keys; give a file, or --plain")
    wanted = SceneGame(scene, 0, bots, seed, model)
    if plain:
        return told(arcade.begun(wanted), live=True)
    return arcade.opened(wanted, shown)
