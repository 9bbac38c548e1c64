"""The format as JSON Schema, with which text editors complete and check YAML."""

from typing import cast

from vicode.store.format import DESIGN
from vicode.store.format_values import VERSION
from vicode.store.project_format import PROJECT
from vicode.store.schema_types import (
    KeySchema,
    ListSchema,
    MapSchema,
    PairSchema,
    RecordSchema,
    ScalarSchema,
    ScalarType,
    ValueSchema,
)

JsonSchema = dict[str, object]

_DIALECT = "https://json-schema.org/draft/2020-12/schema"
_SCALAR: JsonSchema = {"type": ["string", "number", "boolean", "null"]}


def design_schema() -> JsonSchema:
    """JSON Schema (draft 2020-12) of a design file."""
    return _document(DESIGN, "vicode design")


def project_schema() -> JsonSchema:
    """JSON Schema (draft 2020-12) of a project.yaml."""
    return _document(PROJECT, "vicode project")


def _document(record: RecordSchema, title: str) -> JsonSchema:
    definitions: JsonSchema = {}
    reference = _schema(record, definitions)
    return {"$schema": _DIALECT, "title": title, **reference, "$defs": definitions}


def _schema(schema: ValueSchema, definitions: JsonSchema) -> JsonSchema:
    match schema:
        case ScalarSchema():
            return _scalar_schema(schema)
        case PairSchema():
            number = {"type": "number"}
            return {"description": schema.description, "type": "array", "items": number, "minItems": 2, "maxItems": 2}
        case ListSchema():
            return _list_schema(schema, definitions)
        case MapSchema():
            return _map_schema(schema, definitions)
        case RecordSchema():
            return _reference(schema, definitions)


def _scalar_schema(schema: ScalarSchema) -> JsonSchema:
    match schema.scalar_type:
        case ScalarType.NUMBER:
            return {"type": "number", "exclusiveMinimum": 0}
        case ScalarType.COUNT:
            return {"type": "integer", "minimum": 0}
        case ScalarType.BOOLEAN:
            return {"type": "boolean"}
        case ScalarType.TRUE:
            return {"const": True}
        case ScalarType.VERSION:
            return {"const": int(VERSION)}
    return {"enum": list(schema.choices)} if schema.choices else dict(_SCALAR)


def _list_schema(schema: ListSchema, definitions: JsonSchema) -> JsonSchema:
    item = schema.item_schema()
    items: JsonSchema = {"type": "array", "items": _schema(item, definitions)}
    if not schema.single_item_key or not isinstance(item, RecordSchema):
        return items
    key = item.find_key(schema.single_item_key)
    assert key is not None, "the item schema lacks the single_item_key of its list"
    return {"description": schema.description, "anyOf": [items, _schema(key.schema, definitions)]}


def _map_schema(schema: MapSchema, definitions: JsonSchema) -> JsonSchema:
    value = _or_null(_schema(schema.value_schema, definitions))
    mapping: JsonSchema = {"type": ["object", "null"], "additionalProperties": value}
    if schema.allowed_keys:
        mapping = {
            "type": ["object", "null"],
            "properties": dict.fromkeys(schema.allowed_keys, value),
            "additionalProperties": False,
        }
    forms: list[JsonSchema] = [mapping]
    if schema.allows_name_list:
        forms.append({"type": "array", "items": dict(_SCALAR), "uniqueItems": True})
    if schema.shorthand_key:
        forms.append(dict(_SCALAR))
    return (
        {"description": schema.description, **mapping}
        if len(forms) == 1
        else {"description": schema.description, "anyOf": forms}
    )


def _reference(record: RecordSchema, definitions: JsonSchema) -> JsonSchema:
    if record.name not in definitions:
        # Registered before its properties are built: transitions contain transitions.
        definitions[record.name] = {}
        definitions[record.name] = _record_schema(record, definitions)
    return {"$ref": f"#/$defs/{record.name}"}


def _record_schema(record: RecordSchema, definitions: JsonSchema) -> JsonSchema:
    properties = {key.name: _property(key, record, definitions) for key in record.keys}
    mapping: JsonSchema = {"type": ["object", "null"], "properties": properties, "additionalProperties": False}
    required = [key.name for key in record.keys if key.required]
    if required:
        mapping |= {"type": "object", "required": required}
    if record.one_of:
        mapping |= {"type": "object", "oneOf": [{"required": [name]} for name in record.one_of]}
    if record.dependent_keys:
        mapping["dependentRequired"] = {key: needed for key, *needed in record.dependent_keys if len(needed) == 1}
    if not record.shorthand_key:
        return {"description": record.description, **mapping}
    key = record.find_key(record.shorthand_key)
    assert key is not None, "the record lacks its shorthand_key"
    return {"description": record.description, "anyOf": [mapping, _schema(key.schema, definitions)]}


def _property(key: KeySchema, record: RecordSchema, definitions: JsonSchema) -> JsonSchema:
    schema = _schema(key.schema, definitions)
    if key.name not in record.one_of:
        schema = _or_null(schema)
    return {**schema, "description": key.description}


def _or_null(schema: JsonSchema) -> JsonSchema:
    """Also allow null: a key without a value counts as missing."""
    types = schema.get("type")
    if types is None or "const" in schema or "enum" in schema:
        return {"anyOf": [schema, {"type": "null"}]}
    type_list = cast("list[str]", [types] if isinstance(types, str) else types)
    return {**schema, "type": [*type_list, *([] if "null" in type_list else ["null"])]}
