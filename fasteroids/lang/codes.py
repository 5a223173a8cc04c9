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


def _syntax(title: str, *, why: str, wrong: str, right: str) -> Code:
    return Code("syntax", title, why, wrong, right)


SYNTAX: Final[dict[str, Code]] = {
    "FA001": _syntax(
        "A character that is no part of the language",
        why=(
            "Programs are made of names, numbers, the signs of the language, blanks, tabs, line "
            "ends and `//` comments. Anything else is refused, so that no slip is passed over "
            "in silence."
        ),
        wrong="turn 1 @;",
        right="turn 1;",
    ),
    "FA002": _syntax(
        "Bytes that are not UTF-8",
        why=(
            "A program is a text in UTF-8. Where its bytes are something else, nobody knows "
            "which characters were meant. Most editors can save a text as UTF-8."
        ),
        wrong="turn 1; \ufffd",
        right="turn 1;",
    ),
    "FA003": _syntax(
        "A number in another notation",
        why=(
            "A number is digits, or digits, a point and digits: no point at either end, no "
            "decimal comma, no exponent, no letters."
        ),
        wrong="turn .5;",
        right="turn 0.5;",
    ),
    "FA004": _syntax(
        "A comment in another notation",
        why="A comment starts with `//` and ends with its line.",
        wrong="/* away */ fire;",
        right="// away\nfire;",
    ),
    "FA005": _syntax(
        "Text in quotes",
        why="Values are numbers, truth values and entities; there is no text among them.",
        wrong='print "hit";',
        right="print 1; // hit",
    ),
    "FA006": _syntax(
        "A malformed name",
        why="A name is a letter (a to z, A to Z), then such letters, digits and underscores.",
        wrong="double _d;",
        right="double d;",
    ),
    "FA007": _syntax(
        "Markup of a web page",
        why=(
            "Tags and entities such as `</pre>` and `&lt;` come along when a program is copied "
            "from the source of a page."
        ),
        wrong="fire;</pre>",
        right="fire;",
    ),
    "FA008": _syntax(
        "A number too large",
        why="A number is a double: at most about 1.8 * 10^308.",
        wrong="turn 1" + "0" * 309 + ";",
        right="turn 10;",
    ),
    "FA009": _syntax(
        "An operator in another spelling",
        why=(
            "The operators are `+ - * / %`, `== != < <= > >=`, `&& || !` and `getx` and its like."
        ),
        wrong="bool b; b := b and b;",
        right="bool b; b := b && b;",
    ),
    "FA010": _syntax(
        "A missing semicolon",
        why=(
            "Declarations, assignments, `print` and actions end in `;`, also before `}` and at "
            "the end of the text. Only `skip` may go without."
        ),
        wrong="turn 1\nfire;",
        right="turn 1;\nfire;",
    ),
    "FA011": _syntax(
        "`=` for `:=` or `==`",
        why="An assignment is written `:=`, a comparison `==`. A lone `=` is neither.",
        wrong="double d; d = 1;",
        right="double d; d := 1;",
    ),
    "FA012": _syntax(
        "A missing `)`",
        why="Each `(` is closed by its `)` in the same expression.",
        wrong="turn (1 + 2;",
        right="turn (1 + 2);",
    ),
    "FA013": _syntax(
        "A missing `(`",
        why="`sqrt`, `sin`, `cos` and the head of a `foreach` demand parentheses.",
        wrong="turn sqrt 2;",
        right="turn sqrt(2);",
    ),
    "FA014": _syntax(
        "A missing `}`",
        why=(
            "Each block is closed by its own `}`. Which one is missing is guessed from the "
            "indentation of the lines."
        ),
        wrong="while (true) {\n  if (true) {\n    fire;\n}",
        right="while (true) {\n  if (true) {\n    fire;\n  }\n}",
    ),
    "FA015": _syntax(
        "A missing `{`",
        why=(
            "The body of an `if`, `else`, `while` or `foreach` stands between braces, even if "
            "it is one statement."
        ),
        wrong="if (true) fire;",
        right="if (true) { fire; }",
    ),
    "FA016": _syntax(
        "A `}` that closes nothing",
        why="There are more closing braces than opening ones.",
        wrong="fire; }",
        right="fire;",
    ),
    "FA017": _syntax(
        "A `)` that closes nothing",
        why="There are more closing parentheses than opening ones.",
        wrong="turn 1);",
        right="turn 1;",
    ),
    "FA018": _syntax(
        "A missing expression",
        why=(
            "Something needs a value and has none: `turn` an angle, `print` a value, an "
            "operator both its sides."
        ),
        wrong="turn;",
        right="turn 0.2;",
    ),
    "FA019": _syntax(
        "A missing operator",
        why="Two expressions stand side by side. Multiplication is always written `*`.",
        wrong="turn 2 (1 + 1);",
        right="turn 2 * (1 + 1);",
    ),
    "FA020": _syntax(
        "Something unexpected",
        why="What stands here can neither go on with what came before nor start a statement.",
        wrong="1 + 1;",
        right="print 1 + 1;",
    ),
    "FA021": _syntax(
        "A misspelt word",
        why="The word is none of the language, but close to one that fits here. Case matters.",
        wrong="trun 1;",
        right="turn 1;",
    ),
    "FA022": _syntax(
        "A word of another language",
        why=(
            "The types are `bool`, `double` and `entity`. The statements are declarations, "
            "assignments, `if`, `while`, `foreach`, `print`, and the actions `turn`, `fire`, "
            "`thrust`, `thrust_off` and `skip`."
        ),
        wrong="int i;",
        right="double i;",
    ),
    "FA023": _syntax(
        "No name where a variable is expected",
        why="A variable has a name, and it is none of the words of the language.",
        wrong="double turn;",
        right="double angle;",
    ),
    "FA024": _syntax(
        "A malformed `foreach`",
        why=(
            "`foreach (kind, variable)` runs its body once for each entity of the kind `ship`, "
            "`asteroid`, `bullet` or `any`, with the entity in a variable that is declared "
            "elsewhere."
        ),
        wrong="entity a; foreach (a in asteroids) { }",
        right="entity a; foreach (asteroid, a) { }",
    ),
    "FA025": _syntax(
        "Several variables in one declaration",
        why="A declaration declares one variable.",
        wrong="double a, b;",
        right="double a; double b;",
    ),
    "FA026": _syntax(
        "A word that takes nothing is given something",
        why=(
            "Of the actions only `turn` takes an expression. `getdir` takes no entity: a ship knows "
            "only its own direction."
        ),
        wrong="fire();",
        right="fire;",
    ),
    "FA027": _syntax(
        "Several values where one is expected",
        why="`print` shows one value, and `sqrt`, `getx` and their like take one.",
        wrong="print 1, 2, 3;",
        right="print 1; print 2; print 3;",
    ),
    "FA028": _syntax(
        "A shorthand for an assignment",
        why="An assignment is `x := e;` and nothing else.",
        wrong="double d; d += 1;",
        right="double d; d := d + 1;",
    ),
    "FA029": _syntax(
        "Too deep a nesting",
        why=(
            "A program has at most 100 parts inside each other, counting blocks, statements and "
            "expressions, and at most 100 open parentheses. A sum of many terms is nested too: "
            "each `+` holds all that stands on its left. So is a chain of `else if`: each stands in the "
            "`else` before it."
        ),
        wrong="turn 1" + " + 1" * 100 + ";",
        right="turn 1 + 1;",
    ),
    "FA030": _syntax(
        "A function the language has not",
        why=(
            "The functions are `sqrt`, `sin` and `cos`, and those of entities `getx`, `gety`, "
            "`getvx`, `getvy` and `getradius`. Some others are a line: the absolute value of x is "
            "`sqrt(x * x)`, its tangent `sin(x) / cos(x)`, and x rounded down `x - x % 1`. An angle is "
            "found by halving: with x in front and y to the left, it is between 0 and pi if y is "
            "above 0, and else between -pi and 0; try the middle, a, and it is larger where "
            "`cos(a) * y - sin(a) * x` is above 0, else smaller. The shipped program `turret` does so."
        ),
        wrong="turn abs(1);",
        right="turn sqrt(1 * 1);",
    ),
    "FA031": _syntax(
        "A field of an entity",
        why=(
            "Entities are read with `getx e`, `gety e`, `getvx e`, `getvy e` and `getradius e`, "
            "and cannot be written."
        ),
        wrong="print self.x;",
        right="print getx self;",
    ),
    "FA032": _syntax(
        "`else` and `if` that do not belong together",
        why=(
            "An `else` stands right behind the closing brace of its `if`. It has no condition "
            "of its own; `else if` has."
        ),
        wrong="if (true) { fire; }; else { skip; }",
        right="if (true) { fire; } else { skip; }",
    ),
    "FA033": _syntax(
        "A block on its own",
        why=(
            "A block is the body of an `if`, `else`, `while` or `foreach`. All variables are "
            "global, so a block on its own would mean nothing."
        ),
        wrong="{ fire; }",
        right="fire;",
    ),
    "FA034": _syntax(
        "An assignment inside an expression",
        why="An assignment is a statement and has no value.",
        wrong="double a; double b; a := b := 1;",
        right="double a; double b; b := 1; a := b;",
    ),
    "FA035": _syntax(
        "A plus sign before an expression",
        why="There is a minus sign before an expression, but no plus sign.",
        wrong="turn +1;",
        right="turn 1;",
    ),
}
"""FA001 to FA099, by the lexer and the parser."""

TYPE: Final[dict[str, Code]] = {
    "FA101": Code(
        "type",
        "A variable that is not declared",
        "Each variable that a program mentions must be declared, with its type. It does not matter where: all "
        "variables are global. If the name is close to one that is declared, it is most likely misspelt.",
        "distance := getradius self;\nprint distance;",
        "double distance;\ndistance := getradius self;\nprint distance;",
    ),
    "FA102": Code(
        "type",
        "One name declared with two types",
        "All variables are global, also those declared inside braces, so two declarations of one name mean one "
        "variable. It can have one type only. (To declare it twice with the same type does no harm.)",
        "double target;\nif (getx self > 0) {\n  entity target := self;\n}",
        "double aim;\nif (getx self > 0) {\n  entity target := self;\n}",
    ),
    "FA103": Code(
        "type",
        "A value of another type than the variable",
        "A variable keeps its type. What is assigned to it, or given with its declaration, must be of that type; "
        "nothing is converted.",
        "bool near;\nnear := getx self;",
        "bool near;\nnear := getx self < 100;",
    ),
    "FA104": Code(
        "type",
        "A condition that is no bool",
        "`if` and `while` ask a question that is answered by true or false. A number or an entity is no answer: "
        "compare it with something.",
        "if (getvx self) {\n  thrust;\n}",
        "if (getvx self > 0) {\n  thrust;\n}",
    ),
    "FA105": Code(
        "type",
        "An operator on something of the wrong type",
        "`+ - * / %`, `< <= > >=`, sqrt, sin and cos take doubles; `&& || !` take bools; getx, gety, getvx, getvy "
        "and getradius take an entity.",
        "turn getx 3;",
        "turn getx self;",
    ),
    "FA106": Code(
        "type",
        "Two types compared for equality",
        "`==` and `!=` compare two doubles, two bools or two entities; null and self are entities. Values of "
        "different types are never equal, so the question is a slip.",
        "if (getx self == null) {\n  fire;\n}",
        "if (self != null) {\n  fire;\n}",
    ),
    "FA107": Code(
        "type",
        "A turn by something that is no double",
        "`turn` adds an angle in radians to the direction of the ship. An angle is a double.",
        "turn true;",
        "turn 0.5;",
    ),
    "FA108": Code(
        "type",
        "An action inside a for-each",
        "An action ends the run of the program until the next tick, 0.2 s later. By then the entities that the loop "
        "goes through may be gone, so no action, not even skip, may stand anywhere inside a for-each. Remember what "
        "you found in a variable and act behind the loop.",
        "entity a;\nforeach (asteroid, a) {\n  if (getx a > getx self) {\n    fire;\n  }\n}",
        "entity a;\nbool found;\nfound := false;\nforeach (asteroid, a) {\n  if (getx a > getx self) {\n"
        "    found := true;\n  }\n}\nif (found) {\n  fire;\n}",
    ),
    "FA109": Code(
        "type",
        "A for-each over a variable that is no entity",
        "A for-each sets its variable to each ship, asteroid, bullet or any of them in turn. So the variable must be "
        "declared, and as an entity.",
        "double a;\na := 1;\nforeach (asteroid, a) {\n  print a;\n}",
        "entity a;\nforeach (asteroid, a) {\n  print a;\n}",
    ),
    "FA110": Code(
        "type",
        "A variable declared with one type, used as another",
        "Everything that the program does with this variable asks for one type, and the declaration says another. So "
        "the declaration is the slip, and it is reported once, instead of each use.",
        "double nearest;\nnearest := null;\nif (nearest == null) {\n  skip;\n}",
        "entity nearest;\nnearest := null;\nif (nearest == null) {\n  skip;\n}",
    ),
}
"""FA101 to FA199, by the checker."""

LINT: Final[dict[str, Code]] = {
    "FA201": Code(
        "lint",
        "A statement that is never reached",
        "There is no way out of a loop but its condition. Behind a loop whose condition is always true nothing is ever "
        "done.",
        "while (true) {\n  fire;\n}\nthrust;",
        "thrust;\nwhile (true) {\n  fire;\n}",
    ),
    "FA202": Code(
        "lint",
        "A block that never runs",
        "The condition comes to the same whenever it is asked, so one of the ways that the program could go is never "
        "taken.",
        "if (1 > 2) {\n  fire;\n}",
        "if (getx self > 2) {\n  fire;\n}",
    ),
    "FA203": Code(
        "lint",
        "A loop that burns its fuel",
        "A program runs until it takes an action, and has fuel for so many small steps a tick. A loop that takes no "
        "action, and changes no variable that its condition asks, goes round until the fuel is gone, tick after tick: "
        "the ship does nothing meanwhile. To wait for something, `skip` in the loop.",
        "while (getx self < 100) {\n}\nfire;",
        "while (getx self < 100) {\n  skip;\n}\nfire;",
    ),
    "FA204": Code(
        "lint",
        "A variable that is never read",
        "What is assigned to this variable is never used: it may be left from an earlier version, or another name is "
        "read by mistake. To work out its own next value, as in `n := n + 1`, is no use of it.",
        "double best;\nbest := getx self;\nfire;",
        "double best;\nbest := getx self;\nturn best;",
    ),
    "FA205": Code(
        "lint",
        "A variable that is never set",
        "Nothing is ever assigned to this variable, so it keeps what all variables start with: 0, false or null. "
        "The assignment may be forgotten, or sets another name by mistake.",
        "double angle;\nturn angle;",
        "double angle;\nangle := 0.5;\nturn angle;",
    ),
    "FA206": Code(
        "lint",
        "A variable that is not used",
        "It is declared, and not mentioned anywhere else.",
        "double best;\nfire;",
        "fire;",
    ),
    "FA207": Code(
        "lint",
        "Doubles compared for equality",
        "Doubles that are worked out in two ways, or measured, seldom agree to the last of their 53 bits: 0.1 + 0.2 is "
        "not 0.3. Ask which is greater, or whether they are close. Variables that only count, in whole numbers, are "
        "exact; about them there is no warning.",
        "if (getx self == 100) {\n  fire;\n}",
        "if (getx self > 99 && getx self < 101) {\n  fire;\n}",
    ),
    "FA208": Code(
        "lint",
        "An entity that may be null where it is read",
        "To read `null` stops the program. On some way to this place the variable was not given an entity, or not for "
        "certain: a for-each may find nobody. A test such as `x != null` makes sure, and so do `self` and the variable "
        "of a for-each inside of it. A bool that is set along with the variable may be asked too.",
        "entity a;\nforeach (asteroid, a) {\n}\nturn getx a;",
        "entity a;\nforeach (asteroid, a) {\n}\nif (a != null) {\n  turn getx a;\n}",
    ),
    "FA211": Code(
        "lint",
        "An expression that the parser of 2013 grouped otherwise",
        "To the parser of the course all operators were alike, and grouped to the right: `10 - 3 - 2` was 9. `getx` "
        "and its like, and `!`, took all that was on their right: `getx a + 1` was `getx (a + 1)`. Parentheses make "
        "both agree. (`fasteroids check --course` only.)",
        "turn 10 - 3 - 2;",
        "turn (10 - 3) - 2;",
    ),
    "FA212": Code(
        "lint",
        "Something that the parser of 2013 refused",
        "The parser of the course knew no `%`, no `else if` without braces, and no minus sign before anything but a "
        "number. And a `-` right before a number was always its sign, so `a -1` was an error. (`fasteroids check "
        "--course` only.)",
        "turn getdir -1;",
        "turn getdir - 1;",
    ),
}
"""FA201 to FA299, by the lint. Warnings: such a program runs."""

CODES: Final[dict[str, Code]] = {**SYNTAX, **TYPE, **LINT}
"""All of them."""
