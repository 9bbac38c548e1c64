"""What the language server knows about the files of a behavior."""

from tests.xabsl.lsp_client import FILES, LspClient, locations
from vicode.xabsl.server.grammar import grammar
from vicode.xabsl.server.semantic_tokens import LEGEND
from vicode.xabsl.tokens import KEYWORDS


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
    assert editor.request("textDocument/rename", params, refused=True) == "there is already a decimal output foot"


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
    assert "side.right" in editor.complete(name, play.replace("foot = side.right;", "foot = side.;"), "foot = side.")
    assert editor.complete(name, play.replace("kick(power = 3);", "kick();"), "kick(") == ["power"]
    labels = editor.complete(name, play.replace("      foot = side.right;\n", "      \n"), "action {\n      ")
    assert set(labels) == {"speed", "foot", "play", "kick"}
    assert "if" in editor.complete(name, play.replace("goto go;\n", "\n").replace("stay;", ""), "decision {\n")
    editor.open("options/kick.xabsl")
    assert "@power" in editor.complete(
        "options/kick.xabsl", FILES["options/kick.xabsl"].replace("@power;\n  ", "@power;\n  "), "speed = "
    )


def test_a_completion_replaces_the_whole_dotted_name(editor: LspClient) -> None:
    name, play = "options/play.xabsl", FILES["options/play.xabsl"]
    editor.open(name)
    for written in ("ball.", "ball.di", "bal"):
        text = play.replace("ball.distance < 300", f"{written} < 300")
        editor.change(name, text)
        items = editor.request("textDocument/completion", editor.at(name, text, f"({written}", end=True))
        (item,) = [item for item in items if item["label"] == "ball.distance"]
        assert item["textEdit"]["newText"] == "ball.distance"
        assert "filterText" not in item
        assert item["textEdit"]["range"] == {
            "start": {"line": 3, "character": 10},
            "end": {"line": 3, "character": 10 + len(written)},
        }
    text = play.replace("speed = angle", "an").replace("foot = side", "// foot = side")
    editor.change(name, text)
    items = editor.request("textDocument/completion", editor.at(name, text, "// foot", end=True))
    assert items == []
    text = play.replace("speed = angle(x = 1, y = ball.distance);", "speed = an")
    editor.change(name, text)
    items = editor.request("textDocument/completion", editor.at(name, text, "speed = an", end=True))
    (item,) = [item for item in items if item["label"] == "angle"]
    assert (item["insertTextFormat"], item["textEdit"]["newText"]) == (2, "angle(x = ${1}, y = ${2})")


def test_highlights_tell_reading_from_writing(editor: LspClient) -> None:
    name, kick = "options/kick.xabsl", FILES["options/kick.xabsl"]
    editor.open(name)
    result = editor.request("textDocument/documentHighlight", editor.at(name, kick, "@power"))
    assert [(each["range"]["start"]["line"], each["kind"]) for each in result] == [(1, 3), (4, 2)]
    result = editor.request("textDocument/documentHighlight", editor.at(name, kick, "speed"))
    assert [(each["range"]["start"]["line"], each["kind"]) for each in result] == [(4, 3)]


def test_search_folding_and_definitions_of_includes(editor: LspClient) -> None:
    editor.open("agents.xabsl")
    symbols = editor.request("workspace/symbol", {"query": "bdist"})
    assert [(each["name"], each["location"]["range"]["start"]["line"]) for each in symbols] == [("ball.distance", 3)]
    (state, *_rest) = editor.request("workspace/symbol", {"query": "wait"})
    assert (state["name"], state["containerName"]) == ("wait", "play")

    editor.open("options/play.xabsl")
    params = {"textDocument": {"uri": editor.uri("options/play.xabsl")}}
    folds = editor.request("textDocument/foldingRange", params)
    assert {(fold["startLine"], fold["endLine"]) for fold in folds} == {
        *((0, 17), (1, 10), (2, 6), (8, 9), (12, 16), (13, 15))
    }
    folds = editor.request("textDocument/foldingRange", {"textDocument": {"uri": editor.uri("agents.xabsl")}})
    assert folds == [{"startLine": 0, "endLine": 2, "kind": "imports"}]

    result = editor.request("textDocument/definition", editor.at("agents.xabsl", FILES["agents.xabsl"], "options/kick"))
    assert locations([result]) == [("kick.xabsl", 1)]


def test_calls_of_options(editor: LspClient) -> None:
    name, play, kick = "options/play.xabsl", FILES["options/play.xabsl"], FILES["options/kick.xabsl"]
    editor.open(name)
    (item,) = editor.request("textDocument/prepareCallHierarchy", editor.at(name, play, "kick(power"))
    assert (item["name"], item["uri"]) == ("kick", editor.uri("options/kick.xabsl"))
    (call,) = editor.request("callHierarchy/incomingCalls", {"item": item})
    assert (call["from"]["name"], call["fromRanges"][0]["start"]["line"]) == ("play", 14)
    (item,) = editor.request("textDocument/prepareCallHierarchy", editor.at(name, play, "play"))
    (call,) = editor.request("callHierarchy/outgoingCalls", {"item": item})
    assert call["to"]["name"] == "kick"
    (call,) = editor.request("callHierarchy/incomingCalls", {"item": item})
    assert call["from"]["name"] == "player"
    assert editor.request("textDocument/prepareCallHierarchy", editor.at("options/kick.xabsl", kick, "only")) is None


def test_signature_help_follows_the_arguments(editor: LspClient) -> None:
    name, play = "options/play.xabsl", FILES["options/play.xabsl"]
    editor.open(name)
    for after, active in (("angle(", 0), ("angle(x = 1", 0), ("angle(x = 1,", 1), ("y = ball", 1)):
        result = editor.request("textDocument/signatureHelp", editor.at(name, play, after, end=True))
        assert (result["signatures"][0]["label"], result["activeParameter"]) == (
            "float input angle(float x, float y)",
            active,
        )
    assert editor.request("textDocument/signatureHelp", editor.at(name, play, "goto ", end=True)) is None


def test_semantic_tokens_name_what_names_refer_to(editor: LspClient) -> None:
    editor.open("options/kick.xabsl")
    text = FILES["options/kick.xabsl"].replace("option", "/* 😀\n*/ option", 1)
    editor.change("options/kick.xabsl", text)
    legend = LEGEND.token_types
    params = {"textDocument": {"uri": editor.uri("options/kick.xabsl")}}
    data = editor.request("textDocument/semanticTokens/full", params)["data"]
    line, column, found = 0, 0, []
    lines = text.split("\n")
    for lines_down, columns, length, kind, _modifiers in zip(*[iter(data)] * 5, strict=True):
        line, column = line + lines_down, columns + (0 if lines_down else column)
        units = lines[line].encode("utf-16-le")
        found.append((units[2 * column : 2 * (column + length)].decode("utf-16-le"), legend[kind]))
    assert found[:7] == [
        ("/* 😀", "comment"),
        ("*/", "comment"),
        ("option", "keyword"),
        ("kick", "class"),
        ("float", "keyword"),
        ("@power", "parameter"),
        ("initial", "keyword"),
    ]
    assert ("speed", "property") in found
    assert ("only", "label") in found


def test_the_grammar_contains_every_keyword() -> None:
    patterns = " ".join(pattern.get("match", "") for pattern in grammar()["patterns"])
    assert all(keyword in patterns for keyword in KEYWORDS)
