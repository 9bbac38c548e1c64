"""The decisions of a state as an ordered, indented list; a click selects one."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.row_dragging import RowDragging
from vicode.editor.panels.rows import add_button, row_of_buttons
from vicode.editor.session.outline import MANY_STATES
from vicode.editor.view import Selected, guard_label, transition_key
from vicode.findings import Path
from vicode.model.design import Decision, Group, Guard, Stay, Transition
from vicode.model.edits import add_transition, items_path, remove_decisions, reorder_decision, update_items


def decisions_list(desk: Desk, source: str, path: Path, items: tuple[Decision, ...]) -> None:
    """Show the decisions a path leads to, with buttons to add, move and remove."""
    if not items:
        ui.label("None yet: it stays here.").classes("empty")
    _rows(desk, path, items)
    with ui.row().classes("adders"):
        _offer_targets(desk, source)
        _adder(desk, path, "Stay", Stay)
        _adder(desk, path, "Group", lambda: Group(guard=Guard(when="True"), then=(Stay(),)))


def _offer_targets(desk: Desk, source: str) -> None:
    """A new transition to a state: from a menu, or by typing when there are more states than anybody would scroll."""

    def targets() -> list[str]:
        return [state.name for state in desk.design.states]

    if len(targets()) > MANY_STATES:
        find = ui.select(targets(), label="Transition to", with_input=True, clearable=True)
        find.on_value_change(lambda event: _connector(desk, source, event.value)() if event.value else None)
        find.on("focus", lambda: find.set_options(targets()))
        find.props("dense outlined options-dense").classes("mono")
        return

    def fill() -> None:
        menu.clear()
        with menu:
            for target in targets():
                ui.menu_item(f"to {target}", on_click=_connector(desk, source, target)).classes("mono")

    with add_button("Transition", "Add: Transition"), ui.menu().props("auto-close") as menu:
        # Other people's states shall be in it, but not make every form anew.
        menu.on("before-show", fill)


def _rows(desk: Desk, path: Path, items: tuple[Decision, ...]) -> None:
    dragging = RowDragging(lambda held, onto: _mover(desk, (*path, held), onto)())
    for index, item in enumerate(items):
        here = (*path, index)
        thing = Selected(of="transitions", id=transition_key(here))
        marks = (" is-selected" if desk.only == thing else "") + (" is-disabled" if item.disabled else "")
        with ui.row().classes("decision-row" + marks) as row:
            dragging.add(row, index)
            with ui.element("button").classes("decision").props('type="button"').on("click", _opener(desk, thing)):
                ui.label(f"{index + 1}").classes("order")
                ui.label(_target(item) + (" (disabled)" if item.disabled else "")).classes("decision-target")
                ui.label(guard_label(item.guard, desk.design.time_unit) or "always").classes("decision-guard mono")
            row_of_buttons(
                f"{index + 1} {_target(item)}",
                up=None if index == 0 else _mover(desk, here, index - 1),
                down=None if index == len(items) - 1 else _mover(desk, here, index + 1),
                remove=_remover(desk, here),
            )
        if isinstance(item, Group):
            with ui.column().classes("nested"):
                _rows(desk, (*here, "then"), item.then)
                if item.otherwise:
                    ui.label("else").classes("mono else")
                    _rows(desk, (*here, "else"), item.otherwise)


def _target(item: Decision) -> str:
    match item:
        case Transition(to=to):
            return f"→ {to}"
        case Stay():
            return "stay"
        case Group():
            return "if"


def _opener(desk: Desk, thing: Selected) -> Callable[[], None]:
    def select() -> None:
        desk.select(thing)
        desk.reveal(thing)

    return select


def _connector(desk: Desk, source: str, target: str) -> Callable[[], None]:
    def add() -> None:
        desk.edit(f"connect {source.lstrip('@')} to {target}", lambda design: add_transition(design, source, target))
        last = len(getattr(desk.design.state(source) or desk.design.common, "transitions", ())) - 1
        desk.select(Selected(of="transitions", id=transition_key((*items_path(desk.design, source), last))))

    return add


def _adder(desk: Desk, path: Path, label: str, make: Callable[[], Decision]) -> None:
    def add() -> None:
        decision = make()
        desk.edit(f"add {label.lower()}", lambda design: update_items(design, path, lambda items: (*items, decision)))

    add_button(label, f"Add: {label}", add)


def _mover(desk: Desk, path: Path, to_index: int) -> Callable[[], None]:
    def move() -> None:
        desk.edit("change the order", lambda design: reorder_decision(design, path, to_index))
        if desk.only == Selected(of="transitions", id=transition_key(path)):
            desk.select(Selected(of="transitions", id=transition_key((*path[:-1], to_index))))

    return move


def _remover(desk: Desk, path: Path) -> Callable[[], None]:
    def remove() -> None:
        desk.edit("remove transition", lambda design: remove_decisions(design, [path]))

    return remove
