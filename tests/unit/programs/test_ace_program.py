"""The shipped ace is what `tools/ace_program.py` writes, and what that writes for each slot it writes for all."""

from __future__ import annotations

import re

import pytest
from ace_program import PARTS, SLOTS, TEMPLATE, chosen, each, nested, program

from fasteroids.cli._files import shipped_programs


def test_the_shipped_program_is_what_the_tool_writes() -> None:
    assert shipped_programs()["ace"] == program()


def test_the_template_has_a_place_for_each_part_and_no_other_places() -> None:
    places = re.findall(r"\{\{(.*?)\}\}", TEMPLATE.read_text(encoding="utf-8"))
    assert {*places} == {*PARTS}


def test_a_text_for_each_slot_names_every_slot_in_order() -> None:
    assert each("x# ").split() == [f"x{slot}" for slot in range(1, SLOTS + 1)]


def test_a_nested_text_stands_within_those_of_the_slots_before_it() -> None:
    assert nested("n > @", "x#;\n", last=2) == "if (n > 0.5) {\nx1;\nif (n > 1.5) {\nx2;\n}\n}\n"


@pytest.mark.parametrize("slot", range(1, SLOTS + 1))
def test_halving_finds_the_text_of_each_slot(slot: int) -> None:
    """Follow the comparisons as the program would with that number."""
    lines = chosen("n", "x#;\n").splitlines()
    while len(lines) > 1:
        limit = re.fullmatch(r"if \(n < (\d\.5)\) \{", lines[0])
        assert limit is not None
        depth = 0
        middle = 0
        for place, line in enumerate(lines):
            depth += line.startswith("if") - (line == "}")
            if line == "} else {" and depth == 1:
                middle = place
        lines = lines[1:middle] if slot < float(limit[1]) else lines[middle + 1 : -1]
    assert lines == [f"x{slot};"]
