"""docs/language.md and docs/idioms.md: every program on them does what stands below it.

A page is read as its fenced blocks, in order. A `fasteroids` block is a program; the `text` blocks below it, up to the
next program, say what comes of it: what `fasteroids check` finds in it, or what `fasteroids run` tells of the world on
the page. A program right below another one is its normal form.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from attrs import evolve as with_
from attrs import frozen
from click.testing import CliRunner

from fasteroids import happenings, load_scene, parse_program
from fasteroids.cli import main
from fasteroids.cli._narrate import Narrator
from fasteroids.lang import syntax, words
from fasteroids.lang.checker.uses import constructs
from fasteroids.lang.formatter import formatted
from fasteroids.lang.front import diagnose
from fasteroids.lang.lint import warnings
from fasteroids.lang.parser.lexer import tokens
from fasteroids.lang.report import rendered

DOCS = Path(__file__).parents[3] / "docs"
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
FILE = "try.ast"
COURSE = f"$ fasteroids check --course {FILE}\n"
LONGER = re.compile(r"\$ fasteroids run try\.toml --for ([0-9.]+)\n")


@frozen
class Sample:
    """A program of a page, where it is, its normal form by the page, and what the page says of it."""

    place: str
    program: str
    normal: str
    said: tuple[str, ...] = ()

    @property
    def reports(self) -> list[str]:
        """What the page says that `fasteroids check` finds."""
        return [each for each in self.said if each.startswith((FILE, COURSE))]

    @property
    def runs(self) -> list[str]:
        """What the page says that `fasteroids run` tells."""
        return [each for each in self.said if each not in self.reports]


def samples(page: str) -> list[Sample]:
    """The programs of a page, with what it says of them."""
    found: list[Sample] = []
    text = (DOCS / page).read_text(encoding="utf-8")
    above = ""
    for fence in FENCE.finditer(text):
        language, body = fence.groups()
        if language == above == "fasteroids":
            found[-1] = with_(found[-1], normal=body)
        elif language == "fasteroids":
            line = text.count("\n", 0, fence.start(2)) + 1
            found.append(Sample(f"{page}:{line}", body, body))
        elif language == "text":
            found[-1] = with_(found[-1], said=(*found[-1].said, body))
        above = language
    return found


SAMPLES = [*samples("language.md"), *samples("idioms.md")]
[SCENE] = [
    body
    for language, body in FENCE.findall((DOCS / "language.md").read_text(encoding="utf-8"))
    if language == "toml"
]
each_sample = pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.place)


def told(program: str, span: float) -> str:
    """What `fasteroids run` tells of the world on the page, but for its first and last line."""
    world = load_scene(SCENE, read={FILE: program.encode()}.__getitem__)
    narrator = Narrator(world, span)
    lines = (narrator.line(*step) for step in happenings(world, world.time + span))
    return "".join(f"{line}\n" for line in lines if line is not None)


def report(program: str, *, course: bool = False) -> str:
    """What `fasteroids check` finds: errors, or else warnings."""
    found = diagnose(program) or warnings(parse_program(program).tree, course=course)
    return rendered(found, program, FILE) + "\n" * bool(found)


@each_sample
def test_programs_are_in_normal_form_or_above_it(sample: Sample) -> None:
    assert formatted(sample.program) == sample.normal
    assert formatted(sample.normal) == sample.normal


@each_sample
def test_checking_finds_what_the_page_says_and_nothing_where_it_says_nothing(
    sample: Sample,
) -> None:
    plain = [each for each in sample.reports if not each.startswith(COURSE)]
    assert [report(sample.program)] == (plain or [""])
    for each in sample.reports:
        if each.startswith(COURSE):
            assert each == COURSE + report(sample.program, course=True)


@each_sample
def test_running_tells_what_the_page_says(sample: Sample) -> None:
    assert bool(sample.runs) != bool(diagnose(sample.program) or COURSE in "".join(sample.said))
    for said in sample.runs:
        longer = LONGER.match(said)
        span = float(longer[1]) if longer else 1.0
        assert said == (longer[0] if longer else "") + told(sample.program, span)


def test_the_commands_say_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the tests above make of the library is what a reader gets who does as the page says."""
    sample = next(each for each in SAMPLES if each.reports and each.runs)
    (tmp_path / "try.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / FILE).write_text(sample.program, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke(main, ["run", "try.toml", "--for", "1"])
    assert run.stdout.splitlines(keepends=True)[1:-1] == sample.runs[0].splitlines(keepends=True)
    check = CliRunner().invoke(main, ["check", FILE])
    assert check.stdout == sample.reports[0] + "\n"


def test_the_pages_show_every_word_and_every_operator() -> None:
    pieces = {piece for each in SAMPLES for piece in tokens(each.program)[0].texts}
    assert words.KEYWORDS - pieces == set()
    nodes = [node for each in SAMPLES for node, _ in constructs(parse_program(each.program).tree)]
    binary = {node.operator for node in nodes if isinstance(node, syntax.Binary)}
    unary = {node.operator for node in nodes if isinstance(node, syntax.Unary)}
    assert binary == words.BINARY.keys()
    assert unary == {*words.UNARY, *words.CALLS}


def test_every_section_of_a_construct_has_a_program() -> None:
    """But for the first, which has the world to try them in."""
    for page in ("language.md", "idioms.md"):
        _, *sections = re.split(
            r"^## ", (DOCS / page).read_text(encoding="utf-8"), flags=re.MULTILINE
        )
        bare = [each.partition("\n")[0] for each in sections if "```fasteroids\n" not in each]
        assert bare == (["To try it"] if page == "language.md" else [])
