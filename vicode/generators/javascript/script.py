"""Writes a design as a part of a classic script: browsers refuse modules of pages that are opened from files.

The modules share one scope, in which their imports are not needed: names of classes are unique in a project, and
`escape` keeps them apart from `bica` and `declarations`.
"""

import json
import re
from collections.abc import Iterable, Iterator

from vicode.generators.javascript.component import JavaScriptWriter, write_declarations, write_interfaces
from vicode.generators.javascript.expression_printer import JavaScriptExpressionPrinter
from vicode.generators.plan import (
    Branch,
    ComponentPlan,
    Condition,
    DecisionPlan,
    ExpressionCondition,
    InterfacePlan,
    ProjectPlan,
    TimerCondition,
    UnsoundDesignError,
)
from vicode.model.design import COMMON
from vicode.model.expressions import Expr, OutputRef, read_name, walk

_EXPORT = re.compile(r"^export (?:const|class|function) (?:\{ (.*) \}|(\w+))", re.MULTILINE)
_NOT_IN_SCRIPTS = re.compile(r"^(?:import .*\n| *(?://|/\*\*).*\n|export )", re.MULTILINE)


def write_script(plan: ProjectPlan, interfaces: Iterable[InterfacePlan], modules: Iterable[str]) -> str:
    """The statements that declare the classes of the only component of a plan and of all that it uses.

    They need the runtime as `bica`. They also declare `guards`, the decisions by state: each has its `id`, a method
    `test` if it has conditions, and in `reads` methods for the values that it reads; `this` is the component.
    """
    (component,), package = plan.components, plan.package
    own = JavaScriptWriter(package=package, component=component).write()
    texts = [write_interfaces(plan, interfaces), *modules, own, "\n".join(_guards(component))]
    declarations = wrap_module(write_declarations(plan)) if package.has_declarations else "{}"
    return f"const declarations = {declarations};\n" + "".join(map(_strip, texts)) + "\n"


def wrap_module(text: str) -> str:
    """A module as an expression whose value has what the module exports."""
    names = ", ".join(group or name for group, name in _EXPORT.findall(text))
    return f"(() => {{\n{_strip(text)}return {{ {names} }};\n}})()"


def _strip(text: str) -> str:
    """A module without imports, exports and comments."""
    return re.sub(r"\n{2,}", "\n", _NOT_IN_SCRIPTS.sub("", text)).lstrip()


def _guards(component: ComponentPlan) -> Iterator[str]:
    printer = JavaScriptExpressionPrinter.of_component(component)
    sources = {COMMON: component.common_decisions} | {state.name: state.decisions for state in component.states}
    yield "const guards = {"
    for source, decisions in sources.items():
        yield f"  [{json.dumps(source)}]: ["
        for decision in _alternatives(decisions):
            nodes = (node for condition in decision.conditions for node in walk(_tree(condition)))
            reads = {name: printer.print(node).text for node in nodes if (name := _name(node))}
            methods = ", ".join(f"[{json.dumps(name)}]() {{ return {value}; }}" for name, value in reads.items())
            test = f"test() {{ return {printer.guard(decision.conditions)}; }}, " if decision.conditions else ""
            yield f"    {{ id: {json.dumps(decision.id)}, {test}reads: {{ {methods} }} }},"
        yield "  ],"
    yield "};"


def _alternatives(decisions: Iterable[DecisionPlan]) -> Iterator[DecisionPlan]:
    for each in decisions:
        yield each
        if isinstance(each.outcome, Branch):
            yield from _alternatives((*each.outcome.then, *each.outcome.otherwise))


def _tree(condition: Condition) -> Expr:
    match condition:
        case ExpressionCondition(expression=tree) | TimerCondition(time=tree):
            return tree
        case _:
            raise UnsoundDesignError("a guard is written as code")


def _name(node: Expr) -> str:
    """The name of a value as in the design; empty for other nodes."""
    if isinstance(node, OutputRef) and node.arguments is not None:
        return f"{node.alias}.{node.output}(…)"
    return read_name(node)
