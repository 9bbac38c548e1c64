"""Imports SCXML: states inside states become states of one design, and regions of <parallel> designs of their own."""

import re
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass, field, replace

from vicode.importers.design_names import DesignNames
from vicode.importers.scxml.actions import ActionWriter
from vicode.importers.scxml.ecmascript import check_expression, translate
from vicode.importers.scxml.events import KEYWORDS, EventInputs, matches, plain
from vicode.importers.scxml.queue import EVENTS_ALIAS, EventComponent
from vicode.importers.scxml.reader import ScxmlError, read_scxml
from vicode.importers.scxml.regions import check_regions, data_homes, done_event
from vicode.importers.scxml.report import START, Exactness, Reached, ReportWriter, TransitionReport
from vicode.importers.scxml.states import ScxmlState, read_states
from vicode.importers.xml_reader import Element
from vicode.model.design import Action, Call, Decision, Design, Guard, State, Stay, Transition, Use
from vicode.model.expressions import build_scope
from vicode.model.names import name_from_text, snake_case
from vicode.model.project import Project
from vicode.model.traversal import iter_expressions

__all__ = ["EventComponent", "Exactness", "ScxmlError", "ScxmlImport", "TransitionReport", "import_scxml"]

_EVENT = re.compile(r'[^\s"\\\x00-\x1f]+')
_AFTER = "after "
_TAKEN = frozenset({"is_done"})
# Attributes of the document, and of <log>, which has no effect.
_KNOWN = ("version", "name", "datamodel", "binding", "label", "expr")
# Names in the classes of the queue.
_TAKEN_BY_QUEUE = _TAKEN | {
    *("hold", "post", "restart", "work", "collect", "send", "delay", "cancel", "find", "output", "eventqueue"),
    *("events", "sentevent"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ScxmlImport:
    """A project: the design of the document, then those of the regions of <parallel>.

    Attributes:
        transitions: How exact the transitions of the document are, in document order.
        notes: What else differs.
        events: The component that provides the events.
    """

    project: Project
    transitions: tuple[TransitionReport, ...]
    notes: tuple[tuple[int, str], ...]
    events: EventComponent


def import_scxml(data: bytes, component: str, name: str, *, has_queue: bool = False) -> ScxmlImport:
    """Convert a document to a project.

    A state of a design stands for a state of the document without children, or for a parallel state, which calls the
    designs of its regions; the transitions of the states around it follow its own. Entering and leaving states around
    it, and the content of transitions, are actions of a state in between. Events are inputs.

    Args:
        data: The content of the file.
        component: The name of the component.
        name: The name of the project.
        has_queue: Whether events arrive through a queue, so that none is lost.

    Raises:
        ScxmlError: The document cannot be expressed as a design.
    """
    designs = read_states(read_scxml(data), has_queue=has_queue)
    states = [state for root, by_name in designs.items() for state in (root, *by_name.values())]
    check_regions(states)
    actions = ActionWriter.of_document(states, has_queue=has_queue)
    homes, outputs = data_homes(states, actions.names)
    own = set() if has_queue else {*actions.timers, *filter(None, map(done_event, states))}
    inputs = EventInputs.of_descriptors(_descriptors(states, own), _TAKEN_BY_QUEUE if has_queue else _TAKEN)
    events = EventComponent.of_inputs(inputs, component, has_queue=has_queue)
    actions.events = events if has_queue else None
    regions = _name_regions(designs, actions, frozenset({component, events.name, events.sent_type}))
    aliases, report = {name: use.alias for name, use in regions.items()}, ReportWriter()
    written = [
        _Importer(
            document=root,
            by_name=by_name,
            actions=actions.for_design(root, homes, aliases),
            events=events,
            report=report,
            regions=regions,
            outputs=outputs,
        ).convert(regions[root.name].component if root.caller else component)
        for root, by_name in designs.items()
    ]
    project = Project(
        name=name,
        languages=("python", "cpp"),
        enumerations=events.enumerations(),
        components=events.interfaces(),
        designs=tuple(written),
    )
    _check(project, states[0].line)
    transitions, found = report.write([*actions.timers.values()], has_queue=has_queue, has_events=bool(inputs.names))
    notes = tuple(sorted({*found, *states[0].element.unread(_KNOWN)}))
    return ScxmlImport(project=project, transitions=transitions, notes=notes, events=events)


def _name_regions(roots: Iterable[ScxmlState], actions: ActionWriter, classes: frozenset[str]) -> dict[str, Use]:
    variables = (*actions.names.values(), *(each.variable for each in actions.timers.values()))
    components, aliases, regions = (
        DesignNames(classes),
        DesignNames(frozenset({EVENTS_ALIAS, *variables}), KEYWORDS),
        {},
    )
    for name in (each.name for each in roots if each.caller):
        text = name_from_text(name) or name
        regions[name] = Use(alias=aliases.allocate(snake_case(name)), component=components.allocate(text))
    return regions


def _check(project: Project, line: int) -> None:
    for design in project.designs:
        scope = build_scope(project, design)
        types = {each.name: each.type for each in design.variables}
        for each in iter_expressions(design):
            check_expression(each.text, scope, each.expected or types.get(str(each.path[-1]), ""), line)


def _descriptors(states: Iterable[ScxmlState], own: Container[str]) -> Iterator[str]:
    """The descriptors of all transitions; without a queue, except the events that the document itself causes."""
    for transition in (each for state in states for each in state.transitions()):
        for written in transition.get("event", "").split():
            if not _EVENT.fullmatch(written):
                raise ScxmlError("S803", f"'{written}' is not the name of an event", transition.line)
            if plain(written) not in own:
                yield written


@dataclass(slots=True, kw_only=True)
class _Importer:
    """Writes the design of `document`, which is the document or a region. `regions` are the designs by state."""

    document: ScxmlState
    by_name: dict[str, ScxmlState]
    actions: ActionWriter
    events: EventComponent
    report: ReportWriter
    regions: dict[str, Use]
    outputs: set[str]
    names: DesignNames = field(default_factory=lambda: DesignNames(keywords=KEYWORDS))
    _states: dict[str, str] = field(default_factory=dict)
    _between: dict[tuple[tuple[Action, ...], str], State] = field(default_factory=dict)

    @property
    def has_queue(self) -> bool:
        return self.events.has_queue

    def convert(self, component: str) -> Design:
        leaves = [state for state in self.by_name.values() if state.is_atomic]
        for leaf in leaves:
            self._states[leaf.name] = self.names.allocate(leaf.name)
        states = [self._leaf(leaf) for leaf in leaves]
        leaf, entered = self._enter(self.document)
        first = next(state for state in states if state.name == self._states[leaf.name])
        is_region = self.document.caller is not None
        if is_region:
            entered = (*self.actions.write(self.document.content("onentry"), self.document), *entered)
            self.report.starts[self.document] = leaf
        # A region starts in the iteration of the event that enters it, which its first state must not take.
        is_forced = is_region or bool(leaf.regions) or (self.has_queue and bool(first.actions))
        initial = self._go_to(entered, leaf, START, is_forced=is_forced).to
        if initial != self._states[leaf.name] and not is_region:
            self.report.add_start(leaf, self.document.line)
        called = tuple(self.regions[region.name] for state in leaves for region in state.regions)
        design = Design(
            component=component,
            uses=(*self.events.uses(), *called),
            outputs=self.actions.declarations(self.outputs, of_outputs=True),
            variables=self.actions.declarations(self.outputs),
            initial=initial,
            states=tuple(self.events.number_sent([*states, *self._between.values()])),
        )
        reads_events = any(f"{EVENTS_ALIAS}." in each.text for each in iter_expressions(design))
        return design if reads_events or not is_region else replace(design, uses=called)

    def _leaf(self, leaf: ScxmlState) -> State:
        is_end = leaf.is_final and leaf.parent is self.document
        decided = [] if is_end and self.document.caller is None else list(self._decisions(leaf))
        enter, actions = self.actions.write(leaf.content("onentry"), leaf), list[Action]()
        if self.has_queue:
            enter += tuple(self.events.sending(done_event(leaf), internal=True))
            first = [decision.guard.when or "true" for decision, is_eventless in decided if is_eventless]
            actions += [self.events.holding(_any_of(first))] if first else []
        return State(
            name=self._states[leaf.name],
            doc=f"In {leaf.parent.name}." if leaf.parent is not None and leaf.parent is not self.document else "",
            final=is_end,
            modulates=tuple(Call(alias=self.regions[each.name].alias) for each in leaf.regions),
            requires=(EVENTS_ALIAS,) if self.has_queue and not is_end else (),
            enter=enter,
            actions=tuple(actions),
            leave=self.actions.write(leaf.content("onexit"), leaf),
            transitions=tuple(decision for decision, _is_eventless in decided),
        )

    def _decisions(self, leaf: ScxmlState) -> Iterator[tuple[Decision, bool]]:
        """The decisions in the order of SCXML, each with whether it needs no event.

        First transitions without event, then those for events of the document itself, then others; among these, those
        of inner states before those of the states around them.
        """
        found = [(owner, each) for owner in leaf.ancestors() for each in owner.transitions()]
        found.sort(key=lambda pair: self._rank(leaf, pair[1]))
        used: set[str] = set()
        for owner, transition in found:
            guard = self._guard(leaf, transition, used)
            if guard is None:
                continue
            is_eventless = not transition.get("event")
            yield self._decision(leaf, owner, transition, guard), is_eventless
            if guard.is_empty:
                return

    def _is_own(self, leaf: ScxmlState, transition: Element) -> bool:
        """Whether SCXML takes a transition before the next event from outside."""
        descriptors = transition.get("event", "").split()
        own = [*self.actions.sent_at_once, *filter(None, [done_event(leaf)])]
        return not descriptors or any(matches(each, event) for each in descriptors for event in own)

    def _rank(self, leaf: ScxmlState, transition: Element) -> int:
        descriptors = transition.get("event", "").split()
        if not descriptors:
            return 0
        done = "" if self.has_queue else done_event(leaf)
        return 1 if done and any(matches(each, done) for each in descriptors) else 2

    def _guard(self, leaf: ScxmlState, transition: Element, used: set[str]) -> Guard | None:
        """The guard; None if the transition can never be taken in this state.

        `used` are events of the document itself that a transition without target has taken.
        """
        inside = leaf.active()
        events, after, terms = transition.get("event", "").split(), "", list[str]()
        if events:
            own = {} if self.has_queue else self._own_events(events, leaf, used)
            if own and not transition.get("target"):
                used.update(_check_unconditional(transition, own))
                own = {}
            parts = list(dict.fromkeys(name for event in events for name in self.events.inputs.matched_by(event)))
            parts = [*own.values(), *(f"{EVENTS_ALIAS}.{name}" for name in parts)]
            if not parts:
                return None
            if len(parts) == 1 and parts[0].startswith(_AFTER):
                after, parts = parts[0].removeprefix(_AFTER), []
            if "true" not in parts and parts:
                terms.append(" or ".join(parts))
        condition = transition.get("cond", "")
        if condition:
            text = translate(condition, self.actions.names, inside.__contains__, transition.line)
            if text == "false":
                return None
            terms += [text] if text != "true" else []
        return Guard(
            when=" and ".join(f"({each})" if len(terms) > 1 and " or " in each else each for each in terms), after=after
        )

    def _own_events(self, descriptors: list[str], leaf: ScxmlState, used: set[str]) -> dict[str, str]:
        """The events of the document itself that may occur in a state, with their conditions."""
        inside = list(leaf.ancestors())
        done = " and ".join(f"done({self.regions[each.name].alias})" for each in leaf.regions) or "true"
        conditions = {done_event(leaf): done} if done_event(leaf) else {}
        for event, timer in self.actions.timers.items():
            if timer.state is leaf:
                conditions[event] = f"{_AFTER}{timer.seconds}"
            elif timer.state in inside:
                conditions[event] = f"component_time - {timer.variable} >= {timer.seconds}"
        return {
            event: condition
            for event, condition in conditions.items()
            if event not in used and any(matches(each, event) for each in descriptors)
        }

    def _decision(self, leaf: ScxmlState, owner: ScxmlState, transition: Element, guard: Guard) -> Decision:
        target = transition.get("target", "").strip()
        if not target:
            if any(child.tag != "log" for child in transition.find()):
                fix = "give it a target, or assign on entry of a state"
                reason = "a transition without a target that assigns: actions belong to states"
                raise ScxmlError("S802", reason, transition.line, fix)
            self.report.add(leaf, owner, transition)
            return Stay(guard=guard)
        if " " in target or target not in self.by_name:
            known = "a design is in one state at a time" if " " in target else f"unknown state '{target}'"
            raise ScxmlError("S803", known, transition.line)
        to = self.by_name[target]
        domain = _domain(owner, to, is_internal=transition.get("type") == "internal")
        left = [state for state in leaf.ancestors() if state is not leaf]
        passed = [state for state in left if domain in [*state.ancestors()][1:]]
        actions = [action for state in passed for action in self.actions.write(state.content("onexit"), state)]
        actions += self.actions.write(transition.find(), owner)
        end, entered = self._enter(to, below=domain)
        step = self._go_to((*actions, *entered), end, f"{self._states[leaf.name]}_to", is_forced=end is leaf)
        reached = Reached(
            end=end, is_later=step.to != self._states[end.name], is_own=self._is_own(leaf, transition), domain=domain
        )
        self.report.add(leaf, owner, transition, reached)
        return Transition(to=step.to, guard=guard)

    def _enter(self, target: ScxmlState, below: ScxmlState | None = None) -> tuple[ScxmlState, tuple[Action, ...]]:
        """The state without children that is entered, and the actions before its own."""
        actions: list[Action] = []
        path = [state for state in target.ancestors() if state is not self.document]
        above = set(map(id, below.ancestors())) if below is not None else set()
        order = [state for state in reversed(path) if id(state) not in above]
        state = target
        while True:
            for each in order:
                if not each.is_atomic:
                    actions += self.actions.write(each.content("onentry"), each)
            if state.is_atomic:
                return state, tuple(actions)
            actions += self.actions.write(state.initial_content, state)
            inner = self.by_name[state.initial] if state.initial else state.children[0]
            between = [each for each in inner.ancestors() if state in [*each.ancestors()][1:]]
            order, state = list(reversed(between)), inner

    def _go_to(
        self, actions: tuple[Action, ...], leaf: ScxmlState, stem: str, *, is_forced: bool = False
    ) -> Transition:
        """A transition to a state, by way of another one that runs actions."""
        target = self._states[leaf.name]
        if not actions and not is_forced:
            return Transition(to=target)
        # The initial state has no iteration before it, so its actions are others than those of a state in between.
        key = (actions, f"{stem}:{target}" if is_forced or stem == START else target)
        if key not in self._between:
            name = self.names.allocate(stem if stem == START else f"{stem}_{target}")
            # The next event is not handed out before the state is left.
            held = (self.events.holding(),) if self.has_queue else ()
            # The initial state decides before it acts.
            is_entered = stem == START or self.has_queue
            entered, acted = ((*actions, *held), ()) if is_entered else ((), actions)
            self._between[key] = State(
                name=name,
                requires=(EVENTS_ALIAS,) if self.has_queue else (),
                enter=entered,
                actions=acted,
                transitions=(Transition(to=target),),
            )
        return Transition(to=self._between[key].name)


def _any_of(conditions: list[str]) -> str:
    if "true" in conditions:
        return "true"
    return " or ".join(f"({each})" if len(conditions) > 1 else each for each in conditions)


def _check_unconditional(transition: Element, events: Iterable[str]) -> Iterable[str]:
    if transition.get("cond"):
        reason = "a transition without a target that takes a timer or done event on a condition"
        raise ScxmlError("S802", reason, transition.line, "use --event-queue")
    return events


def _domain(owner: ScxmlState, target: ScxmlState, *, is_internal: bool) -> ScxmlState:
    """The innermost state that a transition does not leave."""
    around = list(target.ancestors())
    if is_internal and not owner.is_atomic and owner in around[1:]:
        return owner
    candidates: Iterable[ScxmlState] = list(owner.ancestors())[1:] or [owner]
    return next(state for state in candidates if state in around[1:] or state.parent is None)
