"""The figures of docs/thrust.md are what tools/thrust_picture.py draws, and what they say is measured."""

from __future__ import annotations

import re
import subprocess
import sys
from math import atan, atan2, cosh, log, log10, sinh, sqrt, tan
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import thrust_picture
from plot import ADVANCE, BOTTOM, HEIGHT, LEFT, RIGHT, TOP, WIDTH, Plot

ROOT = Path(__file__).resolve().parents[2]
GUIDE = (ROOT / "docs" / "thrust.md").read_text(encoding="utf-8")
FIGURES = {"paths": thrust_picture.paths, "error": thrust_picture.error}
SVG = "{http://www.w3.org/2000/svg}"


def parts(figure: str, tag: str, **wanted: str) -> list[ElementTree.Element]:
    """The elements of a figure, outside its legend, with this tag and these attributes."""
    found = ElementTree.fromstring(figure).findall(SVG + tag)
    return [e for e in found if all(e.get(name) == value for name, value in wanted.items())]


def texts(figure: str, tag: str = "text") -> list[str]:
    return [e.text or "" for e in ElementTree.fromstring(figure).iter(SVG + tag)]


def lines(figure: str) -> list[list[tuple[float, ...]]]:
    """Every line through values, as its pixels."""
    points = [line.get("points", "").split() for line in parts(figure, "polyline")]
    return [[tuple(map(float, point.split(","))) for point in line] for line in points]


def centres(circles: list[ElementTree.Element]) -> list[tuple[float, float]]:
    return [(float(c.get("cx", "")), float(c.get("cy", ""))) for c in circles]


def on_paths(*places: tuple[float, float]) -> list[Any]:
    """The pixels of places (km) in `paths`."""
    return [(pytest.approx(LEFT + x), pytest.approx(BOTTOM - y)) for x, y in places]


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_in_the_guide_is_what_its_command_draws(name: str) -> None:
    file = f"docs/thrust-{name}.svg"
    command = re.search(rf"^\$ \.venv/bin/python (.*) > {file}$", GUIDE, re.MULTILINE)
    assert command is not None
    drawn = subprocess.run(
        [sys.executable, *command[1].split()], cwd=ROOT, capture_output=True, check=True
    )
    assert drawn.stdout.decode() == (ROOT / file).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", FIGURES)
def test_the_guide_shows_a_figure_and_quotes_its_caption(name: str) -> None:
    figure = FIGURES[name]()
    assert f"](thrust-{name}.svg)" in GUIDE
    assert texts(figure, "desc")[0] in " ".join(GUIDE.replace("\n>", "\n").split())


@pytest.mark.parametrize("name", FIGURES)
def test_no_label_is_clipped(name: str) -> None:
    labels = parts(FIGURES[name](), "text")
    assert len(labels) > 10
    for e in labels:
        width = ADVANCE * len(e.text or "")
        shift = {"start": 0.0, "middle": 0.5, "end": 1.0}[e.get("text-anchor", "start")]
        left = float(e.get("x", "")) - shift * width
        assert 0.0 <= left <= left + width <= WIDTH
        assert TOP <= float(e.get("y", "")) <= HEIGHT


def test_literal_is_drawn_from_cut_to_cut() -> None:
    figure = thrust_picture.paths()
    *literals, smooth = lines(figure)
    assert [3, 6, 15] == [len(line) - 1 for line in literals]  # 3 s in steps of 1, 0.5 and 0.2 s
    assert on_paths((40, 50), (40, 250)) == literals[0][:2]
    assert on_paths((40, 50), (40, 150), (95, 250)) == literals[1][:3]
    for line, off in zip(literals, (183, 95, 39), strict=True):
        (x, y), (u, v) = line[-1], smooth[-1]
        assert sqrt((x - u) ** 2 + (y - v) ** 2) == pytest.approx(off, abs=0.6)  # a pixel a km
        assert any(f"{off} km off" in text for text in texts(figure))


def test_a_ring_is_where_a_cut_first_clips_the_speed() -> None:
    rings = parts(thrust_picture.paths(), "circle", fill="none")
    after_08 = 40 + 110 * 0.8**2 - 220 * 0.2 * 0.8 / 2  # behind by a dt t / 2
    assert on_paths((40, 250), (95, 250), (after_08, 210)) == centres(rings)


def test_smooth_is_a_parabola_then_the_catenary_of_equal_strength() -> None:
    c, a, v = 250.0, 220.0, 200.0
    t = sqrt(c * c - v * v) / a
    reach, q = c * c / a, -log(tan(0.5 * atan2(v, a * t)))
    then = q + (3.0 - t) * a / c
    x = 40.0 + 0.5 * a * t * t + reach * log(cosh(then) / cosh(q))
    y = 50.0 + v * t + reach * (atan(sinh(then)) - atan(sinh(q)))
    figure = thrust_picture.paths()
    end = lines(figure)[-1][-1]
    assert end == pytest.approx((LEFT + x, BOTTOM - y), abs=0.051)
    assert f"limit, 250 km/s at {t:.3f} s" in texts(figure)
    (diamond,) = parts(figure, "path", fill=thrust_picture.SMOOTH)
    top = f"M{LEFT + 40.0 + 0.5 * a * t * t:.1f} {BOTTOM - 50.0 - v * t - 10.0:.1f}"
    assert diamond.get("d", "").startswith(top)


def test_steps_are_measured_not_remembered() -> None:
    figure = thrust_picture.paths((1.5,))
    assert 2 == len(lines(figure))
    assert "literal, cut every 1.5 s" in texts(figure)
    assert not [text for text in texts(figure) if "183 km" in text]
    assert "55 km of 110 km" in texts(thrust_picture.error((0.5, 0.25, 0.125)))


def test_error_is_what_a_straight_flight_from_rest_says() -> None:
    figure = thrust_picture.error()
    plot = Plot(0.0008, 0.25, 0.05, 40, log10)
    steps = thrust_picture.ERROR_STEPS
    assert (0.2, 0.001) == (steps[0], steps[-1])
    expected = [plot.at(h, 110.0 * h) for h in steps]
    measured = centres(parts(figure, "circle"))
    assert [pytest.approx(p, abs=0.051) for p in expected] == measured
    assert len(steps) == len(parts(figure, "rect", width="9"))
    assert "22 km of 110 km" in texts(figure)
    assert "standard ship from rest: slope 1.000" in texts(figure)


def test_the_table_of_the_guide_says_what_was_measured() -> None:
    rest = thrust_picture.standard(0.0)
    ((_, behind),) = thrust_picture.errors(rest, (0.2,), 1.0)
    whole = thrust_picture.flown(rest, "smooth", 1.0, 1.0)[-1].x - rest.x
    assert f"{behind:.3g} km after 1 s at steps of 0.2 s, of {whole:.3g} km flown" in GUIDE


def test_a_power_law_is_found() -> None:
    slope, law = thrust_picture.power_law([(x, 3.0 * x**1.5) for x in (0.1, 0.2, 0.7)])
    assert slope == pytest.approx(1.5)
    assert law(4.0) == pytest.approx(24.0)


def test_a_plot_reaches_from_border_to_border() -> None:
    plot = Plot(0.01, 1.0, 0.1, 10.0, log10)
    assert plot.at(0.01, 0.1) == pytest.approx((LEFT, BOTTOM))
    assert plot.at(1.0, 10.0) == pytest.approx((RIGHT, TOP))
    assert plot.at(0.1, 1.0) == pytest.approx((0.5 * (LEFT + RIGHT), 0.5 * (TOP + BOTTOM)))
