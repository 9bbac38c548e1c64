"""Plan a project: its components and their module names."""

from collections.abc import Collection, Mapping

from vicode.generators.plan.component import plan_component, plan_values
from vicode.generators.plan.int_growth import constant_ranges
from vicode.generators.plan.int_ranges import IntRanges
from vicode.generators.plan.interfaces import plan_interface
from vicode.generators.plan.plan_types import PackagePlan, ProjectPlan
from vicode.generators.plan.typed_expressions import UnsoundDesignError, literal_value
from vicode.generators.plan.unique_identifiers import NameAllocator
from vicode.model.expressions import build_scope
from vicode.model.names import identifier_stem, package_name
from vicode.model.project import Project


def plan_project(
    project: Project, components: Collection[str], sources: Mapping[str, str], reserved: frozenset[str]
) -> ProjectPlan:
    """Plan components of a project.

    Args:
        project: A project without errors in the planned components.
        components: The names of the components to plan.
        sources: Design files by component.
        reserved: Names that no module may have in the language.
    """
    package = plan_package(project, reserved)
    constants = plan_values(project.constants, build_scope(project, None))
    return ProjectPlan(
        project=project,
        name=project.name,
        doc=project.doc,
        package=package,
        enumerations=project.enumerations,
        constants=constants,
        nonzero_constants=frozenset(constant.name for constant in constants if literal_value(constant.initial)),
        ranges=IntRanges(constant_ranges(project)),
        components=tuple(
            plan_component(project, design, package.modules, sources.get(design.component, ""))
            for design in project.designs
            if design.component in components
        ),
        interfaces=tuple(plan_interface(project, item) for item in project.components if item.is_generated),
    )


def plan_package(project: Project, reserved: frozenset[str]) -> PackagePlan:
    """Plan the names of a package; they depend only on names, so designs may have errors."""
    names = NameAllocator(reserved)
    components = sorted(design.component for design in project.designs)
    return PackagePlan(
        project=project,
        name=package_name(project.name),
        modules={component: names.allocate(identifier_stem(component)) for component in components},
        has_declarations=bool(project.enumerations or project.constants),
        interfaces=frozenset(item.component for item in project.components if item.is_generated),
    )


def collect_components(project: Project, components: Collection[str] | None) -> frozenset[str]:
    """Return the components and all designs they use, directly or indirectly.

    Raises:
        UnsoundDesignError: A requested component has no design.
    """
    designs = {design.component: design for design in project.designs}
    if components is None:
        return frozenset(designs)
    unknown = sorted(set(components) - set(designs))
    if unknown:
        raise UnsoundDesignError(f"the component '{unknown[0]}' has no design")
    collected: set[str] = set()
    pending = sorted(components)
    while pending:
        component = pending.pop()
        if component in designs and component not in collected:
            collected.add(component)
            pending += [use.component for use in designs[component].uses]
    return frozenset(collected)
