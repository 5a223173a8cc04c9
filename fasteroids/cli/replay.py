"""`fasteroids replay`: the last games, and a look at one of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fasteroids.cli import _arcade as arcade
from fasteroids.cli import _records as records
from fasteroids.cli._columns import aligned
from fasteroids.cli._files import STDIO, Lines
from fasteroids.cli._guard import DONE, Refusal
from fasteroids.cli._telling import told

if TYPE_CHECKING:
    from fasteroids.tui.recent import Brief

__all__ = ["command", "found_in_list"]


@click.command("replay")
@click.argument("file", required=False, type=click.Path())
@click.option("--json", "as_json", is_flag=True, help="List the recordings as JSON Lines.")
@arcade.screen
@arcade.plain
def command(
    file: str | None,
    as_json: bool,
    shown: arcade.Screen,
    plain: bool,
) -> int:
    """List the last games, the newest first; or look at a recording.

    FILE is a recording, or the number or name of one of the list. On the terminal its time goes forwards and
    backwards, and any moment can be taken over. '?' shows the keys.
    """
    from fasteroids.tui._store import data_folder
    from fasteroids.tui.launching import Recorded
    from fasteroids.tui.recent import briefs

    folder = data_folder() / "recordings"
    if file is None:
        return _list(briefs(folder), folder, as_json=as_json)
    if as_json:
        raise click.UsageError("--json is for the list, without FILE")
    wanted = Recorded(_place(file, briefs(folder)))
    if plain:
        return told(arcade.begun(wanted), live=False)
    return arcade.opened(wanted, shown)


def _list(found: list[Brief], folder: Path, *, as_json: bool) -> int:
    if not found and not as_json:
        click.echo(f"no games are recorded in {folder} yet", err=True)
        return DONE
    with Lines(STDIO) as lines:
        if as_json:
            for number, each in enumerate(found, 1):
                lines.write(records.compact(_record(number, each)))
            return DONE
        head = ("", "when", "game", "seed", "length", "file")
        rows = [_row(number, each) for number, each in enumerate(found, 1)]
        for line in aligned([head, *rows], right=(0, 3)):
            lines.write(line)
    return DONE


def _record(number: int, each: Brief) -> dict[str, Any]:
    return {
        "number": number,
        "file": str(each.place),
        "title": each.title,
        "seed": each.seed,
        "time": each.seconds,
        "whole": each.whole,
        "bytes": each.size,
        "written": each.when,
    }


def _row(number: int, each: Brief) -> tuple[str, ...]:
    length = "" if each.seconds is None else f"{each.seconds:.1f} s"
    cut = "" if each.whole or each.seconds is None else " (cut short)"
    seed = "" if each.seed is None else str(each.seed)
    return str(number), each.when, each.title, seed, length + cut, each.place.name


def _place(file: str, found: list[Brief]) -> Path:
    """The recording that is meant: a file wins over a name of the list, that over a number."""
    path = Path(file)
    if path.exists():
        return path
    listed = _listed(file, found)
    if listed is None:
        raise Refusal(f"there is no recording {file!r}; `fasteroids replay` lists those there are")
    return listed


def _listed(file: str, found: list[Brief]) -> Path | None:
    for number, each in enumerate(found, 1):
        if file in (str(number), each.place.name, each.place.name.partition(".")[0]):
            return each.place
    return None


def found_in_list(file: str) -> Path | None:
    """The recording with this number or name among the last games; None if there is none."""
    from fasteroids.tui._store import data_folder
    from fasteroids.tui.recent import briefs

    return _listed(file, briefs(data_folder() / "recordings"))
