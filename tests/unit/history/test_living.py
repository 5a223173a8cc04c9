"""The loop that lives a past, the first time and again."""

from __future__ import annotations

import pytest

from fasteroids import Asteroid, Fire, ModelError, Ship, Turn, World, evolve_until, happenings
from fasteroids.history import Act, Add, Cut, Given, Lived, Place, Remove, Told
from fasteroids.history.living import answered, beginning, cuts_decide, lived, relived
from fasteroids.moments import clock_at


def two_bounces() -> World:
    """Two asteroids, each between its own walls: both meet a wall at 1 s, and again at 2.6 s."""
    return World(200, 200).add_all(
        [Asteroid(80, 50, -60, 0, 20), Asteroid(120, 150, 60, 0, 20)],
    )


# Places.


def test_places_order_as_they_are_lived() -> None:
    places = [Place(0, 0.0), Place(0, 0.0, 1), Place(0, 0.5), Place(0, 0.5, 1), Place(1, 0.0)]
    assert sorted(places, reverse=True)[::-1] == places
    assert Place(1, 0.5).time == 1024.5


def test_a_place_counts_what_happens_at_one_moment() -> None:
    place = Place(0, 1.0, 2)
    assert place.after((0, 1.0)) == Place(0, 1.0, 3)
    assert place.after((0, 1.5)) == Place(0, 1.5, 1)
    assert place.reaching((0, 1.0)) is place
    assert place.reaching((0, 1.5)) == Place(0, 1.5, 0)


# Living.


def test_it_gives_every_event_and_the_cut_at_the_end() -> None:
    world = two_bounces()
    states = list(lived(beginning(world), clock_at(2.0)))
    events = [(what, after) for what, after in happenings(world, 2.0)]
    assert [(s.what, s.world) for s in states[:-1]] == events
    assert [s.place for s in states] == [Place(0, 1.0, 1), Place(0, 1.0, 2), Place(0, 2.0, 0)]
    assert states[-1].what == Cut(clock_at(2.0))
    assert states[-1].world == evolve_until(world, 2.0)


def test_an_input_tells_who_died_and_who_was_born_of_it() -> None:
    start = beginning(two_bounces())
    added = answered(start, Add(Asteroid(100, 100, 0, 0, 10)))
    assert added.what == Told(Add(Asteroid(100, 100, 0, 0, 10)), (), (3,))
    removed = answered(added, Remove(1))
    assert (removed.died, removed.born) == ((1,), ())
    assert [added.place.nth, removed.place.nth] == [1, 2]
    with pytest.raises(ModelError, match="no entity with id 1"):
        answered(removed, Remove(1))


def test_a_cut_as_an_input_leads_to_its_clock() -> None:
    world = two_bounces()
    state = answered(beginning(world), Cut(clock_at(1.5)))
    assert state.world == evolve_until(world, 1.5)
    assert state.place == Place(0, 1.5)


def test_inputs_come_again_at_their_places_between_two_events_of_one_moment() -> None:
    world = two_bounces()
    givens = [Given(Place(0, 1.0, 1), Remove(2))]
    states = list(relived(beginning(world), givens, clock_at(2.0)))
    assert [type(s.what).__name__ for s in states] == ["Happened", "Told"]
    assert [s.place for s in states] == [Place(0, 1.0, 1), Place(0, 1.0, 2)]
    late = [Given(Place(0, 1.0, 2), Remove(2))]
    assert len(list(relived(beginning(world), late, clock_at(2.0)))) == 3


def test_inputs_at_one_place_come_in_order() -> None:
    ship = Ship(500, 500, 0, 0, 20, 5e15, 0.0)
    world = World(1_000, 1_000).add(ship)
    acts = [Given(Place(0, 0.5, n), Act(1, Turn(a))) for n, a in enumerate([1.0, 0.5])]
    acts.append(Given(Place(0, 0.5, 2), Act(1, Fire())))
    *_, last = relived(beginning(world), acts, clock_at(1.0))
    (bullet,) = last.world.bullets
    assert last.place.nth == 3
    assert last.world.ships[0].direction == 1.5
    assert bullet.vx == pytest.approx(250 * 0.0707, rel=1e-2)


def test_an_input_comes_even_if_fewer_events_lead_to_its_place_than_before() -> None:
    givens = [Given(Place(0, 1.0, 5), Remove(2)), Given(Place(0, 1.2), Remove(1))]
    states = list(relived(beginning(two_bounces()), givens, clock_at(2.0)))
    assert [s.place for s in states if isinstance(s.what, Told)] == [
        Place(0, 1.0, 3),
        Place(0, 1.2, 1),
    ]


def test_the_last_state_is_brought_to_the_clock_that_was_asked_for() -> None:
    past = relived(beginning(two_bounces()), [], clock_at(1.5))
    while True:
        try:
            next(past)
        except StopIteration as stop:
            last: Lived = stop.value
            break
    assert last.world == evolve_until(two_bounces(), 1.5)
    assert last.place == Place(0, 1.5)


@pytest.mark.parametrize(("model", "decide"), [("robust", True), ("spec", True), ("smooth", False)])
def test_cuts_decide_under_literal_thrust_alone(model: str, decide: bool) -> None:
    assert cuts_decide(World(10, 10, model=model)) is decide
