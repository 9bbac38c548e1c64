"""The ordered actions of a state: assignments, calls of used components, code."""

from collections.abc import Callable, Hashable
from dataclasses import replace

from nicegui import ui

from vicode.editor.panels.code_field import pairs_field
from vicode.editor.panels.code_language_tabs import code_fields
from vicode.editor.panels.fields import Attribute, attribute_binding
from vicode.editor.panels.form import Form, ItemRows, Rows
from vicode.editor.panels.widgets import add_button, reorder_buttons
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.forms.fields import replace_text
from vicode.editor.session.item_paths import TrackedItem, item_at
from vicode.model.design import Action, Assign, Call, Declaration, RunCode
from vicode.model.expressions import build_scope

# Focus a new action: otherwise typed letters would be commands of the canvas.
_FOCUS = """
(function focus(left) {
  const field = getHtmlElement(%d)?.querySelector(".cm-content");
  if (field) field.focus();
  else if (left > 0) setTimeout(() => focus(left - 1), 50);
})(100);
"""


def actions_panel(form: Form, owner: TrackedItem, section: str, *, calls: bool = True) -> None:
    """Build forms for a list of actions, with buttons to add, move and remove them."""
    context = form.context

    def shape(action: Action) -> Hashable:
        return (type(action), component_parameters(context, action.alias) if isinstance(action, Call) else ())

    def add(label: str, icon: str, make: Callable[[], Action]) -> None:
        adder = _adder(rows, owner.child(section), label, make)
        add_button(label, f"Add to {section}: {label}", adder, icon=icon).props("data-opens-field")

    def list_calls() -> list[str]:
        return ["Call"] if calls and context.design.uses else []

    def make_call() -> Action:
        return Call(alias=context.design.uses[0].alias)

    rows = ItemRows(form, owner, section, _action, shape)
    with ui.row().classes("adders"):
        add("Set", "edit_note", lambda: Assign(values=(_first_assignment(context),)))
        Rows(form, list_calls, lambda _row, label: add(label, "call_made", make_call))
        add("Code", "code", lambda: RunCode(code=replace_text(None, "python", "")))


def _action(form: Form, item: TrackedItem) -> None:
    def list_heads() -> list[tuple[str, int, bool]]:
        path = item.path
        if path is None:
            return []
        index, actions = int(path[-1]), item_at(form.context.design, path[:-1])
        return [(_title(actions[index]), index, index == len(actions) - 1)]

    def build_head(_row: Form, key: tuple[str, int, bool]) -> None:
        title, index, is_last = key
        _head(form, item, title, index, is_last=is_last)

    with ui.column().classes("card"):
        Rows(form, list_heads, build_head)
        _action_field(form, item)


def _head(form: Form, item: TrackedItem, title: str, index: int, *, is_last: bool) -> None:
    edit = form.context.edit

    def move(by: int) -> Callable[[], None]:
        return lambda: edit("move action", lambda design: item.move(design, by))

    with ui.row().classes("card-head"):
        ui.label(title).classes("card-title")
        reorder_buttons(
            f"{index + 1} {title}",
            up=None if index == 0 else move(-1),
            down=None if is_last else move(1),
            remove=lambda: edit("remove action", item.remove),
        )


def parse_assignments(text: str) -> tuple[tuple[str, str], ...]:
    """Parse lines `name = expression` (or `name: expression`)."""
    halves = (line.partition("=" if "=" in line else ":") for line in text.splitlines())
    return tuple((name.strip(), value.strip()) for name, _sign, value in halves if name.strip())


def format_assignments(pairs: tuple[tuple[str, str], ...]) -> str:
    """Format pairs as lines `name = expression`."""
    return "\n".join(f"{name} = {value}" for name, value in pairs)


def _title(action: Action) -> str:
    match action:
        case Assign():
            return "Set"
        case Call(alias=alias):
            return f"Call {alias}"
        case RunCode():
            return "Code"


def _action_field(form: Form, item: TrackedItem) -> None:
    context = form.context
    match item.get():
        case RunCode():
            code_fields(form, item, "code")
        case Assign():
            attribute = Attribute(
                label="name = expression, one per line",
                name="values",
                key="set",
                format=format_assignments,
                # The last assignment is removed with its action.
                parse=lambda text: parse_assignments(text) or item.get().values,
            )
            pairs_field(form, attribute_binding(item, attribute), lambda: settable_declarations(context))
        case Call(alias=alias):
            attribute = Attribute(
                label="parameter = expression, one per line",
                name="arguments",
                key="with",
                format=format_assignments,
                parse=parse_assignments,
                hint=", ".join(each.name for each in component_parameters(context, alias)),
            )
            binding = attribute_binding(item, attribute)
            pairs_field(form, binding, lambda: component_parameters(context, item.get().alias))


def settable_declarations(context: WindowContext) -> tuple[Declaration, ...]:
    """Return the variables and outputs of the design, and variables of used components as `alias.variable`."""
    declarations = [*context.design.variables, *context.design.outputs]
    for use in context.design.uses:
        interface = context.workspace.project.interface(use.component)
        variables = interface.variables if interface else ()
        declarations += [replace(each, name=f"{use.alias}.{each.name}") for each in variables]
    return tuple(declarations)


def component_parameters(context: WindowContext, alias: str) -> tuple[Declaration, ...]:
    use = context.design.use(alias)
    interface = context.workspace.project.interface(use.component) if use else None
    return interface.parameters if interface else ()


def _first_assignment(context: WindowContext) -> tuple[str, str]:
    """Return a default assignment: the first settable declaration, and a value of its type."""
    settable = settable_declarations(context)
    if not settable:
        return ("name", "0")
    scope = build_scope(context.workspace.project, context.design)
    type_ = scope.type_of(settable[0])
    elements = scope.enumerations.get(type_, ())
    zero = f"{type_}.{elements[0]}" if elements else {"bool": "False"}.get(type_, "0")
    return (settable[0].name, zero)


def _adder(rows: ItemRows, actions: TrackedItem, label: str, make: Callable[[], Action]) -> Callable[[], None]:
    def add() -> None:
        action, context = make(), rows.form.context
        context.edit(f"add {label.lower()}", lambda design: actions.update(design, lambda old: (*old, action)))
        context.client.run_javascript(_FOCUS % rows.container.default_slot.children[-1].id)

    return add
