"""The forms of latches, interrupts, the competence and layers (`vicode.model.lowering`).

The form of the design lists them. Forms of the states and transitions that are derived from one show it as a part.
The paths of its fields are the same everywhere, such as "design/latches/0/on": each edit is one of the design.
"""

import json
from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Any, Literal

from vicode.editor.session.forms.action_form import modulation_cards
from vicode.editor.session.forms.decision_form import decision_target, decision_title
from vicode.editor.session.forms.fields import field_node, known_field
from vicode.editor.session.forms.item_place import ItemPlace
from vicode.editor.session.forms.list_ids import ListIds, noun_of
from vicode.editor.session.forms.nodes import (
    Adder,
    AdderList,
    Button,
    Card,
    Cards,
    Choice,
    CodeText,
    ConstructList,
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
from vicode.model.construct_edits import new_construct
from vicode.model.design import (
    INTERRUPT_ENDS,
    Competence,
    CompetenceStep,
    Decision,
    Design,
    Interrupt,
    Latch,
    Layer,
    Origin,
    State,
)
from vicode.model.project import Project
from vicode.model.traversal import Construct

_KINDS: tuple[tuple[ConstructList, str, str, str], ...] = (
    ("latches", "Latches", "conditions with two limits or a minimum time", ""),
    ("interrupts", "Interrupts", "rules for many states, the first is most urgent", "needs a state that it can enter"),
    ("competence", "Competence", "steps towards a goal", "needs a design without states"),
    ("steps", "Steps", "the first one that is possible is done", ""),
    ("layers", "Layers", "the last one whose condition holds commands", "needs a design without states"),
)
"""The lists with their titles, hints, and the reason why nothing can be added."""
_CONDITIONS = ("goal", "on", "off", "when", "until")
_SMALL_FIELDS = {"hold": "none", "during": "all other states", "every": "no limit", "retries": "no limit"}


def construct_lists(design: Design, ids: ListIds) -> tuple[Node, ...]:
    """The lists of all constructs, without headings while they are empty."""
    nodes: list[Node] = []
    for section, title, hint, _reason in _KINDS:
        items = [(place, each) for place, each in _places(design, ids) if place.section == section]
        is_shown = bool(items) or (section == "steps" and design.competence is not None)
        nodes += [Heading(text=title, hint=hint)] if is_shown else []
        if section == "competence":
            nodes += (FormPart(form=place.key) for place, _competence in items)
            continue
        cards = tuple(_card(place, each, FormPart(form=place.key)) for place, each in items)
        adders: AdderList | Literal[""] = section if is_shown else ""
        path = ("design", *(("competence",) if section == "steps" else ()), section)
        nodes.append(Cards(path=path, cards=cards, adders=adders, noun=noun_of(section), is_ordered=True))
    return tuple(nodes)


def construct_parts(project: Project, design: Design, ids: ListIds) -> dict[str, tuple[Node, ...]]:
    """The form of each construct, by its key in the forms."""
    return {place.key: tuple(_nodes(project, design, place, each)) for place, each in _places(design, ids)}


def construct_adders(project: Project, design: Design) -> dict[AdderList, Any]:
    """What can be added to the lists of constructs, as JSON values; if nothing can be, the menu says why."""
    found: dict[AdderList, Adder] = {}
    for section, _title, hint, reason in _KINDS:
        path = ("competence", section) if section == "steps" else (section,)
        added, place = new_construct(design, path, ""), ItemPlace(section=section, at=(section, len(design.layers)))
        card = _card(place, added, *_nodes(project, design, place, added)) if added else Card(id="", title="", nodes=())
        found[section] = Adder(
            label=noun_of(section).capitalize(),
            icon="add",
            adds=section if added else "",
            title=card.title,
            nodes=() if section == "competence" else card.nodes,
            hint=hint if added else reason,
        )
    lists: dict[AdderList, list[Adder]] = {section: [each] if each.nodes else [] for section, each in found.items()}
    lists["constructs"] = [each for section, each in found.items() if section != "steps"]
    return {section: json.loads(form_json(each)) for section, each in lists.items()}


def interrupt_ends(design: Design) -> list[str]:
    """What can follow an interrupt."""
    return [*INTERRUPT_ENDS, *(state.name for state in design.states)]


def derived_state_form(design: Design, ids: ListIds, state: State) -> tuple[Node, ...]:
    """The form of a state that is derived from a step, a layer or the competence: that of its construct."""
    origin = _origin_nodes(design, ids, state.origin)
    return (Title(text="State", name=state.name, is_hidden=True), Notice(path=OUTSIDE), *origin) if origin else ()


def derived_decision_form(design: Design, ids: ListIds, source: str, decision: Decision) -> tuple[Node, ...]:
    """What a derived decision says, and the form of its construct or a link to the state that shows it."""
    match getattr(decision, "origin", ()):
        case ():
            return ()
        case ("competence", "steps", str(name)) | ("layers", str(name)):
            link = ItemLink(label="Derived from", caption=name, opens=("states", name))
            origin: tuple[Node, ...] = (link,)
        case ("interrupts", int(number)) as part:
            # Its transitions are drawn as one.
            do = design.interrupts[number].do
            (_heading, *form) = _origin_nodes(design, ids, part)
            return (Title(text="Interrupt by", name=do, opens=("states", do)), *form)
        case part:
            origin = _origin_nodes(design, ids, part)
    text = f"{decision_target(decision)} – {guard_label(decision.guard, design.time_unit) or 'always'}"
    return (decision_title(source, decision), Paragraph(text=text, look="small mono"), *origin)


def _origin_nodes(design: Design, ids: ListIds, origin: Origin) -> tuple[Node, ...]:
    places = {_origin(place, each): place for place, each in _places(design, ids)} if origin else {}
    place = places.get(origin)
    title = noun_of(place.section).capitalize() if place else ""
    return (Heading(text=title, hint="what this is derived from"), FormPart(form=place.key)) if place else ()


def _places(design: Design, ids: ListIds) -> Iterator[tuple[ItemPlace, Construct]]:
    here = ItemPlace(path=("design",), ids=ids)
    yield from here.items("latches", design.latches)
    yield from here.items("interrupts", design.interrupts)
    if design.competence is not None:
        owner = replace(here, path=("design", "competence"), at=("competence",), section="competence")
        yield owner, design.competence
        yield from owner.items("steps", design.competence.steps)
    yield from here.items("layers", design.layers)


def _origin(place: ItemPlace, construct: Construct) -> Origin:
    return place.at if isinstance(construct, Interrupt | Competence) else (*place.at[:-1], construct.name)


def _card(place: ItemPlace, construct: Construct, *nodes: Node) -> Card:
    """A card of one line until a user opens it."""
    title = getattr(construct, "do", "") or getattr(construct, "name", "")
    caption = getattr(construct, "on", "") or getattr(construct, "when", "")
    line = Section(key=place.key, title=title, caption=caption, nodes=nodes, look="line")
    return Card(id=place.id, title=title, nodes=(line,))


def _nodes(project: Project, design: Design, place: ItemPlace, construct: Construct) -> Iterator[Node]:
    """The fields of a construct: names and times, conditions, components, description."""
    first: list[Node] = []
    if isinstance(construct, Interrupt):
        then = known_field(construct, ("then",)).read(construct)
        first.append(Choice(path=place.within("do"), label="Do", value=construct.do, options="states"))
        first.append(Choice(path=place.within("then"), label="Then", value=then, options="ends"))
    elif not isinstance(construct, Competence):
        first.append(ItemName(path=place.within("name"), label="Name", value=construct.name))
    # The lowest layer commands if no other does.
    is_lowest = isinstance(construct, Layer) and place.is_first and not construct.when
    names = [] if is_lowest else [each.name for each in fields(construct)]
    first += (_small_field(design, place, construct, name) for name in _SMALL_FIELDS if name in names)
    yield Row(nodes=tuple(first))
    for name in (each for each in _CONDITIONS if each in names):
        field, path = known_field(construct, (name,)), place.within(name)
        value, label = field.read(construct), name.capitalize()
        yield CodeText(path=path, label=label, value=value, language="expression", hint=field.help, is_checked=True)
    if not isinstance(construct, Latch | Interrupt) and (design.uses or construct.requires):
        requires = construct.requires
        yield MultiChoice(path=place.within("requires"), label="Requires", value=requires, options="uses")
    if isinstance(construct, CompetenceStep | Layer) and (design.uses or construct.modulates):
        yield Heading(text="Modulates")
        yield modulation_cards(project, construct.modulates, place.path)
    yield field_node(construct, "doc", place.path)
    if isinstance(construct, Competence):
        yield Button(label="Remove competence", icon="close", action="remove-card", path=place.path)


def _small_field(design: Design, place: ItemPlace, construct: Construct, name: str) -> Node:
    # Names are applied when they are finished: a part of one is another pattern.
    node = replace(field_node(construct, name, place.path, is_committed=name == "during"), hint=_SMALL_FIELDS[name])
    unit = f" ({design.time_unit or 's'})" if name in ("hold", "every") else ""
    return replace(node, help="", label=node.label + unit) if isinstance(node, TextField) else node
