"""The facade's programs: read, and checked."""

from __future__ import annotations

import http.client
import io
import urllib.error
import urllib.request
from pathlib import Path
from typing import IO, Any

import pytest

from fasteroids import ModelError
from fasteroids.facade import ParseOutcome, TypeCheckOutcome
from tests.unit.facade.handles import FIRST, ILL_TYPED, facade, program, ship

BROKEN = "double d;\nd := ;\nfire"


def test_parse_program_gives_a_program_or_a_message_with_every_error() -> None:
    fine, broken = facade.parse_program(FIRST), facade.parse_program(BROKEN)
    assert fine.successful
    assert (fine.program, fine.message) == (program(FIRST), None)
    assert not broken.successful
    assert broken.program is None
    assert broken.message is not None
    assert "program:2:5: error FA" in broken.message
    assert "program:3:5: error FA" in broken.message
    assert len(broken.diagnostics) == 2


def test_parse_program_reads_ill_typed_programs() -> None:
    assert facade.parse_program(ILL_TYPED).successful


def test_parse_program_wants_text() -> None:
    for value in (None, b"fire;", 5):
        with pytest.raises(ModelError, match="must be a str"):
            facade.parse_program(value)  # type: ignore[arg-type]


@pytest.mark.parametrize("stream", [io.StringIO(FIRST), io.BytesIO(FIRST.encode())])
def test_load_program_from_stream_reads_what_is_left_of_text_or_bytes(stream: IO[Any]) -> None:
    assert facade.load_program_from_stream(stream) == facade.parse_program(FIRST)
    assert facade.load_program_from_stream(stream) == facade.parse_program("")
    assert not stream.closed


def test_a_stream_that_is_no_utf_8_gives_a_message(tmp_path: Path) -> None:
    outcome = facade.load_program_from_stream(io.BytesIO(b"skip;\nprint \xff;"))
    assert outcome.message is not None
    assert "program:2:7: error FA" in outcome.message
    path = tmp_path / "latin.ast"
    path.write_bytes(b"// \xff\n")
    with path.open(encoding="utf-8") as text:
        outcome = facade.load_program_from_stream(text)
    assert outcome == ParseOutcome(None, "the stream is not utf-8 text: invalid start byte")


class Failing(io.StringIO):
    """A stream that breaks."""

    def read(self, _size: int | None = -1) -> str:
        raise OSError("the line is dead")


def test_an_error_of_the_stream_passes() -> None:
    with pytest.raises(OSError, match="the line is dead"):
        facade.load_program_from_stream(Failing())


class Numbers:
    """A stream of something else."""

    def read(self) -> int:
        return 5


def test_what_is_no_open_stream_is_refused() -> None:
    closed = io.StringIO("fire;")
    closed.close()
    for value in (None, "fire;", io.StringIO, closed, Numbers()):
        with pytest.raises(ModelError, match="stream"):
            facade.load_program_from_stream(value)  # type: ignore[arg-type]


def test_load_program_from_url_reads_files(tmp_path: Path) -> None:
    path = tmp_path / "first.ast"
    path.write_text(FIRST, encoding="utf-8")
    assert facade.load_program_from_url(path.as_uri()) == facade.parse_program(FIRST)
    with pytest.raises(OSError, match="No such file"):
        facade.load_program_from_url((tmp_path / "none.ast").as_uri())


def test_load_program_from_url_closes_what_an_opener_opens() -> None:
    stream, asked = io.BytesIO(FIRST.encode()), []

    def opener(url: str) -> IO[bytes]:
        asked.append(url)
        return stream

    outcome = facade.load_program_from_url("https://example.org/first.ast", opener=opener)
    assert outcome.program == program(FIRST)
    assert asked == ["https://example.org/first.ast"]
    assert stream.closed


@pytest.mark.parametrize(
    "url",
    ["", "first.ast", "ftp://example.org/x", "data:,fire;", "http://[", "http://a b/", None, 5],
)
def test_what_is_no_such_address_is_refused(url: Any) -> None:
    with pytest.raises(ModelError, match="address"):
        facade.load_program_from_url(url)


def test_an_opener_is_a_function() -> None:
    with pytest.raises(ModelError, match="opener"):
        facade.load_program_from_url("http://example.org", opener=5)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "error", [http.client.IncompleteRead(b""), urllib.error.URLError("no route"), TimeoutError()]
)
def test_a_server_that_fails_is_an_os_error(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Answer(io.BytesIO):
        def read(self, _size: int | None = -1) -> bytes:
            raise error

    monkeypatch.setattr(urllib.request, "urlopen", lambda *_, **__: Answer())
    with pytest.raises(OSError):  # noqa: PT011
        facade.load_program_from_url("http://example.org/first.ast")


@pytest.mark.parametrize("url", ["http://example.org/x", "https://example.org/x", "file:///x"])
def test_addresses_are_opened_once_and_not_for_ever(
    url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened = []

    def urlopen(url: str, timeout: float) -> IO[bytes]:
        opened.append((url, timeout > 0))
        return io.BytesIO(b"fire;")

    monkeypatch.setattr(urllib.request, "urlopen", urlopen)
    assert facade.load_program_from_url(url).successful
    assert opened == [(url, True)]


# Checking.


def test_is_type_checking_supported() -> None:
    assert facade.is_type_checking_supported()


def test_type_check_program_tells_every_type_error() -> None:
    assert facade.type_check_program(program(FIRST)) == TypeCheckOutcome()
    assert facade.type_check_program(program(FIRST)).successful
    outcome = facade.type_check_program(program(ILL_TYPED))
    assert not outcome.successful
    assert outcome.message is not None
    assert "program:2:" in outcome.message
    assert "program:3:" in outcome.message
    assert len(outcome.diagnostics) == 2


@pytest.mark.parametrize("value", [None, FIRST, facade.parse_program(FIRST)])
def test_only_parsed_programs_are_checked_or_put_on_ships(value: Any) -> None:
    with pytest.raises(ModelError, match="a program that was parsed"):
        facade.type_check_program(value)
    with pytest.raises(ModelError, match="a program that was parsed"):
        facade.set_ship_program(ship(1, 1), value)
