"""Writes the module that runs a package: `python -m PACKAGE [COMPONENT]`."""

from vicode.generators.plan import ProjectPlan
from vicode.generators.python.names import component_class_name
from vicode.generators.python.text import docstring, quoted
from vicode.generators.python.views import MainModuleView


def build_main_view(plan: ProjectPlan) -> MainModuleView | None:
    """Return the view of the module: the agents first, then all other designs; None without designs."""
    modules = plan.package.modules
    roots = {agent.root: agent.name for agent in plan.project.agents if agent.root in modules}
    named = [(name, component) for component, name in roots.items()]
    named += [(component, component) for component in modules if component not in roots]
    if not named:
        return None
    package = plan.package.name
    return MainModuleView(
        docstring=docstring(f"Runs a component of the project {plan.name}: python -m {package} [COMPONENT].", 0),
        components=tuple(
            (quoted(name), quoted(f"{package}.{modules[component]}:{component_class_name(component)}"))
            for name, component in dict(named).items()
        ),
        world=quoted(plan.project.world),
        clock=quoted(plan.project.clock) if plan.project.clock else "",
    )
