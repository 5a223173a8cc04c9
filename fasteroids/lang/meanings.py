"""What each word and sign of the language means, in one sentence: for editors.

Units are those of the whole package: km, s, km/s, rad, angles counter-clockwise from the x-axis (assignment 1.8).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from attrs import frozen

from fasteroids.units import BULLET_RADIUS, BULLET_SPEED, FUEL, MAX_BULLETS, TICKS_PER_SECOND

__all__ = ["MEANINGS", "Meaning"]


@frozen
class Meaning:
    """How a word or sign is written, and what it does.

    In `usage`, `e` stands for any expression, `x` for a variable, `{ }` for a block. `sentence` is one plain
    sentence, with its full stop; code in it stands between backquotes.
    """

    usage: str
    sentence: str


_TICK: Final = f"{1 / TICKS_PER_SECOND:g} s"

MEANINGS: Final[Mapping[str, Meaning]] = {
    # Types.
    "bool": Meaning("bool x;", "Declares a truth value, `false` at first."),
    "double": Meaning("double x;", "Declares a number, 0 at first."),
    "entity": Meaning(
        "entity x;", "Declares a ship, an asteroid, a bullet or nothing, `null` at first."
    ),
    # What a for-each ranges over.
    "ship": Meaning("foreach (ship, x) { }", "All living ships, the own one included."),
    "asteroid": Meaning("foreach (asteroid, x) { }", "All living asteroids."),
    "bullet": Meaning("foreach (bullet, x) { }", "All living bullets, the own ones included."),
    "any": Meaning(
        "foreach (any, x) { }", "All living ships, asteroids and bullets, the own ship included."
    ),
    # Actions.
    "turn": Meaning(
        "turn e;",
        f"Action: turns the ship at once by an angle in rad, counter-clockwise if positive, and waits {_TICK}.",
    ),
    "fire": Meaning(
        "fire;",
        f"Action: fires a bullet of radius {BULLET_RADIUS:g} km at {BULLET_SPEED:g} km/s where the ship faces, unless "
        f"{MAX_BULLETS} of its bullets are flying, and waits {_TICK}.",
    ),
    "thrust": Meaning(
        "thrust;",
        f"Action: switches the thruster on, which speeds the ship up where it faces until `thrust_off`, and waits "
        f"{_TICK}.",
    ),
    "thrust_off": Meaning("thrust_off;", f"Action: switches the thruster off, and waits {_TICK}."),
    "skip": Meaning("skip;", f"Action: does nothing, and waits {_TICK}."),
    # Statements.
    "if": Meaning(
        "if (e) { } else { }", "Runs the first block if a bool is true, else the second."
    ),
    "then": Meaning(
        "if (e) then { }", "May stand behind the condition of an `if`, and means nothing."
    ),
    "else": Meaning("if (e) { } else { }", "Starts what runs if the condition is false."),
    "while": Meaning(
        "while (e) { }",
        "Runs its block again and again as long as a bool is true; a tick has fuel for "
        f"{FUEL:,} small steps, so a loop that waits needs an action.",
    ),
    "do": Meaning("while (e) do { }", "May stand before the block of a loop, and means nothing."),
    "foreach": Meaning(
        "foreach (kind, x) { }",
        "Runs its block once for each living entity of a kind, in ascending order of ids, with the entity in a "
        "declared variable; no action may stand inside.",
    ),
    "print": Meaning("print e;", "Shows a value of any type to whoever watches."),
    # Constants.
    "true": Meaning("true", "The truth value that holds."),
    "false": Meaning("false", "The truth value that does not hold."),
    "null": Meaning("null", "No entity; to read it with `getx` and its like stops the program."),
    "self": Meaning("self", "The ship that runs the program."),
    "getdir": Meaning(
        "getdir",
        "The direction of the ship that runs the program, in rad from 0 to 2 pi, counter-clockwise from the x-axis.",
    ),
    # Getters.
    "getx": Meaning("getx e", "The x-coordinate of an entity's centre, in km from the left wall."),
    "gety": Meaning(
        "gety e", "The y-coordinate of an entity's centre, in km from the bottom wall."
    ),
    "getvx": Meaning("getvx e", "The velocity of an entity along the x-axis, in km/s."),
    "getvy": Meaning("getvy e", "The velocity of an entity along the y-axis, in km/s."),
    "getradius": Meaning("getradius e", "The radius of an entity, in km."),
    # Functions.
    "sqrt": Meaning(
        "sqrt(e)", "The square root of a double, not a number (nan) if that is negative."
    ),
    "sin": Meaning(
        "sin(e)", "The sine of an angle in rad, not a number (nan) if that is infinite."
    ),
    "cos": Meaning(
        "cos(e)", "The cosine of an angle in rad, not a number (nan) if that is infinite."
    ),
    # Operators.
    "||": Meaning(
        "e || e",
        "True if one of two bools is true; the second is only asked if the first is false.",
    ),
    "&&": Meaning(
        "e && e",
        "True if both of two bools are true; the second is only asked if the first is true.",
    ),
    "==": Meaning(
        "e == e", "True if two values of one type are equal; entities are if they are the same one."
    ),
    "!=": Meaning("e != e", "True if two values of one type are not equal."),
    "<": Meaning("e < e", "True if the first of two doubles is less than the second."),
    "<=": Meaning(
        "e <= e", "True if the first of two doubles is less than the second or equal to it."
    ),
    ">": Meaning("e > e", "True if the first of two doubles is greater than the second."),
    ">=": Meaning(
        "e >= e", "True if the first of two doubles is greater than the second or equal to it."
    ),
    "+": Meaning("e + e", "The sum of two doubles."),
    "-": Meaning("e - e", "The difference of two doubles, or the negative of one."),
    "*": Meaning("e * e", "The product of two doubles."),
    "/": Meaning(
        "e / e",
        "The quotient of two doubles; by 0 it is infinite, or not a number (nan) for 0 / 0.",
    ),
    "%": Meaning(
        "e % e",
        "The remainder of two doubles, with the sign of the divisor, so that angles wrap; by 0 not a number (nan).",
    ),
    "!": Meaning("!e", "True if a bool is false."),
    # Punctuation.
    ":=": Meaning("x := e;", "Puts the value of an expression into a variable of the same type."),
    ";": Meaning("fire;", "Ends a statement."),
    ",": Meaning(
        "foreach (kind, x) { }", "Stands between the kind and the variable of a `foreach`."
    ),
    "(": Meaning("(e)", "Opens a group, which is worked out first, or the head of a `foreach`."),
    ")": Meaning("(e)", "Closes a group or the head of a `foreach`."),
    "{": Meaning("{ }", "Opens a block of statements."),
    "}": Meaning("{ }", "Closes a block of statements."),
}
"""One for each of `words.KEYWORDS` and `words.SIGNS`."""
