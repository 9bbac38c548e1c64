"""The import contracts in pyproject.toml hold."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PURE_EDITOR_MODULES = ("vicode.editor.session", "vicode.editor.view")


def test_import_contracts_hold() -> None:
    command = [sys.executable, "-c", "from importlinter.cli import lint_imports_command as main; main()", "--no-cache"]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.parametrize("module", PURE_EDITOR_MODULES)
def test_importing_session_and_view_does_not_import_nicegui(module: str) -> None:
    program = f"import sys, {module}; sys.exit('nicegui is imported' if 'nicegui' in sys.modules else 0)"
    result = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, f"{module} must be usable without NiceGUI:\n{result.stderr}"
