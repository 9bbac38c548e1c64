"""Compares hand-written classes and the world with the declarations in project.yaml, by reading their source.

What a class gets from an unknown base, a decorator or `setattr` is not known; it then counts as present.
"""

import ast
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.model.names import python_attribute_name, snake_case
from vicode.model.project import WORLD, Interface, Project
from vicode.model.xabsl.names import is_basic_behavior

ReadModule = Callable[[str], tuple[str, str] | None]
"""Returns the file name and the text of a module, None if it is not in the project folder."""

_Function = ast.FunctionDef | ast.AsyncFunctionDef
_DYNAMIC_METHODS = {"__getattr__", "__getattribute__"}
_DYNAMIC_CALLS = {"setattr", "vars"}


def check_classes(
    project: Project, read_module: ReadModule, components: Collection[str] | None = None
) -> Iterator[Finding]:
    """P212: missing outputs, other parameters or another frequency of a class; missing members of the world."""
    checked = [each for each in project.components if components is None or each.component in components]
    for interface in checked:
        if not interface.is_generated:
            found = _find_class(interface.implementation, read_module)
            if isinstance(found, _ClassSource):
                yield from _ClassChecker(interface, found).check()
            elif found:
                message = f"{found} has no class '{interface.implementation.partition(':')[2]}'"
                yield _make_finding(message, f"add it, or correct the implementation of {interface.component}", found)
    yield from _check_world(project, [each for each in checked if each.implementation == WORLD], read_module)


def _check_world(project: Project, interfaces: list[Interface], read_module: ReadModule) -> Iterator[Finding]:
    """The attributes and methods that generated classes of components use, and those of a world that sets the pace."""
    members = [(*member, f"{each.component} uses") for each in interfaces for member in _world_members(each)]
    if project.clock:
        members += [("method", name, "'clock: world' needs") for name in ("now_ns", "next_cycle")]
    world = _find_class(project.world, read_module) if project.world and members else None
    if isinstance(world, str):
        message = f"{world} has no class '{project.world.partition(':')[2]}'"
        yield _make_finding(message, "add it, or correct 'world' in project.yaml", world)
    elif world is not None and world.is_complete:
        known = world.functions.keys() | world.attributes
        for kind, name, reason in members:
            if name not in known:
                message = f"'{world.node.name}' has no {kind} '{name}', which {reason}"
                yield _make_finding(message, "add it", world.file, world.node)


def _world_members(interface: Interface) -> Iterator[tuple[str, str]]:
    for output in interface.outputs:
        kind = "attribute" if output.arguments is None else "method"
        yield kind, python_attribute_name(output.xabsl_name or output.name)
    if is_basic_behavior(interface):
        yield "method", python_attribute_name(interface.xabsl_name or snake_case(interface.component))


def _find_class(path: str, read_module: ReadModule) -> "_ClassSource | str | None":
    """The class at module:Class; its file, if the class is missing there; None if that is not known."""
    module, _colon, name = path.partition(":")
    source = read_module(module)
    syntax = _parse(source[1]) if source else None
    if source is None or syntax is None:
        return None
    classes = {node.name: node for node in syntax.body if isinstance(node, ast.ClassDef)}
    if name in classes:
        return _read_class(source[0], classes[name], classes)
    return None if {name, "*"} & _bound_names(syntax) else source[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class _ClassSource:
    """What the source of a class and of its bases in the same module defines.

    `is_complete` is false if the class may have more members than these.
    """

    file: str
    node: ast.ClassDef
    functions: dict[str, _Function]
    attributes: frozenset[str]
    values: dict[str, ast.expr]
    is_complete: bool


@dataclass(frozen=True, slots=True)
class _ClassChecker:
    interface: Interface
    source: _ClassSource

    def check(self) -> Iterator[Finding]:
        yield from self._check_outputs()
        yield from self._check_parameters()
        yield from self._check_frequency()

    def _check_outputs(self) -> Iterator[Finding]:
        for output in self.interface.readable:
            function = self.source.functions.get(output.name)
            is_attribute = output.name in self.source.attributes
            if function is not None and not function.decorator_list and output.arguments is None and not is_attribute:
                message = f"'{output.name}' is a method, but project.yaml declares it without arguments"
                yield self._report(message, "make it a property, or declare 'arguments: {}'", function)
            elif function is None and not is_attribute and self.source.is_complete:
                message = f"'{self.source.node.name}' has no attribute '{output.name}'"
                yield self._report(message, "set it in __init__, or delete the output in project.yaml")

    def _check_parameters(self) -> Iterator[Finding]:
        declared = [parameter.name for parameter in self.interface.parameters]
        modulate = self.source.functions.get("modulate")
        if modulate is None:
            if declared and self.source.is_complete and "modulate" not in self.source.attributes:
                message = f"'{self.source.node.name}' has no method 'modulate'"
                yield self._report(message, f"add def modulate(self, *, {', '.join(declared)})")
            return
        arguments = modulate.args
        names = [each.arg for each in (*arguments.args[1:], *arguments.kwonlyargs)]
        for name in declared:
            if name not in names and arguments.kwarg is None:
                message = f"'modulate' has no parameter '{name}'"
                yield self._report(message, "add it, or delete the parameter in project.yaml", modulate)
        required = [
            each.arg for each, value in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True) if not value
        ]
        required += [each.arg for each in arguments.args[1 : len(arguments.args) - len(arguments.defaults)]]
        for name in required:
            if name not in declared:
                message = f"'modulate' requires '{name}', which project.yaml does not declare"
                yield self._report(message, "declare the parameter, or give it a default", modulate)

    def _check_frequency(self) -> Iterator[Finding]:
        value = self.source.values.get("frequency_hz")
        if value is None and not self.source.is_complete:
            return
        if value is not None and not (isinstance(value, ast.Constant) and isinstance(value.value, int | float | None)):
            return
        actual = value.value if isinstance(value, ast.Constant) else None
        if actual != self.interface.frequency_hz:
            message = f"'{self.source.node.name}' runs {_describe(actual)}, but project.yaml declares "
            fix = "use the same frequency_hz and frequency; the class determines the behavior"
            yield self._report(message + _describe(self.interface.frequency_hz), fix, value)

    def _report(self, message: str, fix: str, node: _Function | ast.expr | None = None) -> Finding:
        return _make_finding(message, fix, self.source.file, node or self.source.node)


def _describe(hertz: object) -> str:
    return f"at {hertz:g} Hz" if isinstance(hertz, int | float) else "on every step"


def _make_finding(message: str, fix: str, file: str, node: ast.stmt | ast.expr | None = None) -> Finding:
    line, column = (node.lineno, node.col_offset + 1) if node is not None else (1, 1)
    location = SourceLocation(file=file, line=line, column=column)
    return Finding(rule=get_rule("P212"), message=message, fix=fix, location=location, languages=("python",))


def _parse(text: str) -> ast.Module | None:
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _bound_names(syntax: ast.Module) -> set[str]:
    """All names that a module may define; "*" imports and nested statements define any name."""
    names = {node.id for node in ast.walk(syntax) if isinstance(node, ast.Name)}
    names |= {node.name for node in ast.walk(syntax) if isinstance(node, ast.ClassDef | _Function)}
    imports = [
        alias for node in ast.walk(syntax) if isinstance(node, ast.ImportFrom | ast.Import) for alias in node.names
    ]
    return names | {(alias.asname or alias.name) for alias in imports}


def _read_class(file: str, node: ast.ClassDef, classes: dict[str, ast.ClassDef]) -> _ClassSource:
    """Read a class and its bases of the same module; members of the class precede those of its bases."""
    functions: dict[str, _Function] = {}
    values: dict[str, ast.expr] = {}
    attributes: set[str] = set()
    is_complete = True
    pending, seen = [node], {node.name}
    while pending:
        current = pending.pop(0)
        is_complete = is_complete and not current.decorator_list and not current.keywords
        for statement in current.body:
            if isinstance(statement, _Function):
                functions.setdefault(statement.name, statement)
            elif isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
                targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
                for name in (each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)):
                    values.setdefault(name, statement.value)
            elif not isinstance(statement, ast.Expr | ast.AnnAssign | ast.Pass):
                is_complete = False
        attributes |= _assigned_attributes(current)
        is_complete = is_complete and not _is_dynamic(current)
        for base in current.bases:
            known = classes.get(base.id) if isinstance(base, ast.Name) else None
            if known is not None and known.name not in seen:
                seen.add(known.name)
                pending.append(known)
            elif known is None and _last_name(base) != "Component":
                is_complete = False
    return _ClassSource(
        file=file,
        node=node,
        functions=functions,
        attributes=frozenset(attributes | values.keys()),
        values=values,
        is_complete=is_complete,
    )


def _assigned_attributes(node: ast.ClassDef) -> set[str]:
    """The attributes that methods assign, such as those of `self`."""
    return {each.attr for each in ast.walk(node) if isinstance(each, ast.Attribute) and isinstance(each.ctx, ast.Store)}


def _is_dynamic(node: ast.ClassDef) -> bool:
    """Whether methods may set or compute attributes by names that the source does not show."""
    for each in ast.walk(node):
        if isinstance(each, _Function) and each.name in _DYNAMIC_METHODS:
            return True
        if isinstance(each, ast.Call) and _last_name(each.func) in _DYNAMIC_CALLS:
            return True
        if isinstance(each, ast.Attribute) and each.attr == "__dict__":
            return True
    return False


def _last_name(node: ast.expr) -> str:
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""
