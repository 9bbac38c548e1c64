"""The form of the design: what it is, what it uses and declares, and its code."""

from dataclasses import replace

from vicode.editor.session.forms.construct_form import construct_lists
from vicode.editor.session.forms.decision_form import code_texts
from vicode.editor.session.forms.declaration_form import declaration_cards
from vicode.editor.session.forms.fields import field_node, known_field, other_nodes
from vicode.editor.session.forms.interface_form import interface_lists
from vicode.editor.session.forms.item_place import ItemPlace
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    Choice,
    DeclarationList,
    Heading,
    ItemLink,
    Node,
    OptionList,
    Paragraph,
    Row,
    Section,
    Title,
    UseLine,
    Uses,
)
from vicode.editor.session.forms.project_form import project_section
from vicode.editor.session.forms.state_form import uses_xabsl
from vicode.model.design import COMMON, Design
from vicode.model.lowering import lift_design
from vicode.model.project import Project
from vicode.model.words import describe_property

_SECTIONS: tuple[tuple[DeclarationList, str, str], ...] = (
    ("parameters", "Parameters", "values set by the states that modulate this component"),
    ("outputs", "Outputs", "values other components can read"),
    ("variables", "Variables", "internal values"),
)
_XABSL_CHOICES: tuple[tuple[str, OptionList, str], ...] = (
    ("arithmetic", "arithmetic", "xabsl: arithmetic and restart semantics of XABSL. Empty: default semantics."),
    ("time_unit", "time_units", "Unit of state_time and component_time in expressions. Empty: seconds."),
)


def design_form(project: Project, design: Design, ids: ListIds) -> tuple[Node, ...]:
    """The form of the design, shown while nothing is selected."""
    declared: list[Node] = []
    for section, title, hint in _SECTIONS:
        cards = declaration_cards(ItemPlace(ids=ids), section, getattr(design, section))
        declared += [
            Heading(text=title, hint=hint),
            replace(cards, menu="Latch, interrupt…" if section == "variables" else ""),
        ]
    initial = Choice(path=("initial",), label="Initial state", value=design.initial, options="states")
    has_initial = design.competence is None and not design.layers
    return (
        Title(text="Component", name=design.component),
        field_node(design, "doc"),
        Row(nodes=(*((initial,) if has_initial else ()), field_node(design, "frequency_hz"))),
        field_node(design, "resume"),
        *other_nodes(design),
        *interface_lists(project, design, ids.of_project(project)),
        *((_xabsl(design),) if uses_xabsl(project, design) or design.time_unit else ()),
        Heading(text="Uses", hint="components this design requires or modulates"),
        Uses(rows=tuple(UseLine(alias=use.alias, component=use.component) for use in design.uses)),
        *declared,
        *construct_lists(design, ids),
        *_properties(design),
        Heading(text="Every state", hint="transitions and actions before those of each state"),
        ItemLink(label="Common transitions and actions", caption=_describe_common(design), opens=("common", COMMON)),
        _code(project, design),
        project_section(project),
    )


def _properties(design: Design) -> tuple[Node, ...]:
    """The properties, which are edited in the file."""
    if not design.properties:
        return ()
    lines = (Paragraph(text=describe_property(each), look="small") for each in design.properties)
    return (Heading(text="Properties", hint="what it promises; edited in the file"), *lines)


def _xabsl(design: Design) -> Section:
    parts = [f"{design.xabsl_name} in XABSL"] if design.xabsl_name else []
    parts += ["XABSL arithmetic"] if design.arithmetic else []
    parts += [f"time unit {design.time_unit}"] if design.time_unit else []
    choices = (
        Choice(
            path=(name,),
            label=known_field(design, (name,)).label,
            value=getattr(design, name),
            options=options,
            help=help_,
            is_clearable=True,
        )
        for name, options, help_ in _XABSL_CHOICES
    )
    return Section(
        key="xabsl",
        title="XABSL",
        caption="; ".join(parts) or "name, arithmetic, time unit",
        nodes=(field_node(design, "xabsl_name"), *choices),
    )


def _code(project: Project, design: Design) -> Section:
    names = [name for name in ("module", "members") if getattr(design, name).texts]
    return Section(
        key="code",
        title="Code",
        caption=", ".join(names) or "module and class members",
        nodes=tuple(code_texts(project, design, (name,)) for name in ("module", "members")),
    )


def _describe_common(design: Design) -> str:
    common = lift_design(design).common
    parts = [
        f"{len(items)} {noun}{'s' * (len(items) != 1)}"
        for items, noun in ((common.transitions, "transition"), (common.actions, "action"))
        if items
    ]
    return ", ".join(parts) or "none"
