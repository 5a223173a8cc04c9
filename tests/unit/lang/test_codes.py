"""The table of codes: `fasteroids.lang.codes`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fasteroids.lang.codes import CODES
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnose, mended
from fasteroids.lang.lint import warnings
from fasteroids.lang.parser import parse_program

LANG = Path(__file__).resolve().parents[3] / "fasteroids" / "lang"
PHASES = {"0": "syntax", "1": "type", "2": "lint"}


def found(name: str, text: str) -> tuple[Diagnostic, ...]:
    """The faults of a program, of the kind that a code is of: warnings only where it is one."""
    errors = diagnose(text)
    if errors or CODES[name].phase != "lint":
        return errors
    return warnings(parse_program(text).tree, course=name >= "FA211")


@pytest.mark.parametrize("name", CODES)
def test_the_wrong_program_has_just_this_fault_and_the_right_one_none(name: str) -> None:
    code = CODES[name]
    assert [each.code for each in found(name, code.wrong)] == [name]
    assert found(name, code.right) == ()


@pytest.mark.parametrize("name", CODES)
def test_what_is_offered_as_a_fix_mends_the_wrong_program(name: str) -> None:
    faults = found(name, CODES[name].wrong)
    if any(each.fix for each in faults):
        assert found(name, mended(CODES[name].wrong, faults)) == ()


@pytest.mark.parametrize("name", CODES)
def test_a_code_is_told_in_plain_words(name: str) -> None:
    code = CODES[name]
    assert re.fullmatch("FA[0-9]{3}", name)
    assert code.phase == PHASES[name[2]]
    assert code.title[0] == "`" or code.title[0].isupper()
    assert not code.title.endswith(".")
    assert code.why.endswith((".", ")"))
    assert code.wrong == code.wrong.strip()
    assert code.right == code.right.strip()


def test_every_code_in_use_is_in_the_table_and_the_other_way_round() -> None:
    sources = [
        path.read_text(encoding="utf-8") for path in LANG.rglob("*.py") if path.name != "codes.py"
    ]
    used = {code for text in sources for code in re.findall(r'"(FA[0-9]{3})"', text)}
    assert used == CODES.keys()
