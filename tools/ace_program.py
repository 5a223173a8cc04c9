"""Write the program of the all-rounder: ``python tools/ace_program.py > fasteroids/programs/ace.ast``.

The language has neither arrays nor functions, so the program has variables of its own for each asteroid it looks at: a
*slot*. What it does alike for all slots stands here once, with `#` for the number of the slot, and is written as often
as needed. The rest of the program is `tools/ace_program.txt`, in which each `{{name}}` is a part from here.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from fasteroids.lang.formatter import formatted

SLOTS: Final = 7
"""So many asteroids are foreseen. More would not leave enough fuel to compare courses."""

TEMPLATE: Final = Path(__file__).with_suffix(".txt")
"""The program without what is written once for each slot."""

VARIABLES: Final = {
    "far": "how far it will be soon, rim to centre",
    "x": "where it is",
    "y": "",
    "u": "its velocity",
    "v": "",
    "r": "its radius",
    "touch": "the square of the distance at which it touches, with a margin",
    "bounce": "when it bounces",
    "meets": "off what, as with `other`",
    "laterX": "where it would have to be to fly from now on as it will then",
    "laterY": "",
    "laterU": "its velocity from then on",
    "laterV": "",
}
"""The numbers of a slot, and what they are."""

READ: Final = """
near := #;
x# := getx rock#;
y# := gety rock#;
u# := getvx rock#;
v# := getvy rock#;
r# := getradius rock#;
touch# := (r# + 44) * (r# + 44);
"""
"""A slot is filled."""

PICK: Final = "ix := x#; iy := y#; iu := u#; iv := v#; ir := r#;\n"
"""A slot becomes the one in hand."""

MEET: Final = """
px := x# - ix;
py := y# - iy;
qx := u# - iu;
qy := v# - iv;
towards := px * qx + py * qy;
if (towards < 0) {
  s := r# + ir;
  gap := px * px + py * py - s * s;
  root := towards * towards - (qx * qx + qy * qy) * gap;
  if (root > 0) {
    t := gap / (sqrt(root) - towards);
    if (t < bounce#) {
      bounce# := t;
      meets# := slot;
    }
    if (t < when) {
      when := t;
      other := #;
    }
  }
}
"""
"""The slot in hand and one before it: do they meet before each meets anything else?"""

TURN: Final = """
laterX# := ix + (iu - u) * when;
laterY# := iy + (iv - v) * when;
laterU# := u;
laterV# := v;
"""
"""How a slot flies after its bounce."""

LEG: Final = (
    "legFrom := bounce#; legX := laterX#; legY := laterY#; legU := laterU#; legV := laterV#;\n"
)
"""The flight of a slot after its bounce is the one that matters."""

LEAD: Final = """
qx := u * u + v * v - pace * pace;
towards := px * u + py * v - r * pace;
gap := px * px + py * py - r * r;
root := towards * towards - qx * gap;
t := -1;
if (root > 0) {
  t := (-towards - sqrt(root)) / qx;
}
"""
"""When a bullet meets what is at `px` and `py` and flies at `u` and `v`: -1 if never."""

HIT: Final = """
px := {x}# - planX;
py := {y}# - planY;
qx := {u}# - planU;
qy := {v}# - planV;
towards := px * qx + py * qy;
if (towards < 0) {{
  gap := px * px + py * py - touch#;
  root := towards * towards - (qx * qx + qy * qy) * gap;
  if (root > 0) {{
    t := gap / (sqrt(root) - towards);
    if (t < soonest && t {when} bounce#) {{
      soonest := t;
      meant := rock#;
{leg}    }}
  }}
}}
"""
"""Does the ship on its course meet a slot on one of its two flights, and before all it is known to meet?"""

HITS: Final = "".join(
    [
        "work := work + 75;\n",
        HIT.format(x="x", y="y", u="u", v="v", when="<", leg="      legFrom := 1000;\n"),
        "if (bounce# < soonest) {\nwork := work + 55;\n",
        HIT.format(x="laterX", y="laterY", u="laterU", v="laterV", when=">", leg=LEG),
        "}\n",
    ]
)
"""Both flights, the later one only if it begins before the first hit so far."""


def each(text: str) -> str:
    """The text for every slot, one after the other."""
    return "".join(text.replace("#", str(slot)) for slot in range(1, SLOTS + 1))


def nested(condition: str, text: str, slot: int = 1, last: int = SLOTS) -> str:
    """The text for the slots from `slot` to `last`, up to the first for which the condition does not hold.

    In the condition, `@` is half a number less than the slot: between it and the one before.
    """
    if slot > last:
        return ""
    head = condition.replace("#", str(slot)).replace("@", "%d.5" % (slot - 1))
    return "if (%s) {\n%s%s}\n" % (
        head,
        text.replace("#", str(slot)),
        nested(condition, text, slot + 1, last),
    )


def chosen(variable: str, text: str, low: int = 1, high: int = SLOTS) -> str:
    """The text for the slot whose number is in the variable, from `low` to `high`."""
    if low == high:
        return text.replace("#", str(low))
    middle = (low + high) // 2
    return "if (%s < %d.5) {\n%s} else {\n%s}\n" % (
        variable,
        middle,
        chosen(variable, text, low, middle),
        chosen(variable, text, middle + 1, high),
    )


def insertion(slot: int = SLOTS) -> str:
    """Asteroid `a` is nearer than what is in `slot`, which falls out or is in the next slot already.

    So `a` goes there, unless it is nearer than the one before too, which then moves up.
    """
    here = "far# := key;\nrock# := a;\n".replace("#", str(slot))
    if slot == 1:
        return here
    moved = "far# := far{before};\nrock# := rock{before};\n".replace("#", str(slot))
    return "if (key < far%d) {\n%s%s} else {\n%s}\n" % (
        slot - 1,
        moved.format(before=slot - 1),
        insertion(slot - 1),
        here,
    )


def declarations() -> str:
    """The numbers of all slots; what they are stands at the first of them."""
    lines = []
    for name, what in VARIABLES.items():
        first, *rest = each("double %s#;\n" % name).splitlines(keepends=True)
        lines += [first.replace("\n", "  // %s\n" % what) if what else first, *rest]
    return "".join(lines)


PARTS: Final = {
    "slots": str(SLOTS),
    "entities": each("entity rock# := self;\n"),
    "variables": declarations(),
    "no one": each("far# := 340;\n"),
    "insertion": insertion(),
    "reading": nested("far# < 340 && rock# != null", READ),
    "picking": chosen("slot", PICK),
    "meeting": nested("slot > #", MEET, last=SLOTS - 1),
    "noting": chosen("slot", "bounce# := when;\nmeets# := other;\n"),
    "picking with bounce": chosen("slot", PICK + "when := bounce#;\nother := meets#;\n"),
    "picking the other": chosen("other", "px := x#; py := y#; qx := u#; qy := v#; r := r#;\n"),
    "turning": chosen("slot", TURN),
    "lead": LEAD,
    "hits": nested("near > @ && soonest - cost > best", HITS),
}
"""What stands for each `{{name}}` of the template."""


def program() -> str:
    """The program in normal form."""
    text = TEMPLATE.read_text(encoding="utf-8")
    return formatted(re.sub(r"\{\{([a-z ]+)\}\}", lambda mark: PARTS[mark[1]], text))


if __name__ == "__main__":
    print(program(), end="")
