"""docs/facade.md: its ported test runs, in Python what it is in Java, and what it prints is so."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from fasteroids.facade import Facade

DOCS = (Path(__file__).parents[3] / "docs" / "facade.md").read_text(encoding="utf-8")
PORTED, AHEAD = re.findall(r"```python\n(.*?)```", DOCS, re.DOTALL)
(JAVA,) = re.findall(r"```java\n(.*?)```", DOCS, re.DOTALL)


def test_the_ported_test_passes() -> None:
    names: dict[str, Any] = {}
    exec(compile(PORTED, "docs/facade.md", "exec"), names)
    names["test_bullet_kills_asteroid"]()


def test_it_makes_the_same_calls_as_the_test_in_java() -> None:
    def snake(name: str) -> str:
        return re.sub(r"[A-Z]", lambda capital: "_" + capital[0].lower(), name)

    in_java = re.findall(r"facade\.(\w+)\(([^()]*)\)", JAVA)
    in_python = re.findall(r"facade\.(\w+)\(([^()]*)\)", PORTED)
    assert len(in_java) == 10
    assert [(snake(name), args.replace("null", "None")) for name, args in in_java] == in_python


def test_looking_ahead_leaves_the_handle_where_it_is(capsys: Any) -> None:
    facade = Facade()
    world = facade.create_world(1000, 1000)
    ship = facade.create_ship(100, 500, -45, 0, 10, 0, 5e15)
    facade.add_ship(world, ship)
    exec(compile(AHEAD, "docs/facade.md", "exec"), {"world": world})
    assert capsys.readouterr().out.startswith("t=2 wall #1, at the left, bounce\n")
    assert (world.world.time, facade.get_ship_x(ship)) == (0, 100)


def test_every_method_of_the_course_is_there() -> None:
    course = """
        create_world get_world_width get_world_height get_ships get_asteroids get_bullets add_ship add_asteroid
        remove_ship remove_asteroid evolve create_ship create_asteroid is_ship is_asteroid is_bullets
        get_ship_x get_ship_y get_ship_x_velocity get_ship_y_velocity get_ship_radius get_ship_direction
        get_ship_mass get_ship_world is_ship_thruster_active set_thruster_active turn fire_bullet
        get_asteroid_x get_asteroid_y get_asteroid_x_velocity get_asteroid_y_velocity get_asteroid_radius
        get_asteroid_mass get_asteroid_world get_bullet_x get_bullet_y get_bullet_x_velocity get_bullet_y_velocity
        get_bullet_radius get_bullet_mass get_bullet_world get_bullet_source parse_program load_program_from_stream
        load_program_from_url is_type_checking_supported type_check_program set_ship_program
    """
    assert sorted(course.split()) == [name for name in dir(Facade) if not name.startswith("_")]
