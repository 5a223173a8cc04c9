"""Fasteroids: a pure-functional, event-driven Asteroids engine.

A `World` is an immutable value; `evolve` gives the world some seconds later, `happenings` each event on the way.
Lengths in km, times in s, masses in kg, angles in rad.
"""

from fasteroids.actions import Fire as Fire
from fasteroids.actions import Skip as Skip
from fasteroids.actions import Thrust as Thrust
from fasteroids.actions import ThrustOff as ThrustOff
from fasteroids.actions import Turn as Turn
from fasteroids.entities import Asteroid as Asteroid
from fasteroids.entities import Bullet as Bullet
from fasteroids.entities import Ship as Ship
from fasteroids.events import Happened as Happened
from fasteroids.events import act as act
from fasteroids.events import bounce as bounce
from fasteroids.events import evolve as evolve
from fasteroids.events import evolve_until as evolve_until
from fasteroids.events import happenings as happenings
from fasteroids.events import time_to_contact as time_to_contact
from fasteroids.events import time_to_wall as time_to_wall
from fasteroids.lang import check_program as check_program
from fasteroids.lang import parse_program as parse_program
from fasteroids.scene import dump_scene as dump_scene
from fasteroids.scene import load_scene as load_scene
from fasteroids.state import World as World
from fasteroids.units import ModelError as ModelError

__all__ = [
    "Asteroid",
    "Bullet",
    "Fire",
    "Happened",
    "ModelError",
    "Ship",
    "Skip",
    "Thrust",
    "ThrustOff",
    "Turn",
    "World",
    "act",
    "bounce",
    "check_program",
    "dump_scene",
    "evolve",
    "evolve_until",
    "happenings",
    "load_scene",
    "parse_program",
    "time_to_contact",
    "time_to_wall",
]
