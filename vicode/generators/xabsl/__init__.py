"""XABSL: an option a design, symbols for what components offer, and the agents."""

import re
from collections.abc import Callable

from vicode.generators.origins import ComponentCode
from vicode.generators.plan import ComponentPlan, PackagePlan, ProjectPlan
from vicode.generators.plan.names import NameAllocator
from vicode.generators.xabsl.name_map import XabslNameMap
from vicode.generators.xabsl.option_printer import print_option
from vicode.generators.xabsl.options import GeneratedOption, build_option
from vicode.generators.xabsl.origins import find_origins, option_origins
from vicode.generators.xabsl.symbols import SymbolsWriter
from vicode.model.project import Project
from vicode.model.xabsl.names import component_name, is_basic_behavior, symbol_declarations
from vicode.output import OutputFile
from vicode.regions import add_header
from vicode.xabsl.printer import print_file
from vicode.xabsl.tree import FileNode

__all__ = ["RESERVED_MODULES", "component_writer", "find_origins", "generate_xabsl", "list_paths"]

LANGUAGE = "xabsl"
RESERVED_MODULES: frozenset[str] = frozenset()
_DECLARATIONS, _BEHAVIORS = "declarations", "basic_behaviors"


def generate_xabsl(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:
    """All files of a project; XABSL's engines have no runtime that could be copied beside them (`standalone`)."""
    del standalone
    project, paths = plan.project, _OutputPaths(plan.package)
    if not project.designs:
        return ()
    vocabulary = XabslNameMap(project)
    writer = SymbolsWriter(vocabulary)
    whole = f"the project {plan.name}"
    files = [_declaration_file(paths.agents, writer.agents_file(paths.includes()), whole)]
    if paths.has_declarations:
        files.append(
            _declaration_file(
                paths.symbols[_DECLARATIONS], writer.declarations_file(paths.namespaces[_DECLARATIONS]), whole
            )
        )
    if paths.has_behaviors:
        files.append(
            _declaration_file(paths.symbols[_BEHAVIORS], writer.behaviors_file(paths.namespaces[_BEHAVIORS]), whole)
        )
    for interface in project.components:
        if interface.readable:
            key = _namespace_key(interface.component)
            files.append(
                _declaration_file(paths.symbols[key], writer.interface_file(interface, paths.namespaces[key]), whole)
            )
    for component in plan.components:
        key = _namespace_key(component.component)
        if key in paths.symbols:
            file = writer.design_file(component.design, paths.namespaces[key])
            files.append(_declaration_file(paths.symbols[key], file, _source_of(component)))
        files.append(_option_file(component, build_option(component, vocabulary), paths))
    return tuple(files)


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentCode]:
    """What writes the options of a project, one at a time."""
    paths, vocabulary = _OutputPaths(plan.package), XabslNameMap(plan.project)

    def write(component: ComponentPlan) -> ComponentCode:
        written = build_option(component, vocabulary)
        file = _option_file(component, written, paths)
        return ComponentCode(file=file, origins=option_origins(file.text, written))

    return write


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:
    """Every path that `generate_xabsl` may write for the whole project."""
    del standalone
    paths = _OutputPaths(package)
    if not package.project.designs:
        return ()
    return (paths.agents, *paths.symbols.values(), *paths.options.values())


class _OutputPaths:
    """Where the files of a project are, by the names in it alone: they are known of designs with mistakes too."""

    def __init__(self, package: PackagePlan) -> None:
        project = package.project
        self.folder = f"{LANGUAGE}/{package.name}"
        self.agents = f"{self.folder}/agents.xabsl"
        self.has_declarations = _has_declarations(project)
        self.has_behaviors = any(map(is_basic_behavior, project.components))
        wanted = {_DECLARATIONS: _DECLARATIONS} if self.has_declarations else {}
        wanted |= {_BEHAVIORS: _BEHAVIORS} if self.has_behaviors else {}
        wanted |= {_namespace_key(each.component): component_name(each) for each in project.components if each.readable}
        wanted |= {
            _namespace_key(each.component): component_name(each)
            for each in project.designs
            if symbol_declarations(each)
        }
        names = NameAllocator()
        self.namespaces = {key: names.allocate(_safe_file_name(name)) for key, name in wanted.items()}
        self.symbols = {key: f"{self.folder}/Symbols/{name}.xabsl" for key, name in self.namespaces.items()}
        names = NameAllocator()
        self.options = {
            each.component: f"{self.folder}/Options/{names.allocate(_safe_file_name(component_name(each)))}.xabsl"
            for each in project.designs
        }

    def includes(self) -> list[str]:
        """All files but that of the agents, as it includes them."""
        return [path.removeprefix(f"{self.folder}/") for path in (*self.symbols.values(), *self.options.values())]


def _option_file(component: ComponentPlan, written: GeneratedOption, paths: _OutputPaths) -> OutputFile:
    text = print_option(written.option, written.comments)
    return OutputFile(path=paths.options[component.component], text=add_header(text, _source_of(component), "//"))


def _source_of(component: ComponentPlan) -> str:
    return component.source or f"the design of {component.component}"


def _declaration_file(path: str, file: FileNode, source: str) -> OutputFile:
    return OutputFile(path=path, text=add_header(print_file(file), source, "//"))


def _has_declarations(project: Project) -> bool:
    """Whether there is a file for enumerations and constants; bools and elements are no constants of XABSL."""
    vocabulary = XabslNameMap(project)
    numbers = (vocabulary.scope.type_of(each) in ("int", "float") for each in project.constants)
    return bool(project.enumerations) or any(numbers)


def _namespace_key(component: str) -> str:
    """What a component's namespace is found under; those of the project have names without it."""
    return f"component {component}"


def _safe_file_name(name: str) -> str:
    """A name that can be that of a file, whatever was written."""
    return re.sub(r"[^A-Za-z0-9_.]", "_", name).strip(".") or "x"
