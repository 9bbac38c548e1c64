"""Commands without a browser do not import NiceGUI or other slow libraries."""

import subprocess
import sys
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


def test_help_imports_nothing_heavy() -> None:
    _assert_imports_nothing_heavy("--help")


def test_check_imports_nothing_heavy(tmp_path: Path) -> None:
    _assert_imports_nothing_heavy("check", str(_write_design(tmp_path)))


def test_gen_imports_nothing_heavy(tmp_path: Path) -> None:
    _assert_imports_nothing_heavy("gen", str(_write_design(tmp_path)), "--out", str(tmp_path / "out"))
    assert list((tmp_path / "out").rglob("*.py")), "nothing was generated"


def test_text_export_imports_nothing_heavy(tmp_path: Path) -> None:
    _assert_imports_nothing_heavy("export", str(_write_design(tmp_path)), "--format", "mermaid")


def _write_design(folder: Path) -> Path:
    path = folder / "blinker.yaml"
    path.write_text(DESIGN, encoding="utf-8")
    return path


def _assert_imports_nothing_heavy(*arguments: str) -> None:
    command = [sys.executable, "-c", PROGRAM, *arguments]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
