"""Small faults of a design, and which of them inputs would show.

Each mutant is the design with one change. It runs in the reference interpreter on the same inputs as the design; it is
noticed if what is observed differs. A mutant that is not noticed may behave the same on all inputs, which the analysis
of guards proves for some.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from textwrap import shorten
from typing import Any

from vicode.analysis.decision_targets import is_equivalent
from vicode.analysis.machines import MachineAnalysis
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.reference import ReferenceRobots
from vicode.findings import DesignPath
from vicode.generators import collect_components
from vicode.model.design import (
    Action,
    Assign,
    Call,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    State,
    Stay,
    Transition,
)
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.edits import (
    remove_decisions,
    reorder_decision,
    replace_action,
    replace_decision,
    set_declarations,
    update_actions,
    update_state,
)
from vicode.model.expressions import Comparison, Expr, Logic, Number, Scope, build_scope, parse_expression, walk
from vicode.model.project import Project
from vicode.model.traversal import LocatedDecision, find_decision, iter_actions, iter_decisions, iter_expressions
from vicode.semantics import NotInterpretableError

_OTHER_COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
_OPERATOR = re.compile(r"<=|>=|==|!=|<|>")
_WIDTH = 60
_LOGIC = {"and": "or", "or": "and"}


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignMutant:
    """A design with one change; `path` is the part of the design that is changed, `text` says how."""

    design: Design
    path: DesignPath
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MutantReport:
    """The mutants of a design.

    Attributes:
        count: The number of mutants that were tried.
        equivalent: The number of others, which are proved to behave like the design.
        survivors: Those that were not noticed.
    """

    count: int
    equivalent: int
    survivors: tuple[DesignMutant, ...]


Observe = Callable[[Sequence[Mapping[str, Any]]], object]
"""What is compared of the records of an iteration."""


def try_mutants(runs: Sequence[ConformanceRun], *, observe: Observe = repr, is_root_only: bool = False) -> MutantReport:
    """Try the mutants of a design on its runs.

    Args:
        runs: Runs of one design.
        observe: What is compared; by default everything, as text, so that nan equals nan.
        is_root_only: Whether the designs that it uses stay as they are.

    Raises:
        NotInterpretableError: The design has errors, or code that is not portable.
    """
    project, root = runs[0].project, runs[0].root
    expected = [_ExpectedRun.of(run, observe) for run in runs]
    used = (root,) if is_root_only else collect_components(project, (root,))
    count, equivalent, tried, survivors = 0, 0, set[Design](), []
    for design in (each for each in project.designs if each.component in used):
        machine = MachineAnalysis(project, design)
        tried.add(design)
        for mutant in list_mutants(project, design, is_root=design.component == root):
            # A run sets the parameters of its root.
            if mutant.design in tried or (mutant.path[0] == "parameters" and design.component == root):
                continue
            tried.add(mutant.design)
            if is_equivalent(machine, mutant.design, mutant.path):
                equivalent += 1
                continue
            try:
                is_noticed = _is_noticed(mutant, design, expected, observe)
            except NotInterpretableError:
                continue
            count += 1
            if not is_noticed:
                survivors.append(mutant)
    return MutantReport(count=count, equivalent=equivalent, survivors=tuple(survivors))


@dataclass(frozen=True, slots=True)
class _ExpectedRun:
    """A run with what is observed of the design, and the states in which its components are."""

    run: ConformanceRun
    observed: tuple[object, ...]
    states: frozenset[tuple[str, str]]

    @classmethod
    def of(cls, run: ConformanceRun, observe: Observe) -> "_ExpectedRun":
        records = list(_records(run.project, run))
        steps = (step for robots in records for record in robots for step in record["tree"])
        states = frozenset(
            (step["component"], state) for step in steps for state in (step["state"], step["changed_from"])
        )
        return cls(run, tuple(map(observe, records)), states)


def _is_noticed(mutant: DesignMutant, design: Design, expected: Sequence[_ExpectedRun], observe: Observe) -> bool:
    project = expected[0].run.project
    changed = replace(project, designs=tuple(mutant.design if each is design else each for each in project.designs))
    place = (design.component, str(mutant.path[1]) if mutant.path[0] == "states" else design.initial)
    # First the runs that are in the state which is changed.
    ordered = sorted(expected, key=lambda each: (place not in each.states, len(each.observed)))
    return any(
        any(
            observe(records) != known for records, known in zip(_records(changed, each.run), each.observed, strict=True)
        )
        for each in ordered
    )


def _records(project: Project, run: ConformanceRun) -> Iterator[list[dict[str, Any]]]:
    robots = ReferenceRobots(
        project,
        run.root,
        run.inputs,
        robots=run.robots,
        team_ticks=run.team_ticks,
        holds_outputs=run.holds_outputs,
    )
    return (robots.step(step) for step in run.steps)


def list_mutants(project: Project, design: Design, *, is_root: bool) -> Iterator[DesignMutant]:
    """The mutants of a design; `is_root` is whether it is stepped in each iteration, so that it never resumes."""
    yield from _change_design(design, is_root=is_root)
    for section, declaration in design.declarations():
        yield from _change_declaration(project, design, section, declaration)
    yield from _change_expressions(design, build_scope(project, design))
    disabled = disabled_states(design)
    for located in iter_decisions(design):
        if is_enabled(located, disabled):
            yield from _change_decision(design, located)
    yield from _change_actions(design)
    for state in design.states:
        if state.name not in disabled:
            yield from _change_state(design, state)


def _change_design(design: Design, *, is_root: bool) -> Iterator[DesignMutant]:
    if not is_root:
        yield DesignMutant(design=replace(design, resume=not design.resume), path=("resume",), text="resume changed")
    if design.frequency_hz:
        slower = replace(design, frequency_hz=design.frequency_hz * 0.999)
        yield DesignMutant(design=slower, path=("frequency",), text="frequency 0.1 % lower")
        always = replace(design, frequency_hz=None)
        yield DesignMutant(design=always, path=("frequency",), text="frequency removed")
    for state in design.states:
        if state.name != design.initial and not state.disabled:
            changed = replace(design, initial=state.name)
            yield DesignMutant(design=changed, path=("initial",), text=f"initial state {state.name}")
            break


def _change_declaration(
    project: Project, design: Design, section: str, declaration: Declaration
) -> Iterator[DesignMutant]:
    scope = build_scope(project, design)
    other = {"bool": "true", "int": "1", "float": "1.0"}.get(scope.type_of(declaration), "")
    if not declaration.initial and other and section != "parameters":
        key = "initial"
        changed = _with_initial(design, section, declaration.name, other)
        text = f"initial value {other} of {declaration.name}"
        yield DesignMutant(design=changed, path=(section, declaration.name, key), text=text)


def _change_expressions(design: Design, scope: Scope) -> Iterator[DesignMutant]:
    for located in iter_expressions(design):
        if located.path[0] == "properties":
            continue
        tree = parse_expression(located.text, scope, located.expected or None).tree
        for text, words in _change_text(located.text, tree) if tree else ():
            title = "after " if located.path[-1] == "after" else ""
            changed = _with_expression(design, located.path, text)
            yield DesignMutant(design=changed, path=located.path, text=title + words)


def _change_text(text: str, tree: Expr) -> Iterator[tuple[str, str]]:
    """The text of an expression with another operator or number, or negated, and the change in words."""
    if tree.type == "bool":
        yield f"not ({text})", f"{shorten(text, _WIDTH, placeholder='…')} negated"
    for node in walk(tree):
        match node:
            case Number(span=(start, end)):
                for number in _neighbors(text[start:end]):
                    changed = text[:start] + number + text[end:]
                    words = f" in {shorten(text, _WIDTH, placeholder='…')}" if (start, end) != (0, len(text)) else ""
                    yield changed, f"{text[start:end]} changed to {number}{words}"
            case Comparison(operands=operands):
                for left, right in pairwise(operands):
                    yield from _change_between(text, left, right, _OPERATOR, _OTHER_COMPARISONS)
            case Logic(operator=operator, operands=operands):
                for left, right in pairwise(operands):
                    yield from _change_between(text, left, right, re.compile(r"\b(?:and|or)\b"), _LOGIC)
                for start, end in (each.span for each in operands):
                    neutral = "true" if operator == "and" else "false"
                    words = f"{operator} {shorten(text[start:end], _WIDTH, placeholder='…')} removed"
                    yield text[:start] + neutral + text[end:], words


def _change_between(
    text: str, left: Expr, right: Expr, pattern: re.Pattern[str], others: Mapping[str, str]
) -> Iterator[tuple[str, str]]:
    found = pattern.search(text, left.span[1], right.span[0])
    if found is not None:
        other = others[found[0]]
        around = shorten(text[left.span[0] : right.span[1]], _WIDTH, placeholder="…")
        yield text[: found.start()] + other + text[found.end() :], f"{found[0]} changed to {other} in {around}"


def _neighbors(number: str) -> Iterator[str]:
    """The number with 1 more and 1 less in its last digit."""
    if not re.fullmatch(r"\d+(\.\d*)?", number):
        return
    digits = len(number.partition(".")[2])
    for step in (1, -1):
        value = round(float(number) + step * 10.0**-digits, digits)
        yield f"{value:.{digits}f}" if value >= 0 else f"({value:.{digits}f})"


def _change_decision(design: Design, located: LocatedDecision) -> Iterator[DesignMutant]:
    path, item = located.path, located.decision
    title = _title(item)
    yield DesignMutant(design=remove_decisions(design, (path,)), path=path, text=f"{title} removed")
    index = path[-1]
    assert isinstance(index, int)
    if find_decision(design, (*path[:-1], index + 1)) is not None:
        swapped = reorder_decision(design, path, index + 1)
        yield DesignMutant(design=swapped, path=path, text=f"{title} swapped with the next decision")
    if item.guard.after:
        always = replace_decision(design, path, replace(item, guard=replace(item.guard, after="")))
        yield DesignMutant(design=always, path=path, text=f"after {item.guard.after} removed")
    match item:
        case Transition(to=to):
            for state in design.states:
                if state.name not in (to, located.source) and not state.disabled:
                    changed = replace_decision(design, path, replace(item, to=state.name))
                    yield DesignMutant(design=changed, path=path, text=f"{title} redirected to {state.name}")
                    break
        case Stay():
            pass
        case DecisionGroup(then=then, otherwise=otherwise):
            changed = replace_decision(design, path, replace(item, then=otherwise, otherwise=then))
            yield DesignMutant(design=changed, path=path, text=f"{title}: then and else swapped")


def _title(item: Decision) -> str:
    match item:
        case Transition(to=to):
            return f"transition to {to}"
        case Stay():
            return "stay"
        case DecisionGroup():
            return "group"


def _change_actions(design: Design) -> Iterator[DesignMutant]:
    for located in iter_actions(design):
        path, action = located.path, located.action
        if located.phase == "modulates":
            continue
        title = _action_title(action)
        yield DesignMutant(design=replace_action(design, path), path=path, text=f"{title} removed")
        if isinstance(action, Assign) and len(action.values) > 1:
            turned = replace(action, values=tuple(reversed(action.values)))
            yield DesignMutant(
                design=replace_action(design, path, turned), path=path, text=f"{title} in the opposite order"
            )
        index = path[-1]
        assert isinstance(index, int)
        swapped = update_actions(design, path[:-1], lambda actions, at=index: _swap(actions, at))  # type: ignore[misc]
        if swapped != design:
            yield DesignMutant(design=swapped, path=path, text=f"{title} swapped with the next action")


def _swap(actions: tuple[Action, ...], at: int) -> tuple[Action, ...]:
    if at + 1 >= len(actions):
        return actions
    return (*actions[:at], actions[at + 1], actions[at], *actions[at + 2 :])


def _action_title(action: Action) -> str:
    match action:
        case Assign(values=values):
            return f"set {', '.join(name for name, _text in values)}"
        case Call(alias=alias):
            return f"call of {alias}"
        case _:
            return "code"


def _change_state(design: Design, state: State) -> Iterator[DesignMutant]:
    path: DesignPath = ("states", state.name)

    def mutant(changed: State, key: str, text: str) -> DesignMutant:
        changed_design = update_state(design, state.name, lambda _state: changed)
        return DesignMutant(design=changed_design, path=(*path, key), text=text)

    for alias in state.requires:
        kept = tuple(each for each in state.requires if each != alias)
        yield mutant(replace(state, requires=kept), "requires", f"required {alias} removed")
    for call in state.modulates:
        kept_calls = tuple(each for each in state.modulates if each != call)
        yield mutant(replace(state, modulates=kept_calls), "modulates", f"call of {call.alias} removed")
    if state.enter != state.leave:
        swapped = replace(state, enter=state.leave, leave=state.enter)
        yield mutant(swapped, "enter" if state.enter else "leave", "enter and leave swapped")
    yield mutant(replace(state, final=not state.final), "final", "final changed")
    if state.capacity is not None:
        yield mutant(replace(state, capacity=state.capacity + 1), "capacity", "capacity 1 more")
    if state.synchronized is not None:
        yield mutant(replace(state, synchronized=state.synchronized + 1), "synchronized", "synchronized 1 more")


def _with_expression(design: Design, path: DesignPath, text: str) -> Design:
    match path:
        case ("parameters" | "outputs" | "variables" as section, str(name), _):
            return _with_initial(design, section, name, text)
        case (*place, "when" | "after" as key):
            located = find_decision(design, tuple(place))
            assert located is not None
            old = located.decision.guard
            guard = replace(old, when=text) if key == "when" else replace(old, after=text)
            return replace_decision(design, tuple(place), replace(located.decision, guard=guard))
        case ("states", str(state), "modulates", alias, name):
            return update_state(
                design,
                state,
                lambda old: replace(
                    old,
                    modulates=tuple(
                        _with_argument(call, str(name), text) if call.alias == alias else call for call in old.modulates
                    ),
                ),
            )
        case (*place, "set" | "with", name):
            action = next(each.action for each in iter_actions(design) if each.path == tuple(place))
            match action:
                case Assign(values=values):
                    pairs = tuple((each, text if each == name else old) for each, old in values)
                    return replace_action(design, tuple(place), replace(action, values=pairs))
                case Call():
                    return replace_action(design, tuple(place), _with_argument(action, str(name), text))
    raise AssertionError(path)


def _with_argument(call: Call, name: str, text: str) -> Call:
    return replace(call, arguments=tuple((each, text if each == name else old) for each, old in call.arguments))


def _with_initial(design: Design, section: str, name: str, text: str) -> Design:
    declarations: tuple[Declaration, ...] = getattr(design, section)
    changed = tuple(replace(each, initial=text) if each.name == name else each for each in declarations)
    return set_declarations(design, section, changed)
