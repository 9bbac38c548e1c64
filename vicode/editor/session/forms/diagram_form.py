"""The forms of what only the diagram shows: frames and notes."""

from vicode.editor.session.forms.fields import field_node, other_nodes
from vicode.editor.session.forms.nodes import Button, Colors, ItemName, MultiChoice, Node, Title
from vicode.model.design import STATE_COLORS, DiagramFrame, DiagramNote

_REMOVE = Button(label="Remove", icon="delete", action="remove", is_danger=True)


def frame_form(frame: DiagramFrame) -> tuple[Node, ...]:
    return (
        Title(text="Frame", name=frame.name, is_hidden=True),
        ItemName(path=("name",), label="Title", value=frame.name),
        Colors(path=("color",), label="Color", value=frame.color, options=STATE_COLORS),
        MultiChoice(path=("states",), label="States", value=frame.states, options="states"),
        *other_nodes(frame),
        _REMOVE,
    )


def note_form(note: DiagramNote) -> tuple[Node, ...]:
    return (
        Title(text="Note"),
        field_node(note, "text"),
        *other_nodes(note),
        _REMOVE,
    )
