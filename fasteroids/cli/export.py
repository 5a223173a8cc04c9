"""`fasteroids export`: a recording as tables for other programs, or a moment of it as a scene."""

from __future__ import annotations

import csv
import io
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import click

from fasteroids.cli import _options as options
from fasteroids.cli._files import STDIO, check_outputs, is_special, replacing, write_whole
from fasteroids.cli._guard import DONE, Refusal
from fasteroids.cli._interrupt import terminable
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._recordings import clock_in, open_recording, titled
from fasteroids.cli._tables import TABLES, Row
from fasteroids.history.recording import Recording
from fasteroids.scene import dump_scene
from fasteroids.units import shown

__all__ = ["command"]

_BITS: Final = 63
"""Whole numbers of SQLite and Parquet are below 2 to this power."""

_BATCH: Final = 4096  # rows


@click.command("export")
@click.argument("file", metavar="FILE", type=click.Path(allow_dash=True))
@click.option(
    "--to", "form", required=True, type=click.Choice(["csv", "parquet", "sqlite", "scene"]),
    help="The form. Parquet needs DuckDB: pip install 'fasteroids[data]'.",
)  # fmt: skip
@click.option(
    "-o", "--output", metavar="OUT", required=True, type=click.Path(allow_dash=True),
    help="The file to write; '-' for standard output (csv and scene). One that is there is replaced.",
)  # fmt: skip
@click.option(
    "--table", "name", type=click.Choice(list(TABLES)),
    help="The table of csv and parquet; sqlite gets all of them.  [default: events]",
)  # fmt: skip
@click.option(
    "--at", metavar="S", type=options.Seconds(),
    help="The time of the scene, s.  [default: the end]",
)  # fmt: skip
@click.option("--quiet", is_flag=True, help="Print nothing.")
def command(
    file: str, form: str, output: str, name: str | None, at: float | None, quiet: bool
) -> int:
    """Write the recording FILE as tables, or a moment of it as a scene.

    The tables: events, a row an event; states, every entity at the start, at each snapshot and at the end; prints,
    inputs and bookmarks. OUT has all of it or is as it was. '-' is standard input. DuckDB and pandas read recordings
    as they are, too.
    """
    if name is not None and form in ("sqlite", "scene"):
        raise click.UsageError(f"--table is for csv and parquet, not for {form}")
    if at is not None and form != "scene":
        raise click.UsageError(f"--at is for a scene, not for {form}")
    check_outputs(file, {"--output": output}, what="recording")
    if form in ("sqlite", "parquet") and (output == STDIO or is_special(output)):
        raise click.UsageError(f"{form} needs a plain file for --output")
    duckdb = _duckdb() if form == "parquet" else None
    recording, title = open_recording(file), titled(file)
    with terminable():
        if form == "scene":
            world = recording.at(clock_in(recording, title, at))
            write_whole(output, dump_scene(world))
            told = f"the world at {number(world.time)} s"
        elif form == "sqlite":
            told = counted(_sqlite(recording, title, output), "row")
        elif duckdb is not None:
            told = counted(_parquet(duckdb, recording, title, output, name or "events"), "row")
        else:
            text, rows = _csv(recording, name or "events")
            write_whole(output, text)
            told = counted(rows, "row")
    if recording.short is not None:
        click.echo(f"{title}: {recording.short}", err=True)
    if not quiet:
        where = "standard output" if output == STDIO else repr(output)
        click.echo(f"{title}: {told} in {where}", err=True)
    return DONE


# CSV.


def _csv(recording: Recording, name: str) -> tuple[str, int]:
    """A table as CSV, with a head, and the number of its rows. Floats in the fewest digits that bring them back."""
    table, rows = TABLES[name], 0
    text = io.StringIO()
    write = csv.writer(text, lineterminator="\n").writerow
    write(table.columns)
    for rows, row in enumerate(table.rows(recording), 1):  # noqa: B007
        write([str(cell).lower() if isinstance(cell, bool) else cell for cell in row])
    return text.getvalue().encode("utf-8", "backslashreplace").decode(), rows


# SQLite.


def _sqlite(recording: Recording, title: str, output: str) -> int:
    """Every table in a database; the number of all their rows."""
    import sqlite3  # slow to load, and for this alone

    count = 0
    with replacing(output) as beside:
        base = sqlite3.connect(beside, isolation_level=None)
        try:
            base.execute("PRAGMA journal_mode = OFF")  # nobody sees the file before it is whole
            base.execute("BEGIN")
            for name, table in TABLES.items():
                columns = ", ".join(f'"{column}" {kind}' for column, kind in table.columns.items())
                base.execute(f'CREATE TABLE "{name}" ({columns})')
                marks = ", ".join("?" * len(table.columns))
                for rows in _batches(recording, title, name):
                    base.executemany(f'INSERT INTO "{name}" VALUES ({marks})', rows)
                    count += len(rows)
            base.execute("COMMIT")
        except sqlite3.Error as error:
            raise Refusal(f"cannot write {output!r}: {error}") from None
        finally:
            base.close()
    return count


# Parquet.


def _duckdb() -> Any:
    """The module; `Refusal` that says how to install it."""
    try:
        import duckdb
    except ImportError:
        raise Refusal(
            f"Parquet needs DuckDB, which is not installed: {Path(sys.executable).name} -m pip install "
            "'fasteroids[data]'; or use --to csv or --to sqlite"
        ) from None
    return duckdb


def _parquet(duckdb: Any, recording: Recording, title: str, output: str, name: str) -> int:
    """A table as Parquet, by way of JSON Lines beside it; the number of rows."""
    columns, count = TABLES[name].columns, 0
    with replacing(output) as beside:
        lines = beside.with_name(beside.name + ".jsonl")
        try:
            with lines.open("x", encoding="ascii") as file:
                for rows in _batches(recording, title, name):
                    count += len(rows)
                    for row in rows:
                        file.write(json.dumps(dict(zip(columns, row, strict=True))) + "\n")
            types = "{" + ", ".join(f"{column}: '{kind}'" for column, kind in columns.items()) + "}"
            source = f"read_json({_quoted(lines)}, format = 'newline_delimited', columns = {types})"
            with duckdb.connect() as base:
                base.execute(
                    f"COPY (SELECT * FROM {source}) TO {_quoted(beside)} (FORMAT parquet, COMPRESSION zstd)"
                )
        except duckdb.Error as error:
            raise Refusal(f"cannot write {output!r}: {str(error).splitlines()[0]}") from None
        finally:
            lines.unlink(missing_ok=True)
    return count


def _quoted(path: Path) -> str:
    """A path as a text of SQL."""
    return "'" + str(path).replace("'", "''") + "'"


def _batches(recording: Recording, title: str, name: str) -> Iterator[list[Row]]:
    """The rows of a table, many at a time, as a database takes them."""
    columns, batch = list(TABLES[name].columns), []
    for row in TABLES[name].rows(recording):
        batch.append(
            tuple(_fitting(cell, column, title) for cell, column in zip(row, columns, strict=True))
        )
        if len(batch) == _BATCH:
            yield batch
            batch = []
    if batch:
        yield batch


def _fitting(cell: Any, column: str, title: str) -> Any:
    """A cell as a database can hold it; `Refusal` for a whole number that it cannot."""
    if isinstance(cell, str):
        return cell.encode("utf-8", "backslashreplace").decode()
    if isinstance(cell, int) and cell.bit_length() > _BITS:
        raise Refusal(
            f"{title}: the {column} {shown(cell)} has more than {_BITS} bits, which only --to csv can hold"
        )
    return cell
