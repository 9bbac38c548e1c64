"""The language server as a child process, driven over standard input and output."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from vicode.xabsl.server.grammar import grammar
from vicode.xabsl.tokens import KEYWORDS

FILES = {
    "agents.xabsl": """include "symbols.xabsl";
include "options/play.xabsl";
include "options/kick.xabsl";
agent player("Player", play);
""",
    "symbols.xabsl": """namespace symbols("Symbols") {
  enum side { left, right };
  /** distance to the ball */
  float input ball.distance [0..5000] "mm";
  enum side input ball.side;
  float input angle(float x; float y;);
  float output speed;
  enum side output foot;
}
""",
    "options/play.xabsl": """option play {
  initial state wait {
    decision {
      if (ball.distance < 300 && ball.side == left)
        goto go;
      else
        stay;
    }
    action {
      foot = side.right;
    }
  }
  target state go {
    action {
      kick(power = 3);
      speed = angle(x = 1, y = ball.distance);
    }
  }
}
""",
    "options/kick.xabsl": """option kick {
  float @power;
  initial state only {
    action {
      speed = @power;
    }
  }
}
""",
}


class LspClient:
    """A minimal client: sends requests and records published diagnostics and messages."""

    def __init__(self) -> None:
        command = [sys.executable, "-m", "vicode", "xabsl", "lsp"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.number = 0
        self.start_session(Path.cwd())
        self.request("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        self.notify("initialized", {})

    def start_session(self, folder: Path) -> None:
        self.folder = folder
        self.diagnostics: dict[str, list[dict[str, Any]]] = {}
        self.shown_messages: list[str] = []
        self.versions: dict[str, int] = {}

    def close_documents(self) -> None:
        for name in self.versions:
            self.notify("textDocument/didClose", {"textDocument": {"uri": self.uri(name)}})
        self.wait_for_diagnostics()

    def send(self, message: dict[str, Any]) -> None:
        assert self.process.stdin
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self.process.stdin.flush()

    def notify(self, method: str, params: dict[str, Any]) -> None:
        self.send({"method": method, "params": params})

    def request(self, method: str, params: dict[str, Any]) -> Any:
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        while True:
            message = self.read()
            if message.get("id") == self.number:
                assert "error" not in message, message
                return message["result"]

    def read(self) -> dict[str, Any]:
        assert self.process.stdout
        length = 0
        while line := self.process.stdout.readline().strip():
            if line.lower().startswith(b"content-length:"):
                length = int(line.split(b":")[1])
        message: dict[str, Any] = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            name = message["params"]["uri"].removeprefix(f"{self.folder.as_uri()}/")
            self.diagnostics[name] = message["params"]["diagnostics"]
        elif message.get("method") == "window/showMessage":
            self.shown_messages.append(message["params"]["message"])
        return message

    def uri(self, name: str) -> str:
        return (self.folder / name).as_uri()

    def open(self, name: str) -> None:
        text = (self.folder / name).read_text(encoding="utf-8")
        document = {"uri": self.uri(name), "languageId": "xabsl", "version": 1, "text": text}
        self.versions[name] = 1
        self.notify("textDocument/didOpen", {"textDocument": document})
        self.wait_for_diagnostics()

    def change(self, name: str, text: str) -> None:
        self.versions[name] += 1
        document = {"uri": self.uri(name), "version": self.versions[name]}
        self.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})
        self.wait_for_diagnostics()

    def wait_for_diagnostics(self) -> None:
        """Wait until the server has processed all previous notifications."""
        self.request("textDocument/documentSymbol", {"textDocument": {"uri": self.uri("agents.xabsl")}})

    def at(self, name: str, text: str, word: str, *, end: bool = False) -> dict[str, Any]:
        """Parameters with the position of the first occurrence of a word in a text."""
        offset = text.index(word) + (len(word) if end else 1)
        line = text.count("\n", 0, offset)
        character = offset - (text.rfind("\n", 0, offset) + 1)
        return {"textDocument": {"uri": self.uri(name)}, "position": {"line": line, "character": character}}

    def complete(self, name: str, text: str, after: str) -> list[str]:
        """Change the file to a text and return the completions after the first occurrence of a word."""
        self.change(name, text)
        return [item["label"] for item in self.request("textDocument/completion", self.at(name, text, after, end=True))]


@pytest.fixture(scope="module")
def client() -> Iterator[LspClient]:
    """One server for all tests, since a process takes longer to start than a test to run."""
    client = LspClient()
    yield client
    client.request("shutdown", {})
    client.notify("exit", {})
    assert client.process.stdin
    client.process.stdin.close()
    client.process.wait(20)
    assert client.process.stdout
    client.process.stdout.close()


@pytest.fixture
def editor(client: LspClient, tmp_path: Path) -> Iterator[LspClient]:
    (tmp_path / "options").mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    client.start_session(tmp_path)
    yield client
    client.close_documents()


def locations(results: list[dict[str, Any]]) -> list[tuple[str, int]]:
    return [(result["uri"].rsplit("/", 1)[1], result["range"]["start"]["line"] + 1) for result in results]


def test_hover_definition_references_outline_and_rename(editor: LspClient) -> None:
    play, kick = FILES["options/play.xabsl"], FILES["options/kick.xabsl"]
    editor.open("options/play.xabsl")
    assert not any(editor.diagnostics.values())

    hover = editor.request("textDocument/hover", editor.at("options/play.xabsl", play, "ball.distance"))
    assert 'float input ball.distance [0..5000] "mm"' in hover["contents"]["value"]
    assert "distance to the ball" in hover["contents"]["value"]
    hover = editor.request("textDocument/hover", editor.at("options/play.xabsl", play, "go {"))
    assert "target state go" in hover["contents"]["value"]

    result = editor.request("textDocument/definition", editor.at("options/play.xabsl", play, "kick(power"))
    assert locations([result]) == [("kick.xabsl", 1)]
    params = {**editor.at("options/play.xabsl", play, "ball.distance"), "context": {"includeDeclaration": True}}
    result = editor.request("textDocument/references", params)
    assert locations(result) == [("symbols.xabsl", 4), ("play.xabsl", 4), ("play.xabsl", 16)]

    result = editor.request("textDocument/documentSymbol", {"textDocument": {"uri": editor.uri("options/play.xabsl")}})
    assert [(symbol["name"], [child["name"] for child in symbol["children"]]) for symbol in result] == [
        ("play", ["wait", "go"])
    ]

    rename = {**editor.at("options/kick.xabsl", kick, "@power"), "newName": "strength"}
    edit = editor.request("textDocument/rename", rename)["changes"]
    assert {uri.rsplit("/", 1)[1]: [change["newText"] for change in edits] for uri, edits in edit.items()} == {
        "kick.xabsl": ["@strength", "@strength"],
        "play.xabsl": ["strength"],
    }
    rename = {**editor.at("symbols.xabsl", FILES["symbols.xabsl"], "side"), "newName": "foot.side"}
    edit = editor.request("textDocument/rename", rename)["changes"]
    assert [change["newText"] for change in edit[editor.uri("options/play.xabsl")]] == ["foot.side.right"]
    params = {**editor.at("symbols.xabsl", FILES["symbols.xabsl"], "speed"), "newName": "foot"}
    assert editor.request("textDocument/rename", params) is None
    assert editor.shown_messages == ["there is already a decimal output foot"]


def test_diagnostics_of_all_files_follow_each_change(editor: LspClient) -> None:
    symbols = FILES["symbols.xabsl"]
    editor.open("symbols.xabsl")
    editor.change("symbols.xabsl", "// 😀 comment\n" + symbols.replace("ball.distance", "ball.range"))
    diagnostics = editor.diagnostics["options/play.xabsl"]
    assert [(diagnostic["code"], diagnostic["range"]["start"]) for diagnostic in diagnostics] == [
        ("X621", {"line": 3, "character": 10}),
        ("X621", {"line": 15, "character": 31}),
    ]
    editor.change("symbols.xabsl", symbols)
    assert editor.diagnostics["options/play.xabsl"] == []
    editor.change(
        "symbols.xabsl", symbols.replace("float output speed;", "/* 😀 */ float output speed; float output speed;")
    )
    (diagnostics,) = editor.diagnostics["symbols.xabsl"]
    assert (diagnostics["code"], diagnostics["range"]["start"]["character"]) == ("X623", 44)


def test_completions_depend_on_the_context(editor: LspClient) -> None:
    play = FILES["options/play.xabsl"]
    name = "options/play.xabsl"
    editor.open(name)
    assert editor.complete(name, play.replace("goto go;", "goto "), "goto ") == ["wait", "go"]
    assert editor.complete(name, play.replace("== left", "== "), "ball.side == ")[:2] == ["left", "right"]
    assert editor.complete(name, play.replace("foot = side.right;", "foot = ;"), "foot = ")[:2] == ["left", "right"]
    assert editor.complete(name, play.replace("kick(power = 3);", "kick();"), "kick(") == ["power"]
    labels = editor.complete(name, play.replace("      foot = side.right;\n", "      \n"), "action {\n      ")
    assert set(labels) == {"speed", "foot", "play", "kick"}
    assert "if" in editor.complete(name, play.replace("goto go;\n", "\n").replace("stay;", ""), "decision {\n")
    editor.open("options/kick.xabsl")
    assert "@power" in editor.complete(
        "options/kick.xabsl", FILES["options/kick.xabsl"].replace("@power;\n  ", "@power;\n  "), "speed = "
    )


def test_formatting(editor: LspClient) -> None:
    editor.open("options/kick.xabsl")
    unformatted = "option kick { float @power; initial state only { action { speed = @power; } } }"
    editor.change("options/kick.xabsl", unformatted)
    params = {
        "textDocument": {"uri": editor.uri("options/kick.xabsl")},
        "options": {"tabSize": 2, "insertSpaces": True},
    }
    (edit,) = editor.request("textDocument/formatting", params)
    assert edit["newText"].split("\n")[1] == "  float @power;"


def test_the_grammar_contains_every_keyword() -> None:
    patterns = " ".join(pattern.get("match", "") for pattern in grammar()["patterns"])
    assert all(keyword in patterns for keyword in KEYWORDS)
