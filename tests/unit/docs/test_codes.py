"""docs/codes.md: what `tools/codes_page.py` writes of the table that `fasteroids explain` reads.

That each wrong program has just its fault, and each right one none, is tested with the table.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from codes_page import page

from fasteroids.lang.codes import CODES

PAGE = Path(__file__).parents[3] / "docs" / "codes.md"
SECTIONS = re.split(r"^### ", page(), flags=re.MULTILINE)[1:]


def test_the_page_in_the_repository_is_what_the_table_gives() -> None:
    assert PAGE.read_text(encoding="utf-8") == page()


def test_every_code_has_its_section_in_the_order_of_the_table() -> None:
    assert [section.partition("\n")[0] for section in SECTIONS] == [*CODES]


@pytest.mark.parametrize(("name", "section"), [*zip(CODES, SECTIONS, strict=True)], ids=[*CODES])
def test_a_section_says_all_there_is_and_shows_both_programs_whole(name: str, section: str) -> None:
    code = CODES[name]
    assert code.why in section
    programs = re.findall(r"^```fasteroids\n(.*?)\n```$", section, re.DOTALL | re.MULTILINE)
    assert programs == [code.wrong, code.right]


@pytest.mark.parametrize("name", CODES)
def test_the_words_of_the_table_mean_nothing_to_markdown(name: str) -> None:
    """They are written for a terminal. Code in them stands between backticks, which come in pairs."""
    words = re.sub("`[^`]+`", "", f"{CODES[name].title}. {CODES[name].why}")
    assert re.findall(r"[`_<>\[\]#|~\\]|[*](?! )", words) == []
