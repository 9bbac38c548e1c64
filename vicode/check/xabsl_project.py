"""Rules about what XABSL can say of a project file, and about names that all its designs share there."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.check.xabsl import LANGUAGE, name_problem
from vicode.findings import Finding, Note, Path, Thing, rule
from vicode.model.design import Declaration
from vicode.model.expressions import Scope, scope_of
from vicode.model.names import is_state_name
from vicode.model.project import Project
from vicode.model.xabsl.limits import find_project_limits
from vicode.model.xabsl.names import (
    CONST,
    INPUT,
    component_name,
    element_name,
    is_behavior,
    list_symbols,
    plain_name,
)


@dataclass(frozen=True, slots=True)
class _Name:
    """A name of XABSL, among which it must be the only one (empty: nobody minds), and what has it."""

    name: str
    among: str
    thing: Thing
    is_given: bool


def find_unsayable_things(project: Project) -> Iterator[Finding]:
    """L701: what a program of XABSL has no place for."""
    if LANGUAGE not in project.languages:
        return
    for limit in find_project_limits(project):
        thing = Thing(path=limit.path, of_key=limit.of_key)
        yield Finding(rule=rule("L701"), message=limit.message, mend=limit.mend, thing=thing, languages=(LANGUAGE,))


def find_bad_names(project: Project) -> Iterator[Finding]:
    """L703: names that XABSL cannot have, or that two things of its program would have."""
    if LANGUAGE not in project.languages:
        return
    known: dict[tuple[str, str], _Name] = {}
    for each in _names_of(project):
        is_of_project = not each.thing.component and (each.is_given or is_state_name(str(each.thing.path[-1])))
        problem = name_problem(each.name, is_given=each.is_given) if is_of_project else ""
        notes: tuple[Note, ...] = ()
        first = known.setdefault((each.among, each.name), each) if each.among else each
        if not problem and first is not each:
            problem = f"two {each.among.partition(' ')[0]} would be called '{each.name}' in XABSL"
            notes = (Note(message="the first is here", thing=first.thing),)
        if problem:
            mend = f"give it another: xabsl_name: my_{each.name}"
            yield Finding(
                rule=rule("L703"), message=problem, mend=mend, thing=each.thing, notes=notes, languages=(LANGUAGE,)
            )


def _names_of(project: Project) -> Iterator[_Name]:
    for design in project.designs:
        yield _name(design, component_name(design), "options", ("component",), component=design.component)
    for interface in project.components:
        path: Path = ("components", interface.component)
        among = "behaviors" if is_behavior(interface) else ""
        yield _name(interface, component_name(interface), among, path)
        yield from _parameters(interface.parameters, (*path, "parameters"))
        for output in interface.outputs:
            yield from _parameters(output.arguments or (), (*path, "outputs", output.name, "arguments"))
    for agent in project.agents:
        yield _name(agent, plain_name(agent), "agents", ("agents", agent.name))
    for enumeration in project.enumerations:
        path = ("enumerations", enumeration.name)
        yield _name(enumeration, plain_name(enumeration), "enumerations", path)
        for element in enumeration.element_names:
            name = element_name(enumeration, element)
            thing = Thing(path=path, of_key=True)
            yield _Name(name, f"elements of {enumeration.name}", thing, name != element)
    yield from _symbols(project, scope_of(project, None))


def _parameters(parameters: Iterable[Declaration], path: Path) -> Iterator[_Name]:
    for each in parameters:
        among = f"parameters of {'.'.join(map(str, path))}"
        yield _name(each, plain_name(each), among, (*path, each.name))


def _symbols(project: Project, scope: Scope) -> Iterator[_Name]:
    """Symbols may share a name if they are of two kinds, or one is given by the robot and one is told to it."""
    for each in list_symbols(project):
        type_ = scope.type_of(each.declaration)
        kind = {"bool": "bool", "int": "number", "float": "number"}.get(type_, "enum")
        if each.role == CONST and kind != "number":
            continue
        side = each.role if each.role in (INPUT, CONST) else "told"
        yield _name(each.declaration, each.name, f"symbols {kind} {side}", each.path, component=each.component)


def _name(named: object, name: str, among: str, path: Path, *, component: str = "") -> _Name:
    is_given = bool(getattr(named, "xabsl_name", ""))
    where = ("xabsl_name",) if is_given and path == ("component",) else (*path, "xabsl_name") if is_given else path
    thing = Thing(component=component, path=where, of_key=not is_given and path != ("component",))
    return _Name(name, among, thing, is_given)


RULES = (find_unsayable_things, find_bad_names)
