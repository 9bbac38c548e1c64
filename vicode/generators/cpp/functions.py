"""Writes the member functions of a component: its decisions and actions."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from vicode.generators.cpp.expressions import ExpressionPrinter, Text
from vicode.generators.cpp.names import member_name, state_names
from vicode.generators.cpp.text import LINE_WIDTH, comment, doc_comment, quoted
from vicode.generators.cpp.views import FunctionView
from vicode.generators.plan import (
    ActionStep,
    AssignStep,
    Branch,
    CallStep,
    CodeCondition,
    CodePlan,
    CodeStep,
    ComponentPlan,
    DecisionPlan,
    NoChange,
    StateChange,
    StatePlan,
    UnsoundDesignError,
)
from vicode.model.expressions import Binary, OutputRef, ScopeSymbolKind, Variable
from vicode.regions import wrap_region

INDENT = 4


@dataclass(frozen=True, kw_only=True)
class FunctionWriter:
    """Writes the member functions of one component."""

    component: ComponentPlan
    class_name: str
    printer: ExpressionPrinter

    def write(self) -> Iterator[FunctionView]:
        plan = self.component
        if plan.common_decisions:
            doc = "Tests the common transitions; returns whether one of them ended the decision."
            body = self._decisions(plan.common_decisions, INDENT, ended="true")
            if any(line.strip() for line in body) and body[-1] != " " * INDENT + "return true;":
                body.append(" " * INDENT + "return false;")
            yield self._function("bool", "decide_common", "", body, doc)
        yield self._decide()
        if plan.common_actions:
            body = self._steps(plan.common_actions, INDENT)
            yield self._function("void", "act_common", "", body, "Runs the common actions.")
        yield self._act()
        for phase, doc in (
            ("enter", "Runs the actions on entering a state."),
            ("leave", "Runs the actions on leaving."),
        ):
            if any(getattr(state, phase) for state in plan.states):
                body = self._switch(partial(self._phase_steps, phase))
                yield self._function("void", phase, "", body, doc)
        yield self._change_to()
        yield from self._code_functions()

    def _phase_steps(self, phase: str, state: StatePlan) -> list[str]:
        return self._steps(state.enter if phase == "enter" else state.leave, 3 * INDENT)

    def _decide(self) -> FunctionView:
        body: list[str] = []
        if self.component.common_decisions:
            body += ["    if (decide_common()) {", "        return;", "    }"]
        body += self._switch(lambda state: self._decisions(state.decisions, 3 * INDENT))
        return self._function("void", "decide", "", body, "Takes the first transition whose guard holds.")

    def _act(self) -> FunctionView:
        body = ["    act_common();"] if self.component.common_actions else []
        body += self._switch(lambda state: self._steps(state.actions, 3 * INDENT))
        return self._function("void", "act", "", body, "Runs the actions of the active state.")

    def _change_to(self) -> FunctionView:
        plan = self.component
        is_cooperative = any(state.capacity is not None or state.synchronized is not None for state in plan.states)
        body = ["    if (!may_enter(next)) {", "        return;", "    }"] if is_cooperative else []
        body += ["    if (next == state_) {", "        return;", "    }"]
        if any(state.leave for state in plan.states):
            body.append("    leave();")
        requires = any(state.requires for state in plan.states)
        if requires:
            body.append("    const std::uint32_t required = required_by(state_);")
        body += ["    change_state(state_name(), transition);", "    state_ = next;"]
        if any(state.enter for state in plan.states):
            body.append("    enter();")
        if requires:
            body.append("    require(required);")
        return self._function("void", "change_to", "State next, const char* transition", body, "")

    def _switch(self, write: Callable[[StatePlan], list[str]]) -> list[str]:
        """A switch over the active state; states with the same lines share them, those without are the default."""
        names = state_names(self.component)
        blocks: dict[tuple[str, ...], list[StatePlan]] = {}
        for state in self.component.states:
            blocks.setdefault(tuple(write(state)), []).append(state)
        if set(blocks) == {()}:
            return []
        margin = " " * (2 * INDENT)
        lines = ["    switch (state_) {"]
        for block, states in blocks.items():
            if not block:
                continue
            lines += [f"{margin}case State::{names[state.name]}:" for state in states]
            lines += [*block, f"{margin}    break;"] if not _ends(block) else block
        if () in blocks:
            lines += [f"{margin}default:", f"{margin}    break;"]
        return [*lines, "    }"]

    # Decisions

    def _decisions(self, decisions: Iterable[DecisionPlan], indent: int, ended: str = "") -> list[str]:
        lines: list[str] = []
        for decision in decisions:
            if not any(isinstance(condition, CodeCondition) for condition in decision.conditions):
                lines += comment(decision.doc, indent)
            if decision.conditions:
                lines += self._alternative(decision, indent, ended)
            else:
                lines += self._outcome(decision, indent, ended)
        return lines

    def _alternative(self, decision: DecisionPlan, indent: int, ended: str) -> list[str]:
        margin = " " * indent
        lines = [
            *_broken(f"{margin}if (", " &&", self.printer.terms(decision.conditions), ") {"),
            *self._outcome(decision, indent + INDENT, ended),
        ]
        match decision.outcome:
            case Branch(otherwise=otherwise, then_always_ends=True) if otherwise:
                return [*lines, f"{margin}}}", *self._decisions(otherwise, indent, ended)]
            case Branch(otherwise=otherwise) if otherwise:
                return [
                    *lines,
                    f"{margin}}} else {{",
                    *self._decisions(otherwise, indent + INDENT, ended),
                    f"{margin}}}",
                ]
            case _:
                return [*lines, f"{margin}}}"]

    def _outcome(self, decision: DecisionPlan, indent: int, ended: str) -> list[str]:
        margin = " " * indent
        end = f"{margin}return{ended and ' '}{ended};"
        match decision.outcome:
            case StateChange(state=state, transition=transition):
                arguments = f"State::{state_names(self.component)[state]}" + (
                    f", {quoted(transition)}" if transition else ""
                )
                return [f"{margin}change_to({arguments});", end]
            case NoChange():
                is_cooperative = any(each.capacity or each.synchronized for each in self.component.states)
                return [*([f"{margin}stay();"] if is_cooperative else []), end]
            case Branch(then=then):
                return self._decisions(then, indent, ended)

    # Actions

    def _steps(self, steps: Iterable[ActionStep], indent: int) -> list[str]:
        return [line for step in steps for line in self._step(step, indent)]

    def _step(self, step: ActionStep, indent: int) -> list[str]:
        margin = " " * indent
        match step:
            case CodeStep(code=code):
                return [f"{margin}do_{code.stem}();"]
            case CallStep():
                return self._call(step, indent)
            case AssignStep():
                return self._assign(step, indent)

    def _call(self, step: CallStep, indent: int) -> list[str]:
        margin, target = " " * indent, member_name(step.alias)
        component = next(use.component for use in self.component.uses if use.alias == step.alias)
        type_ = f"{self.printer.names.class_name(component)}::Parameters"
        pairs = (*step.arguments, *step.defaults)
        stored = ", calls_" if self.component.frequency_hz else ""
        if not pairs:
            return [f"{margin}call({target}, {type_}{{}}{stored});"]
        values = [
            line
            for name, value in pairs
            for line in _statement(f"{margin}    parameters.{member_name(name)} = ", self.printer.print(value))
        ]
        head = [f"{margin}{{", f"{margin}    {type_} parameters;"]
        return [*head, *values, f"{margin}    call({target}, parameters{stored});", f"{margin}}}"]

    def _assign(self, step: AssignStep, indent: int) -> list[str]:
        margin, value = " " * indent, step.value
        target = member_name(step.name)
        if step.alias:
            owner = member_name(step.alias)
            if (step.alias, step.name) in self.printer.inputs:
                return _statement(f"{margin}{owner}.set_{target}(", self.printer.print(value), ");")
            target = f"{owner}.{target}"
        match value:
            case Binary(operator="+" | "-" | "*" as operator, left=left, right=right) if left.type == value.type and (
                _is_target(left, step)
            ):
                operand = self.printer.print(right) if right.type == value.type else self.printer._float(right)
                return _statement(f"{margin}{target} {operator}= ", operand)
            case _:
                return _statement(f"{margin}{target} = ", self.printer.print(value))

    # Hand-written code

    def _code_functions(self) -> Iterator[FunctionView]:
        for code in guard_code(self.component):
            yield self._function("bool", f"when_{code.stem}", "", _region(code), code.doc)
        for code in action_code(self.component):
            yield self._function("void", f"do_{code.stem}", "", _region(code), code.doc)

    def _function(self, type_: str, name: str, parameters: str, body: Sequence[str], doc: str) -> FunctionView:
        defaulted = parameters.replace("const char* transition", "const char* transition = nullptr")
        return FunctionView(
            declaration=f"{type_} {name}({defaulted});",
            signature=f"{type_} {self.class_name}::{name}({parameters})",
            body=tuple(body),
            doc=tuple(doc_comment(doc)),
        )


def action_code(component: ComponentPlan) -> Iterator[CodePlan]:
    steps = [component.common_actions]
    steps += [part for state in component.states for part in (state.enter, state.actions, state.leave)]
    yield from (step.code for part in steps for step in part if isinstance(step, CodeStep))


def guard_code(component: ComponentPlan) -> Iterator[CodePlan]:
    for decisions in (component.common_decisions, *(state.decisions for state in component.states)):
        yield from _guard_code(decisions)


def _guard_code(decisions: Iterable[DecisionPlan]) -> Iterator[CodePlan]:
    for decision in decisions:
        yield from (condition.code for condition in decision.conditions if isinstance(condition, CodeCondition))
        if isinstance(decision.outcome, Branch):
            yield from _guard_code((*decision.outcome.then, *decision.outcome.otherwise))


def cpp_code(code: CodePlan) -> str:
    """The C++ text of hand-written code.

    Raises:
        UnsoundDesignError: The code is not written in C++.
    """
    text = code.code.in_language("cpp")
    if text is None:
        raise UnsoundDesignError(f"the code of '{code.region_id}' is not written in C++")
    return text


def _region(code: CodePlan) -> list[str]:
    return wrap_region(code.region_id, cpp_code(code), comment="//", indent=" " * INDENT).rstrip("\n").split("\n")


def _is_target(node: object, step: AssignStep) -> bool:
    match node:
        case Variable(name=name, kind=kind):
            return not step.alias and name == step.name and kind != ScopeSymbolKind.CONSTANT
        case OutputRef(alias=alias, output=name, arguments=None):
            return (alias, name) == (step.alias, step.name)
        case _:
            return False


def _statement(before: str, value: Text, after: str = ";") -> list[str]:
    return [f"{before}{value.text}{after}"]


def _broken(before: str, separator: str, terms: list[str], after: str) -> list[str]:
    """The joined terms; one per line if they do not fit into a line."""
    line = f"{before}{f'{separator} '.join(terms)}{after}"
    if len(line) <= LINE_WIDTH or len(terms) == 1:
        return [line]
    margin = " " * (len(before) - len(before.lstrip()) + INDENT)
    first, *middle, last = terms
    return [f"{before}{first}{separator}", *(f"{margin}{term}{separator}" for term in middle), f"{margin}{last}{after}"]


def _ends(block: Sequence[str]) -> bool:
    return block[-1].startswith(" " * 3 * INDENT + "return")
