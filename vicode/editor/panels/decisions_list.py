"""The decisions of a state as an ordered, indented list."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.draggable_rows import DraggableRows
from vicode.editor.panels.form import Form, Rows
from vicode.editor.panels.texts import NO_TRANSITIONS
from vicode.editor.panels.widgets import add_button, reorder_buttons
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.forms.decision_form import decision_target
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.view import ItemRef, guard_label
from vicode.findings import DesignPath
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Decision, DecisionGroup, Guard, Stay
from vicode.model.edits import add_transition, decisions_path, remove_decisions, reorder_decision

_MAX_STATES_IN_MENU = 60
"""With more states, the target of a transition is a text field with completion instead of a menu."""


def decisions_list(form: Form, owner: TrackedItem, section: str) -> None:
    """List decisions, with buttons to add, move and remove them."""
    context, decisions = form.context, owner.child(section)
    Rows(form, lambda: [] if decisions.get() else [NO_TRANSITIONS], lambda _row, text: ui.label(text).classes("empty"))
    _rows(form, decisions)

    def add_menu(_row: Form, is_long: bool) -> None:
        _add_target_menu(context, owner, is_long=is_long)

    with ui.row().classes("adders"):
        Rows(form, lambda: [len(context.design.states) > _MAX_STATES_IN_MENU], add_menu)
        _adder(context, decisions, "Stay", Stay)
        _adder(context, decisions, "Group", lambda: DecisionGroup(guard=Guard(when="True"), then=(Stay(),)))


def _add_target_menu(context: WindowContext, owner: TrackedItem, *, is_long: bool) -> None:
    """Add the menu for a new transition; with many states, a filtered select instead."""

    def targets() -> list[str]:
        return [state.name for state in context.design.states]

    if is_long:
        find = ui.select(targets(), label="Transition to", with_input=True, clearable=True)
        find.on_value_change(lambda event: _connect_handler(context, owner, event.value)() if event.value else None)
        find.on("focus", lambda: find.set_options(targets()))
        find.props("dense outlined options-dense").classes("mono")
        return

    def fill() -> None:
        menu.clear()
        with menu:
            for target in targets():
                ui.menu_item(f"to {target}", on_click=_connect_handler(context, owner, target)).classes("mono")

    with add_button("Transition", "Add Transition"), ui.menu().props("auto-close") as menu:
        # Filled when it opens: rebuilding each form when a state is added would be slow.
        menu.on("before-show", fill)


def _rows(form: Form, decisions: TrackedItem) -> None:
    """List decisions; a row that changes is built anew."""
    context = form.context

    def list_rows() -> list[tuple[DesignPath, Decision, bool, str]]:
        path, items = decisions.path or (), decisions.get() or ()
        last, unit = len(items) - 1, context.design.time_unit
        return [((*path, index), item, index == last, unit) for index, item in enumerate(items)]

    def build(row: Form, key: tuple[DesignPath, Decision, bool, str]) -> None:
        path, item, is_last, _unit = key
        _row(context, dragging, path, item, is_last=is_last)
        if isinstance(item, DecisionGroup):
            with ui.column().classes("nested"):
                _rows(row, row.item(*path, "then"))
                if item.otherwise:
                    ui.label("else").classes("mono else")
                    _rows(row, row.item(*path, "else"))

    def move(from_index: int, target_index: int) -> None:
        _mover(context, (*(decisions.path or ()), from_index), target_index)()

    dragging = DraggableRows(move)
    Rows(form, list_rows, build)


def _row(context: WindowContext, dragging: DraggableRows, path: DesignPath, item: Decision, *, is_last: bool) -> None:
    index = int(path[-1])
    with ui.row().classes("decision-row" + (" is-disabled" if item.disabled else "")) as row:
        dragging.add(row, index)
        button = ui.element("button").classes("decision").props('type="button"')
        with button.on("click", _opener(context, ItemRef(kind="transitions", id=transition_key(path)))):
            ui.label(f"{index + 1}").classes("order")
            ui.label(decision_target(item) + (" (disabled)" if item.disabled else "")).classes("decision-target")
            ui.label(guard_label(item.guard, context.design.time_unit) or "always").classes("decision-guard mono")
        reorder_buttons(
            f"{index + 1} {decision_target(item)}",
            up=None if index == 0 else _mover(context, path, index - 1),
            down=None if is_last else _mover(context, path, index + 1),
            remove=_remover(context, path),
        )


def _opener(context: WindowContext, decision_ref: ItemRef) -> Callable[[], None]:
    def select() -> None:
        context.select(decision_ref)
        context.page.reveal(decision_ref)

    return select


def decision_source(item: TrackedItem) -> str:
    """The state of an item, or COMMON."""
    path = item.path or ()
    return str(path[1]) if path[:1] == ("states",) else COMMON


def _connect_handler(context: WindowContext, owner: TrackedItem, target: str) -> Callable[[], None]:
    def add() -> None:
        source = decision_source(owner)
        context.edit(f"connect {source.lstrip('@')} to {target}", lambda design: add_transition(design, source, target))
        last = len(getattr(context.design.state(source) or context.design.common, "transitions", ())) - 1
        context.select(ItemRef(kind="transitions", id=transition_key((*decisions_path(context.design, source), last))))

    return add


def _adder(context: WindowContext, decisions: TrackedItem, label: str, make: Callable[[], Decision]) -> None:
    def add() -> None:
        decision = make()
        context.edit(f"add {label.lower()}", lambda design: decisions.update(design, lambda items: (*items, decision)))

    add_button(label, f"Add {label}", add)


def _mover(context: WindowContext, path: DesignPath, to_index: int) -> Callable[[], None]:
    return lambda: context.edit("reorder transitions", lambda design: reorder_decision(design, path, to_index))


def _remover(context: WindowContext, path: DesignPath) -> Callable[[], None]:
    return lambda: context.edit("remove transition", lambda design: remove_decisions(design, [path]))
