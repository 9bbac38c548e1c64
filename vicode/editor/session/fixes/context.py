"""The input and output of the functions that propose fixes."""

from collections.abc import Callable
from dataclasses import dataclass

from vicode.findings import DesignPath, Finding
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.traversal import LocatedDecision, find_decision

DesignEdit = Callable[[Design], Design]
ProjectEdit = Callable[[Project], Project]


@dataclass(frozen=True, slots=True, kw_only=True)
class Fix:
    """A labelled edit of the design, and of project.yaml if `edit_project` is set."""

    label: str
    edit: DesignEdit
    edit_project: ProjectEdit | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class FixContext:
    """A finding at a path of a design."""

    project: Project
    design: Design
    finding: Finding
    path: DesignPath

    def decision(self) -> LocatedDecision | None:
        """The innermost decision on the path."""
        indices = [index for index, part in enumerate(self.path) if isinstance(part, int)]
        is_below = self.path[:2] == ("common", "transitions") or self.path[2:3] == ("transitions",)
        return find_decision(self.design, self.path[: indices[-1] + 1]) if indices and is_below else None

    def state_name(self) -> str:
        """The state on the path, empty if there is none."""
        return str(self.path[1]) if self.path[:1] == ("states",) and len(self.path) > 1 else ""

    def is_used_elsewhere(self) -> bool:
        """Whether another design uses this component and may read or set its declarations."""
        own = self.design.component
        return any(
            use.component == own for design in self.project.designs if design.component != own for use in design.uses
        )
