"""The JSON Schema accepts the same files as the reader."""

from pathlib import Path

import pytest
from hypothesis import given
from jsonschema import Draft202012Validator

from tests.strategies.designs import designs, projects
from vicode.findings import Severity
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.store import (
    design_schema,
    project_schema,
    read_design,
    read_project_file,
    save_design,
    save_project_file,
)
from vicode.store.format import DESIGN
from vicode.store.line_index import LineIndex, ReadReport
from vicode.store.project_format import PROJECT
from vicode.store.schema_types import ListSchema, MapSchema, RecordSchema, ValueSchema
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, parse_yaml

TOP = Path(__file__).parents[2]
FILES = sorted((TOP / "designs").rglob("*.yaml")) + sorted((TOP / "tests").rglob("cases/*.yaml"))
DESIGN_VALIDATOR = Draft202012Validator(design_schema())
PROJECT_VALIDATOR = Draft202012Validator(project_schema())
CORE_WORDS: dict[str, object] = {"": None, "~": None, "null": None, "true": True, "false": False}


@pytest.mark.parametrize("schema", [design_schema(), project_schema()], ids=["design", "project"])
def test_the_schema_is_valid(schema: dict[str, object]) -> None:
    Draft202012Validator.check_schema(schema)


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(TOP)))
def test_schema_and_reader_agree_about_files(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    is_project = path.stem.startswith("project")
    findings = (read_project_file if is_project else read_design)(text).findings
    report = ReadReport(line_index=LineIndex(text, path.name))
    root = parse_yaml(text, report).root
    if report.findings or root is None:
        assert any(finding.severity is Severity.ERROR for finding in findings)
        return
    validator = PROJECT_VALIDATOR if is_project else DESIGN_VALIDATOR
    assert validator.is_valid(_as_json(root)) == (not findings)


@given(designs)
def test_saved_designs_are_valid(design: Design) -> None:
    DESIGN_VALIDATOR.validate(_parsed(save_design(design)))


@given(projects)
def test_saved_projects_are_valid(project: Project) -> None:
    PROJECT_VALIDATOR.validate(_parsed(save_project_file(project)))


@pytest.mark.parametrize(("record", "schema"), [(DESIGN, design_schema()), (PROJECT, project_schema())])
def test_the_schema_has_the_readers_keys(record: RecordSchema, schema: dict[str, object]) -> None:
    definitions = schema["$defs"]
    assert isinstance(definitions, dict)
    records = _records(record)
    assert set(definitions) == {each.name for each in records}
    for each in records:
        mapping = definitions[each.name]
        mapping = mapping.get("anyOf", [mapping])[0]
        assert list(mapping["properties"]) == [key.name for key in each.keys]
        assert mapping["additionalProperties"] is False


def _records(shape: ValueSchema, seen: tuple[RecordSchema, ...] = ()) -> tuple[RecordSchema, ...]:
    if isinstance(shape, MapSchema):
        return _records(shape.value_schema, seen)
    if isinstance(shape, ListSchema):
        return _records(shape.item_schema(), seen)
    if not isinstance(shape, RecordSchema) or shape.name in {each.name for each in seen}:
        return seen
    seen = (*seen, shape)
    for key in shape.keys:
        seen = _records(key.schema, seen)
    return seen


def _parsed(text: str) -> object:
    root = parse_yaml(text, ReadReport(line_index=LineIndex(text, ""))).root
    assert root is not None
    return _as_json(root)


def _as_json(node: YamlNode) -> object:
    """A value as an editor's YAML reader has it, after the core schema of YAML 1.2."""
    if isinstance(node, YamlMapping):
        return {key.text if isinstance(key, YamlScalar) else "?": _as_json(value) for key, value in node.pairs}
    if not isinstance(node, YamlScalar):
        return [_as_json(item) for item in node.items]
    if node.style or node.text in CORE_WORDS:
        return node.text if node.style else CORE_WORDS[node.text]
    for number in (int, float):
        try:
            return number(node.text)
        except ValueError:
            continue
    return node.text
