"""Python generator: one module per component and one method per state, on the BICA runtime."""

from collections.abc import Callable, Iterator
from pathlib import Path

import vicode.bica
from vicode.generators.origins import ComponentCode
from vicode.generators.plan import INTERFACES_MODULE, CodePlan, ComponentPlan, PackagePlan, ProjectPlan
from vicode.generators.python.component import ComponentWriter
from vicode.generators.python.declarations import build_declarations_view
from vicode.generators.python.interfaces import build_interfaces_view
from vicode.generators.python.main_module import build_main_view
from vicode.generators.python.methods import section_code
from vicode.generators.python.names import RESERVED_MODULES, assign_global_names, component_class_name
from vicode.generators.python.origins import find_origins
from vicode.generators.python.probes import PROBES_MODULE, generate_probes
from vicode.generators.python.text import docstring
from vicode.output import OutputFile
from vicode.regions import add_header
from vicode.templating import render

__all__ = [
    "PROBES_MODULE",
    "RESERVED_MODULES",
    "class_path",
    "component_writer",
    "find_origins",
    "generate_probes",
    "generate_python",
    "list_paths",
    "list_regions",
]

LANGUAGE = "python"
_RUNTIME_FOLDER = Path(vicode.bica.__file__).parent


def generate_python(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:
    """Generate all files of a project; with `standalone` also the runtime, as package `vicode.bica` next to them."""
    names = assign_global_names(plan)
    folder = f"{LANGUAGE}/{plan.package.name}"
    project = f"the project {plan.name}"
    about = docstring(plan.doc or f"Components of {project}.", 0) + "\n"
    files = [OutputFile(path=f"{folder}/__init__.py", text=add_header(about, project))]
    shared = build_declarations_view(plan, names)
    if shared is not None:
        text = render("python/declarations.py.jinja", view=shared)
        files.append(OutputFile(path=f"{folder}/declarations.py", text=add_header(text, project)))
    interfaces = build_interfaces_view(plan, names)
    if interfaces is not None:
        text = render("python/interfaces.py.jinja", view=interfaces)
        files.append(OutputFile(path=f"{folder}/{INTERFACES_MODULE}.py", text=add_header(text, project)))
    main = build_main_view(plan)
    if main is not None:
        text = render("python/main.py.jinja", view=main)
        files.append(OutputFile(path=f"{folder}/__main__.py", text=add_header(text, project)))
    files += [_module(ComponentWriter(project=plan, component=item, names=names)) for item in plan.components]
    return (*files, *(_copy_runtime() if standalone else ()))


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentCode]:
    """Return a function that writes the module of one component."""
    names = assign_global_names(plan)

    def write(component: ComponentPlan) -> ComponentCode:
        file = _module(ComponentWriter(project=plan, component=component, names=names))
        return ComponentCode(file=file, find_origins=lambda: find_origins(component, file.text))

    return write


def list_regions(component: ComponentPlan) -> Iterator[CodePlan]:
    """Yield the code that is generated as regions."""
    yield from section_code(component)
    yield from component.action_code
    yield from component.guard_code


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:
    """List every path that `generate_python` may return."""
    folder = f"{LANGUAGE}/{package.name}"
    modules = ["__init__", "__main__"] if package.modules else ["__init__"]
    modules += ["declarations"] if package.has_declarations else []
    modules += [INTERFACES_MODULE] if package.interfaces else []
    paths = [f"{folder}/{module}.py" for module in (*modules, *package.modules.values())]
    return (*paths, *(file.path for file in (_copy_runtime() if standalone else ())))


def class_path(package: PackagePlan, component: str) -> str:
    """Return the import path of a generated class, "package.module:Class"."""
    module = INTERFACES_MODULE if component in package.interfaces else package.modules[component]
    return f"{package.name}.{module}:{component_class_name(component)}"


def _module(writer: ComponentWriter) -> OutputFile:
    component = writer.component
    text = render("python/component.py.jinja", view=writer.build_view())
    path = f"{LANGUAGE}/{writer.project.package.name}/{component.module}.py"
    text = add_header(text, component.source or f"the design of {component.component}")
    return OutputFile(path=path, text=text, component=component.component)


def _copy_runtime() -> tuple[OutputFile, ...]:
    """The runtime under its own name, so that generated and hand-written code imports it as with vicode installed."""
    sources = {f"bica/{source.name}": source.read_text("utf-8") for source in _RUNTIME_FOLDER.glob("*.py")}
    sources["__init__.py"] = '"""The runtime of vicode, copied for robots without it."""\n'
    return tuple(
        OutputFile(path=f"{LANGUAGE}/vicode/{name}", text=add_header(text, "vicode.bica"))
        for name, text in sorted(sources.items())
    )
