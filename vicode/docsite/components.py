"""The page of a state machine: diagram, transitions, states, users and declarations."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, islice

from vicode.analysis.examples import describe_value
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.overlaps import find_overlaps
from vicode.analysis.properties import judge_properties
from vicode.check.properties import describe_judgement
from vicode.docsite.decisions import CodeLinks, code_blocks, numbered_decisions, pseudocode_lines, transition_rows
from vicode.docsite.diagrams import draw_decision_tree, draw_design, draw_neighborhood
from vicode.docsite.doc_text import render_doc
from vicode.docsite.findings import finding_rows
from vicode.docsite.name_linker import NameLinker, join_spans, plain_text
from vicode.docsite.site_input import SiteInput
from vicode.docsite.urls import SiteUrls, path_anchor, state_anchor
from vicode.docsite.uses import use_rows
from vicode.docsite.views import (
    ActionPhaseView,
    ActionView,
    ComponentPageView,
    DeclarationTable,
    LanguageView,
    RichText,
    StateView,
    TextSpan,
    UseRow,
)
from vicode.model.design import COMMON, Action, Assign, Call, Design, RunCode, State, Transition
from vicode.model.words import describe_constructs, describe_fields, describe_property

_PHASES = {"enter": "On entry", "actions": "In each iteration", "leave": "On exit"}
_MOST_DECISIONS, _MOST_OVERLAPS = 12, 3
_SHOWN = (
    *("component", "doc", "xabsl_name", "frequency_hz", "resume", "arithmetic", "time_unit", "initial"),
    *("color", "requires"),
)
"""The fields of designs and states that a page does not show as a fact or badge."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentInputs:
    """The inputs of the page of a component."""

    site_input: SiteInput
    urls: SiteUrls
    tables: tuple[DeclarationTable, ...]
    used_by: tuple[UseRow, ...]
    agents: RichText
    code_links: CodeLinks
    code_pages: tuple[TextSpan, ...]
    languages: tuple[LanguageView, ...]
    try_script: str
    not_tried: RichText


def component_view(design: Design, inputs: ComponentInputs) -> ComponentPageView:
    project, addresses = inputs.site_input.project, inputs.urls
    linker = NameLinker(project, addresses, design)
    machine = MachineAnalysis(project, design)
    common = design.common
    has_common = bool(common.transitions or common.actions or common.doc)
    transitions = tuple(transition_rows(design, linker, addresses))
    codes = (("Module", design.module), ("Members", design.members))
    return ComponentPageView(
        name=addresses.names.component(design.component),
        doc_html=render_doc(design.doc),
        facts=tuple(_facts(design, inputs)),
        svg=draw_design(design, addresses),
        legend=(),
        transitions=tuple(tuple(rows) for _source, rows in groupby(transitions, key=lambda row: row.source)),
        columns=frozenset(name for row in transitions for name in ("timer", "doc_html") if getattr(row, name)),
        properties=tuple(
            (describe_property(each.promised), describe_judgement(each))
            for each in judge_properties(project, design, may_search=False)
        ),
        common=_common(design, linker, inputs) if has_common else None,
        states=tuple(_state(machine, state, linker, inputs) for state in design.states),
        neighborhood_svg=draw_neighborhood(design, project, addresses),
        uses=tuple(use_rows(design, linker)),
        used_by=inputs.used_by,
        root_of=join_spans(
            TextSpan(text=agent.title or agent.name, href=addresses.agent(agent.name))
            for agent in project.agents
            if agent.root == design.component
        ),
        agents=inputs.agents,
        tables=inputs.tables,
        custom_code=tuple((title, code_blocks(code)) for title, code in codes if code.texts),
        findings=finding_rows(inputs.site_input, addresses, design.component),
        code_pages=inputs.code_pages,
        languages=inputs.languages,
        try_script=inputs.try_script,
        not_tried=inputs.not_tried,
    )


def _facts(design: Design, inputs: ComponentInputs) -> Iterator[RichText]:
    source = inputs.site_input.sources.get(design.component)
    is_xabsl = inputs.urls.names.is_xabsl
    if source:
        line = source.nearest_line(("component",))
        href = inputs.urls.code(design.component, "source") + (f"#L{line}" if line else "")
        yield (TextSpan(text=f"{source.path}:{line}" if line else source.path, href=href, css_class="code"),)
    count = len(design.states)
    yield plain_text(f"{count} state{'s' * (count != 1)}")
    if design.frequency_hz is not None:
        yield plain_text(f"runs at {design.frequency_hz:g} Hz")
    elif not is_xabsl:
        yield plain_text("runs on every step")
    if design.resume:
        yield plain_text("resumes where it left off")
    if design.xabsl_name and not is_xabsl:
        yield (TextSpan(text="in XABSL "), TextSpan(text=design.xabsl_name, css_class="code"))
    yield from map(plain_text, (*describe_fields(design, _SHOWN), *describe_constructs(design)))


def _state(machine: MachineAnalysis, state: State, linker: NameLinker, made: ComponentInputs) -> StateView:
    design = machine.design
    words = ("initial",) if state.name == design.initial else ()
    tree_svg, is_folded = draw_decision_tree(
        state.transitions, ("states", state.name, "transitions"), design, made.urls
    )
    # XABSL has no other actions.
    titles = _PHASES | ({"actions": "Actions"} if linker.is_xabsl else {})
    phases = [
        ActionPhaseView(title=title, actions=tuple(_actions(getattr(state, name), linker)))
        for name, title in titles.items()
    ]
    phases.insert(2, ActionPhaseView(title="Modulates", actions=tuple(_actions(state.modulates, linker))))
    return StateView(
        anchor=state_anchor(state.name),
        name=linker.state_name(state),
        badges=(*words, *describe_fields(state, _SHOWN)),
        doc_html=render_doc(state.doc, parent_level=3),
        facts=tuple((title, parts) for title, parts in _state_facts(machine, state, linker) if parts),
        phases=tuple(phase for phase in phases if phase.actions),
        pseudocode=pseudocode_lines(state.transitions, linker, ("states", state.name, "transitions"), made.code_links),
        code_links=made.code_links.get(("states", state.name), ()),
        tree_svg=tree_svg,
        is_folded=is_folded,
    )


def _state_facts(machine: MachineAnalysis, state: State, linker: NameLinker) -> Iterator[tuple[str, RichText]]:
    design = machine.design
    every_state = TextSpan(text="every state", href="#common")
    entries: dict[str, list[TextSpan]] = {}
    exits: dict[str, list[TextSpan]] = {}
    for order, located in numbered_decisions(design):
        if isinstance(located.decision, Transition):
            link = TextSpan(text=str(order), href=f"#{path_anchor(located.path)}")
            if located.decision.to == state.name:
                entries.setdefault(located.source, []).append(link)
            if located.source == state.name and located.decision.to != state.name:
                exits.setdefault(located.decision.to, []).append(link)
    if state.name == design.initial:
        yield "Entered", (TextSpan(text="when the option starts" if linker.is_xabsl else "when the component starts"),)
    yield (
        "Entered from",
        _numbered_links(
            (every_state if each == COMMON else linker.state(each), found) for each, found in entries.items()
        ),
    )
    yield "Leads to", _numbered_links((linker.state(each), found) for each, found in exits.items())
    if design.common.transitions:
        yield "Tested first", (TextSpan(text="common transitions", href="#common"),)
    yield from _times(state, machine, linker)
    yield "Can hold together", _overlaps(state, machine, linker)
    yield "Requires", join_spans(linker.alias(alias) for alias in state.requires)


def _times(state: State, machine: MachineAnalysis, linker: NameLinker) -> Iterator[tuple[str, RichText]]:
    """How long the state lasts whatever the inputs are, as the guards prove."""
    time = machine.time_in(state.name) if machine.live.get(state.name) else None
    if time is None:
        return
    ns_per_unit = machine.guards.conditions.table.ns_per_unit
    if time.at_least_ns:
        yield "Lasts at least", linker.duration(f"{time.at_least_ns / ns_per_unit:.6g}")
    if time.at_most_ns == 0:
        yield "Lasts", (TextSpan(text="one iteration"),)
    elif time.at_most_ns is not None:
        yield "Lasts at most", linker.duration(f"{time.at_most_ns / ns_per_unit:.6g}")


def _overlaps(state: State, machine: MachineAnalysis, linker: NameLinker) -> RichText:
    """Guards that can hold together, if they are few; the first one of a pair is taken."""
    if state.disabled or len(state.transitions) > _MOST_DECISIONS:
        return ()
    found = tuple(islice(find_overlaps(machine.guards, state.name), _MOST_OVERLAPS + 1))
    if not 0 < len(found) <= _MOST_OVERLAPS:
        return ()
    orders = {located.path: str(order) for order, located in numbered_decisions(machine.design)}
    parts: list[TextSpan] = []
    for first, second, example in found:
        links = [TextSpan(text=orders[path], href=f"#{path_anchor(path)}") for path in (first, second)]
        parts += [TextSpan(text="; ")] if parts else []
        parts += [links[0], TextSpan(text=" and "), links[1], TextSpan(text=", with ")]
        for index, (name, value) in enumerate(example.items()):
            parts += [TextSpan(text=", ")] if index else []
            parts += [*linker.expression(name), TextSpan(text=f" = {describe_value(value)}")]
    return (*parts, TextSpan(text=": the first one is taken"))


def _numbered_links(found: Iterable[tuple[TextSpan, Sequence[TextSpan]]]) -> RichText:
    """States, each with links to its transitions."""
    parts: list[TextSpan] = []
    for state, links in found:
        parts += [TextSpan(text=", ")] if parts else []
        parts += [state, TextSpan(text=" ("), *join_spans(links), TextSpan(text=")")]
    return tuple(parts)


def _common(design: Design, linker: NameLinker, made: ComponentInputs) -> StateView:
    actions = tuple(_actions(design.common.actions, linker))
    title = "Common actions" if linker.is_xabsl else "In each iteration, before the state's actions"
    tree_svg, is_folded = draw_decision_tree(design.common.transitions, ("common", "transitions"), design, made.urls)
    return StateView(
        anchor=path_anchor(("common",)),
        name="Every state",
        badges=("common", *describe_fields(design.common, _SHOWN)),
        doc_html=render_doc(design.common.doc, parent_level=3),
        facts=(),
        phases=(ActionPhaseView(title=title, actions=actions),) if actions else (),
        pseudocode=pseudocode_lines(design.common.transitions, linker, ("common", "transitions"), made.code_links),
        code_links=made.code_links.get(("common",), ()),
        tree_svg=tree_svg,
        is_folded=is_folded,
    )


def _actions(actions: Sequence[Action], linker: NameLinker) -> Iterator[ActionView]:
    for action in actions:
        match action:
            case Assign(values=values):
                for name, text in values:
                    value = linker.expression(text, linker.symbol_type(name))
                    yield ActionView(text=(*linker.symbol(name), TextSpan(text=" = "), *value))
            case Call():
                yield ActionView(text=call_text(action, linker))
            case RunCode(code=code):
                yield ActionView(blocks=code_blocks(code))
        for fact in describe_fields(action, ("values", "alias", "arguments")):
            yield ActionView(text=plain_text(fact))


def call_text(call: Call, linker: NameLinker) -> RichText:
    parts: list[TextSpan] = [linker.alias(call.alias), TextSpan(text="(")]
    for index, (name, text) in enumerate(call.arguments):
        parts += [TextSpan(text=", ")] if index else []
        value = linker.expression(text, linker.parameter_type(call.alias, name))
        parts += [linker.parameter(call.alias, name), TextSpan(text=" = " if linker.is_xabsl else "="), *value]
    return (*parts, TextSpan(text=")"))
