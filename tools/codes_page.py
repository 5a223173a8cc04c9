"""Write the page of the error codes: ``python tools/codes_page.py > docs/codes.md``.

It says of each code what `fasteroids explain` says, from the same table, `fasteroids.lang.codes`. The heading of a code
is the code alone, so that `docs/codes.md#fa101` leads to it wherever Markdown is shown.
"""

from __future__ import annotations

from fasteroids.lang.codes import CODES, Code

PHASES = {
    "syntax": ("Syntax", "Errors of form, found by the parser. Such a program never runs."),
    "type": ("Types", "Errors of meaning, found by the checker. Such a program never runs."),
    "lint": (
        "Lint",
        "Warnings about what is odd in a program without errors. Such a program runs all the same.",
    ),
}
"""The heading of each phase, and what its faults have in common, in the order of the page."""

OPENING = """\
<!-- Written by tools/codes_page.py: change that, not this file. -->

# What the codes mean

Each fault that `fasteroids check` finds in a program has a code. `fasteroids explain FA101` says the same as this page.
The language itself is in [language.md](language.md).
"""


def page() -> str:
    """The page as the text of its file."""
    return OPENING + "".join(map(_phase, PHASES))


def _phase(phase: str) -> str:
    """One part of the page: an index, then its codes."""
    heading, what = PHASES[phase]
    codes = {name: code for name, code in CODES.items() if code.phase == phase}
    index = "".join(
        "- [%s](#%s) %s\n" % (name, name.lower(), code.title) for name, code in codes.items()
    )
    return "\n## %s\n\n%s\n\n%s%s" % (
        heading,
        what,
        index,
        "".join(_section(name, code) for name, code in codes.items()),
    )


def _section(name: str, code: Code) -> str:
    """One code."""
    return "\n### %s\n\n**%s.** %s\n\nWrong:\n\n%s\nRight:\n\n%s" % (
        name,
        code.title,
        code.why,
        _fenced(code.wrong),
        _fenced(code.right),
    )


def _fenced(program: str) -> str:
    """A program as a block of code."""
    return "```fasteroids\n%s\n```\n" % program


if __name__ == "__main__":
    print(page(), end="")
