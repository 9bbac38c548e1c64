"""Completion of expressions and code: the names in scope, with type, unit and doc."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.bica import Component
from vicode.model.design import Declaration, Design
from vicode.model.expressions import FUNCTIONS, Scope, build_scope
from vicode.model.project import Enumeration, Interface, Project

# The name being typed, with the qualified name before its dot.
_TYPED = re.compile(r"(?:(?P<owner>[A-Za-z_][\w.]*)\.)?(?P<word>[A-Za-z_]\w*)?\Z", re.ASCII)
_LINE_START = re.compile(r"\s*(?P<word>[A-Za-z_][\w.]*)?\Z", re.ASCII)

_TIMES = (("state_time", "time in the state"), ("component_time", "time since the component started"))
_STATUSES = (
    ("action_done", "whether a component called by the state is done"),
    ("conflict", "whether the state holds its maximum number of robots of the team"),
    ("team_size", "number of robots of the team that are alive, including this one"),
)
_KEYWORDS = ("and", "or", "not", "if", "else", "True", "False")
_RUNTIME_MEMBERS = ("is_done", "state", "state_time", "component_time", "step", "restart")


@dataclass(frozen=True, slots=True, kw_only=True)
class CompletionOption:
    """A proposed name; `kind` selects the icon, `detail` is shown next to the name."""

    label: str
    kind: str
    detail: str = ""
    doc: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class CompletionResult:
    """The proposals for the text from `start` to the cursor."""

    start: int
    options: tuple[CompletionOption, ...]


def complete_expression(project: Project, design: Design, text: str, offset: int) -> CompletionResult:
    scope = build_scope(project, design)
    typed = _typed_before(text, offset)
    owner, start = typed["owner"], offset - len(typed["word"] or "")
    if owner:
        return CompletionResult(start=start, options=tuple(_owner_members(owner, scope, project)))
    if re.search(r"\bdone\(\s*\Z", text[:start]):
        return CompletionResult(start=start, options=tuple(_aliases(design, scope)))
    return CompletionResult(start=start, options=tuple(_names_in_expressions(project, design, scope)))


def complete_assignments(
    project: Project, design: Design, settable: Iterable[Declaration], text: str, offset: int
) -> CompletionResult:
    """Complete a line `name = expression`: a settable name, or the expression after the sign."""
    before = text[:offset].rpartition("\n")[2]
    if "=" in before or ":" in before:
        return complete_expression(project, design, text, offset)
    word = _LINE_START.search(before)
    start = offset - len((word and word["word"]) or "")
    scope = build_scope(project, design)
    return CompletionResult(
        start=start, options=tuple(_declaration_option(declaration, scope, "variable") for declaration in settable)
    )


def complete_python(project: Project, design: Design, text: str, offset: int) -> CompletionResult:
    """Complete the names of a design in Python code; the browser's code editor adds those of the language."""
    scope = build_scope(project, design)
    typed = _typed_before(text, offset)
    owner, start = typed["owner"], offset - len(typed["word"] or "")
    if owner == "self":
        return CompletionResult(start=start, options=tuple(_members(design, scope)))
    if owner and owner.startswith("self."):
        return CompletionResult(
            start=start, options=tuple(_owner_members(owner.removeprefix("self."), scope, project, in_code=True))
        )
    if owner:
        return CompletionResult(start=start, options=tuple(_elements(owner, project)))
    shared = [*_constants(project, scope), *_enumerations(project)]
    return CompletionResult(
        start=start, options=(CompletionOption(label="self", kind="keyword", detail="this component"), *shared)
    )


def _typed_before(text: str, offset: int) -> re.Match[str]:
    typed = _TYPED.search(text[max(0, offset - 200) : offset])
    assert typed is not None, "the pattern matches the empty text"
    return typed


def _names_in_expressions(project: Project, design: Design, scope: Scope) -> Iterator[CompletionOption]:
    for section, declaration in design.declarations():
        yield _declaration_option(declaration, scope, "variable", section.removesuffix("s"))
    yield from _aliases(design, scope)
    yield from _constants(project, scope)
    yield from _enumerations(project)
    unit = design.time_unit or "s"
    yield from (CompletionOption(label=name, kind="property", detail=unit, doc=doc) for name, doc in _TIMES)
    yield from (CompletionOption(label=name, kind="property", detail="bool", doc=doc) for name, doc in _STATUSES)
    yield CompletionOption(label="done", kind="function", detail="(component) bool", doc="whether a component is done")
    yield CompletionOption(
        label="failed", kind="function", detail="(component) bool", doc="whether it has ended without success"
    )
    for function in FUNCTIONS.values():
        parameters = ", ".join(function.parameter_types) + (", …" if function.is_variadic else "")
        detail = f"({parameters}) {function.return_type}"
        yield CompletionOption(label=function.name, kind="function", detail=detail, doc=function.doc)
    yield from (CompletionOption(label=word, kind="keyword") for word in _KEYWORDS)


def _members(design: Design, scope: Scope) -> Iterator[CompletionOption]:
    for section, declaration in design.declarations():
        yield _declaration_option(declaration, scope, "property", section.removesuffix("s"))
    yield from _aliases(design, scope)
    yield from _runtime_members()


def _runtime_members() -> Iterator[CompletionOption]:
    for name in _RUNTIME_MEMBERS:
        doc = (getattr(Component, name, None).__doc__ or "").strip().split("\n")[0]
        yield CompletionOption(label=name, kind="property", detail="runtime", doc=doc)


def _aliases(design: Design, scope: Scope) -> Iterator[CompletionOption]:
    for use in design.uses:
        interface = scope.uses.get(use.alias)
        yield CompletionOption(
            label=use.alias, kind="class", detail=use.component, doc=interface.doc if interface else ""
        )


def _owner_members(owner: str, scope: Scope, project: Project, *, in_code: bool = False) -> Iterator[CompletionOption]:
    """The members of a used component or an enumeration."""
    interface: Interface | None = scope.uses.get(owner)
    if interface is not None:
        yield from (_declaration_option(output, scope, "property", "output") for output in interface.outputs)
        yield from (_declaration_option(variable, scope, "property", "variable") for variable in interface.variables)
        if in_code:
            yield from (
                _declaration_option(parameter, scope, "property", "parameter") for parameter in interface.parameters
            )
            yield from _runtime_members()
    elif not in_code:
        yield from _elements(owner, project)


def _elements(owner: str, project: Project) -> Iterator[CompletionOption]:
    enumeration: Enumeration | None = project.enumeration(owner)
    for name, doc in enumeration.elements if enumeration else ():
        yield CompletionOption(label=name, kind="enum", detail=owner, doc=doc)


def _constants(project: Project, scope: Scope) -> Iterator[CompletionOption]:
    return (_declaration_option(constant, scope, "constant", f"= {constant.initial}") for constant in project.constants)


def _enumerations(project: Project) -> Iterator[CompletionOption]:
    return (
        CompletionOption(label=enumeration.name, kind="enum", detail="enumeration", doc=enumeration.doc)
        for enumeration in project.enumerations
    )


def _declaration_option(declaration: Declaration, scope: Scope, kind: str, what: str = "") -> CompletionOption:
    facts = (scope.type_of(declaration), declaration.unit, what)
    detail = " ".join(fact for fact in facts if fact)
    doc = declaration.doc
    if declaration.range:
        doc = f"{doc} ({declaration.range[0]:g} to {declaration.range[1]:g})".strip()
    return CompletionOption(label=declaration.name, kind=kind, detail=detail, doc=doc)
