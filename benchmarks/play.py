"""The terminal game as it is played: a real screen of 120 x 40 cells in tmux, with everything shown.

Each run is a process of its own in a tmux server of its own, so that nobody's sessions are touched. It plays the game
of `crowd`: four ships that programs fly, bullets and asteroids; twice a second asteroids make up what was shot. A ship
is selected, so that the panes show it and its program; the game is recorded in a file.
"""

from __future__ import annotations

import gc
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import perf_counter, process_time, sleep
from typing import Any, Final

from attrs import evolve, frozen

from benchmarks.frames import SURFACES, game
from benchmarks.measure import Effort, Figure, Table, figure
from benchmarks.workload import SEED
from fasteroids import Asteroid, ModelError, World, check_program, parse_program
from fasteroids.state import instructed
from fasteroids.tui.game import Game, Player
from fasteroids.tui.session import Session, opened

COLUMNS, ROWS = 120, 40
RATES = (30, 60)  # frames a second
ENTITIES = 40
WARM = 2.0  # s, which are not measured
PATIENCE = 60.0  # s more than a run takes
ASKED_CPU: Final = {30: 20.0, 60: 40.0}  # % of a core
ASKED_GAP = 100.0  # ms

PILOT = "while (true) { turn 0.37; thrust; fire; skip; skip; thrust_off; skip; skip; skip; }"
LIVES = 50  # for each ship, which is as good as without end


@frozen
class Measured:
    """What a run tells: seconds on the clock and of the processor, when frames were shown (s), and bytes sent."""

    wall: float
    cpu: float
    shown: list[float]
    made: int
    bytes: int

    @property
    def gaps(self) -> list[float]:
        """Milliseconds between one frame and the next, the shortest first."""
        return sorted((b - a) * 1e3 for a, b in zip(self.shown, self.shown[1:], strict=False))


def play(effort: Effort) -> Table:
    """Frames shown, the share of a core, and gaps between frames, of each arena at each rate."""
    # As asked; one arena for 10 s to try it out; a test, for a moment.
    whole, trial = effort.share >= 1.0, effort.share >= 0.1
    seconds = 60.0 if whole else 10.0 if trial else 0.5
    figures: list[Figure] = []
    reason = "" if shutil.which("tmux") else "tmux is not installed"
    for fps in RATES if trial else RATES[:1]:
        for arena in SURFACES if whole else ("braille",):
            if not reason:
                try:
                    told = measured(arena, fps, seconds, effort.size(ENTITIES))
                except OSError as error:
                    reason = str(error)
                else:
                    figures += rows(f"{arena}, {fps} fps", told, fps)
    if reason:
        figures.append(figure(f"skipped: {reason}", [0.0]))
    return Table(
        f"The game in tmux, {COLUMNS} x {ROWS}, {ENTITIES} entities, panes shown, {seconds:g} s each",
        figures,
        "The share of a core is processor time of the game's process, whatever else runs. Frames and gaps are by the "
        "clock on the wall: where others use the machine they wait for it, and tell more of them than of the game.",
    )


def rows(what: str, told: Measured, fps: int) -> list[Figure]:
    """The figures of a run."""
    frames, gaps = max(len(told.shown), 1), told.gaps or [0.0]
    return [
        figure(f"{what}: CPU", [100.0 * told.cpu / told.wall], "% of a core", below=ASKED_CPU[fps]),
        figure(f"{what}: CPU a frame", [1e3 * told.cpu / frames], "ms"),
        figure(f"{what}: frames shown", [len(told.shown) / told.wall], "1/s"),
        figure(f"{what}: refreshes a frame made", [len(told.shown) / max(told.made, 1)]),
        figure(f"{what}: gap, 99 of 100", [gaps[int(0.99 * (len(gaps) - 1))]], "ms"),
        figure(f"{what}: longest gap", [gaps[-1]], "ms", below=ASKED_GAP),
        figure(f"{what}: sent a frame", [told.bytes / frames / 1024.0], "KiB"),
    ]


def measured(arena: str, fps: int, seconds: float, entities: int) -> Measured:
    """A run in tmux. `OSError` if tmux does not start; `RuntimeError` with the last words of a game that breaks off."""
    with TemporaryDirectory() as folder:
        result, settings = Path(folder, "result"), Path(folder, "tmux.conf")
        settings.write_text("set -g remain-on-exit on\n")
        server = ["tmux", "-S", str(Path(folder, "socket")), "-f", str(settings)]

        def tmux(*words: str) -> subprocess.CompletedProcess[str]:
            return subprocess.run(
                [*server, *words], capture_output=True, check=False, text=True, env=_environment()
            )

        run_ = [arena, str(fps), str(seconds), str(entities), str(result)]
        size = ["-x", str(COLUMNS), "-y", str(ROWS)]
        begun = tmux("new-session", "-d", *size, sys.executable, "-m", "benchmarks.play", *run_)
        if begun.returncode:
            raise OSError(f"tmux does not start: {begun.stderr.strip()}")
        try:
            patience = perf_counter() + seconds + WARM + PATIENCE
            while not result.exists():
                alive = tmux("display-message", "-p", "#{pane_dead}").stdout.strip() == "0"
                if (not alive and not result.exists()) or perf_counter() > patience:
                    words = tmux("capture-pane", "-p").stdout.split()
                    raise RuntimeError(f"the game broke off: {' '.join(words)[-400:]}")
                sleep(0.05)
            return Measured(**json.loads(result.read_text()))
        finally:
            tmux("kill-server")


def _environment() -> dict[str, str]:
    """The environment of a run: a terminal with colours, UTF-8, and this folder to import from."""
    root = str(Path(__file__).parents[1])
    return {**os.environ, "PYTHONPATH": root, "LC_ALL": "C.UTF-8", "COLORTERM": "truecolor"}


# Within tmux.


def crowd(entities: int) -> Session:
    """A game of so many entities, one of ten a ship that a program flies and that comes again when it dies."""
    world = game(entities)
    pilot = check_program(parse_program(PILOT)).program
    for ship in world.ships:
        world = instructed(world, ship.id, pilot)  # type: ignore[arg-type]  # ships in a world have ids
    players = tuple(
        Player(f"ship {ship.id}", ship.id, human=False, lives=LIVES, program=pilot)
        for ship in world.ships
    )
    return evolve(opened(world, Game("waves", players, wave=1)), selected=world.ships[0].id)


def lacking(world: World, entities: int, random: Random) -> Iterator[Asteroid]:
    """Asteroids that make up a number of entities, where there is room."""
    for _ in range(100):
        if len(world) >= entities:
            break
        radius = random.uniform(8.0, 45.0)
        rock = Asteroid(
            random.uniform(radius, world.width - radius), random.uniform(radius, world.height - radius),
            random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0), radius,
        )  # fmt: skip
        try:
            world = world.add(rock)
        except ModelError:  # it overlaps another one
            continue
        yield rock


def run(arena: str, fps: int, seconds: float, entities: int, result: Path) -> None:
    """Play so long, and write what was measured."""
    from textual.driver import Driver
    from textual.drivers.linux_driver import LinuxDriver

    from fasteroids.cli._arcade import Shelf
    from fasteroids.tui._store import Store
    from fasteroids.tui.app import Arcade
    from fasteroids.tui.driving import chosen_driver
    from fasteroids.tui.launching import Launched, NewGame
    from fasteroids.tui.options import Options
    from fasteroids.tui.picture import View
    from fasteroids.tui.settings import DEFAULTS

    base: Any = chosen_driver().driver or LinuxDriver
    sent = 0

    class Counting(base):  # type: ignore[misc]  # a driver that is chosen when it runs
        """Counts what is sent."""

        def write(self, data: str) -> None:
            nonlocal sent
            sent += len(data.encode())
            super().write(data)

    class Measuring(Arcade):
        """Notes when frames are shown."""

        def on_mount(self) -> None:
            super().on_mount()
            self.random, self.shown, self.before = Random(SEED), [0.0], 0
            self.set_interval(0.5, self.fill)
            self.set_timer(min(WARM, seconds), self.begin_measuring)

        def fill(self) -> None:
            if self.playing is not None:
                session = self.playing.session
                for rock in lacking(session.world, entities, self.random):
                    session = evolve(session, timeline=session.timeline.add(rock))
                self.playing.become(session)

        def begin_measuring(self) -> None:
            self.shown.clear()
            assert self.playing is not None
            self.start = perf_counter(), process_time(), sent, self.playing.frames
            self.set_timer(seconds, self.end_measuring)

        def post_display_hook(self) -> None:
            if sent > self.before:
                self.before = sent
                self.shown.append(perf_counter())

        def end_measuring(self) -> None:
            wall, cpu, bytes_, frames = self.start
            wall, cpu = perf_counter() - wall, process_time() - cpu
            assert self.playing is not None
            made = self.playing.frames - frames
            told = {
                "wall": wall,
                "cpu": cpu,
                "shown": self.shown,
                "made": made,
                "bytes": sent - bytes_,
            }
            part = result.with_suffix(".part")
            part.write_text(json.dumps(told))
            part.rename(result)
            self.exit(0)

    driver: type[Driver] = Counting
    with TemporaryDirectory() as folder:
        home = Path(folder)
        options = Options(view=View(arena=arena), folder=home, settings=evolve(DEFAULTS, fps=fps))
        first = Launched(NewGame("waves", ("hunter",), SEED), "waves: a crowd", crowd(entities))
        store = Store(print, folder=home, config=home / "config.toml")
        gc.collect()
        Measuring(Shelf(), store, options, first=first, driver=driver).run()


if __name__ == "__main__":
    run(sys.argv[1], int(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4]), Path(sys.argv[5]))
