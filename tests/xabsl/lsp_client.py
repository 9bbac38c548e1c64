"""A client of the language server, which runs as a child process and talks over standard input and output."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

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
    """A minimal client: sends requests and records published diagnostics."""

    def __init__(self) -> None:
        command = [sys.executable, "-m", "vicode", "xabsl", "lsp"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.number = 0
        self.start_session(Path.cwd())
        completion = {"completionItem": {"snippetSupport": True}}
        capabilities = {"textDocument": {"completion": completion}}
        self.request("initialize", {"processId": None, "rootUri": None, "capabilities": capabilities})
        self.notify("initialized", {})

    def start_session(self, folder: Path) -> None:
        self.folder = folder
        self.diagnostics: dict[str, list[dict[str, Any]]] = {}
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

    def request(self, method: str, params: dict[str, Any], *, refused: bool = False) -> Any:
        """The result of a request, or the message of the error if it is to be refused."""
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        while True:
            message = self.read()
            if message.get("id") == self.number:
                if refused:
                    return message["error"]["message"]
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


def locations(results: list[dict[str, Any]]) -> list[tuple[str, int]]:
    return [(result["uri"].rsplit("/", 1)[1], result["range"]["start"]["line"] + 1) for result in results]
