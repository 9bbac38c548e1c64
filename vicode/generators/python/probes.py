"""A module beside a component that tests its guards and reads their names between iterations."""

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
from vicode.generators.python.expression_printer import PythonExpressionPrinter, functions_by_output
from vicode.generators.python.imports import Import, format_imports
from vicode.generators.python.names import assign_global_names
from vicode.generators.python.pretty_printer import render_doc as lay_out
from vicode.generators.python.text import docstring, quoted
from vicode.generators.python.views import GuardProbeView, ProbesModuleView
from vicode.model.design import COMMON
from vicode.model.expressions import Done, ElapsedTime, Expr, OutputRef, StatusFlag, Variable, walk
from vicode.model.expressions.scope import ScopeSymbolKind
from vicode.output import OutputFile
from vicode.templating import render

PROBES_MODULE = "_probes"
"""The module; names of components' modules do not begin with an underscore."""


def generate_probes(plan: ProjectPlan, component: ComponentPlan) -> OutputFile:
    """The module for one component of a plan: `GUARDS`, `READS` and `ENUMERATIONS`.

    Guards are found by the ids of their decisions, so those without an id are left out.
    """
    names = assign_global_names(plan)
    speller = PythonExpressionPrinter(
        names=names,
        nonzero_constants=plan.nonzero_constants,
        time_unit=component.time_unit,
        uses_xabsl_arithmetic=component.arithmetic == "xabsl",
        functions=functions_by_output(component),
    )
    sources = [(COMMON, component.common_decisions), *((state.name, state.decisions) for state in component.states)]
    declared = [*(each.name for each in plan.enumerations), *(each.name for each in plan.constants)]
    imports = format_imports([Import(module="vicode.bica", name="arithmetic")])
    imports += format_imports(Import(module=".declarations", name=names[name]) for name in declared)
    view = ProbesModuleView(
        docstring=docstring(f"Tests the guards of {component.component} without changing anything.", 0),
        imports=tuple(imports),
        sources=tuple(
            (quoted(source), tuple(_guard_view(each, speller) for each in _alternatives(decisions) if each.id))
            for source, decisions in sources
        ),
        enumerations=tuple((quoted(each.name), names[each.name]) for each in plan.enumerations),
    )
    text = render("python/probes.py.jinja", view=view)
    return OutputFile(path=f"python/{plan.package.name}/{PROBES_MODULE}.py", text=text)


def _alternatives(decisions: Iterable[DecisionPlan]) -> Iterator[DecisionPlan]:
    for alternative in decisions:
        yield alternative
        if isinstance(alternative.outcome, Branch):
            yield from _alternatives((*alternative.outcome.then, *alternative.outcome.otherwise))


def _guard_view(alternative: DecisionPlan, speller: PythonExpressionPrinter) -> GuardProbeView:
    reads = dict(pair for condition in alternative.conditions for pair in _reads(condition, speller))
    return GuardProbeView(
        id=quoted(alternative.id),
        conditions=tuple(_condition(condition, speller) for condition in alternative.conditions),
        reads=tuple((quoted(name), reading) for name, reading in reads.items()),
    )


def _condition(condition: Condition, speller: PythonExpressionPrinter) -> str:
    """A function of the component; code of a person is only named, since running it may change something."""
    if isinstance(condition, CodeCondition):
        return quoted(f"_when_{condition.code.stem}")
    return _function(speller.conditions_to_doc((condition,)))


def _reads(condition: Condition, speller: PythonExpressionPrinter) -> Iterator[tuple[str, str]]:
    match condition:
        case ExpressionCondition(expression=tree) | TimerCondition(time=tree):
            for node in walk(tree):
                name = _read_name(node, speller)
                if name:
                    yield name, _function(speller.to_doc(node))


def _read_name(node: Expr, speller: PythonExpressionPrinter) -> str:
    """How a person wrote what is read, nothing for all else."""
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
            return _text(speller.to_doc(node)).removeprefix("self.") if node.arguments else f"{alias}.{output}"
        case _:
            return ""


def _function(piece: ExpressionDoc) -> str:
    return f"lambda self: ({_text(piece)})"


def _text(piece: ExpressionDoc) -> str:
    return "\n".join(lay_out(piece.unbreakable, 0)).strip()
