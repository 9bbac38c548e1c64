"""What the language server changes: quick fixes, layout and names."""

import logging
from typing import Any

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from tests.xabsl.lsp_client import FILES, LspClient
from vicode.xabsl.server.server import create_server


@pytest.mark.parametrize(
    ("name", "old", "new", "title"),
    [
        ("options/play.xabsl", "ball.distance <", "ball.distanc <", "Replace with ball.distance"),
        ("options/play.xabsl", "power = 3", "@power = 3", "Replace with power"),
        ("options/kick.xabsl", "float @power", "float power", "Replace with @power"),
        ("agents.xabsl", '"options/kick.xabsl"', '"options/kik.xabsl"', 'Replace with "options/kick.xabsl"'),
        ("options/play.xabsl", "goto go;", "goto go", "Insert ;"),
        ("options/play.xabsl", "initial state wait", "state wait", "Make wait the initial state"),
        ("options/play.xabsl", "angle(x = 1, y = ball.distance)", "angle(x = 1)", "Add y"),
        ("symbols.xabsl", "float output speed;", "float output speed;\n  float output unused;", "Remove unused"),
        ("symbols.xabsl", "left, right }", "left, right, }", "Remove ,"),
    ],
)
def test_fixes_of_findings_are_code_actions(editor: LspClient, name: str, old: str, new: str, title: str) -> None:
    editor.open(name)
    changed = FILES[name].replace(old, new, 1)
    editor.change(name, changed)
    everything = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
    params = {
        "textDocument": {"uri": editor.uri(name)},
        "range": everything,
        "context": {"diagnostics": editor.diagnostics[name]},
    }
    actions = editor.request("textDocument/codeAction", params)
    (action,) = [action for action in actions if action["title"] == title]
    ((uri, (edit,)),) = action["edit"]["changes"].items()
    assert uri == editor.uri(name)
    editor.change(name, apply_edit(changed, edit))
    assert not editor.diagnostics[name]


def apply_edit(text: str, edit: dict[str, Any]) -> str:
    lines = text.splitlines(keepends=True)
    first, last = (
        sum(map(len, lines[: position["line"]])) + position["character"]
        for position in (edit["range"]["start"], edit["range"]["end"])
    )
    return text[:first] + str(edit["newText"]) + text[last:]


def test_formatting_a_range_changes_only_its_lines(editor: LspClient) -> None:
    name = "options/play.xabsl"
    editor.open(name)
    text = FILES[name].replace("foot = side.right;", "foot=side.right;").replace("kick(power = 3);", "kick(power=3);")
    editor.change(name, text)
    line = text[: text.index("kick(power")].count("\n")
    params = {
        "textDocument": {"uri": editor.uri(name)},
        "range": {"start": {"line": line, "character": 0}, "end": {"line": line + 1, "character": 0}},
        "options": {"tabSize": 2, "insertSpaces": True},
    }
    (edit,) = editor.request("textDocument/rangeFormatting", params)
    assert apply_edit(text, edit) == text.replace("kick(power=3);", "kick(power = 3);")


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


def test_only_names_can_be_renamed(editor: LspClient) -> None:
    name, play = "options/play.xabsl", FILES["options/play.xabsl"]
    editor.open(name)
    result = editor.request("textDocument/prepareRename", editor.at(name, play, "ball.distance"))
    assert (result["placeholder"], result["range"]["start"]) == ("ball.distance", {"line": 3, "character": 10})
    for word, message in (
        ("goto", "'goto' is a keyword"),
        ("{", "there is no name at the cursor"),
        ("300", "there is no name at the cursor"),
    ):
        assert editor.request("textDocument/prepareRename", editor.at(name, play, word), refused=True) == message
    params = {**editor.at(name, play, "goto"), "newName": "jump"}
    assert editor.request("textDocument/rename", params, refused=True) == "'goto' is a keyword"


def test_the_log_has_failures_but_no_refusals(caplog: pytest.LogCaptureFixture) -> None:
    create_server()
    failure = ValueError("a mistake in the server")
    for error in (JsonRpcException("no", code=lsp.LSPErrorCodes.RequestFailed.value), failure):
        logging.getLogger("pygls.protocol.json_rpc").error("a request failed", exc_info=error)
    assert [record.exc_info and record.exc_info[1] for record in caplog.records] == [failure]
