"""The rules of a game beside those of the world: waves, lives, points, the end."""

from __future__ import annotations

from math import hypot, pi

import pytest
from attrs import evolve

from fasteroids import Asteroid, Bullet, Fire, Ship, World, check_program, parse_program
from fasteroids.history import Act, Add, Lived, Timeline, Told, begin
from fasteroids.tui.game import (
    LIVES,
    MASS,
    PAUSE,
    RADIUS,
    Game,
    Player,
    granted,
    judged,
    new_game,
    points,
    ruled,
    wave,
    wishes,
)

PROGRAM = check_program(parse_program("while (true) { turn 0.1; }")).program


def after(game: Game, timeline: Timeline, states: Timeline) -> Game:
    """The game after what happened from one timeline to a later one."""
    world = timeline.world
    for state in states.forwards(timeline.last.place):
        game = judged(game, world, state)
        world = state.world
    return game


def alone(*others: Asteroid | Ship) -> tuple[Game, Timeline]:
    """A game of waves in its first wave, with a ship that faces right and others."""
    game, world = new_game("waves", seed=1, names=["me"], programs=[None])
    world = World(1024, 768, 1, "smooth").add(evolve(world.ships[0], x=300, direction=0.0, id=None))
    return evolve(game, wave=1), begin(world.add_all(others))


# Beginnings.


def test_a_game_of_waves_has_one_ship_in_the_middle_and_wants_a_wave_at_once() -> None:
    game, world = new_game("waves", seed=1, names=["me"], programs=[None])
    assert [(s.x, s.y, s.name) for s in world.ships] == [(512, 384, "me")]
    assert game.players == (Player("me", 1, True, LIVES),)
    wish = wishes(game, world)
    assert wish is not None
    assert (wish.kind, wish.time) == ("wave", 0.0)


def test_a_duel_has_two_ships_that_face_each_other_among_asteroids() -> None:
    game, world = new_game("duel", seed=1, names=["a", "b"], programs=[None, PROGRAM])
    assert [s.direction for s in world.ships] == [0.0, pi]
    assert [(p.human, p.lives) for p in game.players] == [(True, 1), (False, 1)]
    assert world.asteroids
    assert wishes(game, world) is None


def test_a_scene_is_a_duel_if_two_fly_in_it() -> None:
    ship = Ship(100, 100, 0, 0, 20, MASS, 0.0)
    one = World(1000, 1000).add(ship)
    two = one.add(evolve(ship, x=500, program=PROGRAM, name="bot"))
    assert (ruled(one, 1).mode, ruled(two, 1).mode, ruled(two, 0).mode) == ("free", "duel", "free")
    assert [(p.name, p.human) for p in ruled(two, 1).players] == [("ship 1", True), ("bot", False)]


# Points.


def test_a_shot_is_worth_what_it_destroys() -> None:
    game, start = alone(Asteroid(400, 384, 0, 0, 25))
    shot = start.act(1, Fire())
    end = shot.evolve(1.0)
    assert after(game, start, end).players[0].points == 50


def test_a_shot_that_dies_as_it_is_fired_counts_too() -> None:
    game, start = alone(Asteroid(335, 384, 0, 0, 12))
    end = start.act(1, Fire())
    assert end.last.died == (2, 3)
    assert after(game, start, end).players[0].points == 100


def test_a_crash_is_worth_nothing() -> None:
    game, start = alone(Asteroid(400, 384, -100, 0, 25))
    played = after(game, start, start.evolve(1.0))
    assert played.players[0].points == 0
    assert played.players[0].ship is None


@pytest.mark.parametrize(
    ("entity", "worth"),
    [
        (Asteroid(0, 0, 0, 0, 40), 20),
        (Asteroid(0, 0, 0, 0, 39.9), 50),
        (Asteroid(0, 0, 0, 0, 19.9), 100),
        (Ship(0, 0, 0, 0, 20, MASS, 0), 200),
        (Bullet(0, 0, 0, 0, 3, 1), 0),
    ],
)
def test_what_is_harder_to_hit_is_worth_more(entity: Asteroid | Ship | Bullet, worth: int) -> None:
    assert points(entity) == worth


# Lives.


def test_a_dead_player_of_waves_wants_another_ship_after_a_while() -> None:
    game, start = alone(Asteroid(400, 384, -100, 0, 25))
    end = start.evolve(1.0)
    game = after(game, start, end)
    died = game.players[0].died
    assert died is not None
    wish = wishes(game, end.world)
    assert wish is not None
    assert (wish.kind, wish.time, game.players[0].lives) == ("ship", died + PAUSE, LIVES - 1)
    (add,) = granted(game, end.world, wish)
    assert isinstance(add, Add)
    grown = end.take(add)
    player = after(game, end, grown).players[0]
    assert (player.ship, player.died) == (3, None)


def test_a_new_ship_comes_where_there_is_room() -> None:
    game, start = alone(Asteroid(512, 384, 0, 0, 90), Asteroid(800, 600, 0, 0, 60))
    game = evolve(game, players=(evolve(game.players[0], ship=None, died=0.0, lives=1),))
    world = start.world.remove(1)
    wish = wishes(game, world)
    assert wish is not None
    (add,) = granted(game, world, wish)
    assert isinstance(add, Add)
    room = min(hypot(a.x - add.entity.x, a.y - add.entity.y) - a.radius for a in world.asteroids)
    assert room > 4 * RADIUS


def test_without_room_there_is_no_ship_yet() -> None:
    world = World(200, 200, model="smooth").add(Asteroid(100, 100, 0, 0, 99))
    game = Game("waves", (Player("me", None, True, 1, 0, 0.0),), 1)
    wish = wishes(game, world)
    assert wish is not None
    assert granted(game, world, wish) == []


def test_a_game_of_waves_ends_with_the_last_life() -> None:
    game, start = alone(Asteroid(400, 384, -100, 0, 25))
    game = evolve(game, players=(evolve(game.players[0], lives=1),))
    game = after(game, start, start.evolve(1.0))
    assert game.ended == "game over"
    assert wishes(game, start.world) is None


def test_you_win_and_anybody_else_wins() -> None:
    for names, ended in ((["you", "b"], "you win"), (["yours", "b"], "yours wins")):
        game, world = new_game("duel", seed=1, names=names, programs=[None, None])
        state = begin(world).remove(2).last
        told = Lived(state.place, evolve(state.what, died=(2,)), state.world)  # type: ignore[misc]
        assert judged(game, world, told).ended == ended


def test_the_last_ship_of_a_duel_wins_and_two_deaths_are_a_draw() -> None:
    game, world = new_game("duel", seed=1, names=["a", "b"], programs=[None, None])
    dead = evolve(game, players=(evolve(game.players[0]), evolve(game.players[1], ship=None)))
    state = begin(world).remove(2).last
    told = Lived(state.place, evolve(state.what, died=(2,)), state.world)  # type: ignore[misc]
    assert judged(game, world, told).ended == "a wins"
    assert (
        judged(dead, world, Lived(state.place, Told(Act(1, Fire()), died=(1,)), state.world)).ended
        == "a draw"
    )


# Waves.


def test_waves_get_harder() -> None:
    _, world = new_game("waves", seed=1, names=["me"], programs=[None])
    waves = [wave(world, n) for n in (1, 4, 9, 20)]
    counts = [len(some) for some in waves]
    speeds = [sum(a.speed for a in some) / len(some) for some in waves]
    assert counts == sorted(counts)
    assert counts[0] == 4
    assert speeds == sorted(speeds)


def test_a_wave_comes_away_from_every_ship() -> None:
    _, world = new_game("waves", seed=1, names=["me"], programs=[None])
    for number in range(1, 20):
        for a in wave(world, number):
            assert hypot(a.x - 512, a.y - 384) - a.radius - RADIUS >= 120


def test_the_next_wave_comes_a_while_after_the_last_asteroid() -> None:
    game, start = alone(Asteroid(400, 384, 0, 0, 25))
    end = start.act(1, Fire()).evolve(1.0)
    game = after(game, start, end)
    assert game.cleared is not None
    wish = wishes(game, end.world)
    assert wish is not None
    assert (wish.kind, wish.time) == ("wave", game.cleared + PAUSE)
    grown = end
    for what in granted(game, end.world, wish):
        grown = grown.take(what)
    assert after(game, end, grown).wave == 2
    assert wishes(after(game, end, grown), grown.world) is None
