// Starts the language server, `fasteroids lsp`, when a ship program is opened. All it knows is in the server.

"use strict";

const vscode = require("vscode");

let client;

function activate(context) {
  let language;
  try {
    language = require("vscode-languageclient/node");
  } catch {
    vscode.window.showInformationMessage(
      `Fasteroids has colours only: for errors, completion and more run "npm install" once in ${context.extensionPath}.`,
    );
    return undefined;
  }
  const command = vscode.workspace.getConfiguration("fasteroids").get("command");
  client = new language.LanguageClient(
    "fasteroids",
    "Fasteroids",
    { command, args: ["lsp"] },
    { documentSelector: [{ language: "fasteroids" }] },
  );
  return client.start();
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
