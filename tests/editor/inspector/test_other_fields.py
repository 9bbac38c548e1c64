"""Forms show keys for which no field is written, with fields that are derived from the format."""

from dataclasses import dataclass, field

import pytest

from vicode.editor.session.forms import fields as form_fields
from vicode.editor.session.forms.nodes import Check, TextField
from vicode.store.format_values import COUNT, FLAG, FREQUENCY, NAMES, POSITION, TEXT
from vicode.store.schema_types import KeySchema, RecordSchema, ScalarSchema, ScalarType

SIZES = ScalarSchema(scalar_type=ScalarType.NAME, choices=("small", "large"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Cover:
    """A part of a gadget."""

    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Gadget:
    """A record without a form."""

    id: str = ""
    is_blue: bool = False
    spare_parts: int | None = None
    pace: float | None = None
    size: str = ""
    colors: tuple[str, ...] = ()
    place: tuple[float, float] | None = None
    cover: Cover = field(default_factory=Cover)


GADGET = RecordSchema(
    name="gadget",
    description="a gadget",
    model=Gadget,
    nested={"cover": Cover},
    keys=(
        KeySchema("id", TEXT, "identifier"),
        KeySchema("is_blue", FLAG, "`true`: blue"),
        KeySchema("spare_parts", COUNT, "number of parts", keeps_empty=True),
        KeySchema("pace", FREQUENCY, "steps per second"),
        KeySchema("size", SIZES, "size"),
        KeySchema("colors", NAMES, "colors"),
        KeySchema("place", POSITION, "no text"),
        KeySchema("note", TEXT, "note on its cover", field="cover.note"),
    ),
)


@pytest.fixture(autouse=True)
def _format_with_gadgets(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(form_fields, "DESIGN_RECORDS", (GADGET,))


def test_fields_follow_the_types_of_their_keys() -> None:
    nodes = form_fields.other_nodes(Gadget(spare_parts=2), ("gadgets", "n1"))
    assert nodes[0] == Check(path=("gadgets", "n1", "is_blue"), label="Is blue", value=False, hint="true: blue")
    texts = [(node.path[2:], node.label, node.value) for node in nodes if isinstance(node, TextField)]
    assert texts == [
        (("spare_parts",), "Spare parts", "2"),
        (("pace",), "Pace", ""),
        (("size",), "Size", ""),
        (("colors",), "Colors", ""),
        (("cover", "note"), "Note", ""),
    ]
    assert form_fields.other_nodes(Gadget(), noun="component") == ()
    # Those of project.yaml take the whole width of their cards.
    shared = form_fields.other_nodes(Gadget(spare_parts=2), is_committed=True)
    assert {getattr(node, "is_wide", True) for node in shared} == {True}


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("spare_parts", "3", 3),
        ("pace", "2.5", 2.5),
        ("size", "large", "large"),
        ("colors", "red, blue", ("red", "blue")),
    ],
)
def test_valid_texts_are_written(name: str, text: str, value: object) -> None:
    derived = form_fields.known_field(Gadget(), (name,))
    assert derived.validate(text) == derived.validate("") == ""
    assert getattr(derived.write(Gadget(), text), name) == value
    assert derived.read(derived.write(Gadget(), text)) == text


def test_fields_of_parts_are_written() -> None:
    assert form_fields.known_field(Gadget(), ("cover", "note")).write(Gadget(), "torn").cover == Cover(note="torn")


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("spare_parts", "-1", "integer, 0 or greater"),
        ("pace", "fast", "number greater than 0"),
        ("size", "huge", "small or large"),
    ],
)
def test_other_texts_are_refused(name: str, text: str, expected: str) -> None:
    assert form_fields.known_field(Gadget(), (name,)).validate(text).endswith(f"expected: {expected}")
