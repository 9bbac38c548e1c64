"""Forms for the parameters, outputs and variables of a design."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.fields import Field, FieldBinding, text_field
from vicode.editor.panels.name_field import name_field, rename_declaration
from vicode.editor.panels.widgets import add_button, icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.rename_symbol import validate_identifier
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.edits import set_declarations, unique_name
from vicode.model.rename import SymbolRef

SECTIONS = (
    ("parameters", "Parameters", "inputs other components can set"),
    ("outputs", "Outputs", "values other components can read"),
    ("variables", "Variables", "internal values"),
)


def declarations_form(context: WindowContext, section: str, fields: list[Field]) -> None:
    """Build the forms of a section and append their fields; fields in sections are appended when these open."""
    for index, declaration in enumerate(getattr(context.design, section)):
        _form(context, DeclarationRef(section=section, index=index), declaration, fields)
    with ui.row().classes("adders"):
        add_button("Add", f"Add {section.removesuffix('s')}", _adder(context, section))


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationRef:
    """A declaration by its index, which survives renames; with `argument`, one of its arguments."""

    section: str
    index: int
    argument: int | None = None

    @property
    def kind(self) -> str:
        """The kind as a word: "parameter", "output", "variable" or "argument"."""
        return "argument" if self.argument is not None else self.section.removesuffix("s")

    def find(self, design: Design) -> Declaration | None:
        outer = _at(getattr(design, self.section), self.index)
        return outer if self.argument is None or outer is None else _at(outer.arguments or (), self.argument)

    def update(self, design: Design, change: Callable[[Declaration], Declaration]) -> Design:
        return _updated(
            design, self, lambda outer: change(outer) if self.argument is None else self._update_argument(outer, change)
        )

    def _update_argument(self, outer: Declaration, change: Callable[[Declaration], Declaration]) -> Declaration:
        arguments = enumerate(outer.arguments or ())
        return replace(outer, arguments=tuple(change(each) if at == self.argument else each for at, each in arguments))

    def path(self, design: Design, *more: str) -> DesignPath:
        outer = _at(getattr(design, self.section), self.index)
        inner = self.find(design)
        if outer is None or inner is None:
            return (self.section,)
        middle = ("arguments", inner.name) if self.argument is not None else ()
        return (self.section, outer.name, *middle, *more)

    def symbol_ref(self, design: Design, name: str) -> SymbolRef:
        outer = _at(getattr(design, self.section), self.index)
        if self.argument is None or outer is None:
            return SymbolRef(component=design.component, section=self.section, name=name)
        return SymbolRef(component=design.component, section="arguments", name=name, owner=outer.name)


def _at(declarations: tuple[Declaration, ...], index: int) -> Declaration | None:
    return declarations[index] if index < len(declarations) else None


def _updated(design: Design, ref: DeclarationRef, change: Callable[[Declaration], Declaration]) -> Design:
    declarations = enumerate(getattr(design, ref.section))
    return set_declarations(
        design, ref.section, tuple(change(each) if at == ref.index else each for at, each in declarations)
    )


def _form(context: WindowContext, ref: DeclarationRef, declaration: Declaration, fields: list[Field]) -> None:
    with ui.element("div").classes("declaration").props("role=group") as group:

        def rename(old: str, new: str) -> str:
            return rename_declaration(context, ref.symbol_ref(context.design, old), new)

        def show_name(name: str) -> None:
            group.props["aria-label"] = f"{ref.kind} {name}"
            group.update()
            for button in remove_buttons:
                button.props["aria-label"] = f"Remove {name}"
                button.update()

        remove_buttons: list[ui.button] = []
        fields.append(name_field(context, _name_binding(ref), rename, show_name))
        value = "Initial" if ref.kind in ("output", "variable") else "Default"
        for label, attribute in (("Type", "type"), (value, "initial"), ("Unit", "unit")):
            fields.append(text_field(context, _attribute_binding(ref, label, attribute), monospace=True))
        fields.append(text_field(context, _attribute_binding(ref, "Description", "doc")))
        remove_buttons.append(icon_button("close", f"Remove {declaration.name}", _remover(context, ref)))

        def more() -> None:
            fields.append(text_field(context, _range_binding(ref), monospace=True))
            fields.append(text_field(context, _attribute_binding(ref, "Name in XABSL", "xabsl_name"), monospace=True))
            if ref.kind == "output":
                _arguments(context, ref, fields)

        key = f"{ref.section} {ref.index} {ref.argument}"
        collapsible_section(context, key, "More", declaration_caption(declaration, ref.kind), more).classes(
            "declaration-more"
        )


def declaration_caption(declaration: Declaration, kind: str) -> str:
    """Summarize the section "More": its values, else the available fields."""
    parts = []
    if declaration.range is not None:
        low, high = declaration.range
        parts.append(f"range {number_text.format_number(low)} to {number_text.format_number(high)}")
    if declaration.arguments is not None:
        parts.append(format_arguments(declaration.arguments))
    if declaration.xabsl_name:
        parts.append(f"{declaration.xabsl_name} in XABSL")
    return "; ".join(parts) or ("range, XABSL, arguments" if kind == "output" else "range, XABSL")


def format_arguments(arguments: tuple[Declaration, ...]) -> str:
    return f"arguments {', '.join(argument.name for argument in arguments)}" if arguments else "no arguments"


def _arguments(context: WindowContext, ref: DeclarationRef, fields: list[Field]) -> None:
    """Build the forms of the arguments. An output with arguments is a function, without a value."""
    output = ref.find(context.design)
    if output is None:
        return
    for number, argument in enumerate(output.arguments or ()):
        _form(context, replace(ref, argument=number), argument, fields)
    with ui.row().classes("adders"):
        name = f"Add Argument to {output.name}"
        add_button("Argument", name, _changer(context, ref, add_argument))
        if output.arguments is not None:
            add_button(
                "Remove arguments",
                f"Remove arguments of {output.name}",
                _changer(context, ref, remove_arguments),
                icon="close",
            )


def add_argument(output: Declaration) -> Declaration:
    known = output.arguments or ()
    name = unique_name("argument", {each.name for each in known})
    return replace(output, arguments=(*known, Declaration(name=name, type="float")))


def remove_arguments(output: Declaration) -> Declaration:
    return replace(output, arguments=None)


def _changer(
    context: WindowContext, ref: DeclarationRef, change: Callable[[Declaration], Declaration]
) -> Callable[[], None]:
    return lambda: context.edit("change arguments", lambda design: _updated(design, ref, change))


def _name_binding(ref: DeclarationRef) -> FieldBinding:
    def read(design: Design) -> str:
        declaration = ref.find(design)
        return declaration.name if declaration else ""

    def write(design: Design, _value: str) -> Design:
        return design

    return FieldBinding(
        label="Name", read=read, write=write, get_path=ref.path, validate=lambda text: validate_identifier(str(text))
    )


def _attribute_binding(ref: DeclarationRef, label: str, attribute: str) -> FieldBinding:
    def read(design: Design) -> str:
        declaration = ref.find(design)
        return str(getattr(declaration, attribute)) if declaration else ""

    def write(design: Design, value: str) -> Design:
        text = value if attribute == "doc" else value.strip()
        return ref.update(design, lambda old: _with(old, attribute, text))

    key = {"initial": "default" if ref.kind in ("parameter", "argument") else "initial"}.get(attribute, attribute)
    return FieldBinding(label=label, read=read, write=write, get_path=lambda design: ref.path(design, key))


def _with(declaration: Declaration, attribute: str, value: Any) -> Declaration:
    return replace(declaration, **{attribute: value})


def _range_binding(ref: DeclarationRef) -> FieldBinding:
    def read(design: Design) -> str:
        declaration = ref.find(design)
        return number_text.format_range(declaration.range) if declaration else ""

    return FieldBinding(
        label="Range",
        hint="minimum, maximum: 0, 9000",
        read=read,
        write=lambda design, text: ref.update(design, lambda old: replace(old, range=number_text.parse_range(text))),
        validate=number_text.validate_range,
        get_path=lambda design: ref.path(design, "range"),
    )


def _adder(context: WindowContext, section: str) -> Callable[[], None]:
    def change(design: Design) -> Design:
        name = unique_name(section.removesuffix("s"), {each.name for _section, each in design.declarations()})
        return set_declarations(design, section, (*getattr(design, section), Declaration(name=name, initial="0")))

    return lambda: context.edit(f"add {section.removesuffix('s')}", change)


def _remover(context: WindowContext, ref: DeclarationRef) -> Callable[[], None]:
    def change(design: Design) -> Design:
        if ref.argument is not None:
            return _updated(design, ref, _without_argument)
        remaining = tuple(each for at, each in enumerate(getattr(design, ref.section)) if at != ref.index)
        return set_declarations(design, ref.section, remaining)

    def _without_argument(output: Declaration) -> Declaration:
        remaining = tuple(each for at, each in enumerate(output.arguments or ()) if at != ref.argument)
        return replace(output, arguments=remaining)

    return lambda: context.edit(f"remove {ref.kind}", change)
