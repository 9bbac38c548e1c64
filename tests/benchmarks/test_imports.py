"""What the benchmarks import from the product exists: nothing else runs them."""

import ast
import importlib
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.mark.parametrize("path", sorted(BENCHMARKS.glob("*.py")), ids=lambda path: path.stem)
def test_the_imported_names_exist(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    ours = [node for node in imports if node.module and node.module.split(".")[0] in ("vicode", "tests")]
    assert [name for node in ours for name in _missing(node)] == []


def _missing(node: ast.ImportFrom) -> list[str]:
    names = [f"{node.module}.{alias.name}" for alias in node.names]
    return [name for name in names if not _exists(*name.rsplit(".", 1))]


def _exists(module: str, name: str) -> bool:
    try:
        return hasattr(importlib.import_module(module), name) or bool(importlib.import_module(f"{module}.{name}"))
    except ImportError:
        return False
