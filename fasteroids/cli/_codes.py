"""`fasteroids explain FA012`: what a code means."""

from __future__ import annotations

import re
import textwrap

from fasteroids.cli import _records as records
from fasteroids.cli._guard import Refusal
from fasteroids.lang.codes import CODES, Code

__all__ = ["is_code", "told"]

_CODE = re.compile("FA[0-9]{3}", re.IGNORECASE)
_WIDE = 100


def is_code(text: str) -> bool:
    """Is this written as a code is, in capitals or not?"""
    return _CODE.fullmatch(text) is not None


def told(text: str, *, as_json: bool) -> str:
    """What a code means, for people or as JSON; a `Refusal` if there is no such code."""
    name = text.upper()
    code = CODES.get(name)
    if code is None:
        raise Refusal(f"there is no code {name}; `fasteroids check` says the code of each fault")
    return records.compact(_record(name, code)) if as_json else _text(name, code)


def _text(name: str, code: Code) -> str:
    return "\n".join(
        [
            f"{name}: {code.title} ({code.phase})",
            "",
            *textwrap.wrap(code.why, _WIDE, break_on_hyphens=False),
            "",
            "Wrong:",
            "",
            textwrap.indent(code.wrong, "    "),
            "",
            "Right:",
            "",
            textwrap.indent(code.right, "    "),
        ]
    )


def _record(name: str, code: Code) -> dict[str, str]:
    return {
        "code": name,
        "phase": code.phase,
        "title": code.title,
        "why": code.why,
        "wrong": code.wrong,
        "right": code.right,
    }
