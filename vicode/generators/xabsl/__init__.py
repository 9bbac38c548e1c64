"""XABSL: an option a design, symbols for what components offer, and the agents."""

import re
from collections.abc import Callable

from vicode.generators.origins import ComponentText
from vicode.generators.plan import ComponentPlan, PackagePlan, ProjectPlan
from vicode.generators.plan.naming import Names
from vicode.generators.xabsl.options import OptionText, write_option
from vicode.generators.xabsl.origins import find_origins, origins_in
from vicode.generators.xabsl.printing import print_option
from vicode.generators.xabsl.symbols import SymbolsWriter
from vicode.generators.xabsl.vocabulary import Vocabulary
from vicode.model.project import Project
from vicode.model.xabsl.names import component_name, is_behavior, symbols_of_design
from vicode.output import OutputFile
from vicode.regions import seal
from vicode.xabsl.printer import print_file
from vicode.xabsl.tree import File

__all__ = ["RESERVED_MODULES", "component_writer", "find_origins", "generate_xabsl", "list_paths"]

LANGUAGE = "xabsl"
RESERVED_MODULES: frozenset[str] = frozenset()
_SHARED, _BEHAVIORS = "declarations", "basic_behaviors"


def generate_xabsl(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:
    """All files of a project; XABSL's engines have no runtime that could be copied beside them (`standalone`)."""
    del standalone
    project, paths = plan.project, _Paths(plan.package)
    if not project.designs:
        return ()
    vocabulary = Vocabulary(project)
    writer = SymbolsWriter(vocabulary)
    whole = f"the project {plan.name}"
    files = [_file(paths.agents, writer.agents(paths.includes()), whole)]
    if paths.has_shared:
        files.append(_file(paths.symbols[_SHARED], writer.shared(paths.namespaces[_SHARED]), whole))
    if paths.has_behaviors:
        files.append(_file(paths.symbols[_BEHAVIORS], writer.behaviors(paths.namespaces[_BEHAVIORS]), whole))
    for interface in project.components:
        if interface.readable:
            key = _key(interface.component)
            files.append(_file(paths.symbols[key], writer.interface(interface, paths.namespaces[key]), whole))
    for component in plan.components:
        key = _key(component.component)
        if key in paths.symbols:
            file = writer.design(component.design, paths.namespaces[key])
            files.append(_file(paths.symbols[key], file, _source_of(component)))
        files.append(_option(component, write_option(component, vocabulary), paths))
    return tuple(files)


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentText]:
    """What writes the options of a project, one at a time."""
    paths, vocabulary = _Paths(plan.package), Vocabulary(plan.project)

    def write(component: ComponentPlan) -> ComponentText:
        written = write_option(component, vocabulary)
        file = _option(component, written, paths)
        return ComponentText(file=file, origins=origins_in(file.text, written))

    return write


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:
    """Every path that `generate_xabsl` may write for the whole project."""
    del standalone
    paths = _Paths(package)
    if not package.project.designs:
        return ()
    return (paths.agents, *paths.symbols.values(), *paths.options.values())


class _Paths:
    """Where the files of a project are, by the names in it alone: they are known of designs with mistakes too."""

    def __init__(self, package: PackagePlan) -> None:
        project = package.project
        self.folder = f"{LANGUAGE}/{package.package}"
        self.agents = f"{self.folder}/agents.xabsl"
        self.has_shared = _has_shared(project)
        self.has_behaviors = any(map(is_behavior, project.components))
        wanted = {_SHARED: _SHARED} if self.has_shared else {}
        wanted |= {_BEHAVIORS: _BEHAVIORS} if self.has_behaviors else {}
        wanted |= {_key(each.component): component_name(each) for each in project.components if each.readable}
        wanted |= {_key(each.component): component_name(each) for each in project.designs if symbols_of_design(each)}
        names = Names()
        self.namespaces = {key: names.give(_plain(name)) for key, name in wanted.items()}
        self.symbols = {key: f"{self.folder}/Symbols/{name}.xabsl" for key, name in self.namespaces.items()}
        names = Names()
        self.options = {
            each.component: f"{self.folder}/Options/{names.give(_plain(component_name(each)))}.xabsl"
            for each in project.designs
        }

    def includes(self) -> list[str]:
        """All files but that of the agents, as it includes them."""
        return [path.removeprefix(f"{self.folder}/") for path in (*self.symbols.values(), *self.options.values())]


def _option(component: ComponentPlan, written: OptionText, paths: _Paths) -> OutputFile:
    text = print_option(written.option, written.remarks)
    return OutputFile(path=paths.options[component.component], text=seal(text, _source_of(component), "//"))


def _source_of(component: ComponentPlan) -> str:
    return component.source or f"the design of {component.component}"


def _file(path: str, file: File, source: str) -> OutputFile:
    return OutputFile(path=path, text=seal(print_file(file), source, "//"))


def _has_shared(project: Project) -> bool:
    """Whether there is a file for enumerations and constants; bools and elements are no constants of XABSL."""
    vocabulary = Vocabulary(project)
    numbers = (vocabulary.scope.type_of(each) in ("int", "float") for each in project.constants)
    return bool(project.enumerations) or any(numbers)


def _key(component: str) -> str:
    """What a component's namespace is found under; those of the project have names without it."""
    return f"component {component}"


def _plain(name: str) -> str:
    """A name that can be that of a file, whatever was written."""
    return re.sub(r"[^A-Za-z0-9_.]", "_", name).strip(".") or "x"
