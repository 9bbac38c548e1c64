"""Code opens in the user's own editor, at its line."""

import sys
import time
from pathlib import Path

import pytest

from vicode.editor.session import Workspace
from vicode.editor.session.external_editor import CodePlace, ExternalEditor, find_command, find_place, parse_command

PLACE = CodePlace(file=Path("/a b/player.py"), line=7)


def test_the_place_of_code_is_its_line_in_the_generated_file(workspace: Workspace) -> None:
    document = workspace.open_document("Player")
    assert document is not None
    path = ("states", "WatchBall", "enter", 0, "code")
    assert find_place(workspace, document, path) is None
    workspace.generate(document)
    place = find_place(workspace, document, path)
    assert place is not None
    assert "self._distances: list[float] = []" in place.file.read_text().split("\n")[place.line - 1]
    guard = find_place(workspace, document, ("states", "WatchBall", "transitions", 1, "code"))
    assert guard is not None
    assert guard.line > place.line
    module = find_place(workspace, document, ("module",))
    assert module is not None
    assert 1 < module.line < place.line


def test_links_and_commands_contain_the_place(tmp_path: Path) -> None:
    assert PLACE.vscode_url == "vscode://file/a%20b/player.py:7"
    assert parse_command("code -g {file}:{line}") == ("code", "-g", "{file}:{line}")
    assert parse_command("'my editor' -x") == ("my editor", "-x", "{file}")
    for wrong in ("", "code '"):
        with pytest.raises(ValueError):
            parse_command(wrong)
    told = tmp_path / "told"
    script = "import sys; open(sys.argv[1], 'w').write(sys.argv[2])"
    ExternalEditor(arguments=(sys.executable, "-c", script, str(told), "{file}:{line}")).open(PLACE)
    while not told.exists() or not told.read_text():
        time.sleep(0.01)
    assert told.read_text() == "/a b/player.py:7"


def test_only_editors_with_a_window_are_started_unasked() -> None:
    assert find_command({"EDITOR": "vim"}) == ()
    assert find_command({"VISUAL": "/usr/bin/code --wait"}) == ("/usr/bin/code", "-g", "{file}:{line}")
    assert find_command({"VISUAL": "", "EDITOR": "gedit"}) == ("gedit", "+{line}", "{file}")
