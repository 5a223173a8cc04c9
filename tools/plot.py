"""What the figures of the documentation are drawn with: a grid with labels, and signs on it, as the text of SVG."""

from __future__ import annotations

from typing import Callable, NamedTuple

from picture import BACK, GRID

WIDTH, HEIGHT = 960, 660
LEFT, RIGHT, TOP, BOTTOM = 84, 940, 20, 590  # of the plot
TEXT, FAINT = "#e8ecf0", "#9aa4b0"
SIZE = 17  # of the font
ADVANCE = 0.62 * SIZE  # of a character: 0.6 in monospace fonts, and a little more


class Plot(NamedTuple):
    """The values at the borders of the plot, and the scale of both axes."""

    left: float
    right: float
    bottom: float
    top: float
    scale: Callable[[float], float] = float

    def at(self, x: float, y: float) -> tuple[float, float]:
        """The pixel of a value."""
        s = self.scale
        right = (s(x) - s(self.left)) / (s(self.right) - s(self.left))
        up = (s(y) - s(self.bottom)) / (s(self.top) - s(self.bottom))
        return LEFT + right * (RIGHT - LEFT), BOTTOM - up * (BOTTOM - TOP)

    def line(self, points: list[tuple[float, float]], colour: str, dash: str = "") -> str:
        """A line through values."""
        text = " ".join("%.1f,%.1f" % self.at(x, y) for x, y in points)
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        return (
            f'<polyline points="{text}" fill="none" stroke="{colour}" stroke-width="2.5" '
            f'stroke-linecap="round"{dashed}/>'
        )

    def label(self, x: float, y: float, text: str, colour: str, anchor: str = "start") -> str:
        """A text at a value."""
        return label(*self.at(x, y), text, colour, anchor)

    def axes(
        self, xs: tuple[float, ...], ys: tuple[float, ...], x_name: str, y_name: str
    ) -> list[str]:
        """The grid at these values, with their labels."""
        drawn = []
        for x in xs:
            px, _ = self.at(x, self.bottom)
            drawn.append(f'<path d="M{px:.1f} {TOP}V{BOTTOM}" stroke="{GRID}"/>')
            drawn.append(label(px, BOTTOM + 22, f"{x:g}", FAINT, "middle"))
        for y in ys:
            _, py = self.at(self.left, y)
            drawn.append(f'<path d="M{LEFT} {py:.1f}H{RIGHT}" stroke="{GRID}"/>')
            drawn.append(label(LEFT - 8, py + 5, f"{y:g}", FAINT, "end"))
        middle = 0.5 * (TOP + BOTTOM)
        return [
            *drawn,
            label(0.5 * (LEFT + RIGHT), BOTTOM + 50, x_name, TEXT, "middle"),
            f'<g transform="rotate(-90 24 {middle:g})">{label(24, middle, y_name, TEXT, "middle")}</g>',
        ]


def label(x: float, y: float, text: str, colour: str = TEXT, anchor: str = "start") -> str:
    """A text whose base line is at this pixel."""
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}">{text}</text>'


def dot(x: float, y: float, colour: str) -> str:
    """A cut, or a measured point."""
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{colour}"/>'


def square(x: float, y: float, colour: str) -> str:
    """A measured point of another series."""
    return f'<rect x="{x - 4.5:.1f}" y="{y - 4.5:.1f}" width="9" height="9" fill="{colour}"/>'


def ring(x: float, y: float, colour: str) -> str:
    """A cut that holds the speed at its limit."""
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="{colour}" stroke-width="2"/>'
    )


def diamond(x: float, y: float, colour: str) -> str:
    """An event of kind limit."""
    return (
        f'<path d="M{x:.1f} {y - 10:.1f}l10 10l-10 10l-10 -10z" fill="{colour}" '
        f'stroke="{TEXT}" stroke-width="2"/>'
    )


def stroke(colour: str, dash: str = "") -> str:
    """A line in the legend."""
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<path d="M0 -5h48" stroke="{colour}" stroke-width="2.5" stroke-linecap="round"{dashed}/>'
    )


def disc(x: float, y: float, colour: str) -> str:
    """The ship where it starts or ends."""
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="10" fill="{colour}" fill-opacity="0.3" '
        f'stroke="{colour}" stroke-width="2.5"/>'
    )


def legend(keys: list[tuple[str, str]]) -> list[str]:
    """Signs and what they mean, in a box at the bottom right."""
    width = 92 + ADVANCE * max(len(text) for _, text in keys)
    left, top, height = RIGHT - 8 - width, BOTTOM - 8 - 27 * len(keys) - 14, 27 * len(keys) + 14
    return [
        f'<rect x="{left:.1f}" y="{top}" width="{width:.1f}" height="{height}" fill="{BACK}" '
        f'stroke="{GRID}"/>',
        *(
            f'<g transform="translate({left + 14:.1f} {top + 27 * k})">{sign}{label(64, 0, text)}</g>'
            for k, (sign, text) in enumerate(keys, 1)
        ),
    ]


def framed(title: str, caption: str, drawn: list[str]) -> str:
    """The text of an SVG file."""
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="monospace" font-size="%d">' % SIZE,
            f"<title>{title}</title>",
            f"<desc>{caption}</desc>",
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="{BACK}"/>',
            *drawn,
            "</svg>",
            "",
        ]
    )
