"""Why somebody died: the contact, the flights that led to it, what the ships had done."""

from __future__ import annotations

from math import pi

import pytest

from fasteroids import Fire, ModelError, Skip, Turn
from fasteroids.entities import id_of
from fasteroids.history import Death, Timeline, begin, next_state, why
from tests.unit.history.pasts import fought, states
from tests.unit.making import machine, rock, ship, shot, world_of


def rammed() -> Timeline:
    """A rock bounces off another at 1 s, and then meets the ship, which turned at 0.5 s and skipped since."""
    world = world_of(
        ship(900.0, 500.0, name="red"),
        rock(200.0, 500.0, 100.0),
        rock(340.0, 500.0),
    )
    timeline = begin(world).evolve(0.5).act(1, Turn(1.0)).evolve(1.0).act(1, Skip())
    return timeline.evolve(8.0)


def test_a_ship_dies_of_a_contact_fixed_since_a_bounce() -> None:
    death = why(rammed(), 1)
    assert death.how == "contact"
    assert (death.entity.name, death.partners) == ("red", (3,))
    mine, other = death.courses
    assert (mine.began, mine.since.time) == (None, 0.0)
    bounce = next_state(rammed(), 0.0, "contact")
    assert bounce is not None
    assert other.began is not None
    assert other.began.place == bounce.place == death.inevitable
    assert death.time > death.inevitable.time == 1.0
    assert [(d.ship, d.action, d.state.place.time) for d in death.deeds] == [(1, "turn", 0.5)]
    assert death.shots == ()
    assert str(death).splitlines() == [
        "ship 'red' died at 6.3 s in a contact with asteroid #3",
        "  it was fixed from 1.0 s on: neither flight changed after that",
        "  the flight of ship 'red' began at 0.0 s: the past begins",
        "  the flight of asteroid #3 began at 1.0 s: t=1 contact #2 and #3, bounce",
        "  ship #1 did last: turn at 0.5 s",
    ]


def test_who_died_is_shown_where_it_died() -> None:
    death = why(rammed(), 1)
    one, other = (course.entity for course in death.courses)
    assert one.x - other.x == pytest.approx(one.radius + other.radius)


def test_it_is_not_fixed_before_the_later_flight_began_but_from_then_on() -> None:
    """Whoever changes a flight after that place changes the death; nobody did."""
    timeline = fought()
    for state in states(timeline):
        for entity in state.died:
            death = why(timeline, entity)
            after = [s for s in states(timeline) if death.inevitable < s.place < death.place]
            flights = [
                [s.world.flight_of(id_of(c.entity)).entity.velocity for c in death.courses]
                for s in after
                if all(c.entity.id in s.world for c in death.courses)
            ]
            assert all(f == flights[0] for f in flights)


def test_a_bullet_names_the_ship_that_fired_it() -> None:
    text = "turn 0.0; fire; while (true) { skip; }"
    world = world_of(ship(100.0, 500.0, program=machine(text)), rock(800.0, 500.0))
    timeline = begin(world).evolve(6.0)
    for entity in (2, 3):
        death = why(timeline, entity)
        assert death.how == "contact"
        (fired,) = death.shots
        assert (fired.ship, fired.action) == (1, "fire")
        assert fired.state.place.time == pytest.approx(0.4)
        assert str(fired) == "fire at 0.4 s (line 1)"
        assert [(d.ship, d.action) for d in death.deeds] == [(1, "fire")]
        assert death.inevitable == fired.state.place
        assert "ship #1 fired: fire at 0.4 s" in str(death)


def test_a_bullet_of_the_first_world_was_fired_by_nobody_known() -> None:
    world = world_of(ship(100.0, 500.0), shot(300.0, 500.0, 250.0, source=1), rock(800.0, 500.0))
    death = why(begin(world).evolve(4.0), 2)
    assert death.shots == ()
    assert death.deeds == ()


def test_a_bullet_dies_at_its_second_wall() -> None:
    timeline = begin(world_of(ship(500.0, 500.0, direction=pi / 4))).act(1, Fire()).evolve(20.0)
    death = why(timeline, 2)
    assert (death.how, death.partners) == ("wall", ())
    assert len(death.courses) == 1
    assert death.inevitable == next_state(timeline, 0.0, "wall", 2).place  # type: ignore[union-attr]
    assert [s.state.place.time for s in death.shots] == [0.0]
    assert "at its second wall" in str(death)


def standing() -> tuple[Timeline, Timeline]:
    """A ship fires at 1 s where a rock is, by hand and by program."""
    by_hand = world_of(ship(500.0, 500.0), rock(534.0, 500.0))
    program = machine("skip; skip; skip; skip; fire;")
    by_program = world_of(ship(500.0, 500.0, program=program), rock(534.0, 500.0))
    return begin(by_hand).evolve(1.0).act(1, Fire()).evolve(1.0), begin(by_program).evolve(2.0)


@pytest.mark.parametrize("which", [0, 1])
def test_what_stands_where_a_bullet_is_fired_dies_of_the_shot(which: int) -> None:
    timeline = standing()[which]
    rocks, bullet = why(timeline, 2), why(timeline, 3)
    for death, other in ((rocks, 3), (bullet, 2)):
        assert (death.how, death.partners, death.time) == ("shot", (other,), 1.0)
        assert death.inevitable == death.place
        assert [(s.ship, s.state) for s in death.shots] == [(1, death.state)]
        assert [(d.ship, d.action, d.state) for d in death.deeds] == [(1, "fire", death.state)]
    assert bullet.entity.position == (513.0, 500.0)
    assert "of a shot, with bullet #3" in str(rocks)


def test_every_death_of_a_fight_is_explained_thinned_or_not() -> None:
    timeline, thinned = fought(), fought(budget=0)
    died = [i for s in states(timeline) for i in s.died]
    assert len(died) > 6
    for entity in died:
        death = why(timeline, entity)
        assert isinstance(death, Death)
        assert death.state.died.count(entity) == 1
        assert death.inevitable <= death.place
        again = why(thinned, entity)
        assert str(death) == str(again)
        assert (death.how, death.place, death.entity) == (again.how, again.place, again.entity)
        assert [c.since for c in death.courses] == [c.since for c in again.courses]


def test_a_death_before_a_branch_is_explained_from_the_branch() -> None:
    timeline = rammed()
    branch = timeline.branch(8.0).evolve(1.0)
    assert why(branch, 1) == why(timeline, 1)
    early = timeline.branch(2.0).evolve(1.0)
    with pytest.raises(ModelError, match=r"ship 'red' is alive at 3\.0 s"):
        why(early, 1)


def test_who_did_not_die_has_no_death() -> None:
    timeline = rammed()
    with pytest.raises(ModelError, match="asteroid #2 is alive at"):
        why(timeline, 2)
    with pytest.raises(ModelError, match=r"#2 did not die; it was taken out at 9\.5 s"):
        why(timeline.remove(2), 2)
    with pytest.raises(ModelError, match="ids in this past go from 1 to 3"):
        why(timeline, 4)
    skipped = timeline.add(rock(100.0, 100.0, id=9))
    with pytest.raises(ModelError, match="there was no entity #5 in this past"):
        why(skipped, 5)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "entity e; turn 1; turn getx e;",
            "  the program of ship #1 had stopped at 0.4 s: line 1: getx null: e is null",
        ),
        ("skip; turn 1;", "  the program of ship #1 had stopped at 0.4 s: it came to its end"),
    ],
)
def test_a_program_that_had_stopped_is_told(text: str, told: str) -> None:
    pilot = ship(900.0, 500.0, program=machine(text))
    death = why(begin(world_of(pilot, rock(200.0, 500.0, 100.0))).evolve(10.0), 1)
    assert [state.place.time for state in death.stops] == [0.4]
    assert str(death).splitlines()[-1] == told
    running = ship(900.0, 500.0, program=machine("while (true) { skip; }"))
    assert why(begin(world_of(running, rock(200.0, 500.0, 100.0))).evolve(10.0), 1).stops == ()
