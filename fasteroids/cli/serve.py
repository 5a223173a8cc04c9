"""`fasteroids serve`: the game in browsers."""

from __future__ import annotations

import os
import shlex
import sys
from importlib import import_module
from importlib.util import find_spec
from ipaddress import ip_address

import click
from attrs import evolve

from fasteroids.cli import _arcade as arcade
from fasteroids.cli import _options as options
from fasteroids.cli._guard import DONE, Refusal

__all__ = ["command"]


@click.command("serve")
@click.option(
    "--host", default="127.0.0.1", show_default=True, metavar="NAME",
    help="Where to listen. All but loopback lets others in, and each visitor takes a process.",
)  # fmt: skip
@click.option("--port", type=click.IntRange(1, 65535), default=8000, show_default=True, metavar="N")
@arcade.seed
@options.model
@arcade.screen
def command(
    host: str,
    port: int,
    seed: int | None,
    model: str | None,
    shown: arcade.Screen,
) -> int:
    """Play in a browser: serve the game at http://127.0.0.1:8000, until Ctrl-C. It needs the extra 'web'.

    Each visitor has a game of its own, in a process on this machine, with the scores and recordings of whoever started
    this, and can read files by their paths as that user can. Serve to others only whom you trust.
    """
    if find_spec("textual_serve") is None:
        raise Refusal("the game in a browser needs an extra: pip install 'fasteroids[web]'")
    serve = import_module("textual_serve.server").Server  # an extra: types may be missing
    shown = evolve(shown, seed=seed, model=model)
    words = [sys.executable, "-m", "fasteroids", "play", *shown.words]
    if not _loopback(host):
        click.echo(
            f"Warning: {host} is not loopback: whoever reaches this machine can play here, and read your files",
            err=True,
        )
    # What is served is told to be by a variable; one that is there already would end up in every game.
    os.environ.pop(arcade.WEB, None)
    serve(shlex.join(words), host=host, port=port, title="Fasteroids").serve()
    return DONE


def _loopback(host: str) -> bool:
    """Is this a place that only this machine reaches?"""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
