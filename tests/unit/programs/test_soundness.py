"""What holds for every shipped program: it is in normal form, nothing in it is odd, and no game stops it."""

from __future__ import annotations

import pytest

from fasteroids import parse_program
from fasteroids.cli._files import shipped_programs
from fasteroids.lang.formatter import formatted
from fasteroids.lang.lint import warnings
from tests.unit.programs.playing import games

PROGRAMS = shipped_programs()


@pytest.mark.parametrize("name", PROGRAMS)
def test_each_is_in_normal_form_and_nothing_in_it_is_odd(name: str) -> None:
    tree = parse_program(PROGRAMS[name]).program
    assert tree is not None
    assert warnings(tree) == ()
    assert formatted(PROGRAMS[name]) == PROGRAMS[name]


@pytest.mark.parametrize("name", PROGRAMS)
def test_none_runs_out_of_fuel_or_is_stopped_in_whole_games(name: str) -> None:
    alone = games("field-storm", range(100, 108), name) + games("field-2013", range(100, 102), name)
    against = games("one-on-one", range(100, 104), name, "opponent-2013")
    for game in alone + against:
        assert (game.fuel, game.stopped) == (0, None)
