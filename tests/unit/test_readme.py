"""The README's example runs, prints what it says, and its links lead somewhere."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    return re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)[1]  # type: ignore[index]


def test_the_example_is_twelve_lines_and_prints_what_the_readme_says() -> None:
    code = block("python")
    assert 12 == len([line for line in code.splitlines() if line.strip()])
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(code, "README.md", "exec"), {})
    assert block("text") == out.getvalue()


def test_links_lead_somewhere() -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", README)
    assert len(links) >= 15
    assert [] == [link for link in links if not (ROOT / link).exists()]


def test_every_law_test_is_in_the_table() -> None:
    named = set(re.findall(r"tests/properties/(test_\w+\.py)", README))
    for path in (ROOT / "tests" / "properties").glob("test_*.py"):
        if re.search(r"def test_L\d+_", path.read_text(encoding="utf-8")):
            assert path.name in named
