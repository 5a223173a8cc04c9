"""Scene files: what is wrong with them, each fault at its line."""

from __future__ import annotations

import pickle
import re

import pytest

from fasteroids import ModelError
from fasteroids.paths import Parabola
from fasteroids.scene import Problem, SceneError, dump_scene, load_scene
from tests.unit.making import BOX, ROCK, SHIP, SHOT, problem, problems

BAD = """\
# a bad scene
sped = 3
[world]
width = -5
height = "big"
model = "rbst"
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
PROGRAM = "program, program-text, program-state, program-tick"
SHIP_FIELDS = f"{DISC}, mass, direction, thruster, thrust_power, slowing, {PROGRAM}"

GOLDEN = f"""\
line 2: sped = 3: belongs to no table; {THERE}
line 4: [world], width = -5: must be a number of km from 0 to 1.7976931348623157e+308
line 5: [world], height = "big": must be a number
line 6: [world], model = "rbst": there is no model 'rbst' (did you mean 'robust'?); there are 'spec', 'robust', 'smooth'
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


WIDE = """\
[world]
width = 1e9
height = 1e9
model = "smooth"
time = 100.0
"""
BURNING = """\
[[ship]]
x = 1e5
y = 1e5
radius = 20
mass = 5e15
thruster = true
since = 0.0
"""


def ended(flight: str, when: str) -> str:
    """The problem with a flight that began on line 12."""
    return (
        f"line 12: [[ship]] 1, since = 0.0: its flight {flight} at {when} s, before the time of the world; "
        "a flight begins after the last event"
    )


def test_bent_flights_that_should_have_ended() -> None:
    # Thrust is 220 km/s^2 to the right.
    slow = BURNING + "max_speed = 110.0\n"
    assert problem(WIDE + slow) == ended("reaches its speed limit", "0.5")
    assert len(load_scene(WIDE.replace("100.0", "0.5") + slow)) == 1
    assert problem(WIDE + slow + "vx = -110.0\n") == ended("leaves its speed limit", "0.0")
    back = slow + "vx = -110.0\nslowing = true\n"
    assert problem(WIDE + back) == ended("reaches its speed limit", "1.0")
    assert len(load_scene(WIDE.replace("100.0", "1.0") + back)) == 1
    # It flies at the wall, against its thrust, and is inside the world again at 100 s.
    assert problem(WIDE + BURNING + "vx = -7199\n") == ended("meets the left wall", "20.0")
    # A rock is in its way: 44,000 km from rim to rim.
    rock = ROCK.replace("300", "144030").replace("y = 100", "y = 1e5\nsince = 0")
    assert problem(WIDE + BURNING + rock) == ended("meets [[asteroid]] 1", "20.0")


def test_slowing_only_where_a_ship_leaves_its_limit() -> None:
    inwards = "vx = -110.0\nmax_speed = 110.0\n"
    refused = (
        "line 13: [[ship]] 1, slowing = true: is for a ship at its speed limit whose thruster is on and points "
        "against its velocity"
    )
    late = WIDE.replace("100.0", "0.0")
    for fields in ("", "vx = 110.0\nmax_speed = 110.0\n", "max_speed = 0.0\n"):
        assert problem(late + BURNING + "slowing = true\n" + fields) == refused
    off = BURNING.replace("true", "false") + "slowing = true\n" + inwards
    assert problem(late + off) == refused
    good = late + BURNING + "slowing = true\n" + inwards
    assert type(load_scene(good).flight_of(1).path) is Parabola
    assert load_scene(good, model="robust").flight_of(1).path is None
