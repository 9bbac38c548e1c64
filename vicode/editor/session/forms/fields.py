"""The values that forms show and change: how each is read from its owner, validated and written.

A key of the format needs no entry: without one, its field is derived from its schema and stands below the others.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from vicode.editor.session import texts
from vicode.editor.session.forms.nodes import Check, Node, TextField
from vicode.editor.session.forms.pairs import find_error, find_lost_pairs, format_pairs, parse_pairs
from vicode.editor.session.gestures import number_text
from vicode.findings import DesignPath
from vicode.languages import LANGUAGES
from vicode.model.design import (
    STATE_COLORS,
    Assign,
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Declaration,
    Design,
    DiagramFrame,
    DiagramNote,
    RunCode,
    State,
    Stay,
    Transition,
)
from vicode.model.names import is_valid_name
from vicode.model.project import Agent, Enumeration, Interface, Project
from vicode.model.words import field_word
from vicode.services import messages
from vicode.store.format import DESIGN_RECORDS, NAMES
from vicode.store.project_format import PROJECT_RECORDS
from vicode.store.schema_types import KeySchema, ListSchema, RecordSchema, ScalarSchema, ScalarType


def _accept(_value: Any) -> str:
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class FormField:
    """A value of an owner (a state, a transition), as a form shows it: a text, a bool, or several texts.

    `write` returns the changed owner; `validate` returns an error message, or "" for a value that can be written.
    `find_loss` says why the value of an owner cannot be edited without a loss, or "". Texts for humans are `is_prose`.
    """

    label: str
    read: Callable[[Any], Any]
    write: Callable[[Any, Any], Any]
    hint: str = ""
    help: str = ""
    is_prose: bool = False
    validate: Callable[[Any], str] = _accept
    find_loss: Callable[[Any], str] = lambda _owner: ""


def attribute(name: str, label: str, *, hint: str = "", parse: Callable[[Any], Any] = lambda value: value) -> FormField:
    """The field of an attribute that has the type of the field."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: getattr(owner, name),
        write=lambda owner, value: replace(owner, **{name: parse(value)}),
    )


def part(name: str, field: FormField) -> FormField:
    """The field of a part of the owner, such as the guard of a transition."""
    return replace(
        field,
        read=lambda owner: field.read(getattr(owner, name)),
        write=lambda owner, value: replace(owner, **{name: field.write(getattr(owner, name), value)}),
    )


def code(name: str, language: str, label: str, hint: str = "") -> FormField:
    """The field of a code in one language."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: (written.in_language(language) if (written := getattr(owner, name)) else "") or "",
        write=lambda owner, text: replace(owner, **{name: replace_text(getattr(owner, name), language, text)}),
    )


def replace_text(written: Code | None, language: str, text: str) -> Code:
    """Replace the text in one language; texts in other languages stay. Without any text, the Python text is empty."""
    # A YAML block of several lines ends with a newline; a single line does not.
    ended = text + "\n" if "\n" in text and not text.endswith("\n") else text
    texts = dict(written.texts if written else ())
    if text.strip():
        python = {"python": ended} if language == "python" else {}
        return Code(texts=tuple({**python, **texts, language: ended}.items()))
    texts.pop(language, None)
    return Code(texts=tuple((texts or {"python": text if language == "python" else ""}).items()))


def count(name: str, label: str, hint: str = "") -> FormField:
    """The field of a number of robots, or None."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: number_text.format_number(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: number_text.parse_count(text)}),
        validate=number_text.validate_count,
    )


def number(name: str, label: str, hint: str = "") -> FormField:
    """The field of a number above 0, or None."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: number_text.format_number(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: number_text.parse_frequency(text)}),
        validate=number_text.validate_frequency,
    )


def names(name: str, label: str, hint: str = "") -> FormField:
    """The field of several names, separated by commas or blanks."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: ", ".join(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: tuple(text.replace(",", " ").split())}),
    )


def pairs(name: str, label: str, *, is_required: bool = False) -> FormField:
    """The field of assignments or arguments: lines `name = expression`."""

    def validate(text: str) -> str:
        is_missing = is_required and not text.strip()
        return "write a line such as count = 0, or remove this action" if is_missing else find_error(text)

    return FormField(
        label=label,
        read=lambda owner: format_pairs(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: parse_pairs(text)}),
        validate=validate,
        find_loss=lambda owner: find_lost_pairs(getattr(owner, name)),
    )


FROM_VALUE = "from value"
"""The type of a declaration without one: that of its value."""
DESCRIPTION = replace(attribute("doc", "Description"), is_prose=True)
_PREDICATE = "Predicate (body of a function that returns a bool)"
_GUARD: Mapping[DesignPath, FormField] = {
    ("guard", "when"): part("guard", attribute("when", "When", hint="always")),
    ("guard", "after"): part("guard", attribute("after", "After")),
    **{("guard", "code", language): part("guard", code("code", language, _PREDICATE)) for language in LANGUAGES},
    ("doc",): DESCRIPTION,
    ("disabled",): attribute("disabled", "Disabled (never tested)"),
}
_XABSL_NAME = attribute("xabsl_name", "Name in XABSL", parse=str.strip)
_COLOR = replace(
    attribute("color", "Color"),
    validate=lambda value: "" if value in ("", *STATE_COLORS) else texts.INVALID_REQUEST,
)
_STATE: Mapping[DesignPath, FormField] = {
    ("name",): attribute("name", "State"),
    ("doc",): DESCRIPTION,
    ("final",): attribute("final", "Final", hint="The component is done in this state"),
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
_FREQUENCY = number("frequency_hz", "Frequency, Hz", "every step")
_DECLARATION: Mapping[DesignPath, FormField] = {
    ("type",): FormField(
        label="Type",
        read=lambda owner: owner.type or FROM_VALUE,
        write=lambda owner, text: replace(owner, type="" if text == FROM_VALUE else text.strip()),
    ),
    ("initial",): attribute("initial", "Value", parse=str.strip),
    ("unit",): attribute("unit", "Unit", parse=str.strip),
    ("doc",): DESCRIPTION,
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
    ("doc",): DESCRIPTION,
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
    ("doc",): replace(DESCRIPTION, label="Project description"),
    ("languages",): names("languages", "Languages", "python"),
    ("world",): attribute("world", "World", hint="module:Class"),
}
_SHARED: Mapping[DesignPath, FormField] = {
    ("doc",): DESCRIPTION,
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
    CommonSection: {("doc",): replace(DESCRIPTION, label="Description (all states)")},
    Design: _DESIGN,
    Project: _PROJECT,
    Interface: _INTERFACE,
    Enumeration: _ENUMERATION,
    Agent: {("root",): attribute("root", "Root"), **_SHARED},
    tuple: {("doc",): _MEANING},
    Declaration: _DECLARATION,
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
        is_checked=field.validate is not _accept,
        is_committed=is_committed,
        is_wide=is_wide,
    )


def other_nodes(
    owner: object, base: DesignPath = (), *, noun: str = "", is_committed: bool = False
) -> tuple[Node, ...]:
    """The fields of an owner at `base` that its form has not placed; `noun` is the name of its record in the format."""
    kind: Any = type(owner)
    wanted = (".".join(map(str, path)) for path in _other_fields(kind, noun))
    return tuple(field_node(owner, name, base, is_committed=is_committed) for name in wanted)


_IN_NO_FORM = ("id", "alias", "component", "clock", "generated", "xabsl_encoding")
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
