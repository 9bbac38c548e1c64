"""docs/design-format.md says what the reader reads: its tables come from the format, its examples are sound."""

import re
from pathlib import Path

import pytest

from vicode.store import read_design, read_project_file
from vicode.store.format import DESIGN_RECORDS, PROJECT_RECORDS
from vicode.store.line_index import MAX_FINDINGS
from vicode.store.schema_types import (
    KeySchema,
    ListSchema,
    MapSchema,
    PairSchema,
    RecordSchema,
    ScalarSchema,
    ValueSchema,
)
from vicode.store.yaml_tree import MAX_BYTES, MAX_DEPTH, MAX_NODES

PAGE = Path(__file__).parents[2] / "docs" / "design-format.md"
BLOCK = re.compile(r"(<!-- keys: (\w+) -->\n)((?:\|.*\n)*)")
EXAMPLE = re.compile(r"```yaml\n(.*?)```", re.DOTALL)
BY_NAME = {record.name: record for record in (*PROJECT_RECORDS, *DESIGN_RECORDS)}


def test_the_tables_are_those_of_the_reader(accept: bool) -> None:
    text = PAGE.read_text(encoding="utf-8")
    fresh = BLOCK.sub(lambda match: match.group(1) + _table(BY_NAME[match.group(2)]), text)
    if accept:
        PAGE.write_text(fresh, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == fresh, "run pytest --accept and read the difference"


def test_every_record_has_its_table() -> None:
    shown = {match.group(2) for match in BLOCK.finditer(PAGE.read_text(encoding="utf-8"))}
    same_keys = {"variable", "argument"}
    assert shown | same_keys == set(BY_NAME)


@pytest.mark.parametrize("example", EXAMPLE.findall(PAGE.read_text(encoding="utf-8")))
def test_the_examples_are_sound(example: str) -> None:
    read = read_project_file if "project:" in example else read_design
    assert read(example).findings == ()


def test_the_limits_are_those_of_the_reader() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert f"{MAX_BYTES // 1_000_000} MB" in text
    assert f"{MAX_NODES // 1000} 000 values" in text
    assert f"{MAX_DEPTH} levels" in text
    assert MAX_FINDINGS > 100


def _table(record: RecordSchema) -> str:
    rows = [
        f"| `{key.name}` | {_shape(key.schema)} | {_default(key, record)} | {key.description} |\n"
        for key in record.keys
    ]
    return "".join(["| key | shape | left out | meaning |\n", "|-----|-------|----------|---------|\n", *rows])


def _default(key: KeySchema, record: RecordSchema) -> str:
    if key.required:
        return "a mistake"
    if key.name in record.one_of:
        return "one of " + ", ".join(f"`{name}`" for name in record.one_of)
    if key.name == "languages":
        return "`[python]`"
    return f"`{key.default}`" if isinstance(key.default, str) else "no" if key.default is False else "–"


def _shape(shape: ValueSchema) -> str:
    match shape:
        case ScalarSchema(scalar_type=kind, choices=choices):
            return " or ".join(f"`{choice}`" for choice in choices) or str(kind)
        case PairSchema() | ListSchema() | MapSchema():
            return shape.description
        case RecordSchema():
            return shape.description
