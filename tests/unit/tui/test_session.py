"""What is on screen, as a value: live games, the past, other futures."""

from __future__ import annotations

import random

import pytest

from fasteroids import Fire, Thrust, ThrustOff, Turn, evolve_until, load_scene
from fasteroids.actions import Action
from fasteroids.history import MAIN, Told
from fasteroids.tui import session as s
from fasteroids.tui.commanding import commanded
from fasteroids.tui.game import new_game, ruled
from fasteroids.tui.keys import Command
from fasteroids.tui.session import Session

ACTIONS: list[Action] = [Fire(), Turn(0.3), Turn(-0.3), Thrust(), ThrustOff()]

DUEL = """
[world]
width = 1024
height = 768
seed = 5
model = "smooth"
[[ship]]
name = "pilot"
x = 200
y = 384
radius = 20
mass = 5e15
program-text = "while (true) { turn 0.2; fire; thrust; skip; thrust_off; }"
[[ship]]
name = "drone"
x = 800
y = 384
radius = 20
mass = 5e15
[[asteroid-field]]
count = 8
radius = [12, 50]
speed = [30, 120]
clear = 60
"""


def fresh(seed: int = 3) -> Session:
    game, world = new_game("waves", seed=seed, names=["me"], programs=[None])
    return s.opened(world, game)


def played(session: Session, seconds: float, *, seed: int = 4, rate: float = 30.0) -> Session:
    """Some seconds of a clumsy player."""
    draw = random.Random(seed)
    for _ in range(round(seconds * rate)):
        ship = session.game.players[0].ship
        acts = [(ship, draw.choice(ACTIONS))] if ship and draw.random() < 0.3 else []
        session = s.beat(session, 1.0 / rate, acts)
    return session


def duel() -> Session:
    world = load_scene(DUEL)
    return s.opened(world, ruled(world, 0))


# Time.


def test_game_time_goes_by_as_wall_time_does() -> None:
    session = duel()
    for elapsed in (0.02, 0.05, 0.03, 0.0):
        session = s.beat(session, elapsed)
    assert session.world.time == pytest.approx(0.1)
    assert session.world.entities == evolve_until(load_scene(DUEL), session.world.time).entities


@pytest.mark.parametrize("rates", [(30.0, 7.0), (60.0, 11.0)])
def test_a_slow_terminal_shows_fewer_frames_of_the_same_game(rates: tuple[float, float]) -> None:
    ends = []
    for rate in rates:
        session = duel()
        while session.world.time < 5.0:
            session = s.beat(session, 1.0 / rate)
        ends.append(session.timeline.at(5.0).entities)
    assert ends[0] == ends[1]


def test_a_wave_and_a_new_ship_come_at_their_times_whatever_the_frames() -> None:
    times = []
    for rate in (30.0, 8.0):
        session = fresh()
        while session.world.time < 25.0:
            session = s.beat(session, 1.0 / rate)
        told = [
            x
            for x in session.timeline.forwards(session.timeline.first.place)
            if isinstance(x.what, Told)
        ]
        times.append([x.place for x in told])
    assert times[0] == times[1]
    assert len({place.time for place in times[0]}) > 1, "a wave, and a ship after a death"


def test_a_stall_is_no_leap() -> None:
    assert s.beat(duel(), 30.0).world.time == s.LONGEST
    assert s.beat(duel(), -1.0).world.time == 0.0


def test_slow_motion_and_fast_forward() -> None:
    slow = s.faster(duel(), -2)
    assert slow.speed == 0.25
    assert s.beat(slow, 0.1).world.time == pytest.approx(0.025)
    assert s.faster(duel(), 99).speed == s.SPEEDS[-1]
    assert s.faster(duel(), -99).speed == s.SPEEDS[0]


def test_nothing_moves_in_a_pause() -> None:
    session = s.paused(played(fresh(), 1.0))
    assert s.beat(session, 1.0, [(1, Fire())]) is session
    assert s.paused(session).running == 1


def test_an_action_of_a_ship_that_is_gone_is_no_fault() -> None:
    assert s.beat(duel(), 0.1, [(99, Fire())]).world.time == pytest.approx(0.1)


# The past.


def test_scrubbing_back_shows_the_world_as_it_was() -> None:
    session = played(fresh(), 5.0)
    back = s.scrub(session, "second", -1)
    assert not back.live
    assert back.running == 0
    assert back.world == session.timeline.at(session.world.time - 1.0)
    assert s.scrub(back, "second", 1).place == session.place


@pytest.mark.parametrize("unit", ["frame", "second", "event", "tick"])
def test_back_and_forth_by_a_unit_comes_back(unit: s.Unit) -> None:
    session = duel()
    for _ in range(120):
        session = s.beat(session, 1 / 30)
    session = s.scrub(s.scrub(session, unit, -1), unit, -1)
    again = s.scrub(s.scrub(session, unit, -1), unit, 1)
    assert again.world.entities == session.world.entities
    assert again.place.time == pytest.approx(session.place.time)


@pytest.mark.parametrize("unit", ["frame", "second", "event", "tick"])
def test_scrubbing_ends_at_the_ends(unit: s.Unit) -> None:
    session = played(fresh(), 1.0)
    back = session
    for _ in range(200):
        back = s.scrub(back, unit, -1)
    assert back.place <= session.place
    if unit in ("frame", "second"):
        assert back.world.time == 0.0
    forth = back
    for _ in range(400):
        forth = s.scrub(forth, unit, 1)
    assert forth.place <= session.timeline.last.place


def test_the_film_of_the_past_runs_both_ways_and_stops_at_the_ends() -> None:
    session = s.look(played(fresh(), 3.0), s.scrub(played(fresh(), 3.0), "second", -1).place)
    on = s.beat(s.resumed(session), 0.1)
    assert on.world.time == pytest.approx(session.world.time + 0.1)
    back = s.beat(s.resumed(session, -1), 0.1)
    assert back.world.time == pytest.approx(session.world.time - 0.1)
    end = session
    for _ in range(20):
        end = s.beat(s.resumed(end) if not end.running else end, 0.2)
        if end.live:
            break
    assert end.timeline.world.time >= session.timeline.world.time


def test_jumps_find_deaths_and_shots_and_say_what_they_were() -> None:
    session = played(fresh(), 20.0)
    death = s.jump(session, "death", -1)
    assert "died" in death.said
    assert death.place < session.place
    first = death
    while (earlier := s.jump(first, "death", -1)).place != first.place:
        first = earlier
    assert earlier.said == "no earlier death"
    assert s.jump(session, "death", 1).said == "no later death"


def test_selection_goes_round_ships_first() -> None:
    session = duel()
    chosen = []
    for _ in range(len(session.world)):
        session = s.select_next(session, 1)
        chosen.append(session.selected)
    assert chosen[:2] == [1, 2]
    assert sorted(x for x in chosen if x) == sorted(session.world.entities)
    assert s.select_next(session, 1).selected == 1
    assert s.select_next(duel(), -1).selected == chosen[-1]


# Other futures.


def test_taking_over_lives_on_from_there_and_the_old_future_stays() -> None:
    session = played(fresh(), 10.0)
    back = s.look(session, s.scrub(s.scrub(session, "second", -1), "second", -1).place)
    other = s.beat(s.take_over(back), 0.1, [(1, Fire())])
    assert other.live
    assert other.timeline.name == "2"
    assert other.world.time == pytest.approx(back.world.time + 0.1)
    assert other.timeline.switch(MAIN).world is session.world
    ghost = s.ghost(other)
    assert ghost is not None
    assert ghost == session.timeline.at(other.world.time)


def test_points_and_lives_go_back_with_time() -> None:
    session = played(fresh(), 40.0)
    assert session.game.players[0].lives < 3 or session.game.players[0].points > 0
    start = s.look(session, session.timeline.first.place)
    assert (start.game.players[0].lives, start.game.players[0].points) == (3, 0)
    again = s.take_over(start)
    assert (again.game.players[0].lives, again.game.players[0].points) == (3, 0)
    assert s.played(session).game == session.game


def test_a_past_lived_elsewhere_is_judged_anew() -> None:
    session = played(duel(), 8.0)
    review = s.reviewed(session.timeline)
    assert review.world == session.timeline.first.world
    assert not review.live
    last = s.played(review).game
    assert [(p.points, p.ship) for p in last.players] == [
        (p.points, p.ship) for p in session.game.players
    ]


def test_why_a_ship_died_leads_to_where_it_was_fixed() -> None:
    session = played(fresh(), 20.0)
    assert session.game.players[0].lives < 3
    fixed = s.doomed(session, 1)
    assert "died" in fixed.said
    assert fixed.selected == 1
    assert 1 in fixed.world
    assert s.doomed(session, 99).said.startswith("ids in this past go")


def test_bookmarks_get_numbers_or_names() -> None:
    session = s.bookmarked(s.bookmarked(played(fresh(), 1.0)), "here")
    assert sorted(session.timeline.bookmarks) == ["1", "here"]
    assert s.bookmarked(session).said == "bookmark 2"


def test_bookmarks_of_another_future_are_passed_over() -> None:
    session = played(s.bookmarked(played(fresh(), 1.0), "early"), 2.0)
    session = s.take_over(s.look_at(s.bookmarked(session, "late"), 2.0))
    session = s.look_at(played(session, 0.5), 0.5)
    early = commanded(session, Command.NEXT_BOOKMARK)
    assert early is not None
    assert early.said == "bookmark early"
    none = commanded(early, Command.NEXT_BOOKMARK)
    assert none is not None
    assert none.said == "no later bookmark"
