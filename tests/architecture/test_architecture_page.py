"""The architecture page prints the import contract as it is checked, and names only files that exist."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
TOP_LEVEL = ("docs/", "templates/", "tests/", "benchmarks/", "designs/")


def test_the_import_contract_is_printed() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    layers = project["tool"]["importlinter"]["contracts"][0]["layers"]
    contract = "\n".join(re.sub(r"[()]", "", layer) for layer in layers)
    assert f"```\n{contract}\n```" in PAGE


def test_every_file_of_the_tables_exists() -> None:
    tables = PAGE[PAGE.index("## Where do I change") :]
    paths = re.findall(r"`([\w/.-]+(?:/|\.(?:py|js|css|md|j2)))`", tables)
    missing = [
        path for path in paths if not (ROOT / (path if path.startswith(TOP_LEVEL) else f"vicode/{path}")).exists()
    ]
    assert len(paths) > 100
    assert set(missing) <= {"__init__.py", "origins.py"}, missing
