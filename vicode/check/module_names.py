"""Finds names that hand-written modules import from generated code and that the project does not declare."""

import ast
from collections.abc import Callable, Collection, Iterator
from enum import Enum

from vicode.findings import Finding, SourceLocation, did_you_mean, get_rule
from vicode.model.names import package_name
from vicode.model.project import Project
from vicode.model.rename.modules import DeclaredUse, find_declared_uses, parse_or_none

_ENUM_MEMBERS = frozenset(dir(Enum))


def check_module_names(
    project: Project, read_module: Callable[[str], tuple[str, str] | None], components: Collection[str] | None = None
) -> Iterator[Finding]:
    """P212: a module of a hand-written component or of the world, or one that it imports, uses an unknown name."""
    classes = [
        each.implementation
        for each in project.components
        if not each.is_generated and (components is None or each.component in components)
    ]
    waiting = [path.partition(":")[0] for path in (*classes, project.world) if path]
    package, seen = package_name(project.name), set(waiting)
    while waiting:
        module = waiting.pop(0)
        source = read_module(module)
        tree = parse_or_none(source[1]) if source else None
        if source is None or tree is None:
            continue
        for use in dict.fromkeys(find_declared_uses(tree, package)):
            yield from _check_use(project, use, source[0])
        new = [name for name in _imported_modules(tree, module) if name not in seen]
        seen.update(new)
        waiting += new


def _check_use(project: Project, use: DeclaredUse, file: str) -> Iterator[Finding]:
    enumeration = project.enumeration(use.name)
    if enumeration is None:
        declared = [*(each.name for each in project.enumerations), *(each.name for each in project.constants)]
        if use.name in declared or use.element or use.name.startswith("__"):
            return
        message, known = f"the project declares no enumeration or constant '{use.name}'", declared
    elif use.element and use.element not in enumeration.element_names and use.element not in _ENUM_MEMBERS:
        message, known = f"'{use.name}' has no element '{use.element}'", list(enumeration.element_names)
    else:
        return
    fix = did_you_mean(use.element or use.name, known) or "correct the name, or declare it in project.yaml"
    location = SourceLocation(file=file, line=use.line, column=use.column + 1)
    yield Finding(rule=get_rule("P212"), message=message, fix=fix, location=location, languages=("python",))


def _imported_modules(tree: ast.Module, module: str) -> Iterator[str]:
    """The modules that a module may import, by their full names."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            parents = module.split(".")[: -node.level] if node.level else []
            base = ".".join([*parents, *([node.module] if node.module else [])])
            yield from ([base] if base else [])
            yield from (f"{base}.{each.name}" if base else each.name for each in node.names)
