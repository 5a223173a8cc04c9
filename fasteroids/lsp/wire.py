"""The values of the other modules in the words of the protocol (LSP 3.17)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from lsprotocol import types

from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.source import Span
from fasteroids.lsp.completing import Completion, Kind
from fasteroids.lsp.hovering import Hover
from fasteroids.lsp.navigating import Mention, Symbol
from fasteroids.lsp.positions import Page, Position
from fasteroids.lsp.reading import Place

__all__ = [
    "SOURCE",
    "completion",
    "diagnostic",
    "edits",
    "highlight",
    "hovered",
    "place",
    "range_of",
    "span_of",
    "symbol",
]

SOURCE: Final = "fasteroids"
"""What an editor shows as the origin of a diagnostic."""

_SEVERITIES: Final = {
    "error": types.DiagnosticSeverity.Error,
    "warning": types.DiagnosticSeverity.Warning,
}

_IN_VAIN: Final = frozenset({"FA201", "FA202", "FA204", "FA206"})
"""About what has no effect: never reached, never read, not used. Editors show it faded."""

_KINDS: Final[dict[Kind, types.CompletionItemKind]] = {
    "variable": types.CompletionItemKind.Variable,
    "statement": types.CompletionItemKind.Keyword,
    "type": types.CompletionItemKind.Class,
    "kind": types.CompletionItemKind.EnumMember,
    "constant": types.CompletionItemKind.Constant,
    "function": types.CompletionItemKind.Function,
    "operator": types.CompletionItemKind.Operator,
}


def place(page: Page, position: types.Position) -> Place:
    """Line and column of an editor's position."""
    return page.place(Position(position.line, position.character))


def span_of(page: Page, piece: types.Range) -> Span:
    """A piece of text that an editor names, whichever end comes first."""
    return Span(*min(ends := (place(page, piece.start), place(page, piece.end))), *max(ends))


def range_of(page: Page, span: Span) -> types.Range:
    """A piece of text, for an editor."""
    start, end = page.range(span)
    return types.Range(types.Position(*start), types.Position(*end))


def edits(page: Page, changes: Iterable[Edit]) -> list[types.TextEdit]:
    """Changes to a text."""
    return [types.TextEdit(range_of(page, each.span), each.text) for each in changes]


def diagnostic(page: Page, fault: Diagnostic, uri: str, *, related: bool) -> types.Diagnostic:
    """What is wrong, with its hint; and the other places it speaks of, if the editor can show such."""
    notes = [
        types.DiagnosticRelatedInformation(
            types.Location(uri, range_of(page, note.span)), note.text
        )
        for note in fault.notes
    ]
    return types.Diagnostic(
        range=range_of(page, fault.span),
        severity=_SEVERITIES[fault.severity],
        code=fault.code,
        source=SOURCE,
        message=f"{fault.message}\n{fault.hint}" if fault.hint else fault.message,
        tags=[types.DiagnosticTag.Unnecessary] if fault.code in _IN_VAIN else None,
        related_information=notes if related and notes else None,
    )


def hovered(page: Page, found: Hover, *, markdown: bool) -> types.Hover:
    """A line of code, and sentences below it."""
    code = f"```fasteroids\n{found.code}\n```" if markdown else found.code
    text = "\n\n".join([code, *([" ".join(found.sentences)] if found.sentences else [])])
    kind = types.MarkupKind.Markdown if markdown else types.MarkupKind.PlainText
    return types.Hover(types.MarkupContent(kind, text), range_of(page, found.span))


def completion(page: Page, found: Completion, rank: int, *, snippets: bool) -> types.CompletionItem:
    """Something to write. Editors sort by text, so the rank is one."""
    snippet = snippets and found.snippet != found.plain
    text = found.snippet if snippet else found.plain
    return types.CompletionItem(
        label=found.label,
        kind=_KINDS[found.kind],
        detail=found.detail,
        documentation=found.sentence or None,
        sort_text=f"{rank:06}",
        insert_text_format=(
            types.InsertTextFormat.Snippet if snippet else types.InsertTextFormat.PlainText
        ),
        text_edit=types.TextEdit(range_of(page, found.span), text),
    )


def highlight(page: Page, found: Mention) -> types.DocumentHighlight:
    """A place where a variable is named."""
    kind = types.DocumentHighlightKind
    return types.DocumentHighlight(
        range_of(page, found.span), kind.Write if found.sets or found.declares else kind.Read
    )


def symbol(page: Page, found: Symbol) -> types.DocumentSymbol:
    """A declaration."""
    return types.DocumentSymbol(
        name=found.name,
        detail=found.type,
        kind=types.SymbolKind.Variable,
        range=range_of(page, found.span),
        selection_range=range_of(page, found.name_span),
    )
