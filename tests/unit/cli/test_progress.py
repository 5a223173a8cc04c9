"""Progress: patient, and only for terminals."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from fasteroids.cli import _progress
from fasteroids.cli._progress import GamesProgress, RunProgress


class Terminal:
    """A standard error that is a terminal, or not."""

    def __init__(self, is_one: bool) -> None:
        self.isatty = lambda: is_one


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The time, which a test sets."""
    now = [1000.0]
    monkeypatch.setattr(_progress, "monotonic", lambda: now[0])
    monkeypatch.setattr(_progress, "sys", SimpleNamespace(stderr=Terminal(True)))
    monkeypatch.setenv("TERM", "xterm")
    return now


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list[tuple[float, str]]:
    """What was shown."""
    updates: list[tuple[float, str]] = []
    monkeypatch.setattr(_progress.Progress, "update", lambda _, *what: updates.append(what))
    return updates


def test_games_are_shown_after_a_second_and_then_not_too_often(
    clock: list[float], shown: list[tuple[float, str]]
) -> None:
    progress = GamesProgress(0, 10)
    for done, seconds in enumerate([0.5, 0.9, 1.0, 1.1, 1.15, 1.25], 1):
        clock[0] = 1000.0 + seconds
        progress.show(done)
    assert [share for share, _ in shown] == [0.3, 0.6]


@pytest.mark.parametrize(
    ("before", "done", "games", "seconds", "said"),
    [
        (0, 5, 10, 5.0, "5 of 10 games, 0:05 left"),
        (100, 105, 200, 10.0, "105 of 200 games, 3:10 left"),  # those from before took no time
        (0, 1_000, 2_001_000, 10.0, "1,000 of 2,001,000 games, 5:33:20 left"),
        (3, 10, 10, 60.0, "10 of 10 games, 0:00 left"),
    ],
)
def test_the_time_left_is_that_of_the_games_so_far(
    before: int, done: int, games: int, seconds: float, said: str,
    clock: list[float], shown: list[tuple[float, str]],
) -> None:  # fmt: skip
    progress = GamesProgress(before, games)
    clock[0] += seconds
    progress.show(done)
    assert shown == [(done / games, said)]


def test_nothing_done_says_nothing_of_the_time_left(
    clock: list[float], shown: list[tuple[float, str]]
) -> None:
    progress = GamesProgress(3, 10)
    clock[0] += 5.0
    progress.show(3)
    assert shown == []


def test_a_run_is_shown_with_its_speed(clock: list[float], shown: list[tuple[float, str]]) -> None:
    progress = RunProgress(10.0, 20.0)
    clock[0] += 2.0
    progress.show(12.0, 640)
    progress.show(12.5, 704)  # too soon
    clock[0] += 0.5
    progress.show(15.0, 64 * 11)
    progress.show(16.0, 64 * 12 + 1)  # between two looks
    assert shown == [
        (0.2, "12 s, 640 events, 320 events/s"),
        (0.5, "15 s, 704 events, 128 events/s"),
    ]


@pytest.mark.parametrize(
    ("stderr", "term"), [(None, "xterm"), (Terminal(False), "xterm"), (Terminal(True), "dumb")]
)
def test_nothing_is_shown_without_a_terminal_that_takes_lines_back(
    stderr: object,
    term: str,
    clock: list[float],
    shown: list[tuple[float, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(_progress, "sys", SimpleNamespace(stderr=stderr))
    monkeypatch.setenv("TERM", term)
    games, run = GamesProgress(0, 10), RunProgress(0.0, 1.0)
    clock[0] += 60.0
    games.show(5)
    run.show(0.5, 64)
    assert shown == []
