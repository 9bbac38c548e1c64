// Connects VS Code to the command vicode: its language server for XABSL, its schemas for design files, and its diagrams.
"use strict";

const { execFile } = require("node:child_process");
const path = require("node:path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

const MAX_SVG_BYTES = 32e6;
const SCHEMES = { "vicode-design": [], "vicode-project": ["--project"] };

let client;

async function activate(context) {
  const own = context.subscriptions;
  const output = vscode.window.createOutputChannel("vicode");
  const diagrams = new Diagrams(output);
  own.push(
    output,
    diagrams,
    vscode.commands.registerCommand("vicode.openDiagram", () => diagrams.open(vscode.window.activeTextEditor)),
    vscode.commands.registerCommand("vicode.openEditor", () => openEditor(vscode.window.activeTextEditor)),
    vscode.window.onDidChangeActiveTextEditor(describeEditor),
    vscode.workspace.onDidSaveTextDocument((document) => {
      describeEditor(vscode.window.activeTextEditor);
      diagrams.update(document);
    }),
  );
  describeEditor(vscode.window.activeTextEditor);
  await Promise.all([startLanguageServer(output), registerSchemas(output)]);
}

async function deactivate() {
  await client?.stop();
}

/** The configured command with its arguments; a path in it is relative to the folder of the workspace. */
function commandLine(uri) {
  const [program, ...args] = vscode.workspace.getConfiguration("vicode", uri).get("command");
  const folder = (uri && vscode.workspace.getWorkspaceFolder(uri)) ?? vscode.workspace.workspaceFolders?.[0];
  const isPath = /[\\/]/.test(program) && folder;
  return { program: isPath ? path.resolve(folder.uri.fsPath, program) : program, args, cwd: folder?.uri.fsPath };
}

/** Run vicode and return its standard output; the error has the text of standard error. */
function run(args, uri) {
  const command = commandLine(uri);
  return new Promise((resolve, reject) => {
    const options = { cwd: command.cwd, maxBuffer: MAX_SVG_BYTES };
    execFile(command.program, [...command.args, ...args], options, (error, stdout, stderr) => {
      if (error === null) resolve(stdout);
      else if (error.code === "ENOENT") reject(new Error(missing(command.program)));
      else reject(new Error(stderr.trim() || error.message));
    });
  });
}

function missing(program) {
  return `${program} was not found. Install vicode from a checkout ('pip install /path/to/vicode'), or set vicode.command in the settings.`;
}

async function startLanguageServer(output) {
  try {
    // Its error is clearer than that of the language client.
    await run(["--version"]);
  } catch (error) {
    void vscode.window.showErrorMessage(`vicode: ${error.message}`);
    return;
  }
  const { program, args, cwd } = commandLine();
  client = new LanguageClient(
    "vicode",
    "XABSL",
    { command: program, args: [...args, "xabsl", "lsp"], options: { cwd } },
    { documentSelector: [{ scheme: "file", language: "xabsl" }], outputChannel: output },
  );
  await client.start();
}

/** Let Red Hat's YAML extension, if it is installed, check and complete designs and project.yaml. */
async function registerSchemas(output) {
  const yaml = await vscode.extensions.getExtension("redhat.vscode-yaml")?.activate();
  if (yaml === undefined) return;
  const schemas = {};
  for (const [scheme, args] of Object.entries(SCHEMES)) {
    try {
      schemas[scheme] = await run(["schema", ...args]);
    } catch (error) {
      output.appendLine(error.message);
      return;
    }
    yaml.registerContributor(
      scheme,
      (resource) => (schemeOf(resource) === scheme ? `${scheme}://schema` : undefined),
      () => schemas[scheme],
    );
  }
}

function schemeOf(resource) {
  const document = vscode.workspace.textDocuments.find((each) => each.uri.toString() === resource);
  if (document === undefined || !isVicodeFile(document)) return undefined;
  return path.posix.basename(document.uri.path) === "project.yaml" ? "vicode-project" : "vicode-design";
}

function isVicodeFile(document) {
  return document.languageId === "yaml" && /^vicode:/m.test(document.getText());
}

function describeEditor(editor) {
  const isDesign = editor !== undefined && isVicodeFile(editor.document) && !isProject(editor.document);
  void vscode.commands.executeCommand("setContext", "vicode.isDesign", isDesign);
}

function isProject(document) {
  return path.posix.basename(document.uri.path) === "project.yaml";
}

function openEditor(editor) {
  if (editor === undefined) return;
  const { program, args, cwd } = commandLine(editor.document.uri);
  const shellArgs = [...args, "edit", editor.document.uri.fsPath];
  vscode.window.createTerminal({ name: "vicode", shellPath: program, shellArgs, cwd }).show(true);
}

/** Panels with diagrams, one per file, drawn again after each save. */
class Diagrams {
  constructor(output) {
    this.output = output;
    this.panels = new Map();
  }

  async open(editor) {
    if (editor === undefined) return;
    const { document } = editor;
    const key = document.uri.toString();
    let panel = this.panels.get(key);
    if (panel === undefined) {
      const column = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      const title = `Diagram of ${path.posix.basename(document.uri.path)}`;
      panel = vscode.window.createWebviewPanel("vicode.diagram", title, column, { localResourceRoots: [] });
      panel.onDidDispose(() => this.panels.delete(key));
      this.panels.set(key, panel);
    } else {
      panel.reveal(undefined, true);
    }
    await this.draw(panel, document);
  }

  /** Draw the diagrams that a saved file may have changed: in XABSL, a file of symbols changes all. */
  async update(document) {
    for (const [key, panel] of this.panels) {
      if (key === document.uri.toString()) await this.draw(panel, document);
      else if (document.languageId === "xabsl" && key.endsWith(".xabsl")) {
        const shown = vscode.workspace.textDocuments.find((each) => each.uri.toString() === key);
        if (shown !== undefined) await this.draw(panel, shown);
      }
    }
  }

  async draw(panel, document) {
    const isDark = [vscode.ColorThemeKind.Dark, vscode.ColorThemeKind.HighContrast].includes(
      vscode.window.activeColorTheme.kind,
    );
    const args = ["export", document.uri.fsPath, "--format", "svg", ...(isDark ? ["--dark"] : []), "-o", "-"];
    try {
      panel.webview.html = page(await run(args, document.uri));
    } catch (error) {
      this.output.appendLine(error.message);
      panel.webview.html = page(`<pre>${escapeHtml(error.message)}</pre>`);
    }
  }

  dispose() {
    for (const panel of this.panels.values()) panel.dispose();
  }
}

/** A page without scripts and without access to the network. A wide diagram shrinks only as far as its text is legible. */
function page(body) {
  const width = Number(/^<svg [^>]*?width="([\d.]+)"/.exec(body)?.[1] ?? 0);
  return `<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; font-src data:; img-src data:">
<style>body { padding: 1rem; text-align: center; } svg { max-width: 100%; min-width: ${Math.round(width * 0.65)}px; height: auto; } pre { text-align: left; white-space: pre-wrap; }</style>
</head><body>${body}</body></html>`;
}

function escapeHtml(text) {
  return text.replace(/[&<>"]/g, (char) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[char]);
}

module.exports = { activate, deactivate };
