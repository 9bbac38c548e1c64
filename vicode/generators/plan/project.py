"""From a project to its plan: which components, and how their modules are called."""

from collections.abc import Collection, Mapping

from vicode.generators.plan.component import plan_component, plan_values
from vicode.generators.plan.expressions import UnsoundDesignError, literal_value
from vicode.generators.plan.interfaces import plan_interface
from vicode.generators.plan.names import NameAllocator, identifier_stem, package_name
from vicode.generators.plan.plan_types import PackagePlan, ProjectPlan
from vicode.model.expressions import build_scope
from vicode.model.project import Project


def plan_project(
    project: Project, components: Collection[str], sources: Mapping[str, str], reserved: frozenset[str]
) -> ProjectPlan:
    """Plan components with every design they use.

    Args:
        project: A project without mistakes in what is planned.
        components: Names of those to plan.
        sources: Design files by component, as they are named to people.
        reserved: Names no module may have in a language.
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
        components=tuple(
            plan_component(project, design, package.modules, sources.get(design.component, ""))
            for design in project.designs
            if design.component in components
        ),
        interfaces=tuple(plan_interface(project, each) for each in project.components if each.is_generated),
    )


def plan_package(project: Project, reserved: frozenset[str]) -> PackagePlan:
    """Names that depend on the names in the project alone: they are known of designs with mistakes too."""
    names = NameAllocator(reserved)
    components = sorted(design.component for design in project.designs)
    return PackagePlan(
        project=project,
        name=package_name(project.name),
        modules={component: names.allocate(identifier_stem(component)) for component in components},
        has_declarations=bool(project.enumerations or project.constants),
        interfaces=frozenset(each.component for each in project.components if each.is_generated),
    )


def collect_components(project: Project, components: Collection[str] | None) -> frozenset[str]:
    """The components with all that they use, directly or not, as far as they have designs.

    Raises:
        UnsoundDesignError: One of them has no design.
    """
    designs = {design.component: design for design in project.designs}
    if components is None:
        return frozenset(designs)
    unknown = sorted(set(components) - set(designs))
    if unknown:
        raise UnsoundDesignError(f"there is no design of '{unknown[0]}'")
    found: set[str] = set()
    waiting = sorted(components)
    while waiting:
        component = waiting.pop()
        if component in designs and component not in found:
            found.add(component)
            waiting += [use.component for use in designs[component].uses]
    return frozenset(found)
