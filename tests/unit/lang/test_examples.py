"""The examples of the assignment (1.8, 1.8.1), from text to diagnostics to mended text."""

from __future__ import annotations

from pathlib import Path

import pytest

from fasteroids.lang.front import diagnose, mended
from fasteroids.lang.report import rendered

PROGRAMS = Path(__file__).resolve().parents[2] / "programs"
GOLDEN = Path(__file__).resolve().parents[2] / "golden" / "second-as-printed.txt"


def program(name: str) -> str:
    return (PROGRAMS / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["first.ast", "second-mended.ast"])
def test_examples_are_accepted(name: str) -> None:
    assert diagnose(program(name)) == ()


def test_the_second_example_as_printed_gets_all_its_faults_in_one_run() -> None:
    text = program("second-as-printed.ast")
    assert rendered(diagnose(text), text, "nearest.ast") + "\n" == GOLDEN.read_text(
        encoding="utf-8"
    )


def test_the_second_example_has_its_three_slips_of_text_and_four_of_type() -> None:
    found = diagnose(program("second-as-printed.ast"))
    syntax = [each for each in found if each.code < "FA100"]
    types = {each.span.line: each for each in found if each.code >= "FA100"}
    assert len(syntax) == 3
    assert {line: each.code for line, each in types.items()} == {
        4: "FA110", 13: "FA101", 14: "FA101", 15: "FA101",
    }  # fmt: skip
    assert [each.hint for each in types.values()] == [
        "Declare it `entity nearestAsteroid;`",
        "Declare it: add `double ax;`",
        "Declare it: add `double ay;`",
        "Declare it: add `double ar;`",
    ]


def test_the_offered_fixes_make_the_second_example_right() -> None:
    text = program("second-as-printed.ast")
    assert diagnose(mended(text, diagnose(text))) == ()
