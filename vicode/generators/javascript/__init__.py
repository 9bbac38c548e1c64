"""JavaScript generator: an ES module per component, on the runtime bica.mjs."""

from collections.abc import Callable, Iterable

from vicode.generators.javascript.component import (
    JavaScriptWriter,
    check_supported,
    state_key,
    write_declarations,
    write_interfaces,
)
from vicode.generators.javascript.names import escape
from vicode.generators.javascript.script import wrap_module, write_script
from vicode.generators.origins import ComponentCode, Origin
from vicode.generators.plan import (
    INTERFACES_MODULE,
    ComponentPlan,
    InterfacePlan,
    PackagePlan,
    ProjectPlan,
    plan_interface,
    plan_project,
)
from vicode.model.project import Project
from vicode.output import OutputFile
from vicode.regions import add_header
from vicode.templating import read_asset

__all__ = [
    "LANGUAGE",
    "RESERVED_MODULES",
    "check_supported",
    "component_script",
    "component_writer",
    "escape",
    "find_origins",
    "generate_javascript",
    "list_paths",
    "script_runtime",
]

LANGUAGE = "javascript"
_DECLARATIONS = "declarations"
RESERVED_MODULES = frozenset({_DECLARATIONS, INTERFACES_MODULE})


def generate_javascript(plan: ProjectPlan, *, standalone: bool) -> tuple[OutputFile, ...]:
    """Generate all files of a project; `standalone` has no effect, since the runtime is always written."""
    del standalone
    if not plan.project.designs:
        return ()
    write, folder, origin = component_writer(plan), f"{LANGUAGE}/{plan.package.name}", f"the project {plan.name}"
    texts = {f"{folder}/{INTERFACES_MODULE}.mjs": write_interfaces(plan, list_interfaces(plan))}
    if plan.package.has_declarations:
        texts[f"{folder}/{_DECLARATIONS}.mjs"] = write_declarations(plan)
    shared = [OutputFile(path=path, text=add_header(text, origin, "//")) for path, text in texts.items()]
    runtime = add_header(read_asset("javascript/bica.mjs"), "vicode", "//")
    shared.append(OutputFile(path=f"{LANGUAGE}/bica.mjs", text=runtime))
    return (*shared, *(write(component).file for component in plan.components))


def component_writer(plan: ProjectPlan) -> Callable[[ComponentPlan], ComponentCode]:
    """Return a function that writes the module of one component."""

    def write(component: ComponentPlan) -> ComponentCode:
        text = JavaScriptWriter(package=plan.package, component=component).write()
        file = OutputFile(
            path=f"{LANGUAGE}/{plan.package.name}/{component.module}.mjs",
            text=add_header(text, component.source or f"the design of {component.component}", "//"),
            component=component.component,
        )
        return ComponentCode(file=file, find_origins=lambda: find_origins(component, file.text))

    return write


def list_paths(package: PackagePlan, *, standalone: bool) -> tuple[str, ...]:
    """List every path that `generate_javascript` may return."""
    del standalone
    if not package.project.designs:
        return ()
    shared = (INTERFACES_MODULE, *((_DECLARATIONS,) if package.has_declarations else ()))
    names = (*shared, *package.modules.values())
    return (f"{LANGUAGE}/bica.mjs", *(f"{LANGUAGE}/{package.name}/{name}.mjs" for name in names))


def find_origins(plan: ComponentPlan, text: str) -> tuple[Origin, ...]:
    """Map the lines of each state to the state."""
    marks = {f"      {state_key(state.name)}: {{": state.name for state in plan.states}
    lines = text.split("\n")
    origins = []
    for number, line in enumerate(lines, start=1):
        if line in marks:
            last = next(index for index in range(number, len(lines)) if lines[index] == "      },") + 1
            origins.append(Origin(first=number, last=last, path=("states", marks[line])))
    return tuple(origins)


def script_runtime() -> str:
    """The runtime that `component_script` needs, as an expression."""
    return wrap_module(read_asset("javascript/bica.mjs"))


def component_script(project: Project, component: str, modules: Iterable[str]) -> str:
    """Write a design as `write_script` does; `modules` are those of the designs that it uses.

    Raises:
        UnsoundDesignError: The design has errors, or JavaScript cannot express it.
    """
    plan = plan_project(project, {component}, {}, RESERVED_MODULES)
    return write_script(plan, list_interfaces(plan), modules)


def list_interfaces(plan: ProjectPlan) -> list[InterfacePlan]:
    designs = {design.component for design in plan.project.designs}
    return [plan_interface(plan.project, item) for item in plan.project.components if item.component not in designs]
