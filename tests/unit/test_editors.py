"""What comes for editors agrees with itself and with the command that it starts."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path
from typing import Any

import pytest

from fasteroids.cli import COMMANDS

FOLDER = Path(__file__).resolve().parents[2] / "editors"
EXTENSION = FOLDER / "vscode" / "extension.js"
CODE = EXTENSION.read_text("utf-8")
README = (FOLDER / "README.md").read_text("utf-8")

STUBS = """
const Module = require("module");
const log = [];
class LanguageClient {
  constructor(...all) { log.push(["client", ...all]); }
  start() { log.push(["start"]); return Promise.resolve(); }
  stop() { log.push(["stop"]); return Promise.resolve(); }
}
const vscode = {
  window: { showInformationMessage: (text) => log.push(["said", text]) },
  workspace: { getConfiguration: (section) => ({ get: (name) => `${section}.${name}` }) },
};
const stubs = { vscode, "vscode-languageclient/node": LANGUAGE ? { LanguageClient } : undefined };
const load = Module._load;
Module._load = (name, ...rest) => {
  if (!(name in stubs)) return load(name, ...rest);
  if (stubs[name] === undefined) throw new Error(`no ${name}`);
  return stubs[name];
};
const extension = require(process.argv[1]);
(async () => {
  await extension.activate({ extensionPath: "/here" });
  await extension.deactivate();
  console.log(JSON.stringify(log));
})();
"""


@pytest.fixture(scope="module")
def package() -> dict[str, Any]:
    found = json.loads((FOLDER / "vscode" / "package.json").read_text("utf-8"))
    assert isinstance(found, dict)
    return found


def test_the_package_starts_its_program_for_its_language(package: dict[str, Any]) -> None:
    assert (FOLDER / "vscode" / package["main"]).resolve() == EXTENSION
    [language] = package["contributes"]["languages"]
    assert package["activationEvents"] == [f"onLanguage:{language['id']}"]
    assert f'language: "{language["id"]}"' in CODE


def test_the_program_uses_only_what_the_package_asks_for(package: dict[str, Any]) -> None:
    wanted = {name.partition("/")[0] for name in re.findall(r'require\("([^"]+)"\)', CODE)}
    assert wanted == {"vscode", *package["dependencies"]}


def test_the_program_reads_the_settings_that_the_package_has(package: dict[str, Any]) -> None:
    read = {
        f"{section}.{name}"
        for section, name in re.findall(r'getConfiguration\("(\w+)"\)\s*\.get\("(\w+)"\)', CODE)
    }
    assert read == package["contributes"]["configuration"]["properties"].keys()
    # Who opens a folder of a stranger starts no program of the stranger.
    assert read == {*package["capabilities"]["untrustedWorkspaces"]["restrictedConfigurations"]}


def ran(*, client: bool) -> list[list[Any]]:
    """What the extension does in its life, with all around it pretended."""
    node = shutil.which("node")
    if node is None:  # it comes with editors: nothing of this project needs or installs it
        pytest.skip("there is no Node.js to run it with")
    code = STUBS.replace("LANGUAGE", "true" if client else "false")
    shown = subprocess.run(
        [node, "-e", code, str(EXTENSION)], capture_output=True, text=True, check=True, timeout=60
    )
    log = json.loads(shown.stdout)
    assert isinstance(log, list)
    return log


def test_the_extension_starts_the_command_and_stops_it() -> None:
    made, *rest = ran(client=True)
    assert made[3] == {"command": "fasteroids.command", "args": ["lsp"]}
    assert made[4] == {"documentSelector": [{"language": "fasteroids"}]}
    assert rest == [["start"], ["stop"]]


def test_the_extension_says_what_to_do_if_its_client_is_not_installed() -> None:
    [[kind, text]] = ran(client=False)
    assert kind == "said"
    assert '"npm install" once in /here' in text


def test_the_readme_starts_the_command_in_every_editor() -> None:
    [helix] = re.findall(r"```toml\n(.*?)```", README, re.DOTALL)
    settings = tomllib.loads(helix)
    [language] = settings["language"]
    [server] = language["language-servers"]
    assert settings["language-server"][server] == {"command": "fasteroids", "args": ["lsp"]}
    for lisp in ('cmd = { "fasteroids", "lsp" }', '("fasteroids" "lsp")'):
        assert lisp in README
    assert "lsp" in COMMANDS
