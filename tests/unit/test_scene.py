"""Scene files: what they say, what is wrong with them, and the scenes that come with the package."""

from __future__ import annotations

import json
import pickle
import re
import tomllib
from math import cos, pi
from pathlib import Path
from typing import Any

import pytest
from attrs import fields as fields_of
from jsonschema import Draft202012Validator

from fasteroids import (
    Asteroid,
    Bullet,
    Fire,
    ModelError,
    Ship,
    World,
    act,
    evolve,
    happenings,
)
from fasteroids.models import MODELS
from fasteroids.moments import clock_at
from fasteroids.scene import Problem, SceneError, dump_scene, load_scene
from fasteroids.testing import Script, unfold
from fasteroids.units import SPEED_OF_LIGHT, THRUST

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "fasteroids" / "scenes"
SHIPPED = sorted(path.name for path in SCENES.glob("*.toml"))
SCHEMA = json.loads((SCENES / "scene.schema.json").read_text(encoding="utf-8"))
GUIDE = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")

BOX = "[world]\nwidth = 1000\nheight = 800\n"
SHIP = "[[ship]]\nname = 'red'\nx = 100\ny = 100\nradius = 10\nmass = 1e15\n"
ROCK = "[[asteroid]]\nx = 300\ny = 100\nradius = 10\n"
SHOT = "[[bullet]]\nx = 500\ny = 100\nradius = 3\nsource = 'red'\n"


def problems(text: str, **chosen: Any) -> list[str]:
    """The lines of the error a text gives."""
    with pytest.raises(SceneError) as caught:
        load_scene(text, **chosen)
    assert str(caught.value).split("\n") == list(map(str, caught.value.problems))
    return list(map(str, caught.value.problems))


def problem(text: str) -> str:
    """The one problem of a text."""
    (line,) = problems(text)
    return line


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


# Bad files.

BAD = """\
# a bad scene
sped = 3
[world]
width = -5
height = "big"
model = "robst"
time = inf
next_id = 0

[[ship]]
name = "red"
x = 1
radius = -3
mas = 4
direction = nan
thruster = 1
thrust_power = -1.5

[[ship]]
name = "red"
x = 10
y = 10.0
radius = 5
mass = 0
id = 0

[[bullet]] # of nobody
x = [1, 2]
y = 2
radius = 3
source = "rde"
bounced = "no"
since = [0, 1024]

[[bullet]]
x = 1
y = 2
radius = 3
source = 0
max_speed = 400000
bounced_off = -1

[[bulet]]
x = 1

[[asteroid]]
id = 5
name = \"\"\"
two
lines\"\"\"
x = 1979-05-27
y = true
radius = inf
vx = "fast"
[[asteroid]]
id = 5
x = 1
y = 2
radius = 3
program = "skip;"

[[asteroid-field]]
count = 1e5
radius = [5, 2]
speed = -1
clear = inf
[[asteroid-field]]
count = 10001
"""

THERE = "there are [world], [[ship]], [[asteroid]], [[bullet]], [[asteroid-field]]"
DISC = "name, id, x, y, vx, vy, radius, max_speed, since, bounced_off"
SHIP_FIELDS = f"{DISC}, mass, direction, thruster, thrust_power"

GOLDEN = f"""\
line 2: sped = 3: belongs to no table; {THERE}
line 4: [world], width = -5: must be a number of km from 0 to 1.7976931348623157e+308
line 5: [world], height = "big": must be a number
line 6: [world], model = "robst": there is no model 'robst' (did you mean 'robust'?); there are 'spec', 'robust'
line 7: [world], time = inf: must be a finite number of seconds, 0 or more
line 8: [world], next_id = 0: must be an integer from 1, above every id in the file
line 10: [[ship]] "red", y: is missing
line 10: [[ship]] "red", mass: is missing
line 13: [[ship]] "red", radius = -3: must be a finite number of km above 0
line 14: [[ship]] "red", mas = 4: unknown field (did you mean mass?); there are {SHIP_FIELDS}
line 15: [[ship]] "red", direction = nan: must be a finite number of rad
line 16: [[ship]] "red", thruster = 1: must be true or false
line 17: [[ship]] "red", thrust_power = -1.5: must be a finite number of kg km/s^2, 0 or more
line 20: [[ship]] "red", name = "red": is the name of [[ship]] "red" on line 10 too; then both need an id
line 24: [[ship]] "red", mass = 0: must be a finite number of kg above 0
line 25: [[ship]] "red", id = 0: must be an integer from 1
line 28: [[bullet]] 1, x = [1, 2]: must be a number
line 31: [[bullet]] 1, source = "rde": there is no ship of this name (did you mean red?)
line 32: [[bullet]] 1, bounced = "no": must be true or false
line 33: [[bullet]] 1, since = [0, 1024]: the seconds in the window must be at least 0 and less than 1024
line 39: [[bullet]] 2, source = 0: must be the name of a ship in this file, or the id of a ship (an integer from 1)
line 40: [[bullet]] 2, max_speed = 400000: must lie between 0 and 300000 km/s
line 41: [[bullet]] 2, bounced_off = -1: must be an id, or 0 for none
line 43: [[bulet]]: unknown table (did you mean [[bullet]]?); {THERE}
line 48: [[asteroid]] "two\\nlines", name = "two\\nlines": must be printable text
line 51: [[asteroid]] "two\\nlines", x = 1979-05-27: must be a number
line 52: [[asteroid]] "two\\nlines", y = true: must be a number
line 53: [[asteroid]] "two\\nlines", radius = inf: must be a finite number of km above 0
line 54: [[asteroid]] "two\\nlines", vx = "fast": must be a number
line 56: [[asteroid]] 2, id = 5: is the id of [[asteroid]] "two\\nlines" on line 46 too
line 60: [[asteroid]] 2, program = "skip;": unknown field; there are {DISC}
line 63: [[asteroid-field]] 1, count = 100000.0: must be an integer
line 64: [[asteroid-field]] 1, radius = [5, 2]: must be finite numbers of km above 0, the lowest first
line 65: [[asteroid-field]] 1, speed = -1: must be numbers of km/s from 0 to 300000, the lowest first
line 66: [[asteroid-field]] 1, clear = inf: must be a finite number of km, 0 or more
line 67: [[asteroid-field]] 2, radius: is missing
line 68: [[asteroid-field]] 2, count = 10001: must lie between 1 and 10000
"""


def test_every_fault_at_once_each_at_its_line() -> None:
    assert problems(BAD) == GOLDEN.splitlines()


def test_problems_are_records() -> None:
    with pytest.raises(SceneError) as caught:
        load_scene(BOX + SHIP.replace("10\n", "-10\n"))
    assert isinstance(caught.value, ModelError)
    allowed = "must be a finite number of km above 0"
    record = Problem(8, '[[ship]] "red"', "radius", "-10", allowed)
    assert caught.value.problems == (record,)
    assert str(record) == f'line 8: [[ship]] "red", radius = -10: {allowed}'
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


def test_syntax_errors_all_at_once() -> None:
    text = (
        "[world]\nwidth = = 3\nheight = 5 6\n[[ship]\nx = 1\n[[ship]]\nx = 1\nx = 2\n"
        "mass = [1,\n2\nradius = {a = 1,\nb = 2}\ny = [3]]\n[world]\nwidth = 3\nname = 'red\nend\n"
    )
    lines = problems(text)
    assert lines[0] == "line 2: width = = 3: not TOML: invalid value at column 9"
    assert [line.partition(": not TOML: ")[0] for line in lines] == [
        "line 2: width = = 3",
        "line 3: height = 5 6",
        "line 4: [[ship]",  # x = 1 and x = 1 below are in two tables all the same
        "line 8: x = 2",
        "line 11: radius = {a = 1,",  # an array without an end, up to a bracket that is too many
        "line 14: [world]",
        "line 16: name = 'red",
        "line 17: end",
    ]
    assert lines[4].endswith(", in what begins on line 9")


def test_at_most_twenty_syntax_errors() -> None:
    assert len(problems("x = = 1\n" * 30)) == 20


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("x = [1,\n2,\n", "line 1: x = [1,: not TOML: "),
        ("x = '''a\nb = 1\n", "line 1: x = '''a: not TOML: "),
        ("x = 1\n\x00", 'line 2: "\\u0000": not TOML: invalid statement at column 1'),
        ("x = 1\ry = 2", 'line 1: "x = 1\\ry = 2": not TOML: '),
        ("y = 1\nx = " + "9" * 5000, "line 2: x = 999999999"),
        ("x = " + "[" * 5000, "not TOML: values are nested too deeply"),
        ("x = " + "{a=" * 5000, "not TOML: values are nested too deeply"),
    ],
)  # fmt: skip
def test_hostile_syntax(text: str, line: str) -> None:
    assert problem(text).startswith(line)


@pytest.mark.parametrize(
    "value",
    [
        "1" + "0" * 400, "-1" + "0" * 400, "0x" + "f" * 5000, "inf", "-inf", "nan", "true", "'1'",
        "[]", "[1]", "{}", "{x = 1}", "[[[[[1]]]]]", "[" * 200 + "]" * 200, "07:32:00",
        "1979-05-27T07:32:00Z",
    ],
)  # fmt: skip
@pytest.mark.parametrize("field", ["x", "radius", "mass", "since", "id", "name"])
def test_hostile_values(field: str, value: str) -> None:
    text = "[world]\nwidth = 1000\nheight = 800\n[[ship]]\n"
    fields = {"x": "100", "y": "100", "radius": "10", "mass": "1e15", field: value}
    text += "".join(f"{key} = {given}\n" for key, given in fields.items())
    if (field, value) in (("id", "1" + "0" * 400), ("name", "'1'")):
        assert load_scene(dump_scene(load_scene(text))) == load_scene(text)
    else:
        assert re.match(rf"line \d+: \[\[ship\]\] .*, {field} = .*: ", problem(text))


def test_no_world() -> None:
    assert problem("") == "[world]: is missing; it gives the width and the height"
    assert problem("world = 3") == "line 1: [world]: must be one table"
    assert problem("[[world]]\nwidth = 1") == "line 1: [world]: must be one table"


def test_one_table_where_many_may_be() -> None:
    expected = "line 4: ship = {…}: must be one or more tables, each under [[ship]]"
    assert problem(BOX + "[ship]\nx = 1") == expected


def test_inline_tables_have_the_line_of_their_key() -> None:
    text = (
        BOX + "name = 1\n[[asteroid]]\n".replace("name = 1\n", "") + "x.a = 1\ny = 2\nradius = 3\n"
    )
    assert problem(text) == "line 5: [[asteroid]] 1, x = {…}: must be a number"
    text = BOX + "[[asteroid-field]]\ncount = 1\nradius = [\n3,\n 1, # ]\n]\n"
    assert problem(text).startswith("line 6: [[asteroid-field]] 1, radius = [3, 1]: must be finite")


def test_headers_and_keys_inside_strings_are_no_lines() -> None:
    text = BOX + 'model = """\n[[ship]]\nx = 1\n"""\n[[ship]]\n"x" = 1\n'
    lines = problems(text)
    assert lines[0].startswith('line 4: [world], model = "[[ship]]\\nx = 1\\n": there is no model')
    assert [line[:8] for line in lines[1:]] == ["line 8: "] * 3


def test_references_that_do_not_resolve() -> None:
    assert problem(BOX + SHOT).endswith('source = "red": there is no ship of this name')
    twins = SHIP + "id = 1\n" + SHIP.replace("x = 100", "x = 200") + "id = 2\n"
    assert problem(BOX + twins + SHOT).endswith("2 ships have this name; give an id")
    rock = ROCK + "name = 'rock'\n"
    assert problem(BOX + rock + SHOT.replace("red", "rock")).endswith("no ship of this name")


def test_next_id_below_an_id() -> None:
    assert problem(BOX + "next_id = 4\n" + ROCK + "id = 4\n") == (
        "line 4: [world], next_id = 4: must be above every id in the file, and the highest is 4"
    )


@pytest.mark.parametrize(
    ("time", "allowed"),
    [
        ("-1", "must be a finite number of seconds, 0 or more"),
        ("[0.5, 1]", "the number of windows must be an integer from 0"),
        ("[-1, 1]", "the number of windows must be an integer from 0"),
        ("[1" + "0" * 306 + ", 1]", "must be a finite number of seconds, 0 or more"),
        ("[1, nan]", "the seconds in the window must be at least 0 and less than 1024"),
        ("[1, 2, 3]", "the residue must lie between -2.2737367544323206e-13 and 2.27373675"),
        ("[1]", "must be a number of seconds, or [windows of 1024 s, seconds in the window, res"),
        ("[1, 2, 0, 0]", "must be a number of seconds, or [windows of 1024 s, seconds in the win"),
    ],
)
def test_times_refused(time: str, allowed: str) -> None:
    assert problem(BOX + f"time = {time}\n").split(": ", 2)[2].startswith(allowed)


def test_since_after_the_clock() -> None:
    assert problem(BOX + "time = 3\n" + ROCK + "since = 3.5\n") == (
        "line 9: [[asteroid]] 1, since = 3.5: must not be later than the time of the world"
    )


def test_no_room() -> None:
    text = (
        BOX + SHIP + ROCK.replace("300", "112") + ROCK.replace("300", "5") + ROCK.replace("300", "7")
        + ROCK.replace("radius = 10", "radius = 400")
    )  # fmt: skip
    apart = "their centres must be at least"
    assert problems(text) == [
        f'line 10: [[asteroid]] 1: overlaps [[ship]] "red" by 8.0 km; {apart} 20.0 km apart',
        "line 14: [[asteroid]] 2: of radius 10.0 km at (5.0, 100.0) sticks out of the world: "
        "x must lie in [10.0, 990.0], y in [10.0, 790.0]",
        "line 18: [[asteroid]] 3: of radius 10.0 km at (7.0, 100.0) sticks out of the world: "
        "x must lie in [10.0, 990.0], y in [10.0, 790.0]",
        f"line 18: [[asteroid]] 3: overlaps [[asteroid]] 2 by 18.0 km; {apart} 20.0 km apart",
        "line 22: [[asteroid]] 4: is too wide: 2 r = 800.0 km must be less than the width "
        "(1000.0 km) and the height (800.0 km)",
        f"line 22: [[asteroid]] 4: overlaps [[asteroid]] 2 by 115.0 km; {apart} 410.0 km apart",
        f"line 22: [[asteroid]] 4: overlaps [[asteroid]] 3 by 117.0 km; {apart} 410.0 km apart",
        f'line 22: [[asteroid]] 4: overlaps [[ship]] "red" by 210.0 km; {apart} 410.0 km apart',
        f"line 22: [[asteroid]] 4: overlaps [[asteroid]] 1 by 222.0 km; {apart} 410.0 km apart",
    ]


def test_at_most_a_hundred_overlaps() -> None:
    lines = problems(BOX + ROCK * 30)
    assert lines[0] == "more than 100 pairs overlap; some are listed"
    assert len(lines) == 101


def test_flights_that_left_the_world() -> None:
    gone = ROCK + "vx = 300000\nsince = 0\n"
    assert problem(BOX + "time = 1e300\n" + gone).startswith(
        "line 5: [[asteroid]] 1: of radius 10.0 km at (3.0000000000000002e+305, 100.0) sticks out"
    )
    assert problem(BOX + "time = 1e308\n" + gone) == (
        "line 10: [[asteroid]] 1, since = 0: flies out of the world before its time"
    )


def test_flights_that_should_have_ended() -> None:
    # They meet at 4 s, and at 12 s have passed through one another.
    pair = ROCK + "vx = 50\nsince = 0\n" + ROCK.replace("300", "520") + "since = 1\n"
    assert problem(BOX + "time = 12\n" + pair) == (
        "line 10: [[asteroid]] 1, since = 0: its flight meets [[asteroid]] 2 at 4.0 s, before the time of "
        "the world; a flight begins after the last event"
    )
    assert len(load_scene(BOX + "time = 4\n" + pair)) == 2
    assert len(load_scene(BOX + "time = 12\n" + pair.replace("since = 1", "since = 12"))) == 2
    # It was outside, and flew in through the wall.
    late = ROCK.replace("300", "0") + "vx = -1\nsince = 1\n" + ROCK + "since = 1\n"
    assert "sticks out of the world" in problem(BOX + "time = 12\n" + late)


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


def test_dump_refuses_programs() -> None:
    world = World(100, 100).add(Ship(50, 50, 0, 0, 5, 1, 0, program=Script((Fire(),)), name="red"))
    with pytest.raises(
        ModelError, match="ship 'red' has a program, and programs cannot be written"
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


# The scenes that come with the package, the schema, and the guide.


def shipped(name: str) -> World:
    """A scene that comes with the package."""
    return load_scene((SCENES / name).read_text(encoding="utf-8"))


def faults(text: str) -> list[str]:
    """What the schema has against a scene."""
    document = tomllib.loads(text)
    return [error.message for error in Draft202012Validator(SCHEMA).iter_errors(document)]


def test_scenes_that_come_with_the_package() -> None:
    assert SHIPPED == ["default.toml", "duel.toml", "gas.toml", "squeeze.toml", "thrust.toml"]


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenes_run_and_come_back(name: str) -> None:
    world = shipped(name)
    after = unfold(world, until=20.0)
    assert after.log
    assert load_scene(dump_scene(after.end)) == after.end


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenes_keep_to_the_schema(name: str) -> None:
    assert faults((SCENES / name).read_text(encoding="utf-8")) == []
    assert faults(dump_scene(unfold(shipped(name), until=7.3).end)) == []


def test_default_scene_shows_everything() -> None:
    run = unfold(shipped("default.toml"), until=20.0)
    assert {(h.kind, h.effect) for h in run.log} == {
        ("contact", "bounce"), ("contact", "die"), ("contact", "split"), ("wall", "bounce"),
    }  # fmt: skip
    assert {h.wall for h in run.log} == {None, "left", "right", "bottom", "top"}
    assert [ship.name for ship in run.worlds[0].ships] == ["Vega", "Altair"]
    assert len(run.end.ships) == 1


def test_squeeze_counts_the_digits_of_pi() -> None:
    count = 0
    for happened, _ in happenings(shipped("squeeze.toml"), 100.0):
        if happened.wall == "right":
            break
        count += happened.kind == "contact" or happened.wall == "left"
    assert count == int(pi * 100)


def test_duel_is_its_own_mirror_image() -> None:
    world = shipped("duel.toml")
    discs = {(e.x, e.y, e.vx, e.vy, e.radius) for e in world.entities.values()}
    assert discs == {(world.width - x, y, -vx, vy, r) for x, y, vx, vy, r in discs}
    west, east = world.ships
    assert cos(west.direction) == -cos(east.direction)


def test_thrust_scene_thrusts() -> None:
    run = unfold(shipped("thrust.toml"), until=20.0)
    burning, drifting = run.end.ships
    assert max(world.ships[0].speed for world in run.worlds) == pytest.approx(250.0)
    assert burning.thruster
    assert drifting.speed == pytest.approx(50.0)
    assert len([h for h in run.log if h.entities == (3,)]) == 20


def test_schema_is_one() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert SCHEMA["properties"]["world"]["properties"]["model"]["enum"] == sorted(MODELS)


def test_schema_accepts_what_is_dumped() -> None:
    world = World(1e5, 1e5, clock=(5, 0.1, 1e-14)).add_all([
        Ship(100, 100, 1, 2, 10, 1e15, 0, thruster=True, max_speed=9.0, thrust_power=5.0, name="a"),
        Asteroid(300, 100, 1, 2, 9, max_speed=8.0, id=5),
    ])  # fmt: skip
    world = evolve(act(world, 1, Fire()), 3.0)
    assert faults(dump_scene(world)) == []


@pytest.mark.parametrize(
    "text",
    [
        "", "world = 3", "[world]\nwidth = 1", BOX + "depth = 1", BOX + "time = -1",
        BOX + "time = inf", BOX + "time = [1]", BOX + "time = [1, 1024]", BOX + "seed = 1.5",
        BOX + "model = 'robst'", BOX + "next_id = 0", BOX + "[ship]", BOX + "[[shp]]\nx = 1",
        BOX + SHIP + "program = ''", BOX + SHIP + "thruster = 1", BOX + SHIP + "max_speed = 300001",
        BOX + SHIP + "thrust_power = -1", BOX + SHIP + "since = '1'", BOX + SHIP + "bounced = true",
        BOX + SHIP.replace("10\n", "0\n"), BOX + SHIP.replace("mass", "masse"),
        BOX + SHIP.replace("'red'", "''"), BOX + ROCK + "id = 0", BOX + ROCK + "mass = 1",
        BOX + ROCK + "bounced_off = -1", BOX + ROCK.replace("300", "1979-05-27"),
        BOX + ROCK.replace("300", "true"), BOX + ROCK.replace("300", "inf"),
        BOX + SHOT.replace("'red'", "0"), BOX + SHOT.replace("source", "sauce"),
        BOX + "[[asteroid-field]]\ncount = 0\nradius = 1",
        BOX + "[[asteroid-field]]\ncount = 10001\nradius = 1",
        BOX + "[[asteroid-field]]\ncount = 1\nradius = [1]",
        BOX + "[[asteroid-field]]\ncount = 1\nradius = 1\nspeed = -1",
    ],
)  # fmt: skip
def test_schema_and_loader_refuse_the_same(text: str) -> None:
    assert faults(text)
    assert problems(text)


def test_guide_has_an_example_that_loads() -> None:
    (example,) = re.findall(r"```toml\n(.*?)```", GUIDE, re.DOTALL)
    world = load_scene(example)
    assert [ship.name for ship in world.ships] == ["red", "blue"]
    assert len(world.asteroids) == 9
    assert faults(example) == []
    assert unfold(world, until=20.0).log


def test_guide_names_every_field() -> None:
    tables = SCHEMA["properties"]
    fields = set(tables["world"]["properties"])
    for name in ("ship", "asteroid", "bullet", "asteroid-field"):
        fields |= set(tables[name]["items"]["properties"])
    described = set()
    for row in re.findall(r"^\| (`.*?) \|", GUIDE, re.MULTILINE):
        described |= set(re.findall(r"`(\w+)`", row))
    assert described == fields


def test_schema_names_the_fields_of_the_constructors() -> None:
    flight = {"since", "bounced_off"}
    for name, kind in (("ship", Ship), ("asteroid", Asteroid), ("bullet", Bullet)):
        fields = {a.name for a in fields_of(kind)} - {"program"}
        assert set(SCHEMA["properties"][name]["items"]["properties"]) == fields | flight
