"""Code generation: a pure function from a project to output files."""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache

from vicode.findings import DesignPath
from vicode.generators.origins import ComponentCode, Origin, map_paths_to_full_design, map_to_full_design
from vicode.generators.plan import (
    CodePlan,
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
from vicode.generators.python import list_regions as list_python_regions
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
    "list_component_paths",
    "list_origins",
    "list_outputs",
    "list_regions",
    "python_class_path",
    "python_probes",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Generator:
    """The functions that implement one language.

    Attributes:
        write: Returns the files of a project.
        list_paths: Returns every path that `write` may return.
        reserved_modules: Names that no generated module may have.
        component_writer: Returns a function that writes the file of one component.
        find_origins: Maps lines of a component's text to elements of its design.
        list_regions: Returns the code that a component's text contains as regions.
    """

    write: Callable[..., tuple[OutputFile, ...]]
    list_paths: Callable[..., tuple[str, ...]]
    reserved_modules: frozenset[str]
    component_writer: Callable[..., Callable[[ComponentPlan], ComponentCode]]
    find_origins: Callable[[ComponentPlan, str], tuple[Origin, ...]]
    list_regions: Callable[[ComponentPlan], Iterable[CodePlan]]


def _python_generator() -> Generator:
    return Generator(
        write=generate_python,
        list_paths=list_paths,
        reserved_modules=RESERVED_MODULES,
        component_writer=component_writer,
        find_origins=find_origins,
        list_regions=list_python_regions,
    )


def _xabsl_generator() -> Generator:
    # The XABSL tool chain is slow to import, and most projects do not generate XABSL.
    from vicode.generators import xabsl  # noqa: PLC0415

    return Generator(
        write=xabsl.generate_xabsl,
        list_paths=xabsl.list_paths,
        reserved_modules=xabsl.RESERVED_MODULES,
        component_writer=xabsl.component_writer,
        find_origins=xabsl.find_origins,
        # The code is printed as statements of the option.
        list_regions=lambda _component: (),
    )


def _cpp_generator() -> Generator:
    from vicode.generators import cpp  # noqa: PLC0415 - most projects do not generate C++

    return Generator(
        write=cpp.generate_cpp,
        list_paths=cpp.list_paths,
        reserved_modules=cpp.RESERVED_MODULES,
        component_writer=cpp.component_writer,
        find_origins=cpp.find_origins,
        list_regions=cpp.list_regions,
    )


def _javascript_generator() -> Generator:
    from vicode.generators import javascript  # noqa: PLC0415 - most projects do not generate JavaScript

    return Generator(
        write=javascript.generate_javascript,
        list_paths=javascript.list_paths,
        reserved_modules=javascript.RESERVED_MODULES,
        component_writer=javascript.component_writer,
        find_origins=javascript.find_origins,
        # Code has no counterpart in JavaScript.
        list_regions=lambda _component: (),
    )


GENERATORS: Mapping[str, Callable[[], Generator]] = {
    "python": _python_generator,
    "cpp": _cpp_generator,
    "xabsl": _xabsl_generator,
    "javascript": _javascript_generator,
}
"""Functions that load the generator of a language."""


def generate(
    project: Project,
    *,
    components: Collection[str] | None = None,
    exclude: Collection[str] = (),
    languages: Collection[str] | None = None,
    standalone: bool = False,
    sources: Mapping[str, str] | None = None,
) -> tuple[OutputFile, ...]:
    """Generate the files of a project, sorted by path, without any file access; equal projects give equal bytes.

    Args:
        project: A project without error findings in the generated components.
        components: Generate only these and every design they use; None for all.
        exclude: Components to leave out, for example because they have errors.
        languages: None for the languages of the project.
        standalone: Also copy the runtime, so that the code runs without vicode.
        sources: Design files by component, relative to the project folder; used in header comments and errors.

    Raises:
        UnsoundDesignError: A design has errors; `vicode.check` reports them.
    """
    files: list[OutputFile] = []
    for generator in _select_generators(project, languages):
        selected = collect_components(project, components) - set(exclude)
        plan = plan_project(project, selected, sources or {}, generator.reserved_modules)
        files += generator.write(plan, standalone=standalone)
    return tuple(sorted(files, key=lambda file: file.path))


def component_generator(
    project: Project, language: str, sources: Mapping[str, str]
) -> Callable[[Design], ComponentCode | None]:
    """Return a function that writes the file of one design, or returns None if the language cannot express it."""
    generator = GENERATORS[language]()

    @cache
    def start() -> tuple[ProjectPlan, Callable[[ComponentPlan], ComponentCode]]:
        plan = plan_project(project, (), sources, generator.reserved_modules)
        return plan, generator.component_writer(plan)

    def write(design: Design) -> ComponentCode | None:
        try:
            plan, write_component = start()
            source = sources.get(design.component, "")
            code = write_component(plan_component(project, design, plan.package.modules, source))
        except UnsoundDesignError:
            return None
        return replace(code, find_origins=lambda: map_to_full_design(design, code.origins))

    return write


def list_origins(project: Project, component: str, language: str, text: str) -> tuple[Origin, ...]:
    """Map the lines of a component's generated text to elements of its design.

    Raises:
        UnsoundDesignError: The design has errors.
    """
    design, generator = project.design(component), GENERATORS[language]()
    if design is None:
        return ()
    (plan,) = plan_project(project, {component}, {}, generator.reserved_modules).components
    return map_to_full_design(design, generator.find_origins(plan, text))


def list_regions(project: Project, component: str, language: str) -> dict[str, DesignPath]:
    """List the regions of a component's generated text with the paths of their code in its design.

    Raises:
        UnsoundDesignError: The design has errors.
    """
    design, generator = project.design(component), GENERATORS[language]()
    if design is None:
        return {}
    (plan,) = plan_project(project, {component}, {}, generator.reserved_modules).components
    regions = tuple(generator.list_regions(plan))
    paths = map_paths_to_full_design(design, (code.path for code in regions))
    return dict(zip((code.region_id for code in regions), paths, strict=True))


def list_outputs(
    project: Project, *, languages: Collection[str] | None = None, standalone: bool = False
) -> tuple[str, ...]:
    """List every path that `generate` may return; any other file with a vicode header in these folders is stale."""
    paths: list[str] = []
    for generator in _select_generators(project, languages):
        paths += generator.list_paths(plan_package(project, generator.reserved_modules), standalone=standalone)
    return tuple(sorted(paths))


def list_component_paths(project: Project, component: str) -> tuple[str, ...]:
    """List the files that contain code of one design; names alone decide, so designs may have errors."""
    paths: list[str] = []
    for generator in _select_generators(project, None):
        package = plan_package(project, generator.reserved_modules)
        if component not in package.modules:
            continue
        # Files that all designs share are also written for another one.
        shared = replace(package, modules={"": ""})
        own = replace(package, modules={component: package.modules[component]})
        others = generator.list_paths(shared, standalone=False)
        paths += (path for path in generator.list_paths(own, standalone=False) if path not in others)
    return tuple(paths)


def python_class_path(project: Project, component: str) -> str:
    """Return the import path of a component's Python class, "package.module:Class".

    Raises:
        UnsoundDesignError: The component is not declared.
    """
    interface = project.interface(component)
    if interface is None:
        raise UnsoundDesignError(f"the component '{component}' is not declared")
    if project.design(component) is None and not interface.is_generated:
        return interface.implementation
    return class_path(plan_package(project, RESERVED_MODULES), component)


def python_probes(project: Project, component: str) -> OutputFile:
    """Generate the module of a package that evaluates the guards of a design between iterations.

    Raises:
        UnsoundDesignError: The design has errors.
    """
    plan = plan_project(project, {component}, {}, RESERVED_MODULES)
    return generate_probes(plan, plan.components[0])


def _select_generators(project: Project, languages: Collection[str] | None) -> list[Generator]:
    selected = project.languages if languages is None else languages
    return [load() for language, load in GENERATORS.items() if language in selected]
