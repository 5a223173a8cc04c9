"""Tables as CSV, SQLite and Parquet. A file has all of it, or is as it was."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from fasteroids.cli._files import replacing
from fasteroids.cli._guard import Refusal
from fasteroids.cli._tables import TABLES, Row, Tables
from fasteroids.units import shown

__all__ = ["as_csv", "duckdb_here", "to_parquet", "to_sqlite"]

_BITS: Final = 63
"""Whole numbers of SQLite and Parquet are below 2 to this power."""

_BATCH: Final = 4096  # rows


def as_csv(tables: Tables, name: str) -> tuple[str, int]:
    """A table as CSV, with a head, and the number of its rows. Floats in the fewest digits that bring them back."""
    text, count = io.StringIO(), 0
    write = csv.writer(text, lineterminator="\n").writerow
    write(TABLES[name])
    for count, row in enumerate(tables.rows(name), 1):  # noqa: B007
        write([str(cell).lower() if isinstance(cell, bool) else cell for cell in row])
    return _encodable(text.getvalue()), count


def to_sqlite(tables: Tables, output: str) -> int:
    """Every table in a database; the number of all their rows. `Refusal` if it cannot be written."""
    import sqlite3  # slow to load, and for this alone

    count = 0
    with replacing(output) as beside:
        base = sqlite3.connect(beside, isolation_level=None)
        try:
            base.execute("PRAGMA journal_mode = OFF")  # nobody sees the file before it is whole
            base.execute("BEGIN")
            for name, types in TABLES.items():
                columns = ", ".join(f'"{column}" {kind}' for column, kind in types.items())
                base.execute(f'CREATE TABLE "{name}" ({columns})')
                marks = ", ".join("?" * len(types))
                for rows in _batches(tables, name):
                    base.executemany(f'INSERT INTO "{name}" VALUES ({marks})', rows)
                    count += len(rows)
            base.execute("COMMIT")
        except sqlite3.Error as error:
            raise Refusal(f"cannot write {output!r}: {error}") from None
        finally:
            base.close()
    return count


def duckdb_here() -> Any:
    """The module that writes Parquet; `Refusal` that says how to install it."""
    try:
        import duckdb
    except ImportError:
        raise Refusal(
            "Parquet needs DuckDB, which is not installed: pip install 'fasteroids[data]'; "
            "or use --to csv or --to sqlite"
        ) from None
    return duckdb


def to_parquet(duckdb: Any, tables: Tables, name: str, output: str) -> int:
    """A table as Parquet, by way of JSON Lines beside it; the number of rows. `Refusal` if it cannot be written."""
    types, count = TABLES[name], 0
    with replacing(output) as beside:
        lines = beside.with_name(beside.name + ".jsonl")
        try:
            with lines.open("x", encoding="ascii") as file:
                for rows in _batches(tables, name):
                    count += len(rows)
                    for row in rows:
                        file.write(json.dumps(dict(zip(types, row, strict=True))) + "\n")
            columns = ", ".join(f"{column}: '{kind}'" for column, kind in types.items())
            source = f"read_json({_quoted(lines)}, format = 'newline_delimited', columns = {{{columns}}})"
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


def _batches(tables: Tables, name: str) -> Iterator[list[Row]]:
    """The rows of a table, many at a time, as a database takes them."""
    columns = list(TABLES[name])
    batch: list[Row] = []
    for row in tables.rows(name):
        cells = zip(row, columns, strict=True)
        batch.append(tuple(_fitting(cell, column, tables.title) for cell, column in cells))
        if len(batch) == _BATCH:
            yield batch
            batch = []
    if batch:
        yield batch


def _fitting(cell: Any, column: str, title: str) -> Any:
    """A cell as a database can hold it; `Refusal` for a whole number that it cannot."""
    if isinstance(cell, str):
        return _encodable(cell)
    if isinstance(cell, int) and cell.bit_length() > _BITS:
        raise Refusal(
            f"{title}: {column} {shown(cell)} has more than {_BITS} bits, which only --to csv can hold"
        )
    return cell


def _encodable(text: str) -> str:
    """A text without halves of surrogate pairs, which JSON can hold and UTF-8 cannot."""
    return text.encode("utf-8", "backslashreplace").decode()
