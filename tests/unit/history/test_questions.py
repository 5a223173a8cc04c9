"""Questions to a past: next and previous, what happened to an entity, when something first held."""

from __future__ import annotations

from math import inf, nan, nextafter

import pytest

from fasteroids import Fire, Happened, ModelError, World, happenings
from fasteroids.history import (
    Lived,
    Place,
    Timeline,
    begin,
    events_of,
    first_time,
    last_time,
    next_state,
    previous_state,
)
from fasteroids.history.inputs import Act
from fasteroids.history.living import Told
from fasteroids.history.marks import Kind, is_of
from tests.unit.history.pasts import arena, fought, states
from tests.unit.making import rock, ship, world_of

KINDS: tuple[Kind, ...] = (
    "event", "contact", "wall", "tick", "input", "death", "birth", "shot", "print"
)  # fmt: skip


@pytest.fixture(scope="module")
def past() -> Timeline:
    return fought()


def chain(timeline: Timeline, kind: Kind, entity: int | None = None) -> list[Place]:
    """The places one comes to by asking for the next again and again."""
    found, place = [], timeline.first.place
    while (state := next_state(timeline, place, kind, entity)) is not None:
        place = state.place
        found.append(place)
    return found


def chain_back(timeline: Timeline, kind: Kind, entity: int | None = None) -> list[Place]:
    found, place = [], timeline.last.place.after(timeline.last.place.moment)
    while (state := previous_state(timeline, place, kind, entity)) is not None:
        place = state.place
        found.append(place)
    return found


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("entity", [None, 1, 2, 3, 8])
@pytest.mark.parametrize("budget", [None, 0])
def test_next_and_previous_go_through_all_of_a_kind(
    past: Timeline, kind: Kind, entity: int | None, budget: int | None
) -> None:
    wanted = [s.place for s in states(past) if is_of(s, kind, entity)]
    asked = past if budget is None else past.thin(budget)
    assert chain(asked, kind, entity) == wanted
    assert chain_back(asked, kind, entity) == wanted[::-1]


def test_the_past_asked_has_something_of_each_kind(past: Timeline) -> None:
    assert all(chain(past, kind) for kind in KINDS)
    assert past.thin(0).states < past.states / 2


def test_the_events_are_those_that_happen(past: Timeline) -> None:
    lived = [e for s in states(past) if isinstance(e := s.what, Happened)]
    alone = list(happenings(arena(), 2.9))
    assert lived[: len(alone)] == [happened for happened, _ in alone]


def twins() -> Timeline:
    """Two contacts at one moment, 1 s, and walls that are met later."""
    world = world_of(
        rock(100.0, 100.0, 30.0), rock(200.0, 100.0, -30.0),
        rock(100.0, 500.0, 30.0), rock(200.0, 500.0, -30.0),
    )  # fmt: skip
    return begin(world).evolve(2.0).evolve(4.0)


def test_a_time_is_a_whole_moment() -> None:
    timeline = twins()
    first = next_state(timeline, 0.5)
    assert first is not None
    assert first.place == Place(0, 1.0, 1)
    second = next_state(timeline, first.place)
    assert second is not None
    assert second.place == Place(0, 1.0, 2)
    back = previous_state(timeline, second.place)
    assert back is not None
    assert back.place == first.place
    after = next_state(timeline, 1.0)
    assert after is not None
    assert after.place > second.place
    assert previous_state(timeline, 1.0) is None
    late = previous_state(timeline, nextafter(1.0, 2.0))
    assert late is not None
    assert late.place == second.place


def test_there_is_nothing_behind_the_ends(past: Timeline) -> None:
    assert next_state(past, past.world.time) is None
    assert next_state(past, 1e9) is None
    assert previous_state(past, 0.0) is None
    assert previous_state(past, past.first.place) is None
    assert previous_state(past, 1e9) is not None


def test_to_be_taken_out_is_no_death() -> None:
    timeline = begin(world_of(rock(100.0, 100.0))).evolve(1.0).remove(1).evolve(1.0)
    assert next_state(timeline, 0.0, "death") is None
    taken = next_state(timeline, 0.0, "input", 1)
    assert taken is not None
    assert taken.died == (1,)


def test_a_cut_is_about_no_entity(past: Timeline) -> None:
    assert next_state(past, 0.0, "cut") is not None
    assert next_state(past, 0.0, "cut", 1) is None


def test_entities_whose_ids_share_a_mark_are_told_apart() -> None:
    world = world_of(rock(100.0, 100.0, -40.0), rock(100.0, 600.0, -10.0, id=1025))
    timeline = begin(world).evolve(20.0)
    for thin in (timeline, timeline.thin(0)):
        first, far = next_state(thin, 0.0, "wall", 1), next_state(thin, 0.0, "wall", 1025)
        assert when(first) == 2.0
        assert when(far) == 8.0


@pytest.mark.parametrize("at", [nan, -1.0, inf, "1"])
def test_what_is_no_time_is_refused(past: Timeline, at: float) -> None:
    with pytest.raises(ModelError, match="time"):
        next_state(past, at)
    with pytest.raises(ModelError, match="time"):
        previous_state(past, at)


def test_what_is_no_kind_or_no_id_is_refused(past: Timeline) -> None:
    with pytest.raises(ModelError, match="a kind is one of event, contact"):
        next_state(past, 0.0, "deaths")  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="by its id"):
        previous_state(past, 9.0, "death", "red")  # type: ignore[arg-type]


def test_all_that_happened_to_a_ship_and_what_it_did(past: Timeline) -> None:
    whats = [s.what for s in events_of(past, 1)]
    happened = [w for w in whats if isinstance(w, Happened)]
    assert all(1 in (*w.entities, *w.died, *w.born) for w in happened)
    assert {"tick", "wall"} <= {w.kind for w in happened}
    assert [w.what for w in whats if isinstance(w, Told)] == [Act(1, Fire())]
    places = [s.place for s in events_of(past, 1)]
    assert places == sorted(places)


def test_a_bullet_has_its_whole_life(past: Timeline) -> None:
    shot = next_state(past, 0.0, "shot")
    assert shot is not None
    (bullet,) = shot.born
    life = list(events_of(past, bullet))
    assert life[0].place == shot.place
    assert bullet in life[-1].died


@pytest.mark.parametrize("entity", [0, -1, 10**9, True, "1", None])
def test_an_id_that_never_was_is_refused(past: Timeline, entity: int) -> None:
    with pytest.raises(ModelError, match="ids in this past go from 1 to"):
        events_of(past, entity)


# When something holds.


def cruise() -> Timeline:
    """A ship that crosses 150 km at 5 s, and meets the wall at 89 s."""
    return begin(world_of(ship(100.0, 100.0, 10.0))).evolve(40.0).evolve(60.0)


def when(state: Lived | None) -> float:
    assert state is not None
    return state.place.time


def test_a_crossing_is_found_to_the_double() -> None:
    timeline = cruise()
    found = first_time(timeline, lambda w: w[1].x >= 150.0)
    assert found is not None
    assert found.what is None
    at = when(found)
    assert found.world == timeline.at(at)
    assert at == pytest.approx(5.0)
    assert timeline.at(at)[1].x >= 150.0 > timeline.at(nextafter(at, 0.0))[1].x


def test_the_last_time_is_found_to_the_double() -> None:
    timeline = cruise()
    at = when(last_time(timeline, lambda w: w[1].x < 150.0))
    assert at == pytest.approx(5.0)
    assert timeline.at(at)[1].x < 150.0 <= timeline.at(nextafter(at, 9.0))[1].x
    assert when(last_time(timeline, lambda w: w[1].x > 150.0)) == 100.0


def test_what_holds_at_the_start_or_the_end_is_found_there() -> None:
    timeline = cruise()
    found = first_time(timeline, lambda w: w[1].x > 120.0, after=7.5)
    assert found is not None
    assert (found.place, found.what) == (Place(0, 7.5), None)
    assert found.world == timeline.at(7.5)
    assert when(last_time(timeline, lambda w: w[1].x > 120.0, before=7.5)) == 7.5


def test_an_event_that_makes_it_true_is_the_answer() -> None:
    timeline = cruise()
    wall = next_state(timeline, 0.0, "wall")
    assert first_time(timeline, lambda w: w[1].vx < 0.0) == wall
    before = last_time(timeline, lambda w: w[1].vx > 0.0)
    assert when(before) == nextafter(when(wall), 0.0)


def test_what_holds_between_two_happenings_of_one_moment_is_found() -> None:
    timeline = twins()

    def between(world: World) -> bool:
        return sum(world[i].vx < 0.0 for i in (1, 3)) == 1

    for found in (first_time(timeline, between), last_time(timeline, between, before=2.0)):
        assert found is not None
        assert found.place == Place(0, 1.0, 1)


def test_a_stretch_is_searched_and_no_more() -> None:
    timeline = cruise()

    def here(world: World) -> bool:
        return bool(world[1].x >= 150.0)

    assert first_time(timeline, here, before=4.9) is None
    assert when(first_time(timeline, here, before=5.0)) == when(first_time(timeline, here))
    assert when(first_time(timeline, here, after=Place(0, 6.0), before=Place(0, 6.0))) == 6.0
    assert last_time(timeline, lambda w: w[1].x < 150.0, after=5.0) is None
    assert first_time(timeline, lambda _: False) is None
    assert last_time(timeline, lambda _: False) is None


def test_what_is_true_for_less_than_a_look_is_found_by_looking_closer() -> None:
    timeline = cruise()

    def narrow(world: World) -> bool:
        return bool(150.5 < world[1].x < 150.6)

    assert first_time(timeline, narrow) is None
    for found in (
        first_time(timeline, narrow, every=0.005),
        last_time(timeline, narrow, every=0.005),
    ):
        assert found is not None
        assert narrow(found.world)
    close = when(first_time(timeline, narrow, every=0.005))
    assert not narrow(timeline.at(nextafter(close, 0.0)))


def test_a_window_of_the_clock_is_no_hurdle() -> None:
    timeline = begin(world_of(ship(100.0, 100.0, 0.25))).evolve(3000.0)
    for x in (355.9, 356.0, 612.0, 612.5, 849.0):

        def beyond(world: World, x: float = x) -> bool:
            return world[1].x >= x

        for every in (1.0, 700.0, 5000.0):
            first = first_time(timeline, beyond, every=every)
            last = last_time(timeline, lambda w: not beyond(w), every=every)
            assert first is not None
            assert last is not None
            assert when(first) == pytest.approx((x - 100.0) / 0.25)
            assert first.world[1].x >= x > last.world[1].x
            assert (last.place.window, nextafter(last.place.offset, inf)) in (
                first.place[:2],
                (first.place.window - 1, first.place.offset + 1024.0),
            )


@pytest.mark.parametrize(
    ("after", "before"), [(5.0, 4.0), (101.0, None), (None, -1.0), (nan, None)]
)
def test_a_stretch_that_is_none_is_refused(after: float | None, before: float | None) -> None:
    with pytest.raises(ModelError):
        first_time(cruise(), lambda _: True, after=after, before=before)
    with pytest.raises(ModelError):
        last_time(cruise(), lambda _: True, after=after, before=before)


@pytest.mark.parametrize("every", [0.0, -1.0, nan, inf, 1e-300, "1"])
def test_an_interval_that_is_none_is_refused(every: float) -> None:
    with pytest.raises(ModelError, match="between two looks"):
        first_time(cruise(), lambda _: True, every=every)


def test_cuts_of_the_caller_change_no_answer() -> None:
    whole = begin(arena()).evolve(12.0)
    sliced = begin(arena())
    for _ in range(120):
        sliced = sliced.evolve(0.1)

    def near(world: World) -> bool:
        return 1 in world and any(abs(world[1].x - e.x) < 60.0 for e in world.asteroids)

    assert first_time(whole, near) == first_time(sliced, near)
    assert first_time(whole, near, after=2.5) == first_time(sliced, near, after=2.5)


def test_a_stretch_under_literal_thrust_starts_before_what_happens_at_its_start() -> None:
    world = world_of(ship(100.0, 500.0, 1.0, thruster=True), rock(500.0, 100.0, 0.0, -40.0))
    timeline = begin(world).evolve(4.0)
    wall = next_state(timeline, 0.0, "wall")
    assert wall is not None
    assert wall.place == Place(0, 2.0, 1)
    assert first_time(timeline, lambda w: w[2].vy > 0.0, after=2.0) == wall
    assert (
        first_time(timeline, lambda w: w[2].vy < 0.0, after=2.0, before=Place(0, 2.0)) is not None
    )


def test_a_look_under_literal_thrust_is_a_cut_as_in_at() -> None:
    timeline = begin(world_of(ship(100.0, 500.0, 1.0, thruster=True))).evolve(1.0)
    found = first_time(timeline, lambda w: w[1].vx >= 65.0)
    assert found is not None
    assert 0.0 < when(found) < 1.0
    assert found.world == timeline.at(when(found))
