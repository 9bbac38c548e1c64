"""Each key of the format has a field in the model, each field has a key, and the strategies draw all fields."""

from collections.abc import Iterator
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from typing import Any

import pytest
from hypothesis import Phase, given, settings

from tests.strategies import designs
from vicode.model import design as design_model
from vicode.model import project as project_model
from vicode.store.format import DESIGN_RECORDS
from vicode.store.project_format import PROJECT_RECORDS
from vicode.store.schema_types import ListSchema, MapSchema, RecordSchema, ValueSchema

RECORDS = {record.name: record for record in (*DESIGN_RECORDS, *PROJECT_RECORDS)}
DERIVED = {f"{name}.origin" for name in ("Declaration", "Transition", "DecisionGroup", "Assign", "State")}
NOT_IN_FILE = {*DERIVED, "Interface.remote", "Interface.tunable", "Project.designs", "Project.unreadable"}
MODEL_CLASSES = [
    value
    for module in (design_model, project_model)
    for value in vars(module).values()
    if isinstance(value, type) and is_dataclass(value) and value.__module__ == module.__name__
]


@pytest.mark.parametrize("record", RECORDS.values(), ids=lambda record: record.name)
def test_each_key_has_a_field_in_the_model(record: RecordSchema) -> None:
    models = [record.model] if record.model else list(record.variants.values())
    for key in record.keys:
        if key.constant is not None or key.shorthand_for:
            continue
        parent, _dot, name = key.model_field.rpartition(".")
        owners: list[Any] = [record.nested[parent]] if parent else models
        assert any(name in owner.__dataclass_fields__ for owner in owners), f"no field for key '{key.name}'"


def test_each_field_of_the_model_has_a_key() -> None:
    declared = {name for record in RECORDS.values() for name in _declared_fields(record)}
    existing = {f"{cls.__name__}.{name}" for cls in MODEL_CLASSES for name in _defaults(cls)}
    assert existing - declared == NOT_IN_FILE
    assert declared <= existing


def test_the_strategies_draw_each_field() -> None:
    """The save laws only cover what the strategies draw: each field must get a value other than its default."""
    drawn: set[str] = set()

    @settings(max_examples=400, phases=[Phase.generate], database=None, derandomize=True, deadline=None)
    @given(designs.lowered_designs, designs.projects)
    def collect(design: object, project: object) -> None:
        for node in (*_iter_nodes(design), *_iter_nodes(project)):
            defaults = _defaults(type(node))
            drawn.update(f"{type(node).__name__}.{name}" for name in defaults if getattr(node, name) != defaults[name])

    collect()
    existing = {f"{cls.__name__}.{name}" for cls in MODEL_CLASSES for name in _defaults(cls)}
    assert existing - drawn - DERIVED == NOT_IN_FILE - DERIVED


@cache
def _defaults(cls: type) -> dict[str, object]:
    return {
        field.name: field.default_factory() if field.default_factory is not MISSING else field.default
        for field in fields(cls)  # type: ignore[arg-type]
        if field.init
    }


def _declared_fields(record: RecordSchema) -> Iterator[str]:
    for model in [record.model] if record.model else list(record.variants.values()):
        assert model is not None
        own_fields = {field.name for field in fields(model)}  # type: ignore[arg-type]
        for key in record.keys:
            parent, _dot, name = key.model_field.rpartition(".")
            if parent:
                yield f"{model.__name__}.{parent}"
                yield f"{record.nested[parent].__name__}.{name}"
            elif name in own_fields and not key.shorthand_for:
                yield f"{model.__name__}.{name}"
    for key in record.keys:
        yield from _entry_fields(key.schema)


def _entry_fields(schema: ValueSchema) -> Iterator[str]:
    if isinstance(schema, ListSchema) and not isinstance(schema.item_schema(), RecordSchema):
        yield from _entry_fields(schema.item_schema())
    if not isinstance(schema, MapSchema):
        return
    if schema.wrapper is not None:
        yield "Code.texts"
    if isinstance(schema.entry_model, type):
        yield f"{schema.entry_model.__name__}.{schema.name_field}"
        yield f"{schema.entry_model.__name__}.{schema.value_field}"
    if isinstance(schema.value_schema, RecordSchema):
        for model in (schema.value_schema.model, *schema.value_schema.variants.values()):
            if model is not None:
                yield f"{model.__name__}.{schema.name_field}"


def _iter_nodes(value: object) -> Iterator[object]:
    if isinstance(value, tuple):
        for item in value:
            yield from _iter_nodes(item)
    elif is_dataclass(value) and not isinstance(value, type):
        yield value
        for field in fields(value):
            yield from _iter_nodes(getattr(value, field.name))
