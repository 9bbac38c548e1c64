"""Forms of declarations in project.yaml: constants, and what hand-written components show, as those of a design."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.declarations import caption_of, with_argument, without_arguments
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Field
from vicode.editor.panels.folds import fold
from vicode.editor.panels.project.fields import (
    DOC,
    RANGE,
    XABSL_NAME,
    Line,
    line_in_file,
    name_in_file,
    write,
    write_project,
)
from vicode.editor.panels.project.removing import remove
from vicode.editor.panels.rows import add_button, icon_button
from vicode.editor.session.project_spots import Spot

_VALUES = {"constant": "Value", "parameter": "Default", "argument": "Default"}
_ORDERED = ("elements", "arguments")
_UNIT = Line(label="Unit", attribute="unit")


def declaration_form(
    desk: Desk, spot: Spot, label: str, fields: list[Field], shown: Callable[[], None] = lambda: None
) -> None:
    """Build the form of a declaration; `label` is that of its name, `shown` is called when it may be another."""
    whole, called = group(desk, spot)
    with whole:
        fields.append(name_in_file(desk, label, spot, called))
        value = _VALUES.get(spot.kind, "Initial")
        lines = (Line(label="Type", attribute="type"), Line(label=value, attribute="initial"), _UNIT, DOC)
        fields.extend(line_in_file(desk, spot, line, shown) for line in lines)
        remover(desk, spot, called)

        def more() -> None:
            fields.append(line_in_file(desk, spot, RANGE, caption))
            fields.append(line_in_file(desk, spot, XABSL_NAME, caption))
            if spot.kind == "output":
                _arguments(desk, spot, fields)

        def caption() -> None:
            found = spot.read(desk.workspace.project)
            said = caption_of(found, spot.kind) if found is not None else ""
            for whole in told:
                whole.props["caption"] = said
                whole.update()

        # What is open is built at once, before there is a fold to tell.
        told: list[ui.expansion] = []
        told.append(fold(desk, f"project {spot.steps}", "More", "", more).classes("declaration-more"))
        caption()


def group(desk: Desk, spot: Spot, look: str = "") -> tuple[ui.element, Callable[[str], None]]:
    """A frame around the form of a thing, and what calls it by another name."""
    whole = ui.element("div").classes(f"declaration {look}").props("role=group")

    def call_it(name: str) -> None:
        whole.props["aria-label"] = f"{spot.kind} {name}"
        whole.update()
        for button in whole.default_slot.children:
            if isinstance(button, ui.button):
                verb = str(button.props["aria-label"]).partition(" ")[0]
                button.props["aria-label"] = f"{verb} {spot.kind} {name}"
                button.update()

    call_it(spot.name(desk.workspace.project))
    return whole, call_it


def remover(desk: Desk, spot: Spot, called: Callable[[str], None]) -> None:
    """A button that removes a thing; where the order has a meaning, one that puts it before the one before."""
    if spot.section in _ORDERED and spot.steps[-1][1]:

        def put_earlier() -> None:
            what = f"{spot.name(desk.workspace.project)} is earlier"
            tell(desk, write_project(desk, spot.earlier, what, spot, is_agreed=True))

        icon_button("arrow_upward", "Earlier:", put_earlier).classes("earlier")
    icon_button("close", "Remove", lambda: remove(desk, spot))
    called(spot.name(desk.workspace.project))


def _arguments(desk: Desk, spot: Spot, fields: list[Field]) -> None:
    """What a function takes; an output without arguments is a value."""
    output = spot.read(desk.workspace.project)
    if output is None:
        return
    for number in range(len(output.arguments or ())):
        declaration_form(desk, spot.inner("arguments", number), "Name", fields)
    with ui.row().classes("adders"):
        name = f"Argument: {output.name} is a function of one more"
        add_button("Argument", name, lambda: tell(desk, write(desk, spot, with_argument)))
        if output.arguments is not None:
            words = "No function: it is a value again"
            add_button("No function", words, lambda: tell(desk, write(desk, spot, without_arguments)), icon="close")


def tell(desk: Desk, refused: str) -> None:
    """Say why something was not written."""
    if refused:
        desk.say(refused[:1].upper() + refused[1:], "warning")
