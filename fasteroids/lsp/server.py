"""The shell: the protocol over standard input and output. What is answered, the other modules work out.

An editor tells the whole text at each change. Programs are short, and so no two sides can come to differ about it: the
library would cut lines where the protocol does not, at form feeds and the like.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from functools import reduce
from importlib.metadata import version
from typing import Any, Final, cast
from urllib.parse import unquote

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer

from fasteroids.lang.diagnostics import Edit
from fasteroids.lsp import completing, hovering, mending, navigating, wire
from fasteroids.lsp.navigating import Refused
from fasteroids.lsp.positions import Encoding, Page
from fasteroids.lsp.reading import Place, Reading

__all__ = ["MOST_BYTES", "serve"]

MOST_BYTES: Final = 1024 * 1024
"""Longer texts are no programs: nothing is said about them but that. The same limit as of files."""

_MOST_FAULTS: Final = 500
"""Diagnostics of one text that an editor gets."""

_MOST_OFFERED: Final = 1_000
"""Completions that an editor gets."""

_QUICK: Final = 50_000
"""Characters that are looked at in some 50 ms or less, so at each key."""

_PAUSE: Final = 0.3
"""Seconds without a key after which a longer text is looked at."""

_REQUEST_FAILED: Final = -32803
"""The protocol's code for what cannot be done, though it was asked for well."""

_FIX_ALL: Final = f"{types.CodeActionKind.SourceFixAll.value}.fasteroids"
"""What an editor that mends on saving asks for."""


class _Server(LanguageServer):
    """The texts that are open, each read at most once."""

    def __init__(self) -> None:
        super().__init__(
            "fasteroids", version("fasteroids"), types.TextDocumentSyncKind.Full, max_workers=1
        )
        self.orderly = False
        """Has the editor said that it is about to leave?"""
        self._open: dict[str, _Document] = {}
        self._waiting: dict[str, asyncio.TimerHandle] = {}

    def can(self, path: str) -> Any:
        """What the editor says about one of its capabilities, named with points; None if nothing."""
        return reduce(
            lambda found, name: getattr(found, name, None),
            path.split("."),
            cast("Any", self.client_capabilities),
        )

    def document(self, uri: str) -> _Document | None:
        """An open text; None if there is none, or if it is too long."""
        known = self.workspace.text_documents.get(unquote(uri))
        if known is None:
            return None
        found = self._open.get(uri)
        if found is None or found.reading.text != known.source:
            found = _Document(known.source, cast("Encoding", self._encoding()))
            self._open[uri] = found
        return None if found.too_long else found

    def _encoding(self) -> str:
        told = self.workspace.position_encoding
        return str(told.value if isinstance(told, types.PositionEncodingKind) else told)

    def look_at(self, uri: str) -> None:
        """Say what is wrong with a text, at once or, if that takes long, when nobody types any more."""
        self.forget(uri)
        known = self.workspace.text_documents.get(unquote(uri))
        if known is None:
            return
        if len(known.source) <= _QUICK:
            self._publish(uri)
        else:
            loop = asyncio.get_running_loop()
            self._waiting[uri] = loop.call_later(_PAUSE, self._publish, uri)

    def forget(self, uri: str) -> None:
        """Do not look at a text that waits for it."""
        waiting = self._waiting.pop(uri, None)
        if waiting is not None:
            waiting.cancel()

    def close(self, uri: str) -> None:
        """A text is not open any more, and nothing is wrong with it."""
        self.forget(uri)
        self._open.pop(uri, None)
        self._tell(uri, None, [])

    def _publish(self, uri: str) -> None:
        known = self.workspace.text_documents.get(unquote(uri))
        if known is None:
            return
        found = self.document(uri)
        self._tell(uri, known.version, [_TOO_LONG] if found is None else self.faults(found, uri))

    def faults(self, found: _Document, uri: str) -> list[types.Diagnostic]:
        """What is wrong with a text, the first of it if that is much."""
        related = bool(self.can("text_document.publish_diagnostics.related_information"))
        return [
            wire.diagnostic(found.page, each, uri, related=related)
            for each in found.reading.faults[:_MOST_FAULTS]
        ]

    def _tell(self, uri: str, number: int | None, found: list[types.Diagnostic]) -> None:
        self.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(uri=uri, version=number, diagnostics=found)
        )


class _Document:
    """An open text."""

    def __init__(self, text: str, encoding: Encoding) -> None:
        self.reading = Reading(text)
        self.page = Page(text, encoding)
        self.too_long = len(text) > MOST_BYTES or (
            len(text) * 4 > MOST_BYTES and len(text.encode(errors="surrogatepass")) > MOST_BYTES
        )

    def place(self, position: types.Position) -> Place:
        return wire.place(self.page, position)


_TOO_LONG: Final = types.Diagnostic(
    range=types.Range(types.Position(0, 0), types.Position(0, 0)),
    severity=types.DiagnosticSeverity.Error,
    source=wire.SOURCE,
    message=f"A program has at most {MOST_BYTES} bytes; this one has more, and is not looked at",
)


def _opened(ls: _Server, params: types.DidOpenTextDocumentParams) -> None:
    ls.look_at(params.text_document.uri)


def _changed(ls: _Server, params: types.DidChangeTextDocumentParams) -> None:
    ls.look_at(params.text_document.uri)


def _closed(ls: _Server, params: types.DidCloseTextDocumentParams) -> None:
    ls.close(params.text_document.uri)


def _hover(ls: _Server, params: types.HoverParams) -> types.Hover | None:
    document = ls.document(params.text_document.uri)
    if document is None:
        return None
    found = hovering.hover(document.reading, document.place(params.position))
    formats = ls.can("text_document.hover.content_format") or ()
    markdown = types.MarkupKind.Markdown in formats
    return wire.hovered(document.page, found, markdown=markdown) if found else None


def _completion(ls: _Server, params: types.CompletionParams) -> list[types.CompletionItem]:
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


def _definition(ls: _Server, params: types.DefinitionParams) -> list[types.Location]:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return []
    spans = navigating.definitions(document.reading, document.place(params.position))
    return [types.Location(uri, wire.range_of(document.page, span)) for span in spans]


def _references(ls: _Server, params: types.ReferenceParams) -> list[types.Location]:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return []
    return [
        types.Location(uri, wire.range_of(document.page, each.span))
        for each in navigating.mentions(document.reading, document.place(params.position))
        if params.context.include_declaration or not each.declares
    ]


def _highlight(ls: _Server, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    document = ls.document(params.text_document.uri)
    if document is None:
        return []
    found = navigating.mentions(document.reading, document.place(params.position))
    return [wire.highlight(document.page, each) for each in found]


def _symbols(ls: _Server, params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
    document = ls.document(params.text_document.uri)
    if document is None:
        return []
    return [wire.symbol(document.page, each) for each in navigating.symbols(document.reading)]


def _may_rename(
    ls: _Server, params: types.PrepareRenameParams
) -> types.PrepareRenamePlaceholder | None:
    document = ls.document(params.text_document.uri)
    if document is None:
        return None
    found = navigating.variable_at(document.reading, document.place(params.position))
    if isinstance(found, Refused):
        raise _refusal(found)
    name, span = found
    return types.PrepareRenamePlaceholder(wire.range_of(document.page, span), name)


def _rename(ls: _Server, params: types.RenameParams) -> types.WorkspaceEdit | None:
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


def _formatting(ls: _Server, params: types.DocumentFormattingParams) -> list[types.TextEdit] | None:
    document = ls.document(params.text_document.uri)
    if document is None:
        return None
    return wire.edits(document.page, mending.formatting(document.reading))


def _actions(ls: _Server, params: types.CodeActionParams) -> list[types.CodeAction]:
    uri = params.text_document.uri
    document = ls.document(uri)
    if document is None:
        return []
    found: list[types.CodeAction] = []
    if _asked(params.context.only, types.CodeActionKind.QuickFix.value):
        related = bool(ls.can("text_document.publish_diagnostics.related_information"))
        for fix in mending.fixes(document.reading, wire.span_of(document.page, params.range)):
            found.append(
                types.CodeAction(
                    title=fix.title,
                    kind=types.CodeActionKind.QuickFix,
                    diagnostics=[wire.diagnostic(document.page, fix.fault, uri, related=related)],
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


def _workspace_edit(document: _Document, uri: str, edits: tuple[Edit, ...]) -> types.WorkspaceEdit:
    return types.WorkspaceEdit(changes={uri: wire.edits(document.page, edits)})


def _shutdown(ls: _Server, *_: object) -> None:
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
    server = _Server()
    for method, answer, options in _FEATURES:
        server.feature(method, options)(answer)
    stdout = sys.stdout.buffer
    with redirect_stdout(sys.stderr):
        server.start_io(sys.stdin.buffer, stdout)
    return server.orderly
