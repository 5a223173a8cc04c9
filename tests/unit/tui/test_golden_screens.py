"""The pictures in tests/golden/screens are what the app shows today (`python tools/golden_screens.py` writes them)."""

from __future__ import annotations

import re

import pytest
from golden_screens import FOLDER, screens

SCREENS = screens()


@pytest.mark.parametrize("name", sorted(SCREENS))
def test_a_golden_screen_is_current(name: str) -> None:
    assert (FOLDER / name).read_text("utf-8").splitlines() == SCREENS[name].splitlines()


def test_no_golden_screen_is_left_over() -> None:
    assert {file.name for file in FOLDER.iterdir()} == SCREENS.keys()


def test_pictures_have_no_ids_of_their_own() -> None:
    for svg in SCREENS.values():
        assert not re.search(r"terminal-\d", svg)
        assert "Fasteroids" in svg
