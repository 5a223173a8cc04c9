"""A machine as text: the cursor and the frames."""

from __future__ import annotations

from fasteroids.lang.code import compiled
from fasteroids.lang.cursor import cursor, frames
from fasteroids.lang.machine import place, started
from fasteroids.lang.syntax import Act, Block, Program
from tests.unit.lang.running import loaded, stepped, to_the_end

TEXT = "double d;\nwhile (d < 3) {\n\td := d + 0.5;\n\tfire;\n}\n"


def test_the_cursor_walks_through_an_expression_in_evaluation_order() -> None:
    machine = stepped(loaded(TEXT), 4)  # d, 3, <, while
    marks = []
    for _ in range(4):
        line = cursor(machine, around=0).splitlines()[1]
        marks.append(line)
        machine = stepped(machine, 1)
    assert marks == [
        "  | \t     ^",
        "  | \t         ^^^",
        "  | \t     ^^^^^^^",
        "  | \t^^^^^^^^^^^^^",
    ]


def test_the_cursor_shows_the_lines_around_and_marks_the_first_of_many() -> None:
    machine = stepped(loaded(TEXT), 3)
    assert cursor(machine).splitlines() == [
        "1 | double d;",
        "2 | while (d < 3) {",
        "  | ^^^^^^^^^^^^^^^",
        "3 | \td := d + 0.5;",
    ]


def test_the_cursor_stands_behind_a_program_that_ended_and_on_what_got_stuck() -> None:
    ended, _ = to_the_end("print 1;")
    assert cursor(ended) == "1 | print 1;\n  |         ^"
    stuck, _ = to_the_end("entity a;\nprint getx a;")
    assert cursor(stuck, around=0) == "2 | print getx a;\n  |       ^^^^^^"


def test_lines_end_where_the_lexer_says_they_do() -> None:
    text = "// a\u2028b\r\nprint 1;\rprint 2;"
    assert cursor(loaded(text), around=0) == "2 | print 1;\n  |       ^"


def test_a_tree_that_was_never_text_has_a_cursor_too() -> None:
    machine = started(compiled(Program(Block((Act("skip"),)))))
    assert cursor(machine) == "1 |\n  | ^"


def test_frames_tell_the_line_and_what_waits() -> None:
    machine = stepped(loaded(TEXT), 6)
    assert frames(machine) == (
        "line 3, block 1, instruction 0: 2 of 3 nodes done, operands 0.0, 0.5",
        "line 2, block 0, instruction 0",
    )
    each = stepped(loaded("entity e;\nforeach (any, e) {\n  print 1;\n}"), 2)
    assert frames(each) == (
        "line 3, block 1, instruction 0: 1 of 1 nodes done, operands 1.0",
        "line 2, block 0, instruction 0: to visit asteroid 2, bullet 3, ship 4",
    )
    assert frames(to_the_end("print 1;")[0]) == ()


def test_place_is_the_statement_once_its_value_is_there() -> None:
    machine = stepped(loaded("print 1 + 2;"), 2)
    assert place(machine) == (1, 7, 1, 12)
    assert place(stepped(machine, 1)) == (1, 1, 1, 13)
