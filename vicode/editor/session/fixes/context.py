"""What a fixer is given, and what it gives."""

from collections.abc import Callable
from dataclasses import dataclass

from vicode.findings import DesignPath, Finding, suggested_name
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.traversal import LocatedDecision, find_decision, iter_decisions

DesignEdit = Callable[[Design], Design]


@dataclass(frozen=True, slots=True, kw_only=True)
class Fix:
    """One mend: what it does in words, and the edit."""

    label: str
    edit: DesignEdit


@dataclass(frozen=True, slots=True, kw_only=True)
class FixContext:
    """A finding at a path of a design."""

    project: Project
    design: Design
    finding: Finding
    path: DesignPath

    @property
    def suggested_name(self) -> str:
        """The known name that was probably meant, empty if none is near."""
        return suggested_name(self.finding.fix)

    def decision(self) -> LocatedDecision | None:
        """The innermost decision that the path leads into."""
        indices = [at for at, part in enumerate(self.path) if isinstance(part, int)]
        is_below = self.path[:2] == ("common", "transitions") or self.path[2:3] == ("transitions",)
        return find_decision(self.design, self.path[: indices[-1] + 1]) if indices and is_below else None

    def state_name(self) -> str:
        """The state that the path leads into, empty if it leads into none."""
        return str(self.path[1]) if self.path[:1] == ("states",) and len(self.path) > 1 else ""

    def is_used_elsewhere(self) -> bool:
        """Whether another design uses this component, so that what it declares may be read or set from there."""
        own = self.design.component
        return any(
            use.component == own for design in self.project.designs if design.component != own for use in design.uses
        )

    def target_names(self) -> set[str]:
        """The names that transitions lead to."""
        return {getattr(located.decision, "to", "") for located in iter_decisions(self.design)}
