"""The ordered actions of a state: assignments, calls of used components, code."""

from collections.abc import Callable
from dataclasses import replace

from nicegui import ui

from vicode.editor.panels.code_field import code_field, pairs_field
from vicode.editor.panels.fields import Field, FieldBinding
from vicode.editor.panels.widgets import add_button, reorder_buttons
from vicode.editor.panels.window_context import WindowContext
from vicode.findings import DesignPath
from vicode.model.design import Action, Assign, Call, Code, Declaration, Design, RunCode
from vicode.model.edits import update_actions
from vicode.model.expressions import build_scope

# Focus a new action: otherwise typed letters would be commands of the canvas.
_FOCUS_LAST = """
(function focus(left) {
  const field = document.querySelector('[data-adds="LIST"]')?.previousElementSibling?.querySelector(".cm-content");
  if (field) field.focus();
  else if (left > 0) setTimeout(() => focus(left - 1), 50);
})(100);
"""


def actions_panel(
    context: WindowContext, path: DesignPath, actions: tuple[Action, ...], *, calls: bool = True
) -> list[Field]:
    """Build forms for the actions at a path, with buttons to add, move and remove them."""
    fields: list[Field] = []
    for index, action in enumerate(actions):
        with ui.column().classes("card"):
            with ui.row().classes("card-head"):
                ui.label(_title(action)).classes("card-title")
                reorder_buttons(
                    f"{index + 1} {_title(action)}",
                    up=None if index == 0 else _mover(context, path, index, -1),
                    down=None if index == len(actions) - 1 else _mover(context, path, index, 1),
                    remove=_remover(context, path, index),
                )
            fields += _action_fields(context, path, index, action)
    with ui.row().classes("adders").props(f"data-adds={path[-1]}-{len(actions)}"):
        _adder(context, path, "Set", "edit_note", lambda: Assign(values=(_first_assignment(context),)))
        if calls and context.design.uses:
            _adder(context, path, "Call", "call_made", lambda: Call(alias=context.design.uses[0].alias))
        _adder(context, path, "Code", "code", lambda: RunCode(code=python_code("pass\n")))
    return fields


def python_code(text: str) -> Code:
    return replace_python(None, text)


def replace_python(code: Code | None, text: str) -> Code:
    """Replace the Python text of code; texts in other languages stay."""
    others = tuple(pair for pair in (code.texts if code else ()) if pair[0] != "python")
    # A YAML block of several lines ends with a newline; a single line does not.
    ended = text + "\n" if "\n" in text and not text.endswith("\n") else text
    return Code(texts=((("python", ended), *others) if text.strip() else others))


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


def _action_fields(context: WindowContext, path: DesignPath, index: int, action: Action) -> list[Field]:
    here = (*path, index)

    def read(design: Design) -> Action | None:
        declarations = _actions_at(design, path)
        return declarations[index] if index < len(declarations) else None

    def write(make: Callable[[Action, str], Action]) -> Callable[[Design, str], Design]:
        def change(design: Design, value: str) -> Design:
            return update_actions(
                design,
                path,
                lambda actions: tuple(make(each, value) if at == index else each for at, each in enumerate(actions)),
            )

        return change

    match action:
        case RunCode():
            bound = FieldBinding(
                label="Python", path=(*here, "code"), read=lambda design: _code_of(read(design)), write=write(_set_code)
            )
            return [code_field(context, bound)]
        case Assign():
            bound = FieldBinding(
                label="name = expression, one per line",
                path=(*here, "set"),
                read=lambda design: _values_of(read(design)),
                write=write(_set_values),
            )
            return [pairs_field(context, bound, lambda: settable_declarations(context))]
        case Call():
            bound = FieldBinding(
                label="parameter = expression, one per line",
                path=(*here, "with"),
                read=lambda design: _values_of(read(design)),
                write=write(_set_values),
                hint=", ".join(each.name for each in component_parameters(context, action.alias)),
            )
            return [pairs_field(context, bound, lambda: component_parameters(context, action.alias))]


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


def _actions_at(design: Design, path: DesignPath) -> tuple[Action, ...]:
    if path[0] == "common":
        return design.common.actions
    state = design.state(str(path[1]))
    actions: tuple[Action, ...] = getattr(state, str(path[2])) if state else ()
    return actions


def _code_of(action: Action | None) -> str:
    return (action.code.in_language("python") or "") if isinstance(action, RunCode) else ""


def _values_of(action: Action | None) -> str:
    match action:
        case Assign(values=pairs) | Call(arguments=pairs):
            return format_assignments(pairs)
        case _:
            return ""


def _set_code(action: Action, text: str) -> Action:
    return replace(action, code=replace_python(action.code, text)) if isinstance(action, RunCode) else action


def _set_values(action: Action, text: str) -> Action:
    pairs = parse_assignments(text)
    match action:
        case Assign():
            return replace(action, values=pairs) if pairs else action
        case Call():
            return replace(action, arguments=pairs)
        case _:
            return action


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


def _adder(context: WindowContext, path: DesignPath, label: str, icon: str, make: Callable[[], Action]) -> None:
    def add() -> None:
        action, client = make(), ui.context.client
        context.edit(f"add {label.lower()}", lambda design: update_actions(design, path, lambda old: (*old, action)))
        # The form with the new action is built later.
        count = len(_actions_at(context.design, path))
        client.run_javascript(_FOCUS_LAST.replace("LIST", f"{path[-1]}-{count}"))

    add_button(label, f"Add to {path[-1]}: {label}", add, icon=icon)


def _mover(context: WindowContext, path: DesignPath, index: int, by: int) -> Callable[[], None]:
    def change(actions: tuple[Action, ...]) -> tuple[Action, ...]:
        moved = list(actions)
        moved.insert(index + by, moved.pop(index))
        return tuple(moved)

    return lambda: context.edit("move action", lambda design: update_actions(design, path, change))


def _remover(context: WindowContext, path: DesignPath, index: int) -> Callable[[], None]:
    def change(actions: tuple[Action, ...]) -> tuple[Action, ...]:
        return actions[:index] + actions[index + 1 :]

    return lambda: context.edit("remove action", lambda design: update_actions(design, path, change))
