"""The course's facade (OGP 2012-2013, part III, `IFacade`) over immutable worlds, for those who port course tests.

The course's objects change; a `World` does not. So the facade hands out *handles*: small objects that change, each
standing for one value.

`create_world(w, h)` gives a `WorldHandle`, which holds the current immutable `World` (its `world`). `evolve` and all
that changes something put the next world in its place. `create_ship` and `create_asteroid` give handles of entities
in no world. Once added, a handle reads its entity from its world, at the world's clock, whenever asked (its `entity`).
When the entity dies or is removed, the handle keeps the last state and is in no world; what was removed may be added
again, the dead may not. A child or a bullet gets a
handle when somebody asks for it; one entity has one handle, the same object every time. Handles are equal if they are
the same object, so sets of them do what the course's sets do.

    facade = Facade()
    world = facade.create_world(1000, 1000)
    ship = facade.create_ship(100, 100, -10, -10, 50, 0, 5e15)
    facade.add_ship(world, ship)
    facade.evolve(world, 15, None)
    assert (facade.get_ship_x(ship), facade.get_ship_y(ship)) == (150, 150)

Methods have the course's names in snake_case and take the course's arguments in the course's order. Worlds move by the
course's text: thrust is `literal`. All errors of the caller are `ModelError`, a handle of the wrong kind among them.
Two kinds of exception are not the facade's to change, and pass: those of a caller's listener or generator, and
`OSError` where a program is read.

This module is a shell: it stands at the rim with the command line, nothing imports it, and the reading of files and
addresses is in one method of it (`load_program_from_url`).
"""

from fasteroids.facade._facade import Facade as Facade
from fasteroids.facade._handles import AsteroidHandle as AsteroidHandle
from fasteroids.facade._handles import BulletHandle as BulletHandle
from fasteroids.facade._handles import Handle as Handle
from fasteroids.facade._handles import ShipHandle as ShipHandle
from fasteroids.facade._handles import WorldHandle as WorldHandle
from fasteroids.facade._programs import ParseOutcome as ParseOutcome
from fasteroids.facade._programs import TypeCheckOutcome as TypeCheckOutcome
from fasteroids.facade._time import CollisionListener as CollisionListener

__all__ = [
    "AsteroidHandle",
    "BulletHandle",
    "CollisionListener",
    "Facade",
    "Handle",
    "ParseOutcome",
    "ShipHandle",
    "TypeCheckOutcome",
    "WorldHandle",
]
