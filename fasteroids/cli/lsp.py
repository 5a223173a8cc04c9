"""`fasteroids lsp`: the language server, for editors to start."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from signal import SIG_DFL, SIGINT, signal

import click

from fasteroids.cli._guard import DONE, FINDINGS, Refusal

__all__ = ["command"]


@click.command("lsp")
@click.option("--stdio", is_flag=True, help="Use standard input and output, as it does anyway.")
def command(stdio: bool) -> int:
    """Serve editors: errors and warnings as you type, meanings, completion, names, the normal form, fixes.

    An editor starts this, and talks with it over standard input and output (Language Server Protocol 3.17); how to tell
    it so is in editors/README.md. It needs the extra 'lsp'. Exit codes: 0 the editor left in order, 1 it did not.
    """
    del stdio
    if find_spec("pygls") is None:
        raise Refusal("the language server needs an extra: pip install 'fasteroids[lsp]'")
    if sys.stdin is None or sys.stdin.isatty():
        raise Refusal("the language server is for editors to start: it reads no terminal")
    # Whoever waits in a read of standard input cannot be told to stop: let an interrupt end the process.
    signal(SIGINT, SIG_DFL)
    from fasteroids.lsp.server import serve

    return DONE if serve() else FINDINGS
