"""Writes the module of one component."""

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from operator import itemgetter

from vicode.generators.javascript.expression_printer import JavaScriptExpressionPrinter
from vicode.generators.javascript.names import escape
from vicode.generators.plan import (
    INTERFACES_MODULE,
    ActionStep,
    AssignStep,
    Branch,
    CallStep,
    ComponentPlan,
    DecisionPlan,
    InterfacePlan,
    PackagePlan,
    ProjectPlan,
    StateChange,
    StatePlan,
    UnsoundDesignError,
    ValuePlan,
)
from vicode.regions import escape_marks

_INDENT = "  "


def check_supported(component: ComponentPlan) -> None:
    """Raise if JavaScript cannot express a component.

    Raises:
        UnsoundDesignError: The component has code or cooperative states.
    """
    code = [*component.guard_code, *component.action_code, *filter(None, (component.module_code, component.members))]
    if code:
        raise UnsoundDesignError(f"{component.component} contains code, which has no counterpart in JavaScript")
    if any(state.is_cooperative for state in component.states):
        raise UnsoundDesignError(f"{component.component} has states of a team, which JavaScript does not support")


@dataclass(frozen=True, kw_only=True)
class JavaScriptWriter:
    """Writes the class of a component with a design."""

    package: PackagePlan
    component: ComponentPlan

    @cached_property
    def printer(self) -> JavaScriptExpressionPrinter:
        return JavaScriptExpressionPrinter.of_component(self.component)

    def write(self) -> str:
        check_supported(self.component)
        return "\n".join([*self._imports(), "", *self._class()]) + "\n"

    def _imports(self) -> Iterator[str]:
        yield 'import * as bica from "../bica.mjs";'
        if self.package.has_declarations:
            yield 'import * as declarations from "./declarations.mjs";'
        uses = sorted({(use.module or INTERFACES_MODULE, escape(use.component)) for use in self.component.uses})
        for module, group in groupby(uses, key=itemgetter(0)):
            yield f'import {{ {", ".join(name for _module, name in group)} }} from "./{module}.mjs";'

    def _class(self) -> Iterator[str]:
        plan = self.component
        yield from comment(plan.doc or f"The component {plan.component}.", 0)
        yield f"export class {escape(plan.component)} extends bica.Component {{"
        yield from indented(self._constructor(), 1)
        if plan.common_decisions:
            yield from ("", f"{_INDENT}$decideCommon() {{")
            yield from indented((*self._decisions(plan.common_decisions), "return undefined;"), 2)
            yield f"{_INDENT}}}"
        if plan.common_actions:
            yield from ("", f"{_INDENT}$actCommon() {{")
            yield from indented(self._steps(plan.common_actions), 2)
            yield f"{_INDENT}}}"
        yield "}"

    def _constructor(self) -> Iterator[str]:
        plan = self.component
        options = [f"periodNs: {round(1e9 / plan.frequency_hz)}"] if plan.frequency_hz else []
        options += ["resume: true"] if plan.resume else []
        options += ["xabsl: true"] if plan.arithmetic == "xabsl" else []
        given = f", {{ {', '.join(options)} }}" if options else ""
        yield "constructor(root) {"
        yield f"{_INDENT}super(root, {json.dumps(plan.component)}{given});"
        for use in plan.uses:
            yield f"{_INDENT}this.{escape(use.alias)} = root.component({escape(use.component)});"
        yield from indented(declare(plan.parameters, (*plan.outputs, *plan.variables), self.printer), 1)
        yield f"{_INDENT}this.$define({json.dumps(plan.states[0].name)}, {{"
        for state in plan.states:
            yield from indented(self._state(state), 2)
        yield f"{_INDENT}}});"
        yield "}"

    def _state(self, state: StatePlan) -> Iterator[str]:
        yield from comment(state.doc, 0)
        yield f"{state_key(state.name)}: {{"
        if state.final:
            yield f"{_INDENT}final: true,"
        for key, aliases in (("requires", state.requires), ("calls", state.calls)):
            if aliases and (key != "calls" or self.component.uses_action_done):
                yield f"{_INDENT}{key}: [{', '.join(f'this.{escape(alias)}' for alias in aliases)}],"
        for key, steps in (("enter", state.enter), ("leave", state.leave)):
            yield from self._function(key, self._steps(steps))
        yield from self._function("decide", self._decisions(state.decisions), "return undefined;")
        yield from self._function("act", self._steps(state.actions))
        yield "},"

    def _function(self, key: str, body: Iterable[str], end: str = "") -> Iterator[str]:
        lines = list(body)
        if lines:
            lines += [end] if end and not lines[-1].startswith("return") else []
            yield f"{_INDENT}{key}: () => {{"
            yield from indented(lines, 2)
            yield f"{_INDENT}}},"

    def _decisions(self, decisions: Iterable[DecisionPlan]) -> Iterator[str]:
        for decision in decisions:
            yield from comment(decision.doc, 0)
            if not decision.conditions:
                yield from self._outcome(decision)
                continue
            yield f"if ({self.printer.guard(decision.conditions)}) {{"
            yield from indented(self._outcome(decision), 1)
            if isinstance(decision.outcome, Branch) and decision.outcome.otherwise:
                yield "} else {"
                yield from indented(self._decisions(decision.outcome.otherwise), 1)
            yield "}"

    def _outcome(self, decision: DecisionPlan) -> Iterator[str]:
        match decision.outcome:
            case StateChange(state=state, transition=transition):
                yield f"return [{', '.join(map(json.dumps, filter(None, (state, transition))))}];"
            case Branch(then=then):
                yield from self._decisions(then)
            case _:
                yield "return bica.STAY;"

    def _steps(self, steps: Iterable[ActionStep]) -> Iterator[str]:
        for step in steps:
            match step:
                case AssignStep(name=name, value=value, alias=alias):
                    owner = f"this.{escape(alias)}" if alias else "this"
                    yield f"{owner}.{escape(name)} = {self.printer.stored(value)};"
                case CallStep(alias=alias, arguments=arguments):
                    given = ", ".join(f"{escape(name)}: {self.printer.stored(value)}" for name, value in arguments)
                    yield f"this.$call(this.{escape(alias)}, {{{f' {given} ' if given else ''}}});"


def state_key(name: str) -> str:
    """The name of a state as a key of an object literal, in which `__proto__` has a meaning unless it is computed."""
    return name if name.isascii() and name.isidentifier() and name != "__proto__" else f"[{json.dumps(name)}]"


def write_interfaces(plan: ProjectPlan, interfaces: Iterable[InterfacePlan]) -> str:
    """The classes of components without a design, which hold their initial values until the program sets others."""
    lines = ['import * as bica from "../bica.mjs";']
    lines += ['import * as declarations from "./declarations.mjs";'] if plan.package.has_declarations else []
    printer = JavaScriptExpressionPrinter(ranges=plan.ranges)
    for item in interfaces:
        interface = plan.project.interface(item.component)
        hertz = interface.frequency_hz if interface else None
        options = f", {{ periodNs: {round(1e9 / hertz)} }}" if hertz else ""
        lines += ["", *comment(item.doc or f"The component {item.component}.", 0)]
        lines += [f"export class {escape(item.component)} extends bica.Component {{", f"{_INDENT}constructor(root) {{"]
        lines += [f"{_INDENT * 2}super(root, {json.dumps(item.component)}{options});"]
        lines += indented(declare(item.parameters, (*item.outputs, *item.variables), printer), 2)
        lines += [f"{_INDENT}}}"]
        for function in item.functions:
            result = printer.stored(function.result.initial)
            lines += ["", *comment(function.result.doc, 1), f"{_INDENT}{escape(function.result.name)}(_given) {{"]
            lines += [f"{_INDENT * 2}return {result};", f"{_INDENT}}}"]
        lines += ["}"]
    return "\n".join(lines) + "\n"


def write_declarations(plan: ProjectPlan) -> str:
    lines = ['import * as bica from "../bica.mjs";']
    for item in plan.enumerations:
        lines += ["", *comment(item.doc, 0), f"export const {escape(item.name)} = Object.freeze({{"]
        lines += [f"{_INDENT}{escape(name)}: {json.dumps(f'{item.name}.{name}')}," for name in item.element_names]
        lines += ["});"]
    printer = JavaScriptExpressionPrinter(ranges=plan.ranges, declarations="")
    for constant in plan.constants:
        value = printer.stored(constant.initial)
        lines += ["", *comment(constant.doc, 0), f"export const {escape(constant.name)} = {value};"]
    return "\n".join(lines) + "\n"


def declare(
    parameters: Iterable[ValuePlan], values: Iterable[ValuePlan], printer: JavaScriptExpressionPrinter
) -> Iterator[str]:
    """The statement that declares the values of a component."""
    sections = [
        [f"{escape(value.name)}: {printer.stored(value.initial)}" for value in each] for each in (parameters, values)
    ]
    if any(sections):
        first, second = (f"{{ {', '.join(section)} }}" if section else "{}" for section in sections)
        yield f"this.$declare({first}, {second});"


def indented(lines: Iterable[str], depth: int) -> Iterator[str]:
    return (f"{_INDENT * depth}{line}" for line in lines)


def comment(text: str, depth: int) -> list[str]:
    """A line of comment; empty for an empty text."""
    words = " ".join(escape_marks(text).split())
    return [f"{_INDENT * depth}// {words}"] if words else []
