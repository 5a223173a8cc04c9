"""How fast programs of ships run: steps by closures against plain steps, and the tick of a real program."""

from __future__ import annotations

from collections.abc import Callable
from time import process_time

from benchmarks.measure import Effort, Table, call_time, figure, rate, ratios, turns
from fasteroids import Asteroid, Ship, World
from fasteroids.actions import View
from fasteroids.lang.code import Code, compiled
from fasteroids.lang.machine import Machine, Ran, run, run_by_steps, started, tick
from fasteroids.lang.parser import parse_program
from fasteroids.rules import ShipView

OPPONENT = """
double x; double y; double r; double ax; double ay; double ar;
entity nearest; entity a; double distance; double least;
bool always := true;

while (always) {
  x := getx self;
  y := gety self;
  r := getradius self;
  nearest := null;
  foreach (asteroid, a) do {
    ax := getx a;
    ay := gety a;
    ar := getradius a;
    distance := sqrt((((x - ax) * (x - ax)) + ((y - ay) * (y - ay))));
    if (nearest == null) then {
      nearest := a;
      least := distance;
    } else {
      if (distance < least) then {
        nearest := a;
        least := distance;
      }
    }
  }
  if (nearest != null) then {
    print least;
  }
  turn 0.2;
  fire;
}
"""
"""What the computer's ship of 2013 does by default: look for the nearest asteroid, say how far it is, turn, fire."""

COUNTING = """
double n; double s; bool odd;
while (true) {
  n := n + 1;
  odd := n % 2 == 1 && !(n < 0);
  if (odd) { s := s + sqrt(n) / 2; } else { s := s - 0.5 * n; }
}
"""
"""Never an action: arithmetic, a branch, a loop."""

STEPS = 200_000  # a round
SLICES = 3


def ready(text: str) -> Code:
    """A program made ready."""
    parsed = parse_program(text)
    assert not parsed.diagnostics
    return compiled(parsed.tree)


def arena(asteroids: int) -> ShipView:
    """What a program sees in a field of asteroids, six in a row, with its ship between them."""
    field = [
        Asteroid(100.0 + 200.0 * (i % 6), 100.0 + 200.0 * (i // 6), 1.0, 2.0, 30.0)
        for i in range(asteroids)
    ]
    ship = Ship(610.0, 420.0, 0.0, 0.0, 10.0, 5e15, 0.0)
    world = World(1_200.0, 200.0 * (asteroids // 6 + 2)).add_all([*field, ship])
    return ShipView(world, world.ships[0])


def stepping(
    text: str, view: View, runner: Callable[[Machine, View, int], Ran]
) -> Callable[[int], None]:
    """Take so many steps of a program that never ends, on from where it was, tick after tick."""
    machine = started(ready(text))

    def steps(count: int) -> None:
        nonlocal machine
        left = count
        while left > 0:
            ran = runner(machine, view, min(left, 10_000))
            left -= min(left, 10_000) - ran.left
            machine = ran.machine

    return steps


def programs(effort: Effort) -> Table:
    """Rates of both ways to run, a tick of the opponent, and whether a step grows dearer as a program runs on."""
    view = arena(effort.size(30))
    count = effort.events(STEPS)
    figures = []
    for name, text in (("the opponent of 2013", OPPONENT), ("arithmetic", COUNTING)):
        taken = turns(
            effort.rounds,
            {
                "closures": rate(stepping(text, view, run), count),
                "steps": rate(stepping(text, view, run_by_steps), count // 4),
            },
            slices=SLICES,
        )
        figures += [
            figure(f"{name}: by closures", taken["closures"], "steps/s", at_least=1e6),
            figure(f"{name}: by plain steps", taken["steps"], "steps/s", at_least=2e5),
            figure(f"{name}: closures over steps", ratios(taken["closures"], taken["steps"])),
        ]
    # Two ticks later it has turned and fired, and is about to look around again.
    machine = run(run(started(ready(OPPONENT)), view, view.fuel).machine, view, view.fuel).machine
    once = call_time(lambda: tick(machine, view, view.fuel), effort.events(100))
    ticking = turns(effort.rounds, {"tick": once})
    figures.append(
        figure(
            "a tick of the opponent among 30 asteroids",
            [us / 1e3 for us in ticking["tick"]],
            "ms",
            below=2.0,
        )
    )
    figures.append(figure("a step late in a run over one early", ageing(view, effort), below=1.5))
    return Table(
        "Programs",
        figures,
        "Steps are counted small steps, whichever way they are taken. The tick looks through all asteroids once.",
    )


def ageing(view: View, effort: Effort) -> list[float]:
    """Time of some plain steps after twenty times as many, over the time of the first ones."""
    result = []
    count = effort.events(20_000)
    for _ in range(effort.rounds):
        early = stepping(COUNTING, view, run_by_steps)
        late = stepping(COUNTING, view, run_by_steps)
        late(20 * count)
        start = process_time()
        late(count)
        middle = process_time()
        early(count)
        result.append((middle - start) / (process_time() - middle))
    return result
