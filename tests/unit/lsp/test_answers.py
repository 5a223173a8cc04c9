"""What the language server answers, part by part, on programs whole and half-typed. `|` marks the cursor."""

from __future__ import annotations

import re

import pytest

from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.front import diagnose
from fasteroids.lang.meanings import MEANINGS
from fasteroids.lang.source import Span
from fasteroids.lang.words import ACTIONS, KEYWORDS, KINDS, PUNCTUATION, TYPES
from fasteroids.lsp.completing import SNIPPETS, Completion, completions
from fasteroids.lsp.hovering import hover
from fasteroids.lsp.mending import fix_all, fixes, formatting, put_in
from fasteroids.lsp.navigating import Refused, definitions, mentions, renamed, symbols, variable_at
from fasteroids.lsp.reading import Place, Reading, faults


def marked(text: str) -> tuple[Reading, Place]:
    """A text without its `|`, and where that was."""
    before, after = text.split("|")
    row = before.rsplit("\n", 1)[-1]
    return Reading(before + after), (before.count("\n") + 1, len(row) + 1)


# Hover.


def shown(text: str) -> tuple[str, str] | None:
    found = hover(*marked(text))
    return (found.code, " ".join(found.sentences)) if found else None


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("turn ge|tx self * 2;", "getx self: double"),
        ("turn getx self |* 2;", "getx self * 2: double"),
        ("turn getx self *| 2;", "getx self * 2: double"),
        ("turn (1 - 2) |- 3;", "(1 - 2) - 3: double"),
        ("turn (1 |- 2) - 3;", "1 - 2: double"),
        ("turn |-(1 - 2);", "-(1 - 2): double"),
        ("bool b; b := |!b;", "!b: bool"),
        ("bool b; b := 1 |< 2 && true;", "1 < 2: bool"),
        ("bool b; b := nu|ll == self;", "null: entity"),
        ("turn get|dir;", "getdir: double"),
        ("turn 0.|5;", "0.5: double"),
        ("turn s|qrt(2);", "sqrt(2): double"),
        ("turn 1\n  |+ 2;", "e + e: double"),
        ("double d; d |:= 1;", "x := e;"),
        ("|while (true) { }", "while (e) { }"),
        ("whi|le", "while (e) { }"),
        ("entity a; foreach (aster|oid, a) { }", "foreach (asteroid, x) { }"),
        ("thrust|", "thrust;"),
        ("double d|;", "double d"),
        ("d := getx |a;", "entity a"),
        ("|a := b;", "a"),
    ],
)
def test_hover_shows_the_innermost_expression_or_how_a_word_is_used(text: str, code: str) -> None:
    found = shown(text)
    assert found is not None
    assert found[0] == code


def test_hover_says_what_a_word_means() -> None:
    for word in sorted(KEYWORDS):
        found = shown(f"{word}|")
        assert found is not None
        assert found[1] == MEANINGS[word].sentence


def test_hover_says_where_a_variable_is_declared_set_and_read() -> None:
    text = "double |d;\nd := 1;\nturn d;\nturn d;\nprint d;\n"
    assert shown(text) == (
        "double d",
        "Declared in line 1. Set in line 2. Read in lines 3, 4 and 5.",
    )
    assert shown("turn |x;") == ("double x", "Not declared. Never set. Read in line 1.")
    many = "double d|;\n" + "turn d;\n" * 9
    assert shown(many) == (
        "double d",
        "Declared in line 1. Never set. Read in lines 2, 3, 4, 5 and 5 more.",
    )


@pytest.mark.parametrize(
    "text", ["|", "fire;  |  ", "// fi|re", "fire; // a|b", "fire; @|@", *(f"{p}|" for p in PUNCTUATION if p != ":=")]
)  # fmt: skip
def test_hover_is_silent_where_nothing_is_to_be_said(text: str) -> None:
    assert shown(text) is None


# Completion.


def offered(text: str, typed: str = "") -> list[str]:
    return [each.label for each in completions(*marked(text), typed=typed)]


VARIABLES = "bool b; double d; entity e; "


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("turn getx |", ["e", "self"]),
        ("turn getx (|", ["e"]),
        ("turn |", ["d", "getdir", "getx"]),
        ("turn sqrt(|", ["d", "getdir"]),
        ("turn d * |", ["d", "getdir"]),
        ("d := |", ["d", "getdir"]),
        ("e := |", ["e", "null", "self"]),
        ("b := |", ["b", "d", "e", "true", "false"]),
        ("if (|", ["b", "d", "e", "true"]),
        ("if (b && |", ["b"]),
        ("if (e == |", ["e", "null", "self"]),
        ("if (getx e == |", ["d", "getdir"]),
        ("if (d < |", ["d"]),
        ("print |", ["b", "d", "e"]),
        ("foreach (|", list(KINDS)),
        ("foreach (as|", list(KINDS)),
        ("foreach (any, |", ["e"]),
        ("if (b) { } else |", ["if"]),
        ("if (b) { } |", ["else", "b"]),
        ("if (b) { } el|", ["else", "b"]),
        ("fire;\n|", ["b", "d", "e", "if", "while", "foreach", "print", *ACTIONS, *TYPES]),
        ("skip |", ["b", "d"]),
        ("d := 1\n|", ["b", "d", "e", "if"]),
        ("d := gety e\n  fi|", ["b", "d", "e", "if"]),
        ("d :=\n  |", ["d", "getdir"]),
    ],
)
def test_completion_offers_first_what_fits(text: str, first: list[str]) -> None:
    assert offered(VARIABLES + text)[: len(first)] == first


@pytest.mark.parametrize(
    "text",
    ["turn 1|", "turn 1.|", "turn d |", "// fi|", "fire; // |", "fire |", "foreach |", "turn 2x|", "double |"],
)  # fmt: skip
def test_completion_offers_nothing_where_no_word_can_stand(text: str) -> None:
    assert offered(VARIABLES + text) == []


def test_completion_offers_no_action_inside_a_for_each_and_no_entity_for_what_is_none() -> None:
    inside = offered("entity a; foreach (any, a) { | }")
    assert "print" in inside
    assert not set(inside) & set(ACTIONS)
    assert offered("double d; turn getx |") == ["self"]
    assert set(ACTIONS) <= set(offered("entity a; foreach (any, a) { } |"))


def test_completion_offers_no_second_else() -> None:
    assert "else" not in offered("if (true) { } | else { }")
    assert "else" not in offered("while (true) { } |")


def test_completion_does_not_offer_the_word_that_is_being_typed() -> None:
    assert "nea" not in offered("nea|")
    assert "nea" in offered("nea := 1; nea|")


def test_completion_offers_names_that_lack_a_declaration_behind_a_type() -> None:
    text = "entity | turn getx a + b;"
    assert offered(text) == ["a", "b"]


def test_a_blank_or_bracket_just_typed_asks_for_no_statement() -> None:
    assert offered("fire; |", " ") == []
    assert offered("entity a; turn getx |", " ") == ["a", "self"]


def best(text: str, label: str) -> Completion:
    return next(each for each in completions(*marked(text)) if each.label == label)


def test_completion_replaces_the_part_of_a_word_before_the_cursor() -> None:
    assert best("fire; thr|ust", "thrust").span == Span(1, 7, 1, 10)
    assert best("fire; |", "thrust").span == Span(1, 7, 1, 7)


def test_completion_does_not_double_a_semicolon() -> None:
    assert best("fi|;", "fire").plain == "fire"
    assert best("fi|", "fire").plain == "fire;"
    assert best("tu| ;", "turn").snippet == "turn ${1:0.1}"
    assert best("fi|\n;", "fire").plain == "fire;"


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("pri|nt x;", "print"),
        ("turn| -1;", "turn"),
        ("turn s|qrt(2);", "sqrt"),
        ("turn sq| (2);", "sqrt"),
        ("i| (a) { fire; }", "if"),
        ("whi|le true { fire; }", "while"),
        ("fore|ach (any, a) { }", "foreach"),
        ("if (a) { } els| { }", "else"),
        ("if (a) { } els| if (b) { }", "else"),
        ("doub|le d;", "double"),
        ("double| d := 1;", "double"),
    ],
)
def test_completion_fills_nothing_in_that_is_there_already(text: str, word: str) -> None:
    found = best(text, word)
    assert (found.snippet, found.plain) == (word, word)


@pytest.mark.parametrize("text", ["fi| x := 1;", "fi| // on", "fi| }", "fi| skip;", "fi|\n(1)"])
def test_completion_ends_a_statement_before_another_one(text: str) -> None:
    assert best(text, "fire").plain == "fire;"
    assert best(text, "turn").snippet == "turn ${1:0.1};"


@pytest.mark.parametrize("word", SNIPPETS)
def test_a_snippet_filled_in_with_what_it_suggests_is_right(word: str) -> None:
    snippet = re.sub(r"\$\{[0-9]\|(\w+)[^}]*\}", r"\1", SNIPPETS[word])
    snippet = re.sub(r"\$\{[0-9]:([^}]*)\}", r"\1", snippet)
    if word in MEANINGS and MEANINGS[word].usage.endswith((";", "}")):
        text = snippet.replace("$0", "")
    else:
        text = f"turn {snippet.replace('$1', '0')};"
    text = f"if (true) {{ }} {text}" if word == "else" else f"entity a; {text}"
    assert diagnose(text) == ()


def test_whoever_knows_no_snippets_gets_the_word_alone() -> None:
    assert best("|", "while").plain == "while"
    assert best("|", "fire").plain == "fire;"


# Names.


def test_a_variable_is_found_from_each_of_its_places() -> None:
    text = "entity a;\nforeach (any, a) {\n  print getx a;\n}\n"
    places = [Span(1, 8, 1, 9), Span(2, 15, 2, 16), Span(3, 14, 3, 15)]
    for span in places:
        for place in (span.start, span.end):
            found = mentions(Reading(text), place)
            assert [each.span for each in found] == places
            assert [each.sets for each in found] == [False, True, False]
            assert [each.declares for each in found] == [True, False, False]
            assert definitions(Reading(text), place) == places[:1]


def test_places_that_could_not_be_parsed_count_too() -> None:
    text = "double d; ) d ( d ? d"
    assert len(mentions(Reading(text), (1, 8))) == 4


@pytest.mark.parametrize("text", ["fi|re;", "// d|", "|", "turn 1|;", "double d; d := 1; // |d"])
def test_what_is_no_variable_has_no_places(text: str) -> None:
    assert mentions(*marked(text)) == []
    assert definitions(*marked(text)) == []
    assert isinstance(variable_at(*marked(text)), Refused)


def test_the_outline_has_all_of_a_declaration_and_its_name() -> None:
    (one, two) = symbols(Reading("double d := 1;\nif (true) { entity e; }"))
    assert (one.name, one.type, one.span, one.name_span) == (
        "d",
        "double",
        Span(1, 1, 1, 15),
        Span(1, 8, 1, 9),
    )
    assert (two.name, two.type) == ("e", "entity")


def test_a_new_name_is_put_in_everywhere() -> None:
    reading, place = marked("double |d; d := d + 1; // d\nturn d;")
    edits = renamed(reading, place, "angle")
    assert not isinstance(edits, Refused)
    assert put_in(reading.text, edits) == "double angle; angle := angle + 1; // d\nturn angle;"
    assert renamed(reading, place, "d") == ()


@pytest.mark.parametrize(
    ("new", "reason"),
    [
        ("while", "`while` is a word of the language, and no variable may have its name"),
        ("e", "`e` is another variable already"),
        ("", "`` is no name"),
        ("2x", "`2x` is no name"),
        ("a b", "`a b` is no name"),
        (" a", "` a` is no name"),
        ("a//", "`a//` is no name"),
        ("größe", "`größe` is no name"),
        ("_a", "`_a` is no name"),
        ("\ufeffa", "`\\ufeffa` is no name"),
    ],
)
def test_a_name_that_cannot_be_is_refused_with_a_sentence(new: str, reason: str) -> None:
    refused = renamed(*marked("double |d; entity e; turn d;"), new)
    assert isinstance(refused, Refused)
    assert refused.reason.startswith(reason)


# Mending.


def test_fixes_are_those_of_the_faults_that_a_piece_touches() -> None:
    reading = Reading("double d;\nd = 1;\nturn d\n")
    assert [fix.fault.code for fix in fixes(reading, Span(2, 1, 2, 2))] == []
    (fix,) = fixes(reading, Span(2, 3, 2, 3))
    assert put_in(reading.text, fix.edits) == "double d;\nd := 1;\nturn d\n"
    assert len([*fixes(reading, Span(1, 1, 4, 1))]) == 2


def test_all_fixes_are_put_in_until_none_is_left() -> None:
    reading = Reading("double d;\r\nentity e\r\nd = 1;\r\nturn d\r\n")
    (edit,) = fix_all(reading)
    after = put_in(reading.text, [edit])
    assert after == "double d;\r\nd := 1;\r\nturn d;\r\n"
    assert faults(after) == ()
    assert fix_all(Reading(after)) == ()


@pytest.mark.parametrize(
    ("text", "edit"),
    [
        ("fire;", Edit(Span(1, 1, 1, 6), "fire;\n")),
        ("fire;\nskip", Edit(Span(2, 1, 2, 5), "skip;\n")),
        ("fire;\n\n\n\nfire;\n", Edit(Span(3, 1, 5, 1), "")),
        ("fire;\r\nskip\r\nfire;\r\n", Edit(Span(2, 1, 3, 1), "skip;\r\n")),
        ("fire;\rskip\rfire;\r", Edit(Span(2, 1, 3, 1), "skip;\r")),
        ("\n\n", Edit(Span(1, 1, 3, 1), "")),
        ("fire; skip; // one", Edit(Span(1, 1, 1, 19), "fire;\nskip;  // one\n")),
    ],
)
def test_formatting_changes_the_lines_that_differ_and_keeps_line_ends(
    text: str, edit: Edit
) -> None:
    assert formatting(Reading(text)) == (edit,)
    assert formatting(Reading(put_in(text, [edit]))) == ()


@pytest.mark.parametrize("text", ["", "fire", "if(true){", "fire;\r\nskip;\r\n", "fire;\n"])
def test_formatting_leaves_alone_what_is_broken_or_in_normal_form(text: str) -> None:
    assert formatting(Reading(text)) == ()
