"""Tables of a scene file and everything that is wrong with them.

Each value is looked at twice. Its type is checked here, for a message in the terms of TOML; what numbers are
allowed the constructors know, and their own guards are asked, field by field. Nothing stops at the first fault.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, TypeAlias, TypeVar

from attrs import frozen

from fasteroids.scene._text import BARE, MOST_BITS, Path, Problem, SceneError, lines_of, shown
from fasteroids.units import ModelError

__all__ = [
    "INTEGER",
    "NUMBER",
    "SWITCH",
    "TEXT",
    "Faults",
    "Fields",
    "Table",
    "Type",
    "are_numbers",
    "check_headers",
    "guarded",
    "is_integer",
    "is_number",
    "nearest",
    "tables_of",
    "typed",
]

T = TypeVar("T")

Fields: TypeAlias = Mapping[str, "Type"]
"""What may stand in a table."""


@frozen
class Type:
    """What a message says is allowed, and whether a value of TOML is of that type."""

    allowed: str
    fits: Callable[[Any], bool]


def is_number(value: Any) -> bool:
    """Is it an integer or a float? A bool is neither."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def is_integer(value: Any) -> bool:
    """Is it an integer, and not a bool?"""
    return isinstance(value, int) and not isinstance(value, bool)


def are_numbers(value: Any, *lengths: int) -> bool:
    """Is it an array of numbers, of one of these lengths?"""
    return isinstance(value, list) and len(value) in lengths and all(map(is_number, value))


NUMBER = Type("must be a number", is_number)
INTEGER = Type("must be an integer", is_integer)
TEXT = Type("must be text in quotes", lambda value: isinstance(value, str))
SWITCH = Type("must be true or false", lambda value: isinstance(value, bool))


@frozen
class Table:
    """A table of a document: where it is, how messages call it, and its values."""

    path: Path
    label: str
    values: Mapping[str, Any]


class Faults:
    """The problems found so far in a text, each at its line."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._lines: dict[Path, int] | None = None
        self._found: list[Problem] = []

    def __len__(self) -> int:
        return len(self._found)

    def line(self, path: Path) -> int | None:
        """The line of a table or key; of the nearest one above it that has a line, None if none has."""
        if self._lines is None:
            self._lines = lines_of(self._text)
        while path and path not in self._lines:
            path = path[:-1]
        return self._lines.get(path)

    def add(self, table: Table, message: str, field: str | None = None) -> None:
        """One more problem: of a field, shown with its value if it has one, or of the whole table."""
        path, value = table.path, None
        if field is not None:
            path = (*path, field)
            value = shown(table.values[field]) if field in table.values else None
            field = _key(field)
        self._found.append(Problem(self.line(path), table.label or None, field, value, message))

    def stop(self) -> None:
        """`SceneError` if there is a problem."""
        if self._found:
            raise SceneError(sorted(self._found, key=lambda p: p.line or 0))


def _key(name: str) -> str:
    """A key as a message shows it: plain if it is short and can be written so, else in quotes."""
    return name if len(name) <= 30 and BARE.fullmatch(name) else shown(name)


def nearest(name: str, known: Iterable[str]) -> str:
    """What a message adds about an unknown name: the known one most like it, if any is."""
    near = get_close_matches(name, list(known), n=1)
    return f" (did you mean {_key(near[0])}?)" if near else ""


def check_headers(document: Mapping[str, Any], headers: Sequence[str], faults: Faults) -> None:
    """Faults for everything at the top of a document that has none of these headers."""
    known = {header.strip("[]"): header for header in headers}
    for name, value in document.items():
        if name not in known:
            near = get_close_matches(name, known, n=1)
            hint = f" (did you mean {known[near[0]]}?)" if near else ""
            there = f"{hint}; there are {', '.join(headers)}"
            if isinstance(value, dict):
                faults.add(Table((name,), f"[{_key(name)}]", {}), f"unknown table{there}")
            elif isinstance(value, list) and value and isinstance(value[0], dict):
                faults.add(Table((name,), f"[[{_key(name)}]]", {}), f"unknown table{there}")
            else:
                faults.add(Table((), "", document), f"belongs to no table{there}", name)


def tables_of(document: Mapping[str, Any], kind: str, faults: Faults) -> list[Table]:
    """The tables under [[kind]], each called by its name, or by its number if it has none."""
    given = document.get(kind, [])
    if not isinstance(given, list) or not all(isinstance(values, dict) for values in given):
        message = f"must be one or more tables, each under [[{kind}]]"
        faults.add(Table((), "", document), message, kind)
        return []
    tables = []
    for i, values in enumerate(given):
        name = values.get("name")
        who = shown(name) if isinstance(name, str) else str(i + 1)
        tables.append(Table((kind, i), f"[[{kind}]] {who}", values))
    return tables


def typed(table: Table, fields: Fields, required: Iterable[str], faults: Faults) -> dict[str, Any]:
    """The values of a table that are of the right type; faults for the others and for missing ones."""
    good = {}
    for name, value in table.values.items():
        numbers = value if isinstance(value, list) else [value]
        if name not in fields:
            hint = nearest(name, fields)
            faults.add(table, f"unknown field{hint}; there are {', '.join(fields)}", name)
        elif not fields[name].fits(value):
            faults.add(table, fields[name].allowed, name)
        elif any(isinstance(n, int) and n.bit_length() > MOST_BITS for n in numbers):
            faults.add(table, f"must be a number of at most {MOST_BITS} bits", name)
        else:
            good[name] = value
    for name in required:
        if name not in table.values:
            faults.add(table, "is missing", name)
    return good


def guarded(
    make: Callable[..., T], valid: Mapping[str, Any], table: Table, values: Mapping[str, Any],
    faults: Faults,
) -> T | None:  # fmt: skip
    """What a constructor makes of `values` among otherwise `valid` ones, or None and a fault for each it refuses.

    Which it refuses shows when each is put alone in the place of a valid one.
    """
    try:
        return make(**{**valid, **values})
    except ModelError as error:
        before, whole = len(faults), str(error)
    for name, value in values.items():
        try:
            make(**{**valid, name: value})
        except ModelError as error:
            reason = str(error).removeprefix(f"{name} ").partition("; got ")[0]
            faults.add(table, reason.replace(", or None", "").replace(" or None", ""), name)
    if len(faults) == before:
        faults.add(table, whole)
    return None
