"""The pages of docs/: their links lead to files that are there, and to headings that are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[3] / "docs"
PAGES = sorted(DOCS.glob("*.md"))
FENCED = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)


def prose(page: Path) -> str:
    """A page without its blocks of code."""
    return FENCED.sub("", page.read_text(encoding="utf-8"))


def anchors(page: Path) -> list[str]:
    """The names of a page's headings in links: small letters, hyphens for blanks, no other signs."""
    headings = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    return [re.sub(r"[^\w\- ]", "", each.lower()).replace(" ", "-") for each in headings]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    nowhere = []
    for link in re.findall(r"\]\(([^)\s]+)\)", prose(page)):
        place, _, heading = link.partition("#")
        target = (page.parent / place).resolve() if place else page
        if "://" not in link and not (
            target.exists() and (not heading or heading in anchors(target))
        ):
            nowhere.append(link)
    assert nowhere == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_no_two_headings_of_a_page_have_one_name(page: Path) -> None:
    assert sorted(anchors(page)) == sorted({*anchors(page)})


@pytest.mark.parametrize("name", ["language.md", "idioms.md"])
def test_the_index_names_every_section_in_order(name: str) -> None:
    text = prose(DOCS / name)
    index = text[: text.index("\n## ")]
    sections = re.findall(r"^## (.*)$", text, re.MULTILINE)
    linked = re.findall(r"\[([^\]]+)\]\(#[^)]+\)", index)
    assert [each.lower() for each in linked] == [each.lower() for each in sections]
