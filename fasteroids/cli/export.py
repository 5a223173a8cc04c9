"""`fasteroids export`: a recording as tables for other programs, or a moment of it as a scene."""

from __future__ import annotations

import click

from fasteroids.cli import _options as options
from fasteroids.cli._files import STDIO, check_outputs, is_special, write_whole
from fasteroids.cli._guard import DONE
from fasteroids.cli._interrupt import terminable
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._recordings import clock_in, open_recording, titled
from fasteroids.cli._tables import TABLES, Tables
from fasteroids.cli._tabular import as_csv, duckdb_here, to_parquet, to_sqlite
from fasteroids.scene import dump_scene

__all__ = ["command"]

_FORMS = ["csv", "parquet", "sqlite", "scene"]


@click.command("export")
@click.argument("file", metavar="FILE", type=click.Path(allow_dash=True))
@click.option(
    "--to", "form", required=True, type=click.Choice(_FORMS),
    help="The form. Parquet needs DuckDB: pip install 'fasteroids[data]'.",
)  # fmt: skip
@click.option(
    "-o", "--output", metavar="OUT", required=True, type=click.Path(allow_dash=True),
    help="The file to write; '-' for standard output (csv and scene). One that is there is replaced.",
)  # fmt: skip
@click.option(
    "--table", type=click.Choice(list(TABLES)),
    help="The table of csv and parquet; sqlite gets all of them.  [default: events]",
)  # fmt: skip
@click.option(
    "--every", metavar="S", type=options.Seconds(positive=True),
    help="How often the table of states looks, in s.  [default: 1]",
)  # fmt: skip
@click.option(
    "--at", metavar="S", type=options.Seconds(),
    help="The time of the scene, in s.  [default: the end]",
)  # fmt: skip
@click.option("--quiet", is_flag=True, help="Print nothing.")
def command(
    file: str,
    form: str,
    output: str,
    table: str | None,
    every: float | None,
    at: float | None,
    quiet: bool,
) -> int:
    """Write the recording FILE as tables, or a moment of it as a scene.

    The tables: events, a row an event; states, every entity at the start, at each multiple of --every and at the end;
    prints, inputs and bookmarks. OUT has all of it or is as it was. '-' is standard input. DuckDB and pandas read
    recordings as they are, too.
    """
    _check(form, output, table, every, at)
    check_outputs(file, {"--output": output}, what="recording")
    duckdb = duckdb_here() if form == "parquet" else None
    recording, title = open_recording(file), titled(file)
    with terminable():
        if form == "scene":
            world = recording.at(clock_in(recording, title, at))
            write_whole(output, dump_scene(world))
            told = f"the world at {number(world.time)} s"
        else:
            tables = Tables(recording, title, 1.0 if every is None else every)
            if form == "sqlite":
                rows = to_sqlite(tables, output)
            elif duckdb is not None:
                rows = to_parquet(duckdb, tables, table or "events", output)
            else:
                text, rows = as_csv(tables, table or "events")
                write_whole(output, text)
            told = counted(rows, "row")
    if recording.short is not None:
        click.echo(f"{title}: {recording.short}", err=True)
    if not quiet:
        where = "standard output" if output == STDIO else repr(output)
        click.echo(f"{title}: {told} in {where}", err=True)
    return DONE


def _check(
    form: str, output: str, table: str | None, every: float | None, at: float | None
) -> None:
    """Usage errors of options that do not go together."""
    if table is not None and form in ("sqlite", "scene"):
        raise click.UsageError(f"--table is for csv and parquet, not for {form}")
    if at is not None and form != "scene":
        raise click.UsageError(f"--at is for a scene, not for {form}")
    if every is not None and form != "sqlite" and table != "states":
        raise click.UsageError("--every is for the table of states")
    if form in ("sqlite", "parquet") and (output == STDIO or is_special(output)):
        raise click.UsageError(f"{form} needs a plain file for --output")
