"""Converts between values of the format and the model, as the schema declares it."""

from collections.abc import Mapping
from typing import Any, cast

from vicode.model.design import Design
from vicode.model.lowering import lift_design, lower_design
from vicode.model.project import Project
from vicode.store.format import DESIGN
from vicode.store.project_format import PROJECT
from vicode.store.schema_types import (
    FormatValue,
    ListSchema,
    MapSchema,
    PairSchema,
    RecordSchema,
    ScalarSchema,
    ValueSchema,
    build_record_value,
)


def decode_design(value: FormatValue, default_name: str) -> Design:
    """Build a lowered design (`vicode.model.lowering`); `default_name` is the component name if the file has none."""
    return lower_design(cast("Design", decode_record(DESIGN, value, {"component": default_name})))


def decode_project(value: FormatValue, default_name: str) -> Project:
    """Build a project without designs; `default_name` is its name if the file has none."""
    return cast("Project", decode_record(PROJECT, value, {"name": default_name}))


def encode_design(design: Design) -> FormatValue:
    return _encode_record(DESIGN, lift_design(design))


def encode_project(project: Project) -> FormatValue:
    return _encode_record(PROJECT, project)


def _decode(schema: ValueSchema, value: Any) -> Any:
    match schema:
        case ScalarSchema() | PairSchema():
            return value
        case ListSchema():
            item_schema = schema.item_schema()
            return tuple(_decode(item_schema, item) for item in value)
        case MapSchema():
            return _decode_map(schema, value)
        case RecordSchema():
            return decode_record(schema, value, {})


def _decode_map(schema: MapSchema, pairs: Any) -> Any:
    if schema.wrapper is not None:
        return schema.wrapper(texts=pairs)
    if not schema.name_field:
        return pairs
    if isinstance(schema.value_schema, RecordSchema):
        return tuple(decode_record(schema.value_schema, value, {schema.name_field: name}) for name, value in pairs)
    assert schema.entry_model is not None, "a map of values with a name_field lacks its entry_model"
    return tuple(schema.entry_model(**{schema.name_field: name, schema.value_field: value}) for name, value in pairs)


def decode_record(schema: RecordSchema, pairs: FormatValue, defaults: Mapping[str, Any]) -> Any:
    """Build the model of a record; `defaults` are fields of the model that the record may set."""
    values = dict(cast("tuple[tuple[str, FormatValue], ...]", pairs))
    arguments = dict(defaults)
    nested: dict[str, dict[str, Any]] = {}
    for key in schema.keys:
        parent, _dot, field = key.model_field.rpartition(".")
        if key.constant is not None:
            continue
        if key.name in values:
            target = nested.setdefault(parent, {}) if parent else arguments
            target[field] = _decode(key.schema, values[key.name])
        elif key.required and field not in arguments:
            arguments[field] = "" if isinstance(key.schema, ScalarSchema) else ()
    for parent, fields in nested.items():
        arguments[parent] = schema.nested[parent](**fields)
    variant = next((name for name in schema.variants if name in values), "")
    model = schema.variants[variant] if variant else schema.model
    assert model is not None, f"no variant of {schema.name} is given"
    return model(**arguments)


def _encode(schema: ValueSchema, value: Any) -> FormatValue | None:
    if value is None:
        return None
    match schema:
        case ScalarSchema() | PairSchema():
            return cast("FormatValue", value)
        case ListSchema():
            item_schema = schema.item_schema()
            return tuple(cast("FormatValue", _encode(item_schema, item)) for item in value)
        case MapSchema():
            return _encode_map(schema, value)
        case RecordSchema():
            return _encode_record(schema, value)


def _encode_map(schema: MapSchema, value: Any) -> FormatValue:
    if schema.wrapper is not None:
        return cast("FormatValue", value.texts)
    if not schema.name_field:
        return cast("FormatValue", value)
    if isinstance(schema.value_schema, RecordSchema):
        record = schema.value_schema
        return tuple((getattr(entry, schema.name_field), _encode_record(record, entry)) for entry in value)
    return tuple((getattr(entry, schema.name_field), getattr(entry, schema.value_field)) for entry in value)


def _encode_record(schema: RecordSchema, model: Any) -> FormatValue:
    values: dict[str, FormatValue | None] = {}
    for key in schema.keys:
        if key.shorthand_for:
            continue
        if schema.variants and not _has_key(schema, key.name, type(model)):
            continue
        if key.constant is not None:
            values[key.name] = key.constant
            continue
        parent, _dot, field = key.model_field.rpartition(".")
        values[key.name] = _encode(key.schema, getattr(getattr(model, parent) if parent else model, field))
    return build_record_value(schema, values)


def _has_key(schema: RecordSchema, name: str, model: type) -> bool:
    """Whether a key belongs to the variant of this model."""
    if name in schema.variants:
        return schema.variants[name] is model
    key = schema.find_key(name)
    return key is not None and key.model_field.partition(".")[0] in model.__dataclass_fields__  # type: ignore[attr-defined]
