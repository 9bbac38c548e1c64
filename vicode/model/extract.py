"""Extracts states of a design as a component of their own, with the same behavior in each iteration.

The caller gets one state that *requires* the component. A required component is stepped before its caller decides, so a
final state that the component reaches is seen, and left, in the same iteration; a called component would be seen one
iteration later. A component that is required is stepped when the state is entered, and decides in this iteration,
which the extracted states did not do: it therefore begins in a state that only leads to the first of them.
Values flow from the component to its caller only: a requirement sets no parameters.
"""

import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import takewhile

from vicode.model.decisions import retarget_all
from vicode.model.design import (
    STATE_KEYS,
    Assign,
    Declaration,
    Design,
    Guard,
    State,
    Transition,
    Use,
)
from vicode.model.edits import replace_in_frames, unique_name
from vicode.model.fragments import references_alias, references_name
from vicode.model.lowering import is_lowered
from vicode.model.names import snake_case
from vicode.model.traversal import has_code, iter_actions, iter_code, iter_expressions, iter_transitions


@dataclass(frozen=True, slots=True, kw_only=True)
class Extraction:
    """The design with a state in place of the extracted ones, and the new design; `problems` say why there are none.

    `note` says what differs in the first iteration, "" if nothing does.
    """

    caller: Design
    component: Design
    problems: tuple[str, ...] = ()
    note: str = ""


def extract_component(design: Design, states: Collection[str], name: str) -> Extraction:
    """Extract states as the component `name`, whose name is not used in the project."""
    cut = _Cut(
        design=design,
        inside=tuple(state for state in design.states if state.name in states),
        outside=tuple(state for state in design.states if state.name not in states),
    )
    problems = tuple(dict.fromkeys(_find_problems(cut)))
    if problems:
        return Extraction(caller=design, component=Design(component=name), problems=problems)
    component = _component(cut, name)
    later = f"after a start of {design.component}, the transitions of {cut.entry} are tested one iteration later"
    note = later if cut.is_started and cut.has_start else ""
    return Extraction(caller=_caller(cut, component), component=component, note=note)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Cut:
    """A design whose states are divided."""

    design: Design
    inside: tuple[State, ...]
    outside: tuple[State, ...]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(state.name for state in self.inside)

    @property
    def entries(self) -> list[tuple[str, str]]:
        """The sources and targets of transitions to the extracted states."""
        return [(source, to) for source, to in _edges(self.design) if source not in self.names and to in self.names]

    @property
    def exits(self) -> list[tuple[str, str]]:
        return [(source, to) for source, to in _edges(self.design) if source in self.names and to not in self.names]

    @property
    def targets(self) -> list[State]:
        """The states that are entered from the extracted ones."""
        targets = {to for _source, to in self.exits}
        return [state for state in self.outside if state.name in targets]

    @property
    def is_started(self) -> bool:
        return self.design.initial in self.names

    @property
    def has_start(self) -> bool:
        """Whether the component begins in its own state; by XABSL's rules, it is not done when it restarts."""
        return bool(self.entries) or self.design.arithmetic == "xabsl"

    @property
    def entry(self) -> str:
        return self.design.initial if self.is_started else self.entries[0][1]

    @property
    def entry_state(self) -> State:
        return next(state for state in self.inside if state.name == self.entry)

    @property
    def kept_requirements(self) -> tuple[str, ...]:
        """The first requirements of all states, which the calling state keeps if they could be stepped twice."""
        columns = zip(*(state.requires for state in self.inside), strict=False)
        first = (column[0] for column in takewhile(lambda column: len(set(column)) == 1, columns))
        return tuple(first) if _requirement_problems(self, ()) else ()

    def names_in(self, states: Iterable[State]) -> set[str]:
        """The declarations to which states refer; those outside include the properties."""
        part = Design(component="", states=tuple(states))
        if part.states != self.inside:
            part = replace(part, properties=self.design.properties)
        return {each.name for _section, each in self.design.declarations() if references_name(part, each.name)}

    @property
    def returned(self) -> tuple[Declaration, ...]:
        """The values that the extracted states set and others read."""
        return tuple(
            each
            for section, each in self.design.declarations()
            if each.name in _set_by(self.inside) and (section == "outputs" or each.name in self.names_in(self.outside))
        )

    @property
    def moved(self) -> tuple[Declaration, ...]:
        """The variables of the extracted states alone."""
        names = self.names_in(self.inside) - self.names_in(self.outside)
        return tuple(each for each in self.design.variables if each.name in names)


def _edges(design: Design) -> list[tuple[str, str]]:
    transitions = iter_transitions(design)
    return [(each.source, each.decision.to) for each in transitions if isinstance(each.decision, Transition)]


def _set_by(states: Iterable[State]) -> set[str]:
    """The names that states set; code may set each name that it mentions."""
    part = Design(component="", states=tuple(states))
    assigned = {
        name
        for placed in iter_actions(part)
        if isinstance(placed.action, Assign)
        for name, _text in placed.action.values
    }
    words = " ".join(text for each in iter_code(part) for _language, text in each.code.texts)
    return assigned | _words(words)


def _words(text: str) -> set[str]:
    return set(re.findall(r"\w+", text))


# What cannot keep its behavior


def _find_problems(cut: _Cut) -> Iterator[str]:
    design = cut.design
    if not cut.inside:
        yield "select the states to extract"
        return
    if is_lowered(design):
        yield "the design has latches, interrupts, a competence, layers or failed states"
        return
    if design.common.transitions or design.common.actions:
        yield "the common section applies to each state: the component would work before it"
    if design.resume and design.arithmetic == "xabsl":
        yield "with 'resume' and the rules of XABSL, the component is not done in the iteration in which it resumes"
    known = {state.name for state in design.states}
    yield from (f"{source}: there is no state '{to}'" for source, to in _edges(design) if to not in known)
    entered = {to: source for source, to in cut.entries} | ({design.initial: "the start"} if cut.is_started else {})
    if len(entered) != 1:
        places = ", ".join(f"{to} (from {source})" for to, source in entered.items())
        yield f"the states are entered in several places: {places}" if places else "no transition enters the states"
        return
    yield from _state_problems(cut)
    yield from _value_problems(cut)
    yield from _requirement_problems(cut, cut.kept_requirements)[:1]
    for promised in design.properties:
        for name in {getattr(promised, key, None) for key in STATE_KEYS}.intersection(cut.names):
            yield f"a property of {design.component} names the state {name}"


def _state_problems(cut: _Cut) -> Iterator[str]:
    for state in cut.inside:
        if state.final:
            yield f"{state.name} is a final state: {cut.design.component} is done in it"
        if has_code(state) and (cut.design.members.texts or cut.design.module.texts):
            yield f"the code of {state.name} may use 'members' or 'module' of {cut.design.component}"
    for state in (*cut.inside, *cut.targets):
        if state.capacity is not None or state.synchronized is not None:
            yield f"{state.name} is entered together with other robots of a team"
    part = Design(component="", states=cut.inside)
    texts = [(each.state, each.text) for each in iter_expressions(part)]
    texts += [(each.state, text) for each in iter_code(part) for _language, text in each.code.texts]
    for name in dict.fromkeys(state for state, text in texts if "component_time" in _words(text)):
        yield f"{name} reads component_time, which would be that of the new component"


def _value_problems(cut: _Cut) -> Iterator[str]:
    design, used = cut.design, cut.names_in(cut.inside)
    for section, each in design.declarations():
        if each.name not in used:
            continue
        place = next(state.name for state in cut.inside if each.name in cut.names_in([state]))
        other = next((state.name for state in cut.outside if each.name in _set_by([state])), "")
        if section == "parameters":
            yield f"{place} reads the parameter '{each.name}', which a required component does not get"
        elif each.arguments is not None:
            yield f"{place} reads '{each.name}', which has arguments"
        elif other:
            yield f"{place} uses '{each.name}', which {other} sets"


def _requirement_problems(cut: _Cut, kept: Collection[str]) -> list[str]:
    """What changes if the calling state requires `kept` and the component the other requirements."""
    required = {state.name: state.requires for state in cut.design.states}
    found = [
        f"{source} and {to} both require '{alias}', which would be stepped twice"
        for source, to in (*cut.exits, *cut.entries)
        for alias in required.get(to, ())
        if alias in required.get(source, ()) and alias not in kept
    ]
    before = [required.get(source, ()) for source, _to in cut.entries] + [()] * cut.is_started
    if cut.entry_state.enter and not all(set(kept) <= set(aliases) for aliases in before):
        found.append(f"'enter' of {cut.entry} would run after its requirements")
    return found


# The two designs


def _component(cut: _Cut, name: str) -> Design:
    design, entry = cut.design, cut.entry_state
    used, returned = cut.names_in(cut.inside), cut.returned
    ends, flags = _end_states(cut, {*used, *(use.alias for use in design.uses)})
    start = State(
        name=unique_name("Start", {*cut.names, *(state.name for state in ends)}),
        transitions=(Transition(to=entry.name),),
    )
    kept, targets = cut.kept_requirements, {state.name: end.name for state, end in zip(cut.targets, ends, strict=True)}
    inside = tuple(
        replace(state, requires=state.requires[len(kept) :], transitions=retarget_all(state.transitions, targets))
        for state in cut.inside
    )
    variables = tuple(each for _section, each in design.declarations() if each.name in used and each not in returned)
    return Design(
        component=name,
        doc=f"Extracted from {design.component}.",
        frequency_hz=design.frequency_hz,
        resume=design.resume,
        arithmetic=design.arithmetic,
        time_unit=design.time_unit,
        uses=tuple(use for use in design.uses if references_alias(Design(component="", states=inside), use.alias)),
        outputs=(*returned, *(Declaration(name=flag, initial="false") for flag in flags)),
        variables=variables,
        initial=start.name if cut.has_start else entry.name,
        states=(*([start] if cut.has_start else []), *inside, *ends),
    )


def _end_states(cut: _Cut, taken: Collection[str]) -> tuple[list[State], list[str]]:
    """A final state for each way out; with several, the outputs that say which one was taken."""
    states, flags = list(cut.names), list(taken)
    for target in cut.targets:
        states.append(unique_name(f"To{target.name}", states))
        flags.append(unique_name(snake_case(f"to_{target.name}"), flags))
    names, flags = states[len(cut.names) :], flags[len(taken) :] if len(cut.targets) > 1 else []
    ends = [
        State(
            name=name,
            at=target.at,
            final=True,
            disabled=target.disabled,
            enter=(Assign(values=tuple((each, str(each == flags[index])) for each in flags)),) if flags else (),
            transitions=(Transition(to=cut.entry),) if cut.has_start else (),
        )
        for index, (target, name) in enumerate(zip(cut.targets, names, strict=True))
    ]
    return ends, flags


def _caller(cut: _Cut, component: Design) -> Design:
    design = cut.design
    taken = {use.alias for use in design.uses} | {each.name for _section, each in design.declarations()}
    alias = unique_name(snake_case(component.component), taken)
    flags = [each.name for each in component.outputs if each not in cut.returned]
    copied = tuple((each.name, f"{alias}.{each.name}") for each in cut.returned)
    copies = (Assign(values=copied),) if copied else ()
    conditions = [f"done({alias}) and {alias}.{flag}" for flag in flags] or [f"done({alias})"]
    call = State(
        name=unique_name(component.component, {state.name for state in cut.outside}),
        at=cut.entry_state.at,
        disabled=cut.entry_state.disabled,
        requires=(*cut.kept_requirements, alias),
        actions=copies,
        leave=copies,
        transitions=tuple(
            Transition(to=to.name, guard=Guard(when=when))
            for to, when in zip(cut.targets, conditions if cut.targets else [], strict=True)
        ),
    )
    new = {cut.entry: call.name}
    outside = [replace(each, transitions=retarget_all(each.transitions, new)) for each in cut.outside]
    place = design.states.index(cut.inside[0])
    used = {use.alias for use in component.uses}
    variables = tuple(each for each in design.variables if each not in cut.moved)
    kept = replace(design, states=(*outside[:place], call, *outside[place:]), variables=variables)
    uses = (use for use in design.uses if use.alias not in used or references_alias(kept, use.alias))
    return replace(
        kept,
        uses=(*uses, Use(alias=alias, component=component.component)),
        initial=call.name if cut.is_started else design.initial,
        frames=replace_in_frames(design.frames, dict.fromkeys(cut.names, (call.name,))),
    )
