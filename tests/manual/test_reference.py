"""The tables of docs/reference are those of the code: `make reference` writes them."""

import re
from pathlib import Path

import pytest

from tests.manual import reference_tables

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs/reference"
PAGES = {
    "commands.md": ("commands", reference_tables.commands),
    "runtime.md": ("runtime", reference_tables.runtime),
    "expressions.md": ("functions", reference_tables.functions),
}


@pytest.mark.parametrize("page", PAGES)
def test_the_page_is_up_to_date(page: str, accept: bool) -> None:
    file = FOLDER / page
    name, make = PAGES[page]
    mark = f"<!-- generated: {name} -->\n"
    before, _, rest = file.read_text(encoding="utf-8").partition(mark)
    expected = f"{before}{mark}{make()}<!-- end -->{rest.partition('<!-- end -->')[2]}"
    if accept:
        file.write_text(expected, encoding="utf-8")
    assert file.read_text(encoding="utf-8") == expected, "run make reference and review the difference"


def test_all_environment_variables_are_listed() -> None:
    sources = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "vicode").rglob("*.py"))
    table = (FOLDER / "commands.md").read_text(encoding="utf-8").partition("## Environment variables")[2]
    assert set(re.findall(r"\bVICODE_[A-Z_]+\b", sources)) == set(re.findall(r"`(VICODE_\w+)`", table))
