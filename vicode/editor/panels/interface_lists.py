"""The lists of inputs and commands of a design, with forms to add them to project.yaml and the design."""

from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.form import Form, ItemRows, Rows
from vicode.editor.panels.project.component_forms import declaration_adder, declaration_row
from vicode.editor.panels.project.declaration_forms import show_write_error
from vicode.editor.panels.project.project_fields import project_node, write_design_and_project
from vicode.editor.panels.widgets import add_button, heading
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.interface_edits import InterfaceEdit, add_command, add_input, type_names
from vicode.editor.view import ItemRef
from vicode.model.design import Declaration
from vicode.model.project import MISSING


@dataclass(frozen=True, slots=True, kw_only=True)
class _UsedInterface:
    """A used component in the list of a section, outputs or parameters."""

    alias: str
    section: str
    index: int | None = None
    """The index in project.yaml; None for a design."""
    names: tuple[str, ...] = ()
    """The declarations of a design, which has no form here."""
    is_implemented: bool = True


def inputs_list(form: Form) -> None:
    """Build the list of the outputs of used components, which expressions of the design can read."""
    heading("Inputs", hint="values that its guards can read")
    Rows(form, lambda: _list_uses(form.context, "outputs"), _build_use)
    _adder(form, "input", "bool")


def commands_list(form: Form) -> None:
    """Build the list of the used components with parameters, which the design calls or modulates."""
    heading("Commands", hint="what its states can trigger, such as motions")
    Rows(form, lambda: _list_uses(form.context, "parameters"), _build_use)
    _adder(form, "command")


def _list_uses(context: WindowContext, section: str) -> list[_UsedInterface]:
    """The used components that belong to a list: a component with neither outputs nor parameters is a command."""
    project = context.workspace.project
    indices = {each.component: index for index, each in reversed(list(enumerate(project.components)))}
    found = []
    for use in context.design.uses:
        interface = project.interface(use.component)
        if interface is None:
            continue
        is_plain = section == "parameters" and not interface.readable
        declarations: tuple[Declaration, ...] = getattr(interface, section)
        if declarations or is_plain:
            index = indices.get(use.component) if project.design(use.component) is None else None
            names = tuple(each.name for each in declarations) if index is None else ()
            found.append(
                _UsedInterface(
                    alias=use.alias,
                    section=section,
                    index=index,
                    names=names,
                    is_implemented=interface.implementation != MISSING,
                )
            )
    return found


def _build_use(form: Form, used: _UsedInterface) -> None:
    """Build the row of a component; each output of one without an implementation has a row."""
    if used.index is None:
        _build_design(form.context, used)
        return
    node = project_node(form, "components", used.index)
    if used.section == "outputs" and not used.is_implemented:
        ItemRows(form, node, "outputs", lambda row, item: declaration_row(row, item, f"{used.alias}."))
        return

    def caption() -> str:
        return ", ".join(each.name for each in getattr(node.get(), used.section, ()))

    def build() -> None:
        ItemRows(form, node, used.section, declaration_row)
        declaration_adder(form.context, node, used.section)

    section = collapsible_section(form, f"{used.section} of {used.alias}", lambda: used.alias, caption, build)
    section.classes("declaration-more declared-line")


def _build_design(context: WindowContext, used: _UsedInterface) -> None:
    """Build a row that leads to the box of a component with a design."""
    row = ui.element("button").props('type="button"').classes("choice use-row")
    row.on("click", lambda: context.select(ItemRef(kind="components", id=used.alias)))
    with row:
        ui.label(used.alias).classes("mono")
        ui.label(", ".join(used.names)).classes("component-name ellipsis")


def _adder(form: Form, kind: str, type_: str = "") -> None:
    """Build the fields for a new input, whose type has the default `type_`, or for a new command."""
    context = form.context
    with ui.row().classes("adders add-row"):
        name = ui.input(f"New {kind}").props("dense outlined stack-label maxlength=80").classes("mono add-name")
        if type_:
            types = ui.select(type_names(context.workspace.project), value=type_, label="Type")
            form.watch(lambda: type_names(context.workspace.project), types.set_options)
            types.props('dense outlined options-dense stack-label aria-label="Type of inputs to add"')
            second: ui.input | ui.select = types
        else:
            second = ui.input("Parameters", placeholder="speed, turn: int").props("dense outlined stack-label")
        second.classes("add-detail")

        def add() -> None:
            edit = (add_input if type_ else add_command)(
                context.workspace.project, context.design, str(name.value or "").strip(), str(second.value or "")
            )
            error = edit.error or _write(context, edit)
            show_write_error(context, error)
            if not error:
                name.set_value("")
                if not type_:
                    second.set_value("")

        for field in (name, second):
            field.on("keydown.enter", add)
        add_button("Add", f"Add {kind}", add)


def _write(context: WindowContext, edit: InterfaceEdit) -> str:
    return write_design_and_project(context, edit.label, edit.change_design, edit.change_project)
