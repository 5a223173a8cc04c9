"""How fast the fold is: against a peer, against the yardstick, and as worlds grow."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from itertools import islice, pairwise
from time import process_time

from benchmarks.measure import Effort, Table, call_time, figure, rate, ratios, turns
from benchmarks.workload import FOREVER, after, thrusting, workload
from benchmarks.yardstick import Yardstick
from fasteroids import World, evolve, happenings

PEER_EVENTS = 40  # a round; the peer is some hundred times slower
EVENTS = 12_000  # a round
SLICES = 5


def unfolding(world: World) -> Callable[[int], object]:
    """Let so many events happen, each yielding a world."""
    events = happenings(world, FOREVER)
    return lambda count: deque(islice(events, count), maxlen=0)


def engine(world: World) -> Callable[[int], object]:
    """The same from a world that, like every contender's, is warmed up by 2 N events."""
    return unfolding(after(world, 2 * len(world)))


def yardstick(world: World) -> Callable[[int], object]:
    """The same without worlds."""
    fold = Yardstick(world)
    fold.run(2 * len(world))
    return fold.run


def billiards_rate(world: World, events: int) -> Callable[[], float]:
    """Events per second of the package `billiards`, from the same start; about `events` a round."""
    from billiards import Billiard  # type: ignore[import-untyped,unused-ignore]
    from billiards.obstacles import InfiniteWall  # type: ignore[import-untyped,unused-ignore]

    w, h = world.width, world.height
    corners = [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h), (0.0, 0.0)]
    table = Billiard([InfiniteWall(a, b, inside="left") for a, b in pairwise(corners)])
    for a in world.asteroids:
        table.add_ball(a.position, a.velocity, a.radius, a.mass)
    times = (happened.time for happened, _ in happenings(world, FOREVER))

    def measured() -> float:
        until = next(islice(times, events - 1, None))
        start = process_time()
        bounces = len(table.evolve(until))
        return bounces / (process_time() - start)

    return measured


def peer(effort: Effort) -> Table:
    """Against the `billiards` package."""
    n = effort.size(1_000)
    world = workload(n)
    taken = turns(
        effort.rounds,
        {
            "engine": rate(engine(world), effort.events(EVENTS)),
            "billiards": billiards_rate(world, max(5, effort.events(PEER_EVENTS))),
        },
    )
    return Table(
        "Against billiards 0.5.0",
        [
            figure(
                f"rate over the peer's, N = {n:,}",
                ratios(taken["engine"], taken["billiards"]),
                at_least=60.0,
            ),
            figure("fasteroids", taken["engine"], "events/s"),
            figure("billiards", taken["billiards"], "events/s"),
        ],
        "Events are bounces that happen, off discs and walls; each of ours yields a world.",
    )


def against_yardstick(effort: Effort) -> Table:
    """Against the same algorithm in place, without worlds."""
    n = effort.size(1_000)
    world, events = workload(n), effort.events(EVENTS // SLICES)
    taken = turns(
        effort.rounds,
        {"engine": rate(engine(world), events), "yardstick": rate(yardstick(world), events)},
        slices=SLICES,
    )
    return Table(
        "Against the yardstick",
        [
            figure(
                f"rate over the yardstick's, N = {n:,}",
                ratios(taken["engine"], taken["yardstick"]),
                at_least=0.5,
            ),
            figure("fasteroids", taken["engine"], "events/s"),
            figure("yardstick", taken["yardstick"], "events/s"),
        ],
        "The yardstick is the same algorithm, in place and without worlds; its log has the same bits.",
    )


def growth(effort: Effort) -> Table:
    """The cost of an event as N grows."""
    events = effort.events(EVENTS)
    sizes = [effort.size(n) for n in (100, 1_000, 10_000)]
    taken = turns(
        effort.rounds, {str(n): rate(engine(workload(n)), events) for n in dict.fromkeys(sizes)}
    )
    few, _, many = (taken[str(n)] for n in sizes)
    return Table(
        "Growth of the cost per event",
        [
            figure(f"N = {sizes[2]:,} over N = {sizes[0]:,}", ratios(few, many), below=3.0),
            *(figure(f"N = {int(n):,}", rates, "events/s") for n, rates in taken.items()),
        ],
    )


def levels(effort: Effort) -> Table:
    """What deciding right costs."""
    n, events = effort.size(1_000), effort.events(EVENTS // SLICES)
    taken = turns(
        effort.rounds,
        {model: rate(engine(workload(n, model=model)), events) for model in ("robust", "spec")},
        slices=SLICES,
    )
    return Table(
        "robust against spec",
        [
            figure(
                f"cost per event of robust over spec, N = {n:,}",
                ratios(taken["spec"], taken["robust"]),
                below=1.3,
            ),
            *(figure(model, rates, "events/s") for model, rates in taken.items()),
        ],
    )


def thrust(effort: Effort) -> Table:
    """What exact paths cost."""
    n, events = effort.size(30), effort.events(EVENTS // SLICES)
    taken = turns(
        effort.rounds,
        {
            rule: rate(engine(thrusting(n, 4, model=model)), events)
            for rule, model in (("literal", "robust"), ("smooth", "smooth"))
        },
        slices=SLICES,
    )
    return Table(
        "smooth against literal",
        [
            figure(
                f"events/s of smooth over literal, N = {n}, 4 ships thrusting",
                ratios(taken["smooth"], taken["literal"]),
                at_least=0.5,
            ),
            *(figure(rule, rates, "events/s") for rule, rates in taken.items()),
        ],
        "literal gives each thrusting ship a new flight at every event, smooth only at its own.",
    )


def idle(effort: Effort) -> Table:
    """A step in which nothing happens."""
    calls = effort.events(20_000)
    sizes = list(dict.fromkeys(effort.size(n) for n in (10, 1_000, 10_000)))
    taken = turns(effort.rounds, {str(n): call_time(_step(n), calls) for n in sizes})
    first, last = str(sizes[0]), str(sizes[-1])
    return Table(
        "evolve without events, on its own result",
        [
            *(figure(f"N = {int(n):,}", times, "us", below=10.0) for n, times in taken.items()),
            figure(f"N = {sizes[-1]:,} over N = {sizes[0]:,}", ratios(taken[last], taken[first])),
        ],
    )


def _step(n: int) -> Callable[[], object]:
    world = after(workload(n), 2 * n)

    def step() -> None:
        nonlocal world
        world = evolve(world, 1e-12)

    return step
