"""The table of codes: `fasteroids.lang.codes`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fasteroids.lang.codes import CODES
from fasteroids.lang.front import diagnose, mended

LANG = Path(__file__).resolve().parents[3] / "fasteroids" / "lang"
PHASES = {"0": "syntax", "1": "type", "2": "lint"}


@pytest.mark.parametrize("name", CODES)
def test_the_wrong_program_has_just_this_fault_and_the_right_one_none(name: str) -> None:
    code = CODES[name]
    assert [each.code for each in diagnose(code.wrong)] == [name]
    assert diagnose(code.right) == ()


@pytest.mark.parametrize("name", CODES)
def test_what_is_offered_as_a_fix_mends_the_wrong_program(name: str) -> None:
    found = diagnose(CODES[name].wrong)
    if any(each.fix for each in found):
        assert diagnose(mended(CODES[name].wrong, found)) == ()


@pytest.mark.parametrize("name", CODES)
def test_a_code_is_told_in_plain_words(name: str) -> None:
    code = CODES[name]
    assert re.fullmatch("FA[0-9]{3}", name)
    assert code.phase == PHASES[name[2]]
    assert code.title
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
