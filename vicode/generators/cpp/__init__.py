"""C++ generator: a header and a source per component, on the header-only runtime bica.hpp."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from vicode.generators.cpp.component import CppComponentWriter
from vicode.generators.cpp.live import add_code_hash, build_live
from vicode.generators.cpp.names import RESERVED_MODULES, GlobalNames
from vicode.generators.cpp.origins import find_origins
from vicode.generators.cpp.project import build_components, build_declarations, build_interfaces, list_interfaces
from vicode.generators.cpp.symbols import CppSymbols, list_symbols
from vicode.generators.origins import ComponentCode
from vicode.generators.plan import (
    CodePlan,
    ComponentPlan,
    PackagePlan,
    ProjectPlan,
    plan_component,
    plan_project,
)
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import OutputFile
from vicode.regions import add_header
from vicode.templating import read_asset, render

__all__ = [
    "RESERVED_MODULES",
    "CppCode",
    "component_writer",
    "cpp_generator",
    "find_origins",
    "generate_cpp",
    "list_paths",
    "list_regions",
]

LANGUAGE = "cpp"


def generate_cpp(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:  # noqa: ARG001 - as in other languages
    """Generate all files of a project. The runtime is always part of them, so `standalone` changes nothing."""
    names = GlobalNames.of_project(plan)
    source = f"the project {plan.name}"
    shared = {"components.hpp": build_components(plan, names), "CMakeLists.txt": build_components(plan, names)}
    if plan.package.has_declarations:
        shared["declarations.hpp"] = build_declarations(plan, names)
    if list_interfaces(plan):
        shared["interfaces.hpp"] = build_interfaces(plan, names)
    files = [
        *(
            OutputFile(path=f"{LANGUAGE}/{name}", text=add_header(read_asset(f"cpp/{name}"), name, "//"))
            for name in _list_runtime(plan.project)
        ),
        OutputFile(path=f"{LANGUAGE}/.clang-format", text=add_header(read_asset("cpp/clang-format"), "vicode", "#")),
    ]
    for name, view in shared.items():
        text = render(f"cpp/{name}.jinja", view=view)
        comment = "#" if name == "CMakeLists.txt" else "//"
        files.append(OutputFile(path=f"{LANGUAGE}/{plan.package.name}/{name}", text=add_header(text, source, comment)))
    for component in plan.components:
        files += _component_files(plan, component, names)
    if plan.project.live:
        live = build_live(plan, names, {file.path.rpartition("/")[2]: file.text for file in files})
        text = add_header(render("cpp/live.hpp.jinja", view=live), source, "//")
        files.append(OutputFile(path=f"{LANGUAGE}/{plan.package.name}/live.hpp", text=text))
    return tuple(files)


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentCode]:
    """Return a function that writes the source file of one component."""
    names = GlobalNames.of_project(plan)

    def write(component: ComponentPlan) -> ComponentCode:
        _header, source = _component_files(plan, component, names)
        return ComponentCode(file=source, find_origins=lambda: find_origins(component, source.text))

    return write


@dataclass(frozen=True, slots=True, kw_only=True)
class CppCode:
    """The header and the source of one component, and the names in them."""

    header: str
    source: str
    symbols: CppSymbols


def cpp_generator(project: Project, sources: Mapping[str, str]) -> Callable[[Design], CppCode]:
    """Return a function that writes the files of one design.

    The function raises `UnsoundDesignError` if C++ cannot express the design.
    """
    plan = plan_project(project, (), sources, RESERVED_MODULES)
    names = GlobalNames.of_project(plan)

    def write(design: Design) -> CppCode:
        component = plan_component(project, design, plan.package.modules, sources.get(design.component, ""))
        header, source = _component_files(plan, component, names)
        symbols = list_symbols(plan, component, names.class_name(design.component))
        return CppCode(header=header.text, source=source.text, symbols=symbols)

    return write


def list_regions(component: ComponentPlan) -> Iterator[CodePlan]:
    """Yield the code that is generated as regions."""
    sections = (component.module_code, component.members)
    yield from (code for code in sections if code is not None and code.code.in_language(LANGUAGE) is not None)
    yield from component.guard_code
    yield from component.action_code


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:  # noqa: ARG001 - as in other languages
    """List every path that `generate_cpp` may return."""
    folder = f"{LANGUAGE}/{package.name}"
    shared = ["components.hpp", "CMakeLists.txt", "interfaces.hpp"]
    shared += ["declarations.hpp"] if package.has_declarations else []
    shared += ["live.hpp"] if package.project.live else []
    modules = [f"{module}.{suffix}" for module in package.modules.values() for suffix in ("hpp", "cpp")]
    runtime = (*(f"{LANGUAGE}/{name}" for name in _list_runtime(package.project)), f"{LANGUAGE}/.clang-format")
    return (*runtime, *(f"{folder}/{name}" for name in (*shared, *modules)))


def _list_runtime(project: Project) -> tuple[str, ...]:
    return ("bica.hpp", "bica_live.hpp") if project.live else ("bica.hpp",)


def _component_files(plan: ProjectPlan, component: ComponentPlan, names: GlobalNames) -> tuple[OutputFile, OutputFile]:
    view = CppComponentWriter(project=plan, component=component, global_names=names).build_view()
    source = component.source or f"the design of {component.component}"
    header, body = (
        OutputFile(
            path=f"{LANGUAGE}/{plan.package.name}/{component.module}.{suffix}",
            text=add_header(render(f"cpp/component.{suffix}.jinja", view=view), source, "//"),
            component=component.component,
        )
        for suffix in ("hpp", "cpp")
    )
    return header, replace(body, text=add_code_hash(header.text, body.text))
