"""The README's example runs, prints what it says, and its links lead somewhere."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import pytest

from fasteroids import check_program, parse_program

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


def test_the_report_shown_is_the_one_made() -> None:
    golden = (ROOT / "tests" / "golden" / "second-as-printed.txt").read_text(encoding="utf-8")
    shown = re.findall(r"^nearest\.ast:.*?(?=\n\n|\n```)", README, re.MULTILINE | re.DOTALL)
    assert len(shown) == 4
    assert [] == [report for report in shown if report not in golden]


def test_what_is_said_of_programs_is_so(capsys: pytest.CaptureFixture[str]) -> None:
    guide = (ROOT / "docs" / "programs.md").read_text(encoding="utf-8")
    text, code = (
        re.search(f"```{kind}\n(.*?)```", guide, re.DOTALL) for kind in ("text", "python")
    )
    assert text is not None
    assert code is not None
    assert parse_program(text[1]).program is not None
    assert check_program(parse_program(text[1]).tree).diagnostics == ()
    exec(compile(code[1], "programs.md", "exec"), {})
    assert capsys.readouterr().out == "None 101.0\nFire() None\n"
