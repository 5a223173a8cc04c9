"""The lock installs the same bytes everywhere, from wherever a machine gets its packages."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[2]
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
# One requirement and what continues it: the lines that end in a backslash and the one after them.
ENTRIES = re.findall(r"^[A-Za-z0-9](?:.*\\\n)*.*$", LOCK, re.MULTILINE)
PINS = {
    canonicalize_name(pin.name): pin
    for pin in (Requirement(entry.split("\\")[0].strip()) for entry in ENTRIES)
}


def declared() -> list[Requirement]:
    """What pyproject.toml asks for: to build, to run, and in every extra."""
    project = PROJECT["project"]
    wanted = [*PROJECT["build-system"]["requires"], *project["dependencies"]]
    for extra in project["optional-dependencies"].values():
        wanted += extra
    requirements = [Requirement(text) for text in wanted]
    return [each for each in requirements if each.name != project["name"]]


@pytest.mark.parametrize(
    "address", ["http:", "https:", "://", "@ ", "file:", "--index", "--find-links", "/"]
)
def test_lock_names_no_address(address: str) -> None:
    named = [line for line in LOCK.splitlines() if address in line]
    assert named == []


def test_every_requirement_is_one_version_with_hashes() -> None:
    assert len(ENTRIES) == len(PINS) > 20
    for entry in ENTRIES:
        requirement, *hashes = (line.strip(" \\") for line in entry.splitlines())
        assert re.search(r"==[^*\s]+( ;|$)", requirement), entry
        assert hashes, f"no hash: {entry}"
        assert all(re.fullmatch(r"--hash=sha256:[0-9a-f]{64}", each) for each in hashes), entry


def test_lock_holds_nothing_else() -> None:
    lines = LOCK.splitlines()
    others = [line for line in lines if line and not line.lstrip().startswith(("#", "--hash="))]
    assert len(others) == len(ENTRIES)


@pytest.mark.parametrize("name", ["hatchling", "editables"])
def test_lock_holds_what_the_editable_install_needs(name: str) -> None:
    assert name in PINS


@pytest.mark.parametrize("requirement", declared(), ids=str)
def test_lock_satisfies_what_is_declared(requirement: Requirement) -> None:
    pin = PINS[canonicalize_name(requirement.name)]
    (version,) = (each.version for each in pin.specifier)
    assert requirement.specifier.contains(version, prereleases=True)
