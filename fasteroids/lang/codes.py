"""What each code of a diagnostic means: the one table behind `fasteroids explain FA012` and the docs."""

from __future__ import annotations

from typing import Final, Literal

from attrs import frozen

__all__ = ["CODES", "Code", "Phase"]

Phase = Literal["syntax", "type", "lint"]


@frozen
class Code:
    """A kind of fault: its phase, a title of a few words, why it is one, and a program with it and without."""

    phase: Phase
    title: str
    why: str
    wrong: str
    right: str


SYNTAX: Final[dict[str, Code]] = {}
"""FA001 to FA099, by the lexer and the parser."""

TYPE: Final[dict[str, Code]] = {
    "FA101": Code(
        "type",
        "A variable that is not declared",
        "Each variable that a program mentions must be declared, with its type. It does not matter where: all "
        "variables are global. If the name is close to one that is declared, it is most likely misspelt.",
        "distance := getradius self;\nprint distance;\n",
        "double distance;\ndistance := getradius self;\nprint distance;\n",
    ),
    "FA102": Code(
        "type",
        "One name declared with two types",
        "All variables are global, also those declared inside braces, so two declarations of one name mean one "
        "variable. It can have one type only. (To declare it twice with the same type does no harm.)",
        "double target;\nif (getx self > 0) {\n  entity target := self;\n}\n",
        "double aim;\nif (getx self > 0) {\n  entity target := self;\n}\n",
    ),
    "FA103": Code(
        "type",
        "A value of another type than the variable",
        "A variable keeps its type. What is assigned to it, or given with its declaration, must be of that type; "
        "nothing is converted.",
        "bool near;\nnear := getx self;\n",
        "bool near;\nnear := getx self < 100;\n",
    ),
    "FA104": Code(
        "type",
        "A condition that is no bool",
        "`if` and `while` ask a question that is answered by true or false. A number or an entity is no answer: "
        "compare it with something.",
        "if (getvx self) {\n  thrust;\n}\n",
        "if (getvx self != 0) {\n  thrust;\n}\n",
    ),
    "FA105": Code(
        "type",
        "An operator on something of the wrong type",
        "`+ - * / %`, `< <= > >=`, sqrt, sin and cos take doubles; `&& || !` take bools; getx, gety, getvx, getvy "
        "and getradius take an entity.",
        "turn getx 3;\n",
        "turn getx self;\n",
    ),
    "FA106": Code(
        "type",
        "Two types compared for equality",
        "`==` and `!=` compare two doubles, two bools or two entities; null and self are entities. Values of "
        "different types are never equal, so the question is a slip.",
        "if (getx self == null) {\n  fire;\n}\n",
        "if (self != null) {\n  fire;\n}\n",
    ),
    "FA107": Code(
        "type",
        "A turn by something that is no double",
        "`turn` adds an angle in radians to the direction of the ship. An angle is a double.",
        "turn true;\n",
        "turn 0.5;\n",
    ),
    "FA108": Code(
        "type",
        "An action inside a for-each",
        "An action ends the run of the program until the next tick, 0.2 s later. By then the entities that the loop "
        "goes through may be gone, so no action, not even skip, may stand anywhere inside a for-each. Remember what "
        "you found in a variable and act behind the loop.",
        "entity a;\nforeach (asteroid, a) {\n  if (getx a > getx self) {\n    fire;\n  }\n}\n",
        "entity a;\nbool found;\nfound := false;\nforeach (asteroid, a) {\n  if (getx a > getx self) {\n"
        "    found := true;\n  }\n}\nif (found) {\n  fire;\n}\n",
    ),
    "FA109": Code(
        "type",
        "A for-each over a variable that is no entity",
        "A for-each sets its variable to each ship, asteroid, bullet or any of them in turn. So the variable must be "
        "declared, and as an entity.",
        "double a;\na := 1;\nforeach (asteroid, a) {\n  print a;\n}\n",
        "entity a;\nforeach (asteroid, a) {\n  print a;\n}\n",
    ),
    "FA110": Code(
        "type",
        "A variable declared with one type, used as another",
        "Everything that the program does with this variable asks for one type, and the declaration says another. So "
        "the declaration is the slip, and it is reported once, instead of each use.",
        "double nearest;\nnearest := null;\nif (nearest == null) {\n  skip;\n}\n",
        "entity nearest;\nnearest := null;\nif (nearest == null) {\n  skip;\n}\n",
    ),
}
"""FA101 to FA199, by the checker."""

CODES: Final[dict[str, Code]] = {**SYNTAX, **TYPE}
"""All of them; FA201 to FA299 are for the lint."""
