"""The command line: one thin module a command, each imported only when it is called.

Data goes to standard output, talk to standard error. Exit codes: 0 done, 1 findings, 2 usage or bad input, 3 our
bug, 130 interrupted.
"""

from __future__ import annotations

import gc
from importlib import import_module
from typing import Final

import click

from fasteroids.cli._guard import guarded

__all__ = ["main"]

COMMANDS: Final = {
    "play": "Play on the terminal.",
    "watch": "Look on while the programs of a scene play.",
    "replay": "List the last games, or look at one again.",
    "debug": "Step through ship programs, forwards and backwards.",
    "serve": "Play in a browser.",
    "run": "Evolve a scene and tell what happens.",
    "record": "Run a scene into a recording.",
    "verify": "Live recordings again, and compare.",
    "diff": "Find where two recordings part.",
    "show": "Show what is in a recording, or how somebody died.",
    "export": "Write a recording as tables, or its world as a scene.",
    "audit": "Run a scene and measure how well the laws were kept.",
    "trace": "Tell each small step of a ship's program.",
    "check": "Find every fault of ship programs.",
    "fmt": "Bring ship programs into their one normal form.",
    "explain": "Say what a scene needs of the model, or what a code means.",
    "arena": "Compare ship programs over many seeds of a field.",
    "new": "Write a program or a scene to start from.",
    "lsp": "Serve editors: the language server.",
}
"""The commands, with what the help says of them."""


_COLLECT_AFTER: Final = 200_000
"""New records (Python: 700)."""


class Commands(click.Group):
    """The commands by name. Listing them imports none of them."""

    def __init__(self, **settings: object) -> None:
        stubs = [click.Command(name, help=text) for name, text in COMMANDS.items()]
        super().__init__(commands=stubs, **settings)  # type: ignore[arg-type]

    def list_commands(self, _ctx: click.Context) -> list[str]:
        """In the order of use, not of the alphabet."""
        return list(COMMANDS)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command a user named, imported now."""
        name, stub, rest = super().resolve_command(ctx, args)
        if stub is None:
            return name, None, rest
        command: click.Command = import_module(f"{__name__}.{name}").command
        return name, command, rest

    def invoke(self, ctx: click.Context) -> None:
        """Call the command; whatever goes wrong ends in an exit code.

        Worlds and diagnostics are many small records without cycles: the collector is to look at them seldom.
        """
        usual = gc.get_threshold()
        gc.set_threshold(_COLLECT_AFTER)
        try:
            ctx.exit(guarded(lambda: super(Commands, self).invoke(ctx)))
        finally:
            gc.set_threshold(*usual)


main = Commands(
    name="fasteroids",
    help="""Fasteroids: a pure-functional, event-driven Asteroids engine.

    A SCENE is a file in TOML, '-' for standard input, or the name of a scene that comes with the package. A FILE
    is a ship program. Data goes to standard output, talk to standard error.

    Exit codes: 0 done, 1 findings, 2 usage or bad input, 3 a bug in fasteroids, 130 interrupted.
    """,
    context_settings={"help_option_names": ["-h", "--help"]},
)
click.version_option(package_name="fasteroids", message="%(prog)s %(version)s")(main)
