"""What it costs to record a run: of a game whose ships are flown by programs, and of nothing but collisions."""

from __future__ import annotations

from collections.abc import Callable
from tempfile import TemporaryFile
from time import monotonic, process_time

from benchmarks.measure import Effort, Figure, Table, figure, turns
from benchmarks.programs import OPPONENT
from benchmarks.workload import after, workload
from fasteroids import Ship, World, check_program, parse_program
from fasteroids.history.living import beginning, lived
from fasteroids.history.recording import RecordingFile
from fasteroids.moments import advanced
from fasteroids.scene import load_scene

SPAN = 120.0  # s of a game, in which about 1,700 events happen
SLICES = 3


def game(entities: int) -> World:
    """A game of so many: four ships flown by the opponent of 2013, the others asteroids."""
    asteroids = load_scene(
        "[world]\nwidth = 6000\nheight = 4500\nseed = 7\nmodel = 'smooth'\n"
        f"[[asteroid-field]]\ncount = {entities - 4}\nradius = [15, 40]\nspeed = [20, 60]\n"
    )
    program = check_program(parse_program(OPPONENT)).program
    return asteroids.add_all(
        Ship(x, y, 0.0, 0.0, 12.0, 5e15, 0.0, program=program)
        for x, y in ((1500.0, 1100.0), (4500.0, 1100.0), (1500.0, 3300.0), (4500.0, 3300.0))
    )


def living(world: World, span: float) -> Callable[[], float]:
    """A contender: seconds of the processor that it takes to live so long."""

    def measured() -> float:
        start = process_time()
        for _ in lived(beginning(world), advanced(world.clock, span)):
            pass
        return process_time() - start

    return measured


def writing(world: World, span: float, *, packed: bool = False) -> Callable[[], float]:
    """A contender: the same, and a recording of it in a file."""

    def measured() -> float:
        start, until = process_time(), advanced(world.clock, span)
        with (
            TemporaryFile() as file,
            RecordingFile(file, world, clock=monotonic, packed=packed) as recording,
        ):
            for state in lived(beginning(world), until):
                recording.add(state)
            recording.finish(until)
        return process_time() - start

    return measured


def recording(effort: Effort) -> Table:
    """The share that a recording adds to the time of a run, the header and the closing of the file included."""
    figures: list[Figure] = []
    n = effort.size(30)
    for name, world, span, bound in (
        ("a game, ships flown by programs", game(n), SPAN * effort.share, 5.0),
        ("W(30), nothing but bounces", after(workload(n), 2 * n), 1.25 * SPAN * effort.share, None),
    ):
        taken = turns(
            effort.rounds,
            {
                "run": living(world, span),
                "plain": writing(world, span),
                "packed": writing(world, span, packed=True),
            },
            slices=SLICES,
        )
        for how in ("plain", "packed"):
            added = [100.0 * (a / b - 1.0) for a, b in zip(taken[how], taken["run"], strict=True)]
            below = bound if how == "plain" else None
            figures.append(figure(f"{name}: {how}", added, "%", below=below))
    return Table(
        "Recording, added to a headless run of 30 entities",
        figures,
        "Three doubles written in digits, the time and the place of a bounce, are a tenth of what the bounce takes.",
    )
