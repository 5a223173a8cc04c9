"""The shell: the protocol over standard input and output. What is answered, the other modules work out."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from typing import Final

from lsprotocol import types
from pygls.exceptions import JsonRpcException

from fasteroids.lang.diagnostics import Edit
from fasteroids.lsp import completing, hovering, mending, navigating, wire
from fasteroids.lsp.navigating import Refused
from fasteroids.lsp.session import Document, Session

__all__ = ["serve"]

_MOST_OFFERED: Final = 1_000
"""Completions that an editor gets."""

_REQUEST_FAILED: Final = -32803
"""The protocol's code for what cannot be done, though it was asked for well."""

_FIX_ALL: Final = f"{types.CodeActionKind.SourceFixAll.value}.fasteroids"
"""What an editor that mends on saving asks for."""


def _opened(ls: Session, params: types.DidOpenTextDocumentParams) -> None:
    ls.look_at(params.text_document.uri)


def _changed(ls: Session, params: types.DidChangeTextDocumentParams) -> None:
    ls.look_at(params.text_document.uri)


def _closed(ls: Session, params: types.DidCloseTextDocumentParams) -> None:
    ls.close(params.text_document.uri)


def _hover(ls: Session, params: types.HoverParams) -> types.Hover | None:
    document = ls.document(params.text_document.uri)
    if document is None:
        return None
    found = hovering.hover(document.reading, document.place(params.position))
    formats = ls.can("text_document.hover.content_format") or ()
    markdown = types.MarkupKind.Markdown in formats
    return wire.hovered(document.page, found, markdown=markdown) if found else None


def _completion(ls: Session, params: types.CompletionParams) -> list[types.CompletionItem]:
    document = ls.document(params.text_document.uri)
    if document is None:
        return []
    typed = params.context.trigger_character if params.context else None
    snippets = bool(ls.can("text_document.completion.completion_item.snippet_support"))
    place = document.place(params.position)
    found = completing.completions(document.reading, place, typed=typed or "")
    return [
        wire.completion(document.page, each, rank, snippets=snippets)
        for rank, each in enumerate(found[:_MOST_OFFERED])
    ]


def _definition(ls: Session, params: types.DefinitionParams) -> list[types.Location]:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return []
    spans = navigating.definitions(document.reading, document.place(params.position))
    return [types.Location(uri, wire.range_of(document.page, span)) for span in spans]


def _references(ls: Session, params: types.ReferenceParams) -> list[types.Location]:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return []
    return [
        types.Location(uri, wire.range_of(document.page, each.span))
        for each in navigating.mentions(document.reading, document.place(params.position))
        if params.context.include_declaration or not each.declares
    ]


def _highlight(ls: Session, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    document = ls.document(params.text_document.uri)
    if document is None:
        return []
    found = navigating.mentions(document.reading, document.place(params.position))
    return [wire.highlight(document.page, each) for each in found]


def _symbols(ls: Session, params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
    document = ls.document(params.text_document.uri)
    if document is None:
        return []
    return [wire.symbol(document.page, each) for each in navigating.symbols(document.reading)]


def _may_rename(
    ls: Session, params: types.PrepareRenameParams
) -> types.PrepareRenamePlaceholder | None:
    document = ls.document(params.text_document.uri)
    if document is None:
        return None
    found = navigating.variable_at(document.reading, document.place(params.position))
    if isinstance(found, Refused):
        raise _refusal(found)
    name, span = found
    return types.PrepareRenamePlaceholder(wire.range_of(document.page, span), name)


def _rename(ls: Session, params: types.RenameParams) -> types.WorkspaceEdit | None:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return None
    place = document.place(params.position)
    found = navigating.renamed(document.reading, place, params.new_name)
    if isinstance(found, Refused):
        raise _refusal(found)
    return _workspace_edit(document, uri, found)


def _refusal(refused: Refused) -> JsonRpcException:
    return JsonRpcException(refused.reason, _REQUEST_FAILED)


def _formatting(ls: Session, params: types.DocumentFormattingParams) -> list[types.TextEdit] | None:
    document = ls.document(params.text_document.uri)
    if document is None:
        return None
    return wire.edits(document.page, mending.formatting(document.reading))


def _actions(ls: Session, params: types.CodeActionParams) -> list[types.CodeAction]:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return []
    found: list[types.CodeAction] = []
    if _asked(params.context.only, types.CodeActionKind.QuickFix.value):
        for fix in mending.fixes(document.reading, wire.span_of(document.page, params.range)):
            found.append(
                types.CodeAction(
                    title=fix.title,
                    kind=types.CodeActionKind.QuickFix,
                    diagnostics=[ls.diagnostic(document, uri, fix.fault)],
                    is_preferred=True,
                    edit=_workspace_edit(document, uri, fix.edits),
                )
            )
    # That takes many readings: it is worked out only for who may use it.
    if (found or params.context.only) and _asked(params.context.only, _FIX_ALL):
        edits = mending.fix_all(document.reading)
        if edits:
            found.append(
                types.CodeAction(
                    title="Put in all fixes",
                    kind=_FIX_ALL,
                    edit=_workspace_edit(document, uri, edits),
                )
            )
    return found


def _asked(only: object, kind: str) -> bool:
    """Does an editor that asks for some kinds of actions alone, or for any, want this one?"""
    if not isinstance(only, list | tuple) or not only:
        return True
    wanted = [each.value if isinstance(each, types.CodeActionKind) else each for each in only]
    return any(each == "" or kind == each or kind.startswith(f"{each}.") for each in wanted)


def _workspace_edit(document: Document, uri: str, edits: tuple[Edit, ...]) -> types.WorkspaceEdit:
    return types.WorkspaceEdit(changes={uri: wire.edits(document.page, edits)})


def _shutdown(ls: Session, *_: object) -> None:
    ls.orderly = True


_FEATURES: Final[tuple[tuple[str, Callable[..., object], object], ...]] = (
    (types.TEXT_DOCUMENT_DID_OPEN, _opened, None),
    (types.TEXT_DOCUMENT_DID_CHANGE, _changed, None),
    (types.TEXT_DOCUMENT_DID_CLOSE, _closed, None),
    (types.TEXT_DOCUMENT_HOVER, _hover, None),
    (
        types.TEXT_DOCUMENT_COMPLETION,
        _completion,
        types.CompletionOptions(trigger_characters=[" ", "("]),
    ),
    (types.TEXT_DOCUMENT_DEFINITION, _definition, None),
    (types.TEXT_DOCUMENT_REFERENCES, _references, None),
    (types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, _highlight, None),
    (types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, _symbols, None),
    (types.TEXT_DOCUMENT_PREPARE_RENAME, _may_rename, None),
    (types.TEXT_DOCUMENT_RENAME, _rename, types.RenameOptions(prepare_provider=True)),
    (types.TEXT_DOCUMENT_FORMATTING, _formatting, None),
    (
        types.TEXT_DOCUMENT_CODE_ACTION,
        _actions,
        types.CodeActionOptions(code_action_kinds=[types.CodeActionKind.QuickFix, _FIX_ALL]),
    ),
    (types.SHUTDOWN, _shutdown, None),
)


def serve() -> bool:
    """Talk with an editor over standard input and output until it leaves. Did it say so before?

    Whatever else would be printed goes to standard error, so that nothing gets between the messages.
    """
    server = Session()
    for method, answer, options in _FEATURES:
        server.feature(method, options)(answer)
    stdout = sys.stdout.buffer
    with redirect_stdout(sys.stderr):
        server.start_io(sys.stdin.buffer, stdout)
    return server.orderly
