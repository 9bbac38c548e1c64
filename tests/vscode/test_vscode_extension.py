"""The extension for VS Code, with a fake of the API that it uses."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.editor.canvas.run_js import NODE

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "vicode" / "vscode"
MANIFEST: dict[str, Any] = json.loads((FOLDER / "package.json").read_text())
COMMAND = [sys.executable, "-m", "vicode"]


def open_diagram(file: Path, command: list[str] = COMMAND) -> dict[str, Any]:
    fake = Path(__file__).with_name("fake_vscode.js")
    done = subprocess.run(
        [NODE, fake, FOLDER / "extension.js", file, *command], capture_output=True, text=True, cwd=ROOT, check=True
    )
    shown: dict[str, Any] = json.loads(done.stdout)
    return shown


def test_the_files_of_the_manifest_exist() -> None:
    contributes = MANIFEST["contributes"]
    generated = {"./xabsl.tmLanguage.json"}
    named = {MANIFEST["main"], *(each["configuration"] for each in contributes["languages"])}
    named |= {each["path"] for each in contributes["grammars"]}
    assert {name for name in named - generated if not (FOLDER / name).is_file()} == set()
    json.loads((FOLDER / "language-configuration.json").read_text())


@pytest.mark.parametrize(
    ("file", "is_design", "state"),
    [
        ("designs/meeting/meet.yaml", True, "wait_at_door"),
        ("generated/xabsl/meeting/Options/meet.xabsl", False, "door"),
    ],
)
def test_a_diagram_beside_its_text(file: str, state: str, *, is_design: bool) -> None:
    shown = open_diagram(ROOT / file)
    assert "<svg " in shown["html"]
    assert f">{state}<" in shown["html"]
    assert "<script" not in shown["html"]
    assert shown["contexts"]["vicode.isDesign"] == is_design
    assert set(shown["commands"]) == {each["command"] for each in MANIFEST["contributes"]["commands"]}
    assert shown["started"] == [[*COMMAND, "xabsl", "lsp"]]


def test_an_error_is_shown_as_text(tmp_path: Path) -> None:
    broken = tmp_path / "a.yaml"
    broken.write_text("vicode: 1\ncomponent: '<img src=x>'\n")
    shown = open_diagram(broken)
    assert "&lt;img src=x&gt;" in shown["html"]
    assert "<img" not in shown["html"]


def test_a_missing_command_is_named() -> None:
    shown = open_diagram(ROOT / "designs/meeting/meet.yaml", ["no-such-vicode"])
    assert "no-such-vicode was not found. Install vicode from a checkout (&#39;pip" in shown["html"].replace(
        "'", "&#39;"
    )
