"""The part of the facade that reads, checks and installs ship programs (1.8)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import IO
from urllib.parse import urlsplit

from attrs import evolve, field, frozen

from fasteroids.facade._asking import a
from fasteroids.facade._handles import ShipHandle
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.parser import Parsed, parse_bytes, parse_program
from fasteroids.lang.ready import check_program
from fasteroids.lang.report import rendered
from fasteroids.lang.syntax import Program
from fasteroids.units import ModelError, shown

__all__ = ["ParseOutcome", "Programs", "TypeCheckOutcome"]

_SCHEMES = ("file", "http", "https")
_PATIENCE = 30.0
"""Seconds to wait for an address that does not answer."""


@frozen
class ParseOutcome:
    """What came of reading a program: the program, or a message for people that tells every syntax error."""

    program: Program | None
    message: str | None = None
    diagnostics: tuple[Diagnostic, ...] = field(default=(), repr=False)

    @property
    def successful(self) -> bool:
        """Is there a program?"""
        return self.program is not None


@frozen
class TypeCheckOutcome:
    """What came of checking a program: no message if it is type-correct, else one that tells every type error."""

    message: str | None = None
    diagnostics: tuple[Diagnostic, ...] = field(default=(), repr=False)

    @property
    def successful(self) -> bool:
        """Is the program type-correct?"""
        return self.message is None


class Programs:
    """From texts to programs on ships."""

    def parse_program(self, text: str) -> ParseOutcome:
        """A program from its text. A text with errors gives an outcome with a message, no exception."""
        if not isinstance(text, str):
            raise ModelError(f"the text of a program must be a str; got {shown(text)}")
        return _outcome(parse_program(text))

    def load_program_from_stream(self, stream: IO[str] | IO[bytes]) -> ParseOutcome:
        """A program from all that an open stream still has; bytes should be UTF-8. It is not closed.

        What cannot be decoded gives an outcome with a message. `OSError` passes, as the course's method throws it;
        `ModelError` for a closed stream, or what is none.
        """
        read = getattr(stream, "read", None)
        if isinstance(stream, type) or not callable(read):
            raise ModelError(f"an open stream is needed; got {shown(stream)}")
        try:
            text = read()
        except UnicodeDecodeError as error:
            return ParseOutcome(None, f"the stream is not {error.encoding} text: {error.reason}")
        except ValueError as error:
            raise ModelError(f"the stream cannot be read: {error}") from None
        if isinstance(text, bytes):
            return _outcome(parse_bytes(text))
        if not isinstance(text, str):
            raise ModelError(f"a stream must give str or bytes; got {shown(text)}")
        return _outcome(parse_program(text))

    def load_program_from_url(
        self, url: str, *, opener: Callable[[str], IO[bytes]] | None = None
    ) -> ParseOutcome:
        """A program from a `file:`, `http:` or `https:` address; as from a stream, which is closed.

        `opener` opens an address; without one, `urllib` does. `OSError` passes, be it a missing file or a server that
        refuses or breaks off; `ModelError` for what is no such address.
        """
        scheme = _scheme(url)
        if scheme not in _SCHEMES:
            raise ModelError(f"an address must start with file:, http: or https:; got {shown(url)}")
        if opener is None:
            with _urllib(url) as stream:
                return self.load_program_from_stream(stream)
        if not callable(opener):
            raise ModelError(f"an opener must be a function of an address; got {shown(opener)}")
        with opener(url) as stream:
            return self.load_program_from_stream(stream)

    def is_type_checking_supported(self) -> bool:
        """Yes."""
        return True

    def type_check_program(self, program: Program) -> TypeCheckOutcome:
        """Is a program type-correct (1.8.3)? The outcome tells."""
        tree = _program(program)
        faults = _errors(check_program(tree).diagnostics)
        return TypeCheckOutcome(_told(faults, tree.source), faults)

    def set_ship_program(self, ship: ShipHandle, program: Program) -> None:
        """Have a ship run a program from its start, from its next tick on (1.6: every 0.2 s).

        Programs are values: one on two ships runs twice, and neither run knows of the other. `ModelError` if it is
        not type-correct, with what is wrong; the ship then keeps the program it has.
        """
        handle, tree = a(ShipHandle, ship), _program(program)
        checked = check_program(tree)
        if checked.program is None:
            faults = _errors(checked.diagnostics)
            raise ModelError(
                f"a ship's program must be type-correct, and this one is not:\n{_told(faults, tree.source)}"
            )
        if handle.home is None:
            handle.alter(evolve(handle.entity, program=checked.program))
        else:
            with handle.home.changing():
                handle.home.instruct(handle, checked.program)


def _program(value: object) -> Program:
    if not isinstance(value, Program):
        raise ModelError(f"a program that was parsed is needed; got {shown(value)}")
    return value


def _errors(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(each for each in diagnostics if each.severity == "error")


def _told(faults: tuple[Diagnostic, ...], source: str) -> str | None:
    return rendered(faults, source, "program") if faults else None


def _outcome(parsed: Parsed) -> ParseOutcome:
    faults = _errors(parsed.diagnostics)
    return ParseOutcome(parsed.program, _told(faults, parsed.tree.source), parsed.diagnostics)


def _scheme(url: object) -> str:
    if not isinstance(url, str):
        raise ModelError(f"an address must be a str; got {shown(url)}")
    try:
        return urlsplit(url).scheme
    except ValueError as error:
        raise ModelError(f"{shown(url)} is no address: {error}") from None


@contextmanager
def _urllib(url: str) -> Iterator[IO[bytes]]:
    """An address, open for a while. The modules for it are loaded only here."""
    from http.client import HTTPException, InvalidURL
    from urllib.request import urlopen

    try:
        with urlopen(url, timeout=_PATIENCE) as stream:
            yield stream
    except (OSError, ModelError):
        raise
    except (InvalidURL, ValueError) as error:
        raise ModelError(f"{shown(url)} is no address: {error}") from None
    except HTTPException as error:
        raise OSError(f"{url} did not answer as it should: {error!r}") from error
