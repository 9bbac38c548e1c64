"""The tables of docs/design-format.md are generated from the format, and its examples are valid."""

import re
from pathlib import Path

import pytest

from vicode.store import read_design, read_project_file
from vicode.store.format import DESIGN_RECORDS
from vicode.store.line_index import MAX_FINDINGS
from vicode.store.project_format import PROJECT_RECORDS
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


def test_tables_match_the_format(accept: bool) -> None:
    text = PAGE.read_text(encoding="utf-8")
    expected = BLOCK.sub(lambda match: match.group(1) + _table(BY_NAME[match.group(2)]), text)
    if accept:
        PAGE.write_text(expected, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == expected, "run pytest --accept and review the difference"


def test_each_record_has_a_table() -> None:
    shown = {match.group(2) for match in BLOCK.finditer(PAGE.read_text(encoding="utf-8"))}
    same_keys = {"variable", "argument"}
    assert shown | same_keys == set(BY_NAME)


@pytest.mark.parametrize("example", EXAMPLE.findall(PAGE.read_text(encoding="utf-8")))
def test_examples_are_valid(example: str) -> None:
    read = read_project_file if "project:" in example else read_design
    assert read(example).findings == ()


def test_limits_match_the_reader() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert f"{MAX_BYTES // 1_000_000} MB" in text
    assert f"{MAX_NODES // 1000} 000 values" in text
    assert f"{MAX_DEPTH} levels" in text
    assert MAX_FINDINGS > 100


def _table(record: RecordSchema) -> str:
    rows = [
        f"| `{key.name}` | {_describe(key.schema)} | {_default(key, record)} | {key.description} |\n"
        for key in record.keys
    ]
    return "".join(["| key | value | default | meaning |\n", "|-----|-------|---------|---------|\n", *rows])


def _default(key: KeySchema, record: RecordSchema) -> str:
    if key.required:
        return "required"
    if key.name in record.one_of:
        return "required: one of " + ", ".join(f"`{name}`" for name in record.one_of)
    if key.name == "languages":
        return "`[python]`"
    return f"`{key.default}`" if isinstance(key.default, str) else "no" if key.default is False else "–"


def _describe(schema: ValueSchema) -> str:
    match schema:
        case ScalarSchema(scalar_type=scalar_type, choices=choices):
            return " or ".join(f"`{choice}`" for choice in choices) or str(scalar_type)
        case PairSchema() | ListSchema() | MapSchema():
            return schema.description
        case RecordSchema():
            return schema.description
