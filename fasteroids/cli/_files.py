"""Bytes in, lines and worlds out."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

import click

from fasteroids.cli._guard import Refusal, mute, reason

__all__ = [
    "STDIO",
    "Lines",
    "check_outputs",
    "is_special",
    "names_file",
    "read_limited",
    "read_named",
    "read_program",
    "replacing",
    "shipped",
    "shipped_programs",
    "write_whole",
]

STDIO = "-"

_MOST_BYTES = {"scene": 64 * 2**20, "program": 2**20, "recording": 2**30}
"""Longer files are none. A limit, so that a slip (a device, a disk image) does not fill the memory."""

_BATCH = 64 * 1024  # characters that lines to a file wait for


# What comes with the package.


def shipped() -> dict[str, str]:
    """The scenes that come with the package: text by name."""
    return _shipped("scenes", ".toml")


def shipped_programs() -> dict[str, str]:
    """The ship programs that come with the package: text by name."""
    return _shipped("programs", ".ast")


def _shipped(folder: str, suffix: str) -> dict[str, str]:
    from importlib.resources import files  # not needed for a path

    place = files("fasteroids") / folder
    if not place.is_dir():
        return {}
    return {
        each.name.removesuffix(suffix): each.read_text(encoding="utf-8")
        for each in sorted(place.iterdir(), key=lambda each: each.name)
        if each.name.endswith(suffix)
    }


# Inputs.


def read_limited(file: IO[bytes], title: str, what: str) -> bytes:
    """All the bytes of `what`, a key of the table of limits; a `Refusal` if there are more than it may have."""
    most = _MOST_BYTES[what]
    data = file.read(most + 1)
    if len(data) > most:
        raise Refusal(f"{title}: a {what} has at most {most} bytes; this one has more")
    return data


def names_file(place: Path) -> bool:
    """Is there anything but a folder? A folder does not hide what comes with the package by the same name."""
    return place.exists() and not place.is_dir()


def read_named(name: str, folder: Path = Path()) -> bytes:
    """The bytes of a program by its name: of a file in a folder, else of one that comes with the package.

    `Refusal` says why they cannot be had.
    """
    if not names_file(folder / name) and (text := shipped_programs().get(name)) is not None:
        return text.encode()
    return read_program(os.path.join(".", folder, name))  # noqa: PTH118 so that "-" is a file


def read_program(place: str) -> bytes:
    """The bytes of a program: of a file, or of standard input ('-'). `Refusal` says why they cannot be had."""
    if place == STDIO:
        if sys.stdin is None:
            raise Refusal("standard input is closed")
        return read_limited(sys.stdin.buffer, "standard input", "program")
    if not place:
        raise Refusal("cannot read '': there is no such file")
    try:
        with Path(place).open("rb") as file:
            return read_limited(file, repr(place), "program")
    except OSError as error:
        raise Refusal(f"cannot read {reason(error, place)}") from None
    except ValueError:  # a null character in a name
        raise Refusal(f"cannot read {place!r}: there is no such file") from None


# Outputs.


def check_outputs(
    source: str,
    outputs: dict[str, str | None],
    programs: Sequence[str] = (),
    *,
    what: str = "scene",
) -> None:
    """Refuse what cannot work, before anything is written. `outputs` are the values of options by their names.

    Two outputs in one file, or on standard output; the file of the source (a scene, or `what` it is) or of one of the
    programs; folders, and places in none.
    """
    files = filter(os.path.isfile, programs)
    owners = {os.path.realpath(file): "the program" for file in files}
    if source != STDIO and Path(source).is_file():
        owners[os.path.realpath(source)] = f"the {what}"
    for option, value in outputs.items():
        if value is None:
            continue
        place = STDIO if value == STDIO else os.path.realpath(value)
        if place in owners:
            where = "standard output" if place == STDIO else repr(value)
            raise click.UsageError(f"{option} and {owners[place]} cannot both be {where}")
        path = Path(place)
        if place == STDIO or not path.exists() or path.is_file():
            owners[place] = option
        if place != STDIO:
            folder = path.parent
            if path.is_dir():
                raise Refusal(f"cannot write {value!r}: it is a folder")
            if not folder.is_dir():
                raise Refusal(f"cannot write {value!r}: there is no folder {str(folder)!r}")
            if not os.access(path if path.exists() else folder, os.W_OK):
                raise Refusal(f"cannot write {value!r}: permission denied")


class Lines:
    """Whole lines, to a file or to standard output ('-'), in UTF-8. A context manager.

    A terminal or a pipe gets each line at once, a file many together; either way nothing is handed to the
    system but whole lines. `count` is how many there were; `gone` says that nobody reads them any more.
    """

    def __init__(self, place: str) -> None:
        self.place, self.count, self.gone = place, 0, False
        self._waiting: list[str] = []
        self._size = 0
        self._stream: IO[bytes] | None = None
        if place == STDIO:
            if sys.stdout is not None:
                sys.stdout.flush()
                self._stream = getattr(sys.stdout, "buffer", None)
        else:
            try:
                self._stream = Path(place).open("wb")  # noqa: SIM115 - closed by `close`
            except OSError as error:
                raise Refusal(f"cannot write {reason(error)}") from None
        self._live = not _is_plain(self._stream)

    def __enter__(self) -> Lines:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def write(self, line: str) -> None:
        """One line, given without its end."""
        self._waiting.append(line)
        self._size += len(line)
        self.count += 1
        if self._live or self._size > _BATCH:
            self.flush()

    def flush(self) -> None:
        """Hand what waits to the system."""
        if not self._waiting:
            return
        data = "".join(f"{line}\n" for line in self._waiting)
        self._waiting, self._size = [], 0
        if self._stream is None:
            return
        try:
            self._stream.write(data.encode("utf-8", "backslashreplace"))
            self._stream.flush()
        except BrokenPipeError:
            self._let_go()
        except OSError as error:
            self._let_go()
            name = "standard output" if self.place == STDIO else repr(self.place)
            raise Refusal(f"cannot write {name}: {error.strerror}") from None

    def close(self) -> None:
        """Hand over what waits, and close a file."""
        self.flush()
        if self._stream is not None and self.place != STDIO:
            self._stream.close()

    def _let_go(self) -> None:
        """Write nothing any more: what is in the buffer of the stream cannot be written either."""
        stream, self._stream, self.gone = self._stream, None, True
        if self.place == STDIO:
            mute()
        elif stream is not None:
            with suppress(OSError):
                stream.close()


def _is_plain(stream: IO[bytes] | None) -> bool:
    """Is this a plain file on disk?"""
    try:
        return stream is not None and stat.S_ISREG(os.fstat(stream.fileno()).st_mode)
    except (OSError, ValueError):
        return False


def write_whole(place: str, text: str) -> None:
    """Write a text to a file so that the file has all of it or is as it was; '-' is standard output.

    What is no plain file (a device, a pipe) is written to as it is.
    """
    if place == STDIO or is_special(place):
        with Lines(place) as lines:
            lines.write(text.removesuffix("\n"))
        return
    with replacing(place) as beside, beside.open("xb") as file:
        file.write(text.encode("utf-8"))


def is_special(place: str) -> bool:
    """Is there something that is no plain file: a device, a pipe? It cannot be replaced by a file."""
    target = Path(os.path.realpath(place))
    return target.exists() and not target.is_file()


@contextmanager
def replacing(place: str) -> Iterator[Path]:
    """A path beside a file, for a new one, which takes its place at the end of the block, whole; not if that fails.

    `Refusal` for an `OSError` in the block, too.
    """
    target = Path(os.path.realpath(place))
    beside = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        try:
            yield beside
            if target.exists():
                beside.chmod(stat.S_IMODE(target.stat().st_mode))
            beside.replace(target)
        finally:
            beside.unlink(missing_ok=True)
    except OSError as error:
        raise Refusal(f"cannot write {place!r}: {error.strerror or error}") from None
