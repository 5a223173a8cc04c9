"""Whole lines, whole files."""

from __future__ import annotations

import os
import signal
from collections.abc import Generator
from pathlib import Path

import pytest

from fasteroids.cli._files import Lines, write_whole
from fasteroids.cli._guard import Refusal
from fasteroids.cli._interrupt import Interruptible


def test_lines_reach_a_file_in_batches_of_whole_ones(tmp_path: Path) -> None:
    place = tmp_path / "lines"
    sizes = set()
    with Lines(str(place)) as lines:
        for i in range(20_000):
            lines.write(f"line {i}")
            sizes.add(place.stat().st_size)
            if i % 1000 == 0:
                assert place.read_text() == "" or place.read_text().endswith("\n")
    assert 2 < len(sizes) < 20
    assert lines.count == 20_000
    assert place.read_text() == "".join(f"line {i}\n" for i in range(20_000))


def test_lines_to_a_pipe_nobody_reads(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    with Lines(str(pipe)) as lines:
        lines.write("first")
        assert os.read(reader, 100) == b"first\n"
        os.close(reader)
        lines.write("second")
        assert lines.gone
        lines.write("third")


def test_file_is_replaced_as_a_whole_or_not_at_all(tmp_path: Path) -> None:
    place = tmp_path / "world"
    write_whole(str(place), "new\n")
    assert place.read_text() == "new\n"
    with pytest.raises(UnicodeEncodeError):
        write_whole(str(place), "\ud800")
    assert place.read_text() == "new\n"
    assert [each.name for each in tmp_path.iterdir()] == ["world"]


def test_file_in_no_folder(tmp_path: Path) -> None:
    with pytest.raises(Refusal, match=r"cannot write .*: No such file or directory"):
        write_whole(str(tmp_path / "none" / "world"), "text")


def test_device_is_written_to_as_it_is() -> None:
    write_whole(os.devnull, "text\n")
    assert not Path(os.devnull).is_file()


# Ctrl-C.


def press() -> None:
    signal.raise_signal(signal.SIGINT)


def counting(*, pressed_at: int) -> Generator[int, None, str]:
    for i in range(10):
        if i == pressed_at:
            press()
        yield i
    return "done"


def test_interrupted_while_computing() -> None:
    with Interruptible(counting(pressed_at=3)) as unfold:
        assert list(unfold) == [0, 1, 2]
    assert unfold.interrupted
    assert unfold.result is None


def test_interrupted_while_writing_finishes_the_line() -> None:
    written = []
    with Interruptible(counting(pressed_at=-1)) as unfold:
        for i in unfold:
            if i == 3:
                press()
            written.append(i)
    assert written == [0, 1, 2, 3]
    assert unfold.interrupted


def test_a_polite_kill_is_as_ctrl_c() -> None:
    before = signal.getsignal(signal.SIGTERM)
    with Interruptible(counting(pressed_at=-1)) as unfold:
        for i in unfold:
            if i == 3:
                signal.raise_signal(signal.SIGTERM)
    assert i == 3
    assert unfold.interrupted
    assert signal.getsignal(signal.SIGTERM) is before


def test_second_press_raises_at_once() -> None:
    with Interruptible(counting(pressed_at=-1)) as unfold:
        assert next(iter(unfold)) == 0
        press()
        with pytest.raises(KeyboardInterrupt):
            press()


def test_uninterrupted_run_has_a_result_and_gives_the_signal_back() -> None:
    before = signal.getsignal(signal.SIGINT)
    with Interruptible(counting(pressed_at=-1)) as unfold:
        assert signal.getsignal(signal.SIGINT) is not before
        assert list(unfold) == list(range(10))
    assert unfold.result == "done"
    assert not unfold.interrupted
    assert signal.getsignal(signal.SIGINT) is before


def test_errors_of_the_run_pass() -> None:
    def failing() -> Generator[int, None, None]:
        yield 1
        raise ZeroDivisionError

    with Interruptible(failing()) as unfold, pytest.raises(ZeroDivisionError):
        list(unfold)
