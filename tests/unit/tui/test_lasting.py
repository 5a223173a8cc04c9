"""A stream that outlives its terminal."""

from __future__ import annotations

import io
import os

from fasteroids.tui import kitty


def test_it_writes_as_long_as_somebody_reads() -> None:
    reader, writer = os.pipe()
    with open(writer, "w", encoding="utf-8") as stream:  # noqa: PTH123 - a handle
        lasting = kitty.Lasting(stream)
        assert lasting.write("ab") == 2
        lasting.flush()
        assert os.read(reader, 10) == b"ab"
        assert lasting.fileno() == writer
        os.close(reader)
        lasting.write("c" * 100_000)
        lasting.flush()
        reopened = os.open(os.devnull, os.O_WRONLY)
        os.dup2(reopened, writer)  # so that the end of the stream finds somewhere to write to
        os.close(reopened)


def test_a_closed_stream_takes_what_is_written() -> None:
    stream = io.StringIO()
    lasting = kitty.Lasting(stream)
    stream.close()
    assert lasting.write("abc") == 3
    lasting.flush()
