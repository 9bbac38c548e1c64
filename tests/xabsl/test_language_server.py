"""The language server as a text editor sees it: a process, messages on its standard input and output."""

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
  /** how far it is */
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
  state go {
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
    """A text editor: asks, and keeps the diagnostics that it is told."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-m", "vicode", "xabsl", "lsp"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.folder = folder
        self.diagnostics: dict[str, list[dict[str, Any]]] = {}
        self.said: list[str] = []
        self.number = 0
        self.versions: dict[str, int] = {}
        self.can = self.request("initialize", {"processId": None, "rootUri": folder.as_uri(), "capabilities": {}})
        self.notify("initialized", {})

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
            self.said.append(message["params"]["message"])
        return message

    def uri(self, name: str) -> str:
        return (self.folder / name).as_uri()

    def open(self, name: str) -> None:
        text = (self.folder / name).read_text(encoding="utf-8")
        document = {"uri": self.uri(name), "languageId": "xabsl", "version": 1, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": document})
        self.wait_for_diagnostics()

    def change(self, name: str, text: str) -> None:
        self.versions[name] = self.versions.get(name, 1) + 1
        document = {"uri": self.uri(name), "version": self.versions[name]}
        self.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})
        self.wait_for_diagnostics()

    def wait_for_diagnostics(self) -> None:
        """Wait until everything told so far was worked on."""
        self.request("textDocument/documentSymbol", {"textDocument": {"uri": self.uri("agents.xabsl")}})

    def at(self, name: str, text: str, word: str, *, end: bool = False) -> dict[str, Any]:
        """Parameters that point to the first place of a word in a text."""
        offset = text.index(word) + (len(word) if end else 1)
        line = text.count("\n", 0, offset)
        character = offset - (text.rfind("\n", 0, offset) + 1)
        return {"textDocument": {"uri": self.uri(name)}, "position": {"line": line, "character": character}}

    def complete(self, name: str, text: str, behind: str) -> list[str]:
        """What is offered behind the first place of a word, once the file has this text."""
        self.change(name, text)
        return [
            each["label"] for each in self.request("textDocument/completion", self.at(name, text, behind, end=True))
        ]


@pytest.fixture
def editor(tmp_path: Path) -> Iterator[LspClient]:
    (tmp_path / "options").mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    editor = LspClient(tmp_path)
    yield editor
    editor.request("shutdown", {})
    editor.notify("exit", {})
    assert editor.process.stdin
    editor.process.stdin.close()
    editor.process.wait(20)
    assert editor.process.stdout
    editor.process.stdout.close()


def locations(found: list[dict[str, Any]]) -> list[tuple[str, int]]:
    return [(each["uri"].rsplit("/", 1)[1], each["range"]["start"]["line"] + 1) for each in found]


def test_an_editor_is_served(editor: LspClient) -> None:
    play, kick = FILES["options/play.xabsl"], FILES["options/kick.xabsl"]
    editor.open("options/play.xabsl")
    assert not any(editor.diagnostics.values())

    hover = editor.request("textDocument/hover", editor.at("options/play.xabsl", play, "ball.distance"))
    assert 'float input ball.distance [0..5000] "mm"' in hover["contents"]["value"]
    assert "how far it is" in hover["contents"]["value"]

    found = editor.request("textDocument/definition", editor.at("options/play.xabsl", play, "kick(power"))
    assert locations([found]) == [("kick.xabsl", 1)]
    asked = {**editor.at("options/play.xabsl", play, "ball.distance"), "context": {"includeDeclaration": True}}
    found = editor.request("textDocument/references", asked)
    assert locations(found) == [("symbols.xabsl", 4), ("play.xabsl", 4), ("play.xabsl", 16)]

    found = editor.request("textDocument/documentSymbol", {"textDocument": {"uri": editor.uri("options/play.xabsl")}})
    assert [(each["name"], [child["name"] for child in each["children"]]) for each in found] == [
        ("play", ["wait", "go"])
    ]

    rename = {**editor.at("options/kick.xabsl", kick, "@power"), "newName": "strength"}
    edit = editor.request("textDocument/rename", rename)["changes"]
    assert {uri.rsplit("/", 1)[1]: [each["newText"] for each in edits] for uri, edits in edit.items()} == {
        "kick.xabsl": ["@strength", "@strength"],
        "play.xabsl": ["strength"],
    }
    rename = {**editor.at("symbols.xabsl", FILES["symbols.xabsl"], "side"), "newName": "foot.side"}
    edit = editor.request("textDocument/rename", rename)["changes"]
    assert [each["newText"] for each in edit[editor.uri("options/play.xabsl")]] == ["foot.side.right"]
    taken = {**editor.at("symbols.xabsl", FILES["symbols.xabsl"], "speed"), "newName": "foot"}
    assert editor.request("textDocument/rename", taken) is None
    assert editor.said == ["there is already a decimal output foot"]


def test_mistakes_are_told_in_every_file_while_one_types(editor: LspClient) -> None:
    symbols = FILES["symbols.xabsl"]
    editor.open("symbols.xabsl")
    editor.change("symbols.xabsl", "// 😀 before\n" + symbols.replace("ball.distance", "ball.range"))
    found = editor.diagnostics["options/play.xabsl"]
    assert [(each["code"], each["range"]["start"]) for each in found] == [
        ("X621", {"line": 3, "character": 10}),
        ("X621", {"line": 15, "character": 31}),
    ]
    editor.change("symbols.xabsl", symbols)
    assert editor.diagnostics["options/play.xabsl"] == []
    editor.change(
        "symbols.xabsl", symbols.replace("float output speed;", "/* 😀 */ float output speed; float output speed;")
    )
    (found,) = editor.diagnostics["symbols.xabsl"]
    assert (found["code"], found["range"]["start"]["character"]) == ("X623", 44)


def test_what_is_offered_depends_on_the_place(editor: LspClient) -> None:
    play = FILES["options/play.xabsl"]
    name = "options/play.xabsl"
    editor.open(name)
    assert editor.complete(name, play.replace("goto go;", "goto "), "goto ") == ["wait", "go"]
    assert editor.complete(name, play.replace("== left", "== "), "ball.side == ")[:2] == ["left", "right"]
    assert editor.complete(name, play.replace("foot = side.right;", "foot = ;"), "foot = ")[:2] == ["left", "right"]
    assert editor.complete(name, play.replace("kick(power = 3);", "kick();"), "kick(") == ["power"]
    offered = editor.complete(name, play.replace("      foot = side.right;\n", "      \n"), "action {\n      ")
    assert set(offered) == {"speed", "foot", "play", "kick"}
    assert "if" in editor.complete(name, play.replace("goto go;\n", "\n").replace("stay;", ""), "decision {\n")
    assert "@power" in editor.complete(
        "options/kick.xabsl", FILES["options/kick.xabsl"].replace("@power;\n  ", "@power;\n  "), "speed = "
    )


def test_a_file_is_laid_out(editor: LspClient) -> None:
    editor.open("options/kick.xabsl")
    crowded = "option kick { float @power; initial state only { action { speed = @power; } } }"
    editor.change("options/kick.xabsl", crowded)
    asked = {"textDocument": {"uri": editor.uri("options/kick.xabsl")}, "options": {"tabSize": 2, "insertSpaces": True}}
    (edit,) = editor.request("textDocument/formatting", asked)
    assert edit["newText"].split("\n")[1] == "  float @power;"


def test_every_word_of_the_language_is_coloured() -> None:
    told = " ".join(each.get("match", "") for each in grammar()["patterns"])
    assert all(word in told for word in KEYWORDS)
