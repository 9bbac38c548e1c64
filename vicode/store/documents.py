"""Reads design files and project files into the model."""

import re
from dataclasses import dataclass, replace
from pathlib import PurePath

from vicode.findings import Finding, FindingSubject, sort_findings
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.store.codec import decode_design, decode_project
from vicode.store.conflicts import TextConflict, find_conflicts
from vicode.store.format import DESIGN
from vicode.store.line_index import LineIndex, ReadReport
from vicode.store.project_format import PROJECT
from vicode.store.schema_reader import SchemaReader
from vicode.store.schema_types import RecordSchema
from vicode.store.source_map import SourceMap
from vicode.store.typed_node import TypedNode
from vicode.store.yaml_tree import MAX_BYTES, YamlTree, parse_yaml

_MAX_QUOTED = 80
PROJECT_FILES = ("project.yaml", "project.yml")


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignReadResult:
    """The design of a file, None if it is unreadable, with the locations of its nodes and all findings."""

    design: Design | None
    source_map: SourceMap
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectReadResult:
    """The project of a project.yaml without designs, None if it is unreadable."""

    project: Project | None
    source_map: SourceMap
    findings: tuple[Finding, ...]


def read_design(text: str | bytes, file: str = "design.yaml") -> DesignReadResult:
    """Read a design and report all errors; valid parts of an invalid design are kept.

    Args:
        text: The content of the file.
        file: The file name for findings; its stem is the default name of the component.
    """
    report, root = read_record(text, file, DESIGN)
    design = None
    if root is not None and root.value is not None:
        design = decode_design(root.value, PurePath(file).stem)
    source = SourceMap(file=file, line_index=report.line_index, root=root, design=design)
    component = design.component if design else ""
    return DesignReadResult(design=design, source_map=source, findings=_with_component(report.findings, component))


def read_project_file(text: str | bytes, file: str = "project.yaml") -> ProjectReadResult:
    """Read a project.yaml and report all errors; valid parts of an invalid file are kept."""
    report, root = read_record(text, file, PROJECT)
    project = None
    if root is not None and root.value is not None:
        project = decode_project(root.value, default_project_name(PurePath(file).parent.name))
    source = SourceMap(file=file, line_index=report.line_index, root=root)
    return ProjectReadResult(project=project, source_map=source, findings=_with_component(report.findings, ""))


def default_project_name(folder: str) -> str:
    """The default name of a project: its folder's name, converted to an identifier."""
    name = re.sub(r"\W+", "_", folder, flags=re.ASCII).strip("_")
    return name if name[:1].isalpha() else f"project_{name}".rstrip("_")


def read_record(text: str | bytes, file: str, schema: RecordSchema) -> tuple[ReadReport, TypedNode | None]:
    """Read a text as a record; None if the text as a whole is unreadable."""
    if len(text) > MAX_BYTES:
        report = ReadReport(line_index=LineIndex("", file))
        report.add("Y108", f"the file is larger than {MAX_BYTES} bytes", (0, 1), fix="split the design")
        return report, None
    try:
        decoded = text if isinstance(text, str) else text.decode("utf-8")
    except UnicodeDecodeError as error:
        return _not_utf8(error, file), None
    report = ReadReport(line_index=LineIndex(decoded, file))
    conflicts = find_conflicts(decoded)
    if conflicts:
        _report_conflicts(conflicts, report)
        return report, None
    tree = parse_yaml(decoded, report)
    if tree.root is None:
        if not report.findings:
            report.add("Y103", "the file is empty", (0, 1), fix="start with 'vicode: 1'")
        return report, None
    root = SchemaReader(report).read(tree.root, schema)
    return report, _complete_root(root, tree, report)


def _complete_root(root: TypedNode, tree: YamlTree, report: ReadReport) -> TypedNode | None:
    if not tree.is_complete:
        # Keys that are missing in the first part of the file may follow in the unread part.
        locations = [report.line_index.locate(offset, offset) for offset in tree.unclosed]
        unclosed = {(location.line, location.column) for location in locations}
        report.findings[:] = [finding for finding in report.findings if _is_certain(finding, unclosed)]
        return None
    is_known_version = all(finding.rule.code != "Y109" for finding in report.findings)
    return root if root.value is not None and is_known_version else None


def _is_certain(finding: Finding, unclosed: set[tuple[int, int]]) -> bool:
    is_unclosed = finding.location is not None and (finding.location.line, finding.location.column) in unclosed
    return finding.rule.code == "Y101" or not (finding.rule.code == "Y104" or is_unclosed)


def _report_conflicts(conflicts: tuple[TextConflict, ...], report: ReadReport) -> None:
    """Report each merge conflict at its first part."""
    for conflict in conflicts:
        first, *others = conflict.parts
        place = f" in {conflict.name}" if conflict.name else ""
        sides = f"ours {_quote(conflict.ours)}, theirs {_quote(conflict.theirs)}"
        report.add(
            "Y113",
            f"unresolved merge conflict{place}: {sides}",
            (first.start, first.end),
            fix="keep one side, or combine them, and remove the lines with <<<<<<<, ======= and >>>>>>>",
            note=("continues here", others[0].start) if others else None,
        )


def _quote(text: str) -> str:
    """One side of a conflict in one line."""
    line = " ".join(text.split())
    return f"'{line if len(line) <= _MAX_QUOTED else line[:_MAX_QUOTED] + '…'}'" if line else "nothing"


def _not_utf8(error: UnicodeDecodeError, file: str) -> ReadReport:
    """The report on a file in another encoding, located at its first invalid byte."""
    before = error.object[: error.start].decode("utf-8")
    report = ReadReport(line_index=LineIndex(before, file))
    is_utf16 = error.object.startswith((b"\xff\xfe", b"\xfe\xff"))
    message = "the file is UTF-16" if is_utf16 else f"the byte 0x{error.object[error.start]:02x} is not UTF-8"
    report.add("Y110", message, (len(before), len(before) + 1), fix="save the file as UTF-8")
    return report


def _with_component(findings: list[Finding], component: str) -> tuple[Finding, ...]:
    named = (
        replace(finding, subject=FindingSubject(component=component, path=finding.subject.path))
        if finding.subject is not None
        else finding
        for finding in findings
    )
    return sort_findings(named)
