"""Rules for project files with XABSL as a target language, and for names shared by all designs."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.check.xabsl import LANGUAGE, validate_xabsl_name
from vicode.findings import DesignPath, Finding, FindingSubject, Note, get_rule
from vicode.model.design import Declaration
from vicode.model.expressions import Scope, build_scope
from vicode.model.names import is_valid_state_name
from vicode.model.project import Project
from vicode.model.xabsl.names import (
    CONST,
    INPUT,
    component_name,
    element_name,
    is_basic_behavior,
    list_symbols,
    unqualified_name,
)
from vicode.model.xabsl.unsupported import find_unsupported_in_project


@dataclass(frozen=True, slots=True)
class _XabslName:
    """A name in XABSL, unique in its namespace. An empty namespace means that the name need not be unique."""

    name: str
    namespace: str
    subject: FindingSubject
    is_explicit: bool


def find_unsupported_features(project: Project) -> Iterator[Finding]:
    """L701: features of a project that XABSL does not support."""
    for limit in find_unsupported_in_project(project):
        subject = FindingSubject(path=limit.path, is_key=limit.is_key)
        yield Finding(
            rule=get_rule("L701"), message=limit.message, fix=limit.fix, subject=subject, languages=(LANGUAGE,)
        )


def find_bad_names(project: Project) -> Iterator[Finding]:
    """L703: names that are invalid or not unique in XABSL."""
    known: dict[tuple[str, str], _XabslName] = {}
    for entry in _iter_names(project):
        is_of_project = not entry.subject.component and (
            entry.is_explicit or is_valid_state_name(str(entry.subject.path[-1]))
        )
        problem = validate_xabsl_name(entry.name, is_explicit=entry.is_explicit) if is_of_project else ""
        notes: tuple[Note, ...] = ()
        first = known.setdefault((entry.namespace, entry.name), entry) if entry.namespace else entry
        if not problem and first is not entry:
            problem = f"two {entry.namespace.partition(' ')[0]} would have the name '{entry.name}' in XABSL"
            notes = (Note(message="first declared here", subject=first.subject),)
        if problem:
            fix = f"set another name, such as xabsl_name: my_{entry.name}"
            yield Finding(
                rule=get_rule("L703"),
                message=problem,
                fix=fix,
                subject=entry.subject,
                notes=notes,
                languages=(LANGUAGE,),
            )


def _iter_names(project: Project) -> Iterator[_XabslName]:
    for design in project.designs:
        yield _make_name(design, component_name(design), "options", ("component",), component=design.component)
    for interface in project.components:
        path: DesignPath = ("components", interface.component)
        namespace = "behaviors" if is_basic_behavior(interface) else ""
        yield _make_name(interface, component_name(interface), namespace, path)
        yield from _iter_parameter_names(interface.parameters, (*path, "parameters"))
        for output in interface.outputs:
            yield from _iter_parameter_names(output.arguments or (), (*path, "outputs", output.name, "arguments"))
    for agent in project.agents:
        yield _make_name(agent, unqualified_name(agent), "agents", ("agents", agent.name))
    for enumeration in project.enumerations:
        path = ("enumerations", enumeration.name)
        yield _make_name(enumeration, unqualified_name(enumeration), "enumerations", path)
        for element in enumeration.element_names:
            name = element_name(enumeration, element)
            subject = FindingSubject(path=path, is_key=True)
            yield _XabslName(name, f"elements of {enumeration.name}", subject, name != element)
    yield from _iter_symbol_names(project, build_scope(project, None))


def _iter_parameter_names(parameters: Iterable[Declaration], path: DesignPath) -> Iterator[_XabslName]:
    for each in parameters:
        namespace = f"parameters of {'.'.join(map(str, path))}"
        yield _make_name(each, unqualified_name(each), namespace, (*path, each.name))


def _iter_symbol_names(project: Project, scope: Scope) -> Iterator[_XabslName]:
    """Yield the names of symbols. Symbols of different kinds or directions may share a name."""
    for each in list_symbols(project):
        type_ = scope.type_of(each.declaration)
        kind = {"bool": "bool", "int": "number", "float": "number"}.get(type_, "enum")
        if each.role == CONST and kind != "number":
            continue
        side = each.role if each.role in (INPUT, CONST) else "output"
        yield _make_name(each.declaration, each.name, f"symbols {kind} {side}", each.path, component=each.component)


def _make_name(named: object, name: str, namespace: str, path: DesignPath, *, component: str = "") -> _XabslName:
    is_given = bool(getattr(named, "xabsl_name", ""))
    where = ("xabsl_name",) if is_given and path == ("component",) else (*path, "xabsl_name") if is_given else path
    subject = FindingSubject(component=component, path=where, is_key=not is_given and path != ("component",))
    return _XabslName(name, namespace, subject, is_given)


RULES = (find_unsupported_features, find_bad_names)
