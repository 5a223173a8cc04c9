"""One editor: the texts that it has open, and what it is told about them without asking.

An editor tells the whole text at each change. Programs are short, and so the two sides cannot come to differ about it:
the library would cut lines where the protocol does not, at form feeds and the like.
"""

from __future__ import annotations

import asyncio
from functools import reduce
from importlib.metadata import version
from typing import Any, Final, cast
from urllib.parse import unquote

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lsp import wire
from fasteroids.lsp.positions import Encoding, Page
from fasteroids.lsp.reading import Place, Reading

__all__ = ["MOST_BYTES", "Document", "Session"]

MOST_BYTES: Final = 1024 * 1024
"""Longer texts are no programs: nothing is said about them but that. The same limit as of files."""

_MOST_FAULTS: Final = 500
"""Diagnostics of one text that an editor gets."""

_QUICK: Final = 50_000
"""Characters that are looked at in some 50 ms or less, so at each key."""

_PAUSE: Final = 0.3
"""Seconds without a key after which a longer text is looked at."""


class Session(LanguageServer):
    """The texts that are open, each read at most once."""

    def __init__(self) -> None:
        super().__init__(
            "fasteroids", version("fasteroids"), types.TextDocumentSyncKind.Full, max_workers=1
        )
        self.orderly = False
        """Has the editor said that it is about to leave?"""
        self._open: dict[str, Document] = {}
        self._waiting: dict[str, asyncio.TimerHandle] = {}

    def can(self, path: str) -> Any:
        """What the editor says about one of its capabilities, named with points; None if nothing."""
        return reduce(
            lambda found, name: getattr(found, name, None),
            path.split("."),
            cast("Any", self.client_capabilities),
        )

    def document(self, uri: str) -> Document | None:
        """An open text; None if there is none, or if it is too long."""
        known = self.workspace.text_documents.get(unquote(uri))
        if known is None:
            return None
        found = self._open.get(uri)
        if found is None or found.reading.text != known.source:
            found = Document(known.source, cast("Encoding", self._encoding()))
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
        if found is None:
            self._tell(uri, known.version, [_TOO_LONG])
        else:
            first = found.reading.faults[:_MOST_FAULTS]
            self._tell(uri, known.version, [self.diagnostic(found, uri, each) for each in first])

    def diagnostic(self, document: Document, uri: str, fault: Diagnostic) -> types.Diagnostic:
        """A fault of a text, as this editor can show it."""
        related = bool(self.can("text_document.publish_diagnostics.related_information"))
        return wire.diagnostic(document.page, fault, uri, related=related)

    def _tell(self, uri: str, number: int | None, found: list[types.Diagnostic]) -> None:
        self.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(uri=uri, version=number, diagnostics=found)
        )


class Document:
    """An open text."""

    def __init__(self, text: str, encoding: Encoding) -> None:
        self.reading = Reading(text)
        self.page = Page(text, encoding)
        self.too_long = len(text) > MOST_BYTES or (
            len(text) * 4 > MOST_BYTES and len(text.encode(errors="surrogatepass")) > MOST_BYTES
        )

    def place(self, position: types.Position) -> Place:
        """Line and column of an editor's position."""
        return wire.place(self.page, position)


_TOO_LONG: Final = types.Diagnostic(
    range=types.Range(types.Position(0, 0), types.Position(0, 0)),
    severity=types.DiagnosticSeverity.Error,
    source=wire.SOURCE,
    message=f"A program has at most {MOST_BYTES} bytes; this one has more, and is not looked at",
)
