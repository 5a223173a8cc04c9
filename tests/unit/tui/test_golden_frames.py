"""The pictures in tests/golden/frames are what the camera draws today (`python tools/golden_frames.py` writes them)."""

from __future__ import annotations

import pytest
from golden_frames import FOLDER, frames

FRAMES = frames()


@pytest.mark.parametrize("name", sorted(FRAMES))
def test_a_golden_frame_is_current(name):
    assert (FOLDER / name).read_text("utf-8").splitlines() == FRAMES[name].splitlines()


def test_no_golden_frame_is_left_over():
    assert {file.name for file in FOLDER.iterdir()} == FRAMES.keys()


def test_ascii_frames_are_ascii():
    for name, text in FRAMES.items():
        assert text.isascii() is (".ascii." in name)
