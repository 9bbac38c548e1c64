"""Forms of declarations in project.yaml: constants, and what hand-written components show, as those of a design."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.declarations import add_argument, declaration_caption, remove_arguments
from vicode.editor.panels.fields import Field
from vicode.editor.panels.project.project_fields import (
    DOC,
    RANGE,
    XABSL_NAME,
    TextAttribute,
    project_name_field,
    project_text_field,
    write_node,
    write_project,
)
from vicode.editor.panels.project.removal import confirm_and_remove
from vicode.editor.panels.widgets import add_button, icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.project_paths import ProjectNodePath

_VALUES = {"constant": "Value", "parameter": "Default", "argument": "Default"}
_ORDERED = ("elements", "arguments")
_UNIT = TextAttribute(label="Unit", attribute="unit")


def declaration_form(
    context: WindowContext,
    spot: ProjectNodePath,
    label: str,
    fields: list[Field],
    on_refresh: Callable[[], None] = lambda: None,
) -> None:
    """Build the form of a declaration; `label` is that of its name, `on_refresh` is called when it may be another."""
    whole, called = form_group(context, spot)
    with whole:
        fields.append(project_name_field(context, label, spot, called))
        value = _VALUES.get(spot.kind, "Initial")
        lines = (
            TextAttribute(label="Type", attribute="type"),
            TextAttribute(label=value, attribute="initial"),
            _UNIT,
            DOC,
        )
        fields.extend(project_text_field(context, spot, line, on_refresh) for line in lines)
        add_remove_button(context, spot, called)

        def more() -> None:
            fields.append(project_text_field(context, spot, RANGE, caption))
            fields.append(project_text_field(context, spot, XABSL_NAME, caption))
            if spot.kind == "output":
                _arguments(context, spot, fields)

        def caption() -> None:
            found = spot.get(context.workspace.project)
            said = declaration_caption(found, spot.kind) if found is not None else ""
            for whole in told:
                whole.props["caption"] = said
                whole.update()

        # What is open is built at once, before there is a fold to tell.
        told: list[ui.expansion] = []
        told.append(collapsible_section(context, f"project {spot.steps}", "More", "", more).classes("declaration-more"))
        caption()


def form_group(
    context: WindowContext, spot: ProjectNodePath, look: str = ""
) -> tuple[ui.element, Callable[[str], None]]:
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

    call_it(spot.name(context.workspace.project))
    return whole, call_it


def add_remove_button(context: WindowContext, spot: ProjectNodePath, called: Callable[[str], None]) -> None:
    """A button that removes a thing; where the order has a meaning, one that puts it before the one before."""
    if spot.section in _ORDERED and spot.steps[-1][1]:

        def put_earlier() -> None:
            what = f"{spot.name(context.workspace.project)} is earlier"
            show_write_error(context, write_project(context, spot.move_up, what, spot, is_agreed=True))

        icon_button("arrow_upward", "Earlier:", put_earlier).classes("move-up")
    icon_button("close", "Remove", lambda: confirm_and_remove(context, spot))
    called(spot.name(context.workspace.project))


def _arguments(context: WindowContext, spot: ProjectNodePath, fields: list[Field]) -> None:
    """What a function takes; an output without arguments is a value."""
    output = spot.get(context.workspace.project)
    if output is None:
        return
    for number in range(len(output.arguments or ())):
        declaration_form(context, spot.child("arguments", number), "Name", fields)
    with ui.row().classes("adders"):
        name = f"Argument: {output.name} is a function of one more"
        add_button("Argument", name, lambda: show_write_error(context, write_node(context, spot, add_argument)))
        if output.arguments is not None:
            words = "No function: it is a value again"
            add_button(
                "No function",
                words,
                lambda: show_write_error(context, write_node(context, spot, remove_arguments)),
                icon="close",
            )


def show_write_error(context: WindowContext, refused: str) -> None:
    """Say why something was not written."""
    if refused:
        context.show_toast(refused[:1].upper() + refused[1:], "warning")
