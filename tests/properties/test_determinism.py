"""L11: the same scene gives the same bits, in another process and with another hash seed."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys

from hypothesis import given

from fasteroids import Asteroid, Bullet, Ship, World
from fasteroids.testing import unfold
from tests.properties.laws import BURNING, EVENTS, same, world_law
from tests.unit.making import machine

GOLDEN = "88b51683219d27cf6e25f6f925052c504e29bf57d0096e1f573d0f68ceed9135"


PROGRAM = """
double d; entity a; entity far;
foreach (any, a) {
  if (sqrt(getx a * getx a + gety a * gety a) / 7 > d) { d := sqrt(getx a * getx a + gety a * gety a) / 7; far := a; }
}
if (far != null && d % 0.3 >= 0) { fire; } else { turn 1; }
skip; fire; thrust;
"""


def busy(model: str = "robust") -> World:
    """A world in which everything happens that needs no sine or cosine."""
    return World(1024, 768, seed=3, model=model).add_all(
        [
            Ship(100, 100, 40, 30, 40, 5e15, 0.0, thruster=True),
            Ship(500, 600, -70, 10, 30, 2e15, 0.0, program=machine(PROGRAM)),
            *(
                Asteroid(150 + 90 * i, 250 + 31 * (i % 3), 200 - 45 * i, 17 * i - 60, 12 + i)
                for i in range(9)
            ),
            Bullet(60, 700, 250, -20, 3, 2),
        ]
    )


def digest(world: World, events: int = 400) -> str:
    """A hash of the bits of every event time and of where everything ends."""
    run = unfold(world, until=60.0, events=events)
    events_ = [f"{h.time.hex()} {h.kind} {h.entities} {h.effect}" for h in run.log]
    places = [
        f"{i} {e.x.hex()} {e.y.hex()} {e.vx.hex()} {e.vy.hex()}"
        for i, e in run.end.entities.items()
    ]
    return hashlib.sha256("\n".join(events_ + places).encode()).hexdigest()


@world_law
@given(BURNING)
def test_L11_determinism(world: World) -> None:
    same(unfold(world, events=EVENTS), unfold(world, events=EVENTS))


def test_L11_determinism_across_processes() -> None:
    code = (
        "import sys; sys.path.insert(0, '.');"
        "from tests.properties.test_determinism import busy, digest; print(digest(busy()))"
    )
    for seed in ("0", "1", "4242"):
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        out = subprocess.run(
            [sys.executable, "-c", code],
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        )
        assert digest(busy()) == out.stdout.strip()


def test_L11_determinism_across_versions() -> None:
    """One hash for every Python. If it changes on purpose, the changelog says "numbers changed"."""
    assert GOLDEN == digest(busy())
