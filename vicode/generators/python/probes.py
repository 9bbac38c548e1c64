"""A module beside a component that tests its guards and reads their names between iterations."""

from collections.abc import Iterable, Iterator

from vicode.generators.plan import (
    After,
    Alternative,
    Branch,
    ComponentPlan,
    Condition,
    Holds,
    Predicate,
    ProjectPlan,
)
from vicode.generators.python.imports import Import, import_lines
from vicode.generators.python.layout import render as lay_out
from vicode.generators.python.names import name_globals
from vicode.generators.python.pieces import Piece
from vicode.generators.python.spelling import Speller, functions_of
from vicode.generators.python.text import docstring, quoted
from vicode.generators.python.views import GuardView, ProbesView
from vicode.model.design import COMMON
from vicode.model.expressions import Done, Node, Reading, Status, Time, Variable, walk
from vicode.model.expressions.scope import Kind
from vicode.output import OutputFile
from vicode.templating import render

PROBES = "_probes"
"""The module; names of components' modules do not begin with an underscore."""


def generate_probes(plan: ProjectPlan, component: ComponentPlan) -> OutputFile:
    """The module for one component of a plan: `GUARDS`, `READS` and `ENUMERATIONS`.

    Guards are found by the ids of their decisions, so those without an id are left out.
    """
    names = name_globals(plan)
    speller = Speller(
        names=names,
        never_zero=plan.never_zero,
        time_unit=component.time_unit,
        is_xabsl=component.arithmetic == "xabsl",
        functions=functions_of(component),
    )
    sources = [(COMMON, component.decide_first), *((state.name, state.decisions) for state in component.states)]
    declared = [*(each.name for each in plan.enumerations), *(each.name for each in plan.constants)]
    imports = import_lines([Import(module="vicode.bica", name="arithmetic")])
    imports += import_lines(Import(module=".declarations", name=names[name]) for name in declared)
    view = ProbesView(
        docstring=docstring(f"Tests the guards of {component.component} without changing anything.", 0),
        imports=tuple(imports),
        sources=tuple(
            (quoted(source), tuple(_view(each, speller) for each in _alternatives(decisions) if each.id))
            for source, decisions in sources
        ),
        enumerations=tuple((quoted(each.name), names[each.name]) for each in plan.enumerations),
    )
    text = render("python/probes.py.jinja", view=view)
    return OutputFile(path=f"python/{plan.package.package}/{PROBES}.py", text=text)


def _alternatives(decisions: Iterable[Alternative]) -> Iterator[Alternative]:
    for alternative in decisions:
        yield alternative
        if isinstance(alternative.outcome, Branch):
            yield from _alternatives((*alternative.outcome.then, *alternative.outcome.otherwise))


def _view(alternative: Alternative, speller: Speller) -> GuardView:
    reads = dict(pair for condition in alternative.conditions for pair in _reads(condition, speller))
    return GuardView(
        id=quoted(alternative.id),
        conditions=tuple(_condition(condition, speller) for condition in alternative.conditions),
        reads=tuple((quoted(name), reading) for name, reading in reads.items()),
    )


def _condition(condition: Condition, speller: Speller) -> str:
    """A function of the component; code of a person is only named, since running it may change something."""
    if isinstance(condition, Predicate):
        return quoted(f"_when_{condition.body.stem}")
    return _function(speller.spell_conditions((condition,)))


def _reads(condition: Condition, speller: Speller) -> Iterator[tuple[str, str]]:
    match condition:
        case Holds(expression=tree) | After(time=tree):
            for node in walk(tree):
                name = _name_of(node, speller)
                if name:
                    yield name, _function(speller.spell(node))


def _name_of(node: Node, speller: Speller) -> str:
    """How a person wrote what is read, nothing for all else."""
    match node:
        case Variable(name=name, kind=kind) if kind != Kind.CONSTANT:
            return name
        case Time(of=of):
            return f"{of}_time"
        case Status(of=of):
            return of
        case Done(alias=alias):
            return f"done({alias})"
        case Reading(alias=alias, output=output):
            return _text(speller.spell(node)).removeprefix("self.") if node.arguments else f"{alias}.{output}"
        case _:
            return ""


def _function(piece: Piece) -> str:
    return f"lambda self: ({_text(piece)})"


def _text(piece: Piece) -> str:
    return "\n".join(lay_out(piece.rigid, 0)).strip()
