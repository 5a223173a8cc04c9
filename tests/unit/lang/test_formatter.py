"""Where comments and empty lines go. That nothing is lost, and once is enough, are laws, in the properties."""

from __future__ import annotations

import pytest

from fasteroids.lang.formatter import Comment, comments, formatted, laid_out
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import Act, Block, Program


@pytest.mark.parametrize(
    ("text", "normal"),
    [
        ("", ""),
        (" \n\n", ""),
        (";;", ""),
        ("fire ;;turn(((1)));skip", "fire;\nturn 1;\nskip;\n"),
        ("while b do{if b then{skip}}", "while (b) {\n  if (b) {\n    skip;\n  }\n}\n"),
        ("if b{}else{if(c){}}", "if (b) {\n} else if (c) {\n}\n"),
        ("\ufeffskip \r\n;\rfire;", "skip;\nfire;\n"),
        ("print 0.50;print\t00.0;", "print 0.5;\nprint 0;\n"),
    ],
)
def test_tokens_are_laid_out_anew(text: str, normal: str) -> None:
    assert formatted(text) == normal


@pytest.mark.parametrize(
    ("text", "normal"),
    [
        # Behind a statement, a `{`, a `}`.
        ("fire;// c \t", "fire;  // c\n"),
        ("fire; skip; ; // c", "fire;\nskip;  // c\n"),
        ("while (b) {// c\nskip}// d", "while (b) {  // c\n  skip;\n}  // d\n"),
        # On lines of their own.
        ("// c", "// c\n"),
        ("//c\r\n  //d\rfire;\n  // e", "//c\n//d\nfire;\n// e\n"),
        ("while b{\n//c\nskip\n//d\n}", "while (b) {\n  //c\n  skip;\n  //d\n}\n"),
        ("while b{\n//c\n}", "while (b) {\n  //c\n}\n"),
        ("fire\n; skip\n; // c", "fire;\nskip;  // c\n"),
        ("fire;\n; // c", "fire;\n// c\n"),
        # Inside statements and heads.
        ("x := 1 // c\n + // d\n2; // e", "// c\n// d\nx := 1 + 2;  // e\n"),
        ("fire // c\n;", "// c\nfire;\n"),
        ("skip // c\n", "skip;  // c\n"),
        ("while b // c\n { // d\n}", "// c\nwhile (b) {  // d\n}\n"),
        ("while(b){foreach(any,// c\na){}}", "while (b) {\n  // c\n  foreach (any, a) {\n  }\n}\n"),
        # About `else`.
        ("if b {} // c\n else {}", "if (b) {\n}  // c\nelse {\n}\n"),
        ("if b {\n//b\n}\n\n // c\n\nelse {}", "if (b) {\n  //b\n}\n// c\nelse {\n}\n"),
        ("if b {} else // c\n{ // d\n}", "if (b) {\n}\n// c\nelse {  // d\n}\n"),
        ("if b {}\nelse if // c\n d {}", "if (b) {\n}\n// c\nelse if (d) {\n}\n"),
        # Beside the one `if` of an `else`.
        ("if b {} else { // c\nif d {}}", "if (b) {\n} else {  // c\n  if (d) {\n  }\n}\n"),
        ("if b {} else {if d {}\n//c\n}", "if (b) {\n} else {\n  if (d) {\n  }\n  //c\n}\n"),
        ("if b {} else {if d {}\n} //c", "if (b) {\n} else if (d) {\n}  //c\n"),
    ],
)
def test_comments_stay_where_they_can(text: str, normal: str) -> None:
    assert formatted(text) == normal
    assert formatted(normal) == normal


@pytest.mark.parametrize(
    ("text", "normal"),
    [
        ("\n\nfire;\n \t\n\n\nskip\n\n", "fire;\n\nskip;\n"),
        ("fire;\n;\nskip", "fire;\nskip;\n"),
        ("while b {\n\nfire;\n\n}\n\nskip", "while (b) {\n  fire;\n}\n\nskip;\n"),
        ("\n\n//c\n\n//d\n//e\n\nfire;", "//c\n\n//d\n//e\n\nfire;\n"),
        (
            "while b { //c\n\n//d\n\nfire;\n\n//e\n\n}",
            "while (b) {  //c\n  //d\n\n  fire;\n\n  //e\n}\n",
        ),
        ("fire;\n\nturn\n\n//c\n1;", "fire;\n\n//c\nturn 1;\n"),
        ("fire; //c\n\nskip", "fire;  //c\n\nskip;\n"),
        ("if b {\n}\n\nelse\n\n{}", "if (b) {\n} else {\n}\n"),
    ],
)
def test_of_empty_lines_between_statements_one_stays(text: str, normal: str) -> None:
    assert formatted(text) == normal
    assert formatted(normal) == normal


def test_a_text_with_syntax_errors_stays_as_it_is() -> None:
    assert formatted("fire  // c") == "fire  // c"


def test_comments_have_their_places() -> None:
    assert comments("a//b \r\n/// c\rd / //") == [
        Comment(1, 2, "//b"),
        Comment(2, 1, "/// c"),
        Comment(3, 5, "//"),
    ]


def test_a_tree_that_was_never_text_is_printed() -> None:
    program = Program(Block((Act("skip"), Act("fire"))))
    assert laid_out(program) == printed(program)
