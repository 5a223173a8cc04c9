"""Scene files: what they say, and the worlds that are written to them."""

from __future__ import annotations

import re
from math import pi

import pytest

from fasteroids import Asteroid, Bullet, Fire, ModelError, Ship, World, evolve
from fasteroids.moments import clock_at
from fasteroids.scene import dump_scene, load_scene
from fasteroids.testing import Script, unfold
from fasteroids.units import SPEED_OF_LIGHT, THRUST
from tests.unit.making import BOX, ROCK, SHIP, SHOT, problem

# Good files.


def test_least_scene() -> None:
    assert load_scene("world = {width = 10, height = 20}") == World(10, 20)


def test_fields_of_the_world() -> None:
    text = '[world]\nwidth = 1e3\nheight = 2\nseed = -5\nmodel = "spec"\ntime = 7.5\nnext_id = 9\n'
    world = load_scene(text)
    assert world == World(1000, 2, -5, "spec", clock=clock_at(7.5))
    assert world.roster.next_id == 9


def test_defaults_of_entities() -> None:
    world = load_scene(BOX + SHIP + ROCK + SHOT)
    assert world[1] == Ship(100, 100, 0, 0, 10, 1e15, 0, name="red", id=1)
    assert world[2] == Asteroid(300, 100, 0, 0, 10, id=2)
    assert world[3] == Bullet(500, 100, 0, 0, 3, 1, id=3)


def test_every_field_of_a_ship() -> None:
    ship = Ship(
        1.5, 2.5, 3.0, -4.0, 0.5, 6.0, 7.0,
        thruster=True, name="a b", max_speed=8.0, thrust_power=9.0, id=5,
    )  # fmt: skip
    text = (
        "[[ship]]\nx = 1.5\ny = 2.5\nvx = 3\nvy = -4\nradius = 0.5\nmass = 6\ndirection = 7\n"
        "thruster = true\nname = 'a b'\nmax_speed = 8\nthrust_power = 9\nid = 5\n"
    )
    assert load_scene(BOX + text) == World(1000, 800).add(ship)


def test_every_field_of_a_bullet() -> None:
    bullet = Bullet(50, 60, 7, 8, 3, 12, bounced=True, name="b", max_speed=90.0, id=4)
    text = (
        "[[bullet]]\nx = 50\ny = 60\nvx = 7\nvy = 8\nradius = 3\nsource = 12\nbounced = true\n"
        "name = 'b'\nmax_speed = 90\nid = 4\n"
    )
    assert load_scene(BOX + text) == World(1000, 800).add(bullet)


def test_ids_in_the_order_of_the_file_by_kind() -> None:
    world = load_scene(BOX + SHOT + ROCK + SHIP + ROCK.replace("300", "400"))
    assert [type(e).__name__ for e in world.entities.values()] == [
        "Ship", "Asteroid", "Asteroid", "Bullet",
    ]  # fmt: skip
    assert [world[2].x, world[3].x] == [300, 400]
    assert world.bullets[0].source == 1


def test_ids_given_are_kept_and_the_others_come_after() -> None:
    world = load_scene(BOX + SHIP + ROCK + "id = 7\n" + SHOT)
    assert {i: type(e) for i, e in world.entities.items()} == {7: Asteroid, 8: Ship, 9: Bullet}
    assert world.bullets[0].source == 8
    world = load_scene(BOX + "next_id = 20\n" + SHIP + "id = 3\n" + SHOT)
    assert list(world.entities) == [3, 20]
    assert world.roster.next_id == 21


def test_names_may_repeat_where_all_have_ids() -> None:
    twin = SHIP.replace("x = 100", "x = 200")
    world = load_scene(BOX + SHIP + "id = 1\n" + twin + "id = 2\n")
    assert [ship.name for ship in world.ships] == ["red", "red"]
    assert load_scene(dump_scene(world)) == world


def test_velocity_is_total_as_in_the_constructor() -> None:
    world = load_scene(BOX + ROCK + "vx = nan\nvy = inf\n")
    assert world[1].velocity == (0.0, SPEED_OF_LIGHT)


def test_a_bullet_may_start_inside_its_ship() -> None:
    assert len(load_scene(BOX + SHIP + SHOT.replace("500", "100"))) == 2


def test_touching_is_fine() -> None:
    assert len(load_scene(BOX + SHIP + ROCK.replace("300", "120"))) == 2
    assert len(load_scene(BOX + SHIP.replace("x = 100", "x = 10"))) == 1


def test_other_ways_to_write_the_same_toml() -> None:
    text = (
        "\ufeff# with a mark\r\nworld.width = 1_000\r\nworld . 'height' = 0x320\r\n"
        "ship = [{name = \"red\", x = 1e2, y = 100, radius = +10, mass = 1e15}]\r\n"
    )  # fmt: skip
    assert load_scene(text) == load_scene(BOX + SHIP)


def test_seed_and_model_of_the_caller_win() -> None:
    text = BOX + "seed = 3\n[[asteroid-field]]\ncount = 5\nradius = 9\n"
    assert load_scene(text, seed=4) == load_scene(text.replace("seed = 3", "seed = 4"))
    assert load_scene(text, seed=4) != load_scene(text)
    assert load_scene(text, model="spec").model == "spec"


def test_a_flight_that_began_earlier() -> None:
    text = BOX + "time = 12.5\n" + ROCK + "vx = 20\nsince = 10\nbounced_off = 77\n"
    world = load_scene(text)
    assert world.time == 12.5
    assert world[1].position == (350.0, 100.0)
    assert world.flight_of(1).since == (0, 10.0)
    assert world.flight_of(1).bounced_off == 77


def test_time_in_windows() -> None:
    text = BOX + "time = [3, 0.5, 1e-14]\n" + ROCK + "since = [2, 1023.5]\n"
    world = load_scene(text)
    assert world.clock == (3, 0.5, 1e-14)
    assert world.flight_of(1).since == (2, 1023.5)
    assert load_scene(dump_scene(world)) == world


# Fields of asteroids.


def test_field_by_numbers() -> None:
    text = BOX + SHIP + "[[asteroid-field]]\ncount = 20\nradius = 12\nspeed = 7\nclear = 100\n"
    world = load_scene(text)
    assert list(world.entities) == list(range(1, 22))
    for a in world.asteroids:
        assert a.radius == 12.0
        assert a.speed == pytest.approx(7.0)
        assert (a.x - 100) ** 2 + (a.y - 100) ** 2 >= (10 + 12 + 100) ** 2


def test_field_depends_on_the_seed_and_its_number() -> None:
    one = BOX + "[[asteroid-field]]\ncount = 9\nradius = [1, 9]\n"
    first = load_scene(one).asteroids
    assert first == load_scene(one).asteroids
    assert first != load_scene(one, seed=1).asteroids
    two = load_scene(one + "[[asteroid-field]]\ncount = 9\nradius = [1, 9]\n").asteroids
    assert two[:9] == first
    assert [a.radius for a in two[9:]] != [a.radius for a in first]


def test_field_fills_its_radii_and_its_rectangle() -> None:
    text = "[world]\nwidth = 1e5\nheight = 1e5\n[[asteroid-field]]\ncount = 2000\nradius = [1, 3]\n"
    discs = load_scene(text).asteroids
    for values, low, high in (
        ([a.x for a in discs], 0, 1e5),
        ([a.y for a in discs], 0, 1e5),
        ([a.radius for a in discs], 1, 3),
    ):
        counts = [0] * 10
        for value in values:
            counts[int(10 * (value - low) / (high - low))] += 1
        assert max(abs(count - 200) for count in counts) < 70  # five standard deviations


def test_field_too_dense() -> None:
    text = BOX + "[[asteroid-field]]\ncount = 900\nradius = 20\n"
    assert re.fullmatch(
        r"line 5: \[\[asteroid-field\]\] 1, count = 900: there is no room for more than \d+: "
        r"the next one found no place in 1000 tries",
        problem(text),
    )


def test_field_beside_a_ship_in_a_world_of_extreme_size() -> None:
    size = "[world]\nwidth = 1.7e308\nheight = 1e-300\n"
    world = load_scene(size + "[[asteroid-field]]\ncount = 50\nradius = [1e-310, 1e-301]\n")
    assert len(world) == 50


# Writing.


def test_dump_of_a_fresh_world_is_what_one_would_write() -> None:
    world = World(640, 480.5, seed=3).add_all([
        Ship(100, 100, -0.0, 0, 10, 1e15, pi, name='say "hi"'),
        Asteroid(300.25, 100, 1e-5, 5e-324, 10),
        Bullet(500, 100, 250, 0, 3, 1),
    ])  # fmt: skip
    assert dump_scene(world) == (
        "[world]\nwidth = 640.0\nheight = 480.5\nseed = 3\n\n"
        '[[ship]]\nname = "say \\"hi\\""\nx = 100.0\ny = 100.0\nvx = -0.0\nvy = 0.0\nradius = 10.0\n'
        "mass = 1000000000000000.0\ndirection = 3.141592653589793\n\n"
        "[[asteroid]]\nx = 300.25\ny = 100.0\nvx = 1e-05\nvy = 5e-324\nradius = 10.0\n\n"
        "[[bullet]]\nx = 500.0\ny = 100.0\nvx = 250.0\nvy = 0.0\nradius = 3.0\nsource = 1\n"
    )
    assert load_scene(dump_scene(world)) == world


def test_dump_of_everything_that_is_not_usual() -> None:
    ship = Ship(
        100, 100, 0, 0, 10, 1e15, 0, thruster=True, max_speed=9.0, thrust_power=THRUST / 2, id=4
    )
    world = World(640, 480, 0, "spec", clock=(5, 0.1, 1e-14)).add_all([
        ship, Bullet(500, 100, 0, 0, 3, 99, bounced=True, id=6), Asteroid(300, 100, 0, 0, 9, id=8)
    ]).remove(8)  # fmt: skip
    assert dump_scene(world) == (
        '[world]\nwidth = 640.0\nheight = 480.0\nmodel = "spec"\ntime = [5, 0.1, 1e-14]\nnext_id = 9\n\n'
        "[[ship]]\nid = 4\nx = 100.0\ny = 100.0\nvx = 0.0\nvy = 0.0\nradius = 10.0\n"
        "mass = 1000000000000000.0\ndirection = 0.0\nthruster = true\nmax_speed = 9.0\n"
        "thrust_power = 5.5e+17\n\n"
        "[[bullet]]\nid = 6\nx = 500.0\ny = 100.0\nvx = 0.0\nvy = 0.0\nradius = 3.0\nsource = 99\n"
        "bounced = true\n"
    )
    back = load_scene(dump_scene(world))
    assert back == world
    assert back.roster.next_id == 9


def test_dump_of_flights() -> None:
    world = World(400, 100).add_all([Asteroid(100, 50, 50, 0, 10), Asteroid(200, 50, 0, 0, 10)])
    after = evolve(world, 2.5)
    text = dump_scene(after)
    assert "time = 2.5\n" in text
    assert text.count("since = 1.6\n") == 2
    assert "bounced_off = 2\n" in text
    assert "bounced_off = 1\n" in text
    assert load_scene(text) == after


def test_a_moment_that_is_no_double_is_written_in_two_parts() -> None:
    world = World(10, 10, clock=(5, 0.1, 0.0))  # 5120.1 s rounds
    assert "time = [5, 0.1]\n" in dump_scene(world)
    assert "time = 5120.5\n" in dump_scene(World(10, 10, clock=(5, 0.5, 0.0)))
    assert load_scene(dump_scene(world)) == world


def test_dump_of_an_empty_world_that_was_not() -> None:
    world = World(10, 10).add(Asteroid(5, 5, 0, 0, 1)).remove(1)
    assert load_scene(dump_scene(world)).add(Asteroid(5, 5, 0, 0, 1))[2]


def test_dump_refuses_programs_that_are_no_text() -> None:
    world = World(100, 100).add(Ship(50, 50, 0, 0, 5, 1, 0, program=Script((Fire(),)), name="red"))
    with pytest.raises(
        ModelError, match="ship 'red' has a program that is no text, and cannot be written"
    ):
        dump_scene(world)


def test_dump_of_a_huge_id() -> None:
    world = World(100, 100).add(Asteroid(50, 50, 0, 0, 5, id=10**300))
    assert load_scene(dump_scene(world)) == world
    world = World(100, 100).add(Asteroid(50, 50, 0, 0, 5, id=10**5000))
    with pytest.raises(ModelError, match="too long to be written"):
        dump_scene(world)


def test_a_world_far_from_its_origin_in_time_and_space_comes_back() -> None:
    """Rounding of long flights is left where the next ones begin, near the origin too."""
    world = World(1e9, 1e9).add_all([
        Asteroid(1.5, 1.25, 0, 0, 1, max_speed=0.1),
        Asteroid(7e8, 6e8, -0.07, -0.0599999999, 1, max_speed=0.1),
    ])  # fmt: skip
    run = unfold(world, events=3)
    assert run.log[0].kind == "contact"
    for after in run.worlds:
        assert load_scene(dump_scene(after)) == after
