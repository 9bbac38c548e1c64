"""Paths to the nodes of project.yaml by index, which stay valid when names change."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.project import Interface, Project
from vicode.model.rename import SymbolRef

NodeUpdate = Callable[[Any], Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectNodePath:
    """The path to a node as pairs of section and index, such as ("components", 0), ("outputs", 3).

    The empty path is the project. A node is an enumeration, a constant, a component, an agent, another declaration, or
    a pair of an element and its doc.
    """

    steps: tuple[tuple[str, int], ...]

    @staticmethod
    def top_level(section: str, number: int) -> "ProjectNodePath":
        return ProjectNodePath(steps=((section, number),))

    def child(self, section: str, number: int) -> "ProjectNodePath":
        return ProjectNodePath(steps=(*self.steps, (section, number)))

    @property
    def section(self) -> str:
        """The section that contains the node; "" for the project."""
        return self.steps[-1][0] if self.steps else ""

    @property
    def kind(self) -> str:
        """The kind of the node: its section in the singular, such as "output"."""
        return self.section.removesuffix("s")

    def get(self, project: Project) -> Any:
        """The node; None if it no longer exists."""
        node: Any = project
        for section, number in self.steps:
            nodes = getattr(node, section) or ()
            if number >= len(nodes):
                return None
            node = nodes[number]
        return node

    def name(self, project: Project) -> str:
        """The name of the node; "" if it no longer exists."""
        return _name_of(self.get(project))

    def names(self, project: Project) -> tuple[str, ...]:
        paths = (ProjectNodePath(steps=self.steps[: end + 1]) for end in range(len(self.steps)))
        return tuple(path.name(project) for path in paths)

    def path(self, project: Project) -> DesignPath:
        """The path by names, as used in findings."""
        names = self.names(project)
        return tuple(step for (section, _), name in zip(self.steps, names, strict=True) for step in (section, name))

    def update(self, project: Project, change: NodeUpdate) -> Project:
        """The project with the node replaced by `change(node)`."""
        changed: Project = _updated(project, self.steps, change)
        return changed

    def remove(self, project: Project) -> Project:
        *outer, (section, number) = self.steps
        name = self.name(project)

        def change(holder: Any) -> Any:
            rest = tuple(node for index, node in enumerate(getattr(holder, section) or ()) if index != number)
            changes: dict[str, Any] = {section: rest}
            if section == "elements":
                changes["xabsl_elements"] = tuple(pair for pair in holder.xabsl_elements if pair[0] != name)
            return replace(holder, **changes)

        changed: Project = _updated(project, tuple(outer), change)
        return changed

    def move_up(self, project: Project) -> Project:
        """The project with the node moved up by one in its section."""
        *outer, (section, number) = self.steps

        def change(holder: Any) -> Any:
            nodes = list(getattr(holder, section) or ())
            if 0 < number < len(nodes):
                nodes[number - 1 : number + 1] = nodes[number], nodes[number - 1]
            changes: dict[str, Any] = {section: tuple(nodes)}
            return replace(holder, **changes)

        changed: Project = _updated(project, tuple(outer), change)
        return changed

    def symbol_ref(self, project: Project) -> SymbolRef:
        """The node as a symbol that can be renamed."""
        names = self.names(project)
        match [section for section, _number in self.steps]:
            case ["enumerations", "elements"]:
                return SymbolRef(section="elements", owner=names[0], name=names[1])
            case ["components", section]:
                return SymbolRef(component=names[0], section=section, name=names[1])
            case ["components", "outputs", "arguments"]:
                return SymbolRef(component=names[0], section="arguments", owner=names[1], name=names[2])
            case _:
                return SymbolRef(section=self.section, name=names[0])


def _name_of(node: Any) -> str:
    if isinstance(node, tuple):
        return str(node[0])
    if isinstance(node, Interface):
        return node.component
    return node.name if node is not None else ""


def _updated(node: Any, steps: tuple[tuple[str, int], ...], change: NodeUpdate) -> Any:
    if not steps:
        return change(node)
    (section, number), rest = steps[0], steps[1:]
    children = enumerate(getattr(node, section) or ())
    updated = tuple(_updated(child, rest, change) if index == number else child for index, child in children)
    return replace(node, **{section: updated})
