"""Things that project.yaml declares, by their numbers in it, which stay when their names change."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.project import Interface, Project
from vicode.model.rename import SymbolRef

NodeUpdate = Callable[[Any], Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectNodePath:
    """Where a thing stands: the keys that lead to it, each with a number, such as ("components", 0), ("outputs", 3).

    None lead to the project itself.

    What stands there is an enumeration, a constant, a component, an agent, another declaration, or an element with
    what it means.
    """

    steps: tuple[tuple[str, int], ...]

    @staticmethod
    def top_level(section: str, number: int) -> "ProjectNodePath":
        """A thing of the project itself."""
        return ProjectNodePath(steps=((section, number),))

    def child(self, section: str, number: int) -> "ProjectNodePath":
        """A thing that stands in this one."""
        return ProjectNodePath(steps=(*self.steps, (section, number)))

    @property
    def section(self) -> str:
        """The key that it stands below; "" for the project itself."""
        return self.steps[-1][0] if self.steps else ""

    @property
    def kind(self) -> str:
        """What it is, in a word."""
        return self.section.removesuffix("s")

    def get(self, project: Project) -> Any:
        """The thing; None when it is gone."""
        thing: Any = project
        for section, number in self.steps:
            things = getattr(thing, section) or ()
            if number >= len(things):
                return None
            thing = things[number]
        return thing

    def name(self, project: Project) -> str:
        """Its name; "" when it is gone."""
        return _name_of(self.get(project))

    def names(self, project: Project) -> tuple[str, ...]:
        """The names of all that it stands in, and its own."""
        ways = (ProjectNodePath(steps=self.steps[: end + 1]) for end in range(len(self.steps)))
        return tuple(way.name(project) for way in ways)

    def path(self, project: Project) -> DesignPath:
        """Where it stands in the file."""
        names = self.names(project)
        return tuple(step for (section, _), name in zip(self.steps, names, strict=True) for step in (section, name))

    def update(self, project: Project, change: NodeUpdate) -> Project:
        """The project with another thing there."""
        changed: Project = _updated(project, self.steps, change)
        return changed

    def remove(self, project: Project) -> Project:
        """The project without the thing."""
        *outer, (section, number) = self.steps
        name = self.name(project)

        def change(holder: Any) -> Any:
            rest = tuple(each for at, each in enumerate(getattr(holder, section) or ()) if at != number)
            changes: dict[str, Any] = {section: rest}
            if section == "elements":
                changes["xabsl_elements"] = tuple(each for each in holder.xabsl_elements if each[0] != name)
            return replace(holder, **changes)

        changed: Project = _updated(project, tuple(outer), change)
        return changed

    def move_up(self, project: Project) -> Project:
        """The project with the thing before the one that stands before it; the first stays."""
        *outer, (section, number) = self.steps

        def change(holder: Any) -> Any:
            things = list(getattr(holder, section) or ())
            if 0 < number < len(things):
                things[number - 1 : number + 1] = things[number], things[number - 1]
            changes: dict[str, Any] = {section: tuple(things)}
            return replace(holder, **changes)

        changed: Project = _updated(project, tuple(outer), change)
        return changed

    def symbol_ref(self, project: Project) -> SymbolRef:
        """It as a thing that can be renamed, and is said elsewhere."""
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


def project_structure_key(project: Project) -> object:
    """What decides which fields the forms of a project have, as opposed to what stands in them."""
    parts = (
        (
            len(each.parameters),
            tuple(each.arguments and len(each.arguments) for each in each.outputs),
            len(each.variables),
        )
        for each in project.components
    )
    elements = tuple(len(each.elements) for each in project.enumerations)
    return (elements, len(project.constants), tuple(parts), len(project.agents))


def _name_of(thing: Any) -> str:
    if isinstance(thing, tuple):
        return str(thing[0])
    if isinstance(thing, Interface):
        return thing.component
    return thing.name if thing is not None else ""


def _updated(thing: Any, steps: tuple[tuple[str, int], ...], change: NodeUpdate) -> Any:
    if not steps:
        return change(thing)
    (section, number), rest = steps[0], steps[1:]
    inner = enumerate(getattr(thing, section) or ())
    changes = {section: tuple(_updated(each, rest, change) if at == number else each for at, each in inner)}
    return replace(thing, **changes)
