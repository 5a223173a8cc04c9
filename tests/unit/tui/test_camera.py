"""The picture of a world: total for any world and size, true to scale, and readable without colours."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from math import inf, nan, pi, tau
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids import Asteroid, Bullet, ModelError, Ship, World, evolve, evolve_until
from fasteroids.engine import peek
from fasteroids.testing import worlds
from fasteroids.tui import palette
from fasteroids.tui.camera import DEATH_LASTS, ZOOMS, Death, Frame, Look, frame, viewport
from fasteroids.tui.canvas import SURFACES, canvas
from fasteroids.tui.overlay import overlay

ROOT = Path(__file__).resolve().parents[3]
ARENAS = sorted(SURFACES)
MAX = sys.float_info.max


def ship(x: float, y: float, direction: float = 0.0, r: float = 10.0, **fields: object) -> Ship:
    return Ship(x, y, 0.0, 0.0, r, 5e15, direction, **fields)  # type: ignore[arg-type]


def rock(x: float, y: float, r: float = 20.0) -> Asteroid:
    return Asteroid(x, y, 0.0, 0.0, r)


def colours(picture: Frame) -> set[int]:
    return {colour for row in picture.rows for _, _, colour in row.runs}


def cells(picture: Frame, colour: int) -> Iterator[tuple[int, int, str]]:
    """The cells of a colour that are not blank: column, row, sign."""
    for y, row in enumerate(picture.rows):
        for start, end, index in row.runs:
            if index == colour:
                yield from ((x, y, row.text[x]) for x in range(start, end) if row.text[x] != " ")


def checked(picture: Frame, columns: int, rows: int) -> None:
    """What every frame keeps: its size, runs in order, and a colour for every sign."""
    assert len(picture.rows) == rows
    for text, runs in picture.rows:
        assert len(text) == columns
        assert "\u2800" not in text
        at = 0
        for start, end, colour in runs:
            assert at <= start < end <= columns
            assert not text[at:start].strip()
            assert 0 < colour < len(palette.COLOURS)
            at = end
        assert not text[at:].strip()


# Total.


@pytest.mark.parametrize("arena", ARENAS)
@given(
    world=worlds(), columns=st.integers(0, 130), rows=st.integers(0, 50), zoom=st.sampled_from(ZOOMS),
    selected=st.integers(1, 4), age=st.floats(), place=st.floats(),
)  # fmt: skip
def test_any_world_has_a_picture_of_any_size(arena, world, columns, rows, zoom, selected, age, place):  # fmt: skip
    look = Look(
        arena=arena, zoom=zoom, selected=selected, overlay=overlay(world, None, 1.0, 5),
        deaths=(Death(place, 1.0, abs(age), 0.1), Death(5.0, place, 3.0, age)),
        trails=(((place, age), (1.0, 2.0)), ()), ghosts=world, centre=(place, age),
    )  # fmt: skip
    checked(frame(world, look, columns, rows), columns, rows)


SIZES = [0.0, 5e-324, 1e-300, 1e-3, 1.0, 1e12, MAX]


@pytest.mark.parametrize("arena", ARENAS)
@pytest.mark.parametrize("width", SIZES)
@pytest.mark.parametrize("height", SIZES)
def test_a_world_may_have_any_size_and_shape(arena, width, height):
    world = World(width, height)
    r = min(width, height) / 8.0
    if r > 0.0 and max(width, height) / 4.0 < MAX:
        world = world.add_all([ship(width / 4, height / 2, r=r), rock(width * 0.75, height / 2, r)])
    for zoom in ZOOMS:
        for selected in (None, 1):
            look = Look(arena=arena, zoom=zoom, selected=selected, ghosts=World(MAX, MAX))
            checked(frame(world, look, 80, 24), 80, 24)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e12, MAX])
def test_the_size_of_a_world_does_not_show(size):
    """Only the proportions do: the picture of a scaled world is the same."""
    share = 1.0 / 16.0
    one = World(16.0, 8.0).add_all([ship(4.0, 4.0, r=1.0), rock(12.0, 4.0, 2.0)])
    other = World(size, size / 2).add_all(
        [ship(size / 4, size / 4, r=size * share), rock(size * 0.75, size / 4, size * share * 2)]
    )
    assert frame(one, Look(), 80, 24) == frame(other, Look(), 80, 24)


def test_a_thousand_entities_fit():
    places = [(20.0 + 80.0 * (i % 49), 20.0 + 80.0 * (i // 49)) for i in range(1000)]
    world = World(4000, 3000).add_all(rock(x, y, 15.0) for x, y in places)
    for arena in ARENAS:
        checked(frame(world, Look(arena=arena), 120, 40), 120, 40)


def test_late_and_fast_is_in_sight_all_the_same():
    world = evolve_until(World(1e12, 1e12), 1e300)
    world = world.add(Asteroid(5e11, 5e11, 3e5, 0.0, 1e11)).add(ship(1e11, 1e11, r=1e10))
    for arena in ARENAS:
        picture = frame(evolve(world, 1e6), Look(arena=arena), 80, 24)
        assert {palette.ASTEROID, palette.player(0)} <= colours(picture)


@pytest.mark.parametrize("fields", [{"arena": "sixel"}, {"zoom": 3}, {"zoom": nan}, {"arena": 7}])
def test_a_look_that_makes_no_sense_is_refused_with_a_sentence(fields):
    with pytest.raises(ModelError, match="is one of"):
        Look(**fields)


def test_looking_leaves_the_predictions_of_a_world_where_they_are():
    world = evolve(World(1000, 700).add_all([ship(100, 100), rock(500, 500)]), 1.0)
    engine = peek(world)
    frame(world, Look(selected=1), 80, 24)
    assert engine is not None
    assert peek(world) is engine


# True to scale.


@pytest.mark.parametrize("arena", ARENAS)
@pytest.mark.parametrize(("columns", "rows"), [(80, 24), (60, 60), (200, 20)])
def test_a_square_world_is_square_and_in_the_middle(arena, columns, rows):
    walls = list(cells(frame(World(500, 500), Look(arena=arena), columns, rows), palette.WALL))
    left, right = min(x for x, _, _ in walls), max(x for x, _, _ in walls)
    top, bottom = min(y for _, y, _ in walls), max(y for _, y, _ in walls)
    assert abs((right - left + 1) - 2 * (bottom - top + 1)) <= 2
    assert abs(left - (columns - 1 - right)) <= 1
    assert abs(top - (rows - 1 - bottom)) <= 1


@pytest.mark.parametrize("arena", ARENAS)
def test_an_asteroid_touches_the_wall_it_touches(arena):
    world = World(1000, 1000).add(rock(100, 500, 100))
    picture = frame(world, Look(arena=arena), 100, 50)
    wall = min(x for x, _, _ in cells(picture, palette.WALL))
    assert min(x for x, _, _ in cells(picture, palette.ASTEROID)) - wall in (0, 1)


def test_up_is_up():
    picture = frame(World(100, 100).add(ship(50, 90, r=5)), Look(), 80, 24)
    assert next(cells(picture, palette.player(0)))[1] < 6


@pytest.mark.parametrize("arena", ARENAS)
@pytest.mark.parametrize("kind", [rock, ship, lambda x, y, r: Bullet(x, y, 0.0, 0.0, r, 9)])
def test_who_is_smaller_than_a_dot_is_seen_all_the_same(arena, kind):
    world = World(1e12, 1e12).add(kind(3e11, 3e11, r=1e-6))
    assert len(colours(frame(world, Look(arena=arena), 40, 12))) == 2


@pytest.mark.parametrize("zoom", ZOOMS)
def test_an_enlarged_view_shows_that_much_less(zoom):
    world, surface = World(1000, 1000), canvas("braille", 80, 40)
    view = viewport(world, Look(zoom=zoom), surface)
    assert view.length(1000.0) == pytest.approx(zoom * 158.0)
    assert view.place(500.0, 500.0) == (80.0, 80.0)


def test_an_enlarged_view_follows_the_selected_and_stops_at_the_walls():
    world, surface = World(1000, 1000).add_all([ship(400, 600), ship(950, 20)]), canvas("ascii", 80, 40)  # fmt: skip
    assert viewport(world, Look(zoom=4, selected=1), surface)[:2] == (400.0, 600.0)
    corner = viewport(world, Look(zoom=4, selected=2), surface)
    assert corner.place(1000.0, 0.0) == pytest.approx((79.0, 39.0))
    assert viewport(world, Look(zoom=2, selected=9), surface)[:2] == (500.0, 500.0)
    assert viewport(world, Look(zoom=2, centre=(490.0, 510.0)), surface)[:2] == (490.0, 510.0)


# Readable.


@pytest.mark.parametrize(
    ("eighth", "nose", "right", "down"),
    [(0, ">", 1, 0), (1, "/", 1, -1), (2, "^", 0, -1), (3, "\\", -1, -1),
     (4, "<", -1, 0), (5, "/", -1, 1), (6, "v", 0, 1), (7, "\\", 1, 1)],
)  # fmt: skip
def test_in_ascii_a_ship_is_a_letter_with_its_nose_where_it_faces(eighth, nose, right, down):
    for off in (-0.35, 0.0, 0.35):
        world = World(1000, 1000).add(ship(500, 500, eighth * pi / 4 + off))
        signs = {s: (x, y) for x, y, s in cells(frame(world, Look(), 80, 24), palette.player(0))}
        x, y = signs["A"]
        assert signs == {"A": (x, y), nose: (x + right, y + down)}


@pytest.mark.parametrize("arena", ARENAS)
def test_thrust_is_seen_behind_a_ship(arena):
    off = World(1000, 1000).add(ship(500, 500, tau / 4))
    on = World(1000, 1000).add(ship(500, 500, tau / 4, thruster=True))
    assert palette.FLAME not in colours(frame(off, Look(arena=arena), 80, 40))
    picture = frame(on, Look(arena=arena), 80, 40)
    below = min(y for _, y, _ in cells(picture, palette.FLAME))
    assert below >= max(y for _, y, s in cells(picture, palette.player(0)))


@pytest.mark.parametrize("rank", range(palette.PLAYERS))
@pytest.mark.parametrize("arena", ["braille", "block"])
def test_every_figure_points_where_its_ship_faces(arena, rank):
    """Facing four ways gives four pictures, and each reaches further out in front than behind."""
    seen = set()
    for quarter in range(4):
        world = World(1000, 1000).add(ship(500, 500, quarter * tau / 4, r=200.0))
        look = Look(arena=arena, players=(*range(100, 100 + rank), 1), tags=False)
        picture = frame(world, look, 120, 60)
        seen.add(picture.rows)
        if quarter == 0:
            right = max(x for x, _, _ in cells(picture, palette.player(rank)))
            left = min(x for x, _, _ in cells(picture, palette.player(rank)))
            assert right - 60 > 60 - left
    assert len(seen) == 4


@pytest.mark.parametrize("arena", ["braille", "block"])
def test_ships_differ_without_colours(arena):
    world = World(1000, 1000).add(ship(500, 500, r=60.0))
    texts = {
        str(frame(world, Look(arena=arena, players=(*range(100, 100 + rank), 1), tags=False), 120, 60))
        for rank in range(palette.PLAYERS)
    }  # fmt: skip
    assert len(texts) == palette.PLAYERS


@pytest.mark.parametrize("arena", ARENAS)
def test_a_death_changes_nobodys_colour_and_letter(arena):
    world = World(1000, 1000).add_all([ship(200, 500), ship(500, 500), ship(800, 500)])
    look = Look(arena=arena, players=(1, 2, 3))
    picture = frame(world.remove(1), look, 80, 24)
    assert {"B"} <= {s for _, _, s in cells(picture, palette.player(1))}
    assert {"C"} <= {s for _, _, s in cells(picture, palette.player(2))}
    assert palette.player(0) not in colours(picture)


def test_tags_can_be_left_out_where_figures_do_without():
    world = World(1000, 1000).add(ship(500, 500))
    assert "A" in str(frame(world, Look(arena="braille"), 80, 24))
    assert "A" not in str(frame(world, Look(arena="braille", tags=False), 80, 24))


@pytest.mark.parametrize("arena", ARENAS)
def test_a_ship_is_seen_before_a_ghost_and_an_explosion(arena):
    world = World(1000, 1000).add(ship(500, 500))
    others = World(1000, 1000).add(rock(510, 500))
    bare = list(cells(frame(world, Look(arena=arena), 80, 24), palette.player(0)))
    look = Look(arena=arena, ghosts=others, deaths=(Death(500, 500, 15, 0.1),))
    crowded = list(cells(frame(world, look, 80, 24), palette.player(0)))
    assert [cell[:2] for cell in crowded] == [cell[:2] for cell in bare]


def test_bullets_have_the_colour_of_their_ship():
    world = World(1000, 1000).add_all(
        [ship(100, 100), ship(900, 900), Bullet(500, 500, 0.0, 0.0, 3.0, 2), Bullet(300, 300, 0.0, 0.0, 3.0, 77)]
    )  # fmt: skip
    picture = frame(world, Look(), 80, 24)
    assert "*" in {s for _, _, s in cells(picture, palette.player(1))}
    assert [s for _, _, s in cells(picture, palette.BULLET)] == ["*"]


# What is drawn besides.


@pytest.mark.parametrize("arena", ARENAS)
def test_an_explosion_grows_and_is_over(arena):
    world = World(1000, 1000)

    def width(age: float) -> int:
        look = Look(arena=arena, deaths=(Death(500, 500, 60, age),))
        places = [x for x, _, _ in cells(frame(world, look, 160, 60), palette.EXPLOSION)]
        return max(places, default=0) - min(places, default=0)

    assert 0 < width(0.0) < width(DEATH_LASTS / 2) < width(DEATH_LASTS * 0.99)
    assert [width(age) for age in (-0.1, DEATH_LASTS, 100.0, inf, nan)] == [0] * 5


@pytest.mark.parametrize("arena", ARENAS)
def test_a_ghost_is_drawn_only_where_its_future_differs(arena):
    world = World(1000, 1000).add_all([Asteroid(500, 500, 100, 0, 40), ship(100, 100)])
    same, other = frame(world, Look(arena=arena, ghosts=world), 80, 24), evolve(world, 2.0)
    assert same == frame(world, Look(arena=arena), 80, 24)
    look = Look(arena=arena, ghosts=other)
    ghosts = list(cells(frame(world, look, 80, 24), palette.GHOST))
    assert min(x for x, _, _ in ghosts) > 40


@pytest.mark.parametrize("arena", ARENAS)
def test_a_predicted_meeting_is_marked_with_its_time(arena):
    world = World(1000, 1000).add(Ship(500, 500, 200.0, 0.0, 10.0, 5e15, 0.0))
    picture = frame(world, Look(arena=arena, overlay=overlay(world, None, 5.0)), 80, 24)
    assert "x" in str(picture)
    assert "2.5s" in str(picture) or "2.4s" in str(picture)
    assert palette.OVERLAY in colours(picture)


@pytest.mark.parametrize("arena", ARENAS)
def test_the_selected_is_in_brackets_with_its_id(arena):
    world = World(1000, 1000).add_all([rock(300, 500, 50), rock(700, 500, 50)])
    picture = str(frame(world, Look(arena=arena, selected=2), 80, 24))
    line = next(line for line in picture.splitlines() if "[" in line)
    assert "#2" in line[line.index("]") :]
    assert line.index("[") > 40


@pytest.mark.parametrize("arena", ARENAS)
def test_brackets_leave_a_ship_its_letter_and_its_flame(arena):
    world = World(1000, 1000).add(ship(500, 500, thruster=True))
    bare = frame(world, Look(arena=arena), 120, 40)
    bracketed = frame(world, Look(arena=arena, selected=1), 120, 40)
    assert set(cells(bare, palette.player(0))) == set(cells(bracketed, palette.player(0)))


@pytest.mark.parametrize("arena", ARENAS)
def test_trails_lie_where_bullets_flew(arena):
    look = Look(arena=arena, trails=(((100.0, 500.0), (400.0, 500.0)),))
    trail = list(cells(frame(World(1000, 1000), look, 82, 41), palette.TRAIL))
    assert {y for _, y, _ in trail} == {20}
    assert max(x for x, _, _ in trail) - min(x for x, _, _ in trail) in (23, 24)


# A value.


def test_the_same_moment_gives_the_same_frame_and_another_one_another():
    world = World(1000, 1000).add(Asteroid(500, 500, 100.0, 0.0, 40.0))
    assert frame(world, Look(), 80, 24) == frame(world, Look(), 80, 24)
    assert frame(evolve(world, 1.0), Look(), 80, 24) != frame(world, Look(), 80, 24)


def test_a_frame_prints_as_its_lines():
    picture = frame(World(10, 10), Look(), 6, 3)
    assert str(picture) == "".join(row.text + "\n" for row in picture.rows)
    assert str(picture).isascii()


def test_pictures_need_no_textual():
    code = (
        "import sys; sys.modules['textual'] = sys.modules['rich'] = None; "
        "from fasteroids.tui import camera, canvas, looks, overlay, palette"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
