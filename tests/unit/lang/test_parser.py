"""What is right is read right: the grammar, spans, limits."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import attrs
import pytest

from fasteroids.lang.parser import decoded, parse_bytes, parse_program
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import (
    MOST_NESTED,
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Missing,
    Name,
    Null,
    Number,
    Print,
    Self,
    Statement,
    Truth,
    Turn,
    Unary,
    While,
)

PROGRAMS = Path(__file__).parents[2] / "programs"


def read(text: str) -> tuple[Statement, ...]:
    parsed = parse_program(text)
    assert parsed.diagnostics == ()
    assert parsed.program is parsed.tree
    return parsed.tree.body.statements


def value(text: str) -> Expression:
    [statement] = read(f"print {text};")
    assert isinstance(statement, Print)
    return statement.value


def shape(text: str) -> str:
    """An expression with all its parentheses."""

    def show(e: Expression) -> str:
        if isinstance(e, Binary):
            return f"({show(e.left)}{e.operator}{show(e.right)})"
        if isinstance(e, Unary):
            return f"{e.operator}[{show(e.operand)}]"
        assert isinstance(e, Name)
        return e.name

    return show(value(text))


def nested(node: Any) -> int:
    """Nodes from a node to its farthest leaf."""
    parts: list[Any] = []
    for field in attrs.fields(type(node)):
        part = getattr(node, field.name)
        parts += part if isinstance(part, tuple) and not isinstance(part, Span) else [part]
    return 1 + max((nested(part) for part in parts if attrs.has(type(part))), default=0)


def test_the_first_example_of_the_assignment_is_read() -> None:
    d, b = Name("d"), Name("b")
    body = Block((Turn(d), Assignment(d, Binary("+", d, Number(0.1))), Act("fire")))
    assert read((PROGRAMS / "first.ast").read_text()) == (
        Declaration("double", d), Declaration("bool", b),
        Assignment(d, Number(0.2)), Assignment(b, Truth(True)), While(b, body),
    )  # fmt: skip


def test_the_mended_second_example_is_read() -> None:
    statements = read((PROGRAMS / "second-mended.ast").read_text())
    assert [type(s).__name__ for s in statements[-2:]] == ["ForEach", "If"]


@pytest.mark.parametrize(
    ("text", "grouped"),
    [
        ("a - b - c", "((a-b)-c)"),
        ("a + b * c", "(a+(b*c))"),
        ("a * b + c", "((a*b)+c)"),
        ("a / b % c * d", "(((a/b)%c)*d)"),
        ("a || b && c", "(a||(b&&c))"),
        ("a && b || c", "((a&&b)||c)"),
        ("a < b && c >= d", "((a<b)&&(c>=d))"),
        ("a == b + c", "(a==(b+c))"),
        ("a < b < c", "((a<b)<c)"),
        ("a != b == c", "((a!=b)==c)"),
        ("a + b < c * d || e", "(((a+b)<(c*d))||e)"),
        ("a - b * c - d", "((a-(b*c))-d)"),
        ("a * (b + c)", "(a*(b+c))"),
        ("getx a + b", "(getx[a]+b)"),
        ("getx (a + b)", "getx[(a+b)]"),
        ("-a * b", "(-[a]*b)"),
        ("a - -b", "(a--[b])"),
        ("a--b", "(a--[b])"),
        ("a-b", "(a-b)"),
        ("!a && b", "(![a]&&b)"),
        ("!!a", "![![a]]"),
        ("- getvx a", "-[getvx[a]]"),
        ("sqrt(a) + b", "(sqrt[a]+b)"),
        ("sin(a + b) * cos((c))", "(sin[(a+b)]*cos[c])"),
        ("getradius gety a", "getradius[gety[a]]"),
    ],
)
def test_precedences_are_conventional_and_all_group_to_the_left(text: str, grouped: str) -> None:
    assert shape(text) == grouped


def test_constants_of_each_kind() -> None:
    assert [value(e) for e in ("true", "false", "null", "self", "getdir", "x_1", "007.50")] == [
        Truth(True), Truth(False), Null(), Self(), Direction(), Name("x_1"), Number(7.5),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "normal"),
    [
        ("while (b) do { }", "while b { }"),
        ("while b do { }", "while (b) { }"),
        ("if ((b)) then { } else { }", "if b { } else { }"),
        ("foreach(ship, a) do { skip }", "foreach ( ship , a ) { skip; }"),
        (";; fire; ; }".replace("}", ""), "fire;"),
        ("if b { };", "if b { }"),
        ("skip skip; turn(d);", "skip;skip;turn d;"),
        ("if b { } else if c { } else { fire; }", "if b { } else { if c { } else { fire; } }"),
        ("x:=1;// one\r\n//two", "x := 1;"),
        ("while b { double x; entity e := null; }", "while b{double x;entity e:=null;}"),
        ("print\nx\n;", "print x;"),
    ],
)
def test_trees_are_the_same_in_normal_form(text: str, normal: str) -> None:
    assert read(text) == read(normal)


def test_statements_of_each_kind() -> None:
    x, one, body = Name("x"), Number(1.0), Block((Act("skip"),))
    text = (
        "entity x; bool x := !x; x := 1; print 1; turn -1; fire; thrust; thrust_off; skip"
        " if x { skip } if x { skip } else { skip } while x { skip } foreach (any, x) { skip; }"
    )
    assert read(text) == (
        Declaration("entity", x), Declaration("bool", x, Unary("!", x)), Assignment(x, one),
        Print(one), Turn(Unary("-", one)), Act("fire"), Act("thrust"), Act("thrust_off"),
        Act("skip"), If(x, body), If(x, body, body), While(x, body), ForEach("any", x, body),
    )  # fmt: skip


@pytest.mark.parametrize(
    "name", ["Thrust", "this", "True", "and", "not", "mod", "int", "for", "elseif", "ifx"]
)
def test_words_of_other_languages_are_names_where_the_grammar_takes_a_name(name: str) -> None:
    read(f"double {name}; {name} := {name} + {name}; foreach (any, {name}) {{ }} turn {name};")


def test_nothing_is_a_program() -> None:
    assert parse_program("").program == parse_program("\ufeff // a\n;").program
    assert parse_program("").tree.body.span == Span(1, 1, 1, 1)


def test_the_tree_holds_its_text() -> None:
    for text in ("fire; // é\r\n", "fire @"):
        assert parse_program(text).tree.source == text


def texts(text: str) -> Iterator[str]:
    """The piece of a one-line text that each node spans."""

    def walk(node: Any) -> Iterator[str]:
        if hasattr(node, "span"):
            yield text[node.span.column - 1 : node.span.end_column - 1]
        for field in attrs.fields(type(node)):
            part = getattr(node, field.name)
            for inner in part if isinstance(part, tuple) else (part,):
                if attrs.has(type(inner)):
                    yield from walk(inner)

    return walk(parse_program(text).tree.body)


def test_every_node_spans_its_own_text() -> None:
    assert list(texts(" x := (1+ y)*-2 ; ")) == [
        "x := (1+ y)*-2 ;", "x := (1+ y)*-2 ;", "x", "(1+ y)*-2", "1+ y", "1", "y", "-2", "2",
    ]  # fmt: skip
    assert list(texts("if (b) then {fire;} else if c { }")) == [
        "if (b) then {fire;} else if c { }", "if (b) then {fire;} else if c { }", "b",
        "{fire;}", "fire;", "if c { }", "if c { }", "c", "{ }",
    ]  # fmt: skip
    assert list(texts("foreach (any, a) do {skip}"))[1:] == [
        "foreach (any, a) do {skip}", "a", "{skip}", "skip",
    ]  # fmt: skip


def test_spans_go_over_lines() -> None:
    [statement] = read("turn\n 1 +\n  2;")
    assert statement.span == Span(1, 1, 3, 5)


# Nesting.

DEEPEST = {
    "blocks": ("while b { " * 49, "fire;", "}" * 49),
    "sums": ("turn 1", "+1" * 97, ";"),
    "signs": ("turn " + "-" * 97, "1", ";"),
    "roots": ("turn " + "sqrt(" * 97, "1", ")" * 97 + ";"),
    "sums to the right": ("turn " + "1-(" * 97, "1", ")" * 97 + ";"),
    "getters": ("turn " + "getx (" * 97, "a", ")" * 97 + ";"),
    "branches": ("if b { } else " * 48, "if b { fire; }", ""),
}


@pytest.mark.parametrize("kind", DEEPEST)
def test_a_tree_may_be_as_deep_as_the_limit(kind: str) -> None:
    text = "".join(DEEPEST[kind])
    assert parse_program(text).diagnostics == ()
    assert nested(parse_program(text).tree.body) == MOST_NESTED


@pytest.mark.parametrize(
    "text",
    [
        "while b { " * 49 + "turn 1;" + "}" * 49,
        "while b { " * 49 + "double d;" + "}" * 49,
        "while b { " * 50 + "}" * 50,
        "turn 1" + "+1" * 98 + ";",
        "turn " + "-" * 98 + "1;",
        "turn " + "sqrt(" * 98 + "1" + ")" * 98 + ";",
        "turn " + "1-(" * 98 + "1" + ")" * 98 + ";",
        "turn " + "(" * 101 + "1" + ")" * 101 + ";",
        "turn " + "(" * 300 + "1+1" * 300 + ")" * 300 + ";",
        "if b { } else " * 49 + "if b { fire; }",
        "if b { } else " * 300 + "{ }",
    ],
)
def test_deeper_is_one_error_and_the_rest_is_read(text: str) -> None:
    parsed = parse_program(text + " fire; x = 2;")
    assert [fault.code for fault in parsed.diagnostics] == ["FA029", "FA011"]
    assert parsed.tree.body.statements[-2] == Act("fire")
    assert nested(parsed.tree.body) <= MOST_NESTED


def test_parentheses_alone_may_be_as_many_as_the_limit() -> None:
    assert value("(" * MOST_NESTED + "1" + ")" * MOST_NESTED) == Number(1.0)


def frames(text: str) -> int:
    """How many frames of Python reading a text takes at most."""
    base, most = len(list(_frames(sys._getframe()))), 0

    def count(frame: FrameType, event: str, _: object) -> None:
        nonlocal most
        if event == "call":
            most = max(most, len(list(_frames(frame))))

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        parse_program(text)
    finally:
        sys.setprofile(before)
    return most - base


def _frames(frame: FrameType | None) -> Iterator[FrameType]:
    while frame is not None:
        yield frame
        frame = frame.f_back


@pytest.mark.parametrize(
    "part",
    [
        "(", "-(", "1-(", "sqrt(", "sqrt((", "1-sqrt(", "foo(", "2 foo(", "not (", "@(", "* (", "a b (", "getX (",
    ],
)  # fmt: skip
@pytest.mark.parametrize("blocks", ["", "if b {" * 24, "for {" * 24])
def test_reading_takes_few_frames_however_a_text_is_nested(part: str, blocks: str) -> None:
    for count in (48, 97, 300):
        assert frames(blocks + "x := " + part * count) < 500


# Whatever the text.

NASTY = [
    "(", "{", "}", ")", "if ", "if a ", "if a {", "if a {} else ", "else ", "else if ", "elif a ", "while ",
    "x := ", "x:=", "x:=\n", "x=", "x+=", "x++;", "x ", "x;", "x, ", "a.x ", "foo(", "trun ", "fire ", "fire(",
    "turn ", "print ", "double ", "double a,", "foreach (", "foreach ", "for (", "and ", "& ", "* ", "** ",
    "? ", ":", ",", "=! ", "' ", '" ', "/*", "/* */", "</a", "<  ", "\x00 a ", "\ufffd ", "\xa0", "1e9 ",
    "{}", "}{", "\n{", " if x\n}\n", "if x {}} ", "then ", "@ fire ", "asteriod s;", "\r", "1,2 ",
    "x := getx ", "x := !", "x := -", "x := 1+", "x := (", "x := (1+", "x := a b ", "x := sqrt(",
]  # fmt: skip


@pytest.mark.parametrize("unit", NASTY)
@pytest.mark.parametrize("lead", ["", "x := "])
def test_the_work_grows_no_faster_than_the_text(unit: str, lead: str) -> None:
    # Counted in calls and not in seconds, so that the machine does not matter.
    short, long = (calls(lead + unit * n) for n in (300, 1200))
    assert long <= 4.5 * short + 2000


def calls(text: str) -> int:
    count = 0

    def tally(_: FrameType, event: str, __: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(tally)
    try:
        parse_program(text)
    finally:
        sys.setprofile(None)
    return count


def test_a_sum_of_a_hundred_thousand_terms_is_one_error() -> None:
    for text in (
        "x := 1" + "+1" * 100_000 + ";",
        "x := " + "(" * 100_000,
        "x := " + "getx " * 100_000,
    ):
        codes = [fault.code for fault in parse_program(text).diagnostics]
        # The rest may lack its `;` or `)`.
        assert codes[0] == "FA029"
        assert len(codes) <= 2


# Bytes.


def test_bytes_are_read_and_what_is_not_utf_8_is_told_once() -> None:
    parsed = parse_bytes(b"fire;\nturn \xff;\nx = 1;\n// \xe9\n")
    assert [(f.code, f.span.line) for f in parsed.diagnostics] == [
        ("FA002", 2), ("FA011", 3), ("FA002", 4),
    ]  # fmt: skip
    assert parsed.program is None
    assert parsed.tree.body.statements[1] == Turn(Missing())


def test_good_bytes_are_a_program() -> None:
    data = "fire; // é\n".encode()
    assert parse_bytes(data) == parse_program(decoded(data)[0])
    assert parse_bytes(data).program is not None


def test_the_replacement_character_itself_is_an_error() -> None:
    assert [f.code for f in parse_bytes("turn \ufffd;".encode()).diagnostics] == ["FA002"]
