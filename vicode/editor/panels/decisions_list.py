"""The decisions of a state as an ordered, indented list."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.draggable_rows import DraggableRows
from vicode.editor.panels.texts import NO_TRANSITIONS
from vicode.editor.panels.widgets import add_button, reorder_buttons
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.form_key import MAX_STATES_IN_MENU
from vicode.editor.view import ItemRef, guard_label, transition_key
from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Guard, Stay, Transition
from vicode.model.edits import add_transition, decisions_path, remove_decisions, reorder_decision, update_decisions


def decisions_list(context: WindowContext, source: str, path: DesignPath, items: tuple[Decision, ...]) -> None:
    """List the decisions at a path, with buttons to add, move and remove them."""
    if not items:
        ui.label(NO_TRANSITIONS).classes("empty")
    _rows(context, path, items)
    with ui.row().classes("adders"):
        _add_target_menu(context, source)
        _adder(context, path, "Stay", Stay)
        _adder(context, path, "Group", lambda: DecisionGroup(guard=Guard(when="True"), then=(Stay(),)))


def _add_target_menu(context: WindowContext, source: str) -> None:
    """Add the menu for a new transition; with many states, a filtered select instead."""

    def targets() -> list[str]:
        return [state.name for state in context.design.states]

    if len(targets()) > MAX_STATES_IN_MENU:
        find = ui.select(targets(), label="Transition to", with_input=True, clearable=True)
        find.on_value_change(lambda event: _connect_handler(context, source, event.value)() if event.value else None)
        find.on("focus", lambda: find.set_options(targets()))
        find.props("dense outlined options-dense").classes("mono")
        return

    def fill() -> None:
        menu.clear()
        with menu:
            for target in targets():
                ui.menu_item(f"to {target}", on_click=_connect_handler(context, source, target)).classes("mono")

    with add_button("Transition", "Add Transition"), ui.menu().props("auto-close") as menu:
        # Filled when it opens: rebuilding each form when a state is added would be slow.
        menu.on("before-show", fill)


def _rows(context: WindowContext, path: DesignPath, items: tuple[Decision, ...]) -> None:
    dragging = DraggableRows(lambda from_index, target_index: _mover(context, (*path, from_index), target_index)())
    for index, item in enumerate(items):
        here = (*path, index)
        decision_ref = ItemRef(kind="transitions", id=transition_key(here))
        marks = (" is-selected" if context.single_selection == decision_ref else "") + (
            " is-disabled" if item.disabled else ""
        )
        with ui.row().classes("decision-row" + marks) as row:
            dragging.add(row, index)
            with (
                ui.element("button")
                .classes("decision")
                .props('type="button"')
                .on("click", _opener(context, decision_ref))
            ):
                ui.label(f"{index + 1}").classes("order")
                ui.label(_target(item) + (" (disabled)" if item.disabled else "")).classes("decision-target")
                ui.label(guard_label(item.guard, context.design.time_unit) or "always").classes("decision-guard mono")
            reorder_buttons(
                f"{index + 1} {_target(item)}",
                up=None if index == 0 else _mover(context, here, index - 1),
                down=None if index == len(items) - 1 else _mover(context, here, index + 1),
                remove=_remover(context, here),
            )
        if isinstance(item, DecisionGroup):
            with ui.column().classes("nested"):
                _rows(context, (*here, "then"), item.then)
                if item.otherwise:
                    ui.label("else").classes("mono else")
                    _rows(context, (*here, "else"), item.otherwise)


def _target(item: Decision) -> str:
    match item:
        case Transition(to=to):
            return f"→ {to}"
        case Stay():
            return "stay"
        case DecisionGroup():
            return "if"


def _opener(context: WindowContext, decision_ref: ItemRef) -> Callable[[], None]:
    def select() -> None:
        context.select(decision_ref)
        context.page.reveal(decision_ref)

    return select


def _connect_handler(context: WindowContext, source: str, target: str) -> Callable[[], None]:
    def add() -> None:
        context.edit(f"connect {source.lstrip('@')} to {target}", lambda design: add_transition(design, source, target))
        last = len(getattr(context.design.state(source) or context.design.common, "transitions", ())) - 1
        context.select(ItemRef(kind="transitions", id=transition_key((*decisions_path(context.design, source), last))))

    return add


def _adder(context: WindowContext, path: DesignPath, label: str, make: Callable[[], Decision]) -> None:
    def add() -> None:
        decision = make()
        context.edit(
            f"add {label.lower()}", lambda design: update_decisions(design, path, lambda items: (*items, decision))
        )

    add_button(label, f"Add {label}", add)


def _mover(context: WindowContext, path: DesignPath, to_index: int) -> Callable[[], None]:
    def move() -> None:
        context.edit("reorder transitions", lambda design: reorder_decision(design, path, to_index))
        if context.single_selection == ItemRef(kind="transitions", id=transition_key(path)):
            context.select(ItemRef(kind="transitions", id=transition_key((*path[:-1], to_index))))

    return move


def _remover(context: WindowContext, path: DesignPath) -> Callable[[], None]:
    def remove() -> None:
        context.edit("remove transition", lambda design: remove_decisions(design, [path]))

    return remove
