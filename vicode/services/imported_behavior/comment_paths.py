"""Maps the paths of an imported project to those of the project that was written."""

from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass, field

from vicode.findings import DesignPath
from vicode.model.design import Action, Assign, Call, CommonSection, Decision, DecisionGroup, Design, Guard, State, Stay
from vicode.model.project import Interface, Project
from vicode.model.xabsl.names import component_name, is_basic_behavior, symbol_name, unqualified_name


@dataclass(slots=True)
class PathMap:
    """The paths in a written design by those of its import.

    Attributes:
        paths: Paths that differ, without what follows them.
        inexact: Sections with another structure: a path in them has no counterpart but the section.
    """

    paths: dict[DesignPath, DesignPath] = field(default_factory=dict)
    inexact: set[DesignPath] = field(default_factory=set)

    def translate(self, path: DesignPath) -> DesignPath:
        for length in range(len(path), 0, -1):
            start = path[:length]
            if start in self.inexact:
                return self.paths.get(start, start)
            if start in self.paths:
                return (*self.paths[start], *path[length:])
        return path

    def is_exact(self, path: DesignPath) -> bool:
        """Whether a path of the import has a counterpart."""
        return not any(path[:length] in self.inexact for length in range(1, len(path) + 1))


def map_design(imported: Design, design: Design) -> PathMap:
    """Map the paths of the import of a design."""
    found = PathMap()
    _map_names(found, ("parameters",), imported.parameters, design.parameters)
    _map_section(found, ("common",), ("common",), imported.common, design.common)
    ours = {unqualified_name(state): state for state in design.states}
    for state in imported.states:
        other = ours.get(unqualified_name(state))
        if other is not None:
            path, new = ("states", state.name), ("states", other.name)
            found.paths[path] = new
            _map_section(found, path, new, state, other)
    return found


def map_project(imported: Project, project: Project) -> PathMap:
    """Map the paths of the import of a project.yaml."""
    found = PathMap()
    for section in ("enumerations", "constants", "agents"):
        _map_names(found, (section,), getattr(imported, section), getattr(project, section))
    ours = {_component_key(each): each for each in project.components}
    for component in imported.components:
        other = ours.get(_component_key(component))
        if other is None:
            continue
        path, new = ("components", component.component), ("components", other.component)
        found.paths[path] = new
        for section in ("outputs", "variables"):
            names = {(symbol_name(other.component, each), each.type): each.name for each in getattr(other, section)}
            for each in getattr(component, section):
                name = names.get((symbol_name(component.component, each), each.type), each.name)
                found.paths[*path, section, each.name] = (*new, section, name)
    return found


def iter_elementary_paths(actions: Iterable[Action], path: DesignPath) -> Iterator[DesignPath]:
    """The path of each call and assignment; the first assignment of an action is the action."""
    for index, action in enumerate(actions):
        yield (*path, index)
        if isinstance(action, Assign):
            yield from ((*path, index, "set", name) for name, _value in action.values[1:])


def _map_names(found: PathMap, section: DesignPath, imported: Iterable[object], ours: Iterable[object]) -> None:
    name_of: Callable[..., str] = unqualified_name
    names = {name_of(item): item.name for item in ours}  # type: ignore[attr-defined]
    for item in imported:
        name: str = item.name  # type: ignore[attr-defined]
        found.paths[*section, name] = (*section, names.get(name_of(item), name))


def _map_section(
    found: PathMap, path: DesignPath, new: DesignPath, imported: State | CommonSection, ours: State | CommonSection
) -> None:
    if _shape(imported.transitions) != _shape(ours.transitions):
        found.paths[*path, "transitions"] = (*new, "transitions")
        found.inexact.add((*path, "transitions"))
    olds = list(iter_elementary_paths(imported.actions, (*path, "actions")))
    news = list(iter_elementary_paths(ours.actions, (*new, "actions")))
    has_others = isinstance(ours, State) and bool(ours.enter or ours.leave or ours.modulates)
    is_plain = all(isinstance(action, Assign | Call) for action in ours.actions)
    found.paths[*path, "actions"] = (*new, "actions")
    if len(olds) != len(news) or has_others or not is_plain:
        found.inexact.add((*path, "actions"))
    else:
        found.paths.update(zip(olds, news, strict=True))


def _shape(decisions: tuple[Decision, ...]) -> Hashable:
    """The structure of decisions without a final `stay`, which is the default."""
    if decisions and isinstance(decisions[-1], Stay) and decisions[-1].guard == Guard() and not decisions[-1].doc:
        decisions = decisions[:-1]
    return tuple(map(_item_shape, decisions))


def _item_shape(item: Decision) -> Hashable:
    if isinstance(item, DecisionGroup):
        branches = (tuple(map(_item_shape, branch)) for branch in (item.then, item.otherwise))
        return item.disabled, *branches
    return type(item), item.disabled


def _component_key(component: Interface) -> tuple[str, bool]:
    return component_name(component), is_basic_behavior(component)
