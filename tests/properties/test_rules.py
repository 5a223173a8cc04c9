"""L10: bullets, deaths and children keep to the rules."""

from __future__ import annotations

from math import hypot, ulp

from hypothesis import given

from fasteroids import Asteroid, Bullet, Ship, World
from fasteroids.entities import Entity
from fasteroids.overlap import depth
from fasteroids.state import located
from fasteroids.testing import keeping, unfold
from fasteroids.units import MAX_BULLETS, SPLIT_RADIUS
from tests.properties.laws import BURNING, EVENTS, world_law

U = 2.0**-53


@world_law
@given(BURNING)
def test_L10_rules(world: World) -> None:
    run = unfold(world, events=EVENTS)
    with keeping("L10_rules", world):
        dead: set[int] = set()
        before, used = world, set(world.entities)
        for happened, after in zip(run.log, run.worlds, strict=True):
            # The dead are absent and never come back; the born are new.
            dead |= set(happened.died)
            assert dead.isdisjoint(after.entities)
            assert used.isdisjoint(happened.born)
            used |= set(happened.born)
            assert set(after.entities) == (set(before.entities) | set(happened.born)) - dead
            sources = [b.source for b in after.bullets]
            assert all(sources.count(source) <= MAX_BULLETS for source in sources)
            check_contact(before, happened.entities)
            check_walls(before, after, happened)
            check_children(before, after, happened)
            for i, f in after.all_flights().items():
                if i in before:
                    assert unchanging(before.flight_of(i).entity) == unchanging(f.entity)
            before = after


def unchanging(e: Entity) -> tuple[object, ...]:
    extra = (e.mass,) if isinstance(e, Ship) else (e.source,) if isinstance(e, Bullet) else ()
    return (type(e), e.radius, e.max_speed, e.name, e.id, *extra)


def check_contact(before: World, ids: tuple[int, ...]) -> None:
    """A ship is never hit by its own bullet."""
    if len(ids) == 2:
        a, b = (before.flight_of(i).entity for i in ids)
        assert not (isinstance(a, Bullet) and a.source == b.id)
        assert not (isinstance(b, Bullet) and b.source == a.id)


def check_walls(before: World, after: World, happened: object) -> None:
    """A bullet dies at its second wall, and nothing else dies at a wall."""
    if happened.kind != "wall":  # type: ignore[attr-defined]
        return
    (i,) = happened.entities  # type: ignore[attr-defined]
    e = before.flight_of(i).entity
    assert (i not in after) == (isinstance(e, Bullet) and e.bounced)
    if isinstance(e, Bullet) and i in after:
        assert after[i].bounced  # type: ignore[union-attr]


def check_children(before: World, after: World, happened: object) -> None:
    """Children lie on one line, fly apart with 1.5 times the speed, inside the parent's disc."""
    born = happened.born  # type: ignore[attr-defined]
    died = [i for i in happened.died if i in before]  # type: ignore[attr-defined]
    parents = [
        before.flight_of(i) for i in died if isinstance(before.flight_of(i).entity, Asteroid)
    ]
    children = [after[i] for i in born if i in after and isinstance(after[i], Asteroid)]
    assert len(children) == 2 * sum(f.entity.radius >= SPLIT_RADIUS for f in parents)
    for f, a, b in zip(
        (f for f in parents if f.entity.radius >= SPLIT_RADIUS),
        children[::2],
        children[1::2],
        strict=True,
    ):
        p = located(f, after.now)
        scale = abs(p.x) + abs(p.y) + p.radius
        fine = 8 * U * scale
        assert 0.5 * p.radius == a.radius == b.radius
        assert abs(0.5 * (a.x + b.x) - p.x) <= fine
        assert abs(0.5 * (a.y + b.y) - p.y) <= fine
        assert abs(hypot(a.x - p.x, a.y - p.y) - 0.5 * p.radius) <= fine
        assert abs(depth(a, b)) <= fine  # touching
        assert hypot(a.x - p.x, a.y - p.y) + a.radius <= p.radius + fine
        assert (-a.vx, -a.vy) == (b.vx, b.vy)
        wanted = min(1.5 * p.speed, a.max_speed)
        assert abs(a.speed - wanted) <= 8 * ulp(wanted)
        # Flying apart along the line they lie on.
        across = (a.x - b.x) * a.vy - (a.y - b.y) * a.vx
        assert abs(across) <= 16 * U * scale * max(a.speed, ulp(0.0))
        assert (a.x - b.x) * a.vx + (a.y - b.y) * a.vy >= -16 * U * scale * a.speed
