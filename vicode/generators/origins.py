"""Which lines of generated code come from which thing of a design: the same words for every language."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from vicode.findings import Path
from vicode.model.design import Design
from vicode.model.enabling import disabled_states, enabled_part, is_working
from vicode.model.walks import walk_decisions
from vicode.output import OutputFile


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """Lines, both ends included and counted from 1, with the path of what they come from."""

    first: int
    last: int
    path: Path


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentText:
    """The file of one component, and which of its lines come from what."""

    file: OutputFile
    origins: tuple[Origin, ...]


def in_whole_design(design: Design, origins: Iterable[Origin]) -> tuple[Origin, ...]:
    """The origins with the paths of the whole design, in place of those of what is enabled in it."""
    off = disabled_states(design)
    whole = (located.path for located in walk_decisions(design) if is_working(located, off))
    enabled = (located.path for located in walk_decisions(enabled_part(design)))
    paths = dict(zip(enabled, whole, strict=True))
    return tuple(replace(origin, path=_path_in(paths, origin.path)) for origin in origins)


def _path_in(paths: dict[Path, Path], path: Path) -> Path:
    """A decision's path, with what follows it, by the longest part that is a decision."""
    for length in range(len(path), 0, -1):
        if path[:length] in paths:
            return (*paths[path[:length]], *path[length:])
    return path
