// The part of VS Code's API that the extension uses. `run` opens a file in it, shows its diagram and prints the page.
"use strict";

const fs = require("node:fs");
const Module = require("node:module");

const [extension, file, ...command] = process.argv.slice(2);
const commands = {};
const listener = () => ({ dispose() {} });
const panel = { webview: { html: "" }, onDidDispose: listener, reveal() {}, dispose() {} };
const languageId = file.endsWith(".xabsl") ? "xabsl" : "yaml";
const uri = { fsPath: file, path: file, toString: () => `file://${file}` };
const document = { uri, languageId, getText: () => fs.readFileSync(file, "utf8") };
const contexts = {};
const started = [];
const fakes = {
  vscode: {
    window: {
      activeTextEditor: { document },
      activeColorTheme: { kind: 1 },
      createOutputChannel: () => ({ appendLine: console.error, dispose() {} }),
      createWebviewPanel: () => panel,
      onDidChangeActiveTextEditor: listener,
      showErrorMessage: console.error,
    },
    workspace: {
      getConfiguration: () => ({ get: () => command }),
      getWorkspaceFolder: () => undefined,
      onDidSaveTextDocument: listener,
      textDocuments: [document],
    },
    commands: {
      registerCommand: (name, action) => ((commands[name] = action), listener()),
      executeCommand: (_set, name, value) => (contexts[name] = value),
    },
    extensions: { getExtension: () => undefined },
    ViewColumn: { Beside: -2 },
    ColorThemeKind: { Dark: 2, HighContrast: 3 },
  },
  "vscode-languageclient/node": {
    LanguageClient: class {
      constructor(_id, _name, server) {
        this.server = server;
      }
      async start() {
        started.push([this.server.command, ...this.server.args]);
      }
    },
  },
};
const load = Module._load;
Module._load = (name, ...rest) => fakes[name] ?? load(name, ...rest);

(async () => {
  await require(extension).activate({ subscriptions: [] });
  await commands["vicode.openDiagram"]();
  console.log(JSON.stringify({ html: panel.webview.html, commands: Object.keys(commands), contexts, started }));
})();
