"""The methods of a generated class: what a state decides and does, line by line."""

from dataclasses import dataclass

from vicode.generators.plan import (
    After,
    Alternative,
    Body,
    Branch,
    CallComponent,
    Change,
    ComponentPlan,
    Keep,
    Predicate,
    Run,
    Set,
    StatePlan,
    Step,
    UnsoundDesignError,
    literal_of,
)
from vicode.generators.python.layout import WIDTH, Doc, call, joined, render
from vicode.generators.python.names import has_statement
from vicode.generators.python.pieces import AND, atom, chain, statement
from vicode.generators.python.spelling import Speller
from vicode.generators.python.text import comment, docstring, quoted
from vicode.generators.python.views import MethodView
from vicode.model.expressions import Binary, Kind, Node, Reading, Variable
from vicode.regions import wrap

METHOD, BODY = 4, 8


@dataclass(frozen=True, slots=True, kw_only=True)
class MethodWriter:
    """Writes the methods of one component."""

    component: ComponentPlan
    speller: Speller

    def write_states(self) -> list[MethodView]:
        """Every method that comes from states, in the order of a reader."""
        plan = self.component
        methods: list[MethodView] = []
        if plan.decide_first:
            doc = "Test what is tested before the guards of every state; true if that ended the decision."
            lines = [*self._decide(plan.decide_first, BODY, ended=" True")]
            lines += [] if lines[-1:] == [" " * BODY + "return True"] else [" " * BODY + "return False"]
            methods += [_method("_decide_common(self) -> bool", doc, lines), *self._predicates(plan.decide_first)]
        if plan.act_first:
            lines = self._steps(plan.act_first)
            methods += [_method("_act_common(self) -> None", "Act as in every state.", lines)]
            methods += self._actions(plan.act_first)
        for state in plan.states:
            methods += self._write_state(state)
        return methods

    def _write_state(self, state: StatePlan) -> list[MethodView]:
        return [
            _method(f"_in_{state.stem}(self, decide: bool = True) -> None", state.doc, self._lines_in(state)),
            *self._passage("enter", state.stem, state.enter),
            *self._passage("leave", state.stem, state.leave),
            *self._predicates(state.decisions),
            *self._actions(state.act),
        ]

    def _lines_in(self, state: StatePlan) -> list[str]:
        margin = " " * BODY
        lines: list[str] = []
        if self.component.decide_first:
            lines += [f"{margin}if decide and self._decide_common():", f"{margin}    return"]
        lines += self._decide_own(state.decisions)
        if self.component.act_first:
            lines.append(f"{margin}self._act_common()")
        return [*lines, *self._steps(state.act)]

    def _decide_own(self, decisions: tuple[Alternative, ...]) -> list[str]:
        match decisions:
            case ():
                return []
            case (Alternative(conditions=conditions, outcome=outcome) as only,) if conditions and not (
                isinstance(outcome, Branch) and outcome.otherwise
            ):
                return [*self._remark(only, BODY), *self._alternative(only, BODY, "", "if decide and")]
            case _:
                return [" " * BODY + "if decide:", *self._decide(decisions, BODY + 4)]

    def _passage(self, phase: str, stem: str, steps: tuple[Step, ...]) -> list[MethodView]:
        """What is done on entering or leaving; code that stands alone there needs no method of its own."""
        if not steps:
            return []
        signature = f"_{phase}_{stem}(self) -> None"
        match steps:
            case (Run(body=body),):
                return [_method(signature, "", [_region(body, BODY)])]
            case _:
                return [_method(signature, "", self._steps(steps)), *self._actions(steps)]

    def _predicates(self, alternatives: tuple[Alternative, ...]) -> list[MethodView]:
        methods: list[MethodView] = []
        for alternative in alternatives:
            for condition in alternative.conditions:
                if isinstance(condition, Predicate):
                    body = condition.body
                    methods.append(_method(f"_when_{body.stem}(self) -> bool", body.doc, [_region(body, BODY)]))
            if isinstance(alternative.outcome, Branch):
                methods += self._predicates(alternative.outcome.then + alternative.outcome.otherwise)
        return methods

    def _actions(self, steps: tuple[Step, ...]) -> list[MethodView]:
        bodies = [step.body for step in steps if isinstance(step, Run)]
        return [_method(f"_do_{body.stem}(self) -> None", body.doc, [_region(body, BODY)]) for body in bodies]

    def _steps(self, steps: tuple[Step, ...]) -> list[str]:
        return [line for step in steps for line in self._step(step)]

    def _step(self, step: Step) -> list[str]:
        match step:
            case Run(body=body):
                return [" " * BODY + f"self._do_{body.stem}()"]
            case CallComponent(alias=alias, arguments=arguments, defaults=defaults):
                given: list[Doc] = [f"self.{alias}"]
                pairs = (*arguments, *defaults)
                given += [joined(f"{name}=", self.speller.spell(value).breakable) for name, value in pairs]
                return render(call("self._call", given), BODY)
            case Set(name=name, value=value, alias=alias) if alias:
                return self._set_there(alias, name, value)
            case Set(name=name, value=value):
                return self._set(name, value)

    def _set_there(self, alias: str, name: str, value: Node) -> list[str]:
        match value:
            case Binary(operator="+" | "-" | "*" as operator, left=Reading(alias=there, output=left), right=right) if (
                there == alias and left == name
            ):
                return statement(f"self.{alias}.{name} {operator}= ", self.speller.spell(right), indent=BODY)
            case _:
                return statement(f"self.{alias}.{name} = ", self.speller.spell(value), indent=BODY)

    def _set(self, name: str, value: Node) -> list[str]:
        match value:
            case Binary(operator="+" | "-" | "*" as operator, left=Variable(name=left, kind=kind), right=right) if (
                left == name and kind != Kind.CONSTANT
            ):
                return statement(f"self.{name} {operator}= ", self.speller.spell(right), indent=BODY)
            case _:
                return statement(f"self.{name} = ", self.speller.spell(value), indent=BODY)

    def _decide(self, alternatives: tuple[Alternative, ...], indent: int, ended: str = "") -> list[str]:
        lines: list[str] = []
        for alternative in alternatives:
            lines += self._remark(alternative, indent)
            if not alternative.conditions:
                lines += self._outcome(alternative.outcome, indent, ended)
            else:
                lines += self._alternative(alternative, indent, ended)
        return lines

    def _alternative(self, alternative: Alternative, indent: int, ended: str, keyword: str = "if") -> list[str]:
        lines = [*self._condition(alternative, indent, keyword), *self._outcome(alternative.outcome, indent + 4, ended)]
        outcome = alternative.outcome
        if not isinstance(outcome, Branch) or not outcome.otherwise:
            return lines
        if outcome.then_ends:
            return [*lines, *self._decide(outcome.otherwise, indent, ended)]
        match outcome.otherwise:
            case (Alternative(conditions=conditions) as only,) if conditions and not self._remark(only, indent):
                return [*lines, *self._alternative(only, indent, ended, "elif")]
            case _:
                return [*lines, " " * indent + "else:", *self._decide(outcome.otherwise, indent + 4, ended)]

    def _outcome(self, outcome: Change | Keep | Branch, indent: int, ended: str) -> list[str]:
        margin = " " * indent
        match outcome:
            case Change(state=state, transition=transition):
                arguments: list[Doc] = [quoted(state), *([quoted(transition)] if transition else [])]
                return [*render(call("self._change_to", arguments), indent), f"{margin}return{ended}"]
            case Keep():
                return [f"{margin}self._stay()", f"{margin}return{ended}"]
            case Branch(then=then):
                return self._decide(then, indent, ended) or [f"{margin}pass"]

    def _condition(self, alternative: Alternative, indent: int, keyword: str) -> list[str]:
        piece = self.speller.spell_conditions(alternative.conditions)
        if keyword.endswith(" and"):
            first, keyword = keyword.split()[1], keyword.split(maxsplit=1)[0]
            piece = chain([(None, atom(first)), ("and", piece)], AND)
        for condition in alternative.conditions:
            time = literal_of(condition.time) if isinstance(condition, After) else None
            if time is not None:
                remark = f"  # after {time:g} {self.component.time_unit}"
                lines = statement(f"{keyword} ", piece, ":" + remark, indent=indent)
                if all(len(line) <= WIDTH for line in lines):
                    return lines
        return statement(f"{keyword} ", piece, ":", indent=indent)

    def _remark(self, alternative: Alternative, indent: int) -> list[str]:
        has_method = any(isinstance(condition, Predicate) for condition in alternative.conditions)
        return [] if has_method or not alternative.doc.strip() else comment(alternative.doc, indent)


def _method(signature: str, doc: str, lines: list[str]) -> MethodView:
    body = [docstring(doc, BODY)] if doc.strip() else []
    body += lines
    return MethodView(signature=" " * METHOD + f"def {signature}:", body="\n".join(body or [" " * BODY + "pass"]))


def _region(body: Body, indent: int) -> str:
    return wrap(body.region, python_code(body), indent=" " * indent).removesuffix("\n")


def python_code(body: Body) -> str:
    """The Python of a body, with `pass` where there is nothing to do.

    Raises:
        UnsoundDesignError: It is not written in Python.
    """
    text = body.code.in_language("python")
    if text is None:
        raise UnsoundDesignError(f"the code of '{body.region}' is not written in Python")
    if has_statement(text):
        return text
    return f"{text.rstrip()}\npass" if text.strip() else "pass"
