"""Rules for project files."""

import keyword
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from vicode.check.declarations import validate_declaration, validate_range
from vicode.check.expressions import find_nonconstant_nodes
from vicode.check.identifiers import (
    Identifier,
    iter_project_identifiers,
    keyword_languages,
    validate_identifier,
    with_article,
)
from vicode.check.topics import find_bad_topics
from vicode.check.typed_expressions import (
    TypedExpression,
    analyze_expression,
    literal_value,
    parse_initial_values,
)
from vicode.findings import DesignPath, Finding, FindingSubject, Note, Span, did_you_mean, get_rule
from vicode.languages import GENERATED_LANGUAGES
from vicode.model.design import Declaration
from vicode.model.expressions import BOOL, Scope, build_interface_scope, build_scope, constant_scopes
from vicode.model.names import package_name
from vicode.model.project import INTERNAL, MISSING, WORLD, Elsewhere, Project, TopicReference

_CLASS_IN_MODULE = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*\Z", re.ASCII)
_ROBOT_AND_COMPONENT = re.compile(r"[A-Za-z0-9][\w.-]{0,63}/[A-Za-z]\w{0,63}\Z", re.ASCII)


def find_bad_profiles(project: Project) -> Iterator[Finding]:
    """P213: a profile of an unknown component, a class that is not module:Class, or a bad remote component."""
    names = [interface.component for interface in project.components]
    for profile in project.profiles:
        path: DesignPath = ("profiles", profile.name)
        if profile.world and not _CLASS_IN_MODULE.match(profile.world):
            yield _make_finding("P213", (*path, "world"), f"'{profile.world}' is not of the form module:Class")
        if profile.clock and not (profile.world or project.world):
            fix = "add 'world: module:Class', or remove 'clock'"
            yield _make_finding("P213", (*path, "clock"), "the world sets the pace, but the profile has none", fix)
        is_used = any(isinstance(each, TopicReference) for each in profile.components)
        if profile.tune and not (is_used and any(each.tunable for each in project.constants)):
            fix = "mark a constant as 'tunable: true', or remove 'tune'" if is_used else "remove 'tune'"
            message = "no constant is tunable" if is_used else "the profile has no topics, which 'tune' needs"
            yield _make_finding("P213", (*path, "tune"), message, fix)
        for choice in profile.components:
            place = (*path, "components", choice.component)
            if isinstance(choice, Elsewhere):
                yield from _find_bad_remote(project, choice, place)
            elif choice.component not in names:
                fix = did_you_mean(choice.component, names, "declare it in 'components'")
                message = f"'{choice.component}' is not a hand-written component"
                yield _make_finding("P213", place, message, fix, is_key=True)
            elif choice.implementation not in (WORLD, INTERNAL) and not _CLASS_IN_MODULE.match(choice.implementation):
                fix = "name the class, such as field.perception:Perception"
                yield _make_finding("P213", place, f"'{choice.implementation}' is not of the form module:Class", fix)


def _find_bad_remote(project: Project, choice: Elsewhere, place: DesignPath) -> Iterator[Finding]:
    interface = project.interface(choice.component)
    if interface is None:
        if choice.component not in dict(project.unreadable):
            fix = did_you_mean(choice.component, project.interfaces(), "declare it in 'components'")
            yield _make_finding("P213", place, f"unknown component '{choice.component}'", fix, is_key=True)
        return
    if isinstance(choice, TopicReference):
        yield from (_make_finding("P213", (*place, *path), *text) for path, *text in find_bad_topics(project, choice))
    elif not _ROBOT_AND_COMPONENT.match(choice.remote):
        fix = f"name the robot and its component, such as striker/{choice.component}"
        yield _make_finding("P213", (*place, "remote"), f"'{choice.remote}' is not of the form robot/component", fix)
    if choice.max_age is not None and not 0 < choice.max_age < float("inf"):
        fix = "use a number above 0, or remove 'max_age'"
        yield _make_finding("P213", (*place, "max_age"), f"{choice.max_age:g} s is not a valid age", fix)
    source = "a topic does not have" if isinstance(choice, TopicReference) else "another robot does not share"
    for output in interface.readable:
        if output.arguments is not None or output in interface.variables:
            kind = "a variable" if output in interface.variables else "an output with arguments"
            message = f"'{output.name}' of '{choice.component}' is {kind}, which {source}"
            fix = "use outputs without arguments and parameters"
            yield _make_finding("P213", place, message, fix, is_key=True)


def find_unusable_project_names(project: Project) -> Iterator[Finding]:
    """P208: a project name whose Python package cannot be imported or hides another module."""
    reason = _package_problem(project) if "python" in project.languages else ""
    if reason:
        message = f"the package '{package_name(project.name)}' of this project {reason}"
        fix = "set another name with 'project:' in project.yaml"
        yield replace(_make_finding("P208", ("project",), message, fix), languages=("python",))


def _package_problem(project: Project) -> str:
    package = package_name(project.name)
    targets = {
        "world": project.world,
        **{interface.component: interface.implementation for interface in project.components},
    }
    hidden = [name for name, target in targets.items() if target.partition(":")[0].partition(".")[0] == package]
    if keyword.iskeyword(package):
        return "is a Python keyword"
    if package in sys.stdlib_module_names:
        return "would hide a module of Python's standard library"
    if package in ("vicode", "bica"):
        return "would hide the runtime"
    return f"would hide the module of '{hidden[0]}'" if hidden else ""


def find_bad_names(project: Project) -> Iterator[Finding]:
    """D404 to D407: names in the project file."""
    for named in iter_project_identifiers(project):
        problem = validate_identifier(named, project.languages)
        if problem:
            code, message, fix = problem
            languages = keyword_languages(named, project.languages) if code == "D406" else ()
            yield replace(_make_finding(code, named.path, message, fix, is_key=True), languages=languages)


def find_duplicate_names(project: Project) -> Iterator[Finding]:
    """D407: duplicate constants, enumerations or elements, or a type and a component with one name."""
    known: dict[tuple[DesignPath, str], Identifier] = {}
    for named in iter_project_identifiers(project):
        if named.kind == "enumeration" and project.interface(named.name):
            message = f"'{named.name}' is already the name of a component"
            yield _make_finding("D407", named.path, message, "rename one of them", is_key=True)
        # Constants and enumerations share one namespace; other names are unique among their siblings.
        namespace = () if named.is_expression_name else named.path[:-1]
        first = known.setdefault((namespace, named.name), named)
        if first is not named and named.kind != "hand-written component":
            note = Note(message="first declared here", subject=FindingSubject(path=first.path, is_key=True))
            message = f"'{named.name}' is already the name of {with_article(first.kind)}"
            yield _make_finding("D407", named.path, message, "rename one of them", is_key=True, notes=(note,))


def find_duplicate_components(project: Project) -> Iterator[Finding]:
    """P201: several components with one name."""
    written = [interface.component for interface in project.components]
    for name, count in Counter(written).items():
        if count > 1:
            yield _make_finding(
                "P201", ("components", name), f"'{name}' is declared twice", "rename one of them", is_key=True
            )
    designs = Counter(design.component for design in project.designs)
    for name, count in designs.items():
        subject = FindingSubject(component=name, path=("component",))
        notes: tuple[Note, ...] = ()
        if name in written:
            message = f"'{name}' is also the name of a hand-written component"
            notes = (Note(message="declared here", subject=FindingSubject(path=("components", name), is_key=True)),)
        elif count > 1:
            message = f"{count} designs have the name '{name}'"
        else:
            continue
        yield Finding(rule=get_rule("P201"), message=message, fix="rename one of them", subject=subject, notes=notes)


def find_bad_implementations(project: Project) -> Iterator[Finding]:
    """P203: an implementation or world that is not module:Class."""
    fix = "use module:Class, such as field.perception:Perception"
    for interface in project.components:
        if not interface.is_generated and not _CLASS_IN_MODULE.match(interface.implementation):
            path = ("components", interface.component, "implementation")
            yield _make_finding("P203", path, f"'{interface.implementation}' is not of the form module:Class", fix)
    if project.world and not _CLASS_IN_MODULE.match(project.world):
        yield _make_finding("P203", ("world",), f"'{project.world}' is not of the form module:Class", fix)
    if project.clock and not project.world:
        fix = "add 'world: module:Class', or remove 'clock'"
        yield _make_finding("P203", ("clock",), "the world sets the pace, but the project has none", fix)


def find_unimplemented_components(project: Project) -> Iterator[Finding]:
    """P209 to P211: components whose outputs nothing provides when the generated Python runs."""
    has_world = bool(project.world or project.bridge.world)
    for interface in project.components:
        path: DesignPath = ("components", interface.component)
        if interface.implementation == MISSING:
            message = f"'{interface.component}' has no implementation"
            if interface.readable:
                message += ": its outputs keep their initial values unless the robot program sets them"
            fix = "add implementation: module:Class when the class exists"
            yield _make_finding("P209", path, message, fix, is_key=True)
        elif interface.implementation == WORLD and not has_world and "python" in project.languages:
            message = f"the world provides '{interface.component}', but the project has no world"
            fix = "set world: module:Class, or delete the implementation to set the outputs by hand"
            yield _make_finding("P210", (*path, "implementation"), message, fix)
        elif interface.implementation == INTERNAL:
            for output in interface.outputs:
                message = f"nothing sets '{output.name}': a component with implementation: internal has only variables"
                fix = "move it to 'variables', or delete the implementation"
                yield _make_finding("P211", (*path, "outputs", output.name), message, fix, is_key=True)


def find_unknown_languages(project: Project) -> Iterator[Finding]:
    """P204: a language without a generator."""
    for index, language in enumerate(project.languages):
        if language not in GENERATED_LANGUAGES:
            fix = did_you_mean(language, GENERATED_LANGUAGES, f"use one of {', '.join(GENERATED_LANGUAGES)}")
            yield _make_finding("P204", ("languages", index), f"vicode does not generate '{language}'", fix)


def find_unknown_roots(project: Project) -> Iterator[Finding]:
    """P202: an agent with an unknown root component."""
    for agent in project.agents:
        # The design of an unreadable component has a finding of its own.
        if project.interface(agent.root) is None and agent.root not in dict(project.unreadable):
            fix = did_you_mean(agent.root, project.interfaces(), "add a design with this name")
            yield _make_finding("P202", ("agents", agent.name, "root"), f"unknown component '{agent.root}'", fix)


def find_empty_enumerations(project: Project) -> Iterator[Finding]:
    """P207: an enumeration without elements."""
    for enumeration in project.enumerations:
        if not enumeration.elements:
            path = ("enumerations", enumeration.name)
            yield _make_finding(
                "P207",
                path,
                f"'{enumeration.name}' has no elements",
                "add elements, such as [first, second]",
                is_key=True,
            )


def find_bad_frequencies(project: Project) -> Iterator[Finding]:
    """D416: a hand-written component with a frequency that is not above 0."""
    for interface in project.components:
        hertz = interface.frequency_hz
        if hertz is not None and not 0 < hertz < float("inf"):
            path = ("components", interface.component, "frequency")
            yield _make_finding(
                "D416", path, f"{hertz:g} Hz is not a valid frequency", "use a number above 0, or remove 'frequency'"
            )


def find_bad_declarations(project: Project) -> Iterator[Finding]:
    """P205, P206, D427, E3: types, ranges and initial values of declarations in the project file."""
    for declaration, path, scope in _declarations(project):
        for code, here, message, fix in validate_declaration(declaration, path, scope):
            yield _make_finding(code, here, message, fix)
        for expression in parse_initial_values(declaration, path, scope):
            yield from _find_bad_initial_value(expression, scope)


def _find_bad_initial_value(expression: TypedExpression, scope: Scope) -> Iterator[Finding]:
    for diagnostic in expression.analysis.diagnostics:
        yield _make_finding(
            diagnostic.rule.code, expression.path, diagnostic.message, diagnostic.fix, span=diagnostic.span
        )
    if expression.tree is None or not expression.is_sound:
        return
    fix = "use literals, constants and enumeration elements only"
    for message, node in find_nonconstant_nodes(expression.tree):
        yield _make_finding("E308", expression.path, message, fix, span=node.span)
    receiver = expression.receiver
    message = validate_range(receiver, literal_value(expression.tree, scope)) if receiver else ""
    if message:
        yield _make_finding(
            "D427", expression.path, message, "change the value or the range", span=expression.tree.span
        )


def find_bad_assumptions(project: Project) -> Iterator[Finding]:
    """E301 to E306, P216: errors in the assumption about a component, or one that never holds."""
    for interface in (each for each in project.components if each.assume):
        from vicode.analysis.guards import disprove_assumption  # noqa: PLC0415 - few projects need it

        path: DesignPath = ("components", interface.component, "assume")
        diagnostics = analyze_expression(interface.assume, build_interface_scope(project, interface), BOOL).diagnostics
        for each in diagnostics:
            yield _make_finding(each.rule.code, path, each.message, each.fix, span=each.span)
        if not diagnostics and disprove_assumption(project, interface) is not None:
            message = f"what is assumed of {interface.component} never holds"
            yield _make_finding("P216", path, message, "change the condition or the ranges")


def _declarations(project: Project) -> Iterator[tuple[Declaration, DesignPath, Scope]]:
    """Yield each declaration with its scope. A constant can use only the constants before it."""
    for constant, preceding in zip(project.constants, constant_scopes(project), strict=True):
        yield constant, ("constants", constant.name), preceding
    scope = build_scope(project, None)
    for interface in project.components:
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(interface, section):
                yield declaration, ("components", interface.component, section, declaration.name), scope


def _make_finding(
    code: str,
    path: DesignPath,
    message: str,
    fix: str = "",
    *,
    span: Span | None = None,
    is_key: bool = False,
    notes: tuple[Note, ...] = (),
) -> Finding:
    subject = FindingSubject(path=path, span=span, is_key=is_key)
    return Finding(rule=get_rule(code), message=message, fix=fix, subject=subject, notes=notes)


RULES = (
    find_unusable_project_names,
    find_bad_names,
    find_duplicate_names,
    find_duplicate_components,
    find_bad_implementations,
    find_bad_profiles,
    find_unimplemented_components,
    find_unknown_languages,
    find_unknown_roots,
    find_empty_enumerations,
    find_bad_frequencies,
    find_bad_declarations,
    find_bad_assumptions,
)
