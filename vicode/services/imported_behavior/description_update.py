"""Finds descriptions in designs that XABSL has no syntax for."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import COMMON, Design
from vicode.model.paths import describe_path
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.model.xabsl.names import component_name, unqualified_name
from vicode.store import CommentedFile


@dataclass(frozen=True, slots=True, kw_only=True)
class UnwrittenDescription:
    """A description that is not in XABSL: the design and the line of its file."""

    message: str
    component: str
    line: int


def find_unwritten_descriptions(
    imported: Project, project: Project, texts: Mapping[str, str]
) -> Iterator[UnwrittenDescription]:
    """Yield the descriptions of designs that the import of the written files does not have."""
    written = {component_name(design): design for design in imported.designs}
    for design in project.designs:
        other = written.get(component_name(design))
        if other is None or design.component not in texts:
            continue
        commented: CommentedFile | None = None
        for path in _find_unwritten(other, design):
            commented = commented or CommentedFile(texts[design.component])
            message = f"the {describe_path((*path, 'doc'))} is not written to XABSL, which has no place for it"
            yield UnwrittenDescription(
                message=message, component=design.component, line=commented.line_of((*path, "doc"))
            )


def _find_unwritten(imported: Design, design: Design) -> Iterator[DesignPath]:
    if design.common.doc:
        yield ("common",)
    xabsl_names = {state.name: unqualified_name(state) for state in design.states}
    written: dict[str, str] = {}
    names = {state.name: unqualified_name(state) for state in imported.states}
    for located in iter_decisions(imported):
        source = names.get(located.source, COMMON)
        written[source] = f"{written.get(source, '')} {_words(located.decision.doc)}"
    for located in iter_decisions(design):
        source = xabsl_names.get(located.source, COMMON)
        if _words(located.decision.doc) not in written.get(source, "") and not located.decision.disabled:
            yield located.path


def _words(text: str) -> str:
    return " ".join(text.replace("*/", "* /").replace("/*", "/ *").split())
