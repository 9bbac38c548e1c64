"""Paths to the nodes of project.yaml by index, which stay valid when names change."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from vicode.editor.session.gestures.item_paths import change_item, item_at
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
        return item_at(project, self._flat)

    @property
    def _flat(self) -> DesignPath:
        return tuple(step for pair in self.steps for step in pair)

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
        changed: Project = change_item(project, self._flat, change)
        return changed

    def remove(self, project: Project) -> Project:
        section, number = self.steps[-1]
        name = self.name(project)

        def change(holder: Any) -> Any:
            nodes = getattr(holder, section)
            changes: dict[str, Any] = {section: (*nodes[:number], *nodes[number + 1 :])}
            if section == "elements":
                changes["xabsl_elements"] = tuple(pair for pair in holder.xabsl_elements if pair[0] != name)
            return replace(holder, **changes)

        changed: Project = change_item(project, self._flat[:-2], change)
        return changed

    def move_up(self, project: Project) -> Project:
        """The project with the node moved up by one in its section."""
        index = self.steps[-1][1]

        def moved(nodes: tuple[Any, ...]) -> tuple[Any, ...]:
            return (*nodes[: index - 1], nodes[index], nodes[index - 1], *nodes[index + 1 :]) if index else nodes

        changed: Project = change_item(project, self._flat[:-1], moved)
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
