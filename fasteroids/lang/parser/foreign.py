"""What people bring along from other languages, and what it is here.

Some of it is grammatical (a variable may be called `this`), so the checker reads these tables too.
"""

from __future__ import annotations

from typing import Final

__all__ = [
    "CONSTANTS",
    "ELSE_IFS",
    "FUNCTIONS",
    "INFIX",
    "KINDS",
    "MEMBERS",
    "MODIFIERS",
    "PREFIX",
    "SHORTHANDS",
    "SIGNS",
    "STATEMENTS",
    "SYNONYMS",
    "TYPES",
]

CONSTANTS: Final = {
    "True": "true", "TRUE": "true", "yes": "true",
    "False": "false", "FALSE": "false", "no": "false",
    "None": "null", "NULL": "null", "Null": "null", "nil": "null", "nothing": "null",
    "this": "self", "me": "self", "Self": "self",
}  # fmt: skip
"""Names of constants. They are ordinary names here, so only where one is not declared is it a fault."""

INFIX: Final = {
    "and": "&&", "AND": "&&", "or": "||", "OR": "||", "mod": "%", "MOD": "%",
    "is": "==", "equals": "==", "eq": "==", "ne": "!=", "lt": "<", "gt": ">", "le": "<=", "ge": ">=",
    "plus": "+", "minus": "-", "times": "*", "div": "/",
}  # fmt: skip
"""Words between two expressions."""

PREFIX: Final = {"not": "!", "NOT": "!", "minus": "-"}
"""Words before an expression."""

SIGNS: Final = {
    "&": "&&", "|": "||", "===": "==", "!==": "!=", "<>": "!=", "=<": "<=", "=>": ">=", "=:": ":=",
    "~=": "!=", "^=": "!=",
    "≠": "!=", "≤": "<=", "≥": ">=", "×": "*", "·": "*", "÷": "/", "−": "-", "–": "-", "—": "-",
    "∧": "&&", "∨": "||", "¬": "!", "←": ":=", "≔": ":=", "；": ";", "，": ",", "（": "(", "）": ")",
    "&lt;": "<", "&gt;": ">", "&amp;&amp;": "&&", "&amp;": "&&", "&lt;=": "<=", "&gt;=": ">=",
}  # fmt: skip
"""Signs that mean one thing wherever they stand (the last row: a web page's source)."""

SHORTHANDS: Final = {"+=": "+", "-=": "-", "*=": "*", "/=": "/", "%=": "%"}
"""Assignments that repeat their target."""

TYPES: Final = {
    "int": "double", "integer": "double", "float": "double", "number": "double", "real": "double",
    "long": "double", "short": "double", "num": "double", "Double": "double",
    "boolean": "bool", "Boolean": "bool", "Bool": "bool", "logical": "bool",
    "Entity": "entity", "object": "entity", "Object": "entity", "Ship": "entity",
    "Asteroid": "entity", "Bullet": "entity", "ship": "entity", "asteroid": "entity",
    "bullet": "entity", "any": "entity",
    "var": None, "let": None, "const": None, "auto": None, "val": None, "dim": None, "local": None,
    "global": None, "string": None, "String": None, "char": None, "list": None, "array": None,
}  # fmt: skip
"""Types, and words that open a declaration; None where none of ours stands for it."""

MODIFIERS: Final = frozenset(
    {
        "auto", "const", "dim", "final", "global", "let", "local", "mut", "private", "public", "readonly",
        "static", "val", "var",
    }
)  # fmt: skip
"""Words before the type of a declaration, all without need here."""

KINDS: Final = {
    "ships": "ship", "asteroids": "asteroid", "bullets": "bullet", "all": "any", "everything": "any",
    "entities": "any", "entity": "any", "rock": "asteroid", "rocks": "asteroid",
}  # fmt: skip
"""What a for-each could range over."""

MEMBERS: Final = {
    "x": "getx", "y": "gety", "vx": "getvx", "vy": "getvy", "radius": "getradius", "r": "getradius",
    "getX": "getx", "getY": "gety", "getx": "getx", "gety": "gety", "getvx": "getvx", "getvy": "getvy",
    "getradius": "getradius", "getRadius": "getradius",
}  # fmt: skip
"""Fields and methods, as in `a.x`."""

ELSE_IFS: Final = frozenset({"elseif", "elif", "elsif", "elsIf", "elseIf", "ElseIf"})
"""One word for `else if`."""

STATEMENTS: Final = {
    "for": "Write `while (…) { … }`, or `foreach (asteroid, a) { … }` to visit entities",
    "return": "A program ends after its last statement; put what should not run into an `else`",
    "break": "Let the condition of the loop become false",
    "continue": "Put the rest of the loop's body into an `if`",
    "function": "Write the statements where they are needed",
    "def": "Write the statements where they are needed",
    "void": "Write the statements where they are needed",
    "class": "A program is only declarations and statements",
    "import": "A program is one text",
    "include": "A program is one text",
    "switch": "Write `if (…) { … } else if (…) { … }`",
    "case": "Write `if (…) { … } else if (…) { … }`",
    "repeat": "Write `while (…) { … }`",
    "until": "Write `while (!(…)) { … }`",
    "loop": "Write `while (true) { … }`",
    "forever": "Write `while (true) { … }`",
    "unless": "Write `if (!(…)) { … }`",
    "try": "A program that fails is stopped; test for `null` before you read an entity",
    "begin": "Blocks stand between `{` and `}`",
    "end": "Blocks stand between `{` and `}`",
    "endif": "Blocks stand between `{` and `}`",
    "wait": "`skip;` does nothing for one run of the program (0.2 s)",
    "sleep": "`skip;` does nothing for one run of the program (0.2 s)",
}  # fmt: skip
"""Words that open a statement elsewhere, each with the way to say it here."""

SYNONYMS: Final = {
    "shoot": "fire", "rotate": "turn", "println": "print", "echo": "print", "write": "print",
    "log": "print", "pass": "skip", "nop": "skip", "forall": "foreach",
    "thrust_on": "thrust", "thruston": "thrust", "thrustOn": "thrust",
}  # fmt: skip
"""Words that open a statement elsewhere, or might here, and have one of ours."""


_ANGLE: Final = "There is no inverse of `sin` and `cos`: an angle is found by halving; see `fasteroids explain FA030`"
_LENGTH: Final = "A length is `sqrt(x * x + y * y)`"
_LARGER: Final = "Take one, and in an `if` the other: `if (b > a) { a := b; }`"
_DICE: Final = (
    "There are no dice; `seed := seed * 16807 % 2147483647;` makes whole numbers that look random"
)

FUNCTIONS: Final[dict[str, str | None]] = {
    "abs": "The absolute value of `x` is `sqrt(x * x)`",
    "fabs": "The absolute value of `x` is `sqrt(x * x)`",
    "acos": _ANGLE, "asin": _ANGLE, "atan": _ANGLE, "atan2": _ANGLE,
    "tan": "The tangent of `x` is `sin(x) / cos(x)`",
    "distance": _LENGTH, "hypot": _LENGTH,
    "max": _LARGER, "min": "Take one, and in an `if` the other: `if (b < a) { a := b; }`",
    "floor": "`x` rounded down is `x - x % 1`",
    "ceil": "`x` rounded up is `x + -x % 1`",
    "round": "`x` rounded down is `x - x % 1`; add 0.5 first for the nearest",
    "mod": "The remainder is `x % y`",
    "pow": "There is no power: multiply, as in `x * x`",
    "sqr": "The square of `x` is `x * x`",
    "rand": _DICE, "random": _DICE,
    "exp": None, "log": None, "sign": None,
}  # fmt: skip
"""Functions that are not misspelt but missing, each with the way to do without where that is short."""
