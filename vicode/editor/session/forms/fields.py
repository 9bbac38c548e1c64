"""The fields of all forms.

A key of the format needs no entry: without one, its field is derived from its schema and stands below the others.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from vicode.editor.session import texts
from vicode.editor.session.forms.form_field import FormField, attribute, code, count, names, number, pairs, part
from vicode.editor.session.forms.nodes import Check, Node, TextField
from vicode.editor.session.gestures import number_text
from vicode.findings import DesignPath
from vicode.languages import LANGUAGES
from vicode.model.design import (
    INTERRUPT_ENDS,
    STATE_COLORS,
    Assign,
    Call,
    CommonSection,
    Competence,
    CompetenceStep,
    DecisionGroup,
    Declaration,
    Design,
    DiagramFrame,
    DiagramNote,
    Interrupt,
    Latch,
    Layer,
    RunCode,
    State,
    Stay,
    Transition,
)
from vicode.model.names import is_valid_name
from vicode.model.project import Agent, Enumeration, Interface, Project
from vicode.model.words import field_word
from vicode.services import messages
from vicode.store.format import DESIGN_RECORDS
from vicode.store.format_values import NAMES
from vicode.store.project_format import PROJECT_RECORDS
from vicode.store.schema_types import KeySchema, ListSchema, RecordSchema, ScalarSchema, ScalarType

FROM_VALUE = "from value"
"""The type of a declaration without one: that of its value."""
_DESCRIPTION = replace(attribute("doc", "Description"), is_prose=True)
_PREDICATE = "Predicate (body of a function that returns a bool)"
_GUARD: Mapping[DesignPath, FormField] = {
    ("guard", "when"): part("guard", attribute("when", "When", hint="always")),
    ("guard", "after"): part("guard", attribute("after", "After")),
    **{("guard", "code", language): part("guard", code("code", language, _PREDICATE)) for language in LANGUAGES},
    ("doc",): _DESCRIPTION,
    ("disabled",): attribute("disabled", "Disabled (never tested)"),
}
_XABSL_NAME = attribute("xabsl_name", "Name in XABSL", parse=str.strip)
_COLOR = replace(
    attribute("color", "Color"),
    validate=lambda value: "" if value in ("", *STATE_COLORS) else texts.INVALID_REQUEST,
)
_STATE: Mapping[DesignPath, FormField] = {
    ("name",): attribute("name", "State"),
    ("doc",): _DESCRIPTION,
    ("final",): attribute("final", "Final", hint="The component is done in this state"),
    ("failed",): attribute("failed", "Failed", hint="The component has ended without success"),
    ("disabled",): attribute("disabled", "Disabled", hint="Not generated"),
    ("color",): _COLOR,
    ("requires",): attribute("requires", "Components", parse=tuple),
    ("capacity",): replace(
        count("capacity", "Capacity (robots at once)", "no limit"),
        help="A robot waits in its current state until there is room.",
    ),
    ("synchronized",): replace(
        count("synchronized", "Synchronized (robots)", "not synchronized"),
        help="Robots wait in their current state until this many are ready.",
    ),
    ("xabsl_name",): _XABSL_NAME,
}
_STEP: Mapping[DesignPath, FormField] = {("doc",): _DESCRIPTION, ("requires",): _STATE[("requires",)]}
_THEN = FormField(
    label="Then",
    read=lambda interrupt: interrupt.then or INTERRUPT_ENDS[0],
    write=lambda interrupt, text: replace(interrupt, then="" if text == INTERRUPT_ENDS[0] else text),
)
_FREQUENCY = number("frequency_hz", "Frequency, Hz", "every step")
_DECLARATION: Mapping[DesignPath, FormField] = {
    ("type",): FormField(
        label="Type",
        read=lambda owner: owner.type or FROM_VALUE,
        write=lambda owner, text: replace(owner, type="" if text == FROM_VALUE else text.strip()),
    ),
    ("initial",): attribute("initial", "Value", parse=str.strip),
    ("unit",): attribute("unit", "Unit", parse=str.strip),
    ("doc",): _DESCRIPTION,
    ("range",): FormField(
        label="Range",
        hint="minimum, maximum: 0, 9000",
        read=lambda owner: number_text.format_range(owner.range),
        write=lambda owner, text: replace(owner, range=number_text.parse_range(text)),
        validate=number_text.validate_range,
    ),
    ("xabsl_name",): _XABSL_NAME,
    ("tunable",): attribute("tunable", "Tune in running robots"),
}
_DESIGN: Mapping[DesignPath, FormField] = {
    ("doc",): _DESCRIPTION,
    ("initial",): attribute("initial", "Initial state"),
    ("frequency_hz",): _FREQUENCY,
    ("resume",): attribute("resume", "Resume where it left off"),
    ("xabsl_name",): _XABSL_NAME,
    ("arithmetic",): attribute("arithmetic", "Arithmetic"),
    ("time_unit",): attribute("time_unit", "Time unit"),
    **{("module", language): code("module", language, "Module") for language in LANGUAGES},
    **{("members", language): code("members", language, "Members") for language in LANGUAGES},
}


def _validate_name(text: str) -> str:
    name = text.strip()
    return ("" if is_valid_name(name) else messages.invalid_identifier(name)) if name else messages.NAME_MISSING


_PROJECT: Mapping[DesignPath, FormField] = {
    ("name",): replace(attribute("name", "Project name"), validate=_validate_name),
    ("doc",): replace(_DESCRIPTION, label="Project description"),
    ("languages",): names("languages", "Languages", "python"),
    ("world",): attribute("world", "World", hint="module:Class"),
}
_SHARED: Mapping[DesignPath, FormField] = {
    ("doc",): _DESCRIPTION,
    ("xabsl_name",): _XABSL_NAME,
    ("title",): replace(attribute("title", "Title"), is_prose=True),
}
_INTERFACE: Mapping[DesignPath, FormField] = {
    ("frequency_hz",): _FREQUENCY,
    ("implementation",): attribute(
        "implementation", "Implementation", hint="none yet; module:Class, world or internal"
    ),
    **_SHARED,
}
_INTERNAL = "Internal (elements numbered by the XABSL engine)"
_ENUMERATION: Mapping[DesignPath, FormField] = {("internal",): attribute("internal", _INTERNAL), **_SHARED}
_MEANING = FormField(
    label="Meaning", is_prose=True, read=lambda pair: pair[1], write=lambda pair, text: (pair[0], text)
)
_CODE: Mapping[DesignPath, FormField] = {("code", language): code("code", language, "") for language in LANGUAGES}
_FIELDS: Mapping[type, Mapping[DesignPath, FormField]] = {
    Transition: {("to",): attribute("to", "To"), **_GUARD},
    Stay: _GUARD,
    DecisionGroup: _GUARD,
    State: _STATE,
    CommonSection: {("doc",): replace(_DESCRIPTION, label="Description (all states)")},
    Design: _DESIGN,
    Project: _PROJECT,
    Interface: _INTERFACE,
    Enumeration: _ENUMERATION,
    Agent: {("root",): attribute("root", "Root"), **_SHARED},
    tuple: {("doc",): _MEANING},
    Declaration: _DECLARATION,
    Latch: {("doc",): _DESCRIPTION},
    Interrupt: {("do",): attribute("do", "Do"), ("then",): _THEN, ("doc",): _DESCRIPTION},
    Competence: _STEP,
    CompetenceStep: _STEP,
    Layer: _STEP,
    DiagramFrame: {
        ("color",): _COLOR,
        ("states",): replace(
            attribute("states", "States", parse=tuple),
            validate=lambda names: "" if names else "a frame needs at least one state; remove the frame instead",
        ),
    },
    DiagramNote: {("text",): replace(attribute("text", "Text"), is_prose=True)},
    Assign: {("values",): pairs("values", "name = expression, one per line", is_required=True)},
    Call: {("arguments",): pairs("arguments", "parameter = expression, one per line")},
    RunCode: _CODE,
}


def initial_field(state: str) -> FormField:
    """Whether a state is the initial one, as a field of the design. It stays so until another state is."""
    return FormField(
        label="Initial",
        read=lambda design: design.initial == state,
        write=lambda design, value: replace(design, initial=state) if value else design,
    )


def xabsl_field(element: str) -> FormField:
    """The name of an element in XABSL, as a field of its enumeration."""

    def write(enumeration: Enumeration, text: str) -> Enumeration:
        names = {**dict(enumeration.xabsl_elements), element: text}
        pairs = ((each, names.get(each, "")) for each in enumeration.element_names)
        return replace(enumeration, xabsl_elements=tuple(pair for pair in pairs if pair[1]))

    return FormField(
        label="Element in XABSL", read=lambda owner: dict(owner.xabsl_elements).get(element, ""), write=write
    )


def field_of(owner: object, path: DesignPath) -> FormField | None:
    """The field at a path of an owner; None if there is none."""
    kind: Any = type(owner)
    return _FIELDS.get(kind, {}).get(path) or _other_fields(kind, "").get(path)


def known_field(owner: object, path: DesignPath) -> FormField:
    """The field at a path that is known to exist."""
    field = field_of(owner, path)
    assert field is not None, f"{type(owner).__name__} has no field {path}"
    return field


def field_node(
    owner: object, name: str, base: DesignPath = (), *, is_committed: bool = False, is_wide: bool = False
) -> TextField | Check:
    """The node of a text, number or flag of an owner at `base`; `name` is that of an attribute, or "part.attribute"."""
    path = tuple(name.split("."))
    field = known_field(owner, path)
    value, here = field.read(owner), (*base, *path)
    if isinstance(value, bool):
        return Check(path=here, label=field.label, value=value, hint=field.hint, is_wide=is_wide)
    return TextField(
        path=here,
        label=field.label,
        value=value,
        hint=field.hint,
        help=field.help,
        is_code=not field.is_prose,
        is_long=name in ("doc", "text") and not isinstance(owner, Declaration | tuple),
        is_checked=field.is_checked,
        is_committed=is_committed,
        is_wide=is_wide,
    )


def other_nodes(
    owner: object, base: DesignPath = (), *, noun: str = "", is_committed: bool = False
) -> tuple[Node, ...]:
    """The fields of an owner at `base` that its form has not placed; `noun` is the name of its record in the format."""
    kind: Any = type(owner)
    wanted = (".".join(map(str, path)) for path in _other_fields(kind, noun))
    # Those of the project are in cards with two columns.
    return tuple(field_node(owner, name, base, is_committed=is_committed, is_wide=is_committed) for name in wanted)


_IN_NO_FORM = ("id", "alias", "component", "clock", "generated", "live", "xabsl_encoding")
"""Written by the editor, changed in another way, or edited in the file."""


@cache
def _other_fields(kind: type, noun: str) -> Mapping[DesignPath, FormField]:
    """The fields without an entry in `_FIELDS`, of all records or that with a name."""
    found: dict[DesignPath, FormField] = {}
    for record in (*DESIGN_RECORDS, *PROJECT_RECORDS):
        if kind in (record.model, *record.variants.values()) and noun in ("", record.name):
            for key in record.keys:
                path, field = tuple(key.model_field.split(".")), _derived_field(kind, record, key)
                if field is not None and path not in _FIELDS.get(kind, {}) and key.model_field not in _IN_NO_FORM:
                    found[path] = field
    return found


def _derived_field(kind: type, record: RecordSchema, key: KeySchema) -> FormField | None:
    """The field of a key by its type; None if no field can show it, or the class has no such field."""
    owner, _dot, name = key.model_field.rpartition(".")
    kind = record.nested[owner] if owner else kind
    if key.constant is not None or not hasattr(kind, name):
        return None
    word, about = field_word(kind, name), key.description.replace("`", "")
    label = word[:1].upper() + word[1:]
    match key.schema:
        case ScalarSchema(scalar_type=ScalarType.BOOLEAN):
            field = attribute(name, label, hint=about)
        case ScalarSchema(scalar_type=ScalarType.TEXT):
            field = replace(attribute(name, label), help=about, is_prose=True)
        case ScalarSchema(scalar_type=type_, choices=choices):
            make = _MAKERS.get(type_, attribute)
            field = _with_error(replace(make(name, label), help=about), " or ".join(choices) or type_, choices)
            if key.required:
                # What is derived from it would disappear while it is typed anew.
                field = replace(field, validate=lambda text: "" if text.strip() else texts.VALUE_MISSING)
        case ListSchema() if key.schema == NAMES:
            field = replace(names(name, label), help=about)
        case _:
            return None
    return part(owner, field) if owner else field


def _with_error(field: FormField, expected: str, choices: Sequence[str]) -> FormField:
    """The field with a message that names the valid values, which are choices if there are any."""

    def validate(value: Any) -> str:
        is_valid = not field.validate(value) and (not choices or value in ("", *choices))
        return "" if is_valid else texts.expected(expected)

    return replace(field, validate=validate)


_MAKERS: Mapping[ScalarType, Callable[[str, str], FormField]] = {ScalarType.COUNT: count, ScalarType.NUMBER: number}
