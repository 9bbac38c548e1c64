"""Writes the methods of a generated class: the decisions and actions of its states."""

from collections.abc import Iterator
from dataclasses import dataclass

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
    TimerCondition,
    UnsoundDesignError,
    iter_guard_code,
    literal_value,
)
from vicode.generators.python.expression_doc import AND, atom, format_statement, operator_chain
from vicode.generators.python.expression_printer import PythonExpressionPrinter
from vicode.generators.python.names import has_statement
from vicode.generators.python.pretty_printer import LINE_WIDTH, Doc, call_doc, concat, render_doc
from vicode.generators.python.text import comment, docstring, quoted
from vicode.generators.python.views import MethodView
from vicode.model.expressions import Binary, Expr, OutputRef, ScopeSymbolKind, Variable
from vicode.regions import wrap_region

METHOD_INDENT, BODY_INDENT = 4, 8


@dataclass(frozen=True, slots=True, kw_only=True)
class MethodWriter:
    """Writes the methods of one component."""

    component: ComponentPlan
    expression_printer: PythonExpressionPrinter

    def write_states(self) -> list[MethodView]:
        plan = self.component
        methods: list[MethodView] = []
        if plan.common_decisions:
            doc = "Test the common transitions; return whether one of them ended the decision."
            lines = [*self._decide(plan.common_decisions, BODY_INDENT, ended=" True")]
            lines += [] if lines[-1:] == [" " * BODY_INDENT + "return True"] else [" " * BODY_INDENT + "return False"]
            methods += [_method("_decide_common(self) -> bool", doc, lines), *self._predicates(plan.common_decisions)]
        if plan.common_actions:
            lines = self._steps(plan.common_actions)
            methods += [_method("_act_common(self) -> None", "Run the common actions.", lines)]
            methods += self._actions(plan.common_actions)
        for state in plan.states:
            methods += self._write_state(state)
        return methods

    def _write_state(self, state: StatePlan) -> list[MethodView]:
        return [
            _method(f"_in_{state.stem}(self, decide: bool = True) -> None", state.doc, self._state_body(state)),
            *self._enter_or_leave("enter", state.stem, state.enter),
            *self._enter_or_leave("leave", state.stem, state.leave),
            *self._predicates(state.decisions),
            *self._actions(state.actions),
        ]

    def _state_body(self, state: StatePlan) -> list[str]:
        margin = " " * BODY_INDENT
        lines: list[str] = []
        if self.component.common_decisions:
            lines += [f"{margin}if decide and self._decide_common():", f"{margin}    return"]
        lines += self._state_decisions(state.decisions)
        if self.component.common_actions:
            lines.append(f"{margin}self._act_common()")
        return [*lines, *self._steps(state.actions)]

    def _state_decisions(self, decisions: tuple[DecisionPlan, ...]) -> list[str]:
        match decisions:
            case ():
                return []
            case (DecisionPlan(conditions=conditions, outcome=outcome) as only,) if conditions and not (
                isinstance(outcome, Branch) and outcome.otherwise
            ):
                return [*self._comment(only, BODY_INDENT), *self._alternative(only, BODY_INDENT, "", "if decide and")]
            case _:
                return [" " * BODY_INDENT + "if decide:", *self._decide(decisions, BODY_INDENT + 4)]

    def _enter_or_leave(self, phase: str, stem: str, steps: tuple[ActionStep, ...]) -> list[MethodView]:
        """Write the enter or leave method; a single code action is inlined."""
        if not steps:
            return []
        signature = f"_{phase}_{stem}(self) -> None"
        match steps:
            case (CodeStep(code=body),):
                return [_method(signature, "", [_region(body, BODY_INDENT)])]
            case _:
                return [_method(signature, "", self._steps(steps)), *self._actions(steps)]

    def _predicates(self, alternatives: tuple[DecisionPlan, ...]) -> list[MethodView]:
        return [
            _method(f"_when_{body.stem}(self) -> bool", body.doc, [_region(body, BODY_INDENT)])
            for body in iter_guard_code(alternatives)
        ]

    def _actions(self, steps: tuple[ActionStep, ...]) -> list[MethodView]:
        bodies = [step.code for step in steps if isinstance(step, CodeStep)]
        return [_method(f"_do_{body.stem}(self) -> None", body.doc, [_region(body, BODY_INDENT)]) for body in bodies]

    def _steps(self, steps: tuple[ActionStep, ...]) -> list[str]:
        return [line for step in steps for line in self._step(step)]

    def _step(self, step: ActionStep) -> list[str]:
        match step:
            case CodeStep(code=body):
                return [" " * BODY_INDENT + f"self._do_{body.stem}()"]
            case CallStep(alias=alias, arguments=arguments, defaults=defaults):
                values: list[Doc] = [f"self.{alias}"]
                pairs = (*arguments, *defaults)
                values += [
                    concat(f"{name}=", self.expression_printer.stored_doc(value).breakable) for name, value in pairs
                ]
                return render_doc(call_doc("self._call", values), BODY_INDENT)
            case AssignStep():
                return self._assign(step)

    def _assign(self, step: AssignStep) -> list[str]:
        printer = self.expression_printer
        target = f"self.{step.alias}.{step.name}" if step.alias else f"self.{step.name}"
        match step.value:
            case Binary(operator="+" | "-" | "*" as operator, left=left, right=right) as value if _is_target(
                left, step
            ) and printer.ranges.is_storable(value):
                return format_statement(f"{target} {operator}= ", printer.to_doc(right), indent=BODY_INDENT)
            case value:
                return format_statement(f"{target} = ", printer.stored_doc(value), indent=BODY_INDENT)

    def _decide(self, alternatives: tuple[DecisionPlan, ...], indent: int, ended: str = "") -> list[str]:
        lines: list[str] = []
        for alternative in alternatives:
            lines += self._comment(alternative, indent)
            if not alternative.conditions:
                lines += self._outcome(alternative.outcome, indent, ended)
            else:
                lines += self._alternative(alternative, indent, ended)
        return lines

    def _alternative(self, alternative: DecisionPlan, indent: int, ended: str, keyword: str = "if") -> list[str]:
        lines = [*self._condition(alternative, indent, keyword), *self._outcome(alternative.outcome, indent + 4, ended)]
        outcome = alternative.outcome
        if not isinstance(outcome, Branch) or not outcome.otherwise:
            return lines
        if outcome.then_always_ends:
            return [*lines, *self._decide(outcome.otherwise, indent, ended)]
        match outcome.otherwise:
            case (DecisionPlan(conditions=conditions) as only,) if conditions and not self._comment(only, indent):
                return [*lines, *self._alternative(only, indent, ended, "elif")]
            case _:
                return [*lines, " " * indent + "else:", *self._decide(outcome.otherwise, indent + 4, ended)]

    def _outcome(self, outcome: StateChange | NoChange | Branch, indent: int, ended: str) -> list[str]:
        margin = " " * indent
        match outcome:
            case StateChange(state=state, transition=transition):
                arguments: list[Doc] = [quoted(state), *([quoted(transition)] if transition else [])]
                return [*render_doc(call_doc("self._change_to", arguments), indent), f"{margin}return{ended}"]
            case NoChange():
                return [f"{margin}self._stay()", f"{margin}return{ended}"]
            case Branch(then=then):
                return self._decide(then, indent, ended) or [f"{margin}pass"]

    def _condition(self, alternative: DecisionPlan, indent: int, keyword: str) -> list[str]:
        piece = self.expression_printer.conditions_to_doc(alternative.conditions)
        if keyword.endswith(" and"):
            first, keyword = keyword.split()[1], keyword.split(maxsplit=1)[0]
            piece = operator_chain([(None, atom(first)), ("and", piece)], AND)
        for condition in alternative.conditions:
            time = literal_value(condition.time) if isinstance(condition, TimerCondition) else None
            if time is not None:
                suffix = f"  # after {time:g} {self.component.time_unit}"
                lines = format_statement(f"{keyword} ", piece, ":" + suffix, indent=indent)
                if all(len(line) <= LINE_WIDTH for line in lines):
                    return lines
        return format_statement(f"{keyword} ", piece, ":", indent=indent)

    def _comment(self, alternative: DecisionPlan, indent: int) -> list[str]:
        has_method = any(isinstance(condition, CodeCondition) for condition in alternative.conditions)
        return [] if has_method or not alternative.doc.strip() else comment(alternative.doc, indent)


def _method(signature: str, doc: str, lines: list[str]) -> MethodView:
    body = [docstring(doc, BODY_INDENT)] if doc.strip() else []
    body += lines
    return MethodView(
        signature=" " * METHOD_INDENT + f"def {signature}:", body="\n".join(body or [" " * BODY_INDENT + "pass"])
    )


def _is_target(node: Expr, step: AssignStep) -> bool:
    match node:
        case Variable(name=name, kind=kind):
            return not step.alias and name == step.name and kind != ScopeSymbolKind.CONSTANT
        case OutputRef(alias=alias, output=name):
            return (alias, name) == (step.alias, step.name)
        case _:
            return False


def _region(body: CodePlan, indent: int) -> str:
    return wrap_region(body.region_id, python_code(body), indent=" " * indent).removesuffix("\n")


def section_code(component: ComponentPlan) -> Iterator[CodePlan]:
    """The code of the module and of the class, where it is written in Python."""
    for code in (component.module_code, component.members):
        if code is not None and code.code.in_language("python") is not None:
            yield code


def python_code(body: CodePlan) -> str:
    """Return the Python text of the code, with `pass` if it has no statement.

    Raises:
        UnsoundDesignError: The code is not written in Python.
    """
    text = body.code.in_language("python")
    if text is None:
        raise UnsoundDesignError(f"the code of '{body.region_id}' is not written in Python")
    if has_statement(text):
        return text
    return f"{text.rstrip()}\npass" if text.strip() else "pass"
