"""The forms of latches, interrupts, the competence and layers (`vicode.model.lowering`).

The form of the design lists them. Forms of the states and transitions that are derived from one show it as a part.
The paths of its fields are the same everywhere, such as "design/latches/0/on": each edit is one of the design.
"""

import json
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from vicode.editor.session.forms.action_form import modulation_cards
from vicode.editor.session.forms.decision_form import decision_target, decision_title
from vicode.editor.session.forms.fields import field_node, known_field
from vicode.editor.session.forms.item_place import ItemPlace
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    Adder,
    AdderList,
    Button,
    Card,
    Cards,
    Choice,
    CodeText,
    FormPart,
    Heading,
    ItemLink,
    ItemName,
    MultiChoice,
    Node,
    Notice,
    Paragraph,
    Row,
    Section,
    TextField,
    Title,
    form_json,
)
from vicode.editor.session.forms.state_form import OUTSIDE
from vicode.editor.view import guard_label
from vicode.model.construct_edits import has_own_states, interrupting_states
from vicode.model.design import (
    Competence,
    CompetenceStep,
    DecisionGroup,
    Design,
    Interrupt,
    Latch,
    Layer,
    Origin,
    State,
    Transition,
)
from vicode.model.lowering import derived_variables
from vicode.model.project import Project
from vicode.model.traversal import Construct

_LISTS: tuple[tuple[AdderList, str, str], ...] = (
    ("latches", "Latches", "conditions with two limits or a minimum time"),
    ("interrupts", "Interrupts", "the first ones are the most urgent"),
    ("steps", "Steps", "the first one that is possible is done"),
    ("layers", "Layers", "the last one whose condition holds commands"),
)
_DERIVED = "this is derived from it"
_NOUNS = {Latch: "Latch", Interrupt: "Interrupt", Competence: "Competence", CompetenceStep: "Step", Layer: "Layer"}


def construct_lists(design: Design, ids: ListIds) -> tuple[Node, ...]:
    """The lists of all constructs, without headings while they are empty."""
    nodes: list[Node] = []
    found = list(_places(design, ids))
    for section, title, hint in _LISTS:
        items = [(place, each) for place, each in found if place.section == section]
        is_competence = section == "steps"
        if is_competence and design.competence is None:
            continue
        if is_competence:
            nodes += [Heading(text="Competence", hint="steps towards a goal"), FormPart(form="design/competence")]
        is_shown = bool(items) or is_competence
        nodes += [Heading(text=title, hint=hint)] if is_shown else []
        cards = (_card(place, each, FormPart(form=place.key)) for place, each in items)
        owner = ("design", "competence") if is_competence else ("design",)
        noun = {"latches": "latch"}.get(section, section.removesuffix("s"))
        adders: AdderList | None = section if is_shown else None
        nodes.append(Cards(path=(*owner, section), cards=tuple(cards), adders=adders or "", noun=noun, is_ordered=True))
    return tuple(nodes)


def construct_parts(project: Project, design: Design, ids: ListIds) -> dict[str, tuple[Node, ...]]:
    """The form of each construct, by its key in the forms."""
    variables = derived_variables(design)
    parts: dict[str, tuple[Node, ...]] = {}
    for place, each in _places(design, ids):
        added = [name for name, origin in variables if origin == _origin(place, each) and name != _name(each)]
        note = (Paragraph(text=f"Adds {', '.join(added)}.", look="empty"),) if added else ()
        parts[place.key] = (*construct_nodes(project, design, place, each), *note)
    return parts


def derived_state_form(design: Design, ids: ListIds, state: State) -> tuple[Node, ...]:
    """The form of a state that is derived from a step, a layer or the competence: that of its construct."""
    return (
        Title(text="State", name=state.name, is_hidden=True),
        Notice(path=OUTSIDE),
        *_origin_nodes(design, ids, state.origin),
    )


def derived_decision_form(
    design: Design, ids: ListIds, source: str, decision: Transition | DecisionGroup
) -> tuple[Node, ...]:
    """What a derived decision says, and the form of its construct, or a link to the state that has this form."""
    text = f"{decision_target(decision)} – {guard_label(decision.guard, design.time_unit) or 'always'}"
    match decision.origin:
        case ("competence", "steps", str(name)) | ("layers", str(name)):
            noun = "Layer" if len(decision.origin) == 2 else "Step"
            origin: tuple[Node, ...] = (ItemLink(label=f"{noun} {name}", caption=_DERIVED, opens=("states", name)),)
        case _:
            origin = _origin_nodes(design, ids, decision.origin)
    return (decision_title(source, decision), Paragraph(text=text, look="small mono"), *origin)


def _origin_nodes(design: Design, ids: ListIds, origin: Origin) -> tuple[Node, ...]:
    found = next(((place, each) for place, each in _places(design, ids) if _origin(place, each) == origin), None)
    if found is None:
        return ()
    place, construct = found
    return (Heading(text=_NOUNS[type(construct)], hint=_DERIVED), FormPart(form=place.key))


def construct_nodes(project: Project, design: Design, place: ItemPlace, construct: Construct) -> tuple[Node, ...]:
    """The fields of a construct."""
    unit = "ms" if design.time_unit == "ms" else "s"
    doc = field_node(construct, "doc", place.path)
    match construct:
        case Latch():
            first = Row(nodes=(_name_field(place, construct), _time(place, construct, "hold", unit)))
            return (first, _condition(place, construct, "on"), _condition(place, construct, "off"), doc)
        case Interrupt():
            value = known_field(construct, ("then",)).read(construct)
            do = Choice(path=place.within("do"), label="Do", value=construct.do, options="states")
            then = Choice(path=place.within("then"), label="Then", value=value, options="ends")
            during = field_node(construct, "during", place.path, is_committed=True)
            last = Row(nodes=(during, _time(place, construct, "every", unit)))
            conditions = (_condition(place, construct, name) for name in ("when", "until"))
            return (Row(nodes=(do, then)), *conditions, last, doc)
        case Competence():
            remove = Button(label="Remove competence", icon="close", action="remove-card", path=place.path)
            return (_condition(place, construct, "goal"), *_links(project, design, place, construct), doc, remove)
        case CompetenceStep():
            first = Row(nodes=(_name_field(place, construct), field_node(construct, "retries", place.path)))
            return (first, _condition(place, construct, "when"), *_links(project, design, place, construct), doc)
        case Layer():
            head: tuple[Node, ...] = (_name_field(place, construct),)
            if construct.when or not place.is_first:
                # The lowest layer needs no condition.
                head = (Row(nodes=(*head, _time(place, construct, "hold", unit))), _condition(place, construct, "when"))
            return (*head, *_links(project, design, place, construct), doc)


def construct_adders(project: Project, design: Design) -> dict[AdderList, Any]:
    """What can be added to the lists of constructs, as JSON values; what cannot be has a reason in the menu."""
    states = interrupting_states(design)
    is_written, is_competence = has_own_states(design), design.competence is not None
    reason = "for a design without states: it defines them" if is_written else "there is already a competence"
    latch = _adder(project, design, "latches", Latch(name="latch"), "with two limits, or a minimum time")
    interrupt = (
        _adder(project, design, "interrupts", Interrupt(do=states[0]), "a rule for many states")
        if states
        else Adder(
            label="Interrupt", icon="add", adds="", title="", nodes=(), hint="needs another state that it enters"
        )
    )
    layer = _adder(project, design, "layers", Layer(name="Layer"), "behaviors of which the highest commands")
    step = _adder(project, design, "steps", CompetenceStep(name="Step"), "")
    competence = Adder(label="Competence", icon="add", adds="competence", title="", nodes=(), hint="steps to a goal")
    if is_written or is_competence:
        layer = replace(layer, adds="", hint=reason)
    if is_written or is_competence or design.layers:
        competence = replace(competence, adds="", hint="there are already layers" if design.layers else reason)
    found: dict[AdderList, list[Adder]] = {
        "latches": [latch],
        "interrupts": [interrupt] if states else [],
        "steps": [step],
        "layers": [layer],
        "constructs": [latch, interrupt, layer, competence],
    }
    return {section: json.loads(form_json(each)) for section, each in found.items()}


def _adder(project: Project, design: Design, section: str, added: Construct, hint: str) -> Adder:
    place = ItemPlace(section=section, at=(section, 1))
    card = _card(place, added, *construct_nodes(project, design, place, added))
    return Adder(label=_NOUNS[type(added)], icon="add", adds=section, title=_name(added), nodes=card.nodes, hint=hint)


def _places(design: Design, ids: ListIds) -> Iterator[tuple[ItemPlace, Construct]]:
    here = ItemPlace(path=("design",), ids=ids)
    yield from here.items("latches", design.latches)
    yield from here.items("interrupts", design.interrupts)
    if design.competence is not None:
        owner = replace(here, path=("design", "competence"), at=("competence",))
        yield owner, design.competence
        yield from owner.items("steps", design.competence.steps)
    yield from here.items("layers", design.layers)


def _origin(place: ItemPlace, construct: Construct) -> Origin:
    return place.at if isinstance(construct, Interrupt | Competence) else (*place.at[:-1], construct.name)


def _name(construct: Construct) -> str:
    return construct.do if isinstance(construct, Interrupt) else getattr(construct, "name", "")


def _card(place: ItemPlace, construct: Construct, *nodes: Node) -> Card:
    """A card of one line until a user opens it."""
    match construct:
        case Latch(on=on, off=off):
            caption = f"{on}; off: {off}" if off else on
        case Interrupt(when=when) | CompetenceStep(when=when) | Layer(when=when):
            caption = when
        case _:
            caption = ""
    title = _name(construct)
    line = Section(key=place.key, title=title, caption=caption, nodes=nodes, look="line")
    return Card(id=place.id, title=title, nodes=(line,))


def _name_field(place: ItemPlace, construct: Construct) -> ItemName:
    return ItemName(path=place.within("name"), label="Name", value=_name(construct))


def _condition(place: ItemPlace, construct: Construct, name: str) -> CodeText:
    field = known_field(construct, (name,))
    return CodeText(
        path=place.within(name),
        label=field.label,
        value=field.read(construct),
        language="expression",
        hint=field.hint,
        is_checked=field.is_checked,
    )


def _time(place: ItemPlace, construct: Construct, name: str, unit: str) -> TextField:
    node = field_node(construct, name, place.path)
    assert isinstance(node, TextField)
    return replace(node, label=f"{node.label} ({unit})")


def _links(
    project: Project, design: Design, place: ItemPlace, owner: Competence | CompetenceStep | Layer
) -> Iterator[Node]:
    """The components that are required, and modulated with parameters; none if the design uses none."""
    if design.uses or owner.requires:
        yield MultiChoice(path=place.within("requires"), label="Requires", value=owner.requires, options="uses")
    if not isinstance(owner, Competence) and (design.uses or owner.modulates):
        yield Heading(text="Modulates")
        yield modulation_cards(project, owner.modulates, place.path)
