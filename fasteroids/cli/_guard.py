"""What may go wrong, and the exit code of each."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable
from typing import Any

import click

from fasteroids.units import ModelError

__all__ = [
    "BUG",
    "DONE",
    "FINDINGS",
    "INTERRUPTED",
    "USAGE",
    "Refusal",
    "guarded",
    "mute",
    "reason",
]

DONE, FINDINGS, USAGE, BUG, INTERRUPTED = 0, 1, 2, 3, 130

_LAST_FRAMES = 5


class Refusal(click.ClickException):
    """Bad input: a sentence on standard error, exit code 2."""

    exit_code = USAGE


def guarded(command: Callable[[], Any]) -> int:
    """Call a command that returns an exit code; a code for everything that can go wrong too.

    Faults of the caller are a sentence each: `ModelError`, and `OSError` of a file. A reader of standard output
    that left early (`| head`) has seen what it wanted. Anything else is a bug of ours, and says so.
    """
    try:
        return int(command() or DONE)
    except (click.ClickException, click.exceptions.Exit):
        raise
    except ModelError as error:
        raise Refusal(str(error)) from None
    except BrokenPipeError:
        mute()
        return DONE
    except OSError as error:
        mute()
        raise Refusal(reason(error)) from None
    except MemoryError:
        raise Refusal("this takes more memory than there is") from None
    except (KeyboardInterrupt, click.Abort):
        click.echo("interrupted", err=True)
        return INTERRUPTED
    except Exception as error:
        frames = traceback.format_tb(error.__traceback__)[-_LAST_FRAMES:]
        what = "".join(traceback.format_exception_only(error)).strip()
        click.echo(f"this is a bug in fasteroids: {what}\n{''.join(frames)}", err=True, nl=False)
        return BUG


def reason(error: OSError, place: object = None) -> str:
    """The sentence for a file that cannot be read or written.

    `place` is what to call it where the error does not know: one of a file that was open already, as of a full disk.
    """
    text = error.strerror or str(error)
    name = error.filename if error.filename is not None or place is None else str(place)
    return f"{name!r}: {text}" if name is not None else text


def mute() -> None:
    """Let go of a standard output that cannot be written, so that Python does not try again as it ends."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (AttributeError, OSError, ValueError):  # it is closed, or no file
        return
