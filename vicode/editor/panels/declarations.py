"""What a design declares: parameters, outputs and variables, each with its type, value, unit, doc and more."""

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
    ("parameters", "Parameters", "what others may modulate in it"),
    ("outputs", "Outputs", "what others may read from it"),
    ("variables", "Variables", "its own memory"),
)


def declarations_form(context: WindowContext, section: str, fields: list[Field]) -> None:
    """Build the forms of all declarations of a section; their fields are added, those in folds when these open."""
    for index, declaration in enumerate(getattr(context.design, section)):
        _form(context, DeclarationRef(section=section, index=index), declaration, fields)
    with ui.row().classes("adders"):
        add_button("Declare", f"Declare: one more of the {section}", _adder(context, section))


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationRef:
    """A declaration by its number, which stays when its name changes; with `argument` one of its arguments."""

    section: str
    index: int
    argument: int | None = None

    @property
    def kind(self) -> str:
        """What it is, in a word."""
        return "argument" if self.argument is not None else self.section.removesuffix("s")

    def find(self, design: Design) -> Declaration | None:
        """The declaration; None when it is gone."""
        outer = _at(getattr(design, self.section), self.index)
        return outer if self.argument is None or outer is None else _at(outer.arguments or (), self.argument)

    def update(self, design: Design, change: Callable[[Declaration], Declaration]) -> Design:
        """The design with another declaration there."""
        return _updated(
            design, self, lambda outer: change(outer) if self.argument is None else self._update_argument(outer, change)
        )

    def _update_argument(self, outer: Declaration, change: Callable[[Declaration], Declaration]) -> Declaration:
        arguments = enumerate(outer.arguments or ())
        return replace(outer, arguments=tuple(change(each) if at == self.argument else each for at, each in arguments))

    def path(self, design: Design, *more: str) -> DesignPath:
        """Where it stands in the file."""
        outer = _at(getattr(design, self.section), self.index)
        inner = self.find(design)
        if outer is None or inner is None:
            return (self.section,)
        middle = ("arguments", inner.name) if self.argument is not None else ()
        return (self.section, outer.name, *middle, *more)

    def symbol_ref(self, design: Design, name: str) -> SymbolRef:
        """It as a thing that can be renamed."""
        outer = _at(getattr(design, self.section), self.index)
        if self.argument is None or outer is None:
            return SymbolRef(component=design.component, section=self.section, name=name)
        return SymbolRef(component=design.component, section="arguments", name=name, owner=outer.name)


def _at(declarations: tuple[Declaration, ...], index: int) -> Declaration | None:
    return declarations[index] if index < len(declarations) else None


def _updated(design: Design, spot: DeclarationRef, change: Callable[[Declaration], Declaration]) -> Design:
    declarations = enumerate(getattr(design, spot.section))
    return set_declarations(
        design, spot.section, tuple(change(each) if at == spot.index else each for at, each in declarations)
    )


def _form(context: WindowContext, spot: DeclarationRef, declaration: Declaration, fields: list[Field]) -> None:
    with ui.element("div").classes("declaration").props("role=group") as whole:

        def take(old: str, new: str) -> str:
            return rename_declaration(context, spot.symbol_ref(context.design, old), new)

        def call_it(name: str) -> None:
            whole.props["aria-label"] = f"{spot.kind} {name}"
            whole.update()
            for button in removing:
                button.props["aria-label"] = f"Remove {name}"
                button.update()

        removing: list[ui.button] = []
        fields.append(name_field(context, _name_binding(spot), take, call_it))
        value = "Initial" if spot.kind in ("output", "variable") else "Default"
        for label, attribute in (("Type", "type"), (value, "initial"), ("Unit", "unit")):
            fields.append(text_field(context, _attribute_binding(spot, label, attribute), monospace=True))
        fields.append(text_field(context, _attribute_binding(spot, "Doc", "doc")))
        removing.append(icon_button("close", f"Remove {declaration.name}", _remover(context, spot)))

        def more() -> None:
            fields.append(text_field(context, _range_binding(spot), monospace=True))
            fields.append(text_field(context, _attribute_binding(spot, "Name in XABSL", "xabsl_name"), monospace=True))
            if spot.kind == "output":
                _arguments(context, spot, fields)

        key = f"{spot.section} {spot.index} {spot.argument}"
        collapsible_section(context, key, "More", declaration_caption(declaration, spot.kind), more).classes(
            "declaration-more"
        )


def declaration_caption(declaration: Declaration, kind: str) -> str:
    """What stands in a fold that is closed, or may."""
    said = []
    if declaration.range is not None:
        said.append(
            f"from {number_text.format_number(declaration.range[0])} to {number_text.format_number(declaration.range[1])}"
        )
    if declaration.arguments is not None:
        said.append(f"takes {', '.join(each.name for each in declaration.arguments) or 'nothing'}")
    if declaration.xabsl_name:
        said.append(f"{declaration.xabsl_name} in XABSL")
    return "; ".join(said) or ("range, XABSL, arguments" if kind == "output" else "range, XABSL")


def _arguments(context: WindowContext, spot: DeclarationRef, fields: list[Field]) -> None:
    """What a function takes; an output without arguments is a value."""
    output = spot.find(context.design)
    if output is None:
        return
    for number, argument in enumerate(output.arguments or ()):
        _form(context, replace(spot, argument=number), argument, fields)
    with ui.row().classes("adders"):
        name = f"Argument: {output.name} is a function of one more"
        add_button("Argument", name, _changer(context, spot, add_argument))
        if output.arguments is not None:
            add_button(
                "No function",
                "No function: it is a value again",
                _changer(context, spot, remove_arguments),
                icon="close",
            )


def add_argument(output: Declaration) -> Declaration:
    """The output as a function of one more argument."""
    known = output.arguments or ()
    name = unique_name("argument", {each.name for each in known})
    return replace(output, arguments=(*known, Declaration(name=name, type="float")))


def remove_arguments(output: Declaration) -> Declaration:
    """The output as a value."""
    return replace(output, arguments=None)


def _changer(
    context: WindowContext, spot: DeclarationRef, change: Callable[[Declaration], Declaration]
) -> Callable[[], None]:
    return lambda: context.edit("change arguments", lambda design: _updated(design, spot, change))


def _name_binding(spot: DeclarationRef) -> FieldBinding:
    def read(design: Design) -> str:
        found = spot.find(design)
        return found.name if found else ""

    def write(design: Design, _value: str) -> Design:
        return design

    return FieldBinding(
        label="Name", read=read, write=write, get_path=spot.path, validate=lambda text: validate_identifier(str(text))
    )


def _attribute_binding(spot: DeclarationRef, label: str, attribute: str) -> FieldBinding:
    def read(design: Design) -> str:
        found = spot.find(design)
        return str(getattr(found, attribute)) if found else ""

    def write(design: Design, value: str) -> Design:
        text = value if attribute == "doc" else value.strip()
        return spot.update(design, lambda old: _with(old, attribute, text))

    key = {"initial": "default" if spot.kind in ("parameter", "argument") else "initial"}.get(attribute, attribute)
    return FieldBinding(label=label, read=read, write=write, get_path=lambda design: spot.path(design, key))


def _with(declaration: Declaration, attribute: str, value: Any) -> Declaration:
    return replace(declaration, **{attribute: value})


def _range_binding(spot: DeclarationRef) -> FieldBinding:
    def read(design: Design) -> str:
        found = spot.find(design)
        return number_text.format_range(found.range) if found else ""

    return FieldBinding(
        label="Range",
        hint="lowest, highest: 0, 9000",
        read=read,
        write=lambda design, text: spot.update(design, lambda old: replace(old, range=number_text.parse_range(text))),
        validate=number_text.validate_range,
        get_path=lambda design: spot.path(design, "range"),
    )


def _adder(context: WindowContext, section: str) -> Callable[[], None]:
    def change(design: Design) -> Design:
        name = unique_name(section.removesuffix("s"), {each.name for _section, each in design.declarations()})
        return set_declarations(design, section, (*getattr(design, section), Declaration(name=name, initial="0")))

    return lambda: context.edit("declare", change)


def _remover(context: WindowContext, spot: DeclarationRef) -> Callable[[], None]:
    def change(design: Design) -> Design:
        if spot.argument is not None:
            return _updated(design, spot, _without_argument)
        rest = tuple(each for at, each in enumerate(getattr(design, spot.section)) if at != spot.index)
        return set_declarations(design, spot.section, rest)

    def _without_argument(output: Declaration) -> Declaration:
        rest = tuple(each for at, each in enumerate(output.arguments or ()) if at != spot.argument)
        return replace(output, arguments=rest)

    return lambda: context.edit(f"remove {spot.kind}" if spot.argument is not None else "remove declaration", change)
