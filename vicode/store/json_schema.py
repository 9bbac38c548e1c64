"""The format as JSON Schema, so that editors complete and check YAML while it is typed."""

from typing import cast

from vicode.store.format import DESIGN, PROJECT, VERSION
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


def _schema(shape: ValueSchema, definitions: JsonSchema) -> JsonSchema:
    match shape:
        case ScalarSchema():
            return _scalar_schema(shape)
        case PairSchema():
            number = {"type": "number"}
            return {"description": shape.description, "type": "array", "items": number, "minItems": 2, "maxItems": 2}
        case ListSchema():
            return _list_schema(shape, definitions)
        case MapSchema():
            return _map_schema(shape, definitions)
        case RecordSchema():
            return _reference(shape, definitions)


def _scalar_schema(shape: ScalarSchema) -> JsonSchema:
    match shape.scalar_type:
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
    return {"enum": list(shape.choices)} if shape.choices else dict(_SCALAR)


def _list_schema(shape: ListSchema, definitions: JsonSchema) -> JsonSchema:
    item = shape.item_schema()
    items: JsonSchema = {"type": "array", "items": _schema(item, definitions)}
    if not shape.single_item_key or not isinstance(item, RecordSchema):
        return items
    key = item.find_key(shape.single_item_key)
    assert key is not None, "the table names a key that the item does not have"
    return {"description": shape.description, "anyOf": [items, _schema(key.schema, definitions)]}


def _map_schema(shape: MapSchema, definitions: JsonSchema) -> JsonSchema:
    value = _or_null(_schema(shape.value_schema, definitions))
    mapping: JsonSchema = {"type": ["object", "null"], "additionalProperties": value}
    if shape.allowed_keys:
        mapping = {
            "type": ["object", "null"],
            "properties": dict.fromkeys(shape.allowed_keys, value),
            "additionalProperties": False,
        }
    forms: list[JsonSchema] = [mapping]
    if shape.allows_name_list:
        forms.append({"type": "array", "items": dict(_SCALAR), "uniqueItems": True})
    if shape.shorthand_key:
        forms.append(dict(_SCALAR))
    return (
        {"description": shape.description, **mapping}
        if len(forms) == 1
        else {"description": shape.description, "anyOf": forms}
    )


def _reference(record: RecordSchema, definitions: JsonSchema) -> JsonSchema:
    if record.name not in definitions:
        # The name is taken first: a transition holds transitions.
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
        mapping["dependentRequired"] = {name: [needed] for name, needed in record.dependent_keys}
    if not record.shorthand_key:
        return {"description": record.description, **mapping}
    key = record.find_key(record.shorthand_key)
    assert key is not None, "the table names a key that the record does not have"
    return {"description": record.description, "anyOf": [mapping, _schema(key.schema, definitions)]}


def _property(key: KeySchema, record: RecordSchema, definitions: JsonSchema) -> JsonSchema:
    schema = _schema(key.schema, definitions)
    if key.name not in record.one_of:
        schema = _or_null(schema)
    return {**schema, "description": key.description}


def _or_null(schema: JsonSchema) -> JsonSchema:
    """Also the empty value: a key with nothing behind it is left out."""
    types = schema.get("type")
    if types is None or "const" in schema or "enum" in schema:
        return {"anyOf": [schema, {"type": "null"}]}
    known = cast("list[str]", [types] if isinstance(types, str) else types)
    return {**schema, "type": [*known, *([] if "null" in known else ["null"])]}
