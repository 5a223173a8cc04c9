"""The panes and menus can be made without a terminal library."""

from __future__ import annotations

import subprocess
import sys

MODULES = (
    "breakpoints", "chronicle", "edits", "inspector", "launching", "menu", "pictures", "program_pane", "recent", "rows",
    "strip", "verdicts", "words"
)  # fmt: skip


def test_no_pane_or_menu_loads_a_terminal_library() -> None:
    names = ", ".join(f"fasteroids.tui.{name}" for name in MODULES)
    code = (
        f"import sys, {names}; print(*sorted({{'textual', 'rich', 'click'}} & sys.modules.keys()))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == []
