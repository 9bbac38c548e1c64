"""Forms for the parameters, outputs and variables of a design."""

from collections.abc import Callable
from dataclasses import replace

from vicode.editor.panels.fields import (
    Attribute,
)
from vicode.editor.panels.form import Form, Rows
from vicode.editor.panels.widgets import add_button
from vicode.editor.session import number_text
from vicode.editor.session.forms.declaration_form import format_arguments
from vicode.editor.session.item_paths import TrackedItem
from vicode.model.design import Declaration
from vicode.model.edits import unique_name

ChangeDeclaration = Callable[[Declaration], Declaration]

TYPE = Attribute(label="Type", name="type", parse=str.strip)
UNIT = Attribute(label="Unit", name="unit", parse=str.strip)
RANGE = Attribute(
    label="Range",
    name="range",
    hint="minimum, maximum: 0, 9000",
    format=number_text.format_range,
    parse=number_text.parse_range,
    validate=number_text.validate_range,
)
TUNABLE = Attribute(label="Tune in running robots", name="tunable")


def describe_declaration(declaration: Declaration | None) -> str:
    """Describe type, unit, range, value and arguments, then the description."""
    if declaration is None:
        return ""
    arguments, range_ = declaration.arguments, declaration.range
    parts = (
        format_arguments(arguments) if arguments is not None else "",
        declaration.type,
        declaration.unit,
        f"{number_text.format_number(range_[0])} to {number_text.format_number(range_[1])}" if range_ else "",
        f"= {declaration.initial}" if declaration.initial else "",
    )
    summary = ", ".join(part for part in parts if part)
    return ": ".join(part for part in (summary, declaration.doc) if part)


def argument_buttons(form: Form, output: TrackedItem, edit: Callable[[ChangeDeclaration], None]) -> None:
    """Build the buttons that add an argument, and remove all of them; `edit` changes the output."""

    def list_buttons() -> list[tuple[str, bool]]:
        declaration = output.get()
        if declaration is None:
            return []
        buttons = [(declaration.name, True)]
        return buttons if declaration.arguments is None else [*buttons, (declaration.name, False)]

    def build(_row: Form, key: tuple[str, bool]) -> None:
        name, adds = key
        if adds:
            add_button("Argument", f"Add Argument to {name}", lambda: edit(_add_argument))
        else:
            label = f"Remove arguments of {name}"
            add_button("Remove arguments", label, lambda: edit(_remove_arguments), icon="close")

    Rows(form, list_buttons, build)


def _add_argument(output: Declaration) -> Declaration:
    """Add an argument to an output."""
    known = output.arguments or ()
    name = unique_name("argument", {each.name for each in known})
    return replace(output, arguments=(*known, Declaration(name=name, type="float")))


def _remove_arguments(output: Declaration) -> Declaration:
    """Turn an output with arguments into a value."""
    return replace(output, arguments=None)
