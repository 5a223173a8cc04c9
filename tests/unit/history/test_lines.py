"""Lines of history: chunks of kept states, gaps, and the hand that goes round."""

from __future__ import annotations

from fasteroids import Asteroid, World
from fasteroids.history import Lived, Place
from fasteroids.history.lines import Line, appended, begun, index_of, kept, thinned
from fasteroids.history.living import beginning, lived
from fasteroids.history.marks import wanted
from fasteroids.moments import clock_at


def line_of(seconds: float) -> Line:
    """An asteroid that meets a wall each second."""
    world = World(1_000, 120, model="smooth").add(Asteroid(500, 60, 0, 80, 20))
    first = beginning(world)
    return appended(begun("main", None, first), list(lived(first, clock_at(seconds))))


def states(line: Line) -> list[Lived]:
    return [each.state for each in kept(line, (0, 0), 1, None)]


def test_a_line_holds_its_states_in_order() -> None:
    line = line_of(300.25)
    assert len(line.chunks) > 2
    assert line.states == 302
    assert [s.place.time for s in states(line)] == [0.0, *(k + 0.5 for k in range(300)), 300.25]
    assert states(line)[::-1] == [
        each.state for each in kept(line, index_of(line, line.last.place), -1, None)
    ]


def test_a_place_is_found_by_the_last_state_that_is_not_after_it() -> None:
    line = line_of(300.25)
    for place in (
        Place(0, 0.0),
        Place(0, 0.49),
        Place(0, 0.5, 1),
        Place(0, 77.7),
        Place(0, 300.25),
    ):
        c, k = index_of(line, place)
        assert line.chunks[c].kept[k].state is [s for s in states(line) if s.place <= place][-1]


def test_chunks_without_what_is_wanted_are_passed_over() -> None:
    line = line_of(300.25)
    assert list(kept(line, (0, 0), 1, wanted("death"))) == []
    assert list(kept(line, (0, 0), 1, wanted("wall", 2))) == []
    assert len(list(kept(line, (0, 0), 1, wanted("wall", 1)))) == line.states


def test_thinning_leaves_no_more_than_so_many_happenings_to_a_gap() -> None:
    line = line_of(1_000.0)
    for _ in range(20):
        line = thinned(line, line.bytes // 4)
        gaps = [each.gap.size for each in kept(line, (0, 0), 1, None)]
        assert max(gaps) <= line.coarse
        assert sum(gaps) + len(gaps) in (1_001, 1_002), (
            "each happening is in a gap or kept, and the last cut"
        )
    assert line.states == 2


def test_thinning_by_nothing_drops_nothing() -> None:
    line = line_of(10.0)
    assert thinned(line, 0) == line
    assert thinned(line, -5) == line


def test_the_bytes_of_a_line_are_those_of_its_states_and_gaps() -> None:
    line = line_of(300.25)
    for _ in range(6):
        line = thinned(line, line.bytes // 3)
        found = [each for chunk in line.chunks for each in chunk.kept]
        assert line.bytes == sum(each.weight + each.gap.weight for each in found)
        assert all(each.gap.weight > 0 for each in found if each.gap.size)
