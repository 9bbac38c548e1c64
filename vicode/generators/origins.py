"""Which lines of generated code come from which thing of a design: the same words for every language."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.disabled import disabled_states, is_enabled, strip_disabled
from vicode.model.traversal import iter_decisions
from vicode.output import OutputFile


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """Lines, both ends included and counted from 1, with the path of what they come from."""

    first: int
    last: int
    path: DesignPath


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentCode:
    """The file of one component, and which of its lines come from what."""

    file: OutputFile
    origins: tuple[Origin, ...]


def map_to_full_design(design: Design, origins: Iterable[Origin]) -> tuple[Origin, ...]:
    """The origins with the paths of the whole design, in place of those of what is enabled in it."""
    off = disabled_states(design)
    whole = (located.path for located in iter_decisions(design) if is_enabled(located, off))
    enabled = (located.path for located in iter_decisions(strip_disabled(design)))
    paths = dict(zip(enabled, whole, strict=True))
    return tuple(replace(origin, path=_full_path(paths, origin.path)) for origin in origins)


def _full_path(paths: dict[DesignPath, DesignPath], path: DesignPath) -> DesignPath:
    """A decision's path, with what follows it, by the longest part that is a decision."""
    for length in range(len(path), 0, -1):
        if path[:length] in paths:
            return (*paths[path[:length]], *path[length:])
    return path
