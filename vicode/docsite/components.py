"""The page of a component: what it is, how it decides, what each state does, who uses it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from vicode.docsite.addresses import Addresses, anchor_of, state_anchor
from vicode.docsite.decisions import Places, blocks_of, pseudo_lines, transition_rows
from vicode.docsite.declarations import tables_of
from vicode.docsite.docs import html_of
from vicode.docsite.drawings import draw_around, draw_decisions, draw_design
from vicode.docsite.findings import finding_rows
from vicode.docsite.linking import Linker, listed, plain
from vicode.docsite.subject import Subject
from vicode.docsite.uses import use_rows, user_rows
from vicode.docsite.views import ActionView, ComponentView, LanguageView, Line, Part, Phase, StateView
from vicode.model.design import COMMON, Action, Assign, Call, Design, RunCode, State
from vicode.model.walks import walk_transitions

_PHASES = (("enter", "When it is entered"), ("actions", "At each iteration"), ("leave", "When it is left"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Made:
    """What the parts of a page are made with."""

    subject: Subject
    addresses: Addresses
    places: Places
    texts: tuple[Part, ...]
    languages: tuple[LanguageView, ...]


def component_view(design: Design, made: Made) -> ComponentView:
    """The whole page."""
    project, addresses = made.subject.project, made.addresses
    linker = Linker(project, addresses, design)
    common = design.common
    has_common = bool(common.transitions or common.actions or common.doc)
    transitions = tuple(transition_rows(design, linker, addresses))
    codes = (("Module", design.module), ("Members", design.members))
    return ComponentView(
        name=design.component,
        doc_html=html_of(design.doc),
        facts=tuple(_facts(design)),
        svg=draw_design(design, addresses),
        legend=(),
        transitions=tuple(tuple(rows) for _source, rows in groupby(transitions, key=lambda row: row.source)),
        columns=frozenset(name for row in transitions for name in ("timer", "doc_html") if getattr(row, name)),
        common=_common(design, linker, made) if has_common else None,
        states=tuple(_state(design, state, linker, made) for state in design.states),
        around_svg=draw_around(design, project, addresses),
        uses=tuple(use_rows(design, linker)),
        used_by=tuple(user_rows(project, design.component, addresses)),
        agents=listed(
            Part(text=agent.title or agent.name, href=addresses.agent(agent.name))
            for agent in project.agents
            if agent.root == design.component
        ),
        tables=tuple(tables_of(design, linker)),
        shared_code=tuple((title, blocks_of(code)) for title, code in codes if code.texts),
        findings=finding_rows(made.subject, addresses, design.component),
        texts=made.texts,
        languages=made.languages,
    )


def _facts(design: Design) -> Iterator[Line]:
    count = len(design.states)
    yield plain(f"{count} state{'s' * (count != 1)}")
    if design.frequency_hz is not None:
        yield plain(f"works {design.frequency_hz:g} times a second")
    else:
        yield plain("works at every step it is given")
    if design.resume:
        yield plain("goes on where it was when it works again")
    if design.xabsl_name:
        yield (Part(text="in XABSL "), Part(text=design.xabsl_name, kind="code"))


def _state(design: Design, state: State, linker: Linker, made: Made) -> StateView:
    sources = dict.fromkeys(each.source for each in walk_transitions(design) if _leads(each.decision, state.name))
    words = []
    if state.name == design.initial:
        words.append("initial")
    words += [word for word in ("final", "disabled") if getattr(state, word)]
    words += [f"{word} {getattr(state, word):g}" for word in ("capacity", "synchronized") if getattr(state, word)]
    tree_svg, is_folded = draw_decisions(
        state.transitions, ("states", state.name, "transitions"), design, made.addresses
    )
    phases = [Phase(title=title, actions=tuple(_actions(getattr(state, name), linker))) for name, title in _PHASES]
    phases.insert(2, Phase(title="Modulates", actions=tuple(_actions(state.modulates, linker))))
    return StateView(
        anchor=state_anchor(state.name),
        name=state.name,
        words=tuple(words),
        doc_html=html_of(state.doc, below=3),
        requires=listed(linker.alias(alias) for alias in state.requires),
        phases=tuple(phase for phase in phases if phase.actions),
        pseudo=pseudo_lines(state.transitions, linker, ("states", state.name, "transitions"), made.places),
        comes_from=listed(
            Part(text="every state", href="#common") if source == COMMON else linker.state(source) for source in sources
        ),
        places=made.places.get(("states", state.name), ()),
        tree_svg=tree_svg,
        is_folded=is_folded,
    )


def _common(design: Design, linker: Linker, made: Made) -> StateView:
    actions = tuple(_actions(design.common.actions, linker))
    tree_svg, is_folded = draw_decisions(design.common.transitions, ("common", "transitions"), design, made.addresses)
    return StateView(
        anchor=anchor_of(("common",)),
        name="Every state",
        words=("common",),
        doc_html=html_of(design.common.doc, below=3),
        requires=(),
        phases=(Phase(title="At each iteration, first", actions=actions),) if actions else (),
        pseudo=pseudo_lines(design.common.transitions, linker, ("common", "transitions"), made.places),
        comes_from=(),
        places=made.places.get(("common",), ()),
        tree_svg=tree_svg,
        is_folded=is_folded,
    )


def _leads(decision: object, name: str) -> bool:
    return getattr(decision, "to", None) == name


def _actions(actions: Sequence[Action], linker: Linker) -> Iterator[ActionView]:
    for action in actions:
        match action:
            case Assign(values=values):
                for name, text in values:
                    yield ActionView(line=(*linker.expression(name), Part(text=" = "), *linker.expression(text)))
            case Call():
                yield ActionView(line=call_line(action, linker))
            case RunCode(code=code):
                yield ActionView(blocks=blocks_of(code))


def call_line(call: Call, linker: Linker) -> Line:
    """A component with its parameters."""
    parts: list[Part] = [linker.alias(call.alias), Part(text="(")]
    for index, (name, text) in enumerate(call.arguments):
        parts += [Part(text=", ")] if index else []
        parts += [linker.parameter(call.alias, name), Part(text="="), *linker.expression(text)]
    return (*parts, Part(text=")"))
