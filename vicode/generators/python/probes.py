"""Writes a module that evaluates the guards of a component between iterations."""

from collections.abc import Iterable, Iterator

from vicode.generators.plan import (
    Branch,
    CodeCondition,
    ComponentPlan,
    Condition,
    DecisionPlan,
    ExpressionCondition,
    ProjectPlan,
    TimerCondition,
)
from vicode.generators.python.expression_doc import ExpressionDoc
from vicode.generators.python.expression_printer import PythonExpressionPrinter
from vicode.generators.python.imports import RUNTIME, Import, format_imports
from vicode.generators.python.names import assign_global_names
from vicode.generators.python.pretty_printer import render_doc
from vicode.generators.python.text import docstring, quoted
from vicode.generators.python.views import GuardProbeView, ProbesModuleView
from vicode.model.design import COMMON
from vicode.model.expressions import Done, ElapsedTime, Expr, OutputRef, StatusFlag, Variable, walk
from vicode.model.expressions.scope import ScopeSymbolKind
from vicode.output import OutputFile
from vicode.templating import render

PROBES_MODULE = "_probes"
"""The name of the module; modules of components never start with an underscore."""


def generate_probes(plan: ProjectPlan, component: ComponentPlan) -> OutputFile:
    """Generate the module for one component: the tables `GUARDS`, `READS` and `ENUMERATIONS`.

    The keys are the ids of the decisions; decisions without an id are omitted.
    """
    names = assign_global_names(plan)
    printer = PythonExpressionPrinter.of_component(plan, component, names)
    sources = [(COMMON, component.common_decisions), *((state.name, state.decisions) for state in component.states)]
    declared = [*(item.name for item in plan.enumerations), *(item.name for item in plan.constants)]
    imports = format_imports([Import(module=RUNTIME, name="arithmetic")])
    imports += format_imports(Import(module=".declarations", name=names[name]) for name in declared)
    view = ProbesModuleView(
        docstring=docstring(f"Evaluates the guards of {component.component} without side effects.", 0),
        imports=tuple(imports),
        sources=tuple(
            (
                quoted(source),
                tuple(_guard_view(decision, printer) for decision in _alternatives(decisions) if decision.id),
            )
            for source, decisions in sources
        ),
        enumerations=tuple((quoted(item.name), names[item.name]) for item in plan.enumerations),
    )
    text = render("python/probes.py.jinja", view=view)
    return OutputFile(path=f"python/{plan.package.name}/{PROBES_MODULE}.py", text=text)


def _alternatives(decisions: Iterable[DecisionPlan]) -> Iterator[DecisionPlan]:
    for alternative in decisions:
        yield alternative
        if isinstance(alternative.outcome, Branch):
            yield from _alternatives((*alternative.outcome.then, *alternative.outcome.otherwise))


def _guard_view(alternative: DecisionPlan, printer: PythonExpressionPrinter) -> GuardProbeView:
    reads = dict(pair for condition in alternative.conditions for pair in _reads(condition, printer))
    return GuardProbeView(
        id=quoted(alternative.id),
        conditions=tuple(_condition(condition, printer) for condition in alternative.conditions),
        reads=tuple((quoted(name), function) for name, function in reads.items()),
    )


def _condition(condition: Condition, printer: PythonExpressionPrinter) -> str:
    """Return a function of the component; hand-written code may have side effects and is given by name only."""
    if isinstance(condition, CodeCondition):
        return quoted(f"_when_{condition.code.stem}")
    return _function(printer.conditions_to_doc((condition,)))


def _reads(condition: Condition, printer: PythonExpressionPrinter) -> Iterator[tuple[str, str]]:
    match condition:
        case ExpressionCondition(expression=tree) | TimerCondition(time=tree):
            for node in walk(tree):
                name = _read_name(node, printer)
                if name:
                    yield name, _function(printer.to_doc(node))


def _read_name(node: Expr, printer: PythonExpressionPrinter) -> str:
    """Return the name of a value as written in the design; empty for other nodes."""
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
            return _text(printer.to_doc(node)).removeprefix("self.") if node.arguments else f"{alias}.{output}"
        case _:
            return ""


def _function(piece: ExpressionDoc) -> str:
    return f"lambda self: ({_text(piece)})"


def _text(piece: ExpressionDoc) -> str:
    return "\n".join(render_doc(piece.unbreakable, 0)).strip()
