"""L13: leaving out a part the scene does not need changes nothing, and acting may make it needed."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from fasteroids import World, act
from fasteroids.engine import EVERYTHING
from fasteroids.testing import actions, keeping, unfold, worlds
from tests.properties.laws import BURNING, EVENTS, forced, same, world_law


@world_law
@given(BURNING)
def test_L13_economy(world: World) -> None:
    with keeping("L13_economy", world):
        same(unfold(forced(world, EVERYTHING), events=EVENTS), unfold(world, events=EVENTS))


@world_law
@given(
    worlds(min_size=1, flavours=("ordinary", "thin", "touching")),
    st.lists(st.tuples(st.integers(0, 12), actions()), max_size=6),
)
def test_L13_economy_when_players_act(world: World, orders: list[tuple[int, object]]) -> None:
    plain, full = world, forced(world, EVERYTHING)
    with keeping("L13_economy_when_players_act", world):
        for pause, order in orders:
            runs = [unfold(w, until=w.time + 1.0, events=pause) for w in (plain, full)]
            same(*runs)
            plain, full = (run.end for run in runs)
            for ship in plain.ships[:1]:
                plain, full = act(plain, ship.id, order), act(full, ship.id, order)  # type: ignore[arg-type]
        same(*(unfold(w, events=EVENTS) for w in (plain, full)))
