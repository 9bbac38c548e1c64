"""Writes a design as a part of a classic script: browsers refuse modules of pages that are opened from files.

The modules share one scope, in which their imports are not needed: names of classes are unique in a project, and
`escape` keeps them apart from `bica` and `declarations`.
"""

import json
import re
from collections.abc import Iterable, Iterator

from vicode.generators.javascript.component import JavaScriptWriter, indented, write_declarations, write_interfaces
from vicode.generators.javascript.expression_printer import JavaScriptExpressionPrinter
from vicode.generators.plan import (
    Branch,
    ComponentPlan,
    DecisionPlan,
    ExpressionCondition,
    InterfacePlan,
    ProjectPlan,
    TimerCondition,
)
from vicode.model.design import COMMON
from vicode.model.expressions import Done, ElapsedTime, Expr, OutputRef, ScopeSymbolKind, StatusFlag, Variable, walk

_EXPORT = re.compile(r"^export (?:const|class|function) (?:\{ (.*) \}|(\w+))", re.MULTILINE)
_NOT_IN_SCRIPTS = re.compile(r"^(?:import .*\n| *(?://|/\*\*).*\n|export )", re.MULTILINE)


def write_script(
    plan: ProjectPlan, component: ComponentPlan, interfaces: Iterable[InterfacePlan], modules: Iterable[str]
) -> str:
    """The statements that declare the classes of a component and of all that it uses, and its `guards`.

    They need the runtime as `bica`. `guards` lists the decisions by state: each has its `id`, a method `test`, and in
    `reads` methods for the values that it reads.

    Args:
        plan: The project.
        component: The component; the ids of its decisions are used.
        interfaces: The components without a design that are used.
        modules: The modules of the designs that are used.
    """
    texts = [
        write_interfaces(plan, interfaces),
        *modules,
        JavaScriptWriter(package=plan.package, component=component).write(),
    ]
    declarations = (
        f"const declarations = {wrap_module(write_declarations(plan))};\n" if plan.package.has_declarations else ""
    )
    return declarations + "".join(map(_strip, texts)) + "\n".join(_guards(component)) + "\n"


def wrap_module(text: str) -> str:
    """A module as an expression whose value has what the module exports."""
    names = ", ".join(group or name for group, name in _EXPORT.findall(text))
    return f"(() => {{\n{_strip(text)}return {{ {names} }};\n}})()"


def _strip(text: str) -> str:
    """A module without imports, exports and comments."""
    return re.sub(r"\n{2,}", "\n", _NOT_IN_SCRIPTS.sub("", text)).lstrip()


def _guards(component: ComponentPlan) -> Iterator[str]:
    printer = JavaScriptExpressionPrinter.of_component(component)
    yield "const guards = {"
    for source, decisions in (
        (COMMON, component.common_decisions),
        *((each.name, each.decisions) for each in component.states),
    ):
        yield f"  [{json.dumps(source)}]: ["
        for decision in _alternatives(decisions):
            reads = dict(pair for each in decision.conditions for pair in _reads(each, printer))
            test = printer.guard(decision.conditions) if decision.conditions else "true"
            yield f"    {{ id: {json.dumps(decision.id)}, test() {{ return {test}; }}, reads: {{"
            yield from indented((f"[{json.dumps(name)}]() {{ return {value}; }}," for name, value in reads.items()), 3)
            yield "    } },"
        yield "  ],"
    yield "};"


def _alternatives(decisions: Iterable[DecisionPlan]) -> Iterator[DecisionPlan]:
    for each in decisions:
        yield each
        if isinstance(each.outcome, Branch):
            yield from _alternatives((*each.outcome.then, *each.outcome.otherwise))


def _reads(condition: object, printer: JavaScriptExpressionPrinter) -> Iterator[tuple[str, str]]:
    match condition:
        case ExpressionCondition(expression=tree) | TimerCondition(time=tree):
            yield from ((name, printer.print(node).text) for node in walk(tree) if (name := _read_name(node, printer)))


def _read_name(node: Expr, printer: JavaScriptExpressionPrinter) -> str:
    """The name of a value as in the design; empty for other nodes."""
    match node:
        case Variable(name=name, kind=kind) if kind != ScopeSymbolKind.CONSTANT:
            return name
        case ElapsedTime(kind=of):
            return f"{of}_time"
        case StatusFlag(name=of):
            return of
        case Done(alias=alias):
            return f"done({alias})"
        case OutputRef(alias=alias, output=output):
            return printer.print(node).text.replace("this.", "") if node.arguments else f"{alias}.{output}"
        case _:
            return ""
