"""Type-correctness (assignment 1.8.3): `fasteroids.lang.checker`."""

from __future__ import annotations

import pytest

from fasteroids.lang.checker import complaints, declared
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import mended
from fasteroids.lang.parser import parse_program
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    ForEach,
    If,
    Missing,
    Name,
    Null,
    Number,
    Program,
    Unary,
)


def check(text: str) -> tuple[Diagnostic, ...]:
    """The complaints about a text without syntax errors."""
    parsed = parse_program(text)
    assert parsed.diagnostics == ()
    return complaints(parsed.tree)


def places(text: str) -> list[str]:
    return [f"{each.code} {each.span.line}:{each.span.column}" for each in check(text)]


def only(text: str) -> Diagnostic:
    (found,) = check(text)
    return found


def cut(text: str, span: Span) -> str:
    """The piece of a text of one line, or of one of its lines, that a span is."""
    return text.split("\n")[span.line - 1][span.column - 1 : span.end_column - 1]


# What is right.


@pytest.mark.parametrize(
    "text",
    [
        "",
        "x := 1; double x;",
        "if (false) { double x; } x := getdir % 2;",
        "double x; double x; print x;",
        "entity e := self; print e == null; print getx e; print getradius self;",
        "bool b := !(1 < 2) && (null == self || true != false); while b { turn -1.5; skip; }",
        "entity e; foreach (any, e) { print e; foreach (ship, e) { print getvx e + getvy e; } } fire;",
        "turn sqrt(2) * sin(1) / cos(1) - 3 % 2;",
        "print true; print null; print 3;",
        "if 1 >= 2 { thrust; } else if 1 <= 2 { thrust_off; } else { fire; }",
    ],
)
def test_accepts(text: str) -> None:
    assert places(text) == []


# What is wrong, and where.


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x := 1;", ["FA101 1:1"]),
        ("print x; print y; print x;", ["FA101 1:7", "FA101 1:16"]),
        ("double x; bool x;", ["FA102 1:16"]),
        ("double x; double x; entity x; bool x;", ["FA102 1:28"]),
        ("double d; d := true;", ["FA103 1:16"]),
        ("bool b := 2;", ["FA103 1:11"]),
        ("entity e := getx self;", ["FA103 1:13"]),
        ("double d := null;", ["FA103 1:13"]),
        ("if (1) { }", ["FA104 1:5"]),
        ("while self { skip; }", ["FA104 1:7"]),
        ("print 1 + true;", ["FA105 1:11"]),
        ("print true + true;", ["FA105 1:7"]),
        ("print -true;", ["FA105 1:8"]),
        ("print -self % 2;", ["FA105 1:8"]),
        ("print !3;", ["FA105 1:8"]),
        ("print !getx self > 3 && !self == null;", ["FA105 1:8", "FA105 1:26"]),
        ("double d; print !d < 1 || !sqrt(true) < 2;", ["FA105 1:18", "FA105 1:28", "FA105 1:33"]),
        # What `!(...)` would not mend is two faults.
        ("print !getx self > null;", ["FA105 1:7", "FA105 1:8"]),
        ("print (!getx self) > 3;", ["FA105 1:8", "FA105 1:9"]),
        ("print getx 3; print getvy true;", ["FA105 1:12", "FA105 1:27"]),
        ("print sqrt(null); print cos(true);", ["FA105 1:12", "FA105 1:29"]),
        ("print self < null;", ["FA105 1:7"]),
        ("print true <= 1;", ["FA105 1:7"]),
        ("print 1 && true || null;", ["FA105 1:7", "FA105 1:20"]),
        ("print 1 == null;", ["FA106 1:12"]),
        ("print true != 2;", ["FA106 1:15"]),
        ("turn self;", ["FA107 1:6"]),
        ("turn 1 < 2;", ["FA107 1:6"]),
        ("entity e; foreach (any, e) { skip; }", ["FA108 1:30"]),
        ("double d := 1; foreach (any, d) { }", ["FA109 1:30"]),
        ("double d; foreach (any, d) { }", ["FA110 1:1"]),
    ],
)
def test_complains_at_the_place(text: str, expected: list[str]) -> None:
    assert places(text) == expected


def test_actions_are_found_however_deep_inside_a_for_each() -> None:
    text = """entity a; entity b;
foreach (any, a) {
  if (true) { while (true) { turn 1; } } else { fire; }
  foreach (ship, b) { thrust; }
  thrust_off;
}
skip;"""
    found = check(text)
    assert [cut(text, each.span) for each in found] == [
        "turn 1;", "fire;", "thrust;", "thrust_off;",
    ]  # fmt: skip
    assert {each.notes[0].span for each in found} == {Span(2, 1, 2, 8)}


def test_everything_is_found_in_one_run() -> None:
    text = "bool b := true; b := 1; if (b + 1 > null) { turn b; } print getx (1 + true);"
    assert places(text) == [
        "FA103 1:22", "FA105 1:29", "FA105 1:37", "FA107 1:50", "FA105 1:67", "FA105 1:71",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "text",
    [
        "double d := 1 + true;",
        "if (1 && true) { }",
        "print getx null + (1 + (2 * (3 - self)));",
        "turn -(-(-true));",
        "bool b := !(!(!1));",
        "double d := sqrt(getx 3) + 1;",
    ],
)
def test_a_fault_inside_is_no_fault_of_what_is_around(text: str) -> None:
    assert len(check(text)) == 1


def test_what_could_not_be_read_is_no_type_error() -> None:
    gap = Missing()
    tree = Program(
        Block(
            (
                Declaration("double", Name("d"), gap),
                Assignment(Name("d"), Binary("+", gap, Unary("getx", gap))),
                If(gap, Block((Assignment(Name("d"), Binary("*", gap, Number(2.0))),))),
                If(Binary("==", gap, Null()), Block((Act("fire"),))),
                ForEach("any", Name(""), Block()),
            )
        )
    )
    assert complaints(tree) == ()


def test_a_tree_that_was_never_text_is_checked_too() -> None:
    tree = Program(Block((Assignment(Name("d"), Number(1.0)), If(Null(), Block()))))
    assert [each.code for each in complaints(tree)] == ["FA101", "FA104"]


# Variables.


def test_one_diagnostic_for_a_name_used_many_times() -> None:
    text = "entity e;\nx := getx e;\nprint x + 1;\nif (x < 3) { turn x; x := x + 1; }"
    found = only(text)
    assert found.message == "`x` is not declared"
    assert found.label == "set to a double here"
    assert found.hint == "Declare it: add `double x;`"
    assert [note.text for note in found.notes] == [
        "used here too", "used here too", "used here too, and 2 more uses",
    ]  # fmt: skip
    assert mended(text, [found]) == text.replace("entity e;\n", "entity e;\ndouble x;\n")


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("x := getx self;", "double"),
        ("print x == null;", "entity"),
        ("print null != x;", "entity"),
        ("print getx x;", "entity"),
        ("foreach (any, x) { }", "entity"),
        ("while x { fire; }", "bool"),
        ("print !x;", "bool"),
        ("x := 1 < 2;", "bool"),
        ("entity e; e := x;", "entity"),
        ("bool b; print x == b;", "bool"),
        ("double d; x := d;", "double"),
        ("turn x;", "double"),
    ],
)
def test_an_undeclared_name_gets_the_type_its_uses_ask_for(text: str, kind: str) -> None:
    found = only(text)
    assert found.hint == f"Declare it: add `{kind} x;`"
    assert check(mended(text, [found])) == ()


def test_undeclared_names_hand_types_on_to_each_other() -> None:
    text = "a := b; b := c; c := d; print d == null;"
    found = check(text)
    assert [each.hint for each in found] == [f"Declare it: add `entity {name};`" for name in "abcd"]
    assert mended(text, found).startswith("entity a;\nentity b;\nentity c;\nentity d;\na := b;")


def test_an_undeclared_name_used_as_of_two_types_is_one_fault() -> None:
    found = only("x := 1;\nprint x == null;\nprint x + 2;\n")
    assert found.hint == "Declare it with one type; now it is used as a double and as an entity"
    assert [note.text for note in found.notes] == ["compared with an entity here"]
    assert found.fix == ()


def test_an_undeclared_name_of_no_evident_type_gets_no_fix() -> None:
    found = only("print x;")
    assert found.hint == "Declare it with its type, such as `double x;`"
    assert found.fix == ()


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("// A hunter.\n\nx := 1;\n", "// A hunter.\n\ndouble x;\nx := 1;\n"),
        ("bool b; // Near?\n// Here we go.\nx := 1;", "bool b; // Near?\ndouble x;\n// Here we go.\nx := 1;"),
        ("bool b; x := 1;", "bool b; double x; x := 1;"),
        ("  x := 1;", "  double x;\n  x := 1;"),
        ("bool b := x;", "bool x;\nbool b := x;"),
        ("bool b;\nfire;\nbool c := x;", "bool b;\nbool x;\nfire;\nbool c := x;"),
    ],
)  # fmt: skip
def test_a_declaration_is_put_where_one_would_write_it(before: str, after: str) -> None:
    assert mended(before, check(before)) == after
    assert check(after) == ()


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("double distance := 1; print distanse;", "Did you mean `distance`?"),
        ("double distance; distence := 1; print distance;", "Did you mean `distance`?"),
        ("print True;", "Did you mean `true`?"),
        ("entity e := Null;", "Did you mean `null`?"),
        ("print getx slef;", "Did you mean `self`?"),
        ("turn getDir;", "Did you mean `getdir`?"),
    ],
)
def test_a_slip_of_the_pen_is_told(text: str, hint: str) -> None:
    found = only(text)
    assert found.hint == hint
    assert check(mended(text, [found])) == ()


@pytest.mark.parametrize(
    "text",
    [
        "bool distance; turn distanse;",  # of another type
        "double minx := 1; miny := 2; print minx + miny;",  # set and read: a variable of its own
        "true1 := true; while true1 { fire; }",
    ],
)
def test_no_slip_is_seen_where_another_variable_is_meant(text: str) -> None:
    hint = only(text).hint
    assert hint is not None
    assert hint.startswith("Declare it: add")


def test_a_slip_for_a_name_that_is_not_declared_either_is_seen() -> None:
    text = "nearest := self;\nif (nearest == null) { fire; }\nprint getx nearset;"
    assert [each.hint for each in check(text)] == [
        "Declare it: add `entity nearest;`",
        "Did you mean `nearest`?",
    ]
    assert check(mended(text, check(text))) == ()


def test_a_slip_shows_what_was_meant() -> None:
    found = only("double distance := 1;\nturn distanse;")
    assert [(note.text, note.span.start) for note in found.notes] == [
        ("`distance` is declared here", (1, 8))
    ]


def test_a_variable_declared_wrongly_is_one_fault() -> None:
    text = "double n; entity a;\nn := null;\nif (n == null) { n := a; }\nprint n;"
    found = only(text)
    assert (found.code, found.hint) == ("FA110", "Declare it `entity n;`")
    assert cut(text, found.span) == "double"
    assert [(note.text, note.span.start) for note in found.notes] == [
        ("set to an entity here", (2, 1)),
        ("compared with an entity here", (3, 5)),
        ("set to an entity here", (3, 18)),
    ]
    assert mended(text, [found]) == text.replace("double n", "entity n")


def test_two_variables_declared_wrongly_are_two_faults() -> None:
    text = "double m; double n; m := null; print m == self; n := null; print n == m; print getx n;"
    assert places(text) == ["FA110 1:1", "FA110 1:11"]
    assert check(mended(text, check(text))) == ()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("double d; d := null;", ["FA103 1:16"]),  # one use is no proof
        ("double d; d := null; print d == null; d := 1;", ["FA103 1:16", "FA106 1:33"]),
        ("double d; double e; d := null; print d == null; e := d;", ["FA103 1:16", "FA106 1:33"]),
        ("double d; entity e; d := e; e := d;", ["FA103 1:26", "FA103 1:34"]),
    ],
)
def test_a_variable_used_both_ways_keeps_its_type(text: str, expected: list[str]) -> None:
    assert [place.split(":")[0] for place in places(text)] == [e.split(":")[0] for e in expected]


def test_nothing_is_said_of_uses_of_a_variable_of_two_types() -> None:
    found = only("double t; entity t; t := 1; t := null; turn t; print getx t;")
    assert found.notes[0].text == "declared double here"
    assert found.label == "declared entity here"


def test_declared_types_come_in_the_order_of_first_declaration() -> None:
    tree = parse_program("while true { entity e; } double d; bool e; double c;").tree
    assert list(declared(tree).items()) == [("e", "bool"), ("d", "double"), ("c", "double")]


# Words.


@pytest.mark.parametrize(
    ("text", "notes"),
    [
        ("double d;\nbool b := d;", ["declared bool here", "`d` is declared double here"]),
        ("bool b;\nb := 2;", ["declared bool here"]),
        ("bool b := true;\nturn b;", ["`b` is declared bool here"]),
        ("bool b := true;\nprint b == 3;", ["a bool", "`b` is declared bool here"]),
        ("print true * null;", ["an entity"]),
        ("print true * false;", ["a bool too"]),
    ],
)
def test_both_places_are_shown_where_two_disagree(text: str, notes: list[str]) -> None:
    assert [note.text for note in only(text).notes] == notes


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("bool b := 0;", "Write `false`"),
        ("while 1 { fire; }", "Write `true`"),
        ("double d := 1; if d { }", "Compare it with a number, as in `d != 0`"),
        ("entity e; if e { }", "Ask whether there is one: `e != null`"),
        ("print self + 1;", "Take a number of the entity, as in `getx self` or `getradius self`"),
        ("entity e := getx self;", "`getx` has made it a double: leave it out if the entity is meant"),
        ("entity e; print e == 0;", "No entity is `null`"),
        ("print getx self == null;", "Only an entity can be `null`"),
        ("double d := 1; print 0 < d < 10;", "Comparisons do not chain: write `0 < d && d < 10`"),
        ("double d := 1; print d == d == 2;", "Comparisons do not chain: write `d == d && d == 2`"),
        ("print -true;", "Not is written `!`"),
        ("print !getx self > 3;", "`!` binds more strongly than `>`: write `!(getx self > 3)`"),
        ("print !self == null;", "`!` binds more strongly than `==`: write `!(self == null)`"),
        ("entity e; print e < self;", "Compare a number of the entity, as in `getx e`"),
        ("bool b; b := getx self;", "Compare it with a number, as in `getx self != 0`"),
        ("double d; d := true;", "Give it a double, or declare it `bool d;`"),
    ],
)  # fmt: skip
def test_hints(text: str, hint: str) -> None:
    assert hint in {each.hint for each in check(text)}


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("bool b := 0;", "bool b := false;"),
        ("while 1 { fire; }", "while true { fire; }"),
        ("entity e; print e == 0;", "entity e; print e == null;"),
        ("print -true;", "print !true;"),
        (
            "print !getx self > sqrt(4) && !self\n!= (null);",
            "print !(getx self > sqrt(4)) && !(self\n!= (null));",
        ),
    ],
)
def test_safe_fixes_are_offered(before: str, after: str) -> None:
    assert mended(before, check(before)) == after
    assert check(after) == ()


def test_types_go_along_any_number_of_undeclared_names() -> None:
    """In a chain, and all names alike: whatever were quadratic here would take minutes."""
    count = 20_000
    text = "".join(f"name{i}x := name{i + 1}x;\n" for i in range(count)) + f"turn name{count}x;"
    tree = parse_program(text).tree
    found = complaints(tree)
    assert len(found) == count + 1
    assert {each.hint.split("`")[1].split()[0] for each in found if each.hint} == {"double"}
    assert len(mended(text, found)) > len(text)


def test_a_name_of_great_length_is_cut_in_messages() -> None:
    found = only(f"turn {'a' * 100_000};")
    assert len(found.message) < 100
    assert found.hint is not None
    assert len(found.hint) < 100
