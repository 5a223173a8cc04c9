"""What is wrong with programs, in the formats of tools: JSON, the workflow commands of GitHub, SARIF 2.1.0."""

from __future__ import annotations

import json
import os
from typing import Any, Final
from urllib.parse import quote

from attrs import frozen

from fasteroids.lang.codes import CODES
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.source import Span

__all__ = ["Checked", "as_github", "as_json", "as_sarif"]


@frozen
class Checked:
    """A program that was checked: where it came from, its text, and what was found."""

    place: str
    text: str
    found: tuple[Diagnostic, ...]

    @property
    def errors(self) -> int:
        """How many of them are errors."""
        return sum(each.severity == "error" for each in self.found)


# JSON.


def as_json(checked: list[Checked]) -> list[str]:
    """One array of objects, a line each; `[]` if nothing was found."""
    records = [json.dumps(_record(file, each)) for file in checked for each in file.found]
    if not records:
        return ["[]"]
    return ["[", *(f"  {record}," for record in records[:-1]), f"  {records[-1]}", "]"]


def _record(file: Checked, each: Diagnostic) -> dict[str, Any]:
    return {
        "code": each.code,
        "severity": each.severity,
        "phase": _PHASES[each.code[2]],
        "message": each.message,
        "hint": each.hint,
        "file": file.place.encode(errors="backslashreplace").decode(),
        "line": each.span.line,
        "column": each.span.column,
        "end_line": each.span.end_line,
        "end_column": each.span.end_column,
    }


_PHASES: Final = {"0": "syntax", "1": "type", "2": "lint"}
"""By the hundreds of the code."""


# GitHub: https://docs.github.com/actions, "Workflow commands".


def as_github(checked: list[Checked]) -> list[str]:
    """One command a diagnostic."""
    return [_command(file, each) for file in checked for each in file.found]


def _command(file: Checked, each: Diagnostic) -> str:
    span = each.span
    name = file.place.encode(errors="backslashreplace").decode()
    places = {"file": name, "line": span.line, "endLine": span.end_line}
    if span.line == span.end_line:  # columns of a piece of many lines are refused
        places |= {"col": span.column, "endColumn": span.end_column}
    places["title"] = each.code
    told = ",".join(f"{name}={_escaped(str(value), ':,')}" for name, value in places.items())
    hint = f"\n{each.hint}" if each.hint else ""
    return f"::{each.severity} {told}::{_escaped(each.message + hint)}"


def _escaped(text: str, more: str = "") -> str:
    for sign in "%\r\n" + more:  # the percent sign first
        text = text.replace(sign, f"%{ord(sign):02X}")
    return text


# SARIF: OASIS, Static Analysis Results Interchange Format 2.1.0.

_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def as_sarif(checked: list[Checked]) -> list[str]:
    """One log with one run, a line a result."""
    from importlib.metadata import version  # slow, and for this format only

    codes = sorted({each.code for file in checked for each in file.found})
    driver = {
        "name": "fasteroids",
        "semanticVersion": version("fasteroids"),
        "rules": [_rule(code) for code in codes],
    }
    index = {code: i for i, code in enumerate(codes)}
    results = [
        json.dumps(_result(file, each, index[each.code])) for file in checked for each in file.found
    ]
    head = json.dumps({"$schema": _SCHEMA, "version": "2.1.0"})[1:-1]
    return [
        f'{{{head}, "runs": [{{',
        f'"tool": {json.dumps({"driver": driver})},',
        '"columnKind": "unicodeCodePoints",',
        '"results": [',
        *(f"{result}," for result in results[:-1]),
        *results[-1:],
        "]}]}",
    ]


def _rule(name: str) -> dict[str, Any]:
    code = CODES[name]
    return {
        "id": name,
        "shortDescription": {"text": code.title},
        "fullDescription": {"text": code.why},
        "help": {"text": f"Wrong:\n\n{code.wrong}\n\nRight:\n\n{code.right}"},
        "properties": {"tags": [code.phase]},
    }


def _result(file: Checked, each: Diagnostic, index: int) -> dict[str, Any]:
    where = {"uri": _uri(file.place)}
    hint = f". {each.hint}" if each.hint else ""
    result: dict[str, Any] = {
        "ruleId": each.code,
        "ruleIndex": index,
        "level": each.severity,
        "message": {"text": each.message + hint},
        "locations": [_location(where, each.span)],
    }
    if each.notes:
        result["relatedLocations"] = [
            {"id": i, **_location(where, note.span), "message": {"text": note.text}}
            for i, note in enumerate(each.notes)
        ]
    if each.fix:
        change = {"artifactLocation": where, "replacements": [_edit(edit) for edit in each.fix]}
        result["fixes"] = [
            {"description": {"text": each.hint or each.message}, "artifactChanges": [change]}
        ]
    return result


def _location(where: dict[str, str], span: Span) -> dict[str, Any]:
    return {"physicalLocation": {"artifactLocation": where, "region": _region(span)}}


def _region(span: Span) -> dict[str, int]:
    return {
        "startLine": span.line,
        "startColumn": span.column,
        "endLine": span.end_line,
        "endColumn": span.end_column,
    }


def _edit(edit: Edit) -> dict[str, Any]:
    return {"deletedRegion": _region(edit.span), "insertedContent": {"text": edit.text}}


def _uri(place: str) -> str:
    if place == "-":
        return "stdin"
    return quote(place.replace(os.sep, "/"), errors="surrogateescape")
