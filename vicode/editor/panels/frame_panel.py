"""The form of a frame."""

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.color_choice import color_choice
from vicode.editor.panels.fields import Attribute, attribute_binding, choice_field
from vicode.editor.panels.form import Form
from vicode.editor.panels.name_field import name_field, node_renamer
from vicode.editor.panels.widgets import panel_title
from vicode.editor.view import ItemRef
from vicode.model.design import Design
from vicode.model.diagram_edits import remove_frames


def _validate_states(names: list[str]) -> str:
    return "" if names else texts.FRAME_NEEDS_STATE


_TITLE = Attribute(label="Title", name="name")
_STATES = Attribute(label="States", name="states", format=list, parse=tuple, validate=_validate_states)


def frame_panel(form: Form, title: str) -> None:
    context, item = form.context, form.item("frames", title)
    panel_title("Frame", title, is_visually_hidden=True)
    name_field(form, attribute_binding(item, _TITLE), node_renamer(context, "frames"))
    form.on_refresh(
        color_choice(context, lambda: [ItemRef(kind="frames", id=frame.name)] if (frame := item.get()) else [])
    )
    choice_field(form, attribute_binding(item, _STATES), _state_names, multiple=True)

    def remove() -> None:
        if frame := item.get():
            context.edit(f"remove frame {frame.name}", lambda design: remove_frames(design, [frame.name]))
        context.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative").classes("remove")


def _state_names(design: Design) -> list[str]:
    return [state.name for state in design.states]
