"""From a project of designs to files of code: a pure function, the same for every caller."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from functools import cache

from vicode.generators import xabsl
from vicode.generators.origins import ComponentCode, Origin, map_to_full_design
from vicode.generators.plan import (
    ComponentPlan,
    ProjectPlan,
    UnsoundDesignError,
    collect_components,
    plan_component,
    plan_package,
    plan_project,
)
from vicode.generators.python import (
    RESERVED_MODULES,
    class_path,
    component_writer,
    find_origins,
    generate_probes,
    generate_python,
    list_paths,
)
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import OutputFile

__all__ = [
    "GENERATORS",
    "ComponentCode",
    "Origin",
    "UnsoundDesignError",
    "collect_components",
    "component_generator",
    "generate",
    "list_origins",
    "list_outputs",
    "python_class_path",
    "python_probes",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Generator:
    """A language: what it writes for a plan, and all paths it may write for a project.

    `component_writer` writes the file of one component after the other; `find_origins` tells which lines of a
    component's text come from which thing of its design.
    """

    write: Callable[..., tuple[OutputFile, ...]]
    list_paths: Callable[..., tuple[str, ...]]
    reserved_modules: frozenset[str]
    component_writer: Callable[[ProjectPlan], Callable[[ComponentPlan], ComponentCode]]
    find_origins: Callable[[ComponentPlan, str], tuple[Origin, ...]]


GENERATORS: Mapping[str, Generator] = {
    "python": Generator(
        write=generate_python,
        list_paths=list_paths,
        reserved_modules=RESERVED_MODULES,
        component_writer=component_writer,
        find_origins=find_origins,
    ),
    "xabsl": Generator(
        write=xabsl.generate_xabsl,
        list_paths=xabsl.list_paths,
        reserved_modules=xabsl.RESERVED_MODULES,
        component_writer=xabsl.component_writer,
        find_origins=xabsl.find_origins,
    ),
}


def generate(
    project: Project,
    *,
    components: Collection[str] | None = None,
    exclude: Collection[str] = (),
    languages: Collection[str] | None = None,
    standalone: bool = False,
    sources: Mapping[str, str] | None = None,
) -> tuple[OutputFile, ...]:
    """The files of a project, by path; nothing is read or written, and the same project gives the same bytes.

    Args:
        project: Without error findings in what is generated.
        components: Only these and every design they use; None for all.
        leave_out: But not these, since they have mistakes.
        languages: None for those of the project.
        standalone: Copy the runtime into the package, so that it runs without vicode.
        sources: The design files by component, relative to the project's folder: how files and errors name them.

    Raises:
        UnsoundDesignError: A design has mistakes; `vicode.check` tells which.
    """
    files: list[OutputFile] = []
    for generator in _select_generators(project, languages):
        wanted = collect_components(project, components) - set(exclude)
        plan = plan_project(project, wanted, sources or {}, generator.reserved_modules)
        files += generator.write(plan, standalone=standalone)
    return tuple(sorted(files, key=lambda file: file.path))


def component_generator(
    project: Project, language: str, sources: Mapping[str, str]
) -> Callable[[Design], ComponentCode | None]:
    """What writes the file of one design after the other as `generate` does; None for one that cannot be said."""
    generator = GENERATORS[language]

    @cache
    def begun() -> tuple[ProjectPlan, Callable[[ComponentPlan], ComponentCode]]:
        plan = plan_project(project, (), sources, generator.reserved_modules)
        return plan, generator.component_writer(plan)

    def write(design: Design) -> ComponentCode | None:
        try:
            plan, write_component = begun()
            source = sources.get(design.component, "")
            written = write_component(plan_component(project, design, plan.package.modules, source))
        except UnsoundDesignError:
            return None
        return replace(written, origins=map_to_full_design(design, written.origins))

    return write


def list_origins(project: Project, component: str, language: str, text: str) -> tuple[Origin, ...]:
    """Which lines of a text that `generate` wrote for a component come from which thing of its design.

    Raises:
        UnsoundDesignError: The design has mistakes.
    """
    design, generator = project.design(component), GENERATORS[language]
    if design is None:
        return ()
    (plan,) = plan_project(project, {component}, {}, generator.reserved_modules).components
    return map_to_full_design(design, generator.find_origins(plan, text))


def list_outputs(
    project: Project, *, languages: Collection[str] | None = None, standalone: bool = False
) -> tuple[str, ...]:
    """Every path that `generate` may write for a project, sound or not: what else carries our header there is stale."""
    paths: list[str] = []
    for generator in _select_generators(project, languages):
        paths += generator.list_paths(plan_package(project, generator.reserved_modules), standalone=standalone)
    return tuple(sorted(paths))


def python_class_path(project: Project, component: str) -> str:
    """Where the class of a component is found in Python: "package.module:Class".

    Raises:
        UnsoundDesignError: Nothing declares it.
    """
    interface = project.interface(component)
    if interface is None:
        raise UnsoundDesignError(f"nothing declares the component '{component}'")
    if project.design(component) is None and not interface.is_generated:
        return interface.implementation
    return class_path(plan_package(project, RESERVED_MODULES), component)


def python_probes(project: Project, component: str) -> OutputFile:
    """A module that tests the guards of a design between iterations; it stands in the package beside the others.

    Raises:
        UnsoundDesignError: The design has mistakes.
    """
    plan = plan_project(project, {component}, {}, RESERVED_MODULES)
    return generate_probes(plan, plan.components[0])


def _select_generators(project: Project, languages: Collection[str] | None) -> list[Generator]:
    wanted = project.languages if languages is None else languages
    return [generator for language, generator in GENERATORS.items() if language in wanted]
