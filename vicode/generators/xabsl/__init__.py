"""XABSL generator: one option per design, symbol files for components, and the agents."""

import re
from collections.abc import Callable

from vicode.generators.origins import ComponentCode
from vicode.generators.plan import ComponentPlan, PackagePlan, ProjectPlan
from vicode.generators.plan.unique_identifiers import NameAllocator
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
    """Generate all files of a project; `standalone` has no effect, since XABSL engines need no runtime."""
    del standalone
    project, paths = plan.project, _OutputPaths(plan.package)
    if not project.designs:
        return ()
    name_map = XabslNameMap(project)
    writer = SymbolsWriter(name_map)
    origin = f"the project {plan.name}"
    files = [_declaration_file(paths.agents, writer.agents_file(paths.includes()), origin)]
    if paths.has_declarations:
        files.append(
            _declaration_file(
                paths.symbols[_DECLARATIONS], writer.declarations_file(paths.namespaces[_DECLARATIONS]), origin
            )
        )
    if paths.has_behaviors:
        files.append(
            _declaration_file(paths.symbols[_BEHAVIORS], writer.behaviors_file(paths.namespaces[_BEHAVIORS]), origin)
        )
    for interface in project.components:
        if interface.readable:
            key = _namespace_key(interface.component)
            files.append(
                _declaration_file(paths.symbols[key], writer.interface_file(interface, paths.namespaces[key]), origin)
            )
    for component in plan.components:
        key = _namespace_key(component.component)
        if key in paths.symbols:
            file = writer.design_file(component.design, paths.namespaces[key])
            files.append(_declaration_file(paths.symbols[key], file, _source_of(component)))
        files.append(_option_file(component, build_option(component, name_map), paths))
    return tuple(files)


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentCode]:
    """Return a function that writes the option of one component."""
    paths, name_map = _OutputPaths(plan.package), XabslNameMap(plan.project)

    def write(component: ComponentPlan) -> ComponentCode:
        option = build_option(component, name_map)
        file = _option_file(component, option, paths)
        return ComponentCode(file=file, find_origins=lambda: option_origins(file.text, option))

    return write


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:
    """List every path that `generate_xabsl` may return."""
    del standalone
    paths = _OutputPaths(package)
    if not package.project.designs:
        return ()
    return (paths.agents, *paths.symbols.values(), *paths.options.values())


class _OutputPaths:
    """The paths of a project's files; they depend only on names, so designs may have errors."""

    def __init__(self, package: PackagePlan) -> None:
        project = package.project
        self.folder = f"{LANGUAGE}/{package.name}"
        self.agents = f"{self.folder}/agents.xabsl"
        self.has_declarations = _has_declarations(project)
        self.has_behaviors = any(map(is_basic_behavior, project.components))
        bases = {_DECLARATIONS: _DECLARATIONS} if self.has_declarations else {}
        bases |= {_BEHAVIORS: _BEHAVIORS} if self.has_behaviors else {}
        interfaces = [interface for interface in project.components if interface.readable]
        bases |= {_namespace_key(interface.component): component_name(interface) for interface in interfaces}
        designs = [design for design in project.designs if symbol_declarations(design)]
        bases |= {_namespace_key(design.component): component_name(design) for design in designs}
        names = NameAllocator()
        self.namespaces = {key: names.allocate(_safe_file_name(name)) for key, name in bases.items()}
        self.symbols = {key: f"{self.folder}/Symbols/{name}.xabsl" for key, name in self.namespaces.items()}
        names = NameAllocator()
        self.options = {
            design.component: f"{self.folder}/Options/{names.allocate(_safe_file_name(component_name(design)))}.xabsl"
            for design in project.designs
        }

    def includes(self) -> list[str]:
        """List the paths that the agents file includes."""
        return [path.removeprefix(f"{self.folder}/") for path in (*self.symbols.values(), *self.options.values())]


def _option_file(component: ComponentPlan, option: GeneratedOption, paths: _OutputPaths) -> OutputFile:
    text = add_header(print_option(option.option, option.comments), _source_of(component), "//")
    return OutputFile(path=paths.options[component.component], text=text, component=component.component)


def _source_of(component: ComponentPlan) -> str:
    return component.source or f"the design of {component.component}"


def _declaration_file(path: str, file: FileNode, source: str) -> OutputFile:
    return OutputFile(path=path, text=add_header(print_file(file), source, "//"))


def _has_declarations(project: Project) -> bool:
    """Whether a declarations file is needed; XABSL supports only numeric constants."""
    name_map = XabslNameMap(project)
    has_numbers = any(name_map.scope.type_of(constant) in ("int", "float") for constant in project.constants)
    return bool(project.enumerations) or has_numbers


def _namespace_key(component: str) -> str:
    """Return the key of a component's namespace, which differs from the keys of the project's namespaces."""
    return f"component {component}"


def _safe_file_name(name: str) -> str:
    """Convert any text to a valid file name."""
    return re.sub(r"[^A-Za-z0-9_.]", "_", name).strip(".") or "x"
