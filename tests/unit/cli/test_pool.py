"""Games by several processes: the same as by one, whatever happens to the processes."""

from __future__ import annotations

import gc
import os
import signal
import threading
from collections.abc import Iterator
from multiprocessing import active_children
from typing import Any

import pytest

from fasteroids.arena import Ended, Game, fixtures
from fasteroids.cli import _pool
from fasteroids.cli._bots import read_bot
from fasteroids.cli._guard import Refusal
from fasteroids.cli._pool import Stage, cores, played
from fasteroids.cli._scenes import read_scene

BOTS = ("spinner", "opponent-2013")
GAMES = fixtures(BOTS, 1, range(6))


def stage(field: str = "field-2013", **programs: Any) -> Stage:
    return Stage(read_scene(field), {bot: read_bot(bot) for bot in BOTS} | programs, None, 60.0)


@pytest.fixture(scope="module")
def alone() -> dict[Game, tuple[Ended, ...]]:
    """The games played by this process."""
    return dict(played(GAMES, stage(), 1))


@pytest.fixture(autouse=True)
def _leaves_nothing() -> Iterator[None]:
    threads = threading.active_count()
    yield
    assert active_children() == []
    assert threading.active_count() == threads


def test_one_process_plays_in_order(alone: dict[Game, tuple[Ended, ...]]) -> None:
    assert list(alone) == list(GAMES)
    assert len(set(alone.values())) > 6


def test_many_processes_give_the_same_games(alone: dict[Game, tuple[Ended, ...]]) -> None:
    assert dict(played(GAMES, stage(), 3)) == alone


def test_no_games_take_no_process() -> None:
    assert list(played([], stage(), 3)) == []


def test_a_process_that_is_killed_loses_no_game(alone: dict[Game, tuple[Ended, ...]]) -> None:
    found = []
    for result in played(GAMES, stage(), 2):
        found.append(result)
        if len(found) == 2:
            for child in active_children():
                child.kill()
    assert len(found) == len(GAMES)  # none twice
    assert dict(found) == alone


class Deadly:
    """Who receives this dies."""

    def __reduce__(self) -> Any:
        return os._exit, (1,)


def test_processes_that_always_die_are_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_pool, "_MOST_BREAKS", 2)
    with pytest.raises(Refusal, match=r"2 times a process ended before its game, .*; try --jobs 1"):
        list(played(GAMES, stage(deadly=Deadly()), 2))


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_game_that_cannot_be_played_is_named(jobs: int) -> None:
    games = [Game(("spinner",), 1), Game(BOTS, 7)]
    with pytest.raises(
        Refusal, match=r"spinner against opponent-2013 cannot play seed 7: .* got 2"
    ):
        list(played(games, stage(), jobs))


def test_who_stops_early_leaves_no_process() -> None:
    results = played(GAMES, stage(), 2)
    next(results)
    assert len(active_children()) == 2
    results.close()


def test_a_second_pool_of_the_same_process_is_left_alone() -> None:
    first, second = played(GAMES, stage(), 2), played(GAMES, stage(), 2)
    next(first), next(second)
    second.close()
    assert len(active_children()) == 2
    assert len(list(first)) == len(GAMES) - 1


def test_ctrl_c_is_heard_after_a_process_was_started() -> None:
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    results = played(GAMES, stage(), 2)
    next(results)
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    for child in active_children():
        assert child.pid is not None
        os.kill(child.pid, signal.SIGINT)  # as a terminal does to all
    assert len(list(results)) == len(GAMES) - 1


def test_a_process_prepares_itself() -> None:
    usual, before = gc.get_threshold(), signal.getsignal(signal.SIGINT)
    try:
        thread = threading.Thread(target=lambda: None)
        thread.start()
        thread.join()
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(_pool, "Thread", lambda **_: thread)
            patch.setattr(thread, "start", lambda: None)
            _pool._prepare(stage(), (5000, 7, 7))
        assert gc.get_threshold() == (5000, 7, 7)
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
        assert _pool._play(GAMES[0]) == stage().play(GAMES[0])
    finally:
        gc.set_threshold(*usual)
        signal.signal(signal.SIGINT, before)
        _pool._stage = None


def test_cores_are_those_that_this_process_may_use(monkeypatch: pytest.MonkeyPatch) -> None:
    assert cores() >= 1
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 3, 5}, raising=False)
    assert cores() == 3
    monkeypatch.delattr(os, "sched_getaffinity")
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert cores() == 1
