"""The format as JSON Schema, so that editors complete and check YAML while it is typed."""

from typing import cast

from vicode.store.format import DESIGN, PROJECT, VERSION
from vicode.store.shapes import Key, Kind, Leaf, Listing, Pair, Record, Shape, Table

Schema = dict[str, object]

_DIALECT = "https://json-schema.org/draft/2020-12/schema"
_SCALAR: Schema = {"type": ["string", "number", "boolean", "null"]}


def design_schema() -> Schema:
    """JSON Schema (draft 2020-12) of a design file."""
    return _document(DESIGN, "vicode design")


def project_schema() -> Schema:
    """JSON Schema (draft 2020-12) of a project.yaml."""
    return _document(PROJECT, "vicode project")


def _document(record: Record, title: str) -> Schema:
    definitions: Schema = {}
    reference = _schema(record, definitions)
    return {"$schema": _DIALECT, "title": title, **reference, "$defs": definitions}


def _schema(shape: Shape, definitions: Schema) -> Schema:
    match shape:
        case Leaf():
            return _leaf(shape)
        case Pair():
            number = {"type": "number"}
            return {"description": shape.what, "type": "array", "items": number, "minItems": 2, "maxItems": 2}
        case Listing():
            return _listing(shape, definitions)
        case Table():
            return _table(shape, definitions)
        case Record():
            return _reference(shape, definitions)


def _leaf(shape: Leaf) -> Schema:
    match shape.kind:
        case Kind.NUMBER:
            return {"type": "number", "exclusiveMinimum": 0}
        case Kind.COUNT:
            return {"type": "integer", "minimum": 0}
        case Kind.FLAG:
            return {"type": "boolean"}
        case Kind.TRUE:
            return {"const": True}
        case Kind.VERSION:
            return {"const": int(VERSION)}
    return {"enum": list(shape.choices)} if shape.choices else dict(_SCALAR)


def _listing(shape: Listing, definitions: Schema) -> Schema:
    item = shape.item()
    items: Schema = {"type": "array", "items": _schema(item, definitions)}
    if not shape.lone or not isinstance(item, Record):
        return items
    key = item.key(shape.lone)
    assert key is not None, "the table names a key that the item does not have"
    return {"description": shape.what, "anyOf": [items, _schema(key.shape, definitions)]}


def _table(shape: Table, definitions: Schema) -> Schema:
    value = _or_nothing(_schema(shape.value, definitions))
    mapping: Schema = {"type": ["object", "null"], "additionalProperties": value}
    if shape.keys:
        mapping = {
            "type": ["object", "null"],
            "properties": dict.fromkeys(shape.keys, value),
            "additionalProperties": False,
        }
    forms: list[Schema] = [mapping]
    if shape.names:
        forms.append({"type": "array", "items": dict(_SCALAR), "uniqueItems": True})
    if shape.short:
        forms.append(dict(_SCALAR))
    return {"description": shape.what, **mapping} if len(forms) == 1 else {"description": shape.what, "anyOf": forms}


def _reference(record: Record, definitions: Schema) -> Schema:
    if record.name not in definitions:
        # The name is taken first: a transition holds transitions.
        definitions[record.name] = {}
        definitions[record.name] = _record(record, definitions)
    return {"$ref": f"#/$defs/{record.name}"}


def _record(record: Record, definitions: Schema) -> Schema:
    properties = {key.name: _property(key, record, definitions) for key in record.keys}
    mapping: Schema = {"type": ["object", "null"], "properties": properties, "additionalProperties": False}
    required = [key.name for key in record.keys if key.required]
    if required:
        mapping |= {"type": "object", "required": required}
    if record.one_of:
        mapping |= {"type": "object", "oneOf": [{"required": [name]} for name in record.one_of]}
    if record.needs:
        mapping["dependentRequired"] = {name: [needed] for name, needed in record.needs}
    if not record.short:
        return {"description": record.what, **mapping}
    key = record.key(record.short)
    assert key is not None, "the table names a key that the record does not have"
    return {"description": record.what, "anyOf": [mapping, _schema(key.shape, definitions)]}


def _property(key: Key, record: Record, definitions: Schema) -> Schema:
    schema = _schema(key.shape, definitions)
    if key.name not in record.one_of:
        schema = _or_nothing(schema)
    return {**schema, "description": key.meaning}


def _or_nothing(schema: Schema) -> Schema:
    """Also the empty value: a key with nothing behind it is left out."""
    types = schema.get("type")
    if types is None or "const" in schema or "enum" in schema:
        return {"anyOf": [schema, {"type": "null"}]}
    known = cast("list[str]", [types] if isinstance(types, str) else types)
    return {**schema, "type": [*known, *([] if "null" in known else ["null"])]}
