"""Writes the header and the source of one component."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from vicode.generators.cpp.expression_printer import ExpressionPrinter, format_number
from vicode.generators.cpp.functions import FunctionWriter, is_large, region, requirements_differ
from vicode.generators.cpp.names import GlobalNames, argument_name, integer_type, member_name, state_names
from vicode.generators.cpp.text import LINE_WIDTH, describe, doc_comment, quoted
from vicode.generators.cpp.views import ComponentView, FunctionView
from vicode.generators.plan import (
    INTERFACES_MODULE,
    CallStep,
    CodePlan,
    ComponentPlan,
    ProjectPlan,
    StatePlan,
    UnsoundDesignError,
    ValuePlan,
)
from vicode.model.expressions import BOOL, FLOAT, INT

_BITS, _MOST_REQUIRED = "std::uint64_t", 64
CODE_HASH = "@code_hash@"
"""What stands in the source of a component in the place of its hash while that is not known."""


@dataclass(frozen=True, kw_only=True)
class CppComponentWriter:
    """Writes one component."""

    project: ProjectPlan
    component: ComponentPlan
    global_names: GlobalNames

    @cached_property
    def names(self) -> GlobalNames:
        """The global names as the class writes them."""
        plan = self.component
        values = [value.name for value in (*plan.parameters, *plan.outputs, *plan.variables)]
        return self.global_names.inside(member_name(name) for name in (*values, *(use.alias for use in plan.uses)))

    @cached_property
    def class_name(self) -> str:
        return self.global_names.class_name(self.component.component)

    @cached_property
    def printer(self) -> ExpressionPrinter:
        return ExpressionPrinter.of_component(self.component, self.names, self.project.nonzero_constants)

    def build_view(self) -> ComponentView:
        plan = self.component
        writer = FunctionWriter(component=plan, class_name=self.class_name, printer=self.printer)
        return ComponentView(
            namespace=self.global_names.namespace,
            name=self.class_name,
            base="bica::XabslComponent" if plan.arithmetic == "xabsl" else "bica::Component",
            doc=tuple(doc_comment(plan.doc or f"The component {plan.component}.")),
            header=f"{self.project.package.name}/{plan.module}.hpp",
            includes=tuple(self._list_includes()),
            module_code=_region_lines(plan.module_code, 0),
            state_type=integer_type(len(plan.states)),
            states=tuple(_listed(list(state_names(plan).values()))),
            parameters=tuple(
                line for value in plan.parameters for line in declare_value(value, self.printer, self.names, 8)
            ),
            declaration=tuple(break_list("    ", f"{self.class_name}(", self._constructor(), ");")),
            constructor=tuple(
                break_list("", f"{self.class_name}::{self.class_name}(", self._constructor(), ")", is_explicit=False)
            ),
            initializers=self._initializers(),
            members=tuple(self._members()),
            initial_state=state_names(plan)[plan.states[0].name],
            cooperative_states=tuple(self._cooperative_states()),
            calls=self._calls(),
            member_code=_region_lines(plan.members, 4),
            public_functions=tuple(self._public_functions()),
            private_functions=(*self._runtime_functions(), *writer.write()),
        )

    def _list_includes(self) -> Iterator[str]:
        package = self.project.package.name
        if self.project.package.has_declarations:
            yield f"{package}/declarations.hpp"
        if any(use.module in {"", INTERFACES_MODULE} for use in self.component.uses):
            yield f"{package}/interfaces.hpp"
        for use in self.component.uses:
            if use.module not in {"", INTERFACES_MODULE}:
                yield f"{package}/{use.module}.hpp"

    def _constructor(self) -> tuple[str, ...]:
        uses = [f"{self.names.class_name(use.component)}& {argument_name(use.alias)}" for use in self.component.uses]
        return ("bica::Root& root_", *uses)

    def _initializers(self) -> tuple[str, ...]:
        plan = self.component
        frequency = [format_number(float(plan.frequency_hz))] if plan.frequency_hz else []
        base = "XabslComponent" if plan.arithmetic == "xabsl" else "Component"
        first = f"bica::{base}({', '.join(['root_', quoted(plan.component), *frequency])})"
        return (first, *(f"{member_name(use.alias)}({argument_name(use.alias)})" for use in plan.uses))

    def _members(self) -> Iterator[tuple[str, tuple[str, ...]]]:
        plan = self.component
        for title, values in (
            ("Parameters", plan.parameters),
            ("Outputs", plan.outputs),
            ("Variables", plan.variables),
        ):
            if values:
                yield (
                    title,
                    tuple(line for value in values for line in declare_value(value, self.printer, self.names, 4)),
                )
        if plan.uses:
            lines = [f"    {self.names.class_name(use.component)}& {member_name(use.alias)};" for use in plan.uses]
            yield "Used components", tuple(lines)

    def _cooperative_states(self) -> Iterator[str]:
        for state in self.component.states:
            if not state.is_cooperative:
                continue
            number = state.synchronized if state.capacity is None else state.capacity
            key = f"{{{quoted(self.component.component)}, {quoted(state.name)}}}"
            is_capacity = str(state.capacity is not None).lower()
            yield f"    bica::CooperativeState in_{state.stem}_{{root.team, *this, {key}, {number}, {is_capacity}}};"

    def _calls(self) -> str:
        """The type that stores the calls of a component with a frequency; empty if it makes none."""
        plan = self.component
        if not plan.frequency_hz:
            return ""
        sections = [
            plan.common_actions,
            *(steps for state in plan.states for steps in (state.enter, state.leave, state.actions)),
        ]
        calls = [step for steps in sections for step in steps if isinstance(step, CallStep)]
        if not calls:
            return ""
        most = max(_count_calls(state.actions) for state in plan.states) + _count_calls(plan.common_actions)
        most += max(_count_calls(state.enter) for state in plan.states)
        most += max(_count_calls(state.leave) for state in plan.states)
        used = {use.alias: use.component for use in plan.uses}
        components = dict.fromkeys(used[call.alias] for call in calls)
        return f"bica::CallsOf<{most}, {', '.join(map(self.names.class_name, components))}>"

    def _public_functions(self) -> Iterator[FunctionView]:
        plan = self.component
        resume = str(plan.resume).lower()
        is_xabsl = plan.arithmetic == "xabsl"
        again = ["    restart_again();"] if is_xabsl else []
        step = "step_large_machine" if is_large(plan) else "step_machine"
        yield self._define("void", "step", "", [*again, f"    {step}(*this, {resume});"], "override")
        if plan.parameters:
            body = [f"    {member_name(value.name)} = {_given(value)};" for value in plan.parameters]
            yield self._define("void", "modulate", "const Parameters& parameters", body, "")
        cases = [
            f"        case State::{name}:\n            return {quoted(state)};"
            for state, name in state_names(plan).items()
        ]
        body = [
            "    switch (state_) {",
            *(line for case in cases for line in case.split("\n")),
            "    }",
            '    return "";',
        ]
        yield self._define("const char*", "state_name", "", body, "const BICA_NAMED")
        if self.project.project.live:
            yield self._define("const char*", "code_hash", "", [f"    return {quoted(CODE_HASH)};"], "const")
        for name, values in (("visit_parameters", plan.parameters), ("visit_values", self._values)):
            if values:
                body = [f"    {line}" for line in visits(values)]
                yield self._define("void", name, "bica::ValueVisitor& visitor", body, "const BICA_NAMED")

    @property
    def _values(self) -> tuple[ValuePlan, ...]:
        plan = self.component
        return (*plan.parameters, *plan.outputs, *plan.variables)

    def _runtime_functions(self) -> Iterator[FunctionView]:
        """The functions that the runtime calls in a step, other than decisions and actions."""
        plan = self.component
        names = state_names(plan)
        body = [f"    state_ = State::{names[plan.states[0].name]};"]
        body = (["    mark_restart();"] if plan.arithmetic == "xabsl" else []) + body
        body += ["    calls_.clear();"] if self._calls() else []
        body += ["    restart();"]
        body += ["    enter();"] if any(state.enter for state in plan.states) else []
        yield self._define("void", "start", "", body, "")
        if any(state.final for state in plan.states):
            body = _grouped_switch(
                plan.states, names, lambda state: ["            return true;"] if state.final else [], "state_"
            )
            yield self._define("bool", "in_final_state", "", _with_return(body, "false"), "const override")
        if any(state.requires for state in plan.states):
            yield from self._require()
        if self._calls():
            yield self._define("void", "forget_calls", "", ["    calls_.clear();"], "")
            repeat = "    calls_.repeat([this](bica::Component& target) { step_modulated(target); });"
            yield self._define("void", "repeat_calls", "", [repeat], "")
        if plan.uses_action_done:
            yield self._define("bool", "action_done", "", list(self._action_done()), "const")
        yield from self._team_functions()

    def _require(self) -> Iterator[FunctionView]:
        plan, names = self.component, state_names(self.component)
        aliases = list(dict.fromkeys(alias for state in plan.states for alias in state.requires))
        if len(aliases) > _MOST_REQUIRED:
            raise UnsoundDesignError(f"{plan.component} requires more than {_MOST_REQUIRED} components")
        if not requirements_differ(plan):
            steps = [f"    {member_name(alias)}.step();" for alias in aliases]
            yield self._define("void", "require", _BITS, steps, "")
            return
        bits = {alias: 1 << index for index, alias in enumerate(aliases)}
        masks = {state.name: sum(bits[alias] for alias in set(state.requires)) for state in plan.states}
        body = _grouped_switch(
            plan.states,
            names,
            lambda state: [f"            return {masks[state.name]}ULL;"] if masks[state.name] else [],
            "state",
        )
        yield self._define(f"{_BITS}", "required_by", "State state", _with_return(body, "0"), "", is_static=True)
        steps = _grouped_switch(
            plan.states,
            names,
            lambda state: [
                line
                for alias in state.requires
                for line in (
                    f"            if ((already & {bits[alias]}ULL) == 0) {{",
                    f"                {member_name(alias)}.step();",
                    "            }",
                )
            ],
            "state_",
        )
        yield self._define("void", "require", f"{_BITS} already", steps, "")

    def _action_done(self) -> Iterator[str]:
        plan, names = self.component, state_names(self.component)
        body = _grouped_switch(
            plan.states,
            names,
            lambda state: (
                [f"            return {' || '.join(f'{member_name(alias)}.is_done()' for alias in state.calls)};"]
                if state.calls
                else []
            ),
            "state_",
        )
        yield from _with_return(body, "false")

    def _team_functions(self) -> Iterator[FunctionView]:
        plan, names = self.component, state_names(self.component)
        if any(state.is_cooperative for state in plan.states):
            cases = _grouped_switch(
                plan.states,
                names,
                lambda state: [f"            return in_{state.stem}_.may_enter();"] if state.is_cooperative else [],
                "next",
            )
            yield self._define("bool", "may_enter", "State next", _with_return(cases, "true"), "")
            yield self._define("void", "stay", "", ["    may_enter(state_);"], "")
            cases = _grouped_switch(
                plan.states,
                names,
                lambda state: [f"            return in_{state.stem}_.is_full();"] if state.is_cooperative else [],
                "state_",
            )
            yield self._define("bool", "conflict", "", _with_return(cases, "false"), "const")

    def _define(
        self, type_: str, name: str, parameters: str, body: Iterable[str], suffix: str, *, is_static: bool = False
    ) -> FunctionView:
        specifier = f" {suffix}" if suffix else ""
        return FunctionView(
            declaration=f"{'static ' if is_static else ''}{type_} {name}({parameters}){specifier};",
            signature=f"{type_} {self.class_name}::{name}({parameters}){' const' if 'const' in suffix else ''}",
            body=tuple(body),
        )


def declare_value(value: ValuePlan, printer: ExpressionPrinter, names: GlobalNames, indent: int) -> list[str]:
    """The declaration of a data member with its initial value."""
    margin = " " * indent
    initial = printer.stored(value.initial).text
    return [
        *doc_comment(describe(value), indent),
        f"{margin}{names.type_name(value.type)} {member_name(value.name)} = {initial};",
    ]


def _given(value: ValuePlan) -> str:
    """What a parameter is set to: the robot program may call `modulate` too."""
    given = f"parameters.{member_name(value.name)}"
    return f"bica::limit({given})" if value.type == INT else given


def break_list(
    margin: str, before: str, items: Sequence[str], after: str, *, is_explicit: bool | None = None
) -> list[str]:
    """The declaration of a constructor; one parameter per line if they do not fit into a line."""
    explicit = "explicit " if len(items) == 1 and is_explicit is not False else ""
    line = f"{margin}{explicit}{before}{', '.join(items)}{after}"
    if len(line) <= LINE_WIDTH:
        return [line]
    *first, last = (f"{margin}    {item}" for item in items)
    return [f"{margin}{explicit}{before}", *(f"{item}," for item in first), f"{last}{after}"]


def visits(values: Iterable[ValuePlan], owner: str = "", *, call: str = "") -> Iterator[str]:
    """The statements that pass values to a visitor; `call` is "()" for those that functions return."""
    for value in values:
        name = f"{owner}{member_name(value.name)}{call}"
        if value.type in (BOOL, INT, FLOAT):
            yield f"visitor.visit({quoted(value.name)}, {name});"
        else:
            yield f"visitor.visit({quoted(value.name)}, {quoted(value.type)}, name_of({name}));"


def _grouped_switch(
    states: Iterable[StatePlan], names: dict[str, str], write: Callable[[StatePlan], list[str]], variable: str
) -> list[str]:
    blocks: dict[tuple[str, ...], list[StatePlan]] = {}
    for state in states:
        blocks.setdefault(tuple(write(state)), []).append(state)
    if set(blocks) == {()}:
        return []
    if len(blocks) == 1 and variable == "state_":
        return [line[8:] for block in blocks for line in block]
    lines = [f"    switch ({variable}) {{"]
    for block, group in blocks.items():
        if block:
            lines += [f"        case State::{names[state.name]}:" for state in group]
            lines += block if block[-1].startswith(" " * 12 + "return") else [*block, "            break;"]
    if () in blocks:
        lines += ["        default:", "            break;"]
    return [*lines, "    }"]


def _with_return(body: list[str], value: str) -> list[str]:
    """The body with a final return of a value, unless it ends with a return."""
    return body if body and body[-1].startswith("    return ") else [*body, f"    return {value};"]


def _count_calls(steps: Iterable[object]) -> int:
    return sum(isinstance(step, CallStep) for step in steps)


def _listed(names: list[str]) -> Iterator[str]:
    yield from (f"        {name}," for name in names)


def _region_lines(code: CodePlan | None, indent: int) -> tuple[str, ...]:
    text = code.code.in_language("cpp") if code else None
    return tuple(region(code, text, indent)) if code and text is not None else ()
