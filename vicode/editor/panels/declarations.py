"""Forms for the parameters, outputs and variables of a design."""

from collections.abc import Callable
from dataclasses import replace

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.fields import (
    XABSL_NAME,
    Attribute,
    FieldBinding,
    FieldKind,
    attribute_binding,
    checkbox_field,
    choice_field,
    text_field,
)
from vicode.editor.panels.form import Form, ItemRows, Rows
from vicode.editor.panels.name_field import name_field, rename_declaration
from vicode.editor.panels.widgets import add_button, icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.interface_edits import type_names
from vicode.editor.session.item_paths import TrackedItem, item_at
from vicode.editor.session.rename_symbol import validate_identifier
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.edits import set_declarations, unique_name
from vicode.model.rename import SymbolRef

ChangeDeclaration = Callable[[Declaration], Declaration]

SECTIONS = (
    ("parameters", "Parameters", "values set by the states that modulate this component"),
    ("outputs", "Outputs", "values other components can read"),
    ("variables", "Variables", "internal values"),
)

_FROM_VALUE = "from value"
_NAME = Attribute(label="Name", name="name", validate=validate_identifier)
TYPE = Attribute(label="Type", name="type", parse=str.strip)
UNIT = Attribute(label="Unit", name="unit", parse=str.strip)
_DOC = Attribute(label="Description", name="doc", kind=FieldKind.TEXT)
RANGE = Attribute(
    label="Range",
    name="range",
    hint="minimum, maximum: 0, 9000",
    format=number_text.format_range,
    parse=number_text.parse_range,
    validate=number_text.validate_range,
)
TUNABLE = Attribute(label="Tune in running robots", name="tunable")
_DEFAULT = Attribute(label="Default", name="initial", key="default", parse=str.strip)
_INITIAL = Attribute(label="Initial", name="initial", parse=str.strip)


def declarations_form(form: Form, section: str) -> None:
    """Build the forms of a section."""
    ItemRows(form, form.item(), section, _declaration)
    with ui.row().classes("adders"):
        add_button("Add", f"Add {section.removesuffix('s')}", _adder(form.context, section))


def _declaration(form: Form, item: TrackedItem) -> None:
    context = form.context
    path = item.path or ()
    kind = str(path[-2]).removesuffix("s")
    value = _INITIAL if kind in ("output", "variable") else _DEFAULT
    with ui.element("div").classes("declaration").props("role=group") as group:

        def show_name(name: str) -> None:
            for element, label in ((group, f"{kind} {name}"), (remove, f"Remove {name}")):
                element.props["aria-label"] = label
                element.update()

        def rename(old: str, new: str) -> str:
            return rename_declaration(context, _symbol_ref(context.design, item, old), new)

        name_field(form, replace(attribute_binding(item, _NAME), get_path=lambda: named_path(item)), rename)
        _type_field(form, item)
        for attribute in (value, UNIT, _DOC):
            _field(form, item, attribute)
        remove = icon_button("close", "Remove", _remover(context, item, kind))
        form.watch(lambda: item.get().name if item.path else "", show_name)

        def more() -> None:
            for attribute in (RANGE, XABSL_NAME):
                _field(form, item, attribute)
            if kind == "output":
                _arguments(form, item)
            if kind == "parameter":
                checkbox_field(form, _binding(item, TUNABLE))

        key = " ".join(str(step) for step in path)
        section = collapsible_section(form, key, lambda: "More", lambda: declaration_caption(item.get(), kind), more)
        section.classes("declaration-more")


def _type_field(form: Form, item: TrackedItem) -> None:
    """Build the choice of a type; a declaration without one has that of its value."""
    binding = _binding(item, TYPE)
    shown = replace(
        binding,
        read=lambda design: binding.read(design) or _FROM_VALUE,
        write=lambda design, value: binding.write(design, "" if value == _FROM_VALUE else value),
    )
    choice_field(form, shown, lambda _design: [_FROM_VALUE, *type_names(form.context.workspace.project)])


def _field(form: Form, item: TrackedItem, attribute: Attribute) -> None:
    text_field(form, _binding(item, attribute), monospace=attribute.kind is FieldKind.CODE)


def _binding(item: TrackedItem, attribute: Attribute) -> FieldBinding:
    """Bind an attribute; the path of a declaration has names instead of indices."""
    binding = attribute_binding(item, attribute)
    return replace(binding, get_path=lambda: (*named_path(item), attribute.key or attribute.name))


def named_path(item: TrackedItem) -> DesignPath:
    """The path of a declaration with names instead of indices, as in the file."""
    path = item.path or ()
    ends = range(2, len(path) + 1, 2)
    return tuple(step for end in ends for step in (path[end - 2], item_at(item.get_root(), path[:end]).name))


def declaration_caption(declaration: Declaration | None, kind: str) -> str:
    """Summarize the section "More": its values, else the available fields."""
    if declaration is None:
        return ""
    parts = []
    if declaration.range is not None:
        low, high = declaration.range
        parts.append(f"range {number_text.format_number(low)} to {number_text.format_number(high)}")
    if declaration.arguments is not None:
        parts.append(format_arguments(declaration.arguments))
    if declaration.xabsl_name:
        parts.append(f"{declaration.xabsl_name} in XABSL")
    return "; ".join(parts) or ("range, XABSL, arguments" if kind == "output" else "range, XABSL")


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


def format_arguments(arguments: tuple[Declaration, ...]) -> str:
    return f"arguments {', '.join(argument.name for argument in arguments)}" if arguments else "no arguments"


def _arguments(form: Form, output: TrackedItem) -> None:
    """Build the forms of the arguments. An output with arguments is a function, without a value."""

    def edit(change: ChangeDeclaration) -> None:
        form.context.edit("change arguments", lambda design: output.update(design, change))

    ItemRows(form, output, "arguments", _declaration)
    with ui.row().classes("adders"):
        argument_buttons(form, output, edit)


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


def _adder(context: WindowContext, section: str) -> Callable[[], None]:
    def change(design: Design) -> Design:
        name = unique_name(section.removesuffix("s"), {each.name for _section, each in design.declarations()})
        return set_declarations(design, section, (*getattr(design, section), Declaration(name=name, initial="0")))

    return lambda: context.edit(f"add {section.removesuffix('s')}", change)


def _remover(context: WindowContext, item: TrackedItem, kind: str) -> Callable[[], None]:
    return lambda: context.edit(f"remove {kind}", item.remove)


def _symbol_ref(design: Design, item: TrackedItem, name: str) -> SymbolRef:
    """The symbol of a declaration for a rename."""
    section, *outer = named_path(item)[:-1]
    if not outer:
        return SymbolRef(component=design.component, section=str(section), name=name)
    return SymbolRef(component=design.component, section="arguments", name=name, owner=str(outer[0]))
