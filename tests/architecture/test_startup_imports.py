"""Commands without a browser do not import NiceGUI or other slow libraries."""

import os
import re
import subprocess
import sys
import urllib.request
from pathlib import Path

ROOT = Path(__file__).parents[2]

DESIGN = """\
vicode: 1
component: Blinker
initial: Dark
states:
  Dark: {transitions: [{to: Lit, after: 1}]}
  Lit: {transitions: [{to: Dark, after: 1}]}
"""

PROGRAM = """\
import sys
import vicode.cli
try:
    code = vicode.cli.main(sys.argv[1:])
except SystemExit as exit:
    code = exit.code
heavy = {"nicegui", "fastapi", "uvicorn", "reportlab", "resvg_py", "pygraphviz", "zenoh"} & set(sys.modules)
sys.exit(f"imported at startup: {sorted(heavy)}" if heavy else code)
"""

NOT_FOR_THE_FIRST_PAGE = {
    *("aiohttp.client", "altair", "docutils", "httpx", "markdown_it", "matplotlib", "mcp", "numpy", "pandas", "plotly"),
    *("pygls", "pygments", "pygraphviz", "pymunk", "reportlab", "resvg_py", "rich", "send2trash", "zenoh"),
    *("vicode.conformance", "vicode.docsite", "vicode.experiments", "vicode.importers", "vicode.semantics"),
}


def test_help_imports_nothing_heavy() -> None:
    _assert_imports_nothing_heavy("--help")


def test_check_imports_nothing_heavy(tmp_path: Path) -> None:
    _assert_imports_nothing_heavy("check", str(_write_design(tmp_path)))


def test_gen_imports_nothing_heavy(tmp_path: Path) -> None:
    _assert_imports_nothing_heavy("gen", str(_write_design(tmp_path)), "--out", str(tmp_path / "out"))
    assert list((tmp_path / "out").rglob("*.py")), "nothing was generated"


def test_text_export_imports_nothing_heavy(tmp_path: Path) -> None:
    _assert_imports_nothing_heavy("export", str(_write_design(tmp_path)), "--format", "mermaid")


def test_the_editor_imports_only_what_the_first_page_needs(tmp_path: Path) -> None:
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}
    state = {"VICODE_STATE": str(tmp_path / "state"), "NICEGUI_STORAGE_PATH": str(tmp_path / "storage")}
    command = [sys.executable, "-X", "importtime", "-m", "vicode", "edit", "--no-open", str(_write_design(tmp_path))]
    log = tmp_path / "imports.txt"
    with (
        log.open("w") as errors,
        subprocess.Popen(
            command, cwd=ROOT, stdout=subprocess.PIPE, stderr=errors, text=True, env={**kept, **state}
        ) as editor,
    ):
        try:
            assert editor.stdout is not None
            found = re.search(r"http://\S+", editor.stdout.readline())
            assert found is not None
            with urllib.request.urlopen(found[0]) as page:
                assert "Blinker" in page.read().decode()
        finally:
            editor.kill()
    imported = set(re.findall(r"\| +(\S+)$", log.read_text(), re.MULTILINE))
    assert "vicode.editor.pages.design_page" in imported
    assert sorted(imported & NOT_FOR_THE_FIRST_PAGE) == []


def _write_design(folder: Path) -> Path:
    path = folder / "blinker.yaml"
    path.write_text(DESIGN, encoding="utf-8")
    return path


def _assert_imports_nothing_heavy(*arguments: str) -> None:
    command = [sys.executable, "-c", PROGRAM, *arguments]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
