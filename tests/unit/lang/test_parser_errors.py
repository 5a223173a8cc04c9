"""What is wrong is told once, at its place, with its fix, and does not hide the rest."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fasteroids.lang.codes import CODES, SYNTAX
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.names import closest_word
from fasteroids.lang.parser import parse_program
from fasteroids.lang.parser.foreign import CONSTANTS, KINDS
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
    Number,
    Print,
    Turn,
    Unary,
    While,
)
from fasteroids.lang.words import KEYWORDS

PROGRAMS = Path(__file__).parents[2] / "programs"


def mended(text: str, *faults: Diagnostic) -> str:
    """The text with the fixes applied."""
    starts = [0, *(m.end() for m in re.finditer(r"\r\n?|\n", text))]
    edits = sorted(
        (edit for fault in faults for edit in fault.fix), key=lambda e: e.span, reverse=True
    )
    for edit in edits:
        start = starts[edit.span.line - 1] + edit.span.column - 1
        end = starts[edit.span.end_line - 1] + edit.span.end_column - 1
        text = text[:start] + edit.text + text[end:]
    return text


def only(text: str) -> Diagnostic:
    [fault] = parse_program(text).diagnostics
    return fault


# The showcase.


def test_the_second_example_as_printed_has_exactly_its_three_faults() -> None:
    text = (PROGRAMS / "second-as-printed.ast").read_text()
    parsed = parse_program(text)
    colon, markup, brace = parsed.diagnostics
    assert (colon.code, colon.span) == ("FA010", Span(3, 9, 3, 10))
    assert colon.message == "A statement ends in `;`, not in `:`"
    assert (markup.code, markup.span) == ("FA007", Span(21, 52, 21, 58))
    assert (brace.code, brace.span) == ("FA014", Span(23, 45, 23, 45))
    assert [note.span for note in brace.notes] == [Span(21, 51, 21, 52)]
    repaired = mended(text, *parsed.diagnostics)
    assert repaired == (
        text.replace("r:", "r;")
        .replace("</pre>", "")
        .replace("= distance;\n  }\n}", "= distance;\n    }\n  }\n}")
    )
    # The tree is that of the mended text, so a checker can go on.
    assert parsed.program is None
    assert parsed.tree == parse_program(repaired).program


@pytest.mark.parametrize("code", sorted(SYNTAX))
def test_the_wrong_program_of_a_code_has_this_fault_alone_and_the_right_one_none(code: str) -> None:
    assert {fault.code for fault in parse_program(SYNTAX[code].wrong).diagnostics} == {code}
    assert parse_program(SYNTAX[code].right).diagnostics == ()


def test_codes_are_numbered_without_gaps_and_known() -> None:
    assert list(SYNTAX) == [f"FA{n:03}" for n in range(1, len(SYNTAX) + 1)]
    assert CODES.keys() >= SYNTAX.keys()


# One fault, one error, and its fix.

MENDED = {
    # assignments
    "x = 3;": "x := 3;",
    "x == 3;": "x := 3;",
    "x : 3;": "x := 3;",
    "x : = 3;": "x := 3;",
    "x =! b;": "x := ! b;",
    "double x = 3;": "double x := 3;",
    "double x: 3;": "double x:= 3;",
    "x++;": "x := x + 1;",
    "x--;": "x := x - 1;",
    "++x;": "x := x + 1;",
    "x += 1;": "x := x + 1;",
    "x -= a + b;": "x := x - (a + b);",
    # semicolons
    "double r:": "double r;",
    "fire": "fire;",
    "turn 1\nfire;": "turn 1;\nfire;",
    "x := 1 // one\nfire;": "x := 1; // one\nfire;",
    "x := 1 y := 3;": "x := 1; y := 3;",
    "if b { x := 1 }": "if b { x := 1; }",
    "if b { fire } else { skip }": "if b { fire; } else { skip }",
    # parentheses
    "x := (1 + 2;": "x := (1 + 2);",
    "x := ((((1+2);": "x := ((((1+2))));",
    "while (b { fire; }": "while (b) { fire; }",
    "if ((a) < (b) then { }": "if ((a) < (b)) then { }",
    "x := 1);": "x := 1;",
    "if (a))) { }": "if (a) { }",
    "x := sqrt 4 + 1;": "x := sqrt(4) + 1;",
    "foreach asteroid, a { }": "foreach (asteroid, a) { }",
    "foreach (asteroid, a { }": "foreach (asteroid, a) { }",
    # braces
    "while (b) {\n  fire;\n": "while (b) {\n  fire;\n}\n",
    "while (b) { fire;": "while (b) { fire; }",
    "if a { if b { fire;": "if a { if b { fire; } }",
    "if (b) fire;": "if (b) { fire; }",
    "if (b)\n  fire;\nturn 1;": "if (b) {\n  fire; }\nturn 1;",
    "while (b)\n  fire;\n  turn 1;\n}\nturn 2;": "while (b) {\n  fire;\n  turn 1;\n}\nturn 2;",
    "while (b); { fire; }": "while (b) { fire; }",
    "fire; }": "fire; ",
    "fire; }}}\nskip": "fire; \nskip",
    "if b {{ fire; }": "if b { fire; }",
    "if b { }; else { }": "if b { } else { }",
    # words
    "if b { } elseif (c) { skip }": "if b { } else if (c) { skip }",
    "if b { } elif c { } else { }": "if b { } else if c { } else { }",
    "if b { } else (c) { }": "if b { } else if (c) { }",
    "if b { } esle { }": "if b { } else { }",
    "while b then { }": "while b do { }",
    "if b do { }": "if b then { }",
    "b := a & c;": "b := a && c;",
    "b := a or c && d;": "b := a || c && d;",
    "b := not a;": "b := ! a;",
    "b := a <> c;": "b := a != c;",
    "b := a =! c;": "b := a != c;",
    "x := a mod b;": "x := a % b;",
    "b := a is null;": "b := a == null;",
    "if (a = b) { }": "if (a == b) { }",
    "if a = b { }": "if a == b { }",
    "if (a := b) { }": "if (a == b) { }",
    "int x;": "double x;",
    "boolean b := true;": "bool b := true;",
    "ship s;": "entity s;",
    "shoot;": "fire;",
    "println x;": "print x;",
    "trun 1;": "turn 1;",
    "pirnt x;": "print x;",
    "whlie (b) { fire; }": "while (b) { fire; }",
    "fier;": "fire;",
    "doubel x;": "double x;",
    "Foreach (asteroid, a) { }": "foreach (asteroid, a) { }",
    "IF b { }": "if b { }",
    "x := getX self;": "x := getx self;",
    "x := squrt(4);": "x := sqrt(4);",
    "x := a.x;": "x := getx a;",
    "x := 1 + self.vy;": "x := 1 + getvy self;",
    # for-each
    "foreach (asteriod, a) { }": "foreach (asteroid, a) { }",
    "foreach (asteroids, a) { }": "foreach (asteroid, a) { }",
    "foreach (all, a) { }": "foreach (any, a) { }",
    "foreach(a in asteroids) { }": "foreach(asteroid, a) { }",
    "foreach (entity a in ships) { }": "foreach (ship, a) { }",
    "foreach (asteroid a) { }": "foreach (asteroid, a) { }",
    "foreach (a, asteroid) { }": "foreach (asteroid, a) { }",
    # declarations, actions
    "double a, b, c;": "double a; double b; double c;",
    "double a,b;": "double a; double b;",
    "double a := 1, b := 2;": "double a := 1; double b := 2;",
    "double a, double b;": "double a; double b;",
    "const double x := 1;": "double x := 1;",
    "let  entity e;": "entity e;",
    "fire();": "fire;",
    "fire(1, 2);": "fire;",
    "thrust_on;": "thrust;",
    "x := getdir();": "x := getdir;",
    "x := sin(-getdir (self)) + 1;": "x := sin(-getdir) + 1;",
    "turn 1 - getdir self * 2;": "turn 1 - getdir * 2;",
    "thrust off;": "thrust_off;",
    "thrust on;": "thrust;",
    # numbers, comments, odd characters
    "x := 1,5;": "x := 1.5;",
    "x := .5;": "x := 0.5;",
    "turn.5;": "turn 0.5;",
    "turn+1;": "turn 1;",
    "print+x;": "print x;",
    "x:=.5;": "x:=0.5;",
    "x := + 5;": "x :=  5;",
    "# foo\nfire;": "// foo\nfire;",
    "/* a */ fire;": "// a\n fire;",
    "x := −1;": "x := -1;",
    "fire;\xa0fire;": "fire; fire;",
    "if a &lt; b { }": "if a < b { }",
}


@pytest.mark.parametrize("text", MENDED)
def test_one_fault_is_one_error_and_its_fix_mends_it(text: str) -> None:
    fault = only(text)
    assert mended(text, fault) == MENDED[text]
    assert parse_program(MENDED[text]).diagnostics == ()
    assert fault.hint is not None


@pytest.mark.parametrize("text", MENDED)
def test_where_the_fix_is_sure_the_tree_is_that_of_the_mended_text(text: str) -> None:
    guessed = {
        "x--;",
        "x++;",
        "++x;",
        "x += 1;",
        "x -= a + b;",
        "x := 1,5;",
        "x := a.x;",
        "x := 1 + self.vy;",
    }
    if text not in guessed:
        assert parse_program(text).tree == parse_program(MENDED[text]).tree


# One fault, one error, without a sure fix: the code, the place, and a word of the message.

TOLD = {
    "turn;": ("FA018", (5, 5), "angle"),
    "print": ("FA018", (6, 6), "value"),
    "x := ;": ("FA018", (5, 5), "value to assign"),
    "x := a + ;": ("FA018", (9, 9), "`+` has nothing on its right"),
    "x := * 5;": ("FA018", (6, 7), "`*` has nothing on its left"),
    "x := getx;": ("FA018", (10, 10), "entity"),
    "x := sqrt();": ("FA018", (11, 11), "missing"),
    "while { }": ("FA018", (6, 6), "condition"),
    "x := \ny := 3;": ("FA018", (5, 5), "value to assign"),
    "x := a b;": ("FA019", (8, 9), "before `b`"),
    "x := a b c d;": ("FA019", (8, 9), "before `b`"),
    "x := 2(3);": ("FA019", (7, 8), "before `(`"),
    "5;": ("FA020", (1, 2), "`5`"),
    "x;": ("FA020", (1, 2), "alone"),
    "getx self;": ("FA020", (1, 5), "`getx`"),
    "if b { } then { }": ("FA020", (10, 14), "`then`"),
    "for (i = 0; i < 3; i++) { fire; }": ("FA022", (1, 4), "`for`"),
    "for x in y { fire; }": ("FA022", (1, 4), "`for`"),
    "return x;": ("FA022", (1, 7), "`return`"),
    "break;": ("FA022", (1, 6), "`break`"),
    "function f(a, b) { fire; }": ("FA022", (1, 9), "`function`"),
    "string s;": ("FA022", (1, 7), "`string`"),
    "var v := null;": ("FA022", (1, 4), "`var`"),
    "foo bar;": ("FA022", (1, 4), "`foo`"),
    "double ship;": ("FA023", (8, 12), "`ship`"),
    "turn := 3;": ("FA023", (1, 5), "`turn`"),
    "any := 3;": ("FA023", (1, 4), "`any`"),
    "x := fire + 1;": ("FA023", (6, 10), "`fire`"),
    "foreach (asteroid, ship) { }": ("FA023", (20, 24), "`ship`"),
    "double;": ("FA023", (7, 7), "name"),
    "double 3;": ("FA023", (8, 9), "`3`"),
    ":= 3;": ("FA023", (1, 3), "name"),
    "foreach (foo, a) { }": ("FA024", (10, 13), "`foo`"),
    "foreach () { }": ("FA024", (10, 10), "kind"),
    "foreach { fire; }": ("FA024", (8, 8), "kind"),
    "thrust 5;": ("FA026", (8, 9), "takes nothing"),
    "x := getdir a + 1;": ("FA026", (13, 14), "its own direction"),
    "x := getdir (a);": ("FA026", (13, 14), "its own direction"),
    "x := getdir(self, a);": ("FA026", (12, 13), "its own direction"),
    "print a, b;": ("FA027", (8, 9), "one value"),
    "x := getx(self, a);": ("FA027", (15, 16), "too many"),
    "x := sqrt(1, 2);": ("FA027", (12, 13), "too many"),
    "x := abs(y);": ("FA030", (6, 9), "`abs`"),
    "x := min(a, b) + 1;": ("FA030", (6, 9), "`min`"),
    "shoot_at(a);": ("FA030", (1, 9), "`shoot_at`"),
    "self.x := 3;": ("FA031", (1, 7), "fields"),
    "x := a.foo();": ("FA031", (6, 11), ".foo"),
    "else { fire; }": ("FA032", (1, 5), "`else`"),
    "{ fire; }": ("FA033", (1, 2), "block"),
    "x := y := z := 3;": ("FA034", (8, 10), "no value"),
    'print "hi";': ("FA005", (7, 11), "quotes"),
    "@@@ fire;": ("FA001", (1, 4), "`@@@`"),
    "entity[] a;": ("FA001", (7, 9), "`[]`"),
    "double[3] a := 1;": ("FA001", (7, 10), "`[3]`"),
    "double a[3];": ("FA001", (9, 12), "`[3]`"),
    "x := a[i + 1];": ("FA001", (7, 14), "`[i + 1]`"),
    "a[b[0]] := 3;": ("FA001", (2, 8), "`[b[0]]`"),
    "x := [1, 2];": ("FA001", (6, 12), "`[1, 2]`"),
    "x := a[0; fire;": ("FA001", (7, 8), "`[`"),
    "fire @;": ("FA001", (6, 7), "`@`"),
    "x := a @ b;": ("FA001", (8, 9), "`@`"),
    "x := a ** b;": ("FA001", (8, 10), "`**`"),
    "x := a ^ b;": ("FA001", (8, 9), "`^`"),
    "_x := 3;": ("FA006", (1, 3), "`_x`"),
    "x := a ? b : c;": ("FA009", (8, 9), "? :"),
    "while (b);": ("FA015", (10, 11), "`while`"),
    "while (b)": ("FA015", (10, 10), "`while`"),
    "if (b): fire;": ("FA015", (7, 8), "`:`"),
}


@pytest.mark.parametrize("text", TOLD)
def test_one_fault_is_one_error_at_its_place(text: str) -> None:
    fault = only(text)
    code, (start, end), told = TOLD[text]
    assert (fault.code, fault.span) == (code, Span(1, start, 1, end))
    assert told in fault.message
    assert not fault.message.endswith(".")


def test_all_errors_of_a_text_are_told_in_the_order_of_their_places() -> None:
    text = "int i;\ni = 1\nwhile i < 3 {\n  trun .5;\n  i++;\n  fire()\n}}\nprint;\n"
    found = [(f.code, f.span.line) for f in parse_program(text).diagnostics]
    assert found == [
        ("FA022", 1), ("FA011", 2), ("FA010", 2), ("FA021", 4), ("FA003", 4), ("FA028", 5),
        ("FA026", 6), ("FA010", 6), ("FA016", 7), ("FA018", 8),
    ]  # fmt: skip


def test_a_statement_after_a_broken_one_is_read() -> None:
    for broken in (
        "x := 3 4 5;",
        "foo bar;",
        "x := (1;",
        "5;",
        "@;",
        "x y z",
        "double;",
        "turn :=;",
        "a.b.c;",
    ):
        parsed = parse_program(f"{broken}\nfire; y = 2;")
        assert parsed.tree.body.statements[-2] == Act("fire"), broken
        assert parsed.diagnostics[-1].code == "FA011", broken
        assert len(parsed.diagnostics) == 2, broken


def test_bodies_of_constructs_the_language_has_not_are_read() -> None:
    for head in (
        "for (i = 0; i < 3; i++)",
        "repeat",
        "function f(x)",
        "foreach",
        "else",
        "foo",
        "",
    ):
        parsed = parse_program(head + " { fire; x = 2; }")
        assert [f.code for f in parsed.diagnostics][1:] == ["FA011"], head
        body = parsed.tree.body.statements[-1]
        assert isinstance(body, If | While), head
        block = body.then if isinstance(body, If) else body.body
        assert block.statements == (Act("fire"), Assignment(Name("x"), Number(2.0))), head


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("x := atan2(y, z);", "halving; see `fasteroids explain FA030`"),
        ("x := abs(y);", "`sqrt(x * x)`"),
        ("x := max(y, z);", "`if (b > a) { a := b; }`"),
        ("x := log(y);", "Functions are `sqrt`, `sin` and `cos`"),
        ("entity[] a;", "There are no lists"),
        ("double a[1];", "There are no lists"),
        ("static const int i;", "a declaration starts with its type"),
        ("var ship s;", "a declaration starts with its type"),
    ],
)
def test_a_hint_says_how_to_do_without(text: str, hint: str) -> None:
    assert hint in (parse_program(text).diagnostics[0].hint or "")


def test_words_before_a_type_are_left_out() -> None:
    for text in ("const int i := 1;", "static final number i := 1;", "let double i := 1;"):
        parsed = parse_program(text)
        assert parsed.tree.body.statements == (Declaration("double", Name("i"), Number(1.0)),)
        assert mended(text, *parsed.diagnostics) == "double i := 1;"


# What is in the tree where something is missing.


def test_what_cannot_be_read_is_missing_in_the_tree() -> None:
    text = "turn; x := a +; print sqrt(@); if { fire; } y := a @ b;"
    condition, body = Missing(), Block((Act("fire"),))
    assert parse_program(text).tree.body.statements == (
        Turn(Missing()), Assignment(Name("x"), Binary("+", Name("a"), Missing())),
        Print(Unary("sqrt", Missing())), If(condition, body), Assignment(Name("y"), Missing()),
    )  # fmt: skip


def test_a_broken_declaration_still_declares() -> None:
    text = "int i := 1; var b := true; var e := null; double a, b; double ship; double r:"
    statements = parse_program(text).tree.body.statements
    declared = [(s.type, s.target.name) for s in statements if isinstance(s, Declaration)]
    assert declared == [
        ("double", "i"), ("bool", "b"), ("entity", "e"), ("double", "a"), ("double", "b"),
        ("double", "ship"), ("double", "r"),
    ]  # fmt: skip


def test_a_broken_for_each_keeps_its_variable() -> None:
    for head in ("(asteriod, a)", "(a in asteroids)", "asteroid, a", "(asteroid, a"):
        [loop] = parse_program(f"foreach {head} {{ fire; }}").tree.body.statements
        assert loop == ForEach("asteroid", Name("a"), Block((Act("fire"),)))


# Which brace is missing or too many.


def brace_lines(text: str) -> list[tuple[str, int]]:
    return [(f.code, f.span.line) for f in parse_program(text).diagnostics]


def test_indentation_tells_which_block_is_not_closed() -> None:
    inner = "while b {\n  if c {\n    fire;\n  turn 1;\n}\n"
    assert brace_lines(inner) == [("FA014", 3)]
    outer = "while b {\n  if c {\n    fire;\n  }\n  turn 1;\nturn 2;\n"
    assert brace_lines(outer) == [("FA014", 5)]
    both = "while b {\n  if c {\n    if d {\n      fire;\n  }\nturn 2;\n"
    assert brace_lines(both) == [("FA014", 4), ("FA014", 5)]
    allman = "while b\n{\n  if c\n  {\n    fire;\n  turn 1;\n}\n"
    assert brace_lines(allman) == [("FA014", 5)]


def test_blocks_that_end_at_one_place_are_one_error_with_their_openings() -> None:
    fault = only("if a {\n  if b {\n    fire;\n")
    assert fault.message == "2 closing braces are missing"
    assert [note.span.line for note in fault.notes] == [2, 1]
    assert mended("if a {\n  if b {\n    fire;\n", fault) == "if a {\n  if b {\n    fire;\n  }\n}\n"


def test_without_indentation_the_last_blocks_are_not_closed() -> None:
    assert brace_lines("while b {\nif c {\nfire;\n}\nturn 1;\n") == [("FA014", 5)]


def test_indentation_tells_which_brace_closes_nothing() -> None:
    assert brace_lines("while b {\n  fire;\n  }\n  turn 1;\n}\n") == [("FA016", 3)]
    assert brace_lines("while b {\n  fire;\n}\n}\nturn 1;\n") == [("FA016", 4)]


def test_indentation_tells_which_body_lacks_its_opening_brace() -> None:
    text = "while true {\n  if b\n    fire;\n  }\n  turn 1;\n}\n"
    assert mended(text, only(text)) == text.replace("if b", "if b {")
    twice = "while a\n  if b\n    fire;\n  }\n}\nfire;"
    assert [f.code for f in parse_program(twice).diagnostics] == ["FA015", "FA015"]
    assert parse_program(twice).tree == parse_program("while a{if b{fire;}} fire;").tree


def test_braces_that_balance_are_left_alone_however_they_are_indented() -> None:
    text = "while b {\n    fire;\n  } if c {\n      }\n  while d {\nskip\n if e {\n} }"
    assert parse_program(text).diagnostics == ()


# Words.


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("asteriod", "asteroid"), ("Asteroid", "asteroid"), ("shp", "ship"), ("trun", "turn"),
        ("IF", "if"), ("thrustoff", "thrust_off"), ("foreahc", "foreach"), ("galaxy", None),
        ("is", None), ("a", None), ("", None),
    ],
)  # fmt: skip
def test_the_closest_word_is_found_or_none(word: str, meant: str | None) -> None:
    assert closest_word(word, sorted(KEYWORDS)) == meant


def test_tables_of_foreign_words_lead_to_words_of_the_language() -> None:
    assert {*CONSTANTS.values(), *KINDS.values()} <= KEYWORDS
    assert KEYWORDS.isdisjoint(CONSTANTS)


def test_long_and_unprintable_pieces_do_not_flood_the_message() -> None:
    for text in (
        "x" * 100_000,
        "@" * 100_000,
        "\x00" * 100_000,
        "9" * 100_000,
        "x := 1 " + "y" * 9999,
    ):
        for fault in parse_program(text).diagnostics:
            assert len(fault.message) < 160
            assert fault.message.isprintable()
