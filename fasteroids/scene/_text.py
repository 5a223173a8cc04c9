"""The text of a scene file: TOML in with every syntax error, the line of every key, TOML out.

``tomllib`` reads TOML, but stops at the first error and forgets where things stood. Here its errors are
collected, and a small scan of the text (strings, brackets, ends of lines) finds the statements, which serves
both to go on after an error and to say on which line a value stands.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

from attrs import frozen

from fasteroids.units import ModelError

__all__ = [
    "BARE",
    "MOST_BITS",
    "Path",
    "Problem",
    "ProblemsError",
    "SceneError",
    "lines_of",
    "parsed",
    "shown",
    "written",
]

Path: TypeAlias = tuple[str | int, ...]
"""Where a value is in a document: keys, and indices of arrays of tables. ("ship", 0, "radius")."""

_MOST_SYNTAX_ERRORS = 20
_LONGEST = 60  # characters of a value in a message
MOST_BITS = 8192
"""Of an integer in a file: well below the 4300 digits that Python reads and prints."""
_LONGEST_KEY = 1000  # characters of a key that has a line of its own


@frozen
class Problem:
    """One thing that is wrong with a scene file.

    `line` counts from 1, None if no line can be named. `table` is the header and the name of the entity, if
    it has one (its number among its kind if not); `field` the key; `value` what was given, as the file would
    write it; each None if it does not apply. `message` says what is allowed.
    """

    line: int | None
    table: str | None
    field: str | None
    value: str | None
    message: str

    def __str__(self) -> str:
        """One line for people."""
        given = " = ".join(part for part in (self.field, self.value) if part is not None)
        place = ", ".join(part for part in (self.table, given) if part)
        start = "" if self.line is None else f"line {self.line}: "
        return f"{start}{place}: {self.message}" if place else f"{start}{self.message}"


class ProblemsError(ModelError):
    """A text that cannot be used, with everything that is wrong with it; `str` gives a line for each."""

    problems: tuple[Problem, ...]

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__(self.problems)

    def __str__(self) -> str:
        """One line per problem."""
        return "\n".join(map(str, self.problems))


class SceneError(ProblemsError):
    """A scene file that cannot be read."""


def shown(value: object) -> str:
    """A value as a message shows it: as TOML, on one line, cut where it is long. Never raises."""
    if isinstance(value, bool):
        text = str(value).lower()
    elif isinstance(value, str):
        text = quoted(value[:_LONGEST])
        return text if len(value) <= _LONGEST else text[:-1] + "…"
    elif isinstance(value, int) and value.bit_length() > 4 * _LONGEST:
        text = hex(value)  # decimal digits can be more than Python prints
    elif isinstance(value, list):
        flat = ["[…]" if isinstance(item, list) else shown(item) for item in value[:_LONGEST]]
        text = f"[{', '.join(flat)}]"
    elif isinstance(value, dict):
        text = "{…}" if value else "{}"
    else:
        text = str(value)
    return text if len(text) <= _LONGEST else text[:_LONGEST] + "…"


def quoted(text: str) -> str:
    """A text as a basic string of TOML."""
    return json.dumps(text, ensure_ascii=not text.isprintable())


def lines_quoted(text: str) -> str:
    """A text of several lines as TOML that shows them: `tomllib` reads the same characters back."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    escaped = "".join(c if c.isprintable() or c in "\n\t" else f"\\U{ord(c):08x}" for c in escaped)
    return f'"""\n{escaped}"""'


# Statements.

_TOKEN = re.compile(
    r'''
    "{3} (?: [^\\] | \\. )*? "{3,5}     # strings of several lines
  | '{3} .*? '{3,5}
  | "{3} .* | '{3} .*                   # without an end
  | " (?: [^"\\\n] | \\[^\n] )* "
  | ' [^'\n]* '
  | \# [^\n]*
  | [^"'\#\[\]{}\n]+
  | .
    ''',
    re.DOTALL | re.VERBOSE,
)  # fmt: skip
_KEY = re.compile(r"""((?:"(?:[^"\\]|\\.)*"|'[^']*'|[^"'=#\[{])+)=""")
BARE = re.compile(r"[A-Za-z0-9_-]+")
"""Keys that need no quotes."""


@frozen
class _Layout:
    """Of each line (from 0): the line its statement begins on, and whether it begins inside a string.

    `open`: does the last statement lack a closing bracket? `stray`: the first line with a quote that nothing
    closes, None if there is none.
    """

    starts: list[int]
    in_string: list[bool]
    open: bool
    stray: int | None


def _layout(text: str) -> _Layout:
    starts, in_string = [0], [False]
    depth, header, fresh, stray = 0, False, True, None
    for match in _TOKEN.finditer(text):
        token = match.group()
        if token == "\n":
            fresh = depth <= 0 or header  # a header ends with its line, whatever its brackets say
            if fresh:
                depth, header = 0, False
            starts.append(len(starts) if fresh else starts[-1])
            in_string.append(False)
        elif "\n" in token:
            inside = token.count("\n")
            starts += [starts[-1]] * inside
            in_string += [True] * inside
            fresh = False
        elif token in "[{":
            header = header or (fresh and token == "[")
            depth, fresh = depth + 1, False
        elif token in "]}":
            depth -= 1
        elif token.strip():
            fresh = False
            if token in ("'", '"') and stray is None:
                stray = len(starts) - 1
    return _Layout(starts, in_string, depth > 0, stray)


# Reading.

_PLACE = re.compile(r"(.*?) \(at (?:line (\d+), column (\d+)|end of document)\)", re.DOTALL)
_LONG_INTEGER = re.compile(r"[0-9][0-9_]{4000,}")


def _plain(text: str) -> str:
    """The text without a byte order mark, with one character for each end of a line."""
    return text.removeprefix("\ufeff").replace("\r\n", "\n")


def parsed(text: str) -> dict[str, Any]:
    """The document in a text of TOML, or `SceneError` with its syntax errors, up to 20 of them.

    After an error the statement it is in is left out, and what is left is read again. A header that cannot be
    read is replaced by one of its own, so that the keys below it do not run into those of another table.
    """
    if not isinstance(text, str):
        raise ModelError(f"a scene is a text in TOML; got {type(text).__name__}")
    lines = _plain(text).split("\n")
    problems: list[Problem] = []
    while len(problems) < _MOST_SYNTAX_ERRORS:
        source = "\n".join(lines)
        try:
            document = tomllib.loads(source)
        except RecursionError:
            problems.append(
                Problem(None, None, None, None, "not TOML: values are nested too deeply")
            )
            break
        except (
            ValueError
        ) as error:  # TOMLDecodeError is one, and so is an integer of too many digits
            place, message = _located(str(error), source)
            if place is None:
                problems.append(Problem(None, None, None, None, f"not TOML: {message}"))
                break
            given = shown_line(lines[place.line])
            problems.append(Problem(place.line + 1, None, None, given, f"not TOML: {message}"))
            if not any(lines[place.first : place.last + 1]):
                break  # nothing left to leave out
            _leave_out(lines, place, len(problems))
        else:
            if not problems:
                return document
            break
    raise SceneError(sorted(problems, key=lambda p: p.line or 0))


def shown_line(line: str) -> str | None:
    """A line of a file as a message shows it, None if it is empty."""
    line = line.strip()
    line = line if len(line) <= _LONGEST else line[:_LONGEST] + "…"
    return (line if line.isprintable() else quoted(line)) or None


@frozen
class _Place:
    """Where an error is, in lines from 0: the one to name, and the first and last of its statement to leave out."""

    line: int
    first: int
    last: int


def _located(message: str, source: str) -> tuple[_Place | None, str]:
    """The place (None if unknown) and the reason in a message of tomllib."""
    layout = _layout(source)
    match = _PLACE.fullmatch(message)
    if match is None:
        number = _LONG_INTEGER.search(source)
        if number is None:
            return None, message
        line, reason = source.count("\n", 0, number.start()), "an integer has too many digits"
    elif match[2] is None:
        reason = f"{_lowered(match[1])}, and the file ends"
        if layout.stray is not None:
            return _Place(layout.stray, layout.stray, layout.stray), reason
        start = layout.starts[-1]
        return _Place(start, start, len(layout.starts) - 1), reason
    else:
        line, reason = int(match[2]) - 1, f"{_lowered(match[1])} at column {match[3]}"
    first, last = layout.starts[line], line
    if first != line:
        reason += f", in what begins on line {first + 1}"
    # A statement without an end swallowed the rest of the file, which is innocent.
    closed = layout.starts[-1] != first or not layout.open
    while last + 1 < len(layout.starts) and (
        layout.starts[last + 1] == first if closed else layout.in_string[last + 1]
    ):
        last += 1
    return _Place(line, first, last), reason


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]


def _leave_out(lines: list[str], place: _Place, count: int) -> None:
    """Blank the lines of a statement; a header gives way to one of its own."""
    size = place.last + 1 - place.first
    header = any(line.lstrip().startswith("[") for line in lines[place.first : place.last + 1])
    lines[place.first : place.last + 1] = [""] * size
    if header:
        lines[place.last] = f'["unreadable {count}"]'


# Lines.


def lines_of(text: str) -> dict[Path, int]:
    """The line (from 1) of every table and every key in a text of valid TOML.

    What stands inside an inline table or an array has no line of its own: look for the longest beginning of a
    path that has one.
    """
    source = _plain(text)
    lines = source.split("\n")
    found: dict[Path, int] = {}
    tables: dict[Path, int] = {}
    here: Path = ()
    for number, start in enumerate(_layout(source).starts):
        if number != start:
            continue
        line = lines[number].strip()
        if line.startswith("["):
            *above, last = _keys(line)
            here = (*_resolved((), above, tables), last)
            found.setdefault(here, number + 1)
            if line.startswith("[["):
                tables[here] = tables.get(here, 0) + 1
                here = (*here, tables[here] - 1)
            else:
                here = _resolved(here[:-1], here[-1:], tables)
            found.setdefault(here, number + 1)
        elif match := _KEY.match(line):
            path = here
            for key in _keys(match[1]):
                path = (*path, key)
                found.setdefault(path, number + 1)
    return found


def _keys(text: str) -> list[str]:
    """The parts of a key or a header. tomllib undoes quotes and escapes where there are any.

    A key of absurd length counts as one part: nobody looks for it, and tomllib takes quadratic time for it.
    """
    if BARE.fullmatch(text.strip()) or len(text) > _LONGEST_KEY:
        return [text.strip()]
    node = tomllib.loads(text if text.lstrip().startswith("[") else f"{text}=0")
    parts: list[str] = []
    while isinstance(node, dict) and node:
        key, node = next(iter(node.items()))
        parts.append(key)
        if isinstance(node, list):
            node = node[0]
    return parts


def _resolved(path: Path, keys: Iterable[str | int], tables: Mapping[Path, int]) -> Path:
    """A path continued by keys; one that names an array of tables means the last of them."""
    for key in keys:
        path = (*path, key)
        if path in tables:
            path = (*path, tables[path] - 1)
    return path


# Writing.


def written(value: object) -> str:
    """A bool, number, text or list of them in TOML; `tomllib` reads the same value back, bit for bit.

    Floats are finite and get the fewest digits that bring them back. `ModelError` for an integer of more than
    `MOST_BITS` bits.
    """
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return lines_quoted(value) if "\n" in value else quoted(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(written, value))}]"
    if isinstance(value, int) and value.bit_length() > MOST_BITS:
        raise ModelError(f"{shown(value)} is too long to be written: more than {MOST_BITS} bits")
    return repr(value)
