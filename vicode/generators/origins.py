"""Map lines of generated code to the design elements they were generated from."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from vicode.findings import DesignPath
from vicode.generators.plan import Branch, DecisionPlan
from vicode.model.design import Design
from vicode.model.disabled import disabled_states, is_enabled, strip_disabled
from vicode.model.traversal import iter_decisions
from vicode.output import OutputFile


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """A range of lines (1-based, inclusive) and the path of its design element."""

    first: int
    last: int
    path: DesignPath


@dataclass(frozen=True, kw_only=True)
class ComponentCode:
    """The file of one component and the origins of its lines, which are found when they are read first."""

    file: OutputFile
    find_origins: Callable[[], tuple[Origin, ...]]

    @cached_property
    def origins(self) -> tuple[Origin, ...]:
        return self.find_origins()


def leaf_paths(alternatives: Iterable[DecisionPlan]) -> Iterator[DesignPath]:
    """The paths of the decisions with an outcome, in the order in which they are generated."""
    for alternative in alternatives:
        if isinstance(alternative.outcome, Branch):
            yield from leaf_paths((*alternative.outcome.then, *alternative.outcome.otherwise))
        else:
            yield alternative.path


def map_to_full_design(design: Design, origins: Iterable[Origin]) -> tuple[Origin, ...]:
    """Convert origins from paths in the design without disabled elements to paths in the full design."""
    origins = tuple(origins)
    paths = map_paths_to_full_design(design, (origin.path for origin in origins))
    return tuple(replace(origin, path=path) for origin, path in zip(origins, paths, strict=True))


def map_paths_to_full_design(design: Design, paths: Iterable[DesignPath]) -> tuple[DesignPath, ...]:
    """Convert paths in the design without disabled elements to paths in the full design."""
    off = disabled_states(design)
    full = (located.path for located in iter_decisions(design) if is_enabled(located, off))
    enabled = (located.path for located in iter_decisions(strip_disabled(design)))
    by_path = dict(zip(enabled, full, strict=True))
    return tuple(_full_path(by_path, path) for path in paths)


def _full_path(paths: dict[DesignPath, DesignPath], path: DesignPath) -> DesignPath:
    """Replace the longest prefix of a path that is a decision."""
    for length in range(len(path), 0, -1):
        if path[:length] in paths:
            return (*paths[path[:length]], *path[length:])
    return path
