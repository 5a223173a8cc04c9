"""L7: in bounds and no overlap, at every event and between events, to a margin computed from the numbers.

`fasteroids.audit` looks at every pair of flights over all the time they had in common (its own tests show that it
finds a missed, a late and a wrong contact). Here it audits worlds of every flavour.
"""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from fasteroids import World, evolve_until
from fasteroids.audit import audit
from fasteroids.moments import between, resolution
from fasteroids.overlap import Placed, first_overlap, outside, slack
from fasteroids.state import located
from fasteroids.testing import keeping, unfold, worlds
from fasteroids.testing.runs import FOREVER
from tests.properties.laws import BURNING, EVENTS, world_law


@world_law
@given(BURNING)
def test_L7_containment(world: World) -> None:
    with keeping("L7_containment", world):
        report = audit(world, FOREVER, max_events=EVENTS)
        assert [] == [margin for margin in report.margins if not margin.ok]


@world_law
@given(worlds(flavours=("ordinary", "dense", "thin")), st.floats(0.0, 1.0))
def test_L7_containment_at_any_moment(world: World, part: float) -> None:
    log = unfold(world, events=EVENTS).log
    then = evolve_until(world, part * log[-1].time if log else 1.0)
    fine = resolution(then.now)
    fastest = max((f.entity.max_speed for f in then.all_flights().values()), default=0.0)
    with keeping("L7_containment_at_any_moment", world):
        placed = []
        for f in then.all_flights().values():
            e, age = located(f, then.now), between(f.since, then.now)
            placed.append(Placed(e, slack(e, age, fine, fastest)))
        assert first_overlap((), placed) is None
        assert not any(outside(p, then.width, then.height) for p in placed)
