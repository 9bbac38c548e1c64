"""Writes the member functions of a component: its decisions and actions."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

from vicode.generators.cpp.expression_printer import ExpressionPrinter
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
    UsedComponent,
    typed_tree,
)
from vicode.model.expressions import (
    BOOL,
    UNKNOWN,
    Binary,
    OutputRef,
    Scope,
    ScopeSymbolKind,
    Variable,
    build_scope,
    walk,
)
from vicode.model.portable_code import (
    PortableAssign,
    PortableCall,
    PortableIf,
    PortableReturn,
    PortableStatement,
    Role,
    always_returns,
    parse_portable,
)
from vicode.regions import wrap_region

INDENT = 4


@dataclass(frozen=True, kw_only=True)
class FunctionWriter:
    """Writes the member functions of one component."""

    component: ComponentPlan
    class_name: str
    printer: ExpressionPrinter

    @cached_property
    def state_names(self) -> dict[str, str]:
        return state_names(self.component)

    @property
    def _inline_change(self) -> str:
        """Each outcome of a decision would contain a copy: compilers need seconds for hundreds of them."""
        return "" if is_large(self.component) else "BICA_INLINE "

    @cached_property
    def uses(self) -> dict[str, UsedComponent]:
        return {use.alias: use for use in self.component.uses}

    @cached_property
    def scope(self) -> Scope:
        return build_scope(self.component.project, self.component.design)

    @cached_property
    def is_cooperative(self) -> bool:
        return any(state.is_cooperative for state in self.component.states)

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
                # Not inline: the live view calls both from another source.
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
        doc = "Takes the first transition whose guard holds."
        return self._function("void", "decide", "", body, doc, inline="BICA_INLINE ")

    def _act(self) -> FunctionView:
        body = ["    act_common();"] if self.component.common_actions else []
        body += self._switch(lambda state: self._steps(state.actions, 3 * INDENT))
        return self._function("void", "act", "", body, "Runs the actions of the active state.", inline="BICA_INLINE ")

    def _change_to(self) -> FunctionView:
        plan = self.component
        body = ["    if (!may_enter(next)) {", "        return;", "    }"] if self.is_cooperative else []
        body += ["    if (next == state_) {", "        return;", "    }"]
        if any(state.leave for state in plan.states):
            body.append("    leave();")
        requires = requirements_differ(plan)
        if requires:
            body.append("    const std::uint64_t required = required_by(state_);")
        body += ["    change_state(transition);", "    state_ = next;"]
        if any(state.enter for state in plan.states):
            body.append("    enter();")
        if requires:
            body.append("    require(required);")
        parameters = "State next, const char* transition"
        return self._function("void", "change_to", parameters, body, "", inline=self._inline_change)

    def _switch(self, write: Callable[[StatePlan], list[str]]) -> list[str]:
        """A switch over the active state; states with the same lines share them, those without are the default."""
        names = self.state_names
        blocks: dict[tuple[str, ...], list[StatePlan]] = {}
        for state in self.component.states:
            blocks.setdefault(tuple(write(state)), []).append(state)
        if set(blocks) == {()}:
            return []
        if len(blocks) == 1:
            return [line[2 * INDENT :] for block in blocks for line in block]
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
            *self.printer.guard(decision.conditions).lines(f"{margin}if (", ") {", indent),
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
                arguments = f"State::{self.state_names[state]}" + (f", {quoted(transition)}" if transition else "")
                return [f"{margin}change_to({arguments});", end]
            case NoChange():
                return [*([f"{margin}stay();"] if self.is_cooperative else []), end]
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
        use = self.uses[step.alias]
        stored = ", calls_" if self.component.frequency_hz else ""
        given = dict((*step.arguments, *step.defaults))
        if not _is_in_order(step, use):
            return self._call_in_written_order(step, use, stored, indent)
        count = max((index + 1 for index, value in enumerate(use.parameters) if value.name in given), default=0)
        values = [
            f"/*{value.name}=*/{self.printer.stored(given.get(value.name, value.initial)).text}"
            for value in use.parameters[:count]
        ]
        line = f"{margin}call({target}, {{{', '.join(values)}}}{stored});"
        if len(line) <= LINE_WIDTH or not values:
            return [line]
        lines = [f"{margin}        {value}," for value in values]
        end = [f"{margin}    }},", f"{margin}    calls_);"] if stored else [f"{margin}    }});"]
        return [f"{margin}call({target},", f"{margin}    {{", *lines, *end]

    def _call_in_written_order(self, step: CallStep, use: UsedComponent, stored: str, indent: int) -> list[str]:
        """A call whose arguments may change inputs of the world: they are evaluated in the order of the design."""
        margin = " " * indent
        type_ = f"{self.printer.names.class_name(use.component)}::Parameters"
        body = [
            f"{type_} parameters;",
            *(
                f"parameters.{member_name(name)} = {self.printer.stored(value).text};"
                for name, value in (*step.arguments, *step.defaults)
            ),
            "return parameters;",
        ]
        target = member_name(step.alias)
        if not stored:
            lines = [f"{margin}    {line}" for line in body]
            return [f"{margin}call({target}, [&] {{", *lines, f"{margin}}}());"]
        lines = [f"{margin}        {line}" for line in body]
        head = [f"{margin}call(", f"{margin}    {target}, [&] {{"]
        return [*head, *lines, f"{margin}    }}(),", f"{margin}    calls_);"]

    def _assign(self, step: AssignStep, indent: int) -> list[str]:
        margin, value = " " * indent, step.value
        target = member_name(step.name)
        if step.alias:
            owner = member_name(step.alias)
            if (step.alias, step.name) in self.printer.inputs:
                return self.printer.stored(value).lines(f"{margin}{owner}.set_{target}(", ");", indent)
            target = f"{owner}.{target}"
        match value:
            case Binary(operator="+" | "-" | "*" as operator, left=left, right=right) if (
                left.type == value.type and _is_target(left, step) and self.printer.ranges.is_storable(value)
            ):
                operand = self.printer.print(right) if right.type == value.type else self.printer._float(right)
                return [f"{margin}{target} {operator}= {operand.text};"]
            case _:
                return self.printer.stored(value).lines(f"{margin}{target} = ", ";", indent)

    # Hand-written code

    def _code_functions(self) -> Iterator[FunctionView]:
        for code in self.component.guard_code:
            body = region(code, self._code(code, "predicate"), INDENT)
            yield self._function("bool", f"when_{code.stem}", "", body, code.doc)
        for code in self.component.action_code:
            body = region(code, self._code(code, "action"), INDENT)
            yield self._function("void", f"do_{code.stem}", "", body, code.doc)

    def _code(self, code: CodePlan, role: Role) -> str:
        """The C++ text of hand-written code, translated from Python if it is not written in C++."""
        written = code.code.in_language("cpp")
        if written is not None:
            return written
        python = code.code.in_language("python")
        statements = parse_portable(python, role, self.scope) if python is not None else None
        if not isinstance(statements, tuple):
            reason = f": {statements.reason}" if statements else ""
            raise UnsoundDesignError(f"the code of '{code.region_id}' is not written in C++{reason}")
        lines = self._statements(statements, 0, self.scope)
        if role == "predicate" and not always_returns(statements):
            lines.append("return false;")
        return "\n".join(lines)

    def _statements(self, statements: Iterable[PortableStatement], indent: int, scope: Scope) -> list[str]:
        return [line for statement in statements for line in self._statement(statement, indent, scope)]

    def _statement(self, statement: PortableStatement, indent: int, scope: Scope) -> list[str]:
        margin = " " * indent
        match statement:
            case PortableAssign(target=target, value=value):
                declaration = scope.find_assignable(target)
                expected = scope.type_of(declaration) if declaration else UNKNOWN
                alias, _dot, name = target.rpartition(".")
                step = AssignStep(name=name, value=typed_tree(value, scope, expected), alias=alias)
                return self._assign(step, indent)
            case PortableCall(call=call):
                return self.printer.print(typed_tree(call, scope, None)).lines(margin, ";", indent)
            case PortableReturn(value=""):
                return [f"{margin}return;"]
            case PortableReturn(value=value):
                return self.printer.print(typed_tree(value, scope, BOOL)).lines(f"{margin}return ", ";", indent)
            case PortableIf(test=test, then=then, otherwise=otherwise):
                printed = self.printer.print(typed_tree(test, scope, BOOL))
                lines = [
                    *printed.lines(f"{margin}if (", ") {", indent),
                    *self._statements(then, indent + INDENT, scope),
                ]
                match otherwise:
                    case ():
                        return [*lines, f"{margin}}}"]
                    case (PortableIf() as only,):
                        first, *rest = self._statement(only, indent, scope)
                        return [*lines, f"{margin}}} else {first.lstrip()}", *rest]
                    case _:
                        rest = self._statements(otherwise, indent + INDENT, scope)
                        return [*lines, f"{margin}}} else {{", *rest, f"{margin}}}"]

    def _function(
        self, type_: str, name: str, parameters: str, body: Sequence[str], doc: str, *, inline: str = ""
    ) -> FunctionView:
        defaulted = parameters.replace("const char* transition", "const char* transition = nullptr")
        return FunctionView(
            declaration=f"{type_} {name}({defaulted});",
            signature=f"{inline}{type_} {self.class_name}::{name}({parameters})",
            body=tuple(body),
            doc=tuple(doc_comment(doc)),
        )


def is_large(component: ComponentPlan) -> bool:
    """Whether the code of a state change and of an observed step exists only once (see `python -m benchmarks.cpp`)."""
    return len(component.states) > 32


def requirements_differ(component: ComponentPlan) -> bool:
    """Whether a change of the state may require components that the old state did not."""
    return len({state.requires for state in component.states}) > 1


def region(code: CodePlan, text: str, indent: int) -> list[str]:
    """The lines of hand-written code between marks."""
    return wrap_region(code.region_id, text, comment="//", indent=" " * indent).removesuffix("\n").split("\n")


def _is_target(node: object, step: AssignStep) -> bool:
    match node:
        case Variable(name=name, kind=kind):
            return not step.alias and name == step.name and kind != ScopeSymbolKind.CONSTANT
        case OutputRef(alias=alias, output=name, arguments=None):
            return (alias, name) == (step.alias, step.name)
        case _:
            return False


def _is_in_order(step: CallStep, use: UsedComponent) -> bool:
    """Whether the order in which the arguments are written does not matter, or is that of the declarations."""
    names = [name for name, _value in step.arguments]
    declared = [value.name for value in use.parameters if value.name in names]
    calls = (isinstance(node, OutputRef) for _name, value in step.arguments for node in walk(value))
    return names == declared or not any(calls)


def _ends(block: Sequence[str]) -> bool:
    return block[-1].startswith(" " * 3 * INDENT + "return")
