"""Imports SCXML: states inside states become states of one design."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from vicode.importers.names import DesignNames
from vicode.importers.scxml.actions import ActionWriter
from vicode.importers.scxml.expressions import check_expression, translate
from vicode.importers.scxml.reader import Element, ScxmlError, read_scxml
from vicode.importers.scxml.states import ScxmlState, read_states
from vicode.model.design import Action, Decision, Declaration, Design, Guard, State, Stay, Transition, Use
from vicode.model.expressions import build_scope
from vicode.model.project import Interface, Project
from vicode.model.traversal import iter_expressions

__all__ = ["ScxmlError", "import_scxml"]

EVENTS = "Events"
_ALIAS = "events"
_DONE = "done.state."


def import_scxml(data: bytes, component: str, name: str) -> Project:
    """Convert a document to a project with one design.

    A state of the design stands for a state of the document without children; the transitions of the states around it
    follow its own. Entering and leaving states around it, and the content of transitions, are actions of a state in
    between. Events are inputs.

    Args:
        data: The content of the file.
        component: The name of the component.
        name: The name of the project.

    Raises:
        ScxmlError: The document cannot be expressed as a design.
    """
    document, by_name = read_states(read_scxml(data))
    return _Importer(document=document, by_name=by_name).convert(component, name)


@dataclass(slots=True, kw_only=True)
class _Importer:
    document: ScxmlState
    by_name: dict[str, ScxmlState]
    names: DesignNames = field(default_factory=DesignNames)
    actions: ActionWriter = field(init=False)
    _states: dict[str, str] = field(default_factory=dict)
    _events: dict[str, str] = field(default_factory=dict)
    _between: dict[tuple[tuple[Action, ...], str], State] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.actions = ActionWriter.of_document(self.document, tuple(self.by_name.values()))

    def convert(self, component: str, name: str) -> Project:
        leaves = [state for state in self.by_name.values() if state.is_atomic]
        for leaf in leaves:
            self._states[leaf.name] = self.names.allocate(leaf.name)
        event_names = DesignNames(frozenset({"is_done"}))
        for descriptor in self._descriptors():
            if descriptor not in self._events:
                self._events[descriptor] = event_names.allocate(descriptor)
        states = [self._leaf(leaf) for leaf in leaves]
        leaf, entered = self._enter(self.document)
        initial = self._go_to(entered, leaf, "Start").to
        events = tuple(Declaration(name=each, type="bool") for each in self._events.values())
        design = Design(
            component=component,
            uses=(Use(alias=_ALIAS, component=EVENTS),) if events else (),
            variables=self.actions.declarations(),
            initial=initial,
            states=(*states, *self._between.values()),
        )
        interfaces = (Interface(component=EVENTS, outputs=events),) if events else ()
        project = Project(name=name, languages=("python", "cpp"), components=interfaces, designs=(design,))
        self._check(project, design)
        return project

    def _check(self, project: Project, design: Design) -> None:
        scope = build_scope(project, design)
        types = {each.name: each.type for each in design.variables}
        for each in iter_expressions(design):
            expected = each.expected or types.get(str(each.path[-1]), "")
            check_expression(each.text, scope, expected, self.document.line)

    def _descriptors(self) -> Iterator[str]:
        """The events of all transitions, except those that the document itself causes."""
        for state in (self.document, *self.by_name.values()):
            for transition in state.transitions():
                for written in transition.attributes.get("event", "").split():
                    event = _plain(written)
                    if event not in self.actions.timers and not event.startswith((_DONE, "error", "*")):
                        yield event

    def _leaf(self, leaf: ScxmlState) -> State:
        is_end = leaf.is_final and leaf.parent is self.document
        decisions = () if is_end else tuple(self._decisions(leaf))
        return State(
            name=self._states[leaf.name],
            doc=f"In {leaf.parent.name}." if leaf.parent is not None and leaf.parent is not self.document else "",
            final=is_end,
            enter=self.actions.write(leaf.content("onentry"), leaf),
            leave=self.actions.write(leaf.content("onexit"), leaf),
            transitions=decisions,
        )

    def _decisions(self, leaf: ScxmlState) -> Iterator[Decision]:
        """First transitions without event, then those of inner states, then those of the states around them."""
        found = [(owner, each) for owner in leaf.ancestors() for each in owner.transitions()]
        found.sort(key=lambda pair: bool(pair[1].attributes.get("event")))
        for owner, transition in found:
            guard = self._guard(leaf, transition)
            if guard is None:
                continue
            yield self._decision(leaf, owner, transition, guard)
            if guard.is_empty:
                return

    def _guard(self, leaf: ScxmlState, transition: Element) -> Guard | None:
        """The guard; None if the transition can never be taken in this state."""
        inside = {state.name for state in leaf.ancestors()}
        events, after, terms = transition.attributes.get("event", "").split(), "", list[str]()
        if events:
            parts = [part for event in events for part in self._event_terms(event, leaf)]
            if not parts:
                return None
            timers = [self.actions.timers[event] for event in events if event in self.actions.timers]
            if timers and timers[0].state is leaf and len(events) == 1:
                after, parts = timers[0].seconds, []
            if "true" not in parts and parts:
                terms.append(" or ".join(parts))
        condition = transition.attributes.get("cond", "")
        if condition:
            text = translate(condition, self.actions.names, inside.__contains__, transition.line)
            if text == "false":
                return None
            terms += [text] if text != "true" else []
        return Guard(
            when=" and ".join(f"({each})" if len(terms) > 1 and " or " in each else each for each in terms), after=after
        )

    def _event_terms(self, event: str, leaf: ScxmlState) -> Iterator[str]:
        plain = _plain(event)
        if event.startswith(_DONE):
            is_done = leaf.is_final and leaf.parent is not None and event == f"{_DONE}{leaf.parent.name}"
            yield from ["true"] if is_done else []
        elif plain in self.actions.timers:
            timer = self.actions.timers[plain]
            yield f"component_time - {timer.variable} >= {timer.seconds}"
        else:
            # A descriptor matches all events that begin with it.
            for known, name in self._events.items():
                if plain in ("*", known) or known.startswith(f"{plain}."):
                    yield f"{_ALIAS}.{name}"

    def _decision(self, leaf: ScxmlState, owner: ScxmlState, transition: Element, guard: Guard) -> Decision:
        target = transition.attributes.get("target", "").strip()
        if not target:
            if any(child.tag != "log" for child in transition.children):
                fix = "give it a target, or assign on entry of a state"
                reason = "a transition without a target that assigns: actions belong to states"
                raise ScxmlError("S802", reason, transition.line, fix)
            return Stay(guard=guard)
        if " " in target or target not in self.by_name:
            known = "a design is in one state at a time" if " " in target else f"unknown state '{target}'"
            raise ScxmlError("S803", known, transition.line)
        to = self.by_name[target]
        domain = _domain(owner, to, is_internal=transition.attributes.get("type") == "internal")
        left = [state for state in leaf.ancestors() if state is not leaf]
        passed = [state for state in left if domain in [*state.ancestors()][1:]]
        actions = [action for state in passed for action in self.actions.write(state.content("onexit"), state)]
        actions += self.actions.write(transition.children, owner)
        end, entered = self._enter(to, below=domain)
        is_restart = end is leaf
        step = self._go_to((*actions, *entered), end, f"{self._states[leaf.name]}_to", is_forced=is_restart)
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
        key = (actions, f"{stem}:{target}" if is_forced else target)
        if key not in self._between:
            name = self.names.allocate(stem if stem == "Start" else f"{stem}_{target}")
            # The initial state decides before it acts.
            entered, acted = (actions, ()) if stem == "Start" else ((), actions)
            self._between[key] = State(name=name, enter=entered, actions=acted, transitions=(Transition(to=target),))
        return Transition(to=self._between[key].name)


def _plain(event: str) -> str:
    """A descriptor without the ending that says that it is one."""
    return event.removesuffix(".*").removesuffix(".")


def _domain(owner: ScxmlState, target: ScxmlState, *, is_internal: bool) -> ScxmlState:
    """The innermost state that a transition does not leave."""
    around = list(target.ancestors())
    if is_internal and not owner.is_atomic and owner in around[1:]:
        return owner
    candidates: Iterable[ScxmlState] = list(owner.ancestors())[1:] or [owner]
    return next(state for state in candidates if state in around[1:] or state.parent is None)
