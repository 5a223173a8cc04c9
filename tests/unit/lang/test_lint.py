"""Warnings about programs without errors: `fasteroids.lang.lint`."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from fasteroids.lang import Halted, Machine, Running, check_program, diagnose, parse_program, step
from fasteroids.lang.codes import LINT
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import mended
from fasteroids.lang.lint import warnings
from fasteroids.lang.report import rendered
from fasteroids.lang.syntax import Program
from fasteroids.testing import program_texts, programs
from tests.unit.lang.running import view


def found(text: str, *, course: bool = False) -> tuple[Diagnostic, ...]:
    assert diagnose(text) == ()
    return warnings(parse_program(text).tree, course=course)


def told(text: str, *codes: str) -> list[tuple[str, int, int]]:
    """Those of some codes: code, line, column."""
    return [(each.code, *each.span.start) for each in found(text) if each.code in codes]


# What is never reached.


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("while (true) { skip } fire;", [("FA201", 1, 23)]),
        ("while (1 < 2 || getx self > 0) { fire; }\nfire;\nfire;", [("FA201", 2, 1)]),
        ("if (getx self > 0) { while (true) { fire; } } else { while (true) { skip } } fire;",
         [("FA201", 1, 78)]),
        ("if (true) { while (true) { fire; } } fire;", [("FA201", 1, 38)]),
        ("while (getx self > 0) { while (true) { fire; } thrust; }", [("FA201", 1, 48)]),
        ("while (true) { fire; } double x; print x;", [("FA201", 1, 34)]),
        ("if (false) { fire; }", [("FA202", 1, 12)]),
        ("if (!(1 > 2)) { fire; } else { skip }", [("FA202", 1, 30)]),
        ("while (getx self > 0 && false) { fire; }", [("FA202", 1, 32)]),
        ("if (false) { while (true) { } fire; }", [("FA202", 1, 12)]),
        ("if (true == false) { fire; }", [("FA202", 1, 20)]),
        ("if (-1 > sqrt(4) - 2) { fire; }", [("FA202", 1, 23)]),
    ],
)  # fmt: skip
def test_what_is_never_reached_is_told(text: str, places: list[tuple[str, int, int]]) -> None:
    assert told(text, "FA201", "FA202") == places


@pytest.mark.parametrize(
    "text",
    [
        "fire; while (true) { fire; }",
        "while (true) { fire; } double x;",
        "while (getx self > 0) { fire; } fire;",
        "if (getx self > 0) { while (true) { fire; } } fire;",
        "while (getx self > 0) { while (true) { fire; } } fire;",
        "entity a; foreach (any, a) { while (true) { } } fire;",
        "if (true) { fire; } thrust;",
        "if (true) { fire; } else { }",
        "if (false) { double x; } else { fire; }",
        "bool b; b := true; if (b) { fire; } else { skip }",
        "if (self == null) { fire; }",
    ],
)
def test_what_may_be_reached_is_not_told(text: str) -> None:
    assert told(text, "FA201", "FA202") == []


# Loops that burn their fuel.


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("while (true) { }", [("FA203", 1, 1)]),
        ("double x;\nwhile (getx self < x) { print x; }", [("FA203", 2, 1)]),
        ("while (true) { while (true) { } }", [("FA203", 1, 1)]),
        ("double x; while (true) { fire; while (x < 3) { print x; } }", [("FA203", 1, 32)]),
        ("entity a; double x; while (x < 1) { foreach (any, a) { print a; } }", [("FA203", 1, 21)]),
    ],
)
def test_a_loop_that_burns_its_fuel_is_told(text: str, places: list[tuple[str, int, int]]) -> None:
    assert told(text, "FA203") == places


@pytest.mark.parametrize(
    "text",
    [
        "while (true) { skip }",
        "while (getx self < 3) { if (gety self > 4) { turn 1; } }",
        "double x; while (x < 3) { x := x + 1; }",
        "double x; while (x < 3) { double x := 4; }",
        "double x; while (x < 3) { if (x > 1) { x := 3; } else { while (x < 2) { x := 3; } } }",
        "entity a; while (a == null) { foreach (asteroid, a) { } }",
        "while (false) { }",
    ],
)
def test_a_loop_that_acts_or_may_end_is_not_told(text: str) -> None:
    assert told(text, "FA203") == []


# Variables in vain.


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("double x; x := 3;", [("FA204", 1, 8)]),
        ("double x := 3;", [("FA204", 1, 8)]),
        ("double n; while (true) { n := n + 1; fire; }", [("FA204", 1, 8)]),
        ("bool b; if (b) { fire; }", [("FA205", 1, 6)]),
        ("entity a; print a;", [("FA205", 1, 8)]),
        ("double x;\nbool b;\nfire;", [("FA206", 1, 8), ("FA206", 2, 6)]),
        ("double x; double y; x := y;", [("FA204", 1, 8), ("FA205", 1, 18)]),
    ],
)
def test_variables_in_vain_are_told(text: str, places: list[tuple[str, int, int]]) -> None:
    assert told(text, "FA204", "FA205", "FA206") == places


@pytest.mark.parametrize(
    "text",
    [
        "double x; x := 3; print x;",
        "double x := 3; turn x;",
        "entity a; foreach (asteroid, a) { print 1; }",
        "entity a; foreach (asteroid, a) { print a; }",
        "double x; double y; y := 1; x := y; while (x < sqrt(y)) { fire; }",
    ],
)
def test_variables_in_use_are_not_told(text: str) -> None:
    assert told(text, "FA204", "FA205", "FA206") == []


@pytest.mark.parametrize(
    ("text", "after"),
    [
        ("double x;\nfire;", "fire;"),
        ("  double x;  \r\nfire;\r\n", "fire;\r\n"),
        ("fire;\ndouble x;", "fire;\n"),
        ("double x; fire;", "fire;"),
        ("fire; double x;\nskip", "fire; \nskip"),
        ("double x; // far\nfire;", "// far\nfire;"),
        ("double x; double\n x\n ; fire;", "fire;"),
        ("if getx self > 0 {double x;fire;}", "if getx self > 0 {fire;}"),
    ],
)
def test_a_declaration_of_nothing_in_use_can_be_taken_out(text: str, after: str) -> None:
    assert mended(text, found(text)) == after
    assert found(after) == ()


# Equality of doubles.


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("if (getx self == 3) { fire; }", [("FA207", 1, 5)]),
        ("double x; x := 0.1; if (1 != x) { fire; }", [("FA207", 1, 25)]),
        ("double x; x := 1; x := x / 3; if (x == 0) { fire; }", [("FA207", 1, 35)]),
        ("double x; double y; y := x; x := y + getdir; print y == 1;", [("FA207", 1, 52)]),
        ("double x; double y; y := x % 2; x := getdir; print y == 1;", [("FA207", 1, 52)]),
        ("double n; n := n + 0.5; print n % 1 == 0;", [("FA207", 1, 31)]),
        ("print !(getdir == 0.5);", [("FA207", 1, 9)]),
    ],
)
def test_doubles_compared_for_equality_are_told(
    text: str, places: list[tuple[str, int, int]]
) -> None:
    assert told(text, "FA207") == places


@pytest.mark.parametrize(
    "text",
    [
        "if (self == null) { fire; }",
        "bool b; print b == true;",
        "print getdir < 1;",
        "double n; n := n + 1; if (n == 3) { n := -1; }",
        "double n; double m; m := n; n := m * 2 - 1; print n != m;",
        "double n; n := n + 1; if (n % 3 == 0) { fire; }",
        "double n; double m; n := n + 1; m := -n % 4; print m == 1;",
    ],
)
def test_counters_and_other_types_compared_are_not_told(text: str) -> None:
    assert told(text, "FA207") == []


# Entities that may be null.

FOUND = "entity a; entity n; bool found; double x; foreach (asteroid, a) { %s } %s"


@pytest.mark.parametrize(
    "marked",
    [
        "print @getx null;",
        "entity a; foreach (ship, a) { } print @getx a + gety a;",
        "entity a; a := self; a := null; print @getx a;",
        "entity a; if (getx self > 0) { a := self; } print @getx a;",
        "entity a; while (true) { print @getx a; a := self; fire; }",
        "entity a; a := self; while (true) { print @getx a; a := null; fire; }",
        "entity a; a := self; if (getx a > 1) { a := null; } print sqrt(1 - @gety a);",
        "entity a; foreach (ship, a) { } if (a == null) { print @getx a; }",
        "entity a; foreach (ship, a) { } if (a != null || @getx a > 1) { skip }",
        "entity a; entity b; a := b; b := self; foreach (any, b) { a := b; } print @getx a;",
        FOUND % ("n := a;", "found := true; if (found) { print @getx n; }"),
        FOUND % ("found := true; n := a;", "n := null; if (found) { print @getx n; }"),
    ],
)
def test_an_entity_that_may_be_null_is_told(marked: str) -> None:
    assert told(marked.replace("@", ""), "FA208") == [("FA208", 1, marked.index("@") + 1)]


@pytest.mark.parametrize(
    "text",
    [
        "print getx self;",
        "entity a; foreach (ship, a) { print getx a; }",
        "entity a; a := self; print getx a;",
        "entity a; entity b; a := self; b := a; print getx b;",
        "entity a; foreach (ship, a) { } if (a != null) { print getx a; }",
        "entity a; foreach (ship, a) { } if (null == a) { skip } else { print getx a; }",
        "entity a; foreach (ship, a) { } if (!(a == null) && getx a > 1) { print gety a; }",
        "entity a; foreach (ship, a) { } if (a == null || getx a > 1) { skip }",
        "entity a; foreach (ship, a) { } while (a == null) { skip } print getx a;",
        "entity a; foreach (ship, a) { } if (a == null) { a := self; } print getx a;",
        "entity a; foreach (ship, a) { } if (a == null) { while (true) { skip } } print getx a;",
        "entity a; foreach (ship, a) { } if (a == self) { print getx a; }",
        "entity a; entity n; n := self; foreach (any, a) { if (getx a < getx n) { n := a; } }",
        FOUND % ("found := true; n := a;", "if (found) { print getx n; }"),
        FOUND % ("n := a; found := true;", "if (found && getx n > 1) { print getx n; }"),
        FOUND % ("if (!found || getx a < x) { found := true; n := a; x := getx n; }",
                 "while (true) { if (found == true) { turn getx n; } skip }"),
        FOUND % ("n := a;", "found := n != null; if (!found) { skip } else { print getx n; }"),
    ],
)  # fmt: skip
def test_an_entity_that_is_surely_there_is_not_told(text: str) -> None:
    assert told(text, "FA208") == []


def test_deep_loops_take_few_passes() -> None:
    text = (
        "entity a; entity b;"
        + "while (getx self > 0) { b := a; a := self; " * 48
        + "skip"
        + "}" * 48
    )
    assert told(text + "print getx b;", "FA208")


# Laws.

FEWER = settings(max_examples=max(settings().max_examples // 3, 30))
"""Programs are slow to draw."""


@FEWER
@given(programs(depth=2))
def test_any_program_has_warnings_that_can_be_shown(tree: Program) -> None:
    """Also about a tree that has no text: then there are no fixes."""
    some = warnings(tree, course=True)
    assert all(not each.fix for each in some)
    rendered(some, "", "x")


@FEWER
@given(program_texts(depth=2))
def test_warnings_are_by_place_and_their_fixes_leave_a_right_program(text: str) -> None:
    some = found(text, course=True)
    assert list(some) == sorted(some, key=lambda each: each.span)
    assert {each.severity for each in some} <= {"warning"}
    assert {each.code for each in some} <= LINT.keys()
    rendered(some, text, "x")
    after = mended(text, some)
    assert diagnose(after) == ()
    fixed = {each.code for each in some if each.fix}
    assert fixed <= {"FA206", "FA211", "FA212"}
    assert not {each.code for each in found(after, course=True) if each.fix} & {"FA206", "FA211"}


@FEWER
@given(program_texts(depth=2))
def test_a_program_does_the_same_with_its_fixes_in(text: str) -> None:
    (one, its), (other, others) = (
        outcome(t) for t in (text, mended(text, found(text, course=True)))
    )
    short = min(len(its), len(others))
    assert its[:short] == others[:short]
    if isinstance(one, Halted) and isinstance(other, Halted):
        assert (its, one.reason) == (others, other.reason)


def outcome(text: str) -> tuple[Machine, list[object]]:
    """What a program did and printed in its first 200 steps."""
    machine = check_program(parse_program(text)).program
    assert machine is not None
    seen, did = view(), list[object]()
    for _ in range(200):
        if not isinstance(machine, Running):
            break
        machine, action, printed = step(machine, seen)
        did += [each for each in (printed, repr(action)) if each not in (None, "None")]
    return machine, did


@FEWER
@given(program_texts(depth=2))
def test_a_program_that_is_not_warned_of_null_never_stops_for_it(text: str) -> None:
    if told(text, "FA205", "FA208"):
        return
    machine, _ = outcome(text)
    assert not (isinstance(machine, Halted) and machine.reason and "null" in machine.reason)
