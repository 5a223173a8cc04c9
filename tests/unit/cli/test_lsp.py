"""`fasteroids lsp` as a process: what goes over its pipes, how it ends, and what it needs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from signal import SIGINT
from threading import Timer
from typing import Any

import pytest
from click.testing import Result

COMMAND = [sys.executable, "-m", "fasteroids", "lsp"]
URI = "file:///hunter.ast"


class Talk:
    """Messages by hand, to a server that must say nothing else on its standard output."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self._last = 0

    def send(self, data: bytes) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(data), data))
        self.process.stdin.flush()

    def tell(self, method: str, **params: Any) -> None:
        self.send(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}).encode())

    def ask(self, method: str, **params: Any) -> dict[str, Any]:
        """The answer to a request; what the server says before it is passed over."""
        self._last += 1
        message = {"jsonrpc": "2.0", "id": self._last, "method": method, "params": params}
        self.send(json.dumps(message).encode())
        while True:
            heard = self.hear()
            if heard.get("id") == self._last:
                return heard

    def hear(self) -> dict[str, Any]:
        """The next message: its head, and a body of the size that the head says."""
        stdout = self.process.stdout
        assert stdout is not None
        size = 0
        while (line := stdout.readline()) != b"\r\n":
            name, _, value = line.decode().partition(": ")
            assert name in ("Content-Length", "Content-Type"), line
            size = int(value) if name == "Content-Length" else size
        heard = json.loads(stdout.read(size))
        assert isinstance(heard, dict)
        return heard

    def start(self, **capabilities: Any) -> dict[str, Any]:
        """What the server says it can do."""
        answer = self.ask("initialize", processId=None, rootUri=None, capabilities=capabilities)
        self.tell("initialized")
        can = answer["result"]["capabilities"]
        assert isinstance(can, dict)
        return can

    def open(self, text: str) -> None:
        document = {"uri": URI, "languageId": "fasteroids", "version": 1, "text": text}
        self.tell("textDocument/didOpen", textDocument=document)

    def end(self) -> int:
        """The exit code, after the end of the input; and nothing is left on standard output."""
        assert self.process.stdout is not None
        rest = self.process.communicate(timeout=60)[0]
        assert rest == b""
        return self.process.returncode


@pytest.fixture
def talk() -> Iterator[Talk]:
    talk = Talk()
    watchdog = Timer(60, talk.process.kill)  # a server that is stuck fails the test, not the run
    watchdog.start()
    with talk.process:
        yield talk
        watchdog.cancel()
        talk.process.kill()


def test_an_editor_that_leaves_in_order_ends_it_with_0(talk: Talk) -> None:
    talk.start()
    assert talk.ask("shutdown")["result"] is None
    talk.tell("exit")
    assert talk.end() == 0


def test_an_editor_that_is_gone_ends_it_with_1(talk: Talk) -> None:
    talk.start()
    assert talk.end() == 1


def test_an_interrupt_ends_it_while_the_editor_is_still_there(talk: Talk) -> None:
    talk.start()
    talk.process.send_signal(SIGINT)
    assert talk.process.wait(timeout=30) == -SIGINT


def test_it_tells_all_that_it_can_do(talk: Talk) -> None:
    can = talk.start(textDocument={"rename": {"prepareSupport": True}})
    for name in (
        "hover", "definition", "references", "documentHighlight", "documentSymbol",
        "documentFormatting", "completion", "rename", "codeAction",
    ):  # fmt: skip
        assert can[f"{name}Provider"], name
    assert can["renameProvider"]["prepareProvider"] is True
    assert can["textDocumentSync"]["change"] == 1  # the whole text
    assert can["positionEncoding"] == "utf-16"


@pytest.mark.parametrize(("encoding", "before"), [("utf-8", 4), ("utf-16", 2), ("utf-32", 1)])
def test_places_are_in_the_units_that_the_editor_asks_for(
    talk: Talk, encoding: str, before: int
) -> None:
    assert talk.start(general={"positionEncodings": [encoding]})["positionEncoding"] == encoding
    talk.open("\U0001f680 turn getdir;")
    said = talk.hear()["params"]
    assert said["uri"] == URI
    assert said["diagnostics"][0]["range"]["end"] == {"line": 0, "character": before}
    position = {"line": 0, "character": before + 7}
    found = talk.ask("textDocument/hover", textDocument={"uri": URI}, position=position)
    assert found["result"]["range"]["start"]["character"] == before + 6
    assert found["result"]["contents"]["value"].startswith("getdir: double")


def test_an_editor_that_can_do_little_gets_what_it_can_show(talk: Talk) -> None:
    talk.start()
    talk.open("entity e;\nturn e;\n")
    [fault] = talk.hear()["params"]["diagnostics"]
    assert fault["code"] == "FA107"
    assert "relatedInformation" not in fault
    assert "codeDescription" not in fault
    place = {"textDocument": {"uri": URI}, "position": {"line": 1, "character": 0}}
    offered = talk.ask("textDocument/completion", **place)["result"]
    assert {each["insertTextFormat"] for each in offered} == {1}  # plain text
    assert "while" in [each["textEdit"]["newText"] for each in offered]
    shown = talk.ask("textDocument/hover", **place)["result"]["contents"]
    assert shown["kind"] == "plaintext"
    assert shown["value"].startswith("turn e;\n\nAction: ")


def test_it_goes_on_after_messages_that_make_no_sense(talk: Talk) -> None:
    talk.start()
    talk.send(b"{")
    talk.send(b"\xff\xfe")
    talk.tell("textDocument/didChange", textDocument={"uri": URI, "version": 1}, contentChanges=[])
    talk.tell("textDocument/didClose", textDocument={"uri": URI})
    talk.tell("textDocument/hover", nonsense=True)
    assert "error" in talk.ask("no/such/method")
    talk.open("double \ud83d; // half a pair \ud83d\r\nturn getx self;")
    document = {"uri": URI}
    for line, character in ((0, 9), (1, 7), (7, 70)):
        position = {"line": line, "character": character}
        for method in ("hover", "completion", "definition", "documentHighlight"):
            answer = talk.ask(f"textDocument/{method}", textDocument=document, position=position)
            assert "error" not in answer
    assert talk.ask("shutdown")["result"] is None


def test_without_the_extra_it_says_what_to_install(
    call: Callable[..., Result], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fasteroids.cli.lsp.find_spec", lambda _name: None)
    shown = call("lsp")
    assert shown.exit_code == 2
    assert shown.stdout == ""
    assert shown.stderr == (
        "Error: the language server needs an extra: pip install 'fasteroids[lsp]'\n"
    )


def test_help_does_not_need_the_extra() -> None:
    code = (
        "import sys; sys.modules['pygls'] = None; sys.modules['lsprotocol'] = None\n"
        "from fasteroids.cli import main\n"
        "main(['lsp', '--help'], prog_name='fasteroids')\n"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "--stdio" in shown.stdout


def test_at_a_terminal_it_says_that_it_is_for_editors() -> None:
    ours, theirs = os.openpty()
    try:
        shown = subprocess.run(
            COMMAND, stdin=theirs, capture_output=True, text=True, timeout=60, check=False
        )
    finally:
        os.close(ours)
        os.close(theirs)
    assert shown.returncode == 2
    assert shown.stderr == (
        "Error: the language server is for editors to start: it reads no terminal\n"
    )
