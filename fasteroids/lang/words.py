"""The words and signs of the language: the one table the lexer, the parser, the printer and editors' tools read.

The operators and their strengths are conventional (`||`, `&&`, comparisons, `+ -`, `* / %`, then the unary ones,
which bind tightest); all binary ones group to the left.
"""

from __future__ import annotations

from typing import Final

__all__ = [
    "ACTIONS",
    "BINARY",
    "CALLS",
    "CONSTANTS",
    "GETTERS",
    "KEYWORDS",
    "KINDS",
    "PUNCTUATION",
    "SIGNS",
    "STATEMENTS",
    "TYPES",
    "UNARY",
]

TYPES: Final = ("bool", "double", "entity")
"""Types of variables and values (assignment 1.8.3)."""

KINDS: Final = ("ship", "asteroid", "bullet", "any")
"""What a for-each ranges over (1.8.1)."""

ACTIONS: Final = ("turn", "fire", "thrust", "thrust_off", "skip")
"""Statements that end a run of the program (1.8.1). Only `turn` takes an expression."""

STATEMENTS: Final = ("if", "then", "else", "while", "do", "foreach", "print")
"""The other words that statements are made of. `then` and `do` mean nothing."""

CONSTANTS: Final = ("true", "false", "null", "self", "getdir")
"""Expressions of one word. `getdir` is the direction of the ship that runs the program, rad."""

GETTERS: Final = ("getx", "gety", "getvx", "getvy", "getradius")
"""Unary operators from an entity to a number: km, km/s."""

CALLS: Final = ("sqrt", "sin", "cos")
"""Functions of one number; they demand parentheses."""

KEYWORDS: Final = frozenset({*TYPES, *KINDS, *ACTIONS, *STATEMENTS, *CONSTANTS, *GETTERS, *CALLS})
"""No variable may have one of these names. Case matters."""

BINARY: Final = {
    "||": 1,
    "&&": 2,
    "==": 3, "!=": 3, "<": 3, "<=": 3, ">": 3, ">=": 3,
    "+": 4, "-": 4,
    "*": 5, "/": 5, "%": 5,
}  # fmt: skip
"""Binary operators and how strongly they bind."""

UNARY: Final = ("-", "!", *GETTERS)
"""Prefix operators; all bind tighter than any binary one."""

PUNCTUATION: Final = (":=", ";", ",", "(", ")", "{", "}")
"""Signs that are no operators."""

SIGNS: Final = (*PUNCTUATION, *BINARY, "!")
"""Every sign."""
