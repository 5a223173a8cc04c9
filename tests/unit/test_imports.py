"""Who may import whom, and what `import fasteroids` loads."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "fasteroids"
HEAVY = ["click", "hypothesis", "numba", "numpy", "pygments", "rich", "textual"]
LINT = "from importlinter.cli import lint_imports; raise SystemExit(lint_imports(no_cache=True))"


def run(code: str, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """Run code in a Python of its own."""
    return subprocess.run(
        [sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=False
    )


def test_import_loads_nothing_heavy() -> None:
    loaded = run(f"import sys, fasteroids; print(*sorted({HEAVY} & sys.modules.keys()))")
    assert loaded.returncode == 0, loaded.stderr
    assert loaded.stdout.split() == []


def test_contracts_hold() -> None:
    linted = run(LINT)
    assert linted.returncode == 0, linted.stdout + linted.stderr


@pytest.mark.parametrize(
    ("module", "line", "contract"),
    [
        ("units.py", "import fasteroids.engine", "every module is in it"),
        ("surplus.py", "", "every module is in it"),
        ("__init__.py", "import click", "know the terminal"),
        ("scene.py", "def load():\n    import rich.table", "know the terminal"),
        ("testing/surplus.py", "import textual", "know the terminal"),
        ("lang/words.py", "import pygments", "know the terminal"),
        ("models/surplus.py", "import hypothesis", "know Hypothesis"),
        ("cli/surplus.py", "import hypothesis", "know Hypothesis"),
        ("cli/surplus.py", "import fasteroids.testing", "works without the strategies"),
        ("physics.py", "import numpy", "Nothing knows arrays"),
        ("cli/surplus.py", "from numba import njit", "Nothing knows arrays"),
    ],
)
def test_contracts_notice(module: str, line: str, contract: str, tmp_path: Path) -> None:
    shutil.copytree(PACKAGE, tmp_path / "fasteroids", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    with (tmp_path / "fasteroids" / module).open("a", encoding="utf-8") as file:
        file.write(f"\n\n{line}\n")
    linted = run(LINT, tmp_path)
    assert linted.returncode == 1
    assert f"{contract} BROKEN" in linted.stdout, linted.stdout + linted.stderr
