"""Games played by several processes at once, whose results are the same as by one.

A game is a function of its stage and its seed, so it does not matter which process plays it, nor when. Processes are
started anew (`spawn`), as every system can, and know nothing but what they are sent.
"""

from __future__ import annotations

import gc
import os
import signal
from collections import deque
from collections.abc import Generator, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import active_children, connection, get_context, parent_process
from threading import Thread
from typing import Final, TypeAlias

from attrs import frozen

from fasteroids.actions import Program
from fasteroids.arena import Ended, Game, flown, play
from fasteroids.cli._guard import Refusal
from fasteroids.cli._scenes import Scene
from fasteroids.lang.report import legible
from fasteroids.units import ModelError

__all__ = ["Result", "Stage", "cores", "played"]

_AHEAD: Final = 4  # games a process has before it, so that it never waits
_MOST_BREAKS: Final = 5
_MOST_JOBS: Final = 61  # more processes cannot be waited for on Windows

Result: TypeAlias = tuple[Game, tuple[Ended, ...]]


@frozen
class Stage:
    """What all games have in common: the field, the programs by name, the model (None: the field's), the limit (s)."""

    scene: Scene
    programs: Mapping[str, Program]
    model: str | None
    limit: float

    def play(self, game: Game) -> tuple[Ended, ...]:
        """How a game ends. `Refusal` names it if it cannot be played."""
        try:
            world = self.scene.world(seed=game.seed, model=self.model)
            return play(flown(world, [self.programs[bot] for bot in game.bots]), limit=self.limit)
        except (ModelError, Refusal) as error:
            told = error.message if isinstance(error, Refusal) else str(error)
            who = " against ".join(map(legible, game.bots))
            raise Refusal(f"{who} cannot play seed {game.seed}: {told}") from None


def cores() -> int:
    """How many processors this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # a system without it
        return os.cpu_count() or 1


def played(games: Sequence[Game], stage: Stage, jobs: int) -> Generator[Result, None, None]:
    """The games and how they ended, in the order in which they get done, by so many processes. One: by this one.

    If a process dies, the games that were under way are played again. `Refusal` if that happens too often.
    """
    jobs = min(jobs, len(games), _MOST_JOBS)
    if jobs <= 1:
        for game in games:
            yield game, stage.play(game)
        return
    left = deque(games)
    for _ in range(_MOST_BREAKS):
        with _pool(stage, min(jobs, len(left))) as pool:
            yield from _through(pool, left, _AHEAD * jobs)
        if not left:
            return
    raise Refusal(
        f"{_MOST_BREAKS} times a process ended before its game, perhaps for want of memory; try --jobs 1"
    )


def _through(pool: ProcessPoolExecutor, left: deque[Game], most: int) -> Iterator[Result]:
    """Play what is left, with so many games handed out at a time. If the pool breaks, what was not played is left."""
    out: dict[Future[tuple[Ended, ...]], Game] = {}
    whole = True
    while out or (left and whole):
        while whole and left and len(out) < most:
            try:
                with _undisturbed():
                    future = pool.submit(_play, left[0])
            except BrokenProcessPool:
                whole = False
            else:
                out[future] = left.popleft()
        for future in wait(out, return_when=FIRST_COMPLETED).done:
            game = out.pop(future)
            try:
                ended = future.result()
            except BrokenProcessPool:
                left.append(game)
                whole = False
            else:
                yield game, ended


@contextmanager
def _pool(stage: Stage, jobs: int) -> Iterator[ProcessPoolExecutor]:
    """Processes that play. Left by an exception they are ended in the middle of their games."""
    others = {*active_children()}
    pool = ProcessPoolExecutor(
        jobs,
        mp_context=get_context("spawn"),
        initializer=_prepare,
        initargs=(stage, gc.get_threshold()),
    )
    try:
        yield pool
    except BaseException:
        with _undisturbed():
            for child in {*active_children()} - others:
                child.terminate()  # or it would play its game to the end
            pool.shutdown(cancel_futures=True)
        raise
    pool.shutdown()


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Hold Ctrl-C back. A process started meanwhile never hears of it: it keeps what is held back here."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


# In a process that plays.

_stage: Stage | None = None
"""Of this process: sent once, and not with every game."""


def _prepare(stage: Stage, threshold: tuple[int, int, int]) -> None:
    global _stage
    _stage = stage
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the one who handed out the games
    gc.set_threshold(*threshold)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Without this a process whose parent was killed would wait for games for ever."""
    parent = parent_process()
    assert parent is not None
    connection.wait([parent.sentinel])
    os._exit(1)


def _play(game: Game) -> tuple[Ended, ...]:
    assert _stage is not None
    return _stage.play(game)
