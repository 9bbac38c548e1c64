"""Python: a module a component, one method a state, on the BICA runtime."""

from pathlib import Path

import vicode.bica
from vicode.generators.plan import INTERFACES, PackagePlan, ProjectPlan
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
    "find_origins",
    "generate_probes",
    "generate_python",
    "list_paths",
]

LANGUAGE = "python"


def generate_python(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:
    """All files of a project; with `standalone` the runtime lies inside the package."""
    names = name_globals(plan)
    runtime = ".bica" if standalone else "vicode.bica"
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
    for component in plan.components:
        writer = ComponentWriter(project=plan, component=component, names=names, runtime=runtime)
        text = render("python/component.py.jinja", view=writer.view())
        source = component.source or f"the design of {component.component}"
        files.append(OutputFile(path=f"{folder}/{component.module}.py", text=seal(text, source)))
    return (*files, *(_copy_runtime(folder) if standalone else ()))


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


def _copy_runtime(folder: str) -> tuple[OutputFile, ...]:
    sources = sorted(Path(vicode.bica.__file__).parent.glob("*.py"))
    return tuple(
        OutputFile(path=f"{folder}/bica/{source.name}", text=seal(source.read_text("utf-8"), "vicode.bica"))
        for source in sources
    )
