"""Python: a module a component, one method a state, on the BICA runtime."""

from collections.abc import Callable
from pathlib import Path

import vicode.bica
from vicode.generators.origins import ComponentText
from vicode.generators.plan import INTERFACES, ComponentPlan, PackagePlan, ProjectPlan
from vicode.generators.python.component import ComponentWriter
from vicode.generators.python.declarations import declarations_view
from vicode.generators.python.interfaces import interfaces_view
from vicode.generators.python.names import RESERVED_MODULES, name_class, name_globals
from vicode.generators.python.origins import find_origins
from vicode.generators.python.probes import PROBES, generate_probes
from vicode.generators.python.text import docstring
from vicode.output import OutputFile
from vicode.regions import seal
from vicode.templating import render

__all__ = [
    "PROBES",
    "RESERVED_MODULES",
    "class_path",
    "component_writer",
    "find_origins",
    "generate_probes",
    "generate_python",
    "list_paths",
]

LANGUAGE = "python"
RUNTIME = "vicode.bica"


def generate_python(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:
    """All files of a project; with `standalone` the runtime lies inside the package."""
    names = name_globals(plan)
    runtime = ".bica" if standalone else RUNTIME
    folder = f"{LANGUAGE}/{plan.package.package}"
    project = f"the project {plan.name}"
    about = docstring(plan.doc or f"Components of {project}.", 0) + "\n"
    files = [OutputFile(path=f"{folder}/__init__.py", text=seal(about, project))]
    shared = declarations_view(plan, names, runtime)
    if shared is not None:
        text = render("python/declarations.py.jinja", view=shared)
        files.append(OutputFile(path=f"{folder}/declarations.py", text=seal(text, project)))
    handed_on = interfaces_view(plan, names, runtime)
    if handed_on is not None:
        text = render("python/interfaces.py.jinja", view=handed_on)
        files.append(OutputFile(path=f"{folder}/{INTERFACES}.py", text=seal(text, project)))
    files += [
        _module(ComponentWriter(project=plan, component=each, names=names, runtime=runtime)) for each in plan.components
    ]
    return (*files, *(_copy_runtime(folder) if standalone else ()))


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentText]:
    """What writes the modules of a project's components, one at a time."""
    names = name_globals(plan)

    def write(component: ComponentPlan) -> ComponentText:
        file = _module(ComponentWriter(project=plan, component=component, names=names, runtime=RUNTIME))
        return ComponentText(file=file, origins=find_origins(component, file.text))

    return write


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:
    """Every path that `generate_python` may write for the whole project."""
    folder = f"{LANGUAGE}/{package.package}"
    modules = ["__init__"]
    modules += ["declarations"] if package.has_declarations else []
    modules += [INTERFACES] if package.interfaces else []
    paths = [f"{folder}/{module}.py" for module in (*modules, *package.modules.values())]
    return (*paths, *(file.path for file in (_copy_runtime(folder) if standalone else ())))


def class_path(package: PackagePlan, component: str) -> str:
    """Where the class of a design's component is found: "package.module:Class"."""
    module = INTERFACES if component in package.interfaces else package.modules[component]
    return f"{package.package}.{module}:{name_class(component)}"


def _module(writer: ComponentWriter) -> OutputFile:
    component = writer.component
    text = render("python/component.py.jinja", view=writer.view())
    path = f"{LANGUAGE}/{writer.project.package.package}/{component.module}.py"
    return OutputFile(path=path, text=seal(text, component.source or f"the design of {component.component}"))


def _copy_runtime(folder: str) -> tuple[OutputFile, ...]:
    sources = sorted(Path(vicode.bica.__file__).parent.glob("*.py"))
    return tuple(
        OutputFile(path=f"{folder}/bica/{source.name}", text=seal(source.read_text("utf-8"), "vicode.bica"))
        for source in sources
    )
