"""The sniper: shoots by way of a wall what it cannot hit straight."""

from __future__ import annotations

from fasteroids import Asteroid, Happened
from tests.unit.programs.playing import acted, arena, cleared, end, killer, log, pilot, wins


def walls(happened: list[Happened], victim: int) -> list[str | None]:
    """The walls that the bullet met which killed it."""
    died = set(killer(happened, victim).died)
    return [h.wall for h in happened if h.kind == "wall" and died & set(h.entities)]


def test_it_hits_a_target_behind_a_blocker_by_way_of_a_wall() -> None:
    shooter, blocker, target = pilot("sniper", 150), Asteroid(500, 384, 0, 0, 60), pilot(None, 900)
    happened = log(arena(shooter, blocker, target), 10.0)
    kill = killer(happened, 3)
    assert walls(happened, 3) in (["bottom"], ["top"])
    assert not any(2 in h.died for h in happened if h.time <= kill.time)


def test_it_also_leads_in_the_mirror() -> None:
    """The target flies along behind three asteroids in a row, to and fro."""
    row = [Asteroid(x, 300, 0, 0, 60) for x in (380, 510, 640)]
    target = pilot(None, 380, 600, vx=60.0)
    happened = log(arena(pilot("sniper", 512, 60), *row, target), 15.0)
    assert len(walls(happened, 5)) == 1
    assert not any(set(h.died) & {2, 3, 4} for h in happened if h.time < killer(happened, 5).time)


def test_it_shoots_straight_where_the_way_is_clear() -> None:
    happened = log(arena(pilot("sniper", 150), pilot(None, 900, 500)), 10.0)
    assert walls(happened, 2) == []
    assert acted(happened)[:2] == ["turn", "fire"]


def test_it_defends_itself_before_it_shoots_ships() -> None:
    attacker = Asteroid(512, 650, 0, -100, 25)
    happened = log(arena(pilot("sniper"), pilot(None, 900), attacker), 10.0)
    assert killer(happened, 3).time < killer(happened, 2).time


def test_it_waits_where_there_is_nothing_to_shoot() -> None:
    assert set(acted(log(arena(pilot("sniper")), 2.0))) == {"skip"}


def test_it_wastes_no_run_where_a_bullet_would_start_behind_a_wall() -> None:
    """Its back to the wall it looks at: it turns instead, and hits by another line."""
    world = arena(pilot("sniper", 984, 384), pilot(None, 300, 384))
    assert 2 not in end(world, 6.0)


def test_it_clears_slow_fields_and_beats_the_opponent_of_2013() -> None:
    assert cleared("field-2013", range(10), "sniper") >= 8
    assert wins("one-on-one", range(10), "sniper", "opponent-2013") >= 18
