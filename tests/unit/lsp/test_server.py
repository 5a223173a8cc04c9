"""The language server, end to end: a real client talks with `python -m fasteroids lsp`."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import pytest_lsp
from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities

pytestmark = pytest.mark.asyncio(loop_scope="module")

URI = "file:///hunter.ast"
COMMAND = [sys.executable, "-m", "fasteroids", "lsp"]
ROOT = Path(__file__).parents[3]

PROGRAM = """\
// \U0001f680 hunter
entity a;
double best;
while (true) {
  best := 0;
  foreach (asteroid, a) {
    best := best + getx a;
  }
  turn best;  // \U0001f680
}
"""


@pytest_lsp.fixture(scope="module", config=ClientServerConfig(server_command=COMMAND))
async def client(lsp_client: LanguageClient) -> AsyncIterator[None]:
    shown = await lsp_client.initialize_session(
        types.InitializeParams(
            capabilities=client_capabilities("visual-studio-code"), process_id=None, root_uri=None
        )
    )
    assert shown.server_info is not None
    assert shown.server_info.name == "fasteroids"
    yield
    await lsp_client.shutdown_session()


def place(text: str, mark: str, *, behind: int = 0) -> types.Position:
    """The position where a piece of text first stands, in the units of UTF-16, which is the default."""
    before = text[: text.index(mark) + behind]
    row = before.rsplit("\n", 1)[-1]
    return types.Position(before.count("\n"), len(row.encode("utf-16-le")) // 2)


DOCUMENT = types.TextDocumentIdentifier(URI)
_versions = iter(range(1, 1_000_000))


def told(client: LanguageClient) -> asyncio.Task[types.PublishDiagnosticsParams]:
    """What the server will say next about a text."""
    return asyncio.create_task(
        client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    )


async def opened(client: LanguageClient, text: str, uri: str = URI) -> list[types.Diagnostic]:
    """What the server says about a text that is opened."""
    waited = told(client)
    client.text_document_did_open(
        types.DidOpenTextDocumentParams(
            types.TextDocumentItem(uri, "fasteroids", next(_versions), text)
        )
    )
    return list((await asyncio.wait_for(waited, 30)).diagnostics)


async def typed(client: LanguageClient, text: str) -> list[types.Diagnostic]:
    """What the server says about a text after a change."""
    waited = told(client)
    client.text_document_did_change(
        types.DidChangeTextDocumentParams(
            types.VersionedTextDocumentIdentifier(next(_versions), URI),
            [types.TextDocumentContentChangeWholeDocument(text)],
        )
    )
    return list((await asyncio.wait_for(waited, 30)).diagnostics)


async def test_diagnostics_come_with_each_change_and_go_when_the_text_is_closed(
    client: LanguageClient,
) -> None:
    assert await opened(client, PROGRAM) == []
    (wrong,) = await typed(client, PROGRAM.replace("turn best", "turn a"))
    assert (wrong.code, wrong.severity, wrong.source) == (
        "FA107",
        types.DiagnosticSeverity.Error,
        "fasteroids",
    )
    assert wrong.message.startswith("The angle of `turn` must be a double, but this is an entity")
    assert wrong.range.start == place(PROGRAM, "turn best", behind=5)
    assert wrong.related_information is not None
    (other,) = wrong.related_information
    assert (other.message, other.location.uri) == ("`a` is declared entity here", URI)
    assert other.location.range.start == place(PROGRAM, "a;")
    assert await typed(client, PROGRAM) == []
    await typed(client, "fire")
    waited = told(client)
    client.text_document_did_close(types.DidCloseTextDocumentParams(DOCUMENT))
    assert not (await asyncio.wait_for(waited, 30)).diagnostics


async def test_what_has_no_effect_is_shown_faded(client: LanguageClient) -> None:
    unused, unreached = await opened(client, "double d; while (true) { fire; } skip;")
    for each, code in ((unused, "FA206"), (unreached, "FA201")):
        assert (each.code, each.severity) == (code, types.DiagnosticSeverity.Warning)
        assert each.tags == (types.DiagnosticTag.Unnecessary,)
    (unset,) = await typed(client, "double d; turn d;")
    assert (unset.code, unset.tags) == ("FA205", None)


async def test_hover_shows_an_expression_with_its_type_and_what_it_means(
    client: LanguageClient,
) -> None:
    await opened(client, PROGRAM)
    found = await client.text_document_hover_async(
        types.HoverParams(DOCUMENT, place(PROGRAM, "getx a"))
    )
    assert found is not None
    assert isinstance(found.contents, types.MarkupContent)
    assert found.contents.kind == types.MarkupKind.Markdown
    code, sentence = found.contents.value.split("\n\n")
    assert code == "```fasteroids\ngetx a: double\n```"
    assert "km" in sentence
    nothing = await client.text_document_hover_async(
        types.HoverParams(DOCUMENT, types.Position(0, 0))
    )
    assert nothing is None


async def test_completion_offers_entities_behind_a_getter_and_snippets_for_statements(
    client: LanguageClient,
) -> None:
    await opened(client, PROGRAM)
    found = await client.text_document_completion_async(
        types.CompletionParams(DOCUMENT, place(PROGRAM, "getx a", behind=5))
    )
    assert isinstance(found, list)
    assert [each.label for each in found] == ["a", "self"]
    found = await client.text_document_completion_async(
        types.CompletionParams(DOCUMENT, place(PROGRAM, "turn"))
    )
    assert isinstance(found, list)
    turn = next(each for each in found if each.label == "turn")
    assert turn.insert_text_format == types.InsertTextFormat.Snippet
    assert isinstance(turn.text_edit, types.TextEdit)
    assert turn.text_edit.new_text == "turn ${1:0.1};"
    assert turn.text_edit.range.start == place(PROGRAM, "turn")
    assert [each.sort_text for each in found] == sorted(each.sort_text or "" for each in found)


async def test_a_blank_at_the_start_of_a_statement_asks_for_nothing(client: LanguageClient) -> None:
    await opened(client, PROGRAM)
    found = await client.text_document_completion_async(
        types.CompletionParams(
            DOCUMENT,
            place(PROGRAM, "  turn", behind=1),
            context=types.CompletionContext(types.CompletionTriggerKind.TriggerCharacter, " "),
        )
    )
    assert found == []


async def test_definition_references_and_highlights_find_a_variable(client: LanguageClient) -> None:
    await opened(client, PROGRAM)
    use = place(PROGRAM, "getx a", behind=5)
    declared = place(PROGRAM, "a;")
    definition = await client.text_document_definition_async(types.DefinitionParams(DOCUMENT, use))
    assert isinstance(definition, list)
    (found,) = definition
    assert isinstance(found, types.Location)
    assert (found.uri, found.range.start) == (URI, declared)
    places = [declared, place(PROGRAM, "a) {"), use]
    for whole in (True, False):
        references = await client.text_document_references_async(
            types.ReferenceParams(types.ReferenceContext(whole), DOCUMENT, use)
        )
        assert references is not None
        assert [each.range.start for each in references] == places[not whole :]
    marks = await client.text_document_document_highlight_async(
        types.DocumentHighlightParams(DOCUMENT, use)
    )
    assert marks is not None
    write, read = types.DocumentHighlightKind.Write, types.DocumentHighlightKind.Read
    assert [(each.range.start, each.kind) for each in marks] == [
        (places[0], write),
        (places[1], write),
        (places[2], read),
    ]


async def test_rename_changes_every_place_and_refuses_with_a_sentence(
    client: LanguageClient,
) -> None:
    await opened(client, PROGRAM)
    use = place(PROGRAM, "turn best", behind=6)
    ready = await client.text_document_prepare_rename_async(
        types.PrepareRenameParams(DOCUMENT, use)
    )
    assert isinstance(ready, types.PrepareRenamePlaceholder)
    assert (ready.placeholder, ready.range.start) == ("best", place(PROGRAM, "turn best", behind=5))
    changes = await client.text_document_rename_async(types.RenameParams(DOCUMENT, use, "sum"))
    assert changes is not None
    assert changes.changes is not None
    assert [each.new_text for each in changes.changes[URI]] == ["sum"] * 5
    with pytest.raises(JsonRpcException, match="`a` is another variable already"):
        await client.text_document_rename_async(types.RenameParams(DOCUMENT, use, "a"))
    with pytest.raises(JsonRpcException, match="only variables can be renamed"):
        await client.text_document_prepare_rename_async(
            types.PrepareRenameParams(DOCUMENT, place(PROGRAM, "while"))
        )


async def test_formatting_changes_only_a_text_without_syntax_errors(client: LanguageClient) -> None:
    options = types.FormattingOptions(tab_size=2, insert_spaces=True)
    params = types.DocumentFormattingParams(DOCUMENT, options)
    await opened(client, "fire;\nif(true){skip}\nfire;\n")
    edits = await client.text_document_formatting_async(params)
    assert edits is not None
    (edit,) = edits
    assert edit.new_text == "if (true) {\n  skip;\n}\n"
    assert edit.range == types.Range(types.Position(1, 0), types.Position(2, 0))
    for text in (PROGRAM, "if(true){skip"):
        await typed(client, text)
        assert not await client.text_document_formatting_async(params)


async def test_quick_fixes_mend_what_is_asked_about_and_one_action_mends_all(
    client: LanguageClient,
) -> None:
    text = "double d;\nd = 1;\nturn d\nfire;\n"
    first, second = await opened(client, text)
    line = types.Range(types.Position(1, 0), types.Position(1, 5))
    actions = await client.text_document_code_action_async(
        types.CodeActionParams(DOCUMENT, line, types.CodeActionContext([first]))
    )
    assert actions is not None
    fix, fix_all = actions
    assert isinstance(fix, types.CodeAction)
    assert isinstance(fix_all, types.CodeAction)
    assert (fix.kind, fix.is_preferred) == (types.CodeActionKind.QuickFix, True)
    assert fix.diagnostics == (first,)
    assert fix.edit is not None
    assert fix.edit.changes is not None
    (edit,) = fix.edit.changes[URI]
    assert (edit.new_text, edit.range) == (":=", first.range)
    assert fix_all.edit is not None
    assert fix_all.edit.changes is not None
    (whole,) = fix_all.edit.changes[URI]
    assert whole.new_text == "d := 1;\nturn d;\n"
    only = types.CodeActionContext([second], only=[types.CodeActionKind.SourceFixAll])
    actions = await client.text_document_code_action_async(
        types.CodeActionParams(DOCUMENT, line, only)
    )
    assert [*(actions or ())] == [fix_all]


async def test_the_outline_has_the_declarations(client: LanguageClient) -> None:
    await opened(client, PROGRAM)
    found = await client.text_document_document_symbol_async(types.DocumentSymbolParams(DOCUMENT))
    assert found is not None
    assert [
        (each.name, each.detail) for each in found if isinstance(each, types.DocumentSymbol)
    ] == [
        ("a", "entity"),
        ("best", "double"),
    ]


async def test_nothing_is_known_of_a_text_that_was_never_opened(client: LanguageClient) -> None:
    other = types.TextDocumentIdentifier("file:///nowhere.ast")
    start = types.Position(0, 0)
    assert await client.text_document_hover_async(types.HoverParams(other, start)) is None
    assert await client.text_document_rename_async(types.RenameParams(other, start, "b")) is None
    params = types.DocumentSymbolParams(other)
    assert await client.text_document_document_symbol_async(params) == []


async def test_a_text_that_is_too_long_gets_one_sentence(client: LanguageClient) -> None:
    uri = "file:///long.ast"
    (only,) = await opened(client, "// \N{SNOWMAN}" * 300_000, uri)
    assert "at most 1048576 bytes" in only.message
    document = types.TextDocumentIdentifier(uri)
    start = types.Position(0, 0)
    assert await client.text_document_hover_async(types.HoverParams(document, start)) is None


async def test_a_long_text_is_looked_at_once_the_typing_stops(client: LanguageClient) -> None:
    uri = "file:///longer.ast"
    found = await opened(client, "turn 0;\n" * 10_000 + "turn a;", uri)
    assert [each.code for each in found] == ["FA101"]


async def test_a_long_text_that_is_closed_before_that_is_looked_at_no_more(
    client: LanguageClient,
) -> None:
    uri = "file:///closed.ast"
    waited = told(client)
    item = types.TextDocumentItem(uri, "fasteroids", next(_versions), "turn 0;\n" * 10_000 + "turn")
    client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    document = types.TextDocumentIdentifier(uri)
    client.text_document_did_close(types.DidCloseTextDocumentParams(document))
    assert not (await asyncio.wait_for(waited, 30)).diagnostics
    with pytest.raises(TimeoutError):
        await asyncio.wait_for(told(client), 1)


async def test_two_texts_are_kept_apart_and_one_opened_anew_is_another(
    client: LanguageClient,
) -> None:
    one, other = "file:///one.ast", "file:///other.ast"
    assert await opened(client, "entity a; print getx a + a;", one)
    assert not await opened(client, "double a; a := getdir; turn a;", other)

    async def shown(uri: str) -> str | None:
        place = types.Position(0, 7)
        document = types.TextDocumentIdentifier(uri)
        found = await client.text_document_hover_async(types.HoverParams(document, place))
        if found is None:
            return None
        assert isinstance(found.contents, types.MarkupContent)
        return found.contents.value.splitlines()[1]

    assert (await shown(one), await shown(other)) == ("entity a", "double a")
    closed = types.DidCloseTextDocumentParams(types.TextDocumentIdentifier(one))
    waited = told(client)
    client.text_document_did_close(closed)
    await asyncio.wait_for(waited, 30)
    assert (await shown(one), await shown(other)) == (None, "double a")
    assert not await opened(client, "bool   a; a := true; print a;", one)
    assert (await shown(one), await shown(other)) == ("bool a", "double a")
