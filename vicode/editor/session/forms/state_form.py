"""The forms of a state, and of what all states have in common."""

from collections.abc import Sequence

from vicode.editor.session.forms.action_form import action_cards, modulation_cards
from vicode.editor.session.forms.decision_form import decisions_list
from vicode.editor.session.forms.fields import field_node, initial_field, other_nodes
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    Check,
    Colors,
    Heading,
    ItemName,
    MultiChoice,
    Node,
    Notice,
    Row,
    Section,
    Title,
)
from vicode.findings import DesignPath
from vicode.model.design import STATE_COLORS, Design, State
from vicode.model.project import Project

OUTSIDE: DesignPath = ("outside",)
"""The path of the notice about code that was changed outside."""


def state_form(project: Project, design: Design, state: State, ids: ListIds) -> tuple[Node, ...]:
    """The form of a state: what it does and when it ends first, what few states need behind "More"."""
    owner: DesignPath = ("states", state.name)
    ends = ("final", "failed") if state.final or state.failed else ("final",)
    return (
        Title(text="State", name=state.name, is_hidden=True),
        ItemName(path=("name",), label="State", value=state.name),
        Notice(path=OUTSIDE),
        field_node(state, "doc"),
        Row(nodes=(_initial(design, state), *(field_node(state, name) for name in ends))),
        Heading(text="Actions", hint="run in order in each iteration"),
        action_cards(project, ("actions",), state.actions, ids.ids((*owner, "actions"), state.actions)),
        Heading(text="Modulates", hint="components this state runs, with parameters"),
        modulation_cards(project, state.modulates),
        Heading(text="Transitions", hint="the first whose guard holds is taken"),
        decisions_list(design, ("transitions",), state.transitions),
        Heading(text="Requires", hint="components that run before this state, in each step"),
        MultiChoice(path=("requires",), label="Components", value=state.requires, options="uses"),
        _enter_and_leave(project, state, ids),
        _more(project, design, state),
        *other_nodes(state),
    )


def common_form(project: Project, design: Design, ids: ListIds) -> tuple[Node, ...]:
    """The form of the transitions and actions of all states."""
    common = design.common
    return (
        Title(text="Every state"),
        field_node(common, "doc"),
        Heading(text="Transitions", hint="tested in every state before its own"),
        decisions_list(design, ("transitions",), common.transitions),
        Heading(text="Actions", hint="run in every state before its own"),
        action_cards(project, ("actions",), common.actions, ids.ids(("common", "actions"), common.actions)),
        *other_nodes(common),
    )


def uses_xabsl(project: Project, design: Design) -> bool:
    """Whether names in XABSL matter to this design."""
    return "xabsl" in project.languages or bool(design.xabsl_name or design.arithmetic)


def _initial(design: Design, state: State) -> Check:
    field = initial_field(state.name)
    return Check(path=("initial",), label=field.label, value=field.read(design))


def _enter_and_leave(project: Project, state: State, ids: ListIds) -> Section:
    nodes: list[Node] = []
    for name, title, hint in (("enter", "Enter", "run once on entry"), ("leave", "Leave", "run once on exit")):
        actions = getattr(state, name)
        nodes.append(Heading(text=title, hint=hint))
        nodes.append(
            action_cards(project, (name,), actions, ids.ids(("states", state.name, name), actions), calls=False)
        )
    counts = [f"{len(actions)} on {name}" for name in ("enter", "leave") if (actions := getattr(state, name))]
    return Section(
        key="enter-leave",
        title="Enter and leave",
        caption=_caption(counts, "actions that run once"),
        nodes=tuple(nodes),
        is_set=bool(counts),
    )


def _more(project: Project, design: Design, state: State) -> Section:
    has_xabsl_name = bool(state.xabsl_name) or uses_xabsl(project, design)
    names = ["capacity", "synchronized", *(["xabsl_name"] if has_xabsl_name else [])]
    fields = Row(nodes=tuple(field_node(state, name) for name in names))
    set_parts = [
        *(["disabled"] if state.disabled else []),
        *([state.color] if state.color else []),
        *(f"{name} {value}" for name in names[:2] if (value := getattr(state, name)) is not None),
        *([f"{state.xabsl_name} in XABSL"] if state.xabsl_name else []),
    ]
    return Section(
        key="more",
        title="More",
        caption=_caption(set_parts, "disabled, color, team" + (", XABSL" if len(names) > 2 else "")),
        nodes=(
            field_node(state, "disabled"),
            Colors(path=("color",), label="Color", value=state.color, options=STATE_COLORS),
            fields,
        ),
        is_set=bool(set_parts),
    )


def _caption(parts: Sequence[str], empty: str) -> str:
    return "; ".join(parts) or empty
